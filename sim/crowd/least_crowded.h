// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/tally.h"
#include "sim/crowd/ways.h"
#include "sim/state.h"

namespace throng {

/// Which of several exits or queues an agent takes: the one that it expects to be through first, by the time
/// of the way at its desired speed and that of all who go there too and are nearer, at the exit's capacity:
/// Ehtamo, Heliovaara, Korhonen, Hostikka, "Game theoretic best-response dynamics for evacuees' exit
/// selection" (Advances in Complex Systems 2010). Those who choose in the same step do so one after the other
/// and know what the ones before them chose.
class LeastCrowded {
 public:
  LeastCrowded(const Scene& scene, const Ways& ways);

  /// Whom the state says to go where. O(agents).
  void count(const State& state);

  /// The option that the agent takes from there, of the open ones, of all where none is; of equally good ones
  /// the first. From then on it goes there. O(sqrt agents) in the mean.
  std::uint32_t choose(const Leg& leg, std::size_t agent, const Vec& place);

 private:
  const Scene& scene_;
  const Ways& ways_;
  std::vector<bool> is_counted_;  // as Crowd::goals: some agent may choose it so
  std::vector<Tally> going_;      // as Crowd::goals: m, ways of all who go there
};

}  // namespace throng
