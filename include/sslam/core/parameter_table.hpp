// SPDX-License-Identifier: BSD-3-Clause
// The parameters of a system by name: what they are, and what a user wants them to be. The table collects
// them from options that list their members, checks new values, and writes those back into the options.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sslam/core/closest_word.hpp"
#include "sslam/core/parameter.hpp"

namespace sslam {

// Values and range are in the unit.
struct Parameter {
  std::string name;
  Unit unit = Unit::kNumber;
  double initial = 0;  // what the options had when they were collected
  double value = 0;
  double least = 0, most = 0;
  bool whole = false;    // takes whole numbers alone
  bool changed = false;  // set by the user
  std::string meaning;
};

// Two parameters of which one must stay below the other, and what would happen without a word if it did not.
struct ParameterOrder {
  std::string_view low, high, otherwise;
};

enum class ParameterFault : std::uint8_t { kFine, kUnknown, kNotFinite, kNotWhole, kOutOfRange, kDisordered };

struct ParameterAnswer {
  ParameterFault fault = ParameterFault::kFine;
  std::string message;  // of a fault: the parameter's name, and what is wrong

  [[nodiscard]] bool ok() const noexcept { return fault == ParameterFault::kFine; }
};

class ParameterTable {
 public:
  // every(visit) visits each parameter, see parameter.hpp. A name that is known already is not taken again.
  template <class Every>
  void collect(Every every) {
    Collector collector{*this};
    every(collector);
  }

  // Writes what was set into the options that `every` visits; all else stays as it is, to the bit.
  template <class Every>
  void write(Every every) const {
    Writer writer{*this};
    every(writer);
  }

  void add_order(const ParameterOrder& order) { orders_.push_back(order); }

  [[nodiscard]] const std::vector<Parameter>& entries() const noexcept { return entries_; }

  // Null where the name is not known.
  [[nodiscard]] const Parameter* find(std::string_view name) const noexcept {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [name](const Parameter& parameter) { return parameter.name == name; });
    return found == entries_.end() ? nullptr : &*found;
  }

  // In the parameter's unit. On a fault the table is left as it was.
  [[nodiscard]] ParameterAnswer set(std::string_view name, double value) {
    const Parameter* known = find(name);
    if (known == nullptr) return unknown(name);
    Parameter& parameter = entries_[static_cast<std::size_t>(known - entries_.data())];
    const std::string what = parameter.name + "=" + text(value) + ": ";
    if (!std::isfinite(value)) return {ParameterFault::kNotFinite, what + "not a finite number"};
    if (parameter.whole && value != std::floor(value))
      return {ParameterFault::kNotWhole, what + "not a whole number"};
    if (value < parameter.least || value > parameter.most)
      return {ParameterFault::kOutOfRange,
              what + "out of range: " + range(parameter) + in_unit(parameter.unit)};
    parameter.value = value;
    parameter.changed = true;
    return {};
  }

  // Whether the values fit together.
  [[nodiscard]] ParameterAnswer check() const {
    for (const ParameterOrder& order : orders_) {
      const Parameter *low = find(order.low), *high = find(order.high);
      if (low == nullptr || high == nullptr || low->value < high->value) continue;
      return {ParameterFault::kDisordered, low->name + ": " + text(low->value) + " is not below the " +
                                               text(high->value) + " of " + high->name + ": " +
                                               std::string(order.otherwise)};
    }
    return {};
  }

  // "0 to 1"; "at least 0" where there is no upper end.
  [[nodiscard]] static std::string range(const Parameter& parameter) {
    return std::isfinite(parameter.most) ? text(parameter.least) + " to " + text(parameter.most)
                                         : "at least " + text(parameter.least);
  }

  [[nodiscard]] static std::string text(double value) {
    char out[32];
    std::snprintf(out, sizeof out, "%g", value);
    return out;
  }

 private:
  struct Collector {
    ParameterTable& table;

    template <class T>
    void operator()(const char* name, T& value, Unit unit, double least, double most, const char* meaning) {
      using Value = std::remove_const_t<T>;
      if (table.find(name) != nullptr) return;
      const double inside = static_cast<double>(value) / inside_unit(unit);
      // The angle that was written, not what its way through radians has left of it.
      const double outside = unit == Unit::kDegrees ? std::round(inside * 1e6) / 1e6 : inside;
      constexpr bool kWhole = std::is_integral_v<Value>;
      if constexpr (kWhole) most = std::min(most, static_cast<double>(std::numeric_limits<Value>::max()));
      table.entries_.push_back({name, unit, outside, outside, least, most, kWhole, false, meaning});
    }
  };

  struct Writer {
    const ParameterTable& table;

    template <class T>
    void operator()(const char* name, T& value, Unit unit, double, double, const char*) const {
      const Parameter* parameter = table.find(name);
      if (parameter != nullptr && parameter->changed)
        value = static_cast<T>(parameter->value * inside_unit(unit));
    }
  };

  [[nodiscard]] static std::string in_unit(Unit unit) {
    return unit == Unit::kNumber ? "" : std::string(", in ") + name(unit);
  }

  [[nodiscard]] ParameterAnswer unknown(std::string_view name) const {
    std::vector<std::string> names;
    names.reserve(entries_.size());
    for (const Parameter& parameter : entries_) names.push_back(parameter.name);
    const std::string nearest = closest_word(name, names);
    return {ParameterFault::kUnknown, std::string(name) + ": no such parameter here" +
                                          (nearest.empty() ? "" : "; did you mean " + nearest + "?")};
  }

  std::vector<Parameter> entries_;
  std::vector<ParameterOrder> orders_;
};

}  // namespace sslam
