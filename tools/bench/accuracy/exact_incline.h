// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/accuracy/body_state.h"

namespace throng::bench {

/// A disc (moment of inertia m r² / 2) that stands on a slope, after t (s). The slope is the x axis, so that
/// `gravity` is g (sin, -cos) of its angle. While its lowest point slips, friction f = mu g cos acts against
/// the slip: a = g sin -+ f, dspin/dt = -+ 2 f / r, until the slip v + spin r is 0. Then it rolls,
/// a = 2/3 g sin, if that takes no more friction than there is: |sin| <= 3 mu cos; else it slips on.
/// Source: Newton and Coulomb; e.g. Chung and Ooi, Granular Matter 13, 643 (2011), on tests of such codes.
BodyState exact_incline(const BodyState& start, const Vec& gravity, double friction, double radius, double t);

/// The same of a block that slides and doesn't turn: it stops after v² / (2 (f -+ g sin)) if friction holds
/// it.
BodyState exact_slide(const BodyState& start, const Vec& gravity, double friction, double t);

}  // namespace throng::bench
