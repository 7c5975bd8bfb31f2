// SPDX-License-Identifier: BSD-3-Clause
// What a user may know and change about an option: each options struct lists its members with unit, range and
// meaning, in a static function beside them:
//
//   struct KeyframeOptions {
//     S max_turn = radians(S(12));
//     template <class Self, class Visit>
//     static void parameters(Self& self, Visit&& visit) {
//       visit("max_turn", self.max_turn, Unit::kDegrees, 1, 180, "rotation against the reference keyframe");
//     }
//   };
//
// `Self` is the struct or its const; `visit` is called as visit(name, value, unit, least, most, meaning), the
// range in the unit, both ends allowed. The command line, the files and the documentation are fed from here.
#pragma once

#include <concepts>
#include <cstdint>
#include <numbers>

namespace sslam {

enum class Unit : std::uint8_t {
  kNumber,   // a ratio or a factor
  kShare,    // 0 to 1
  kCount,    // a whole number
  kPixels,   // of the image as it is tracked
  kDegrees,  // outside; radians inside
  kSeconds,
};

[[nodiscard]] constexpr const char* name(Unit unit) noexcept {
  switch (unit) {
    case Unit::kNumber:
      return "";
    case Unit::kShare:
      return "share";
    case Unit::kCount:
      return "count";
    case Unit::kPixels:
      return "pixels";
    case Unit::kDegrees:
      return "degrees";
    case Unit::kSeconds:
      return "seconds";
  }
  return "";
}

// What one unit is inside the library.
[[nodiscard]] constexpr double inside_unit(Unit unit) noexcept {
  return unit == Unit::kDegrees ? std::numbers::pi / 180 : 1;
}

namespace detail {

struct AnyVisit {
  template <class T>
  void operator()(const char*, T&, Unit, double, double, const char*) const {}
};

}  // namespace detail

// An options struct that lists its members.
template <class T>
concept Described = requires(T& options) {
  T::parameters(options, detail::AnyVisit{});
};

}  // namespace sslam
