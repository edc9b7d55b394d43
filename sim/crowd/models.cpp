// SPDX-License-Identifier: MIT
#include "sim/crowd/collision_free_speed.h"
#include "sim/crowd/constant_velocity.h"
#include "sim/crowd/model.h"
#include "sim/crowd/orca.h"
#include "sim/crowd/social_force.h"

namespace throng {

std::span<const ModelKind> walking_models() {
  static const ModelKind all[] = {constant_velocity(), social_force(), collision_free_speed(), orca()};
  return all;
}

}  // namespace throng
