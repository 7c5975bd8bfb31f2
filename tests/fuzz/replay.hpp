// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets in the ordinary suite: what a fuzzer once found, and seeded spoilings of that and of sound
// input. Nothing guides them; to search, there is tests/fuzz/run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sslam::fuzzing {

using Target = int (*)(const std::uint8_t* data, std::size_t size);
using Mutator = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);

// A little of the bytes becomes something else: as libFuzzer's function of the same meaning, with a seed.
std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);

// Each input as it is, then spoilt `times` in all. A target ends the process where it is not content; the
// number of the input is told then. The environment's SSLAM_FUZZ_TIMES multiplies `times`.
void replay(Target target, const std::vector<std::string>& inputs, int times, Mutator mutator = mutate);

// Input of a fuzzer of kernels: which scene, and how it is spoilt.
[[nodiscard]] std::vector<std::string> random_bytes(int count, std::size_t longest);

}  // namespace sslam::fuzzing
