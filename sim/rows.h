// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace throng {

/// Rows of an array, ascending: all of them, or those of a list that somebody else keeps.
class Rows {
 public:
  static Rows all(std::size_t n) { return {true, n, nullptr}; }
  static Rows of(std::span<const std::uint32_t> list) { return {false, list.size(), list.data()}; }

  bool are_all() const { return all_; }
  std::size_t size() const { return size_; }
  std::uint32_t operator[](std::size_t i) const { return all_ ? static_cast<std::uint32_t>(i) : list_[i]; }

  /// Calls f(row) for each.
  template <class F>
  void for_each(F&& f) const {
    if (all_)
      for (std::size_t i = 0; i < size_; ++i) f(static_cast<std::uint32_t>(i));
    else
      for (std::size_t i = 0; i < size_; ++i) f(list_[i]);
  }

 private:
  Rows(bool all, std::size_t size, const std::uint32_t* list) : all_(all), size_(size), list_(list) {}

  bool all_;
  std::size_t size_;
  const std::uint32_t* list_;
};

}  // namespace throng
