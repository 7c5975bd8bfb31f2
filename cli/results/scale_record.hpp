// SPDX-License-Identifier: BSD-3-Clause
// What a run says about the unit of its map, for the terminal, its files and metrics.json.
#pragma once

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace sslam::cli {

struct ScaleRecord {
  std::string method = "none";  // none, depth, height, known; map: that of the map which the run went on in
  bool metric = false;          // the run's lengths are metres
  double factor = 1;            // metres for one unit of the map as it was tracked
  double spread = std::numeric_limits<double>::quiet_NaN();  // share of it that the samples differ by; NaN:
                                                             // a single one
  int samples = 0;      // keyframes that the factor was taken from; known: the two frames
  int landmarks = 0;    // of them all, or of the floor
  std::string problem;  // why there is no factor, where one was asked for
};

// A comment for files that hold lengths; empty where these are in the map's own unit.
[[nodiscard]] inline std::string unit_comment(const ScaleRecord& scale) {
  return scale.metric ? "unit: metres (scale: " + scale.method + ")" : std::string();
}

// "0.4213 m a unit, from depth, 18 keyframes, spread 1.2 %"
[[nodiscard]] inline std::string scale_text(const ScaleRecord& scale) {
  char text[160];
  std::snprintf(text, sizeof text, "metres, from %s: %.6g m for a unit of the map", scale.method.c_str(),
                scale.factor);
  std::string line = text;
  if (scale.samples > 0 && std::isfinite(scale.spread)) {
    std::snprintf(text, sizeof text, "; %d keyframes, %d landmarks, spread %.1f %%", scale.samples,
                  scale.landmarks, 100 * scale.spread);
    line += text;
  }
  return line;
}

[[nodiscard]] inline nlohmann::ordered_json scale_json(const ScaleRecord& scale) {
  nlohmann::ordered_json json = {
      {"method", scale.method},      {"metric", scale.metric}, {"unit", scale.metric ? "m" : "map units"},
      {"factor", scale.factor},      {"spread", nullptr},      {"keyframes", scale.samples},
      {"landmarks", scale.landmarks}};
  if (std::isfinite(scale.spread)) json["spread"] = scale.spread;
  if (!scale.problem.empty()) json["problem"] = scale.problem;
  return json;
}

// Of the run whose metrics.json this is; older runs did not write it.
[[nodiscard]] inline bool is_metric(const nlohmann::ordered_json& metrics) {
  const auto scale = metrics.find("scale");
  return scale != metrics.end() && scale->is_object() && scale->contains("metric") &&
         (*scale)["metric"] == true;
}

}  // namespace sslam::cli
