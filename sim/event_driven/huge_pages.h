// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace throng {

/// Memory for large arrays that are read here and there: in pages of 2 MB, where the system has such, whose
/// addresses the processor keeps at hand; those of common ones it would have to look up each time.
template <class T>
struct HugePages {
  using value_type = T;

  HugePages() = default;
  template <class U>
  explicit HugePages(const HugePages<U>&) {}

  T* allocate(std::size_t n) {
    if (n > kMost / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = (n * sizeof(T) + kPage - 1) / kPage * kPage;
    if (n * sizeof(T) < kLeast)
      return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(kLine)));
    void* const memory = std::aligned_alloc(kPage, bytes);
    if (!memory) throw std::bad_alloc();
    madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it all is as right
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) {
    n * sizeof(T) < kLeast ? ::operator delete(memory, std::align_val_t(kLine)) : std::free(memory);
  }

  friend bool operator==(const HugePages&, const HugePages&) { return true; }

 private:
  static constexpr std::size_t kPage = 2 << 20, kLeast = kPage, kLine = 64;  // bytes
  static constexpr std::size_t kMost = std::size_t{1} << 62;                 // bytes
};

}  // namespace throng
