// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "narrowphase/linkage/check_linkage.h"

namespace throng::narrowphase {

/// The pairs of links on each segment of a path, segment by segment, for `bisect` and for first contact.
class LinksInMotion {
 public:
  LinksInMotion(const LinkageScene& scene, std::span<const LinkageMotion> segments,
                std::span<const PairBounds> bounds)
      : scene_(scene), segments_(segments), bounds_(bounds) {}

  std::size_t size() const { return bounds_.size(); }
  std::size_t segments() const { return segments_.size(); }
  std::uint32_t segment(std::uint32_t k) const { return static_cast<std::uint32_t>(k / scene_.pairs.size()); }
  double duration(std::uint32_t) const { return 1.0; }
  double likely(std::uint32_t) const { return 0.5; }
  double pace(std::uint32_t k) const {
    const auto [of_a, of_b] = far(k);
    return bounds_[k].rate.of(of_a, of_b);
  }
  double resolution(std::uint32_t k) const {
    const auto [of_a, of_b] = far(k);
    const double smaller = std::min(of_a, of_b);
    return 0x1p-34 * (smaller > 0.0 ? smaller : std::max(of_a, of_b)) + 0x1p7 * motion(k).slack();
  }
  /// m, below which a gap may be a matter of rounding.
  double rounding(std::uint32_t k) const {
    const auto [a, b] = shapes(scene_, pair(k));
    return motion(k).slack() + 0x1p-46 * (a->tree.reach + b->tree.reach);
  }

  SafeTime safe_time(std::uint32_t k, double time, SafeTimeQuestion question) const {
    const auto [a, b] = shapes(scene_, pair(k));
    const LinkageMotion::Instant now = motion(k).at(pair(k), bounds_[k], time);
    question.pose_error = motion(k).slack();
    question.motion = &now.motion;
    return narrowphase::safe_time(*a, now.a, *b, now.b, bounds_[k].rate, question);
  }

 private:
  std::pair<double, double> far(std::uint32_t k) const {
    const auto [a, b] = shapes(scene_, pair(k));
    return {a->tree.nodes[0].far, b->tree.nodes[0].far};
  }
  const LinkPair& pair(std::uint32_t k) const { return scene_.pairs[k % scene_.pairs.size()]; }
  const LinkageMotion& motion(std::uint32_t k) const { return segments_[segment(k)]; }

  const LinkageScene& scene_;
  std::span<const LinkageMotion> segments_;
  std::span<const PairBounds> bounds_;
};

}  // namespace throng::narrowphase
