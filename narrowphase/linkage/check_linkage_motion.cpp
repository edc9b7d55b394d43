// SPDX-License-Identifier: MIT
#include <algorithm>

#include "narrowphase/linkage/check_linkage.h"

namespace throng::narrowphase {

namespace {

double far(const PartsBvh& shape) {
  return shape.tree.nodes[0].far;
}

/// The pairs of links on each segment of a path, for `bisect`: segment by segment.
class LinksInMotion {
 public:
  LinksInMotion(const LinkageScene& scene, std::span<const LinkageMotion> segments,
                std::span<const PairBounds> bounds)
      : scene_(scene), segments_(segments), bounds_(bounds) {}

  std::size_t size() const { return bounds_.size(); }
  std::size_t segments() const { return segments_.size(); }
  std::uint32_t segment(std::uint32_t k) const { return static_cast<std::uint32_t>(k / scene_.pairs.size()); }
  double duration(std::uint32_t) const { return 1.0; }
  double pace(std::uint32_t k) const {
    const auto [a, b] = shapes(scene_, pair(k));
    return bounds_[k].rate.of(far(*a), far(*b));
  }
  double resolution(std::uint32_t k) const {
    const auto [a, b] = shapes(scene_, pair(k));
    const double smaller = std::min(far(*a), far(*b));
    return 0x1p-34 * (smaller > 0.0 ? smaller : std::max(far(*a), far(*b))) + 0x1p7 * motion(k).slack();
  }

  SafeTime safe_time(std::uint32_t k, double time, SafeTimeQuestion question) const {
    const auto [a, b] = shapes(scene_, pair(k));
    const LinkageMotion::Instant now = motion(k).at(pair(k), bounds_[k], time);
    question.pose_error = motion(k).slack();
    question.motion = &now.motion;
    return narrowphase::safe_time(*a, now.a, *b, now.b, bounds_[k].rate, question);
  }

 private:
  const LinkPair& pair(std::uint32_t k) const { return scene_.pairs[k % scene_.pairs.size()]; }
  const LinkageMotion& motion(std::uint32_t k) const { return segments_[segment(k)]; }

  const LinkageScene& scene_;
  std::span<const LinkageMotion> segments_;
  std::span<const PairBounds> bounds_;
};

}  // namespace

LinkageAnswer LinkageChecker::check_motion(std::span<const double> from, std::span<const double> to,
                                           const BisectOptions& options) {
  begin();
  add_segment(from, to);
  return named(bisect(LinksInMotion(scene_, {motions_.data(), segments_}, bounds_), options, scratch_));
}

LinkageAnswer LinkageChecker::check_path(std::span<const double> waypoints, const BisectOptions& options) {
  add_path(waypoints);
  return named(bisect(LinksInMotion(scene_, {motions_.data(), segments_}, bounds_), options, scratch_));
}

LinkageAnswer LinkageChecker::check_path(std::span<const double> waypoints, const BisectOptions& options,
                                         std::span<LinkageAnswer> answers) {
  add_path(waypoints);
  answers_.resize(answers.size());
  const PathAnswer worst =
      bisect_all(LinksInMotion(scene_, {motions_.data(), segments_}, bounds_), options, scratch_, answers_);
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = named(answers_[i]);
  return named(worst);
}

void LinkageChecker::begin() {
  segments_ = 0;
  bounds_.clear();
}

void LinkageChecker::add_path(std::span<const double> waypoints) {
  begin();
  const std::size_t size = scene_.linkage.size();
  for (std::size_t i = size; i < waypoints.size(); i += size)
    add_segment(waypoints.subspan(i - size, size), waypoints.subspan(i, size));
}

void LinkageChecker::add_segment(std::span<const double> from, std::span<const double> to) {
  if (segments_ == motions_.size()) motions_.emplace_back();
  LinkageMotion& motion = motions_[segments_++];
  motion.reset(scene_.linkage, from, to);
  for (const LinkPair& pair : scene_.pairs) bounds_.push_back(motion.bounds(pair));
}

LinkageAnswer LinkageChecker::named(const PathAnswer& answer) const {
  LinkageAnswer linkage{answer.verdict,   answer.segment, answer.from,   answer.to,
                        {kWorld, kWorld}, answer.part_a,  answer.part_b, answer.evaluations};
  if (answer.verdict != Verdict::free) linkage.pair = scene_.pairs[answer.pair % scene_.pairs.size()];
  return linkage;
}

}  // namespace throng::narrowphase
