// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/accuracy/body_state.h"

namespace throng::bench {

/// A table without friction: a box for the ball's centre, which is the walls' box less its radius, and maybe
/// a round post in it.
struct Table {
  Vec min, max;             ///< m
  Vec post{0.0, 0.0};       ///< m
  double post_reach = 0.0;  ///< m, its radius and the ball's; 0: there is none
};

/// A ball that is reflected without loss, after t (s). In the plain box by unfolding: the way goes straight
/// through mirror images of the box, each coordinate is a triangle wave. With a post (Sinai 1970) from
/// reflection to reflection in long double: an error grows by the factor 2 l / (r cos) at each reflection
/// from the post, l the way between, so this holds for some ten of them. O(reflections).
BodyState exact_billiard(const BodyState& start, const Table& table, double t);

}  // namespace throng::bench
