// SPDX-License-Identifier: MIT
#include "sim/sensing/heading.h"

#include <cmath>
#include <numbers>

#include "narrowphase/trigonometry.h"

namespace throng {

Vec direction(double degrees) {
  const double turned = std::fmod(degrees, 360.0), quarter = std::round(turned / 90.0);
  const double rest = turned - 90.0 * quarter;
  Vec d = direction_of_angle(rest * (std::numbers::pi / 180.0));
  if (std::abs(rest) == 45.0) d = {std::sqrt(0.5), std::copysign(std::sqrt(0.5), rest)};
  for (int i = (static_cast<int>(quarter) + 4) % 4; i > 0; --i) d = {-d.y(), d.x()};
  return d;
}

Vec direction_of_angle(double angle) {
  const narrowphase::SinCos turn = narrowphase::sin_cos(angle);
  return {turn.cos, turn.sin};
}

broadphase::FieldOfView field_of_view(double degrees) {
  if (degrees == 360.0) return {};
  const Vec half = direction(0.5 * degrees);
  return {half.x(), half.y()};
}

}  // namespace throng
