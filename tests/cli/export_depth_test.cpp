// SPDX-License-Identifier: BSD-3-Clause
// `sslam export --format depth` on a rendered room, whose renderer knows depth and normals.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "cli/depth_comparison.hpp"
#include "cli/input/open_images.hpp"
#include "cli/results/depth_export.hpp"
#include "cli/room_copy.hpp"
#include "sslam/core/median.hpp"
#include "sslam/geometry/plane3.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "support/catch.hpp"

namespace export_depth_test {

namespace fs = std::filesystem;
using namespace sslam;
using namespace sslam::testing;

namespace {

Outcome export_depth(const fs::path& run, const std::string& options) {
  return run_program("export " + run.string() + " --format depth " + options);
}

void require_done(const Outcome& outcome) {
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
}

// The shared room through a lens, and a run in metres on it.
struct DenseRoom {
  ScratchFolder scratch;
  fs::path folder = scratch.path() / "bent", run = scratch.path() / "run";

  DenseRoom() {
    require_done(run_program("synth " + folder.string() + " --quiet --frames " + std::to_string(kFrames) +
                             " --seed 3 --size 480x360 --lens -0.2,0.05"));
    require_done(run_program("run " + folder.string() +
                             " --quiet --normals none --calibration fixed --dense " +
                             "--no-report --scale depth --out " + run.string()));
  }
};

const DenseRoom& dense_room() {
  static const DenseRoom room;
  return room;
}

}  // namespace

TEST_CASE(
    "export gives the keyframes the depth and normals that their renderer has, with and without the lens") {
  const DenseRoom& room = dense_room();
  for (const bool straight : {false, true}) {
    const fs::path out = room.scratch.path() / (straight ? "straight" : "as they are"),
                   truth = straight ? sslam::testing::room() : room.folder;
    const Outcome outcome =
        export_depth(room.run, (straight ? "--images --out '" : "--out '") + out.string() + "'");
    INFO(outcome.text);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.text.find("sslam: ") == std::string::npos);  // no warning, no note
    CHECK(text_of(out / "depth.txt")
              .starts_with("# depth by the model of a run of sslam, 5000 units to the metre\n"));
    CHECK(text_of(out / "normals/encoding.txt").starts_with("r=+x g=+y b=+z plane_sigma_deg="));
    const auto depths = rows_of(out / "depth.txt"), normals = rows_of(out / "normals.txt"),
               images = rows_of(out / "rgb.txt");
    io::Warnings warnings;
    REQUIRE(depths.size() == io::read_trajectory(room.run / "keyframes.txt", warnings).size());
    REQUIRE(io::read_trajectory(out / "keyframes.txt", warnings).size() == depths.size());
    REQUIRE(normals.size() == depths.size());
    REQUIRE(images.size() == depths.size());
    const auto true_rows = rows_of(truth / "depth.txt");
    Comparison all;
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const auto& [stamp, file] = depths[i];
      CHECK(normals[i] == std::make_pair(stamp, "normals" / file.filename()));
      CHECK(images[i].first == stamp);
      if (straight)
        CHECK(fs::is_regular_file(out / images[i].second));
      else
        CHECK(fs::equivalent(out / images[i].second, room.folder / "rgb" / file.stem().concat(".jpg")));
      const auto same = std::find_if(true_rows.begin(), true_rows.end(),
                                     [&](const auto& row) { return row.second == file; });
      REQUIRE(same != true_rows.end());
      CHECK(std::stod(same->first) == Approx(std::stod(stamp)).margin(1e-9));
      const cv::Mat_<std::uint16_t> depth = depth_in(out / file);
      all.add(depth, depth_in(truth / file));
      all.add_normals(depth, normals_in(out / normals[i].second), normals_in(truth / normals[i].second));
    }
    const double share = static_cast<double>(all.errors.size()) / static_cast<double>(all.true_pixels);
    const Vec3<double> shift = all.shift();
    const double error = median(std::span(all.errors)), bend = median(std::span(all.bends));
    INFO("depth in " << share << ", median error " << error << ", scale " << shift.x() << ", shift "
                     << shift.tail<2>().transpose() << ", normals " << bend);
    CHECK(share > 0.5);
    CHECK(error < 0.02);
    CHECK(std::abs(shift.x()) < 0.02);
    // The planes of the model are half a degree off, which looks like as many pixels: that the middles of
    // pixels are meant is held by the case of exact values, and by that of the raster.
    CHECK(shift.tail<2>().cwiseAbs().maxCoeff() < 1);
    CHECK(bend < 1);
  }
}

TEST_CASE("an export of depth is a dataset that is read again, and no dataset is written over") {
  const DenseRoom& room = dense_room();
  const fs::path out = room.scratch.path() / "again";
  for (int i = 0; i < 2; ++i) require_done(export_depth(room.run, "--images --out " + out.string()));
  const io::Dataset dataset = cli::dataset_at(out);
  CHECK(dataset.layout == io::Layout::kTum);
  CHECK(dataset.warnings.empty());
  REQUIRE(dataset.frames.size() == rows_of(out / "depth.txt").size());
  for (const io::FrameEntry& frame : dataset.frames) CHECK(fs::is_regular_file(frame.depth));
  CHECK(text_of(out / "camera.yaml").find("DepthMapFactor: 5000\n") != std::string::npos);
  CHECK(text_of(out / "camera.yaml").find("Camera.k1: 0\n") != std::string::npos);
  const std::string list = text_of(room.folder / "depth.txt");
  require_refused(export_depth(room.run, "--out " + room.folder.string()),
                  "bent: holds depth.txt, which no such export has made; choose another folder");
  CHECK(text_of(room.folder / "depth.txt") == list);
}

TEST_CASE("export of depth refuses a run whose model is missing or damaged with one line") {
  const DenseRoom& room = dense_room();
  const fs::path run = room.scratch.path() / "spoiled";
  fs::copy(room.run, run);
  fs::resize_file(run / "model.glb", fs::file_size(run / "model.glb") / 2);
  require_refused(export_depth(run, ""), "model.glb: ends too early");
  fs::remove(run / "model.glb");
  require_refused(export_depth(run, ""), "model.glb: is missing");
  CHECK_FALSE(fs::exists(run / "depth"));
}

TEST_CASE("exported depth is 5000 times that of the plane in each pixel, and 0 beyond what 16 bits hold") {
  const ScratchFolder scratch;
  const Pinhole<double> pinhole{50, 55, 31.5, 22};
  const Plane3<double> plane{Vec3<double>(0.7, 0.1, 0.7).normalized(), 4};
  cli::RunFolder run;
  run.metrics["settings"] = {{"pinhole", {pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy}},
                             {"distortion", {0, 0, 0, 0, 0}},
                             {"image_size", {64, 48}},
                             {"dataset", "gone.mp4"}};
  run.frames.columns = {"index", "stamp", "image"};
  run.frames.add_row({"7", "1.25", "gone.mp4 frame 7"});
  const SE3<double> world_from_cam{SO3<double>::exp({0.3, -0.2, 0.1}), {1, 2, 3}};
  for (const int index : {7, 8}) {  // 8: of an earlier run
    Keyframe<double> keyframe;
    keyframe.frame.index = index;
    keyframe.frame.stamp = 1.25;
    keyframe.cam_from_world = world_from_cam.inverse();
    run.map.add_keyframe(keyframe);
  }
  const Mat<double, 3, 2> basis = tangent_basis(plane.normal);
  for (const Vec2<double>& corner : {Vec2<double>(-900, -900), Vec2<double>(900, -900), Vec2<double>(0, 900)})
    run.surfaces.places.push_back(
        (world_from_cam * Vec3<double>(plane.distance * plane.normal + basis * corner)).cast<float>());
  run.surfaces.indices = {0, 1, 2};
  const cli::DepthCounts counts = cli::write_depth_export(run, scratch.path(), scratch.path(), false);
  CHECK(counts.keyframes == 1);
  CHECK(counts.strangers == 1);
  CHECK(counts.missing == 1);
  CHECK(counts.pixels == 64 * 48);
  CHECK_FALSE(fs::exists(scratch.path() / "rgb.txt"));
  CHECK(text_of(scratch.path() / "depth.txt") ==
        "# depth by the model of a run of sslam, 5000 units to the map's unit\n# timestamp filename\n"
        "1.250000 depth/gone_000007.png\n");
  const cv::Mat_<std::uint16_t> depth = depth_in(scratch.path() / "depth/gone_000007.png");
  const cv::Mat_<cv::Vec3b> normals = normals_in(scratch.path() / "normals/gone_000007.png");
  REQUIRE(depth.size() == cv::Size(64, 48));
  std::size_t with_depth = 0, too_far = 0;
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const double inverse = plane.normal.dot(pinhole.unproject(Vec2<double>(u, v))) / plane.distance;
      if (inverse < 0.01) continue;  // near the end of the triangle
      CHECK((normal_of(normals(v, u)) + plane.normal).norm() < 0.01);
      if (inverse < 5000 / 65535.0) {
        CHECK(depth(v, u) == 0);
        ++too_far;
      } else {
        CHECK(std::abs(depth(v, u) - 5000 / inverse) < 0.6);
        ++with_depth;
      }
    }
  CHECK(too_far > 50);
  CHECK(counts.too_far >= too_far);
  CHECK(counts.with_depth == with_depth);
}

}  // namespace export_depth_test
