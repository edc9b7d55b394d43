// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "narrowphase/manifold.h"
#include "sim/contact/contact.h"
#include "sim/contact/look_ahead.h"
#include "sim/contact/touch.h"
#include "sim/plan.h"

namespace throng {

/// Fills `points` by those of a touch's manifold as the solver knows them, without impulses, and returns
/// them. `meeting`: where the manifold was found; null as the step begins, which lasts for `dt` (s).
std::span<PointContact> describe_face(const StepStart& start, const Touch& touch, const Surface& surface,
                                      const narrowphase::Manifold& m, const LookAhead::Meeting* meeting,
                                      double dt, std::array<PointContact, 2>& points);

}  // namespace throng
