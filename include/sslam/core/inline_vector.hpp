// SPDX-License-Identifier: BSD-3-Clause
// A list that lives where it is declared: its capacity is part of its type, and it never touches the heap.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace sslam {

template <class T, std::size_t Capacity>
class InlineVector {
 public:
  using value_type = T;

  // Returns false, and changes nothing, when the list is full.
  [[nodiscard]] constexpr bool push_back(const T& value) noexcept {
    if (size_ == Capacity) return false;
    items_[size_++] = value;
    return true;
  }

  // Removes item i in constant time: the last item takes its place.
  constexpr void swap_remove(std::size_t i) noexcept { items_[i] = items_[--size_]; }
  constexpr void pop_back() noexcept { --size_; }
  constexpr void clear() noexcept { size_ = 0; }

  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const noexcept { return size_ == Capacity; }
  [[nodiscard]] static constexpr std::size_t capacity() noexcept { return Capacity; }

  [[nodiscard]] constexpr T& operator[](std::size_t i) noexcept { return items_[i]; }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const noexcept { return items_[i]; }
  [[nodiscard]] constexpr T& back() noexcept { return items_[size_ - 1]; }
  [[nodiscard]] constexpr const T& back() const noexcept { return items_[size_ - 1]; }

  [[nodiscard]] constexpr T* begin() noexcept { return items_.data(); }
  [[nodiscard]] constexpr T* end() noexcept { return items_.data() + size_; }
  [[nodiscard]] constexpr const T* begin() const noexcept { return items_.data(); }
  [[nodiscard]] constexpr const T* end() const noexcept { return items_.data() + size_; }

  [[nodiscard]] constexpr operator std::span<const T>() const noexcept { return {items_.data(), size_}; }

 private:
  std::array<T, Capacity> items_{};
  std::size_t size_ = 0;
};

}  // namespace sslam
