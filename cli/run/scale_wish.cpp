// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/scale_wish.hpp"

#include <cmath>

#include "cli/shell/exit_code.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

constexpr const char* kExpected =
    "expected none, depth, height=METRES, known=METRES or known=METRES@FRAME:FRAME";

double parse_metres(const std::string& text, const std::string& whole) {
  const auto value = io::parse_number<double>(text);
  if (!value || !std::isfinite(*value) || !(*value > 0))
    throw UsageError("--scale " + whole + ": '" + text + "' is no length in metres above 0; " + kExpected);
  return *value;
}

// "120:480"
void parse_frames(const std::string& text, const std::string& whole, ScaleWish& wish) {
  const auto colon = text.find(':');
  if (colon != std::string::npos) {
    wish.first = io::parse_number<std::int64_t>(text.substr(0, colon));
    wish.second = io::parse_number<std::int64_t>(text.substr(colon + 1));
  }
  if (!wish.first || !wish.second || *wish.first < 0 || *wish.second < 0 || wish.first == wish.second)
    throw UsageError("--scale " + whole + ": '" + text + "' are no two frames such as 120:480; " + kExpected);
}

}  // namespace

ScaleWish parse_scale(const std::string& text) {
  ScaleWish wish;
  if (text == "none") return wish;
  if (text == "depth") {
    wish.method = ScaleMethod::kDepth;
    return wish;
  }
  const auto equals = text.find('=');
  std::string name = text.substr(0, equals);
  if (name == "baseline") name = "known";  // of two frames: the same
  if (equals == std::string::npos || (name != "height" && name != "known"))
    throw UsageError("--scale " + text + ": " + kExpected);
  std::string value = text.substr(equals + 1);
  wish.method = name == "height" ? ScaleMethod::kHeight : ScaleMethod::kKnown;
  if (const auto at = value.find('@'); at != std::string::npos && wish.method == ScaleMethod::kKnown) {
    parse_frames(value.substr(at + 1), text, wish);
    value.resize(at);
  }
  wish.metres = parse_metres(value, text);
  return wish;
}

}  // namespace sslam::cli
