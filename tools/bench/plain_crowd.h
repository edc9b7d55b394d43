// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/crowd/distance_field.h"
#include "sim/scene.h"

namespace throng::bench {

/// The step of a crowd of one model and any goals as it is written down at first: agent by agent, neighbours
/// from nanoflann's tree, the system's exp, every wall looked at. The measure of throng's own.
class PlainCrowd {
 public:
  /// Expects a scene of agents that all have the same model, with its presets where `parameters` of the group
  /// are.
  explicit PlainCrowd(const Scene& scene);
  ~PlainCrowd();

  /// Walks on for dt; nobody leaves.
  void step();

  const std::vector<Vec>& position() const { return position_; }

 private:
  struct Near;
  struct Goal {
    std::unique_ptr<FloorPlan> plan;
    std::unique_ptr<DistanceField> field;
  };

  Vec free_speed(std::uint32_t agent) const;
  Vec social_force(std::uint32_t agent) const;
  Vec orca(std::uint32_t agent) const;
  Vec towards(std::uint32_t agent) const;
  std::span<const double> parameters(std::uint32_t agent) const;

  const Scene& scene_;
  std::string model_;
  Barriers barriers_;
  std::vector<Goal> goals_;
  std::unique_ptr<Near> near_;
  std::int64_t step_ = 0;
  std::vector<Vec> position_, velocity_;
};

}  // namespace throng::bench
