// SPDX-License-Identifier: MIT
#include "sim/contact/corner_impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace throng {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Goes on from normal impulse to normal impulse, while friction adds so much for each of it.
class Impact {
 public:
  Impact(const PointArms& at, double friction, const SolverBody& a, const SolverBody& b)
      : friction_(friction) {
    const double along_a = cross(at.arm_a, at.normal), along_b = cross(at.arm_b, at.normal);
    const double across_a = cross(at.arm_a, at.t), across_b = cross(at.arm_b, at.t);
    const double masses = a.inverse_mass + b.inverse_mass;
    nn_ = masses + a.inverse_inertia * along_a * along_a + b.inverse_inertia * along_b * along_b;
    nt_ = a.inverse_inertia * along_a * across_a + b.inverse_inertia * along_b * across_b;
    tt_ = masses + a.inverse_inertia * across_a * across_a + b.inverse_inertia * across_b * across_b;
    speed_ = at.normal_velocity(a, b), slip_ = at.tangent_velocity(a, b);
    rub();
  }

  /// Until the normal velocity is that, which is more than now.
  void reach(double speed) {
    if (const double rises = this->rises(); !(rises > 0.0 && speed - speed_ <= rises * left())) stop_slip();
    go_on((speed - speed_) / rises());
  }

  /// Until the normal impulse has done so much more work (J), from a normal velocity of 0.
  void gain(double work) {
    const double there = std::sqrt(2.0 * work * rises()) / rises();
    if (there <= left()) return go_on(there);
    const double before = work_;
    stop_slip();
    const double rest = work - (work_ - before), speed = std::max(speed_, 0.0);
    go_on((std::sqrt(speed * speed + 2.0 * std::max(rest, 0.0) * rises()) - speed) / rises());
  }

  double speed() const { return speed_; }
  double work() const { return work_; }
  CornerImpact impulses() const { return {normal_, across_}; }

 private:
  double rises() const { return nn_ + nt_ * ratio_; }   // normal velocity, by normal impulse, 1/kg
  double drifts() const { return nt_ + tt_ * ratio_; }  // slip, likewise
  /// N s, until the slip stops.
  double left() const { return slip_ * drifts() < 0.0 ? -slip_ / drifts() : kNever; }

  /// What is across for each normal impulse: against the slip; where there is none, what holds it, or, where
  /// that is too much, what is most.
  void rub() {
    ratio_ = slip_ > 0.0   ? -friction_
             : slip_ < 0.0 ? friction_
                           : std::clamp(-nt_ / tt_, -friction_, friction_);
  }

  void stop_slip() {
    go_on(left());
    slip_ = 0.0;
    rub();
  }

  void go_on(double impulse) {
    work_ += (speed_ + 0.5 * rises() * impulse) * impulse;
    speed_ += rises() * impulse, slip_ += drifts() * impulse;
    normal_ += impulse, across_ += ratio_ * impulse;
  }

  double friction_, nn_, nt_, tt_, speed_, slip_, ratio_;
  double normal_ = 0.0, across_ = 0.0, work_ = 0.0;
};

}  // namespace

CornerImpact corner_impact(const PointArms& at, double friction, const SolverBody& a, const SolverBody& b,
                           double parting) {
  Impact impact(at, friction, a, b);
  const double meeting = -impact.speed(), restitution = std::max(parting, 0.0) / meeting;
  impact.reach(std::min(parting, 0.0));
  if (restitution > 0.0) impact.gain(-restitution * restitution * impact.work());
  return impact.impulses();
}

}  // namespace throng
