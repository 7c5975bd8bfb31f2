// SPDX-License-Identifier: BSD-3-Clause
// Arrays of numbers for the page: {"type": "f32", "base64": ...}, which data.js unpacks.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "cli/report/base64.hpp"
#include "sslam/core/types.hpp"
#include "sslam/io/maps/byte_archive.hpp"

namespace sslam::cli {

inline void append(std::vector<double>& values, const Vec3<double>& v) {
  values.insert(values.end(), {v.x(), v.y(), v.z()});
}

// type: the name that data.js has for arrays of Target.
template <class Target, class Number>
[[nodiscard]] nlohmann::ordered_json packed(const char* type, std::span<const Number> values) {
  io::ByteWriter out;
  for (const Number value : values) out(static_cast<Target>(value));
  return {{"type", type}, {"base64", base64(out.bytes)}};
}

template <class Target>
[[nodiscard]] nlohmann::ordered_json packed(const char* type, std::span<const double> values) {
  return packed<Target, double>(type, values);
}

[[nodiscard]] inline nlohmann::ordered_json floats(std::span<const double> values) {
  return packed<float>("f32", values);
}

}  // namespace sslam::cli
