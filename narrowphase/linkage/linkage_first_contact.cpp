// SPDX-License-Identifier: MIT
#include <algorithm>

#include "narrowphase/linkage/links_in_motion.h"

namespace throng::narrowphase {

namespace {

/// Pairs on their way from 0 to 1, none of which gets far ahead of the others.
class CommonAdvance {
 public:
  CommonAdvance(const LinksInMotion& pairs, double width, std::vector<FirstContactProgress>& progress)
      : pairs_(pairs), width_(width), progress_(progress) {
    progress_.assign(pairs.size(), {0.0, 0});
  }

  PathAnswer run() {
    while (!progress_.empty()) {
      const std::uint32_t last = behind_all();
      if (!(progress_[last].time < limit_)) break;
      go_on(last);
    }
    return answer();
  }

 private:
  static constexpr std::size_t kMost = 10000;  ///< evaluations of a pair that leads nowhere
  static constexpr int kDoublings = 16;
  static constexpr double kALittleMore = 1.0 + 0x1p-40;  ///< than wanted, which rounding may take away

  std::uint32_t behind_all() const {
    const auto earlier = [](const auto& x, const auto& y) { return x.time < y.time; };
    return static_cast<std::uint32_t>(std::min_element(progress_.begin(), progress_.end(), earlier) -
                                      progress_.begin());
  }

  SafeTime ask(std::uint32_t k, double time, double before) {
    SafeTimeQuestion question;
    question.before = kALittleMore * before;
    question.after = kALittleMore * (limit_ - time);
    ++progress_[k].evaluations;
    return pairs_.safe_time(k, time, question);
  }

  void reach(std::uint32_t k, double time, double after) {
    progress_[k].time = after >= limit_ - time ? 1.0 : time + after;
  }

  void go_on(std::uint32_t k) {
    const double time = progress_[k].time;
    const SafeTime safe = ask(k, time, 0.0);
    if (safe.hit) return touch(k, time, time, safe);
    if (progress_[k].evaluations > kMost) return give_up(k, time);
    if (safe.after >= limit_ - time || safe.after > step(k)) return reach(k, time, safe.after);
    look_ahead(k, time);
  }

  /// How far to look where `safe_time` comes to its end. Of time.
  double step(std::uint32_t k) const { return std::max(width_, 4.0 * pairs_.rounding(k)) / pairs_.pace(k); }

  /// The gap at `from` is within rounding, or nearly: what is behind it?
  void look_ahead(std::uint32_t k, double from) {
    double reached = step(k);
    for (int i = 0;; ++i, reached *= 2.0) {
      const double time = std::min(limit_, from + reached);
      const SafeTime safe = ask(k, time, time - from);
      if (safe.hit) return touch(k, from, time, safe);
      const bool free = safe.before >= time - from;
      if (!free && i < kDoublings && time < limit_) continue;
      if (!free) doubt(k, from, time - safe.before);
      return reach(k, time, safe.after);
    }
  }

  /// Of an earlier hit the bracket stays open at its beginning: up to there alone is its pair known to be
  /// free.
  void touch(std::uint32_t k, double from, double to, const SafeTime& safe) {
    if (contact_.verdict == Verdict::hit) from = std::min(from, contact_.from);
    contact_ = {Verdict::hit, from, to, 0, k, safe.part_a, safe.part_b, 0};
    limit_ = to;
    progress_[k].time = 1.0;
  }

  void doubt(std::uint32_t k, double from, double to) {
    if (doubt_.verdict == Verdict::free || from < doubt_.from)
      doubt_ = {Verdict::undecided, from, to, 0, k, 0, 0, 0};
  }
  void give_up(std::uint32_t k, double from) {
    doubt(k, from, limit_);
    progress_[k].time = 1.0;
  }

  PathAnswer answer() const {
    PathAnswer all = contact_.verdict == Verdict::hit ? contact_ : doubt_;
    if (doubt_.verdict == Verdict::undecided) all.from = std::min(all.from, doubt_.from);
    for (const FirstContactProgress& one : progress_) all.evaluations += one.evaluations;
    return all;
  }

  const LinksInMotion& pairs_;
  double width_;
  std::vector<FirstContactProgress>& progress_;
  double limit_ = 1.0;  ///< what comes later doesn't count
  PathAnswer contact_, doubt_;
};

}  // namespace

LinkageAnswer LinkageChecker::first_contact(std::span<const double> from, std::span<const double> to,
                                            double width) {
  begin();
  add_segment(from, to);
  const LinksInMotion pairs(scene_, {motions_.data(), segments_}, bounds_);
  return named(CommonAdvance(pairs, width, progress_).run());
}

}  // namespace throng::narrowphase
