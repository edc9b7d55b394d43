// SPDX-License-Identifier: MIT
#include <cassert>

#include "narrowphase/linkage/links_in_motion.h"

namespace throng::narrowphase {

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
  assert(!beyond_limits(scene_.linkage, from) && !beyond_limits(scene_.linkage, to));
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
