// SPDX-License-Identifier: BSD-3-Clause
// Standard input or a named pipe, read without a wait that nobody can end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "cli/stream/patience.hpp"

namespace sslam::cli {

class BytePipe {
 public:
  // "-": standard input. A named pipe may have no writer yet. Throws Error when it cannot be read.
  BytePipe(const std::string& name, Patience& patience);
  ~BytePipe();
  BytePipe(const BytePipe&) = delete;
  BytePipe& operator=(const BytePipe&) = delete;

  // Waits for bytes; at most `size`. 0: the end, or patience is over.
  [[nodiscard]] std::size_t read(std::uint8_t* bytes, std::size_t size);

 private:
  Patience& patience_;
  int file_ = -1;
  bool own_ = false;
};

}  // namespace sslam::cli
