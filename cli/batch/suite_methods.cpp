// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/suite_methods.hpp"

#include <utility>

#include "cli/batch/suite_options.hpp"
#include "cli/batch/suite_table.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

// One way to fill in a part of a method; the label tells it from the others, and is empty where there is no
// choice.
template <class Value>
struct Choice {
  std::string label;
  Value value;
};

std::vector<Choice<std::string>> choices_of(const std::vector<std::string>& values) {
  std::vector<Choice<std::string>> choices;
  for (const std::string& value : values) choices.push_back({values.size() > 1 ? value : "", value});
  if (choices.empty()) choices.emplace_back();
  return choices;
}

// For the name of a method; empty: a flag that is off.
std::string label_of(const SuiteOption& option) {
  if (!option.flag) return option.key + "=" + option.value;
  return option.value == "true" ? option.key : "";
}

// Every method with every choice; put(method, value) fills it in.
template <class Value, class Put>
void multiply(std::vector<SuiteMethod>& methods, const std::vector<Choice<Value>>& choices, Put put) {
  std::vector<SuiteMethod> all;
  for (const SuiteMethod& method : methods) {
    for (const Choice<Value>& choice : choices) {
      SuiteMethod next = method;
      if (!choice.label.empty()) io::add_to_list(next.name, choice.label);
      put(next, choice.value);
      all.push_back(std::move(next));
    }
  }
  methods = std::move(all);
}

// A table of parameters. `keyframes.min_gap = 5` without quotes is a table in a table to TOML: `stage` is the
// outer one's key with a point, empty outside.
void multiply_parameters(const toml::table& set, const std::string& file, const std::string& stage,
                         std::vector<SuiteMethod>& methods) {
  SuiteTable table(set, file, "set");
  for (const auto& [key, value] : set) {
    const std::string name = stage + std::string(key.str());
    if (stage.empty() && value.is_table()) {
      multiply_parameters(*value.as_table(), file, name + ".", methods);
      continue;
    }
    std::vector<std::string> texts;
    for (const double number : table.numbers(key.str())) texts.push_back(name + "=" + plain_number(number));
    multiply(methods, choices_of(texts),
             [](SuiteMethod& method, const std::string& text) { method.set.push_back(text); });
  }
}

void multiply_options(const std::vector<SuiteOption>& values, std::vector<SuiteMethod>& methods) {
  std::vector<Choice<SuiteOption>> choices;
  for (const SuiteOption& option : values)
    choices.push_back({values.size() > 1 ? label_of(option) : "", option});
  if (choices.empty()) return;
  multiply(methods, choices,
           [](SuiteMethod& method, const SuiteOption& option) { method.options.push_back(option); });
}

}  // namespace

MethodDefaults read_defaults(SuiteTable& table, const MethodDefaults& otherwise) {
  MethodDefaults read = otherwise;
  read.repeats = static_cast<int>(table.whole_number("repeats", otherwise.repeats, 1));
  const auto seeds = table.whole_numbers("seeds", 0);
  if (!seeds.empty()) read.seeds.assign(seeds.begin(), seeds.end());
  for (auto seed = read.seeds.begin(); seed != read.seeds.end(); ++seed)
    if (std::find(read.seeds.begin(), seed, *seed) != seed)
      table.fail("seeds", std::to_string(*seed) + " appears twice");
  return read;
}

void read_methods(SuiteTable& table, const MethodDefaults& defaults, std::vector<SuiteMethod>& methods) {
  SuiteMethod base;
  base.line = table.line();
  base.preset_line = table.line_of("preset");
  base.normals_line = table.line_of("normals");
  base.set_line = table.line_of("set");
  const auto name = table.text("name");
  base.name = name.value_or("");
  const MethodDefaults own = read_defaults(table, defaults);
  base.seeds = own.seeds;
  base.repeats = own.repeats;
  std::vector<SuiteMethod> all{base};
  multiply(all, choices_of(table.texts("preset")), [](SuiteMethod& method, const std::string& preset) {
    if (!preset.empty()) method.preset = preset;
  });
  multiply(all, choices_of(table.texts("normals")),
           [](SuiteMethod& method, const std::string& normals) { method.normals = normals; });
  if (const toml::node* const set = table.find("set")) {
    if (!set->is_table()) table.fail("set", "expected a table such as {keyframes.min_gap = 5}");
    multiply_parameters(*set->as_table(), table.file(), "", all);
  }
  for (const std::string_view key : kMethodOptions) multiply_options(read_options(table, key), all);
  for (SuiteMethod& method : all) {
    if (name) continue;
    method.name = method.preset;
    if (!method.normals.empty()) method.name += ", " + method.normals;
    for (const std::string& text : method.set) method.name += ", " + text;
    for (const SuiteOption& option : method.options)
      if (const std::string label = label_of(option); !label.empty()) method.name += ", " + label;
  }
  methods.insert(methods.end(), all.begin(), all.end());
}

std::vector<SuiteMethod> default_methods(const MethodDefaults& defaults) {
  SuiteMethod method;
  method.name = method.preset;
  method.seeds = defaults.seeds;
  method.repeats = defaults.repeats;
  return {method};
}

}  // namespace sslam::cli
