// SPDX-License-Identifier: BSD-3-Clause
// A message of ROS 2 as bytes: plain CDR, little-endian (XTypes 1.3, 7.4.3), the other way of MessageFields.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "sslam/core/error.hpp"
#include "sslam/core/types.hpp"
#include "sslam/geometry/se3.hpp"

namespace sslam::io {

// Nanoseconds since 1970, or since whenever the recording counts. Throws Error for a time that no message can
// hold: before that, or after 2038.
[[nodiscard]] inline std::int64_t message_time(double seconds) {
  constexpr double kLast = 2147483647;
  if (!(seconds >= 0 && seconds <= kLast))
    throw Error("the stamp " + std::to_string(seconds) +
                " does not fit a ROS message: expected 0 to 2147483647 s");
  return static_cast<std::int64_t>(static_cast<long double>(seconds) * 1e9L + 0.5L);
}

class CdrWriter {
 public:
  // Without the four bytes in front, which say how the others are meant.
  [[nodiscard]] std::string message() const { return std::string("\0\1\0\0", 4) + bytes_; }

  template <class T>
  requires std::is_arithmetic_v<T> CdrWriter& number(T value) {
    static_assert(std::endian::native == std::endian::little);
    bytes_.append((sizeof(T) - bytes_.size() % sizeof(T)) % sizeof(T), '\0');
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }

  CdrWriter& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    bytes_ += text;
    bytes_ += '\0';
    return *this;
  }

  // The length in front of a list.
  CdrWriter& length(std::size_t count) { return number(static_cast<std::uint32_t>(count)); }

  CdrWriter& doubles(std::span<const double> values) {
    for (const double value : values) number(value);
    return *this;
  }

  CdrWriter& time(std::int64_t nanoseconds) {
    number(static_cast<std::int32_t>(nanoseconds / 1'000'000'000));
    return number(static_cast<std::uint32_t>(nanoseconds % 1'000'000'000));
  }

  // std_msgs/Header
  CdrWriter& header(std::int64_t stamp, std::string_view frame) { return time(stamp).text(frame); }

  // geometry_msgs/Point, Vector3
  CdrWriter& point(const Vec3<double>& p) { return number(p.x()).number(p.y()).number(p.z()); }

  // geometry_msgs/Pose, Transform
  CdrWriter& pose(const SE3<double>& a_from_b) {
    const auto q = a_from_b.rotation.quaternion();
    return point(a_from_b.translation).number(q.x()).number(q.y()).number(q.z()).number(q.w());
  }

  // std_msgs/ColorRGBA
  CdrWriter& colour(float red, float green, float blue, float alpha = 1) {
    return number(red).number(green).number(blue).number(alpha);
  }

  CdrWriter& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }

 private:
  std::string bytes_;
};

}  // namespace sslam::io
