// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/config_file.hpp"

#include "cli/shell/toml_parser.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/shell/option_info.hpp"
#include "cli/shell/toml_text.hpp"
#include "cli/shell/usage_text.hpp"
#include "sslam/core/closest_word.hpp"
#include "sslam/core/error.hpp"
#include "sslam/core/shortest_text.hpp"

namespace sslam::cli {
namespace {

enum class Wanted { kFlag, kWhole, kNumber, kText, kTextOrNumber };

// By what the help says of the option's value.
Wanted wanted_by(const CLI::Option& option) {
  const OptionInfo info = describe_option(option);
  if (info.kind == ValueKind::kNone) return Wanted::kFlag;
  if (info.value == "INT" || info.value == "UINT") return Wanted::kWhole;
  for (const char* number : {"FLOAT", "PIXELS", "DEGREES", "SECONDS"})
    if (info.value == number) return Wanted::kNumber;
  return info.value == "PORT" ? Wanted::kTextOrNumber : Wanted::kText;
}

const char* wanted_text(Wanted wanted) {
  switch (wanted) {
    case Wanted::kFlag:
      return "true or false";
    case Wanted::kWhole:
      return "a whole number";
    case Wanted::kNumber:
      return "a number";
    case Wanted::kText:
      return "text in quotes";
    case Wanted::kTextOrNumber:
      return "a number, or text in quotes";
  }
  return "";
}

// What stands in the file, for people.
std::string found_text(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return "the text \"" + *text + "\"";
  if (node.is_boolean()) return node.value_or(false) ? "true" : "false";
  if (const auto whole = node.value_exact<std::int64_t>()) return "the number " + std::to_string(*whole);
  if (node.is_floating_point()) return "the number " + shortest_text(node.value_or(0.0));
  if (node.is_array()) return "a list";
  return node.is_table() ? "a table" : "a date or a time";
}

class ConfigReader {
 public:
  ConfigReader(CLI::App& command, const std::string& file, std::map<std::string, std::string>* places)
      : command_(command), file_(file), places_(places) {}

  void apply() {
    const std::string text = read_toml_text(file_);
    try {
      const toml::table root = toml::parse(text, file_);
      for (const auto& [key, node] : root) apply_key(std::string(key.str()), key.source().begin.line, node);
    } catch (const toml::parse_error& error) {
      throw Error(at(error.source().begin.line) + "is not TOML: " + std::string(error.description()) +
                  "; expected lines such as normals = \"none\" or end = 40");
    }
  }

 private:
  template <class Line>
  [[nodiscard]] std::string at(Line line) const {
    return file_ + ": line " + std::to_string(line) + ": ";
  }

  [[noreturn]] void refuse(const std::string& key, const toml::node& node,
                           const std::string& expected) const {
    throw Error(at(node.source().begin.line) + key + " is " + found_text(node) + "; expected " + expected);
  }

  template <class Line>
  [[noreturn]] void refuse_unknown(const std::string& key, Line line, bool table) const {
    std::vector<std::string> known{"set"};
    for (const CLI::Option* each : command_.get_options())
      for (const std::string& name : each->get_lnames())
        if (name != "config" && name != "help" && name != "set") known.push_back(name);
    const std::string nearest = closest_word(key, known);
    throw Error(at(line) + "'" + key + "' is not an option of sslam " + command_.get_name() +
                (table ? "; the only table is [set], for parameters" : "") +
                (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }

  template <class Line>
  void apply_key(const std::string& key, Line line, const toml::node& node) {
    CLI::Option* const option = command_.get_option_no_throw("--" + key);
    const toml::table* const table = node.as_table();
    if (key == "set" && table == nullptr)
      refuse(key, node, "a table: [set] with rows such as keyframes.max_turn = 10");
    if (key == "set" && option != nullptr) return apply_parameters(*option, *table, {});
    if (key == "config") throw Error(at(line) + "config: a file of options cannot name another one");
    if (option == nullptr || key == "help") refuse_unknown(key, line, table != nullptr);
    const Wanted wanted = wanted_by(*option);
    const bool several = option->get_items_expected_max() > 1;
    std::vector<std::string> words;
    if (const toml::array* const list = node.as_array(); list != nullptr && several) {
      words.reserve(list->size());
      for (const toml::node& element : *list) words.push_back(word_of(key, element, wanted));
    } else {
      words.push_back(word_of(key, node, wanted));
    }
    if (option->count() > 0 || (wanted == Wanted::kFlag && words.front() == "false")) return;
    for (const std::string& word : words) option->add_result(word);
    try {
      option->run_callback();
    } catch (const CLI::Error& error) {
      std::string what = usage_text(error.what());
      if (const std::string name = "--" + key + ": "; what.starts_with(name)) what.erase(0, name.size());
      throw Error(at(node.source().begin.line) + key + ": " + what);
    }
  }

  // As on a command line.
  [[nodiscard]] std::string word_of(const std::string& key, const toml::node& node, Wanted wanted) const {
    const auto text = node.value_exact<std::string>();
    const auto whole = node.value_exact<std::int64_t>();
    const double number = node.is_number() ? node.value_or(0.0) : std::nan("");
    const bool takes_text = wanted == Wanted::kText || wanted == Wanted::kTextOrNumber;
    if (takes_text && text && text->empty())
      throw Error(at(node.source().begin.line) + key + " is empty; leave it out, or expected " +
                  wanted_text(wanted));
    if (takes_text && text) return *text;
    if (wanted == Wanted::kFlag && node.is_boolean()) return node.value_or(false) ? "true" : "false";
    if (whole && (wanted == Wanted::kWhole || wanted == Wanted::kNumber || wanted == Wanted::kTextOrNumber))
      return std::to_string(*whole);
    constexpr double kLargest = 1e15;  // whole to the last digit
    if (wanted == Wanted::kWhole && number == std::floor(number) && std::abs(number) < kLargest)
      return std::to_string(static_cast<std::int64_t>(number));
    if (wanted == Wanted::kNumber && node.is_number()) return shortest_text(number);
    refuse(key, node, wanted_text(wanted));
  }

  // Of two settings of one parameter the later holds, and the command line has been read already.
  void apply_parameters(CLI::Option& option, const toml::table& table, const std::string& stage) const {
    for (const auto& [key, node] : table) {
      const std::string name = stage + std::string(key.str());
      if (const toml::table* const inner = node.as_table()) {
        apply_parameters(option, *inner, name + ".");
        continue;
      }
      const auto whole = node.value_exact<std::int64_t>();
      if (!node.is_number()) refuse("set." + name, node, "a number");
      const std::string value = whole ? std::to_string(*whole) : shortest_text(node.value_or(0.0));
      const std::vector<std::string> given = option.results();
      option.clear();
      option.add_result(name + "=" + value);
      if (places_ != nullptr) (*places_)[name + "=" + value] = at(key.source().begin.line);
      option.add_result(given);
    }
  }

  CLI::App& command_;
  std::string file_;
  std::map<std::string, std::string>* places_;
};

}  // namespace

void add_config_option(CLI::App& command, std::map<std::string, std::string>* places) {
  command
      .add_option_function<std::string>(
          "--config",
          [&command, places](const std::string& file) { ConfigReader(command, file, places).apply(); },
          "TOML file of options; a table [set] for parameters")
      ->type_name("FILE");
}

}  // namespace sslam::cli
