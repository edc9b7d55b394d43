// SPDX-License-Identifier: MIT
#include "sim/contact/strips.h"

#include <algorithm>
#include <bit>

namespace throng {

namespace {
constexpr std::size_t kContacts = 8192;  // of a strip, at least about
constexpr std::size_t kSample = 64;      // bodies for each strip, by which to cut
constexpr double kWidth = 8.0;           // mean radii: in narrower strips there is little within
constexpr double kSpread = 0.8;          // of the sample, by which the wider side is told
constexpr std::uint8_t kStill = 0xff;    // no strip: rows that stand for obstacles
}  // namespace

void Strips::cut(std::span<const SolverBody> bodies, Rows awake, std::size_t contacts, double radius,
                 Workers& workers) {
  awake_ = awake;
  const std::size_t most = std::min(std::bit_floor(contacts / kContacts), kMost);
  count_ = 1;
  if (most > 1) choose_cuts(bodies, most, kWidth * radius);
  of_.resize(bodies.size()), of_awake_.resize(awake.size());
  workers.for_ranges(awake.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SolverBody& body = bodies[awake[i]];
      std::size_t strip = 0;
      for (std::size_t k = 0; k + 1 < count_; ++k) strip += body.position[axis_] >= cut_[k];
      if (!(body.inverse_mass > 0.0)) strip = count_;
      of_[awake[i]] = of_awake_[i] = static_cast<std::uint8_t>(strip);
    }
  });
  for (std::size_t row = bodies.size() - kStillRows; row < bodies.size(); ++row) of_[row] = kStill;
  bodies_.sort(of_awake_, count_ + 1, workers);
}

/// Of a sample, as even as rows are: across the wider side.
void Strips::choose_cuts(std::span<const SolverBody> bodies, std::size_t most, double least_width) {
  for (int axis = 0; axis < 2; ++axis) sample_[axis].clear();
  const std::size_t stride = std::max<std::size_t>(1, awake_.size() / (kSample * most));
  for (std::size_t i = 0; i < awake_.size(); i += stride) {
    const SolverBody& body = bodies[awake_[i]];
    if (!(body.inverse_mass > 0.0)) continue;
    for (int axis = 0; axis < 2; ++axis) sample_[axis].push_back(body.position[axis]);
  }
  const std::size_t n = sample_[0].size();
  if (n < kSample) return;
  double widths[2];
  for (int axis = 0; axis < 2; ++axis) {
    std::ranges::sort(sample_[axis]);
    const std::size_t left_out = static_cast<std::size_t>(0.5 * (1.0 - kSpread) * static_cast<double>(n));
    widths[axis] = (sample_[axis][n - 1 - left_out] - sample_[axis][left_out]) / kSpread;
  }
  axis_ = widths[1] > widths[0];
  const double room = std::min(widths[axis_] / least_width, static_cast<double>(most));
  count_ = std::max<std::size_t>(1, std::bit_floor(static_cast<std::size_t>(room)));
  for (std::size_t i = 0; i + 1 < count_; ++i) cut_[i] = sample_[axis_][n * (i + 1) / count_];
}

std::uint8_t Strips::group(std::uint32_t a, std::uint32_t b) const {
  if (count_ == 1) return 0;
  const std::size_t of_a = of_[a], of_b = of_[b] == kStill ? of_a : of_[b];
  const std::size_t lower = std::min(of_a, of_b), upper = std::max(of_a, of_b);
  std::size_t group = 2 * count_ - 1;  // what is left
  if (upper < count_ && upper == lower) group = lower;
  if (upper < count_ && upper == lower + 1) group = count_ + lower;
  return static_cast<std::uint8_t>(group);
}

Strips::Series Strips::groups_of(std::size_t phase) const {
  if (phase == 0) return {0, 1, count_};
  if (count_ == 1) return {0, 1, 0};
  if (phase == 1) return {count_, 2, count_ / 2};
  if (phase == 2) return {count_ + 1, 2, (count_ - 1) / 2};
  return {2 * count_ - 1, 1, 1};
}

}  // namespace throng
