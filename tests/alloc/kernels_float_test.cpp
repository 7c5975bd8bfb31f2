// SPDX-License-Identifier: BSD-3-Clause
#include "alloc/heap_watch.hpp"
// All of the core before the kernels' own headers: none may depend on what a user has included before.
#include "sslam/core.hpp"

#include "alloc/heap_checks.hpp"

TEST_CASE("No kernel reaches for the heap in float") {
  sslam::testing::check_no_heap_to_answer<float>();
}
TEST_CASE("No kernel reaches for the heap to refuse in float") {
  sslam::testing::check_no_heap_to_refuse<float>();
}
