// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tools/bench/accuracy/cases.h"
#include "tools/bench/accuracy/exact_bounce.h"
#include "tools/bench/accuracy/exact_incline.h"

namespace throng::bench {

namespace {

JudgeMaker bounced(const Scene& scene) {
  const BodyState start = states_of(scene)[0];
  const double radius = scene.bodies.radius[0], gravity = -scene.gravity.y();
  const double restitution = scene.materials[0].restitution;
  const auto truth = [=](double t) {
    BodyState now = start;
    now.position.y() = radius + exact_bounce(start.position.y() - radius, gravity, restitution, t).height;
    return std::vector<BodyState>{now};
  };
  return by_trajectory(truth, 0.1);
}

/// How far off the floor a disc is that should have been at rest for a second, m over its radius.
class RestJudge : public Judge {
 public:
  explicit RestJudge(const Scene& scene) : radius_(scene.bodies.radius[0]) {
    const double height = scene.bodies.position[0].y() - radius_;
    from_ = 1.0 + exact_rest(height, -scene.gravity.y(), scene.materials[0].restitution);
  }

  void look(double time, const Simulation& simulation) override {
    if (time < from_) return;
    const State& state = simulation.state();
    farthest_ = std::max(farthest_, std::abs(state.position[0].y() / radius_ - 1.0));
    fastest_ = std::max(fastest_, state.velocity[0].norm());
  }

  Figures figures() const override { return {{"error", farthest_}, {"speed", fastest_}}; }

 private:
  double radius_, from_;                   // m, s
  double farthest_ = 0.0, fastest_ = 0.0;  // radii, m/s
};

JudgeMaker rested(const Scene&) {
  return [](const Scene& scene) { return std::make_unique<RestJudge>(scene); };
}

JudgeMaker on_incline(const Scene& scene) {
  const BodyState start = states_of(scene)[0];
  const Vec gravity = scene.gravity;
  const double friction = scene.materials[0].friction, radius = scene.bodies.radius[0];
  return by_trajectory(
      [=](double t) { return std::vector<BodyState>{exact_incline(start, gravity, friction, radius, t)}; },
      0.1);
}

JudgeMaker slid(const Scene& scene) {
  const BodyState start = states_of(scene)[0];
  const Vec gravity = scene.gravity;
  const double friction = scene.materials[0].friction;
  return by_trajectory(
      [=](double t) { return std::vector<BodyState>{exact_slide(start, gravity, friction, t)}; }, 0.1);
}

}  // namespace

std::span<const AccuracyCase> contact_cases() {
  static const AccuracyCase all[] = {
      {.name = "bounce",
       .what = "A disc falls by ten radii and bounces 19 times with restitution 0.8 in 4 s. Exact: throws "
               "between "
               "heights e^2n h.",
       .error = kOffTrajectory,
       .scene = "bounce",
       .dts = halvings(0.025, 8),
       .judges = bounced},
      {.name = "bounce to rest",
       .what = "The same, a second and more after it should have come to rest at 4.06 s.",
       .error = "farthest off its place at rest, radii",
       .scene = "bounce",
       .overrides = {"time.until=6"},
       .dts = halvings(0.025, 5),
       .judges = rested},
      {.name = "rolling",
       .what = "A disc rolls from rest down a slope of 30 degrees. Exact: 2/3 g sin.",
       .error = kOffTrajectory,
       .scene = "incline",
       .dts = halvings(0.05, 7),
       .judges = on_incline,
       .smooth = true},
      {.name = "slipping",
       .what = "The same with a friction of 0.1, too small to roll. Exact: g (sin - mu cos), and the spin.",
       .error = kOffTrajectory,
       .scene = "incline",
       .overrides = {"materials.default.friction=0.1"},
       .dts = halvings(0.05, 7),
       .judges = on_incline,
       .smooth = true},
      {.name = "from slipping to rolling",
       .what =
           "The same with a friction of 0.5, thrown down the slope without spin: it slips until 0.51 s and "
           "rolls on.",
       .error = kOffTrajectory,
       .scene = "incline",
       .overrides = {"bodies[0].velocity=[4, 0]"},
       .dts = halvings(0.05, 7),
       .judges = on_incline,
       .smooth = true},
      {.name = "slide to rest",
       .what = "A block of 1 m slides with 5 m/s and stops. Exact: after v² / (2 mu g).",
       .error = kOffTrajectory,
       .scene = "slide",
       .dts = halvings(0.05, 7),
       .judges = slid,
       .smooth = true},
  };
  return all;
}

}  // namespace throng::bench
