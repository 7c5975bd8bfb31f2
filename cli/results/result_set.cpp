// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/result_set.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/results/folder_lock.hpp"
#include "cli/shell/interrupt.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/maps/checksum.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStage = ".sslam-new";    // files that are being written
constexpr const char* kReady = ".sslam-ready";  // all of them, on the way to their names
constexpr const char* kObsolete = ".obsolete";  // among them: names of files that go, one a line

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw Error(path.string() + ": cannot write: " + what);
}

// What a set is made of: files, and folders of images.
std::vector<fs::path> parts_in(const fs::path& folder) {
  std::vector<fs::path> parts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != kObsolete) parts.push_back(entry.path());
  std::sort(parts.begin(), parts.end());
  return parts;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

// The same again does no harm: it may have been cut short.
void bring_to_names(const fs::path& folder) {
  const fs::path ready = folder / kReady;
  if (!fs::is_directory(fs::symlink_status(ready))) return;
  if (fs::exists(ready / kObsolete)) {
    const std::string text = io::read_text(ready / kObsolete);
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      if (const std::string name = text.substr(at, end - at); is_plain_name(name))
        fs::remove_all(folder / name);
      at = end + 1;
    }
  }
  for (const fs::path& part : parts_in(ready)) {
    const fs::path place = folder / part.filename();
    if (fs::is_directory(part)) fs::remove_all(place);  // a name is not taken from a folder that holds files
    fs::rename(part, place);
  }
  fs::remove_all(ready);
}

std::string checksum_text(const fs::path& file) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx",
                static_cast<unsigned long long>(
                    io::checksum(io::read_text(file, std::numeric_limits<std::size_t>::max()))));
  return text;
}

}  // namespace

ResultSet::ResultSet(fs::path folder) : folder_(std::move(folder)), stage_(folder_ / kStage) {
  try {
    fs::create_directories(folder_);
    bring_to_names(folder_);
    fs::remove_all(stage_);
    fs::create_directory(stage_);
  } catch (const fs::filesystem_error& error) {
    fail(folder_, error.code().message());
  }
}

ResultSet::~ResultSet() {
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
}

void ResultSet::commit(std::span<const char* const> older) {
  try {
    std::string obsolete;
    for (const char* const name : older)
      if (!fs::exists(stage_ / name)) obsolete += std::string(name) + '\n';
    for (const fs::path& part : parts_in(stage_))
      if (!fs::is_directory(part) && fs::is_directory(folder_ / part.filename()))
        fail(folder_ / part.filename(), "is a folder");
    io::write_text(stage_ / kObsolete, obsolete);
    const HeldSignals held;
    fs::rename(stage_, folder_ / kReady);  // from here on it is the new set
    bring_to_names(folder_);
  } catch (const fs::filesystem_error& error) {
    fail(folder_, error.code().message());
  }
}

void settle_results(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder / kReady, ignored)) return;
  const auto lock = FolderLock::take(folder);
  if (!lock) return;
  try {
    bring_to_names(folder);
  } catch (const fs::filesystem_error& error) {
    throw Error(folder.string() +
                ": holds the results of two runs, which cannot be told apart without writing (" +
                error.code().message() + ")");
  }
}

nlohmann::ordered_json checksums_of(const fs::path& folder) {
  nlohmann::ordered_json checksums = nlohmann::ordered_json::object();
  for (const fs::path& part : parts_in(folder))
    if (fs::is_regular_file(part)) checksums[part.filename().string()] = checksum_text(part);
  return checksums;
}

std::vector<std::string> foreign_files(const fs::path& folder, const nlohmann::ordered_json& checksums) {
  std::vector<std::string> lines;
  if (!checksums.is_object()) return lines;
  std::error_code ignored;
  for (const auto& [name, checksum] : checksums.items()) {
    const fs::path file = folder / name;
    if (!is_plain_name(name) || !fs::is_regular_file(file, ignored)) continue;
    if (checksum != checksum_text(file))
      lines.push_back(
          file.string() +
          ": is not the file that belongs to metrics.json beside it: of another run, or changed since");
  }
  return lines;
}

}  // namespace sslam::cli
