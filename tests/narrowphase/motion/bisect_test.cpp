// SPDX-License-Identifier: MIT
#include "narrowphase/motion/bisect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace throng::narrowphase {
namespace {

/// Pairs of which only a distance is known, that changes by at most 1 m/s.
struct Distances {
  struct Pair {
    std::function<double(double)> distance;
    double duration = 1.0;
    std::uint32_t segment = 0;
    double likely = 0.5 * duration;
  };
  std::vector<Pair> pairs;
  std::size_t count = 1;

  std::size_t size() const { return pairs.size(); }
  std::size_t segments() const { return count; }
  std::uint32_t segment(std::uint32_t k) const { return pairs[k].segment; }
  double duration(std::uint32_t k) const { return pairs[k].duration; }
  double likely(std::uint32_t k) const { return pairs[k].likely; }
  double pace(std::uint32_t) const { return 1.0; }
  double resolution(std::uint32_t) const { return 1e-9; }
  SafeTime safe_time(std::uint32_t k, double time, const SafeTimeQuestion&) const {
    const double d = pairs[k].distance(time), lasts = std::max(0.0, d - 1e-15);  // which is rounding
    return d <= 0.0 ? SafeTime{0, 0, true, 7, 8} : SafeTime{lasts, lasts, false, 0, 0};
  }
};

/// Contact at an instant, as far as can be told.
std::function<double(double)> doubt(double at) {
  return [=](double t) { return std::max(1e-300, std::abs(t - at)); };
}

PathAnswer ask(const Distances& pairs, const BisectOptions& options = {}) {
  BisectScratch scratch;
  return bisect(pairs, options, scratch);
}

TEST(Bisect, AsksOnceWhereTheMiddleCoversAll) {
  const PathAnswer answer = ask({{{[](double) { return 0.6; }}}});
  EXPECT_EQ(answer.verdict, Verdict::free);
  EXPECT_EQ(answer.evaluations, 1u);
}

/// A contact from 0.3 to 0.302, of which the middle, the ends and the quarters know nothing.
TEST(Bisect, LooksFirstWhereAContactIsLikely) {
  const auto distance = [](double t) { return std::abs(t - 0.301) - 0.001; };
  const PathAnswer answer = ask({{{distance, 1.0, 0, 0.3015}}});
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_EQ(answer.from, 0.3015);
  EXPECT_EQ(answer.evaluations, 1u);
}

/// A gap of 0.25 s all the way: 0.2 covers the start, the end covers from 0.75, and the middle what is left.
TEST(Bisect, LeavesOutAnEndThatIsCovered) {
  const auto quarter = [](double) { return 0.25; };
  EXPECT_EQ(ask({{{quarter, 1.0, 0, 0.2}}}).evaluations, 3u);
  EXPECT_EQ(ask({{{quarter, 1.0, 0, 0.8}}}).evaluations, 3u);
}

/// Of a contact that only the ends know, whichever is looked at first.
TEST(Bisect, KnowsBothEndsWhereverItBegins) {
  for (const double likely : {0.0, 0.4, 1.0})
    for (const double at : {0.0, 1.0}) {
      const PathAnswer answer = ask({{{[at](double t) { return std::abs(t - at); }, 1.0, 0, likely}}});
      EXPECT_EQ(answer.verdict, Verdict::hit) << likely << ", " << at;
      EXPECT_EQ(answer.from, at);
    }
}

/// A gap of 1e-6 all the way takes half a million computations, of which it gets a thousand.
TEST(Bisect, EndsInDoubtWhereItsComputationsAreSpent) {
  BisectOptions options;
  options.evaluations = 1000;
  const PathAnswer answer = ask({{{[](double) { return 1e-6; }}}}, options);
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_LE(answer.evaluations, 1000u);
  EXPECT_LT(answer.from, 1e-5);
}

TEST(Bisect, OfNoPairsIsFree) {
  EXPECT_EQ(ask({}).verdict, Verdict::free);
}

/// The distance halves to 0.2 at 0.3 and grows again: what the neighbourhoods prove covers all of it.
TEST(Bisect, CoversAFreePathWithoutAGap) {
  std::vector<Neighbourhood> covering;
  BisectOptions options;
  options.covering = &covering;
  const auto distance = [](double t) { return 0.02 + std::abs(t - 0.3); };
  const PathAnswer answer = ask({{{distance}}}, options);
  EXPECT_EQ(answer.verdict, Verdict::free);
  EXPECT_EQ(answer.evaluations, covering.size());
  double until = 0.0;
  for (std::size_t grown = 1; grown > 0;) {
    grown = 0;
    for (const Neighbourhood& n : covering) {
      EXPECT_NEAR(std::max(0.0, n.time - distance(n.time)), n.from, 1e-12);
      if (n.from <= until && n.to > until) until = n.to, ++grown;
    }
  }
  EXPECT_EQ(until, 1.0);
}

TEST(Bisect, FindsAHitAtTheVeryStartAndTheVeryEnd) {
  for (const double at : {0.0, 1.0}) {
    const PathAnswer answer = ask({{{[=](double t) { return std::abs(t - at); }}}});
    EXPECT_EQ(answer.verdict, Verdict::hit);
    EXPECT_EQ(answer.from, at);
    EXPECT_EQ(answer.to, at);
    EXPECT_EQ(answer.part_a, 7u);
    EXPECT_EQ(answer.part_b, 8u);
  }
}

/// The interval in doubt holds it and is no longer than asked.
TEST(Bisect, SaysWhichIntervalIsInDoubt) {
  for (const double epsilon : {0.0, 1e-6, 1e-3}) {
    BisectOptions options;
    options.epsilon = epsilon;
    const PathAnswer answer = ask({{{doubt(M_PI / 10)}}}, options);
    EXPECT_EQ(answer.verdict, Verdict::undecided);
    EXPECT_LE(answer.from, M_PI / 10);
    EXPECT_GE(answer.to, M_PI / 10);
    EXPECT_LE(answer.to - answer.from, std::max(1e-9, epsilon));
    EXPECT_LT(answer.evaluations, 100u);
  }
}

/// Strangers that a release build lets in: the pair's resolution is the least all the same.
TEST(Bisect, EndsAlsoForAnEpsilonThatIsNoNumber) {
  BisectOptions options;
  options.epsilon = std::numeric_limits<double>::quiet_NaN();
  PathAnswer answer;
  answer.verdict = Verdict::undecided;
  EXPECT_DEBUG_DEATH(answer = ask({{{doubt(M_PI / 10)}}}, options), "epsilon");
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_LT(answer.evaluations, 100u);
}

TEST(Bisect, DoubtsAtOnceAboveAnInfiniteEpsilonAndYetTellsAHit) {
  BisectOptions options;
  options.epsilon = std::numeric_limits<double>::infinity();
  const PathAnswer near = ask({{{doubt(M_PI / 10)}}}, options);
  EXPECT_EQ(near.verdict, Verdict::undecided);
  EXPECT_LT(near.evaluations, 10u);
  EXPECT_EQ(ask({{{[](double) { return 0.6; }}}}, options).verdict, Verdict::free);
  EXPECT_EQ(ask({{{[](double) { return -1.0; }}}}, options).verdict, Verdict::hit);
}

/// Half of forever is forever, where nobody knows what distances are.
TEST(Bisect, EndsAlsoForAPathWithoutEnd) {
  PathAnswer answer;
  answer.verdict = Verdict::undecided;
  const auto lost = [](double t) { return t > 1e308 ? 1e-300 : 1.0; };
  EXPECT_DEBUG_DEATH(answer = ask({{{lost, std::numeric_limits<double>::infinity()}}}), "duration");
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_LT(answer.evaluations, 2000u);
}

/// On whichever side of the last computation it lies.
TEST(Bisect, HoldsTheDoubtInItsInterval) {
  BisectOptions options;
  options.epsilon = 1e-3;
  for (int i = 1; i < 1000; ++i) {
    const PathAnswer answer = ask({{{doubt(i * 1e-3)}}}, options);
    EXPECT_LE(answer.from, i * 1e-3);
    EXPECT_GE(answer.to, i * 1e-3);
  }
}

TEST(Bisect, DecidesAboveEpsilonAlways) {
  BisectOptions options;
  options.epsilon = 1e-3;
  for (int i = 0; i < 1000; ++i) {
    const double at = i * 1e-3, clearance = 0.5e-3 * (1.0 + 1e-9);
    EXPECT_EQ(ask({{{[=](double t) { return clearance + std::abs(t - at); }}}}, options).verdict,
              Verdict::free);
  }
}

TEST(Bisect, PrefersAHitElsewhereToADoubt) {
  const auto hit = [](double t) { return std::abs(t - 0.7) - 1e-5; };
  for (const bool hit_first : {false, true}) {
    Distances both{{{doubt(M_PI / 10)}, {hit}}};
    if (hit_first) std::swap(both.pairs[0], both.pairs[1]);
    const PathAnswer answer = ask(both);
    EXPECT_EQ(answer.verdict, Verdict::hit);
    EXPECT_EQ(answer.pair, hit_first ? 0u : 1u);
    EXPECT_NEAR(answer.from, 0.7, 1e-5);
  }
}

TEST(Bisect, TellsTheFirstDoubtOfAll) {
  const PathAnswer answer = ask({{{doubt(0.71)}, {doubt(0.23)}, {doubt(0.57)}}});
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_EQ(answer.pair, 1u);
  EXPECT_NEAR(answer.from, 0.23, 1e-8);
}

/// Nothing can be proven anywhere: it gives up soon, and the doubt is about all of it.
TEST(Bisect, GivesUpOnAPathThatIsAllContact) {
  const PathAnswer answer = ask({{{[](double) { return 1e-300; }}}});
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_EQ(answer.from, 0.0);
  EXPECT_EQ(answer.to, 1.0);
  EXPECT_LT(answer.evaluations, 1100u);
}

TEST(Bisect, OfAnInstantIsWhatItsDistanceSays) {
  const auto verdict = [](double distance) {
    return ask({{{[=](double) { return distance; }, 0.0}}}).verdict;
  };
  EXPECT_EQ(verdict(1.0), Verdict::free);
  EXPECT_EQ(verdict(0.0), Verdict::hit);
  EXPECT_EQ(verdict(1e-300), Verdict::undecided);
}

TEST(BisectAll, AnswersEverySegmentAndTellsTheWorst) {
  const auto constant = [](double d) { return [=](double) { return d; }; };
  const Distances path{
      {{constant(1), 1, 0}, {constant(1e-300), 1, 1}, {constant(-1), 1, 2}, {constant(1), 1, 2}}, 4};
  BisectScratch scratch;
  std::vector<PathAnswer> answers(4);
  const PathAnswer worst = bisect_all(path, {}, scratch, answers);
  const Verdict expected[] = {Verdict::free, Verdict::undecided, Verdict::hit, Verdict::free};
  for (std::uint32_t s = 0; s < 4; ++s) {
    EXPECT_EQ(answers[s].verdict, expected[s]) << s;
    EXPECT_EQ(answers[s].segment, s);
  }
  EXPECT_EQ(answers[2].pair, 2u);
  EXPECT_EQ(worst.verdict, Verdict::hit);
  EXPECT_EQ(worst.segment, 2u);
}

/// The longest of a hundred comes first, which is the one that collides.
TEST(Bisect, BeginsWithTheLongest) {
  Distances many;
  for (int k = 0; k < 100; ++k)
    many.pairs.push_back({[=](double) { return k == 37 ? -1.0 : 1.0; }, k == 37 ? 3.0 : 2.0});
  EXPECT_EQ(ask(many).evaluations, 1u);
}

/// What `Distances` proves of this is `d` to the bit.
double exactly(double d) {
  return d + 1e-15;
}

TEST(Bisect, OfEqualPairsBeginsWithTheFirst) {
  const std::vector<Distances::Pair> equal(5, {[](double) { return -1.0; }});
  EXPECT_EQ(ask({equal}).pair, 0u);
}

/// Two gaps of one length are left, with a hit in the middle of each.
TEST(Bisect, OfEqualGapsBeginsWithTheEarliest) {
  const auto distance = [](double t) {
    if (t == 0.5) return exactly(0.25);
    return t == 0.0 || t == 1.0 ? exactly(0.125) : 0.0;
  };
  const PathAnswer answer = ask({{{distance}}});
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_EQ(answer.from, 0.1875);
}

/// The first computation says that the pair is in doubt; the hundredth that it hits.
TEST(Bisect, SearchesAPairInDoubtForAHit) {
  const auto distance = [](double t) { return t > 0.7 && t < 0.705 ? 0.0 : 1e-300; };
  const PathAnswer answer = ask({{{distance}}});
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_GT(answer.evaluations, 30u);
}

/// Answers no longer than asked for, as distances of solids are.
struct AsLongAsAsked : Distances {
  SafeTime safe_time(std::uint32_t k, double time, const SafeTimeQuestion& question) const {
    SafeTime safe = Distances::safe_time(k, time, question);
    safe.before = std::min(safe.before, question.before), safe.after = std::min(safe.after, question.after);
    return safe;
  }
};

/// A gap whose ends and middle are rounded is covered by its middle, and no splinter is left.
TEST(Bisect, LeavesNoSplinterBesideWhatIsWanted) {
  for (int i = 1; i <= 1000; ++i) {
    const double duration = 0.7 + i * 1e-3;
    const auto distance = [=](double t) {
      return t == 0.0 || t == duration || t == 0.5 * duration ? 0.1 + i * 1e-5 : 9.0;
    };
    AsLongAsAsked pairs;
    pairs.pairs = {{distance, duration}};
    BisectScratch scratch;
    const PathAnswer answer = bisect(pairs, {}, scratch);
    EXPECT_EQ(answer.verdict, Verdict::free) << i;
    EXPECT_EQ(answer.evaluations, 5u) << i;
  }
}

}  // namespace
}  // namespace throng::narrowphase
