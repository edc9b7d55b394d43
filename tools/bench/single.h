// SPDX-License-Identifier: MIT
#pragma once

#include <box2d/b2_math.h>

#include "narrowphase/convex.h"

namespace throng::bench {

/// As Box2D wants it, in single precision.
inline b2Vec2 single(const narrowphase::Vec& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

inline b2Transform single(const narrowphase::Pose& pose) {
  b2Transform t;
  t.p = single(pose.position), t.q.c = static_cast<float>(pose.cos), t.q.s = static_cast<float>(pose.sin);
  return t;
}

}  // namespace throng::bench
