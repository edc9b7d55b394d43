// SPDX-License-Identifier: MIT
#include "sim/crowd/constant_velocity.h"

#include <limits>

namespace throng {

namespace {

class ConstantVelocity : public WalkingModel {
 public:
  Vec velocity(const CrowdView& crowd, std::uint32_t row) const override {
    return crowd.desired_speed[row] * crowd.towards[row];
  }
  double reach(double) const override { return 0.0; }
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
