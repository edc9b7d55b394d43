// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "narrowphase/motion/bisect.h"

namespace throng::narrowphase {

/// One run: the queue of gaps, and what is done with the one at its head.
template <class Pairs>
class Bisection {
 public:
  using Gap = BisectScratch::Gap;

  Bisection(Pairs& pairs, const BisectOptions& options, BisectScratch& scratch, std::span<PathAnswer> answers)
      : pairs_(pairs), options_(options), scratch_(scratch), answers_(answers) {
    assert(options.epsilon >= 0.0);
    scratch_.queue.clear();
    scratch_.left.clear();
    scratch_.pairs.assign(pairs_.size(), {0, options_.evaluations});
    for (std::uint32_t s = 0; s < answers_.size(); ++s) answers_[s] = {}, answers_[s].segment = s;
    for (std::uint32_t k = 0; k < scratch_.pairs.size(); ++k) {
      assert(std::isfinite(pairs_.duration(k)));
      scratch_.queue.push_back({pairs_.pace(k) * pairs_.duration(k), 0.0, pairs_.duration(k), k});
    }
    std::make_heap(scratch_.queue.begin(), scratch_.queue.end(), comes_later);
  }

  void run(bool to_the_first_hit) {
    while (!scratch_.queue.empty() && !(to_the_first_hit && has_hit_)) {
      const Gap gap = pop();
      const Progress& progress = scratch_.pairs[gap.pair];
      if (answer(gap).verdict == Verdict::hit) continue;
      if (progress.evaluations >= progress.allowed)
        scratch_.left.push_back(gap);
      else if (progress.evaluations == 0)
        begin(gap);
      else
        divide(gap);
    }
    tell_doubts();
  }

 private:
  using Progress = BisectScratch::Progress;

  static constexpr std::size_t kSearch = 1024;  ///< computations that a pair in doubt has in any case

  static bool comes_later(const Gap& x, const Gap& y) {
    if (x.length != y.length) return x.length < y.length;
    return std::tie(x.pair, x.from) > std::tie(y.pair, y.from);
  }

  Gap pop() {
    std::pop_heap(scratch_.queue.begin(), scratch_.queue.end(), comes_later);
    const Gap gap = scratch_.queue.back();
    scratch_.queue.pop_back();
    return gap;
  }

  PathAnswer& answer(const Gap& gap) { return answers_[pairs_.segment(gap.pair)]; }

  /// Never below what the ends of gaps are rounded by. Options come last, where NaN is passed over.
  double epsilon(std::uint32_t pair) const {
    const double rounding = 0x1p-44 * pairs_.pace(pair) * pairs_.duration(pair);
    return std::max({pairs_.resolution(pair), rounding, options_.epsilon});
  }

  /// Where contact is likely, and if that doesn't cover the whole path, at the ends that it leaves open.
  void begin(const Gap& path) {
    const double likely = pairs_.likely(path.pair);
    assert(path.from <= likely && likely <= path.to);
    const Neighbourhood in = compute(path.pair, likely, path.from, path.to);
    if (in.hit || covers(in, path.from, path.to)) return;
    if (path.to == 0.0) return scratch_.left.push_back(path);
    if (path.from < in.from) {
      const Neighbourhood start = compute(path.pair, path.from, path.from, in.from);
      if (start.hit) return;
      push(path.pair, start.to, in.from);
    }
    if (in.to < path.to) {
      const Neighbourhood end = compute(path.pair, path.to, in.to, path.to);
      if (end.hit) return;
      push(path.pair, in.to, end.from);
    }
  }

  void divide(const Gap& gap) {
    const Neighbourhood in = compute(gap.pair, gap.from + 0.5 * (gap.to - gap.from), gap.from, gap.to);
    if (in.hit || covers(in, gap.from, gap.to)) return;
    if (gap.length > epsilon(gap.pair)) {
      push(gap.pair, gap.from, in.from);
      push(gap.pair, in.to, gap.to);
    } else {
      leave(gap.pair, gap.from, in.from);
      leave(gap.pair, in.to, gap.to);
    }
  }

  static bool covers(const Neighbourhood& in, double from, double to) {
    return in.proven && in.from <= from && in.to >= to;
  }

  void push(std::uint32_t pair, double from, double to) {
    if (!(from < to)) return;
    scratch_.queue.push_back({pairs_.pace(pair) * (to - from), from, to, pair});
    std::push_heap(scratch_.queue.begin(), scratch_.queue.end(), comes_later);
  }
  void leave(std::uint32_t pair, double from, double to) {
    if (from < to) scratch_.left.push_back({0.0, from, to, pair});
  }

  /// At `time`, wanted from `from` to `to`.
  Neighbourhood compute(std::uint32_t pair, double time, double from, double to) {
    constexpr double kALittleMore = 1.0 + 0x1p-40;  // than wanted, which rounding may take away
    SafeTimeQuestion question;
    question.before = kALittleMore * (time - from);
    question.after = kALittleMore * (to - time);
    question.relative_error = 0.5;  // a third of a time may go unclaimed: it takes far fewer parts to find
    const SafeTime safe = pairs_.safe_time(pair, time, question);
    const Neighbourhood in{
        pair, std::max(0.0, time - safe.before),     std::min(pairs_.duration(pair), time + safe.after),
        time, safe.before > 0.0 || safe.after > 0.0, safe.hit};
    if (options_.covering != nullptr) options_.covering->push_back(in);
    count(in, covers(in, from, to));
    if (safe.hit) tell_hit(in, safe);
    return in;
  }

  void count(const Neighbourhood& in, bool all_wanted) {
    Progress& progress = scratch_.pairs[in.pair];
    ++progress.evaluations;
    ++answers_[pairs_.segment(in.pair)].evaluations;
    const bool in_doubt = !all_wanted && pairs_.pace(in.pair) * (in.to - in.from) < 0.5 * epsilon(in.pair);
    if (in_doubt) progress.allowed = std::min(progress.allowed, 2 * progress.evaluations + kSearch);
  }

  void tell_hit(const Neighbourhood& in, const SafeTime& safe) {
    PathAnswer& known = answers_[pairs_.segment(in.pair)];
    known.verdict = Verdict::hit;
    known.from = known.to = in.time;
    known.pair = in.pair, known.part_a = safe.part_a, known.part_b = safe.part_b;
    has_hit_ = true;
  }

  /// Gaps that touch are one; of each segment the first is told.
  void tell_doubts() {
    std::vector<Gap>& left = scratch_.left;
    std::sort(left.begin(), left.end(),
              [](const Gap& x, const Gap& y) { return std::tie(x.pair, x.from) < std::tie(y.pair, y.from); });
    for (std::size_t i = 0; i < left.size();) {
      Gap all = left[i++];
      for (; i < left.size() && left[i].pair == all.pair && left[i].from <= all.to; ++i) all.to = left[i].to;
      PathAnswer& known = answer(all);
      if (known.verdict == Verdict::hit || (known.verdict == Verdict::undecided && known.from <= all.from))
        continue;
      known.verdict = Verdict::undecided;
      known.from = all.from, known.to = all.to, known.pair = all.pair;
    }
  }

  Pairs& pairs_;
  const BisectOptions& options_;
  BisectScratch& scratch_;
  std::span<PathAnswer> answers_;
  bool has_hit_ = false;
};

/// The first of the worst.
inline PathAnswer worst(std::span<const PathAnswer> answers) {
  const auto badness = [](Verdict v) { return v == Verdict::hit ? 2 : v == Verdict::undecided ? 1 : 0; };
  PathAnswer all;
  std::size_t evaluations = 0;
  for (const PathAnswer& one : answers) {
    evaluations += one.evaluations;
    if (badness(one.verdict) > badness(all.verdict)) all = one;
  }
  all.evaluations = evaluations;
  return all;
}

template <PairsInMotion Pairs>
PathAnswer bisect(Pairs&& pairs, const BisectOptions& options, BisectScratch& scratch) {
  scratch.segments.resize(pairs.segments());
  Bisection(pairs, options, scratch, scratch.segments).run(true);
  return worst(scratch.segments);
}

template <PairsInMotion Pairs>
PathAnswer bisect_all(Pairs&& pairs, const BisectOptions& options, BisectScratch& scratch,
                      std::span<PathAnswer> answers) {
  assert(answers.size() == pairs.segments());
  Bisection(pairs, options, scratch, answers).run(false);
  return worst(answers);
}

}  // namespace throng::narrowphase
