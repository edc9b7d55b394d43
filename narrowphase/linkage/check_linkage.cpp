// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/check_linkage.h"

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// The pairs of parts in two leaves, until one is enough.
template <class Enough>
bool any_pair(const PartsBvh& a, const Branch& of_a, const PartsBvh& b, const Branch& of_b, Enough enough) {
  for (std::uint32_t k = of_a.first; k < of_a.first + of_a.count; ++k)
    for (std::uint32_t l = of_b.first; l < of_b.first + of_b.count; ++l)
      if (enough(a.tree.order[k], b.tree.order[l])) return true;
  return false;
}

}  // namespace

std::optional<LinkContact> LinkageChecker::contact(std::span<const double> values) {
  place(values);
  for (const LinkPair& pair : scene_.pairs)
    if (const auto found = contact_of(pair)) return found;
  return std::nullopt;
}

std::optional<LinkContact> LinkageChecker::nearest(std::span<const double> values) {
  place(values);
  std::optional<LinkContact> best;
  for (const LinkPair& pair : scene_.pairs) find_nearer(pair, best);
  return best;
}

void LinkageChecker::place(std::span<const double> values) {
  poses_.resize(scene_.linkage.size());
  place_links(scene_.linkage, values, poses_);
}

std::optional<LinkContact> LinkageChecker::contact_of(const LinkPair& pair) const {
  const auto [of_a, of_b] = shapes(scene_, pair);
  const PartsBvh &a = *of_a, &b = *of_b;
  const Pose pose_a = poses_[pair.a], pose_b = pose(pair.b);
  std::optional<LinkContact> found;
  const auto touches = [&](std::uint32_t i, std::uint32_t j) {
    const Separation s = separation(a.parts[i], pose_a, b.parts[j], pose_b);
    if (s.distance <= 0.0) found = {pair, i, j, s};
    return found.has_value();
  };
  const auto leaf = [&](const Branch& leaf_a, const Branch& leaf_b) {
    return any_pair(a, leaf_a, b, leaf_b, touches);
  };
  NoCounters none;
  visit_overlaps(a.tree, b.tree, frame(relative(pose_a, pose_b), a.tree.reach + b.tree.reach), leaf, none);
  return found;
}

void LinkageChecker::find_nearer(const LinkPair& pair, std::optional<LinkContact>& best) const {
  const auto [of_a, of_b] = shapes(scene_, pair);
  const PartsBvh &a = *of_a, &b = *of_b;
  const Pose pose_a = poses_[pair.a], pose_b = pose(pair.b);
  double upper = best ? best->separation.distance : std::numeric_limits<double>::infinity();
  const auto compare = [&](std::uint32_t i, std::uint32_t j) {
    const Separation s = separation(a.parts[i], pose_a, b.parts[j], pose_b);
    if (!best || s.distance < best->separation.distance) best = {pair, i, j, s};
    return false;
  };
  const auto leaf = [&](const Branch& leaf_a, const Branch& leaf_b, double) {
    any_pair(a, leaf_a, b, leaf_b, compare);
    return best->separation.distance;
  };
  NoCounters none;
  minimise(a.tree, b.tree, frame(relative(pose_a, pose_b), a.tree.reach + b.tree.reach), 0.0,
           -std::numeric_limits<double>::infinity(), upper, leaf, none);
}

}  // namespace throng::narrowphase
