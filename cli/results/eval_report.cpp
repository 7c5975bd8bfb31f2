// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/eval_report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/shell/json_text.hpp"
#include "sslam/core/types.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

template <class... Values>
std::string line(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

// Errors are kept in radians inside, and shown in degrees.
io::Statistics in_degrees(io::Statistics s) {
  for (double* value : {&s.rmse, &s.mean, &s.median, &s.deviation, &s.min, &s.max}) *value = degrees(*value);
  return s;
}

std::string error_row(const std::string& name, const io::Statistics& s, const char* unit) {
  if (s.count == 0) return line("%-26s %9s\n", name.c_str(), "none");
  return line("%-26s %9.4f %9.4f %9.4f %9.4f  %s\n", name.c_str(), s.rmse, s.mean, s.median, s.max, unit);
}

std::string name_of(const io::Delta& delta) {
  const char* unit = delta.unit == io::DeltaUnit::kSeconds ? "s" : (delta.value == 1 ? "frame" : "frames");
  return line("%g %s", delta.value, unit);
}

nlohmann::ordered_json statistics_json(const io::Statistics& s) {
  return {{"count", s.count},   {"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median},
          {"std", s.deviation}, {"min", s.min},   {"max", s.max}};
}

}  // namespace

std::string evaluation_table(const io::Evaluation& e) {
  std::string text;
  if (e.frames > 0) {
    const double share = static_cast<double>(e.tracked) / static_cast<double>(e.frames);
    text += line("frames tracked   %zu of %zu (%.1f %%)\n", e.tracked, e.frames, 100 * share);
  }
  text += line("poses            %zu\n", e.poses);
  text += line("compared         %zu, stamps within %g\n", e.pairs, e.options.max_difference);
  text += line("path             %.3f m, estimate %.3f m after alignment\n", e.truth_path, e.estimate_path);
  text += "alignment        " + std::string(name(e.options.alignment));
  if (e.options.alignment == io::Alignment::kSim3) text += line(", scale %.6g", e.truth_from_estimate.scale);
  text += line("\n\n%-26s %9s %9s %9s %9s\n", "", "rmse", "mean", "median", "max");
  text += error_row("position (ATE)", e.position, "m");
  text += error_row("rotation", in_degrees(e.rotation), "deg");
  text += error_row("rotation, own offset", in_degrees(e.rotation_own_offset), "deg");
  for (const io::RelativeError& relative : e.relative) {
    const std::string step = "RPE " + name_of(relative.delta);
    text += error_row(step + ", translation", relative.translation, "m");
    text += error_row(step + ", rotation", in_degrees(relative.rotation), "deg");
  }
  for (const std::string& note : e.notes) text += "note: " + note + '\n';
  return text;
}

nlohmann::ordered_json evaluation_json(const io::Evaluation& e) {
  const auto q = e.truth_from_estimate.rotation.quaternion();
  const Vec3<double>& t = e.truth_from_estimate.translation;
  nlohmann::ordered_json json;
  json["poses"] = e.poses;
  json["pairs"] = e.pairs;
  json["frames"] = nullptr;
  json["share_tracked"] = nullptr;
  if (e.frames > 0) {
    json["frames"] = e.frames;
    json["share_tracked"] = static_cast<double>(e.tracked) / static_cast<double>(e.frames);
  }
  json["max_difference"] = e.options.max_difference;
  json["alignment"] = {{"type", name(e.options.alignment)},
                       {"scale", e.truth_from_estimate.scale},
                       {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}},
                       {"translation_m", {t.x(), t.y(), t.z()}}};
  json["path_m"] = e.truth_path;
  json["estimate_path_m"] = e.estimate_path;
  json["ate_m"] = statistics_json(e.position);
  json["rotation_deg"] = statistics_json(in_degrees(e.rotation));
  json["rotation_own_offset_deg"] = statistics_json(in_degrees(e.rotation_own_offset));
  json["rpe"] = nlohmann::ordered_json::array();
  for (const io::RelativeError& relative : e.relative) {
    json["rpe"].push_back({{"delta", relative.delta.value},
                           {"unit", relative.delta.unit == io::DeltaUnit::kSeconds ? "s" : "frames"},
                           {"translation_m", statistics_json(relative.translation)},
                           {"rotation_deg", statistics_json(in_degrees(relative.rotation))}});
  }
  json["notes"] = e.notes;
  return json;
}

void write_json(const std::string& path, const nlohmann::ordered_json& json) {
  io::write_text(path, json_text(json, 2) + '\n');
}

}  // namespace sslam::cli
