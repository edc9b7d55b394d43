// SPDX-License-Identifier: MIT
#include "tools/motion_clearance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "sim/input_error.h"
#include "tools/answer_json.h"

namespace throng::tools {

namespace {

using narrowphase::LinkageAnswer;
using narrowphase::LinkageChecker;
using narrowphase::LinkContact;
using narrowphase::Verdict;
using Json = nlohmann::ordered_json;

constexpr double kPrecision = 1e-3;   // of the clearance, how far apart both ends of the bracket may be
constexpr std::size_t kLooks = 1024;  // at most, all along the path; and
constexpr std::size_t kLooksASegment = 64;
constexpr std::size_t kMostDistances = 1'000'000;  // of all looks, whatever the pairs
constexpr int kSections = 40;                      // of the golden section, round a place that is near
constexpr int kBoldRounds = 8;                     // that ask just below what was found; then halves
constexpr int kMostRounds = 100;                   // 2^-92 of the first distance

class ClearanceSearch {
 public:
  ClearanceSearch(const MotionTask& task, double low, double epsilon)
      : task_(task),
        system_(task, 0.0, MotionSystem::Pairs::all),
        checker_(system_.scene()),
        epsilon_(epsilon),
        low_(low) {}

  std::optional<MotionClearance> run() {
    if (system_.scene().pairs.empty()) return std::nullopt;
    look_everywhere();
    if (!is_narrow()) prove();
    assert(low_ <= high_ + system_.rounding());
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
    std::size_t steps =
        std::min({kLooks, kLooksASegment * segments, kMostDistances / system_.scene().pairs.size()});
    steps = steps < segments ? std::max<std::size_t>(steps, 1) : steps - steps % segments;  // each waypoint
    for (std::size_t k = 0; k <= steps; ++k) {
      const std::size_t segment = std::min(k * segments / steps, segments - 1);
      look(segment, static_cast<double>(k * segments - segment * steps) / static_cast<double>(steps));
    }
    descend(static_cast<double>(segments) / static_cast<double>(steps));
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

  /// The least margin that isn't free, or may not be.
  double upper() const { return std::min(high_, doubtful_); }

  bool is_narrow() const { return !(upper() - low_ > kPrecision * upper()); }

  void prove() {
    std::optional<MotionSystem> grown;
    try {
      grown.emplace(task_, high_);  // what is out of reach there is so at each lesser margin
    } catch (const InputError&) {
      return;  // too many pairs: what is proven stands
    }
    for (int round = 0; round < kMostRounds && !is_narrow(); ++round) {
      const bool bold = round < kBoldRounds && high_ <= doubtful_;
      const double margin = bold ? (1.0 - 0.5 * kPrecision) * high_ : 0.5 * (low_ + upper());
      if (!(low_ < margin && margin < upper())) return;
      grown->grow(margin);
      ask(*grown, margin);
    }
  }

  /// Whether anything comes as near as `margin`.
  void ask(const MotionSystem& grown, double margin) {
    LinkageChecker checker(grown.scene());
    const LinkageAnswer found = checker.check_path(grown.path(), {epsilon_});
    evaluations_ += found.evaluations;
    if (found.verdict == Verdict::free)
      low_ = margin;
    else if (found.verdict == Verdict::undecided || !go_nearer(found))
      doubtful_ = margin;
  }

  bool go_nearer(const LinkageAnswer& hit) {
    const double before = high_;
    const LinkContact contact{hit.pair, hit.part_a, hit.part_b,
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
  double doubtful_ = std::numeric_limits<double>::infinity();  // the least margin left undecided
  MotionDistance nearest_;
  std::size_t evaluations_ = 0;
};

Json points(const narrowphase::Separation& separation) {
  return {json(separation.point_a), json(separation.point_b)};
}

}  // namespace

std::optional<MotionDistance> nearest_at(const MotionTask& task, std::size_t waypoint) {
  const MotionSystem system(task, 0.0, MotionSystem::Pairs::all);
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
