// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "narrowphase/motion/motion.h"
#include "narrowphase/motion/safe_time.h"

/// "Is the path free?", exactly: a motion is covered with neighbourhoods of time that distances and bounds of
/// movement prove free, the place most likely to fail first (Schwarzer, Saha and Latombe 2005). It finds some
/// hit soon, or proves that there is none; for the first contact see first_contact.h.
///
/// Each pair is on its own, and has a covering of its own. At an instant t with distances d_ij between the
/// parts, nothing touches from t - tau to t + tau, tau = min d_ij / mu_ij, or longer: see `safe_time`. The
/// first instant is where the pair is likely to meet, then come the ends; what remains is gaps between
/// neighbourhoods, and the next instant is in the middle of the largest gap. With the
/// minimum alone, that two neighbourhoods of instants a < c leave no gap, tau_a + tau_c >= c - a, implies the
/// test of the paper, lambda_i + lambda_j <= eta_ij(a) + eta_ij(c) for every pair of parts: lambda_i +
/// lambda_j = mu_ij (c - a) <= mu_ij tau_a + mu_ij tau_c <= d_ij(a) + d_ij(c). It says more, for mu_ij tau is
/// what the nearest pair leaves of d_ij.
namespace throng::narrowphase {

/// Pairs of things in motion: rigid bodies, links of robots. Each has a path of its own from time 0 to
/// `duration(k)` and belongs to one of `segments()` segments, which are answered apart from each other.
template <class Pairs>
concept PairsInMotion = requires(Pairs pairs, std::uint32_t k, double time,
                                 const SafeTimeQuestion& question) {
  { pairs.size() } -> std::convertible_to<std::size_t>;
  { pairs.segments() } -> std::convertible_to<std::size_t>;
  { pairs.segment(k) } -> std::convertible_to<std::uint32_t>;
  { pairs.duration(k) } -> std::convertible_to<double>;    // s, finite, never negative
  { pairs.likely(k) } -> std::convertible_to<double>;      // s, within the path, to be looked at first
  { pairs.pace(k) } -> std::convertible_to<double>;        // m/s, what no distance changes faster by
  { pairs.resolution(k) } -> std::convertible_to<double>;  // m, what clearance is not worth proving
  { pairs.safe_time(k, time, question) } -> std::same_as<SafeTime>;  // sets pose_error itself
};

/// What a pair has proven free by one computation of its distance.
struct Neighbourhood {
  std::uint32_t pair;
  double from, to;  ///< s, within the path, both included
  double time;      ///< s, when the distance was computed
  bool proven;      ///< otherwise from = to = time, and it is a matter of rounding or a hit
  bool hit;
};

struct BisectOptions {
  double epsilon = 0.0;  ///< m, clearance below which "undecided" will do; at least the pairs' resolution
  std::vector<Neighbourhood>* covering = nullptr;  ///< appended to: all that was proven, for pictures
  std::size_t evaluations = 1'000'000;  ///< most computations of a pair: what is then open is in doubt
};

/// About a path or a segment of it.
struct PathAnswer {
  Verdict verdict = Verdict::free;
  double from = 0.0, to = 0.0;           ///< s; hit: an instant, both; undecided: see below; free: 0
  std::uint32_t segment = 0, pair = 0;   ///< where that is
  std::uint32_t part_a = 0, part_b = 0;  ///< hit: of the pair, which touch
  std::size_t evaluations = 0;           ///< computations of a pair's distance
};

/// What `bisect` works with: keep one and pass it again, then nothing is allocated once it has grown.
struct BisectScratch {
  struct Gap {
    double length;  ///< m, the time times the pair's pace
    double from, to;
    std::uint32_t pair;
  };
  struct Progress {
    std::size_t evaluations, allowed;
  };
  std::vector<Gap> queue, left;
  std::vector<Progress> pairs;
  std::vector<PathAnswer> segments;
};

/// Whether all pairs stay apart on all their paths. Stops at the first hit found, which wins over what is
/// undecided. Undecided: some pair comes within epsilon, or so near that rounding decides; then [from, to] is
/// the first of the intervals in doubt, and before it nothing touches on that segment. A pair in doubt is
/// searched for a hit for as many computations again as it has had, and 1024 more: after 2 n + 1024, n being
/// those up to its first doubt, what gaps it has left unexplored are told as in doubt too.
/// The largest gap comes first, by length; of equals the first pair, then the earliest: one answer always.
/// Computations grow with a path's length; for a bar that spins past a post, with the logarithm of 1 /
/// clearance.
template <PairsInMotion Pairs>
PathAnswer bisect(Pairs&& pairs, const BisectOptions& options, BisectScratch& scratch);

/// The same, every segment to its own end, in one queue: `answers[s]` for segment s, each with the
/// computations that it took. Expects answers.size() = pairs.segments(). Returns the first of the worst
/// answers (hit before undecided before free), with all computations.
template <PairsInMotion Pairs>
PathAnswer bisect_all(Pairs&& pairs, const BisectOptions& options, BisectScratch& scratch,
                      std::span<PathAnswer> answers);

}  // namespace throng::narrowphase

#include "narrowphase/motion/bisect-inl.h"
