// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

namespace throng {

/// A fixed number of threads for loops whose rounds don't touch each other: the answer is the same for any
/// number.
class Workers {
 public:
  /// Expects threads >= 1; with one, everything runs in the caller's thread and nothing is started.
  explicit Workers(int threads);
  ~Workers();

  /// Calls f(begin, end) for ranges that cover 0 to n. Allocates nothing with one thread.
  template <class F>
  void for_ranges(std::size_t n, F&& f) {
    run(
        n, [](void* call, std::size_t begin, std::size_t end) { (*static_cast<F*>(call))(begin, end); }, &f);
  }

  /// Calls f(i) for i = 0 to n - 1, few and each worth handing over; with as many threads as there are, each
  /// tends to go to the one where it went before.
  template <class F>
  void for_each(std::size_t n, F&& f) {
    run_few(
        n, [](void* call, std::size_t i, std::size_t) { (*static_cast<F*>(call))(i); }, &f);
  }

 private:
  using Call = void (*)(void*, std::size_t, std::size_t);
  void run(std::size_t n, Call call, void* context);
  void run_few(std::size_t n, Call call, void* context);

  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace throng
