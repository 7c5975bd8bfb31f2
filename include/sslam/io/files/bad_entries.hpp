// SPDX-License-Identifier: BSD-3-Clause
// The policy for lists with flaws: a few bad entries are skipped with a warning each, many are an error.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sslam/core/error.hpp"

namespace sslam::io {

using Warnings = std::vector<std::string>;

class BadEntries {
 public:
  // Above this share of a list the file is not flawed but wrong.
  static constexpr double kTolerated = 0.1;

  explicit BadEntries(const std::filesystem::path& source) : source_(source.string()) {}

  void add(int line, const std::string& what) { add("line " + std::to_string(line) + ": " + what); }
  void add(const std::string& what) { found_.push_back(source_ + ": " + what); }

  // Call once, when all entries have been seen. One bad entry is always tolerated if others are good.
  void settle(std::size_t total, Warnings& warnings) const {
    if (found_.empty()) return;
    const std::size_t limit =
        std::max<std::size_t>(1, static_cast<std::size_t>(kTolerated * static_cast<double>(total)));
    if (found_.size() > limit || found_.size() >= total) {
      std::string text = found_.front();
      if (found_.size() > 1) {
        text += " (and " + std::to_string(found_.size() - 1) + " more bad entries of " +
                std::to_string(total) + ")";
      }
      throw Error(text);
    }
    for (const std::string& text : found_) warnings.push_back(text + ": skipped");
  }

 private:
  std::string source_;
  std::vector<std::string> found_;
};

}  // namespace sslam::io
