// SPDX-License-Identifier: BSD-3-Clause
// A program started without a shell in between, and stopped with its parent, however that ends.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sslam::cli {

struct ChildEnd {
  int exit_code = 0;
  int signal = 0;  // that ended it; 0: none
};

class Child {
 public:
  // Runs this program anew; its output goes to `log`. Throws Error when it cannot be started.
  Child(const std::vector<std::string>& arguments, const std::filesystem::path& log);

  // Nothing while it runs.
  [[nodiscard]] std::optional<ChildEnd> poll();

  void send(int signal) const noexcept;

 private:
  pid_t pid_ = 0;
};

// For the child: ends this process as soon as the parent that started it as a Child ends.
void end_with_parent();

}  // namespace sslam::cli
