// SPDX-License-Identifier: BSD-3-Clause
// Counts what reaches for the heap between forbid_heap() and allow_heap(). Two builds, since each is blind
// alone: with EIGEN_RUNTIME_NO_MALLOC Eigen tells of its own requests before an optimiser can remove them;
// without, every request of optimised code to the C and C++ allocators is counted.
#pragma once

#include <cstddef>

namespace sslam::testing {

void forbid_heap() noexcept;
// Returns the number of requests since forbid_heap().
std::size_t allow_heap() noexcept;

void count_heap_request() noexcept;

// The pointer becomes visible to the outside, so that the request that it came from cannot be removed.
inline void escape(void* pointer) noexcept {
  asm volatile("" : : "g"(pointer) : "memory");
}

}  // namespace sslam::testing

#ifdef EIGEN_RUNTIME_NO_MALLOC
// Eigen asserts that malloc is allowed. Kernels are noexcept: count instead of throwing.
#define eigen_assert(condition) ((condition) ? (void)0 : ::sslam::testing::count_heap_request())
#endif
