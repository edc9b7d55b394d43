// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "narrowphase/motion/moving_convex_pair.h"

/// The first root of a smooth function of time, certainly (Moore 1966). Its derivative over an interval is
/// enclosed by that in the middle and a bound of the second one: no interval arithmetic of sines is needed.
namespace throng::narrowphase {

struct SlopedValue {
  double value, slope;
};

/// What is to be known of the function besides its values.
struct RootQuestion {
  double bend;              ///< the second derivative is never larger
  double rounding;          ///< the values are no farther from the truth
  double width;             ///< roots are enclosed as narrowly as this, or as `rounding` lets
  int evaluations = 10000;  ///< most; above them what is left is in doubt
};

/// An interval that holds a root, or one where rounding leaves open whether there is one.
struct Root {
  TimeSpan span;
  bool certain;  ///< the sign changes from one end to the other
};

/// Where the tangents of all slopes from the middle of `span` meet 0; all of it where some slope is 0.
inline TimeSpan newton(const TimeSpan& span, const SlopedValue& f, const RootQuestion& q) {
  const double middle = 0.5 * (span.from + span.until), slack = q.bend * 0.5 * (span.until - span.from);
  const double flat = std::abs(f.slope) - slack, steep = std::abs(f.slope) + slack;
  if (!(flat > 0.0)) return span;
  const double value = f.slope > 0.0 ? f.value : -f.value;
  const double high = value + q.rounding, low = value - q.rounding;
  return {std::max(span.from, middle - high / (high > 0.0 ? flat : steep)),
          std::min(span.until, middle - low / (low > 0.0 ? steep : flat))};
}

/// A root in `found`, which its signs at the ends show where they are out of rounding's reach.
template <class Function>
Root enclosed(const TimeSpan& span, const TimeSpan& found, const SlopedValue& f, const RootQuestion& q,
              Function function) {
  const double flat = std::abs(f.slope) - q.bend * (found.until - found.from);
  const double room = flat > 0.0 ? std::max(4.0 * q.rounding / flat, 0.25 * q.width) : 0.0;
  const TimeSpan in{std::max(span.from, found.from - room), std::min(span.until, found.until + room)};
  const double before = function(in.from).value, after = function(in.until).value;
  return {in, std::min(before, after) < -q.rounding && std::max(before, after) > q.rounding};
}

/// The first root of `f(time)`, a SlopedValue, in `span` that counts: `counts(time, half)` is false where
/// none does from half before to half after. Halves and tightens, from left to right; nothing is lost but
/// what is proven to have no root, or none that counts. Allocates nothing.
template <class Function, class Counts>
std::optional<Root> first_root(const TimeSpan& span, const RootQuestion& q, Function f, Counts counts) {
  std::array<TimeSpan, 128> later;
  std::size_t waiting = 0;
  int evaluations = 0;
  later[waiting++] = span;
  while (waiting > 0) {
    const TimeSpan now = later[--waiting];
    if (evaluations++ >= q.evaluations) return Root{{now.from, span.until}, false};
    const double length = now.until - now.from, middle = 0.5 * (now.from + now.until);
    const SlopedValue at = f(middle);
    const double half = 0.5 * length;
    if (std::abs(at.value) > std::abs(at.slope) * half + 0.5 * q.bend * half * half + q.rounding) continue;
    const TimeSpan in = newton(now, at, q);
    if (!(in.from <= in.until)) continue;
    const bool tight = in.until - in.from > 0.5 * length;
    if (tight && !counts(middle, half)) continue;
    if (length <= 0.5 * q.width || (tight && waiting + 2 > later.size())) {
      if (counts(middle, half)) return enclosed(span, now, at, q, f);
    } else if (tight) {
      later[waiting++] = {middle, now.until}, later[waiting++] = {now.from, middle};
    } else {
      const double least = std::min(0.5 * q.width, 0.25 * length);  // room for the signs at both ends
      later[waiting++] = {std::max(now.from, in.from - 0.5 * least),
                          std::min(now.until, in.until + 0.5 * least)};
    }
  }
  return {};
}

}  // namespace throng::narrowphase
