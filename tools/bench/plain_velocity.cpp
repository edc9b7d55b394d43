// SPDX-License-Identifier: MIT
#include "tools/bench/plain_velocity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace throng::bench {

namespace {

constexpr double kParallel = 1e-14;  // sine of an angle between unit vectors that rounding makes

/// What is looked for: the point nearest to `target`, or the farthest along the unit vector `target`.
struct Aim {
  Vec target;
  bool far = false;
};

double outside(const HalfPlane& plane, const Vec& v) {
  return plane.offset - plane.normal.dot(v);
}

/// Of the border of `plane` within the disc and the half planes, the best point. False where there is none.
bool best_on_border(const HalfPlane& plane, std::span<const HalfPlane> others, double most, const Aim& aim,
                    Vec& best) {
  const double room = most * most - plane.offset * plane.offset;
  if (!(room >= 0.0)) return false;
  const Vec along(-plane.normal.y(), plane.normal.x()), middle = plane.offset * plane.normal;
  double high = std::sqrt(room), low = -high;
  for (const HalfPlane& other : others) {
    const double slope = other.normal.dot(along), lack = outside(other, middle);
    if (std::abs(slope) <= kParallel) {
      if (lack > kParallel * most) return false;
      continue;
    }
    const double t = lack / slope;
    slope > 0.0 ? low = std::max(low, t) : high = std::min(high, t);
    if (low > high) return false;
  }
  const double wanted = along.dot(aim.target);
  const double t = aim.far ? (wanted > 0.0 ? high : low) : std::clamp(wanted, low, high);
  best = middle + t * along;
  return true;
}

/// The best point within the disc and the half planes. Returns how many of these, from the first on, it lies
/// in: all, unless they have none in common.
std::size_t best_within(std::span<const HalfPlane> planes, double most, const Aim& aim, Vec& best) {
  const double length = aim.target.norm();
  best = aim.far ? Vec(most * aim.target) : length > most ? Vec(most / length * aim.target) : aim.target;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!(outside(planes[i], best) > 0.0)) continue;
    const Vec before = best;
    if (best_on_border(planes[i], planes.first(i), most, aim, best)) continue;
    best = before;
    return i;
  }
  return planes.size();
}

/// Where no more than `other` is outside of its plane, one is outside of `plane`; false where that is
/// everywhere or nowhere.
bool less_outside(const HalfPlane& other, const HalfPlane& plane, HalfPlane& result) {
  const Vec normal = other.normal - plane.normal;
  const double length = normal.norm();
  if (length <= kParallel) return false;
  result = {normal / length, (other.offset - plane.offset) / length};
  return true;
}

}  // namespace

Vec plain_velocity(std::span<const HalfPlane> planes, std::size_t hard, double most, const Vec& preferred,
                   std::vector<HalfPlane>& room) {
  Vec best;
  const std::size_t good = best_within(planes, most, {preferred}, best);
  if (good == planes.size()) return best;
  double depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = hard; i < good; ++i) depth = std::max(depth, outside(planes[i], best));
  if (good < hard) best_within(planes.first(hard), most, {preferred}, best);
  for (std::size_t i = std::max(good, hard); i < planes.size(); ++i) {
    if (!(outside(planes[i], best) > depth)) continue;
    room.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(hard));
    HalfPlane between;
    for (std::size_t j = hard; j < i; ++j)
      if (less_outside(planes[j], planes[i], between)) room.push_back(between);
    const Vec before = best;
    if (best_within(room, most, {planes[i].normal, true}, best) < room.size()) best = before;
    depth = outside(planes[i], best);
  }
  return best;
}

}  // namespace throng::bench
