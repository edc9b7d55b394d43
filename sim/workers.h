// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace throng {

/// A fixed number of threads for loops whose rounds don't touch each other: the answer is the same for any
/// number.
class Workers {
  struct Team;

 public:
  /// Expects threads >= 1; with one, everything runs in the caller's thread and nothing is started.
  explicit Workers(int threads);
  ~Workers();

  /// As long as it lives the threads stand by, busy, and loops begin within a microsecond instead of ten. At
  /// most one at a time, and no other loops of TBB in it.
  class Shift {
   public:
    /// Nobody stands by where the longest loops have so few rounds that one thread does them.
    Shift(Workers& workers, std::size_t rounds);
    ~Shift();
    Shift(const Shift&) = delete;
    Shift& operator=(const Shift&) = delete;

   private:
    Team* team_;  // null where nobody stands by
  };

  /// Whether for_ranges would have several threads share so many rounds.
  bool share(std::size_t n) const { return team_ && n > kGrain; }

  /// Calls f(begin, end) for ranges that cover 0 to n. Allocates nothing with one thread. Rethrows what the
  /// lowest range threw.
  template <class F>
  void for_ranges(std::size_t n, F&& f) {
    run(n, kGrain, &call_of<F>, &f);
  }

  /// Calls f(i) for i = 0 to n - 1, few and each worth handing over. During a shift the same one tends to run
  /// where it ran before: what it works on is in that core's cache.
  template <class F>
  void for_each(std::size_t n, F&& f) {
    for_ranges_of(1, n, [&](std::size_t begin, std::size_t end) {
      for (; begin < end; ++begin) f(begin);
    });
  }

 private:
  using Call = void (*)(void*, std::size_t, std::size_t);
  static constexpr std::size_t kGrain = 512;  // rounds a range: enough work to pay for handing it over

  template <class F>
  static void call_of(void* f, std::size_t begin, std::size_t end) {
    (*static_cast<std::remove_reference_t<F>*>(f))(begin, end);
  }
  template <class F>
  void for_ranges_of(std::size_t grain, std::size_t n, F&& f) {
    run(n, grain, &call_of<F>, &f);
  }
  void run(std::size_t n, std::size_t grain, Call call, void* context);

  std::unique_ptr<Team> team_;
};

}  // namespace throng
