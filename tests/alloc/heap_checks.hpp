// SPDX-License-Identifier: BSD-3-Clause
// What every kernel promises of the heap, checked for one scalar: one file each, for they are slow to
// compile.
#pragma once

#include "alloc/heap_watch.hpp"
// The watch defines what Eigen calls: it comes first.
#include "alloc/kernel_calls.hpp"
#include "support/catch.hpp"

namespace sslam::testing {

template <Scalar S>
void check_no_heap_to_answer() {
  const RoomFrame<S> room;
  KernelCalls<S>(room).for_each([](const char* kernel, auto call) {
    forbid_heap();
    const bool ok = call();
    const std::size_t requests = allow_heap();
    INFO(kernel);
    CHECK(ok);
    CHECK(requests == 0);
  });
}

template <Scalar S>
void check_no_heap_to_refuse() {
  RoomFrameOptions options;
  options.normal_rows = options.segments = options.matches = options.points = options.lines = options.views =
      0;
  const RoomFrame<S> room(options);
  KernelCalls<S>(room).for_each([](const char* kernel, auto call) {
    forbid_heap();
    (void)call();
    const std::size_t requests = allow_heap();
    INFO(kernel);
    CHECK(requests == 0);
  });
}

}  // namespace sslam::testing
