// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/candidates.h"
#include "sim/contact/find_contacts.h"
#include "sim/contact/flights.h"
#include "sim/contact/guard.h"
#include "sim/contact/soft_contacts.h"
#include "sim/contact/solve.h"
#include "sim/crowd/walk.h"
#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/sensing/sensing.h"
#include "sim/sleepers.h"
#include "sim/state.h"
#include "sim/workers.h"

/// The native fixed-step loop.
namespace throng {

/// How long the stages took so far.
struct StageTimes {
  double find_pairs = 0.0, collide = 0.0, find_contacts = 0.0, solve = 0.0, store = 0.0;  ///< s
  double look = 0.0, steer = 0.0, walk = 0.0, leave = 0.0, appear = 0.0;                  ///< s, of crowds
  double sleep = 0.0, sense = 0.0;                                                        ///< s
  std::int64_t steps = 0;                                                                 ///< begun
};

/// What a step needs besides the state and may forget: buffers, and indexes of what never moves.
struct Workspace {
  Workspace(const Scene& scene, const Plan& plan, int threads);

  Workers workers;
  Candidates candidates;
  Guard guard;
  Sleepers sleepers;  ///< to be told where `state` isn't what the last step left
  Flights flights;
  SoftContacts soft;
  ContactFinder finder;
  Contacts contacts;
  std::vector<SolverBody> bodies;  ///< a row per body, and one for all obstacles for each group of contacts
  std::vector<std::uint8_t> pressed;  ///< of each body, in the last step; where much stands high
  double mean_radius;                 ///< m, of what may touch
  SolverSettings solver;
  double ahead = 0.0;  ///< s, for how long discs look ahead in a substep: 0 where all are slow
  Walk crowd;
  Sensing sensing;
  StageTimes times;
};

/// Advances `state` by dt. Allocates nothing once its buffers have grown. Semi-implicit Euler in substeps:
/// free fall is late by g h t / 2, h = dt / substeps; discs that keep all energy and that nothing pulls fly
/// and collide exactly; discs whose contacts are soft go by Verlet's method, of second order; agents walk dt
/// at once. Throws SimulationError where a body is no longer at a finite place, where so much happens within
/// dt that contacts might be missed, and as `Candidates::find`; `state` is then that of the step's beginning,
/// but where a place isn't finite.
void step(const Scene& scene, const Plan& plan, State& state, Workspace& workspace);

}  // namespace throng
