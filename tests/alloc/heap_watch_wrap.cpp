// SPDX-License-Identifier: BSD-3-Clause
// Linked with --wrap for each function of the C allocator; operator new is replaced.
#include "alloc/heap_watch.hpp"

#include <cstdlib>
#include <new>

namespace sslam::testing {
namespace {
std::size_t requests = 0;
bool forbidden = false;
}  // namespace

void count_heap_request() noexcept {
  if (forbidden) ++requests;
}
void forbid_heap() noexcept {
  requests = 0;
  forbidden = true;
}
std::size_t allow_heap() noexcept {
  forbidden = false;
  return requests;
}

}  // namespace sslam::testing

using sslam::testing::count_heap_request;

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* old, std::size_t size);
int __real_posix_memalign(void** out, std::size_t alignment, std::size_t size);
void* __real_aligned_alloc(std::size_t alignment, std::size_t size);

void* __wrap_malloc(std::size_t size) {
  count_heap_request();
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  count_heap_request();
  return __real_calloc(count, size);
}
void* __wrap_realloc(void* old, std::size_t size) {
  count_heap_request();
  return __real_realloc(old, size);
}
int __wrap_posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  count_heap_request();
  return __real_posix_memalign(out, alignment, size);
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  count_heap_request();
  return __real_aligned_alloc(alignment, size);
}
}

// The other forms of new end in these two.
void* operator new(std::size_t size) {
  count_heap_request();
  if (void* p = __real_malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  count_heap_request();
  void* p = nullptr;
  if (__real_posix_memalign(&p, static_cast<std::size_t>(alignment), size) == 0) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
