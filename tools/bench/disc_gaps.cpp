// SPDX-License-Identifier: MIT
// The part of throng bench narrowphase that asks about discs: rows of pairs at once, and one by one.
#include "narrowphase/disc_gaps.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "narrowphase/distance.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

constexpr std::size_t kDiscPairs = 512;  // which fit into the first-level cache with their answers
constexpr int kRepeats = 64;
constexpr double kCentreUlp = 4.0 * 0x1p-52;  // m: centres are up to 4 m apart

struct Columns {
  std::vector<double> x, y, radius;

  explicit Columns(std::uint64_t seed) {
    std::mt19937_64 bits(seed);
    const auto uniform = [&](double to) { return to * (static_cast<double>(bits() >> 11) * 0x1p-53); };
    for (std::size_t i = 0; i < kDiscPairs; ++i) {
      x.push_back(uniform(2.8)), y.push_back(uniform(2.8)), radius.push_back(0.2 + uniform(0.8));
    }
  }
  Discs rows() const { return {x, y, radius}; }
};

Row row(const char* engine, const Columns& a, const Columns& b, const std::vector<double>& distance) {
  double most = 0.0;
  for (std::size_t i = 0; i < kDiscPairs; ++i) {
    const long double x = static_cast<long double>(b.x[i]) - a.x[i],
                      y = static_cast<long double>(b.y[i]) - a.y[i];
    const long double exact = std::sqrt(x * x + y * y) - a.radius[i] - b.radius[i];
    most = std::max(most, static_cast<double>(std::abs(distance[i] - exact)));
  }
  Row result{
      "narrowphase",
      "discs, gap and witness",
      engine,
      1,
      {},
      kDiscPairs * kRepeats,
      most <= 4.0 * kCentreUlp ? "distances agree" : "error " + std::to_string(most / kCentreUlp) + " ulp"};
  result.error = {{"max_ulp", most / kCentreUlp}, {"compared", kDiscPairs}};
  return result;
}

}  // namespace

std::vector<Row> bench_disc_gaps(const Options& options) {
  const Columns a(1), b(2);
  std::vector<Convex> shapes_a, shapes_b;
  for (std::size_t i = 0; i < kDiscPairs; ++i)
    shapes_a.push_back(disc(a.radius[i])), shapes_b.push_back(disc(b.radius[i]));
  DiscGaps gaps;
  std::vector<double> one_by_one(kDiscPairs);
  std::vector<Contestant> contestants = {
      {"find_gaps",
       [&] {
         for (int i = 0; i < kRepeats; ++i) find_gaps(a.rows(), b.rows(), gaps);
       }},
      {"separation", [&] {
         for (int i = 0; i < kRepeats; ++i)
           for (std::size_t k = 0; k < kDiscPairs; ++k)
             one_by_one[k] =
                 separation(shapes_a[k], {{a.x[k], a.y[k]}}, shapes_b[k], {{b.x[k], b.y[k]}}).distance;
       }}};
  for (Contestant& one : contestants) one.block();
  std::vector<Row> rows = {row("find_gaps", a, b, gaps.distance), row("separation", a, b, one_by_one)};
  expect_agreement(rows);
  interleave(contestants, options.blocks, kDiscPairs * kRepeats);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].ms = contestants[i].ms;
    rows[i].error["ns"] = 1e6 * median(rows[i].ms);
  }
  return rows;
}

}  // namespace throng::bench
