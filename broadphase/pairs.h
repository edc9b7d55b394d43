// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Pairs of rows, collected as a search meets them.
namespace throng::broadphase {

/// Two rows of the array that was indexed, a < b.
struct Pair {
  std::uint32_t a, b;
  friend bool operator==(const Pair&, const Pair&) = default;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// What a search met, in any order. Grows like a vector, and keeps its memory; appends without a branch.
template <class T>
class Buffer {
 public:
  void clear() { count_ = 0; }
  std::size_t size() const { return count_; }

  /// Where the next `most` may be written; `keep` says how many of them were.
  T* room(std::size_t most) {
    if (capacity_ - count_ < most) grow(most);
    return all_.get() + count_;
  }
  void keep(const T* end) { count_ = static_cast<std::size_t>(end - all_.get()); }

  std::span<T> all() { return {all_.get(), count_}; }
  std::span<const T> all() const { return {all_.get(), count_}; }

 private:
  void grow(std::size_t most);

  std::unique_ptr<T[]> all_;  // more than are in use, so that a write costs no check
  std::size_t count_ = 0, capacity_ = 0;
};
using PairBuffer = Buffer<Pair>;

template <class T>
void Buffer<T>::grow(std::size_t most) {
  capacity_ = 2 * (count_ + most);
  std::unique_ptr<T[]> larger(new T[capacity_]);  // not filled with zeros
  std::copy_n(all_.get(), count_, larger.get());
  all_ = std::move(larger);
}

/// Pairs in the order in which a search met them, one buffer after the other: threads fill one each, and none
/// is copied. Where the buffers meet depends on the number of threads, the order on nothing but the points.
class PairList {
 public:
  /// Makes room for `buffers` empty ones.
  void reset(std::size_t buffers);
  PairBuffer& buffer(std::size_t i) { return buffers_[i]; }

  std::size_t buffers() const { return count_; }
  std::span<const Pair> pairs(std::size_t buffer) const { return buffers_[buffer].all(); }
  std::size_t size() const;

  template <class F>
  void for_each(F&& f) const {
    for (std::size_t i = 0; i < count_; ++i)
      for (const Pair& pair : pairs(i)) f(pair);
  }

 private:
  std::vector<PairBuffer> buffers_;  // the first count_ are in use
  std::size_t count_ = 0;
};

}  // namespace throng::broadphase
