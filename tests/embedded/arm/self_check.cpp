// SPDX-License-Identifier: BSD-3-Clause
// Every kernel on another processor: each must answer, as it does here. The scene is made on the heap; the
// kernels ask for none.
#include <cstdio>

#include "alloc/kernel_calls.hpp"

int main() {
  const sslam::testing::RoomFrame<float> room;
  sslam::testing::KernelCalls<float> calls(room);
  int refused = 0;
  calls.for_each([&](const char* kernel, auto call) {
    if (call()) return;
    std::printf("%s did not answer\n", kernel);
    ++refused;
  });
  return refused;
}
