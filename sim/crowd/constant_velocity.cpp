// SPDX-License-Identifier: MIT
#include "sim/crowd/constant_velocity.h"

#include <limits>

namespace throng {

namespace {

class ConstantVelocity : public WalkingModel {
 public:
  void steer(const CrowdView& crowd, std::span<const std::uint32_t> places,
             std::span<Vec> velocity) const override {
    for (const std::uint32_t place : places)
      velocity[place] = crowd.desired_speed[place] * crowd.towards(place);
  }
  double reach(const Largest&) const override { return 0.0; }
  double longest_step(double, double) const override { return std::numeric_limits<double>::infinity(); }
};

}  // namespace

ModelKind constant_velocity() {
  return {"constant_velocity",
          "Walks at the desired speed and looks at nobody.",
          {},
          [](std::span<const double>) -> std::unique_ptr<WalkingModel> {
            return std::make_unique<ConstantVelocity>();
          }};
}

}  // namespace throng
