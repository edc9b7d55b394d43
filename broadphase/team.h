// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace throng::broadphase {

/// A fixed number of threads for tasks that don't touch each other.
class Team {
 public:
  /// Expects threads >= 1; with one, everything runs in the caller's thread and nothing is started.
  explicit Team(int threads);
  ~Team();

  std::size_t threads() const { return threads_; }

  /// Calls f(i) for i = 0 to n - 1, in any order. Allocates nothing with one thread.
  template <class F>
  void for_each(std::size_t n, F&& f) {
    run(n, call_of<F>, &f);
  }

  /// Into how many ranges that are `grain` long, but the last, for_ranges() cuts 0 to n: one alone, all of
  /// it, where there is one thread or no more to do.
  std::size_t ranges(std::size_t n, std::size_t grain) const {
    return threads_ == 1 || n <= grain ? 1 : (n + grain - 1) / grain;
  }

  /// Calls f(i, begin, end) for the i-th of these ranges.
  template <class F>
  void for_ranges(std::size_t n, std::size_t grain, F&& f) {
    const std::size_t count = ranges(n, grain);
    if (count == 1) return f(std::size_t{0}, std::size_t{0}, n);
    for_each(count, [&](std::size_t i) { f(i, i * grain, std::min(n, (i + 1) * grain)); });
  }

  /// The same as for_each() for few of them, each worth handing over: with as many threads as there are, each
  /// tends to go to the one where it went before.
  template <class F>
  void for_few(std::size_t n, F&& f) {
    if (n == 1) return f(std::size_t{0});
    run_few(n, call_of<F>, &f);
  }

 private:
  using Call = void (*)(void*, std::size_t);
  template <class F>
  static void call_of(void* call, std::size_t i) {
    (*static_cast<std::remove_reference_t<F>*>(call))(i);
  }
  void run(std::size_t n, Call call, void* context);
  void run_few(std::size_t n, Call call, void* context);

  struct Arena;
  std::size_t threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace throng::broadphase
