// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tools/bench/motion_cases.h"

namespace throng::bench {

/// Box2D 2.4.1's b2TimeOfImpact, in single precision. Polygons of up to eight corners, in one part.
class Box2dImpact {
 public:
  enum class State { separated, touching, failed };
  struct Impact {
    State state;
    double time;
  };

  static bool fits(const MotionCase& c);
  explicit Box2dImpact(const MotionCase& c);
  ~Box2dImpact();

  Impact ask(std::size_t query) const;

 private:
  struct Inputs;
  std::unique_ptr<Inputs> inputs_;
};

}  // namespace throng::bench
