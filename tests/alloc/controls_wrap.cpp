// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <new>
#include <vector>

#include "alloc/heap_watch.hpp"
#include "support/catch.hpp"

using namespace sslam::testing;

namespace {

// Requests of one call that hands back what it got; release(p) frees it.
template <class Request, class Release>
std::size_t requests_of(Request request, Release release) {
  forbid_heap();
  auto* p = request();
  escape(p);
  const std::size_t count = allow_heap();
  release(p);
  return count;
}

}  // namespace

TEST_CASE("Each function of the C allocator is noticed") {
  CHECK(requests_of([] { return std::malloc(16); }, std::free) == 1);
  CHECK(requests_of([] { return std::calloc(2, 8); }, std::free) == 1);
  CHECK(requests_of([] { return std::realloc(nullptr, 16); }, std::free) == 1);
  CHECK(requests_of([] { return std::aligned_alloc(64, 64); }, std::free) == 1);
  const auto aligned = [] {
    void* p = nullptr;
    return posix_memalign(&p, 64, 64) == 0 ? p : nullptr;
  };
  CHECK(requests_of(aligned, std::free) == 1);
}

TEST_CASE("Each form of new is noticed") {
  struct alignas(64) Wide {
    double values[8];
  };
  const auto drop = [](auto* p) { delete p; };
  const auto drop_array = [](auto* p) { delete[] p; };
  CHECK(requests_of([] { return new int; }, drop) == 1);
  CHECK(requests_of([] { return new int[4]; }, drop_array) == 1);
  CHECK(requests_of([] { return new (std::nothrow) int; }, drop) == 1);
  CHECK(requests_of([] { return new (std::nothrow) int[4]; }, drop_array) == 1);
  CHECK(requests_of([] { return new Wide; }, drop) == 1);
  CHECK(requests_of([] { return new Wide[2]; }, drop_array) == 1);
}

TEST_CASE("What hides a request is noticed") {
  std::vector<int> values(100);
  forbid_heap();
  Eigen::MatrixXd matrix(3, 3);
  escape(matrix.data());
  CHECK(allow_heap() == 1);
  forbid_heap();
  std::stable_sort(values.begin(), values.end());
  escape(values.data());
  CHECK(allow_heap() == 1);
  struct Large {
    double values[8] = {};
    double operator()() const { return values[0]; }
  };
  forbid_heap();
  std::function<double()> function = Large{};
  escape(&function);
  CHECK(allow_heap() == 1);
}
