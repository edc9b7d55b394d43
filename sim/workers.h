// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "broadphase/team.h"

namespace throng {

/// A fixed number of threads for loops whose rounds don't touch each other: the answer is the same for any
/// number.
class Workers {
 public:
  /// Expects threads >= 1; with one, everything runs in the caller's thread and nothing is started.
  explicit Workers(int threads) : team_(threads) {}

  broadphase::Team& team() { return team_; }

  /// Calls f(begin, end) for ranges that cover 0 to n. Allocates nothing with one thread.
  template <class F>
  void for_ranges(std::size_t n, F&& f) {
    team_.for_ranges(n, kGrain, [&](std::size_t, std::size_t begin, std::size_t end) { f(begin, end); });
  }

  /// Calls f(i) for i = 0 to n - 1, few and each worth handing over; with as many threads as there are, each
  /// tends to go to the one where it went before.
  template <class F>
  void for_few(std::size_t n, F&& f) {
    team_.for_few(n, std::forward<F>(f));
  }

  /// Calls f(begin, end, list) for ranges that cover 0 to n, and appends to `all` what each appends to its
  /// list, in the order of ranges. `lists`: buffers, to be kept.
  template <class T, class F>
  void gather(std::size_t n, std::vector<std::vector<T>>& lists, std::vector<T>& all, F&& f) {
    if (ranges(n) == 1) return f(std::size_t{0}, n, all);
    if (lists.size() < ranges(n)) lists.resize(ranges(n));
    team_.for_ranges(n, kGrain, [&](std::size_t i, std::size_t begin, std::size_t end) {
      lists[i].clear();
      f(begin, end, lists[i]);
    });
    for (std::size_t i = 0; i < ranges(n); ++i) all.insert(all.end(), lists[i].begin(), lists[i].end());
  }

  /// Replaces `all` by what write(begin, end, out) writes from `out` on for ranges that cover 0 to n, as much
  /// as count(begin, end) tells; `out` is an iterator. `counts`: a buffer, to be kept.
  template <class T, class Count, class Write>
  void select(std::size_t n, std::vector<std::size_t>& counts, std::vector<T>& all, Count&& count,
              Write&& write) {
    if (ranges(n) == 1) return all.clear(), write(std::size_t{0}, n, std::back_inserter(all));
    counts.assign(ranges(n) + 1, 0);
    team_.for_ranges(n, kGrain, [&](std::size_t i, std::size_t begin, std::size_t end) {
      counts[i + 1] = count(begin, end);
    });
    std::partial_sum(counts.begin(), counts.end(), counts.begin());
    all.resize(counts.back());
    team_.for_ranges(n, kGrain, [&](std::size_t i, std::size_t begin, std::size_t end) {
      write(begin, end, all.data() + counts[i]);
    });
  }

 private:
  static constexpr std::size_t kGrain = 512;  // rounds a range: enough work to pay for handing it over

  std::size_t ranges(std::size_t n) const { return team_.ranges(n, kGrain); }

  broadphase::Team team_;
};

}  // namespace throng
