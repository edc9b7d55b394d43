// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tools/bench/accuracy/cases.h"
#include "tools/bench/accuracy/exact_spring.h"

namespace throng::bench {

namespace {

/// How bodies 1 and 2, 3 and 4, ... part after they met head on.
class ImpactJudge : public Judge {
 public:
  explicit ImpactJudge(const Scene& scene) : scene_(scene) {}

  void look(double time, const Simulation& simulation) override {
    time_ = time;
    last_ = simulation.state();
  }

  Figures figures() const override {
    double restitution = 0.0, duration = 0.0;
    for (std::size_t i = 0; i < last_.id.size(); i += 2) {
      const auto [met, closing] = apart(scene_.bodies.position, scene_.bodies.velocity, i);
      const auto [gap, parting] = apart(last_.position, last_.velocity, i);
      const double reduced = 1.0 / (1.0 / mass(scene_, i) + 1.0 / mass(scene_, i + 1));
      const double wanted = scene_.materials[0].restitution, stiffness = scene_.soft.stiffness;
      const SpringImpact exact =
          exact_spring_impact(stiffness, reduced, exact_damping(stiffness, reduced, wanted));
      restitution = std::max(restitution, std::abs(-parting / closing / exact.restitution - 1.0));
      const double lasted = time_ - gap / parting - met / -closing;  // s
      duration = std::max(duration, std::abs(lasted / exact.duration - 1.0));
    }
    return {{"error", restitution}, {"duration", duration}};
  }

 private:
  struct Apart {
    double gap, speed;  // m, m/s; above 0 where they part
  };

  Apart apart(const std::vector<Vec>& place, const std::vector<Vec>& velocity, std::size_t i) const {
    const Vec way = place[i + 1] - place[i], n = way.normalized();
    return {way.norm() - scene_.bodies.radius[i] - scene_.bodies.radius[i + 1],
            n.dot(velocity[i + 1] - velocity[i])};
  }

  const Scene& scene_;
  double time_ = 0.0;
  State last_;
};

JudgeMaker met(const Scene&) {
  return [](const Scene& scene) { return std::make_unique<ImpactJudge>(scene); };
}

}  // namespace

std::span<const AccuracyCase> spring_cases() {
  static const AccuracyCase all[] = {
      {.name = "spring and dashpot",
       .what = "Eight pairs of soft discs meet head on, each a little later in a step, with restitution 0.7. "
               "Exact: a "
               "damped oscillation's first half.",
       .error = "restitution, relative, the worst",
       .scene = "spring_impact",
       .dts = halvings(0.01, 6),
       .judges = met,
       .smooth = true},
  };
  return all;
}

}  // namespace throng::bench
