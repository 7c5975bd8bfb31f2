// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/calibration_record.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace sslam::cli {

std::string camera_text(const Camera<double>& camera) {
  char text[160];
  std::snprintf(text, sizeof text, "focal length %.1f pixels, centre (%.1f, %.1f), k1 %.4f, k2 %.4f",
                camera.pinhole.fx, camera.pinhole.cx, camera.pinhole.cy, camera.distortion.k1,
                camera.distortion.k2);
  return text;
}

nlohmann::ordered_json calibration_json(const CalibrationRecord& record) {
  static constexpr std::array kVerdicts{"open", "agrees", "differs"};
  const CameraFinding& found = record.last;
  nlohmann::ordered_json json = {{"map_says", kVerdicts[static_cast<std::size_t>(found.verdict)]},
                                 {"replaced", record.replaced}};
  if (!usable(found.estimate.status)) return json;
  const auto numbers = [](const Camera<double>& camera) {
    return nlohmann::ordered_json{{"fx", camera.pinhole.fx},    {"fy", camera.pinhole.fy},
                                  {"cx", camera.pinhole.cx},    {"cy", camera.pinhole.cy},
                                  {"k1", camera.distortion.k1}, {"k2", camera.distortion.k2}};
  };
  const LensChange<double> sigma = found.estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const double pixels = static_cast<double>(found.camera.width) / found.estimate.camera.width;
  json["given"] = numbers(record.given);
  json["found"] = numbers(found.camera);
  json["sigma"] = {{"fx", sigma[0] * found.camera.pinhole.fx},
                   {"fy", sigma[0] * found.camera.pinhole.fy},
                   {"cx", sigma[1] * pixels},
                   {"cy", sigma[2] * pixels},
                   {"k1", sigma[3]},
                   {"k2", sigma[4]}};
  return json;
}

}  // namespace sslam::cli
