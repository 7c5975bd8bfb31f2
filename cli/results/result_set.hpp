// SPDX-License-Identifier: BSD-3-Clause
// The files of a result as one: written beside those of an older result, in a folder of their own, and
// brought to their names together. Who is killed on the way leaves the old files; or the new ones whole,
// which the next one to look at the folder then brings to their names.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace sslam::cli {

class ResultSet {
 public:
  // Makes the folder where it has gone in the meantime. Throws Error when it cannot be written to.
  explicit ResultSet(std::filesystem::path folder);
  // Without commit(), nothing has changed.
  ~ResultSet();
  ResultSet(const ResultSet&) = delete;
  ResultSet& operator=(const ResultSet&) = delete;

  // Where to write the files. Folders there take the place of those of the same name, with all that is in
  // them.
  [[nodiscard]] const std::filesystem::path& stage() const noexcept { return stage_; }

  // Of the parts that an older result may have, by their names, those go that this one has not written.
  // Signals wait meanwhile. Throws Error.
  void commit(std::span<const char* const> older = {});

 private:
  std::filesystem::path folder_, stage_;
};

// Brings the files to their names that somebody who was killed has left whole. Does nothing while another
// process is writing there. Throws Error.
void settle_results(const std::filesystem::path& folder);

// The checksum of each file in a folder, by its name.
[[nodiscard]] nlohmann::ordered_json checksums_of(const std::filesystem::path& folder);

// A line for each file in the folder that is another than the one in such a list.
[[nodiscard]] std::vector<std::string> foreign_files(const std::filesystem::path& folder,
                                                     const nlohmann::ordered_json& checksums);

}  // namespace sslam::cli
