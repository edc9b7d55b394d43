// SPDX-License-Identifier: MIT
#include "scenarios/distribution.h"

#include <algorithm>
#include <cmath>

#include "scenarios/read.h"
#include "sim/crowd/exponential.h"

namespace throng::scenarios {

namespace {

constexpr int kMostDraws = 1000;
constexpr double kWidest = 1e6;  // means: of a lognormal distribution's standard deviation
/// Standard deviations: a cut nearer to the mean takes more than 7 % of the draws, and moves it by 14 % of
/// one.
constexpr double kNoticed = 1.5;
constexpr double kCutOff = 3.0;  // standard deviations, of a normal distribution without cut-offs of its own

/// With this mean and standard deviation, of the number itself.
double draw_lognormal(double mean, double deviation, Random& random) {
  const double ratio = deviation / mean, variance = logarithm(1.0 + ratio * ratio);
  return mean * exponential(std::sqrt(variance) * random.normal() - 0.5 * variance);
}

double draw_once(const Distribution& d, Random& random) {
  switch (d.kind) {
    case Distribution::Kind::uniform:
      return random.uniform(d.a, d.b);
    case Distribution::Kind::normal:
      return d.a + d.b * random.normal();
    case Distribution::Kind::lognormal:
      return draw_lognormal(d.a, d.b, random);
    case Distribution::Kind::fixed:
      break;
  }
  return d.a;
}

Distribution from_table(const toml::table& table) {
  Distribution result;
  for (const auto& [key, kind] : {std::pair{"uniform", Distribution::Kind::uniform},
                                  {"normal", Distribution::Kind::normal},
                                  {"lognormal", Distribution::Kind::lognormal}})
    if (const toml::node* node = table.get(key)) {
      const Vec numbers = point(*node);
      result = {kind, numbers.x(), numbers.y(), 0.0, 0.0};
    }
  return result;
}

/// The logarithm of a number with no mean above 0 has no mean.
bool is_lognormal(const Distribution& d) {
  return d.a > 0.0 && d.b <= kWidest * d.a;
}

}  // namespace

Distribution read_distribution(const toml::node& node, double least, double most, const std::string& path,
                               Report& report) {
  if (!node.is_table()) return {Distribution::Kind::fixed, number(node), 0.0, least, most};
  const toml::table& table = *node.as_table();
  Distribution result = from_table(table);
  const double spread = result.kind == Distribution::Kind::normal ? kCutOff * result.b : most;
  result.low = std::max(least, result.a - spread), result.high = std::min(most, result.a + spread);
  if (result.kind == Distribution::Kind::uniform) {
    result.low = result.a, result.high = result.b;
    if (table.contains("within"))
      report.error(node, path, "must have no `within` beside `uniform`, whose bounds are its own");
  } else if (const toml::node* within = table.get("within")) {
    const Vec bounds = point(*within);
    result.low = bounds.x(), result.high = bounds.y();
  }
  if (result.kind == Distribution::Kind::lognormal && !is_lognormal(result))
    report.error(node, path,
                 "must have a mean above 0 and a standard deviation of at most " + to_text(kWidest) +
                     " times the mean, to be lognormal");
  else if (!(result.low <= result.high))
    report.error(node, path, lower_first({result.low, result.high}));
  else if (result.kind != Distribution::Kind::uniform &&
           (result.low > result.a + kCutOff * result.b || result.high < result.a - kCutOff * result.b))
    report.error(node, path,
                 "must have a range `within` that its mean is no more than 3 standard deviations away from");
  else if (result.kind == Distribution::Kind::normal && !table.contains("within") &&
           result.a - kNoticed * result.b < least)
    report.warning(node.source(), path,
                   "is drawn again where it is below " + to_text(least) + ": the mean is above " +
                       to_text(result.a) + "; `within` says what is meant");
  return result;
}

double usual_most(const Distribution& distribution) {
  const auto [kind, a, b, low, high] = distribution;
  return kind == Distribution::Kind::fixed     ? a
         : kind == Distribution::Kind::uniform ? b
                                               : std::min(a + b, high);
}

double usual_least(const Distribution& distribution) {
  const auto [kind, a, b, low, high] = distribution;
  const bool is_spread = kind == Distribution::Kind::normal || kind == Distribution::Kind::lognormal;
  return is_spread ? std::max(a - b, low) : a;
}

double draw(const Distribution& distribution, Random& random) {
  if (distribution.kind == Distribution::Kind::fixed) return distribution.a;
  double x = 0.0;
  for (int i = 0; i < kMostDraws; ++i) {
    x = draw_once(distribution, random);
    if (x >= distribution.low && x <= distribution.high) return x;
  }
  return std::clamp(x, distribution.low, distribution.high);
}

}  // namespace throng::scenarios
