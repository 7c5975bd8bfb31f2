// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/suite.hpp"

#include <algorithm>
#include <utility>

#include "cli/batch/suite_methods.hpp"
#include "cli/batch/suite_options.hpp"
#include "cli/batch/suite_table.hpp"
#include "cli/shell/toml_text.hpp"
#include "sslam/io/datasets/known_cameras.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

class SuiteReader {
 public:
  explicit SuiteReader(const fs::path& file) : file_(file.string()), folder_(file.parent_path()) {}

  [[nodiscard]] Suite read() {
    const std::string text = read_toml_text(file_);
    toml::table root;
    try {
      root = toml::parse(text, file_);
    } catch (const toml::parse_error& error) {
      throw Error(at_line(file_, error.source().begin.line) + std::string(error.description()));
    }
    SuiteTable top(root, file_, "the suite");
    suite_.file = file_;
    suite_.name = top.text("name").value_or(fs::path(file_).stem().string());
    const auto out = top.text("out");
    suite_.out = out ? folder_ / *out : fs::path(fs::path(file_).stem().string() + "_results");
    suite_.min_tracked = top.number("min_tracked", suite_.min_tracked, 0, 1);
    suite_.report = top.flag("report", suite_.report);
    for (const std::string& earlier : top.texts("against")) suite_.against.push_back(folder_ / earlier);
    suite_.against_line = top.line_of("against");
    const MethodDefaults defaults = read_defaults(top, {});
    starts_ = read_starts(top);
    read_each(top, "sequence", [&](SuiteTable& table) { read_sequence(table); });
    read_each(top, "method", [&](SuiteTable& table) { read_methods(table, defaults, suite_.methods); });
    read_each(top, "reference", [&](SuiteTable& table) { read_reference(table); });
    top.refuse_others();
    if (suite_.sequences.empty())
      throw Error(file_ + ": names no sequence; expected at least one [[sequence]] with a path");
    if (suite_.methods.empty()) suite_.methods = default_methods(defaults);
    for (SuiteMethod& method : suite_.methods) method.normals = resolve_normals(method.normals);
    refuse_doubles();
    return std::move(suite_);
  }

 private:
  template <class Read>
  void read_each(SuiteTable& top, const std::string& key, Read read_one) {
    const toml::node* const node = top.find(key);
    if (node == nullptr) return;
    const toml::array* const list = node->as_array();
    const std::string heading = "[[" + key + "]]";
    if (list == nullptr || !list->is_array_of_tables())
      top.fail(key, "expected a table with two brackets, " + heading);
    for (const toml::node& element : *list) {
      SuiteTable table(*element.as_table(), file_, heading);
      read_one(table);
      table.refuse_others();
    }
  }

  void read_sequence(SuiteTable& table) {
    SuiteSequence sequence;
    sequence.line = table.line_of("path");
    const std::string path = table.required_text("path", "a dataset, a glob of images, a video or a bag");
    sequence.dataset = resolve(path);
    sequence.name = table.text("name").value_or(fs::path(path).filename().string());
    for (const std::string_view key : kSequenceOptions) {
      const std::vector<SuiteOption> values = read_options(table, key);
      if (values.size() > 1) table.fail(key, "expected one value");
      for (const SuiteOption& option : values) sequence.options.push_back(resolve(option));
    }
    if (const auto truth = table.text("truth")) sequence.truth = resolve(*truth);
    sequence.starts = read_starts(table);
    const bool has_start = std::any_of(sequence.options.begin(), sequence.options.end(),
                                       [](const SuiteOption& option) { return option.key == "start"; });
    if (has_start && !sequence.starts.empty())
      table.fail("starts", "there is a start as well; leave one out");
    if (!has_start && sequence.starts.empty()) sequence.starts = starts_;
    suite_.sequences.push_back(std::move(sequence));
  }

  [[nodiscard]] static std::vector<std::int64_t> read_starts(SuiteTable& table) {
    std::vector<std::int64_t> starts = table.whole_numbers("starts", 0);
    std::sort(starts.begin(), starts.end());
    if (const auto twice = std::adjacent_find(starts.begin(), starts.end()); twice != starts.end())
      table.fail("starts", std::to_string(*twice) + " appears twice");
    return starts;
  }

  void read_reference(SuiteTable& table) {
    SuiteReference reference;
    reference.line = table.line();
    reference.name = table.required_text("name", "what the column is called");
    reference.min_tracked = table.number("min_tracked", suite_.min_tracked, 0, 1);
    const toml::node* const node = table.find("trajectories");
    if (node == nullptr || !node->is_table())
      table.fail("trajectories", "expected SEQUENCE = \"FILE\" or a list of files, one for each run");
    SuiteTable files(*node->as_table(), file_, "trajectories of [[reference]]");
    for (const SuiteSequence& sequence : suite_.sequences) {
      for (const std::string& path : files.texts(sequence.name)) {
        std::error_code ignored;
        if (!fs::is_regular_file(resolve(path), ignored))
          files.fail(sequence.name, resolve(path) + ": no such file; expected a trajectory in TUM format");
        reference.trajectories[sequence.name].push_back(resolve(path));
      }
    }
    files.refuse_others();
    suite_.references.push_back(std::move(reference));
  }

  [[nodiscard]] std::string resolve(const std::string& path) const {
    return fs::absolute(folder_ / path).lexically_normal().string();
  }

  // Files that options name are relative to the suite as well.
  [[nodiscard]] SuiteOption resolve(SuiteOption option) const {
    std::error_code ignored;
    const bool built_in = option.key == "camera" && io::find_known_camera(option.value) &&
                          !fs::exists(resolve(option.value), ignored);
    if (option.key == "mask" || (option.key == "camera" && !built_in)) option.value = resolve(option.value);
    return option;
  }

  // The file behind "files:" or "onnx:" is relative to the suite as well.
  [[nodiscard]] std::string resolve_normals(const std::string& normals) const {
    for (const char* prefix : {"files:", "onnx:", "on-demand:files:", "on-demand:onnx:"})
      if (normals.starts_with(prefix)) return prefix + resolve(normals.substr(std::string(prefix).size()));
    return normals;
  }

  // Two of one name could not be told apart in the table, or would share a folder.
  void refuse_doubles() const {
    const auto check = [this](const auto& list, const std::string& what) {
      for (auto second = list.begin(); second != list.end(); ++second)
        for (auto first = list.begin(); first != second; ++first)
          if (io::lower_case(folder_name(first->name)) == io::lower_case(folder_name(second->name)))
            throw Error(at_line(file_, second->line) + "name in " + what + ": '" + second->name +
                        "' is already used in line " + std::to_string(first->line) +
                        "; give each a different name");
    };
    check(suite_.sequences, "[[sequence]]");
    check(suite_.methods, "[[method]]");
    check(suite_.references, "[[reference]]");
  }

  std::string file_;
  fs::path folder_;
  std::vector<std::int64_t> starts_;  // of sequences that name none
  Suite suite_;
};

}  // namespace

Suite read_suite(const fs::path& file) {
  return SuiteReader(file).read();
}

std::string folder_name(const std::string& name) {
  std::string folder;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '.' || c == '_' || c == '=' || c == '-';
    if (plain) folder += c;
    if (!plain && !folder.empty() && folder.back() != '-') folder += '-';
  }
  while (!folder.empty() && (folder.back() == '-' || folder.back() == '.')) folder.pop_back();
  folder.erase(0, folder.find_first_not_of('.'));
  return folder.empty() ? "unnamed" : folder;
}

}  // namespace sslam::cli
