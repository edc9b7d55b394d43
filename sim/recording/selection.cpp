// SPDX-License-Identifier: MIT
#include "sim/recording/selection.h"

#include <algorithm>
#include <numeric>

#include "sim/periodic.h"

namespace throng::recording {

Eigen::AlignedBox2d place_of_bodies(const Scene& scene) {
  if (scene.domain.kind != DomainKind::unbounded) return {scene.domain.min, scene.domain.max};
  if (!scene.crowd.walkable.empty()) return bounds(scene.crowd.walkable);
  Eigen::AlignedBox2d box;
  for (const Vec& p : scene.bodies.position) box.extend(p);
  return box;
}

Selection::Selection(const Scene& scene)
    : ids_(scene.record.ids),
      changes_(bodies_come_and_go(scene)),
      domain_(scene.domain),
      within_(scene.record.within) {
  if (ids_.empty()) {
    ids_.resize(scene.bodies.size());
    std::iota(ids_.begin(), ids_.end(), 1);
    return;
  }
  row_of_.assign(scene.bodies.size() + 1, kNone);
  for (std::uint32_t row = 0; row < ids_.size(); ++row) row_of_[ids_[row]] = row;
}

bool Selection::is_order(std::span<const std::uint32_t> id) const {
  return all() && std::ranges::equal(id, ids_);
}

bool Selection::is_within(const Vec& position) const {
  if (!within_) return true;
  return within_->contains(domain_.kind == DomainKind::periodic ? wrapped(position, domain_) : position);
}

}  // namespace throng::recording
