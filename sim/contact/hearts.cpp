// SPDX-License-Identifier: MIT
#include "sim/contact/hearts.h"

#include <algorithm>
#include <limits>
#include <map>

#include "narrowphase/relative.h"

namespace throng {

namespace {

/// What of the polygon lies where normal . x <= height (Sutherland and Hodgman 1974).
std::vector<Vec> cut_off(const std::vector<Vec>& polygon, const Vec& normal, double height) {
  std::vector<Vec> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec &p = polygon[i], &q = polygon[narrowphase::next(i, polygon.size())];
    const double from = normal.dot(p) - height, to = normal.dot(q) - height;
    if (from <= 0.0) kept.push_back(p);
    if ((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0))
      kept.push_back(p + from / (from - to) * (q - p));
  }
  return kept;
}

/// Edges as short as rounding have no direction.
std::vector<Vec> without_short_edges(const std::vector<Vec>& polygon, double shortest) {
  std::vector<Vec> kept;
  for (const Vec& v : polygon)
    if (kept.empty() || (v - kept.back()).norm() > shortest) kept.push_back(v);
  while (kept.size() > 1 && (kept.front() - kept.back()).norm() <= shortest) kept.pop_back();
  return kept;
}

}  // namespace

double thickness(const narrowphase::Convex& part) {
  double twice_area = 0.0, outline = 0.0;
  for (std::size_t i = 0; i < part.normals.size(); ++i) {
    const Vec &p = part.vertices[i], &q = part.vertices[narrowphase::next(i, part.vertices.size())];
    twice_area += narrowphase::cross(p - part.vertices[0], q - part.vertices[0]);
    outline += (q - p).norm();
  }
  return part.radius + (outline > 0.0 ? 0.5 * twice_area / outline : 0.0);
}

narrowphase::Convex inset(const narrowphase::Convex& part, double rim) {
  narrowphase::Convex result = part;
  result.radius = std::max(part.radius - rim, 0.0);
  const double depth = rim - (part.radius - result.radius);
  if (!(depth > 0.0) || part.vertices.size() < 3) return result;
  for (std::size_t i = 0; i < part.normals.size(); ++i)
    result.vertices =
        cut_off(result.vertices, part.normals[i], part.normals[i].dot(part.vertices[i]) - depth);
  return narrowphase::convex(without_short_edges(result.vertices, 1e-9 * depth), result.radius);
}

Hearts::Hearts(const Colliders& colliders)
    : colliders_(colliders), least_(std::numeric_limits<double>::infinity()) {
  for (std::uint32_t row = 0; row < colliders.size(); ++row) {
    thickness_.push_back(is_disc(colliders, row) ? colliders.radius[row]
                                                 : throng::thickness(*colliders.shape[row]));
    least_ = std::min(least_, thickness_.back());
  }
}

void Hearts::make() {
  if (!shape_.empty()) return;
  std::map<const narrowphase::Convex*, std::uint32_t> known;
  for (const narrowphase::Convex* shape : colliders_.shape) {
    const auto [at, is_new] = known.try_emplace(shape, static_cast<std::uint32_t>(hearts_.size()));
    shape_.push_back(at->second);
    if (!is_new) continue;
    hearts_.emplace_back();
    for (std::size_t depth = 0; shape && depth < kDepths; ++depth)
      hearts_.back()[depth] = inset(*shape, kRims[depth] * throng::thickness(*shape));
  }
}

const narrowphase::Convex& Hearts::heart(std::uint32_t collider, std::size_t depth,
                                         narrowphase::Convex& lent) const {
  if (!is_disc(colliders_, collider)) return hearts_[shape_[collider]][depth];
  lent.vertices.assign(1, Vec(0.0, 0.0));
  lent.radius = (1.0 - kRims[depth]) * colliders_.radius[collider];
  return lent;
}

}  // namespace throng
