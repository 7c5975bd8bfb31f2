// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/replay.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

namespace sslam::fuzzing {
namespace {

// Of the seed that the mutator in hand was given: libFuzzer's own function takes none.
Random& inner_random() {
  static Random random(1);
  return random;
}

std::uint8_t any_byte(Random& random) {
  // What readers look for: signs, digits, brackets, ends of lines, limits.
  static constexpr char kLetters[] = "\0\x01\x7f\x80\xff\n\r\t .,:;-+=eE019#%\"'[]{}<>/\\&";
  static constexpr std::string_view kTelling(kLetters, sizeof kLetters - 1);
  return static_cast<std::uint8_t>(random.below(2) == 0 ? kTelling[random.below(kTelling.size())]
                                                        : static_cast<char>(random.below(256)));
}

std::size_t change_once(std::uint8_t* data, std::size_t size, std::size_t most, Random& random) {
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(n)));
  };
  const std::size_t at = size > 0 ? below(size) : 0;
  const std::size_t length = 1 + below(std::min<std::size_t>(std::max<std::size_t>(size - at, 1), 16));
  switch (random.below(5)) {
    case 0:  // taken out
      if (size == 0) return size;
      std::copy(data + at + length, data + size, data + at);
      return size - length;
    case 1: {  // twice
      if (size == 0 || size + length > most) return size;
      std::copy_backward(data + at, data + size, data + size + length);
      return size + length;
    }
    case 2: {  // put in
      if (size + 1 > most) return size;
      std::copy_backward(data + at, data + size, data + size + 1);
      data[at] = any_byte(random);
      return size + 1;
    }
    case 3:  // a bit
      if (size > 0) data[at] = static_cast<std::uint8_t>(data[at] ^ (1U << random.below(8)));
      return size;
    default:
      if (size > 0) data[at] = any_byte(random);
      return size;
  }
}

std::size_t change(std::uint8_t* data, std::size_t size, std::size_t most, Random& random) {
  const std::uint32_t times = 1 + random.below(4);
  for (std::uint32_t i = 0; i < times; ++i) size = change_once(data, size, most, random);
  return size;
}

void call(Target target, std::string_view input) {
  target(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

}  // namespace

std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  Random random(seed);
  return change(data, size, most, random);
}

void replay(Target target, const std::vector<std::string>& inputs, int times, Mutator mutator) {
  if (const char* const more = std::getenv("SSLAM_FUZZ_TIMES")) times *= std::max(1, std::atoi(more));
  REQUIRE_FALSE(inputs.empty());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    INFO("input " << i);
    call(target, inputs[i]);
  }
  for (int i = 0; i < times; ++i) {
    INFO("spoilt input " << i);
    std::string input = inputs[static_cast<std::size_t>(i) % inputs.size()];
    const std::size_t size = input.size(), room = size + 256;
    input.resize(room);
    const auto seed = static_cast<unsigned>(i);
    inner_random() = Random(seed);
    input.resize(mutator(reinterpret_cast<std::uint8_t*>(input.data()), size, room, seed));
    call(target, input);
  }
  SUCCEED("nothing was found");
}

std::vector<std::string> random_bytes(int count, std::size_t longest) {
  Random random(1);
  std::vector<std::string> inputs;
  for (int i = 0; i < count; ++i) {
    std::string input(1 + random.below(static_cast<std::uint32_t>(longest)), '\0');
    for (char& byte : input) byte = static_cast<char>(random.below(256));
    inputs.push_back(input);
  }
  return inputs;
}

}  // namespace sslam::fuzzing

// What libFuzzer gives to mutators of our own.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most) {
  return sslam::fuzzing::change(data, size, most, sslam::fuzzing::inner_random());
}
