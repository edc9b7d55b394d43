// SPDX-License-Identifier: MIT
// What comes next to a disc: the border of its cell, an obstacle, another disc.
#include <algorithm>
#include <cmath>
#include <span>

#include "narrowphase/disc_fall.h"
#include "narrowphase/disc_flight.h"
#include "sim/event_driven/hard_discs.h"

namespace throng {

namespace {

constexpr double kNever = Soonest::kNever;

/// When something comes to a border that it is `gap` (m) before, at `nearing` (m/s) and `pull` (m/s²): the
/// time at which it goes beyond it, even if it was beyond before.
double time_to_border(double gap, double nearing, double pull) {
  if (pull == 0.0) return nearing > 0.0 ? gap / nearing : kNever;
  const double squared = nearing * nearing + 2.0 * pull * gap;
  if (pull < 0.0 && (nearing <= 0.0 || squared < 0.0)) return kNever;
  const double root = std::sqrt(std::max(0.0, squared));
  return nearing > 0.0 ? 2.0 * gap / (nearing + root) : (root - nearing) / pull;
}

}  // namespace

/// All of what may come next to the disc, which has just collided with `collided`: two discs don't meet again
/// at once.
void HardDiscs::foresee(std::uint32_t disc, double now, std::uint32_t collided) {
  next_[disc].collision = kNever, next_[disc].other = kNobody;
  foresee_crossing(disc, now, {0, 0});
  foresee_obstacles(disc, now, collided);
  foresee_discs(disc, now, {}, collided);
  set(disc);
}

void HardDiscs::set(std::uint32_t disc) {
  soonest_.set(disc, std::min(next_[disc].crossing, next_[disc].collision));
}

/// When it leaves its cell: of the four borders the first that it comes to. `entered`: -1 or 1 along each
/// axis where it has just come in that way. Who came in as the pull goes doesn't go back before he is turned
/// aside.
void HardDiscs::foresee_crossing(std::uint32_t disc, double now, const std::array<int, 2>& entered) {
  const Flying& one = discs_[disc];
  Next& next = next_[disc];
  next.crossing = kNever;
  if (!plan_.gravity) return foresee_straight_crossing(one, now, next);
  for (int axis : {0, 1})
    for (int step : {-1, 1}) {
      const double pull = step * pull_[axis];
      if (pull < 0.0 && entered[axis] == -step) continue;
      const double way = cells_.border(axis, next.cell.at[axis] + (step > 0 ? 1 : 0)) - one.position[axis];
      const double time = one.since + time_to_border(step * way, step * one.velocity[axis], pull);
      const bool turned = pull < 0.0 && time <= now && step * velocity(one, now)[axis] <= 0.0;
      if (turned || !(std::max(now, time) < next.crossing)) continue;
      next.crossing = std::max(now, time);
      next.axis = static_cast<std::int8_t>(axis), next.step = static_cast<std::int8_t>(step);
    }
}

/// The same where nothing pulls: of each axis one border lies ahead.
void HardDiscs::foresee_straight_crossing(const Flying& one, double now, Next& next) const {
  for (int axis : {0, 1}) {
    const double speed = one.velocity[axis];
    const bool up = speed > 0.0;
    const double way = cells_.border(axis, next.cell.at[axis] + up) - one.position[axis];
    const double time = speed != 0.0 ? std::max(now, one.since + way / speed) : kNever;
    const bool sooner = time < next.crossing;
    next.crossing = sooner ? time : next.crossing;
    next.axis = static_cast<std::int8_t>(sooner ? axis : next.axis);
    next.step = static_cast<std::int8_t>(sooner ? 2 * up - 1 : next.step);
  }
}

/// Those that it meets in its cell: beyond lie others, and where the domain repeats other images of them.
void HardDiscs::foresee_obstacles(std::uint32_t disc, double now, std::uint32_t collided) {
  const Flying& one = discs_[disc];
  Next& next = next_[disc];
  const auto rows = cells_.obstacles(cells_.slot(next_[disc].cell));
  if (rows.empty()) return;
  const narrowphase::Fall fall{place(one, now), velocity(one, now), pull_};
  for (const std::uint32_t row : rows) {
    const auto other = static_cast<std::uint32_t>(discs_.size()) + row;
    double time;
    if (obstacles_.is_side(row))
      time = narrowphase::fall_time(fall, one.radius, obstacles_.side[row]);
    else if (plan_.gravity)
      time = narrowphase::fall_time(fall, one.radius, obstacles_.part_at(row), next.crossing - now);
    else if (other == collided)
      continue;
    else
      time = narrowphase::disc_flight(fall.position, one.radius, fall.velocity, obstacles_.part_at(row)).time;
    if (now + time < std::min(next.collision, next.crossing)) next.collision = now + time, next.other = other;
  }
}

void HardDiscs::foresee_discs(std::uint32_t disc, double now, const Range& range, std::uint32_t collided) {
  const Flying& one = discs_[disc];
  Next& next = next_[disc];
  const Looker looker{place(one, now), velocity(one, now), one.radius, now, disc, collided};
  Meeting first{next.collision, kNobody};
  for_each_near(disc, range, [&](std::span<std::uint32_t> near, const Vec& shift) {
    meet(discs_.data(), near.data(), near.size(), shift, plan_.gravity ? &pull_ : nullptr, looker, first);
  });
  if (first.other != kNobody)
    next.collision = first.time, next.other = first.other, next.had = discs_[first.other].had;
}

}  // namespace throng
