// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <map>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/images.hpp"
#include "bindings/map_arrays.hpp"
#include "bindings/tracking.hpp"
#include "cli/input/normal_choice.hpp"
#include "sslam/system/parameters.hpp"

namespace sslam::python {
namespace {

Result track(Tracking& tracking, const PixelArray& image, double stamp,
             const std::optional<PixelArray>& depth, const std::optional<PixelArray>& mask,
             const std::optional<PixelArray>& normals, const std::string& name, bool rgb) {
  Given given;
  given.image = mat_of(image);
  given.depth = mat_of(depth);
  given.mask = mat_of(mask);
  given.normals = mat_of(normals);
  given.rgb = rgb && given.image.channels() > 1;
  given.stamp = stamp;
  given.name = name;
  return tracking.track(given);
}

// The command line's own reader of the same words; its message begins with the option's name.
NormalChoice source_of_normals(const std::string& text) {
  try {
    return cli::choose_normals(text);
  } catch (const std::exception& error) {
    const std::string why = error.what();
    if (why.starts_with("--normals ")) throw SettingsError("normals", why.substr(10));
    throw SettingsError("normals", why);
  }
}

std::map<std::string, float> timings(const Result& result) {
  std::map<std::string, float> all{{"points", result.points_ms},     {"lines", result.lines_ms},
                                   {"normals", result.normals_ms},   {"extraction", result.extraction_ms},
                                   {"tracking", result.tracking_ms}, {"frame", result.frame_ms()}};
  for (int stage = 0; stage < kStageCount; ++stage)
    all[name(static_cast<Stage>(stage))] = result.stage_ms[static_cast<std::size_t>(stage)];
  return all;
}

nb::object covariance_or_none(const Result& result) {
  if (!result.has_pose() || !result.has_covariance()) return nb::none();
  return nb::cast(matrix_array<6, 6>(result.covariance));
}

nb::object pose_or_none(const std::optional<SE3<double>>& world_from_cam) {
  if (!world_from_cam) return nb::none();
  return nb::cast(matrix_array<4, 4>(matrix_of(*world_from_cam)));
}

void bind_result(nb::module_& module) {
  nb::enum_<State>(module, "State", nb::is_arithmetic(), "State of tracking.")
      .value("INITIALISING", State::kInitialising, "no map yet")
      .value("MANHATTAN", State::kManhattan,
             "rotation from the Manhattan frame, translation from points and lines")
      .value("FALLBACK", State::kFallback, "full pose from points and lines")
      .value("UNCERTAIN", State::kUncertain, "a pose too uncertain to build the map on")
      .value("LOST", State::kLost, "no pose");
  nb::enum_<Reason>(module, "Reason", nb::is_arithmetic(), "Why a frame has its state.")
      .value("FINE", Reason::kFine, "no reason")
      .value("TOO_FEW_FEATURES", Reason::kTooFewFeatures, "the image shows too little")
      .value("TOO_FEW_MATCHES", Reason::kTooFewMatches,
             "too few features of the reference frame, or of the map, are matched")
      .value("LOW_PARALLAX", Reason::kLowParallax, "the camera has only turned or stood still: no depth yet")
      .value("NO_CONSENSUS", Reason::kNoConsensus, "the matches do not agree on one motion")
      .value("NO_MANHATTAN_FRAME", Reason::kNoManhattanFrame, "no Manhattan evidence in this image")
      .value("MANHATTAN_REJECTED", Reason::kManhattanRejected, "the Manhattan pose disagrees with the map")
      .value("UNCERTAIN_POSE", Reason::kUncertainPose, "enough matches, but the pose is too uncertain")
      .value("RELOCALISED", Reason::kRelocalised, "found again after a loss");
  nb::class_<Result>(module, "Result", "The result of System.track for one frame.")
      .def_prop_ro(
          "pose",
          [](const Result& r) {
            return pose_or_none(r.has_pose() ? std::optional(r.cam_from_world.inverse()) : std::nullopt);
          },
          nb::sig("def pose(self) -> numpy.typing.NDArray[numpy.float64] | None"),
          "camera to world, (4, 4), in units of the map; None if the frame has no pose")
      .def_prop_ro("covariance", &covariance_or_none,
                   nb::sig("def covariance(self) -> numpy.typing.NDArray[numpy.float64] | None"),
                   "(6, 6), of xi in pose @ Exp(xi), in the camera's axes: rotation first, rad^2, then the "
                   "position, units of the map squared. The map counts as exact. None if the pose was not "
                   "refined against the map: there is no pose, the frame began the map, or the preset is "
                   "'odometry'")
      .def_ro("index", &Result::index, "number of the frame, from 0")
      .def_ro("stamp", &Result::stamp, "seconds")
      .def_ro("state", &Result::state)
      .def_ro("reason", &Result::reason)
      .def_ro("world", &Result::world,
              "number of the map that the pose is in; each new map has its own until maps are joined")
      .def_prop_ro(
          "inliers", [](const Result& r) { return r.point_inliers + r.line_inliers; },
          "features that agree with the pose")
      .def_ro("point_inliers", &Result::point_inliers)
      .def_ro("line_inliers", &Result::line_inliers)
      .def_ro("points", &Result::points, "point features found in the image")
      .def_ro("lines", &Result::lines, "line features found in the image")
      .def_ro("normals", &Result::normals, "surface normals found in the image")
      .def_prop_ro(
          "normals_asked", [](const Result& r) { return std::string(name(r.normal_need)); },
          "why normals were computed; empty: they were not")
      .def_prop_ro(
          "normals_status", [](const Result& r) { return std::string(name(r.normal_status)); },
          "'ok', or why there are no normals")
      .def_ro("axes_seen", &Result::axes_seen, "Manhattan axes with support, 0 to 3")
      .def_ro("structure", &Result::structure,
              "the Manhattan rotation took part in the pose, and agrees with it")
      .def_ro("image_fixed", &Result::image_fixed,
              "number of features left out because they never move in the image")
      .def_ro("keyframe", &Result::keyframe, "the frame became a keyframe of the map")
      .def_ro("loop_closed", &Result::loop_closed,
              "a loop was closed: a place was recognised, and the map has changed")
      .def_ro("maps_joined", &Result::maps_joined,
              "two maps were joined: this one and one that had been left")
      .def_ro("map_changed", &Result::map_changed,
              "the map changed: one of the events above, or another map began")
      .def_ro("warnings", &Result::warnings, "a line each")
      .def_prop_ro("timings", &timings,
                   "milliseconds of wall clock by name; 'frame' is 'extraction' and 'tracking' together")
      .def("__repr__", [](const Result& r) {
        const std::string why = name(r.reason);
        return "<sslam.Result " + std::to_string(r.index) + ": " + name(r.state) +
               (why.empty() ? "" : ", " + why) + ", " + std::to_string(r.point_inliers + r.line_inliers) +
               " inliers>";
      });
}

nb::list parameter_list(const ParameterTable& table) {
  nb::list all;
  for (const Parameter& p : table.entries())
    all.append(nb::make_tuple(p.name, p.value, name(p.unit), p.least, p.most, p.meaning));
  return all;
}

// `of` is computed without the interpreter's lock, and becomes arrays with it.
template <class Of>
auto reader(Of of) {
  return [of](Tracking& tracking) {
    return arrays_of(tracking.read([&](const System& system) { return of(system.map()); }));
  };
}

void bind_tracking(nb::module_& module) {
  nb::class_<Tracking>(module, "Tracking", "The implementation of sslam.System.")
      .def("__init__",
           [](Tracking* self, const Camera<double>& camera, const std::string& preset,
              const std::string& normals, const std::map<std::string, double>& parameters, std::uint64_t seed,
              bool live, int longest_side, bool final_pass, double depth_factor, double normals_sigma_deg) {
             Settings settings;
             settings.camera = camera;
             settings.preset = preset;
             for (const auto& [name, value] : parameters) settings.parameters.push_back({name, value});
             settings.seed = seed;
             settings.live = live;
             settings.longest_side = longest_side;
             settings.final_pass = final_pass;
             settings.depth_factor = depth_factor;
             settings.keep_pictures = true;  // the map's colours come from them
             const Free free;                // networks take a while to load
             settings.normals = source_of_normals(normals);
             new (self) Tracking(std::move(settings), radians(normals_sigma_deg));
           })
      .def("track", &track, nb::arg("image"), nb::arg("stamp"), nb::arg("depth").none(),
           nb::arg("mask").none(), nb::arg("normals").none(), nb::arg("name"), nb::arg("rgb"))
      .def("finish", &Tracking::finish)
      .def("load", &Tracking::load)
      .def("localise_only", &Tracking::localise_only)
      .def("save",
           [](Tracking& t, const std::filesystem::path& path) {
             t.read([&](const System& s) {
               s.save(path);
               return 0;
             });
           })
      .def("save_trajectory",
           [](Tracking& t, const std::filesystem::path& path) {
             t.read([&](const System& s) {
               io::write_trajectory(path, s.trajectory());
               return 0;
             });
           })
      .def("trajectory",
           [](Tracking& t) {
             return trajectory_arrays(t.read([](const System& s) { return s.trajectory(); }));
           })
      .def("bridged",
           [](Tracking& t) {
             std::vector<double> stamps = t.read([](const System& s) { return s.bridged(); });
             const std::size_t count = stamps.size();
             return make_array(std::move(stamps), {count});
           })
      .def("points", reader(points_of))
      .def("cloud", [](Tracking& t) { return arrays_of(t.cloud()); })
      .def("lines", reader(lines_of))
      .def("planes", reader(planes_of))
      .def("keyframes",
           [](Tracking& t) {
             return trajectory_arrays(t.read([](const System& s) { return keyframes_of(s.map()); }));
           })
      .def("latest",
           [](const Tracking& t) {
             const LatestPose latest = t.system().latest();
             return nb::make_tuple(latest.stamp, latest.state, pose_or_none(latest.world_from_cam),
                                   latest.world);
           })
      .def("parameters", [](const Tracking& t) { return parameter_list(t.system().parameters()); })
      .def_prop_ro("camera", [](const Tracking& t) { return t.system().settings().camera; })
      .def_prop_ro("reads_depth", [](const Tracking& t) { return t.system().reads_depth(); })
      .def_prop_ro("read_out",
                   [](Tracking& t) { return t.read([](const System& s) { return s.read_out(); }); })
      .def_prop_ro("frames", [](Tracking& t) { return t.read([](const System& s) { return s.frames(); }); });
}

}  // namespace

void bind_system(nb::module_& module) {
  bind_result(module);
  bind_tracking(module);
  module.def("presets", [] {
    nb::list all;
    for (const Preset& preset : all_presets())
      all.append(
          nb::make_tuple(preset.name, preset.meaning, preset.use_normals, preset.make_live != nullptr));
    return all;
  });
  module.def("preset_parameters",
             [](const std::string& preset) { return parameter_list(all_parameters(find_preset(preset))); });
}

}  // namespace sslam::python
