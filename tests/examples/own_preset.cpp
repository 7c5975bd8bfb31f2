// SPDX-License-Identifier: BSD-3-Clause
// A rotation stage of your own inside System and `sslam run`. This one believes the Manhattan frame only
// where all three axes are seen. The program is sslam with one more preset:
//
//   own_preset run DATASET --preset three-axes
#include "sslam/system/compiled_stages.hpp"
#include "sslam/system/pipeline_engine.hpp"
#include "sslam/system/presets.hpp"
#include "sslam/system/program.hpp"

namespace {

using namespace sslam;

class ThreeAxes : public ManhattanRotation<double> {
 public:
  RotationAnswer<double> rotate(const Frame<double>& frame, const SO3<double>& predicted_cam_from_world,
                                const KnownAxes<double>& known) {
    RotationAnswer<double> answer = ManhattanRotation::rotate(frame, predicted_cam_from_world, known);
    if (answer.axes_seen < 3 && answer.seen) answer.seen->certain = false;
    return answer;
  }
};
static_assert(RotationStage<ThreeAxes, double>);

using Mine = presets::With<presets::Structure<double, WallTimer>, slots::Rotation<ThreeAxes>>;

}  // namespace

int main(int argc, char** argv) {
  Preset preset;
  preset.name = "three-axes";
  preset.meaning = "as structure, where all three axes of the room are seen";
  preset.make = make_engine<Mine>;
  add_preset(preset);
  return run_program(argc, argv);
}
