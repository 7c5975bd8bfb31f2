// SPDX-License-Identifier: BSD-3-Clause
// Sound input to begin a search with: a fuzzer that starts from nothing does not find the syntax of a format.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace sslam::fuzzing {

// The next input: a changed one, or, as long as there is nothing to change, one of the seeds.
inline std::size_t mutate_or_begin(const std::vector<std::string>& seeds, std::uint8_t* data,
                                   std::size_t size, std::size_t most, unsigned seed) {
  constexpr std::size_t kNothing = 2;
  if (size > kNothing) return LLVMFuzzerMutate(data, size, most);
  const std::string& chosen = seeds[seed % seeds.size()];
  const std::size_t kept = std::min(most, chosen.size());
  std::copy_n(chosen.begin(), kept, data);
  return kept;
}

}  // namespace sslam::fuzzing
