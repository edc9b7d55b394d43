// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_billiard.h"

#include <cmath>
#include <limits>

namespace throng::bench {

namespace {

using Long = long double;
using LongVec = Eigen::Matrix<Long, 2, 1>;
constexpr Long kNeverMeets = std::numeric_limits<Long>::infinity();

/// One coordinate of the unfolded way.
void fold(double low, double high, double t, double& place, double& speed) {
  const double width = high - low;
  const double gone = std::fmod(place - low + t * speed, 2.0 * width);
  const double along = gone < 0.0 ? gone + 2.0 * width : gone;
  place = low + (along <= width ? along : 2.0 * width - along);
  speed = along <= width ? speed : -speed;
}

/// The ball's flight among the walls and the post.
struct Flight {
  LongVec at, speed;

  Long wall(const Table& table, int axis) const {
    if (speed[axis] == 0) return kNeverMeets;
    return ((speed[axis] > 0 ? Long(table.max[axis]) : Long(table.min[axis])) - at[axis]) / speed[axis];
  }

  Long post(const Table& table) const {
    const LongVec away = at - table.post.cast<Long>();
    const Long nearing = -away.dot(speed), reach = table.post_reach;
    const Long excess = away.squaredNorm() - reach * reach;
    const Long root = nearing * nearing - speed.squaredNorm() * excess;
    return nearing <= 0 || root < 0 ? kNeverMeets : excess / (nearing + std::sqrt(root));
  }

  void reflect(const LongVec& normal) { speed -= 2 * speed.dot(normal) * normal; }
};

BodyState among(const BodyState& start, const Table& table, double t) {
  Flight flight{start.position.cast<Long>(), start.velocity.cast<Long>()};
  for (Long left = t;;) {
    const Long x = flight.wall(table, 0), y = flight.wall(table, 1), post = flight.post(table);
    const Long next = std::min(std::min(x, y), post);
    flight.at += std::min(next, left) * flight.speed;
    if (next >= left) break;
    left -= next;
    if (next == post)
      flight.reflect((flight.at - table.post.cast<Long>()).normalized());
    else
      flight.speed[next == x ? 0 : 1] *= -1;
  }
  return {flight.at.cast<double>(), start.angle + t * start.spin, flight.speed.cast<double>(), start.spin};
}

}  // namespace

BodyState exact_billiard(const BodyState& start, const Table& table, double t) {
  if (table.post_reach > 0.0) return among(start, table, t);
  BodyState ball = start;
  for (const int axis : {0, 1})
    fold(table.min[axis], table.max[axis], t, ball.position[axis], ball.velocity[axis]);
  ball.angle += t * ball.spin;
  return ball;
}

}  // namespace throng::bench
