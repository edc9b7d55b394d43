// SPDX-License-Identifier: MIT
#include "broadphase/moving_pairs.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace throng::broadphase {

namespace {

constexpr double kMargin = 0.15;  // of the mean reach: the list is then about a third longer than the pairs
constexpr int kGain = 3;          // calls that a list must answer to be worth its making
constexpr std::size_t kGrain = 2048;  // rows or pairs a range
constexpr int kWait = 100;            // calls without one where it was not

/// Rounding in the comparison of distances, as a part of each reach: far more than it can be.
constexpr double kRounding = 1e-12;

bool same(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

void MovingPairs::find(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                       std::vector<Pair>& pairs, std::span<const std::uint8_t> movable) {
  reused_ = !reach_.empty() && same(movable, movable_) && holds(centres, reach, period);
  if (reused_) {
    ++age_;
  } else {
    if (!reach_.empty() && age_ < kGain) wait_ = kWait;
    reach_.clear();
    if (wait_ > 0) {
      --wait_;
      return search_.find(centres, reach, period, pairs, movable);
    }
    renew(centres, reach, period, movable);
  }
  select(centres, reach, period, pairs);
}

/// Two discs that are near now were, when the list was made, no farther apart than they reach now and have
/// moved since: within the list's reaches, if each one's own sum is.
bool MovingPairs::holds(std::span<const Point> centres, std::span<const double> reach,
                        const Period* period) const {
  if (reach_.size() != reach.size() || periodic_ != (period != nullptr)) return false;
  if (period && (period->origin != period_.origin || period->size != period_.size)) return false;
  const double slack = period ? 16.0 * std::numeric_limits<double>::epsilon() * period->size.maxCoeff() : 0.0;
  std::atomic<bool> all = true;
  team_.for_ranges(reach.size(), kGrain, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double room = reach_[row] * (1.0 - kRounding) - reach[row] - slack;
      if (room >= 0.0 && squared_distance(centres[row], centre_[row], period) <= room * room) continue;
      all = false;
      return;
    }
  });
  return all;
}

void MovingPairs::renew(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                        std::span<const std::uint8_t> movable) {
  double sum = 0.0;
  for (const double r : reach) sum += r;
  double margin = reach.empty() ? 0.0 : kMargin * sum / static_cast<double>(reach.size());
  const double widest = reach.empty() ? 0.0 : *std::max_element(reach.begin(), reach.end());
  if (period) margin = std::min(margin, 0.25 * period->size.minCoeff() - widest);
  reach_.assign(reach.begin(), reach.end());
  for (double& r : reach_) r += margin;
  centre_.assign(centres.begin(), centres.end());
  movable_.assign(movable.begin(), movable.end());
  periodic_ = period != nullptr;
  if (period) period_ = *period;
  search_.find(centres, reach_, period, list_, movable);
  age_ = 0;
}

/// Each range keeps its own where they stood; then these are brought together.
void MovingPairs::select(std::span<const Point> centres, std::span<const double> reach, const Period* period,
                         std::vector<Pair>& pairs) {
  pairs.resize(list_.size()), kept_.assign(list_.size() / kGrain + 1, 0);
  const auto keep = [&](const auto& metric) {
    team_.for_ranges(list_.size(), kGrain, [&](std::size_t i, std::size_t begin, std::size_t end) {
      Pair* out = pairs.data() + begin;
      for (const Pair& pair : std::span(list_).subspan(begin, end - begin)) {
        const double most = reach[pair.a] + reach[pair.b];
        *out = pair;
        out += metric(centres[pair.a], centres[pair.b]) <= most * most;
      }
      kept_[i] = static_cast<std::size_t>(out - (pairs.data() + begin));
    });
  };
  if (period)
    keep(PeriodicMetric{period->size});
  else
    keep(PlaneMetric{});
  auto end = pairs.begin() + static_cast<std::ptrdiff_t>(kept_[0]);
  for (std::size_t i = 1; i < kept_.size(); ++i)
    end = std::copy_n(pairs.begin() + static_cast<std::ptrdiff_t>(i * kGrain), kept_[i], end);
  pairs.erase(end, pairs.end());
}

}  // namespace throng::broadphase
