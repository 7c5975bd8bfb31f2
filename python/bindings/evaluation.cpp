// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in files, and how good they are.
#include "sslam/io/evaluation/evaluation.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "cli/results/truth_source.hpp"
#include "sslam/io/evaluation/same_clock.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::python {
namespace {

// (stamps, poses, whether stamps are the numbers of rows, messages)
nb::tuple read(const std::filesystem::path& path) {
  io::Warnings warnings;
  io::PoseFile file;
  {
    const Free free;
    file = cli::load_estimate(path, warnings);
  }
  const nb::tuple arrays = trajectory_arrays(file.trajectory);
  return nb::make_tuple(arrays[0], arrays[1], file.counted, warnings);
}

// (stamps, poses, whether counted, seconds a stamp, stamps of the images, messages)
nb::tuple read_truth(const std::filesystem::path& path) {
  cli::TruthSource source;
  {
    const Free free;
    source = cli::load_truth(path, cli::FileAxes::kAuto);
  }
  const nb::tuple arrays = trajectory_arrays(source.trajectory);
  const std::size_t frames = source.frame_stamps.size();
  return nb::make_tuple(arrays[0], arrays[1], source.counted, source.seconds_per_stamp,
                        make_array(std::move(source.frame_stamps), {frames}), source.warnings);
}

// Stamps that are too small to show their unit show it beside the others.
void bring_to_clock(const io::Trajectory& reference, io::Trajectory& poses, double max_difference) {
  const io::StampUnit unit =
      io::unit_on_clock(io::stamps_of(reference), io::stamps_of(poses), max_difference);
  for (io::StampedPose& pose : poses) pose.stamp /= unit.per_second;
}

struct Compared {
  io::Evaluation evaluation;
  std::vector<double> stamps, position_errors, rotation_errors;  // of the pairs
};

Compared compare(const Rows<double>& truth_stamps, const Rows<double>& truth_poses,
                 const Rows<double>& stamps, const Rows<double>& poses, const std::string& align,
                 double max_difference, const Rows<double>& frame_stamps, std::size_t frames,
                 double seconds_per_stamp) {
  io::Trajectory truth = trajectory_from(truth_stamps, truth_poses, "truth");
  io::Trajectory estimate = trajectory_from(stamps, poses, "estimate");
  const Free free;
  io::EvaluationOptions options;
  for (const io::Alignment known : {io::Alignment::kNone, io::Alignment::kSe3, io::Alignment::kSim3})
    if (io::name(known) == align) options.alignment = known;
  options.max_difference = max_difference;
  options.seconds_per_stamp = seconds_per_stamp;
  options.frames = frames;
  options.frame_stamps.assign(frame_stamps.data(), frame_stamps.data() + frame_stamps.size());
  bring_to_clock(truth, estimate, max_difference);
  bring_to_clock(estimate, truth, max_difference);
  Compared compared;
  compared.evaluation = io::evaluate(truth, estimate, options);
  const io::PairedPoses paired = io::pair_poses(truth, estimate, max_difference);
  compared.stamps = io::stamps_of(paired.estimate);
  compared.position_errors = io::position_errors(paired, compared.evaluation.truth_from_estimate);
  compared.rotation_errors = io::rotation_errors(paired, compared.evaluation.truth_from_estimate.rotation);
  return compared;
}

nb::object array_of(const std::vector<double>& values) {
  std::vector<double> copy = values;
  const std::size_t count = copy.size();
  return nb::cast(make_array(std::move(copy), {count}));
}

Mat<double, 4, 4> matrix_of_similarity(const Sim3<double>& s) {
  Mat<double, 4, 4> m = Mat<double, 4, 4>::Identity();
  m.topLeftCorner<3, 3>() = s.scale * s.rotation.matrix();
  m.topRightCorner<3, 1>() = s.translation;
  return m;
}

}  // namespace

void bind_evaluation(nb::module_& module) {
  using io::Statistics;
  nb::class_<Statistics>(module, "Statistics",
                         "Summary of a list of errors; if count is 0, so is everything else.")
      .def_ro("count", &Statistics::count)
      .def_ro("rmse", &Statistics::rmse)
      .def_ro("mean", &Statistics::mean)
      .def_ro("median", &Statistics::median)
      .def_ro("deviation", &Statistics::deviation, "standard deviation of the population")
      .def_ro("min", &Statistics::min)
      .def_ro("max", &Statistics::max)
      .def("__repr__", [](const Statistics& s) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "<sslam.Statistics rmse=%.6g mean=%.6g median=%.6g max=%.6g count=%zu>", s.rmse, s.mean,
                      s.median, s.max, s.count);
        return std::string(text);
      });
  nb::class_<io::RelativeError>(module, "RelativeError", "Errors of the motion over a step of time.")
      .def_prop_ro("step", [](const io::RelativeError& e) { return e.delta.value; })
      .def_prop_ro("unit",
                   [](const io::RelativeError& e) {
                     return std::string(e.delta.unit == io::DeltaUnit::kFrames ? "frames" : "seconds");
                   })
      .def_ro("translation", &io::RelativeError::translation, "metres")
      .def_ro("rotation", &io::RelativeError::rotation, "radians");
  nb::class_<Compared>(module, "Evaluation",
                       "How good a trajectory is, as the tools of the TUM RGB-D benchmark define it.")
      .def_prop_ro(
          "position", [](const Compared& c) { return c.evaluation.position; },
          "absolute trajectory error: distances after alignment, metres")
      .def_prop_ro(
          "rotation", [](const Compared& c) { return c.evaluation.rotation; },
          "angles after the same alignment, radians")
      .def_prop_ro(
          "relative", [](const Compared& c) { return c.evaluation.relative; },
          "over one frame, and over one second")
      .def_prop_ro(
          "scale", [](const Compared& c) { return c.evaluation.truth_from_estimate.scale; },
          "of the alignment")
      .def_prop_ro(
          "transform",
          [](const Compared& c) {
            return matrix_array<4, 4>(matrix_of_similarity(c.evaluation.truth_from_estimate));
          },
          "ground truth from estimate, (4, 4), with the scale")
      .def_prop_ro(
          "poses", [](const Compared& c) { return c.evaluation.poses; }, "in the estimate")
      .def_prop_ro(
          "pairs", [](const Compared& c) { return c.evaluation.pairs; },
          "number of estimated poses that have a true pose")
      .def_prop_ro(
          "frames", [](const Compared& c) { return c.evaluation.frames; },
          "number of frames that could have been tracked; 0: not known")
      .def_prop_ro(
          "tracked", [](const Compared& c) { return c.evaluation.tracked; },
          "number of those frames that have a pose")
      .def_prop_ro(
          "notes", [](const Compared& c) { return c.evaluation.notes; },
          "reasons to doubt the figures, one line each")
      .def_prop_ro(
          "stamps", [](const Compared& c) { return array_of(c.stamps); }, "of the pairs, seconds, (N,)")
      .def_prop_ro(
          "position_errors", [](const Compared& c) { return array_of(c.position_errors); },
          "of the pairs, metres, (N,)")
      .def_prop_ro(
          "rotation_errors", [](const Compared& c) { return array_of(c.rotation_errors); },
          "of the pairs, radians, (N,)");
  module.def("read_trajectory", &read);
  module.def("read_truth", &read_truth);
  module.def("evaluate", &compare);
  module.def("write_trajectory",
             [](const std::filesystem::path& path, const Rows<double>& stamps, const Rows<double>& poses) {
               io::write_trajectory(path, trajectory_from(stamps, poses, "trajectory"));
             });
}

}  // namespace sslam::python
