// SPDX-License-Identifier: MIT
#include "sim/free_fall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/straight_runs.h"

namespace throng {

namespace {

constexpr double kRounding = 1e-9;  // of velocities: pressed and let go again, nothing has changed
constexpr double kStraight = 1e-3;  // rad: who turns aside by more in a substep follows a curve

/// Whether one who slides on something that doesn't move never gets to a bend.
bool is_straight(const Scene& scene) {
  if (std::ranges::count(scene.bodies.kind, BodyKind::dynamic) != std::ssize(scene.bodies.kind)) return false;
  std::vector<std::pair<double, double>> ends;
  for (const StraightRun& run : straight_runs(scene.walls))
    for (const Vec& end : {run.from, run.to}) ends.emplace_back(end.x(), end.y());
  std::ranges::sort(ends);
  return std::ranges::adjacent_find(ends) == ends.end();
}

}  // namespace

FreeFall::FreeFall(const Scene& scene, std::size_t rows) : is_straight_(is_straight(scene)), fallen_(rows) {}

void FreeFall::fall(BodyRows<SolverBody> bodies, Rows rows, const Vec& kick) {
  rows.for_each([&](std::uint32_t row) {
    SolverBody& body = bodies[row];
    if (!body.is_dynamic()) return;
    body.velocity += kick;
    fallen_[bodies.slot(row)] = {body.velocity, body.spin};
  });
}

void FreeFall::stop(BodyRows<SolverBody> bodies, std::uint32_t row) {
  fallen_[bodies.slot(row)].velocity.setConstant(std::numeric_limits<double>::quiet_NaN());
}

bool FreeFall::flies(const SolverBody& body, const Fallen& fallen) {
  const Vec change = body.velocity - fallen.velocity;
  return change.squaredNorm() <= kRounding * kRounding * body.velocity.squaredNorm() &&
         std::abs(body.spin - fallen.spin) <= kRounding * std::abs(body.spin);
}

bool FreeFall::flies(BodyRows<const SolverBody> bodies, std::uint32_t row) const {
  return !bodies[row].is_dynamic() || flies(bodies[row], fallen_[bodies.slot(row)]);
}

/// Who rolls or slides straight on: half of what he got faster by in the substep is taken back along his way.
void FreeFall::slide(SolverBody& body, const Fallen& fallen, const Vec& kick, double h) {
  const Vec before = fallen.velocity - kick, &after = body.velocity;
  const double square = after.squaredNorm(), gain = (after - before).dot(after);
  const bool goes_on = before.dot(after) >= 0.0 && std::abs(cross(before, after)) <= kStraight * square;
  if (!(square > 0.0 && goes_on && gain * gain <= kick.squaredNorm() * square)) return;
  body.position -= 0.5 * h * gain / square * after;
  body.turn -= 0.5 * h * (body.spin - fallen.spin);
}

void FreeFall::land(BodyRows<SolverBody> bodies, Rows rows, const Vec& kick, double h) const {
  const Vec too_far = 0.5 * h * kick;
  rows.for_each([&](std::uint32_t row) {
    SolverBody& body = bodies[row];
    if (!body.is_dynamic()) return;
    const Fallen& fallen = fallen_[bodies.slot(row)];
    if (flies(body, fallen))
      body.position -= too_far;
    else if (is_straight_)
      slide(body, fallen, kick, h);
  });
}

}  // namespace throng
