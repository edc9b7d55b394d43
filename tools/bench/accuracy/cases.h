// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/bench/accuracy/judge.h"

/// The scenes of the laboratory, each with what it is held against.
namespace throng::bench {

struct AccuracyCase {
  const char* name;
  const char* what;   ///< is played, and what is exact; a sentence or two for people
  const char* error;  ///< what its error is, and in which unit
  const char* scene;  ///< file in scenes/
  std::vector<std::string> overrides = {};
  std::vector<double> dts;                   ///< s, the longest first; --quick takes three of them
  JudgeMaker (*judges)(const Scene& scene);  ///< called once a case; may compute what is exact
  bool heavy = false;                        ///< --quick plays a tenth of its time
  bool smooth = false;    ///< nothing hard collides on the way: errors show the order of the integrator
  bool instant = false;   ///< collisions are counted, as those are that take no time
  bool promised = true;   ///< its error is what dt = "auto" promises, where it promises anything
  std::size_t knobs = 3;  ///< of how many of its knobs' settings each engine is seen at
};

std::span<const AccuracyCase> flight_cases();     ///< what nothing touches
std::span<const AccuracyCase> contact_cases();    ///< what bounces, rolls and slides on a floor
std::span<const AccuracyCase> collision_cases();  ///< what collides and flies on
std::span<const AccuracyCase> spring_cases();     ///< what gives way where it touches
std::span<const AccuracyCase> still_cases();      ///< what stands, and what settles
std::span<const AccuracyCase> gas_cases();        ///< what flies and collides in crowds

/// The error of most cases.
inline constexpr const char* kOffTrajectory = "distance to the exact trajectory, radii";

/// `count` steps (s), each half as long as the one before.
std::vector<double> halvings(double longest, int count);

/// Judges by the trajectory error at the times k * every (s).
JudgeMaker by_trajectory(Truth truth, double every, bool turns = true);

}  // namespace throng::bench
