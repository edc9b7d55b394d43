// SPDX-License-Identifier: MIT
// No missed hit and no false "free", over random motions of every kind: some thousand of each, with
// THRONG_FULL=1 in the environment a million. The truth comes from samples of the exact distance, refined
// where it is least, and from motions that are made to pass or to meet by a known margin.
#include <gtest/gtest.h>

#include "narrowphase/exhaustive.h"
#include "narrowphase/motion/check_motion.h"
#include "narrowphase/motion/first_contact.h"
#include "narrowphase/nearest_parts.h"
#include "random_trials.h"
#include "tests/full_length.h"

namespace throng::narrowphase::soundness {
namespace {

double gap(const Trial& trial, double time) {
  const Pose a = pose_at(trial.a.motion, time), b = pose_at(trial.b.motion, time);
  if (trial.a.parts.size() == 1 && trial.b.parts.size() == 1)
    return separation(trial.a.parts[0], a, trial.b.parts[0], b).distance;
  return separation(trial.a.parts, a, trial.b.parts, b).distance;
}

/// By the definition, in long double.
double exact_gap(const Trial& trial, double time) {
  double least = std::numeric_limits<double>::infinity();
  for (const Convex& p : trial.a.parts)
    for (const Convex& q : trial.b.parts)
      least = std::min(
          least,
          exhaustive_separation(p, pose_at(trial.a.motion, time), q, pose_at(trial.b.motion, time)).distance);
  return least;
}

/// The least of the samples from time 0 to `until`, and of a golden section around it.
double least_gap(const Trial& trial, double until, int samples) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= samples; ++i)
    if (const double g = gap(trial, until * i / samples); g < least) least = g, best = i;
  double from = until * std::max(0, best - 1) / samples, to = until * std::min(samples, best + 1) / samples;
  const double golden = 0.6180339887498949;
  for (int i = 0; i < 24; ++i) {
    const double p = to - golden * (to - from), q = from + golden * (to - from);
    const double at_p = gap(trial, p), at_q = gap(trial, q);
    least = std::min({least, at_p, at_q});
    (at_p < at_q ? to : from) = at_p < at_q ? q : p;
  }
  return least;
}

struct Tally {
  int trials = 0, hits = 0, undecided = 0;
};

/// What is wrong with the answers, in words; nothing if they are sound.
class Judge {
 public:
  explicit Judge(const Trial& trial) : trial_(trial), least_(least_gap(trial, 1.0, 24)) {
    if (trial.margin) least_ = std::min(least_, *trial.margin);
  }

  std::string of(const PathAnswer& answer) const {
    if (answer.verdict == Verdict::free && meets()) return "free, and they meet";
    if (answer.verdict == Verdict::hit && exact_gap(trial_, answer.from) > trial_.rounding())
      return "a hit at " + std::to_string(answer.from) + ", where they are apart";
    if (answer.verdict == Verdict::hit && passes()) return "a hit, and they pass";
    if (answer.verdict == Verdict::undecided && std::abs(least_) > trial_.doubtful())
      return "undecided, with a gap of " + std::to_string(least_);
    return {};
  }

  std::string of(const FirstContact& contact) const {
    if (contact.verdict == Verdict::free && meets()) return "never a contact, and they meet";
    if (contact.verdict == Verdict::hit && exact_gap(trial_, contact.t_hi) > trial_.rounding())
      return "a contact at " + std::to_string(contact.t_hi) + ", where they are apart";
    if (contact.t_lo > 0.0 && least_gap(trial_, contact.t_lo, 12) < -trial_.rounding())
      return "nothing before " + std::to_string(contact.t_lo) + ", and they meet";
    const bool gave_up = contact.evaluations >= ContactQuestion{}.evaluations;
    if (contact.verdict == Verdict::undecided && !gave_up && std::abs(least_) > trial_.doubtful() &&
        std::abs(gap(trial_, contact.t_lo)) > trial_.doubtful())
      return "a contact undecided, with a gap of " + std::to_string(least_);
    return {};
  }

 private:
  bool meets() const { return least_ < -trial_.rounding(); }
  bool passes() const { return trial_.margin && *trial_.margin > trial_.rounding(); }

  const Trial& trial_;
  double least_;
};

using AskPath = PathAnswer (*)(const Trial& trial, BisectScratch& scratch);

PathAnswer ask_parts(const Trial& trial, BisectScratch& scratch) {
  const PartsBvh a = parts_bvh(trial.a.parts), b = parts_bvh(trial.b.parts);
  return check_motion(a, trial.a.motion, b, trial.b.motion, 1.0, {}, scratch);
}

template <class Volume>
PathAnswer ask_outlines(const Trial& trial, BisectScratch& scratch) {
  const auto a = outline<Volume>(std::span(&trial.a.ring, 1)),
             b = outline<Volume>(std::span(&trial.b.ring, 1));
  return check_motion(a, trial.a.motion, b, trial.b.motion, 1.0, {}, scratch);
}

std::string contradiction(const Trial& trial, AskPath ask, Tally& tally, BisectScratch& scratch) {
  const PathAnswer answer = ask(trial, scratch);
  ++tally.trials, tally.hits += answer.verdict == Verdict::hit;
  tally.undecided += answer.verdict == Verdict::undecided;
  const Judge judge(trial);
  if (const std::string fault = judge.of(answer); !fault.empty()) return fault;
  if (trial.a.parts.size() + trial.b.parts.size() > 2) return {};
  const FirstContact contact =
      first_contact(trial.a.parts[0], trial.a.motion, trial.b.parts[0], trial.b.motion, 1.0);
  if (const std::string fault = judge.of(contact); !fault.empty()) return fault;
  const bool at_odds = (answer.verdict == Verdict::free && contact.verdict == Verdict::hit) ||
                       (answer.verdict == Verdict::hit && contact.verdict == Verdict::free);
  return at_odds ? "bisection and advancement contradict each other" : "";
}

struct Kind {
  const char* name;
  Trial (*make)(Random&);
  int trials;  ///< of the short form
  AskPath ask = ask_parts;
};

class Soundness : public ::testing::TestWithParam<Kind> {};

TEST_P(Soundness, NoHitIsMissedAndNothingIsCalledFreeThatIsNot) {
  const int trials = full_length() ? 1000000 : GetParam().trials;
  constexpr std::uint64_t kSeed = 20261121;
  Random random(kSeed);
  Tally tally;
  BisectScratch scratch;
  int faults = 0;
  for (int i = 0; i < trials && faults < 5; ++i) {
    const Trial trial = GetParam().make(random);
    const std::string fault = contradiction(trial, GetParam().ask, tally, scratch);
    if (fault.empty()) continue;
    ++faults;
    ADD_FAILURE() << GetParam().name << ", seed " << kSeed << ", trial " << i << ": " << fault << "; margin "
                  << trial.margin.value_or(0.0) << ", size " << trial.size;
  }
  RecordProperty("hits", tally.hits), RecordProperty("undecided", tally.undecided);
  EXPECT_GT(tally.hits, 0.25 * tally.trials) << "the sample is representative";
  EXPECT_LT(tally.hits, 0.75 * tally.trials) << "the sample is representative";
}

INSTANTIATE_TEST_SUITE_P(
    OfMotions, Soundness,
    ::testing::Values(Kind{"discs", discs, 3000}, Kind{"capsules", capsules, 3000},
                      Kind{"octagons", octagons, 3000}, Kind{"any_convex", any_convex, 3000},
                      Kind{"unions", unions, 1000}, Kind{"translations", translations, 1500},
                      Kind{"rotations", rotations, 1500}, Kind{"fast_spins", fast_spins, 1000},
                      Kind{"scales", scales, 1500}, Kind{"far_away", far_away, 1500},
                      Kind{"grazing_bars", grazing_bars, 3000}, Kind{"grazing_rounds", grazing_rounds, 3000},
                      Kind{"grazing_corners", grazing_corners, 3000},
                      Kind{"outlines_in_balls", outlines, 300, ask_outlines<Ball<2>>},
                      Kind{"outlines_in_boxes", outlines, 300, ask_outlines<Box<2>>},
                      Kind{"outlines_in_oriented_boxes", outlines, 300, ask_outlines<OrientedBox<2>>},
                      Kind{"outlines_in_boxes_and_balls", outlines, 300, ask_outlines<BoxAndBall<2>>},
                      Kind{"grazing_outlines", grazing_outlines, 3000, ask_outlines<BoxAndBall<2>>}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace throng::narrowphase::soundness
