// SPDX-License-Identifier: BSD-3-Clause
// Every kernel on the inputs of one frame, in float and in double.
//   kernel_costs [RUNS]
// writes a line for each: its name, the scalar, and the shortest of RUNS calls in microseconds. A profiler
// that is told to look at one_call alone sees the kernels one after the other, in the same order:
// scripts/embedding_table.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "alloc/kernel_calls.hpp"

extern "C" [[gnu::noinline]] bool one_call(const std::function<bool()>& kernel) {
  return kernel();
}

namespace {

template <sslam::Scalar S>
int measure(const char* scalar, int runs) {
  using Clock = std::chrono::steady_clock;
  const sslam::testing::RoomFrame<S> room;
  sslam::testing::KernelCalls<S> calls(room);
  int refused = 0;
  calls.for_each([&](const char* name, const std::function<bool()>& kernel) {
    double shortest = 1e30;
    for (int i = 0; i < runs; ++i) {
      const auto start = Clock::now();
      refused += !one_call(kernel);
      shortest = std::min(shortest, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    std::printf("%s,%s,%.3g\n", name, scalar, shortest);
  });
  return refused;
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 300;
  const int refused = measure<float>("float", runs) + measure<double>("double", runs);
  return refused == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
