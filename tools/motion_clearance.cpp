// SPDX-License-Identifier: MIT
#include "tools/motion_clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/answer_json.h"

namespace throng::tools {

namespace {

using narrowphase::LinkageAnswer;
using narrowphase::LinkageChecker;
using narrowphase::LinkContact;
using narrowphase::Verdict;
using Json = nlohmann::ordered_json;

constexpr double kPrecision = 1e-3;     // of the clearance, how far apart both ends of the bracket may be
constexpr std::size_t kSamples = 1024;  // about, of the whole path, but where all pairs' distances
constexpr std::size_t kMostDistances = 1'000'000;  // there were more than these
constexpr int kSections = 40;           // of the golden section, round a place that is near
constexpr int kBoldRounds = 8;          // that ask just below what was found; then halves
constexpr int kMostRounds = 100;        // 2^-92 of the first distance

class ClearanceSearch {
 public:
  ClearanceSearch(const MotionTask& task, double low, double epsilon)
      : task_(task), system_(task, 0.0), checker_(system_.scene()), epsilon_(epsilon), low_(low) {}

  std::optional<MotionClearance> run() {
    if (system_.scene().pairs.empty()) return std::nullopt;
    look_everywhere();
    for (int round = 0; round < kMostRounds && high_ - low_ > kPrecision * high_; ++round)
      if (!ask(round < kBoldRounds ? (1.0 - 0.5 * kPrecision) * high_ : 0.5 * (low_ + high_))) break;
    return MotionClearance{std::min(low_, high_), nearest_, evaluations_};
  }

 private:
  /// Of all pairs, in m.
  double look(std::size_t segment, double fraction) {
    evaluations_ += system_.scene().pairs.size();
    return keep(*checker_.nearest(system_.values(segment, fraction)), segment, fraction);
  }

  /// Remembers it where it is the nearest so far.
  double keep(const LinkContact& contact, std::size_t segment, double fraction) {
    const double distance = contact.separation.distance;
    if (!(distance < high_)) return distance;
    high_ = distance;
    const auto [a, b] = system_.names(contact.pair, contact.part_b);
    nearest_ = {segment, fraction, a, b, contact.separation};
    return distance;
  }

  void look_everywhere() {
    const std::size_t segments = system_.segments();
    const std::size_t samples = std::min(kSamples, kMostDistances / system_.scene().pairs.size());
    const std::size_t each = std::clamp<std::size_t>(samples / segments, 2, 64);
    for (std::size_t segment = 0; segment < segments; ++segment)
      for (std::size_t k = 0; k <= each; ++k)
        look(segment, static_cast<double>(k) / static_cast<double>(each));
    descend(1.0 / static_cast<double>(each));
  }

  /// Round the nearest place so far, as far as `reach` of its segment.
  void descend(double reach) {
    constexpr double kGolden = 0.6180339887498949;
    const std::size_t segment = nearest_.segment;
    double from = std::max(0.0, nearest_.fraction - reach), to = std::min(1.0, nearest_.fraction + reach);
    double left = to - kGolden * (to - from), right = from + kGolden * (to - from);
    double at_left = look(segment, left), at_right = look(segment, right);
    for (int i = 0; i < kSections; ++i)
      if (at_left < at_right) {
        to = right, right = left, at_right = at_left;
        at_left = look(segment, left = to - kGolden * (to - from));
      } else {
        from = left, left = right, at_left = at_right;
        at_right = look(segment, right = from + kGolden * (to - from));
      }
  }

  /// Whether anything comes as near as `margin`. Returns false where the answer is no progress.
  bool ask(double margin) {
    if (!(low_ < margin && margin < high_)) return false;
    const MotionSystem grown(task_, margin);
    LinkageChecker checker(grown.scene());
    const LinkageAnswer found = checker.check_path(grown.path(), {epsilon_});
    evaluations_ += found.evaluations;
    if (found.verdict == Verdict::free) low_ = margin;
    return found.verdict == Verdict::free || (found.verdict == Verdict::hit && go_nearer(found));
  }

  bool go_nearer(const LinkageAnswer& hit) {
    const double before = high_;
    const LinkContact contact{
        hit.pair, hit.part_a, hit.part_b,
        system_.separation(hit.pair, hit.part_a, hit.part_b, hit.segment, hit.to)};
    keep(contact, hit.segment, hit.to);
    if (high_ < before) descend(1.0 / 64);
    return high_ < before;
  }

  const MotionTask& task_;
  const MotionSystem system_;
  LinkageChecker checker_;
  double epsilon_, low_;  // m
  double high_ = std::numeric_limits<double>::infinity();
  MotionDistance nearest_;
  std::size_t evaluations_ = 0;
};

Json points(const narrowphase::Separation& separation) {
  return {json(separation.point_a), json(separation.point_b)};
}

}  // namespace

std::optional<MotionDistance> nearest_at(const MotionTask& task, std::size_t waypoint) {
  const MotionSystem system(task, 0.0);
  const std::size_t segment = std::min(waypoint, system.segments() - 1);
  const auto found = LinkageChecker(system.scene()).nearest(system.waypoint(waypoint));
  if (!found) return std::nullopt;
  const auto [a, b] = system.names(found->pair, found->part_b);
  return MotionDistance{segment, static_cast<double>(waypoint - segment), a, b, found->separation};
}

std::optional<MotionClearance> least_clearance(const MotionTask& task, double low, double epsilon) {
  return ClearanceSearch(task, low, epsilon).run();
}

Json to_json(const MotionDistance& distance) {
  return {{"distance", distance.separation.distance},
          {"pair", {distance.a, distance.b}},
          {"points", points(distance.separation)},
          {"normal", json(distance.separation.normal)}};
}

Json to_json(const MotionClearance& clearance) {
  const MotionDistance& nearest = clearance.nearest;
  return {{"bracket", {clearance.low, nearest.separation.distance}},
          {"segment", nearest.segment},
          {"fraction", nearest.fraction},
          {"pair", {nearest.a, nearest.b}},
          {"points", points(nearest.separation)},
          {"evaluations", clearance.evaluations}};
}

}  // namespace throng::tools
