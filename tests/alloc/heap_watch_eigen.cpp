// SPDX-License-Identifier: BSD-3-Clause
#include "alloc/heap_watch.hpp"

#include <Eigen/Core>

namespace sslam::testing {
namespace {
std::size_t requests = 0;
}

void count_heap_request() noexcept {
  ++requests;
}

void forbid_heap() noexcept {
  requests = 0;
  Eigen::internal::set_is_malloc_allowed(false);
}
std::size_t allow_heap() noexcept {
  Eigen::internal::set_is_malloc_allowed(true);
  return requests;
}

}  // namespace sslam::testing
