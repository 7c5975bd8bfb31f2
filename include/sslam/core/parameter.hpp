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
// range in the unit, both ends allowed. Options within options follow with visit_within. The command line,
// the files and the documentation are fed from here.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>

namespace sslam {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();  // as an end of a range

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

// Puts a prefix before the names of what is visited.
template <class Visit>
class PrefixedVisit {
 public:
  PrefixedVisit(std::string prefix, Visit& visit) : prefix_(std::move(prefix)), visit_(visit) {}

  template <class T>
  void operator()(const char* name, T& value, Unit unit, double least, double most,
                  const char* meaning) const {
    visit_((prefix_ + name).c_str(), value, unit, least, most, meaning);
  }

  // The same visit, deeper.
  [[nodiscard]] PrefixedVisit within(const char* prefix) const { return {prefix_ + prefix, visit_}; }

 private:
  std::string prefix_;
  Visit& visit_;
};

namespace detail {

template <class T>
inline constexpr bool kIsPrefixed = false;
template <class Visit>
inline constexpr bool kIsPrefixed<PrefixedVisit<Visit>> = true;

}  // namespace detail

// The members of options that are part of others, "match." before their names.
template <class Options, class Visit>
void visit_within(const char* prefix, Options& options, Visit&& visit) {
  if constexpr (detail::kIsPrefixed<std::remove_cvref_t<Visit>>)
    std::remove_const_t<Options>::parameters(options, visit.within(prefix));
  else
    std::remove_const_t<Options>::parameters(options, PrefixedVisit(prefix, visit));
}

// The parameters of a stage: those that it lists itself, or those of its `options`. A stage that has neither
// has no parameters.
template <class Stage, class Visit>
void visit_stage(const char* prefix, Stage& stage, Visit&& visit) {
  if constexpr (Described<std::remove_const_t<Stage>>)
    visit_within(prefix, stage, visit);
  else if constexpr (requires { stage.options; })
    if constexpr (Described<std::remove_cvref_t<decltype(stage.options)>>)
      visit_within(prefix, stage.options, visit);
}

}  // namespace sslam
