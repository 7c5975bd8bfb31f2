// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/suite_check.hpp"

#include <set>

#include "cli/batch/plan.hpp"
#include "cli/batch/suite_options.hpp"
#include "cli/input/mask_source.hpp"
#include "cli/results/truth_source.hpp"
#include "cli/run/metric_scale.hpp"
#include "cli/run/run_check.hpp"
#include "cli/shell/messages.hpp"

namespace sslam::cli {
namespace {

class SuiteCheck {
 public:
  explicit SuiteCheck(const Suite& suite) : suite_(suite) {}

  [[nodiscard]] std::vector<SequenceFacts> run() {
    for (const std::filesystem::path& earlier : suite_.against)
      in(suite_.against_line, "against", [&] { (void)read_plan(earlier); });
    for (const SuiteMethod& method : suite_.methods) {
      in(method.preset_line, "[[method]]", [&] { (void)choose_preset(method.preset); });
      in(method.set_line, "[[method]]",
         [&] { (void)set_parameters(choose_preset(method.preset), method.set); });
    }
    std::vector<SequenceFacts> facts;
    for (const SuiteSequence& sequence : suite_.sequences) facts.push_back(check_sequence(sequence));
    for (const SuiteReference& reference : suite_.references) check_reference(reference);
    return facts;
  }

 private:
  // Says where in the suite it stands what the check throws.
  template <class Check>
  void in(int line, const char* what, Check check) const {
    try {
      check();
    } catch (const std::exception& error) {
      throw Error(suite_.file.string() + ": line " + std::to_string(line) + ": " + what + ": " +
                  error.what());
    }
  }

  [[nodiscard]] SequenceFacts check_sequence(const SuiteSequence& sequence) {
    SequenceFacts facts;
    RunSettings settings;
    io::Dataset dataset;
    CameraChoice camera;
    in(sequence.line, "[[sequence]]", [&] {
      std::vector<std::string> words{sequence.dataset};
      for (const SuiteOption& option : sequence.options) words.push_back(argument_of(option));
      settings = parse_run(words);
      dataset = open_from_starts(sequence, settings, facts);
      camera = choose_run_camera(settings, dataset);
      if (!settings.mask.empty())
        (void)MaskSource(settings.mask, {camera.camera.width, camera.camera.height});
      check_scale(parse_scale(settings.scale), dataset, camera.depth_factor);
      io::Trajectory truth = dataset.ground_truth;
      if (!sequence.truth.empty()) {
        TruthSource source = load_truth(sequence.truth, FileAxes::kAuto);
        if (source.counted)
          throw Error(sequence.truth.string() + ": its poses have no stamps; put times.txt beside it");
        truth = std::move(source.trajectory);
      }
      facts.truth = truth_during(dataset, truth);
      if (facts.truth.empty() && !sequence.truth.empty())
        throw Error(sequence.truth.string() + ": no pose at the time of the images of " + sequence.dataset);
    });
    if (facts.truth.empty())
      print_note(sequence.name + ": no ground truth, so the tables show only the share tracked");
    for (const SuiteMethod& method : suite_.methods) check_method(sequence, method, dataset, camera);
    return facts;
  }

  // The frames of all runs together.
  [[nodiscard]] static io::Dataset open_from_starts(const SuiteSequence& sequence,
                                                    const RunSettings& settings, SequenceFacts& facts) {
    if (sequence.starts.empty()) {
      io::Dataset dataset = open_run_dataset(settings);
      facts.frames.push_back(io::frame_stamps(dataset));
      return dataset;
    }
    RunSettings whole = settings;
    whole.slice.start = 0;
    whole.slice.stride = 1;
    io::Dataset dataset = open_run_dataset(whole);
    for (const std::int64_t start : sequence.starts) {
      io::Dataset part = dataset;
      io::apply_slice(part, {start, settings.slice.end, settings.slice.stride});
      facts.frames.push_back(io::frame_stamps(part));
    }
    io::apply_slice(dataset, {sequence.starts.front(), settings.slice.end, 1});
    return dataset;
  }

  void check_method(const SuiteSequence& sequence, const SuiteMethod& method, const io::Dataset& dataset,
                    const CameraChoice& camera) {
    RunSettings settings;
    in(method.line, "[[method]]", [&] {
      std::vector<std::string> words = run_arguments(suite_, sequence, method, method.seeds.front(), {});
      settings = parse_run({words.begin() + 1, words.end()});  // less "run"
      check_live(settings, choose_preset(method.preset));
    });
    in(method.normals_line, "[[method]]", [&] {
      check_normals(settings, dataset, camera.depth_factor);
      check_wide(settings, camera);
      // A network takes a while to load: each source is looked at once.
      if (!settings.normals.empty() && sources_.insert(settings.normals).second)
        (void)choose_normals(settings.normals);
    });
  }

  void check_reference(const SuiteReference& reference) const {
    in(reference.line, "[[reference]]", [&] {
      for (const auto& [sequence, files] : reference.trajectories) {
        for (const std::filesystem::path& file : files) {
          io::Warnings warnings;
          (void)load_stamped(file, warnings);
          print_warnings(warnings);
        }
      }
    });
  }

  const Suite& suite_;
  std::set<std::string> sources_;  // of normals, already looked at
};

}  // namespace

std::vector<SequenceFacts> check_suite(const Suite& suite) {
  return SuiteCheck(suite).run();
}

}  // namespace sslam::cli
