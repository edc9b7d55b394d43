// SPDX-License-Identifier: MIT
// No missed hit and no false "free", over random motions of every kind: some thousand of each, with
// THRONG_FULL=1 in the environment a million. The truth comes from samples of the exact distance, refined
// where it is least, and from motions that are made to pass or to meet by a known margin.
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <optional>

#include "narrowphase/exhaustive.h"
#include "narrowphase/motion/check_motion.h"
#include "narrowphase/motion/first_contact.h"
#include "narrowphase/nearest_parts.h"
#include "tests/narrowphase/random_shapes.h"

namespace throng::narrowphase {
namespace {

constexpr double kPi = std::numbers::pi;

struct Body {
  std::vector<Convex> parts;
  Motion motion;
};

/// Two bodies from time 0 to 1.
struct Trial {
  Body a, b;
  double size = 1.0;               ///< m, of the shapes
  double world = 10.0;             ///< m, of the coordinates
  std::optional<double> margin{};  ///< m, by which they are made to pass, or below 0 to meet

  double rounding() const { return 1e-12 * size + 2e-15 * world; }
  /// Below it "undecided" will do.
  double doubtful() const { return 1e-9 * size + 0x1p-42 * world; }
};

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

std::string contradiction(const Trial& trial, Tally& tally, BisectScratch& scratch) {
  const PartsBvh a = parts_bvh(trial.a.parts), b = parts_bvh(trial.b.parts);
  const PathAnswer answer = check_motion(a, trial.a.motion, b, trial.b.motion, 1.0, {}, scratch);
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

// The kinds of motions.

Convex octagon(Random& random, double radius) {
  std::vector<Vec> vertices;
  for (int i = 0; i < 8; ++i)
    vertices.push_back(pose({0, 0}, 2.0 * kPi * (i + uniform(random, 0.0, 0.7)) / 8.0).rotate({radius, 0.0}));
  return convex(hull(vertices));
}

/// b goes past a, within a size or so: about half of them meet.
void set_passing(Random& random, Trial& t, double spin, double far_aside = 2.5) {
  const Pose from = pose({0, 0}, uniform(random, -kPi, kPi));
  const Vec drift = random_vec(random, 1.0, 1.0), home = random_vec(random, 3.0, 3.0);
  const double away = uniform(random, 2.5, 5.0), aside = uniform(random, -far_aside, far_aside);
  const double way = uniform(random, 2.0, 8.0);
  const double angle_a = uniform(random, -kPi, kPi), angle_b = uniform(random, -kPi, kPi);
  const double spin_a = uniform(random, -spin, spin), spin_b = uniform(random, -spin, spin);
  t.a.motion = {home, angle_a, drift, spin_a};
  t.b.motion = {home + from.rotate({away, aside}), angle_b, drift - from.rotate({way, 0.0}), spin_b};
}

Trial discs(Random& random) {
  Trial t;
  const double p = uniform(random, 0.1, 1.2), q = uniform(random, 0.1, 1.2);
  const Vec off = random() % 2 ? Vec{0.0, 0.0} : random_vec(random, 0.5, 0.5);
  t.a.parts = {disc(p)}, t.b.parts = {disc(q, off)};
  set_passing(random, t, 3.0);
  return t;
}

Trial capsules(Random& random) {
  Trial t;
  for (Body* body : {&t.a, &t.b}) {
    const Vec p = random_vec(random, 1.0, 1.0), q = random_vec(random, 1.0, 1.0);
    body->parts = {segment(p, q, uniform(random, 0.01, 0.4))};
  }
  set_passing(random, t, 3.0);
  return t;
}

Trial octagons(Random& random) {
  Trial t;
  t.a.parts = {octagon(random, 1.0)}, t.b.parts = {octagon(random, 1.0)};
  set_passing(random, t, 3.0);
  return t;
}

Trial any_convex(Random& random) {
  Trial t;
  t.a.parts = {random_shape(random, 1.0)}, t.b.parts = {random_shape(random, 1.0)};
  set_passing(random, t, 3.0);
  return t;
}

Trial unions(Random& random) {
  Trial t;
  for (Body* body : {&t.a, &t.b})
    for (std::size_t parts = 2 + random() % 3; body->parts.size() < parts;) {
      Convex part = random_shape(random, 1.0);
      const Vec by = random_vec(random, 0.8, 0.8);
      for (Vec& v : part.vertices) v = 0.5 * v + by;
      body->parts.push_back(convex(hull(part.vertices), 0.5 * part.radius));
    }
  set_passing(random, t, 3.0);
  return t;
}

Trial translations(Random& random) {
  Trial t = random() % 2 ? octagons(random) : unions(random);
  t.a.motion.spin = t.b.motion.spin = 0.0;
  return t;
}

Trial rotations(Random& random) {
  Trial t = random() % 2 ? octagons(random) : unions(random);
  t.a.motion.velocity = t.b.motion.velocity = {0.0, 0.0};
  const Pose side = pose({0, 0}, uniform(random, -kPi, kPi));
  t.b.motion.position = t.a.motion.position + side.rotate({uniform(random, 1.5, 2.6), 0.0});
  return t;
}

Trial fast_spins(Random& random) {
  Trial t = any_convex(random);
  set_passing(random, t, std::pow(10.0, uniform(random, 1.0, 3.0)), 4.0);
  return t;
}

/// All lengths by a factor.
Trial scaled(Trial t, double factor) {
  for (Body* body : {&t.a, &t.b}) {
    for (Convex& part : body->parts) part = scaled(part, factor);
    body->motion.position *= factor, body->motion.velocity *= factor;
  }
  t.size *= factor, t.world *= factor;
  if (t.margin) *t.margin *= factor;
  return t;
}

Trial scales(Random& random) {
  Trial t = random() % 2 ? any_convex(random) : unions(random);
  return scaled(std::move(t), std::pow(10.0, uniform(random, -6.0, 6.0)));
}

Trial far_away(Random& random) {
  Trial t = random() % 2 ? any_convex(random) : unions(random);
  const double far = std::pow(10.0, uniform(random, 2.0, 6.0));
  const Vec offset = random_vec(random, far, far);
  t.a.motion.position += offset, t.b.motion.position += offset;
  t.world = 2.0 * far;
  return t;
}

/// From 1e-9 to 1, either sign.
double margin(Random& random) {
  const double size = std::pow(10.0, uniform(random, -8.7, 0.0));
  return random() % 2 ? size : -0.3 * size;
}

void set_elsewhere(Random& random, Trial& t) {
  const double turn = uniform(random, -kPi, kPi);
  const Pose world = pose(random_vec(random, 3.0, 3.0), turn);
  const Vec drift = random_vec(random, 0.5, 0.5);
  for (Body* body : {&t.a, &t.b}) {
    Motion& m = body->motion;
    m = {world * m.position, m.angle + turn, world.rotate(m.velocity) + drift, m.spin};
  }
}

/// The short end of a bar turns past the flat side of a post.
Trial grazing_bars(Random& random) {
  Trial t;
  t.margin = margin(random);
  const double from = Vec(1.0, 0.1).norm() + *t.margin, turn = random() % 2 ? 1.0 : -1.0;
  t.a.parts = {convex({{-3.0, -0.1}, {1.0, -0.1}, {1.0, 0.1}, {-3.0, 0.1}})};
  t.b.parts = {convex({{from, -0.5}, {from + 1.0, -0.5}, {from + 1.0, 0.5}, {from, 0.5}})};
  t.a.motion = {{0.0, 0.0}, uniform(random, -1.9, -1.6) * turn, {0.0, 0.0}, 3.5 * turn};
  set_elsewhere(random, t);
  return t;
}

/// Discs and capsules side by side.
Trial grazing_rounds(Random& random) {
  Trial t;
  t.margin = margin(random);
  const double p = uniform(random, 0.5, 1.0), q = uniform(random, 0.5, 1.0);
  const double start = uniform(random, 4.0, 6.0);
  t.a.parts = {disc(p)};
  t.b.parts = {random() % 2 ? disc(q) : segment({-0.4, 0.0}, {0.4, 0.0}, q)};
  t.b.motion = {{start, p + q + *t.margin}, 0.0, {-10.0, 0.0}, 0.0};
  if (t.b.parts[0].vertices.size() == 1) t.b.motion.spin = uniform(random, -9.0, 9.0);
  set_elsewhere(random, t);
  return t;
}

/// A corner goes along a wall, straight or while its body turns about it.
Trial grazing_corners(Random& random) {
  Trial t;
  t.margin = margin(random);
  t.a.parts = {convex({{-9.0, -1.0}, {9.0, -1.0}, {9.0, 0.0}, {-9.0, 0.0}})};
  t.b.parts = {convex({{0.0, 0.0}, {0.8, 1.0}, {-0.8, 1.0}})};
  t.b.motion = {{-2.0, *t.margin}, -0.4, {uniform(random, 1.0, 4.0), 0.0}, random() % 2 ? 0.8 : 0.0};
  set_elsewhere(random, t);
  return t;
}

struct Kind {
  const char* name;
  Trial (*make)(Random&);
  int trials;  ///< of the short form
};

class Soundness : public ::testing::TestWithParam<Kind> {};

TEST_P(Soundness, NoHitIsMissedAndNothingIsCalledFreeThatIsNot) {
  const char* full = std::getenv("THRONG_FULL");
  const int trials = full != nullptr && full[0] == '1' ? 1000000 : GetParam().trials;
  constexpr std::uint64_t kSeed = 20261121;
  Random random(kSeed);
  Tally tally;
  BisectScratch scratch;
  int faults = 0;
  for (int i = 0; i < trials && faults < 5; ++i) {
    const Trial trial = GetParam().make(random);
    const std::string fault = contradiction(trial, tally, scratch);
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
                      Kind{"grazing_corners", grazing_corners, 3000}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace throng::narrowphase
