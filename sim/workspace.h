// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/bounce_queue.h"
#include "sim/contact/candidates.h"
#include "sim/contact/find_contacts.h"
#include "sim/contact/flights.h"
#include "sim/contact/guard.h"
#include "sim/contact/soft_contacts.h"
#include "sim/contact/solve.h"
#include "sim/contact/solver_bodies.h"
#include "sim/contact/step_impulses.h"
#include "sim/contact/unseen.h"
#include "sim/crowd/walk.h"
#include "sim/free_fall.h"
#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/sensing/sensing.h"
#include "sim/sleepers.h"
#include "sim/stage_clock.h"
#include "sim/workers.h"

namespace throng {

/// How long the stages took so far, s.
struct StageTimes {
  double find_pairs = 0.0, collide = 0.0, find_contacts = 0.0, solve = 0.0, store = 0.0;
  double look = 0.0, steer = 0.0, walk = 0.0, measure = 0.0, leave = 0.0, appear = 0.0;  ///< of crowds
  double sleep = 0.0, sense = 0.0;
  StepSampling sampling;  ///< where few bodies are
};

/// What a step needs besides the state and may forget: buffers, and indexes of what never moves. Its parts
/// know each other's places, so it stays where it is.
struct Workspace {
  Workspace(const Scene& scene, const Plan& plan, int threads);
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  Workers workers;
  Candidates candidates;
  std::optional<Guard> guard;  ///< where hard contacts are solved
  Sleepers sleepers;           ///< to be told where `state` isn't what the last step left
  Flights flights;
  SoftContacts soft;
  ContactFinder finder;
  Contacts contacts;
  BounceQueue bounces;
  StepImpulses impulses;
  SolverBodies bodies;  ///< a row per body, and one for all obstacles for each group of contacts
  FreeFall free_fall;
  std::vector<std::uint8_t> pressed;  ///< a buffer of what learns
  Unseen unseen;
  double mean_radius;  ///< m, of what may touch
  SolverSettings solver;
  double ahead = 0.0;  ///< s, for how long discs look ahead in a substep: 0 where nobody gets far
  Walk crowd;
  Sensing sensing;
  StageTimes times;
};

}  // namespace throng
