// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "tools/bench/accuracy/judge.h"

namespace throng::bench {

namespace {

class TrajectoryJudge : public Judge {
 public:
  TrajectoryJudge(const Scene& scene, Truth truth, double every, bool turns)
      : scene_(scene), truth_(std::move(truth)), every_(every), turns_(turns) {}

  void look(double time, const Simulation& simulation) override {
    const double sample = std::round(time / every_) * every_;
    if (std::abs(time - sample) > 1e-9 || time > scene_.time.until + 1e-9) return;
    const std::vector<BodyState> exact = truth_(sample);
    const State& state = simulation.state();
    double sum = 0.0;
    int bodies = 0;
    for (std::size_t row = 0; row < state.id.size(); ++row) {
      const std::size_t body = state.id[row] - std::size_t{1};
      if (scene_.bodies.kind[body] != BodyKind::dynamic) continue;
      sum += off2(exact[body], state, row, scene_.bodies.radius[body]);
      ++bodies;
    }
    last_ = sum / bodies;
    sum_ += last_;
    ++samples_;
  }

  Figures figures() const override {
    if (samples_ == 0) return {{"error", std::numeric_limits<double>::infinity()}};  // no step ends at one
    return {{"error", std::sqrt(sum_ / samples_)}, {"error_end", std::sqrt(last_)}};
  }

 private:
  double off2(const BodyState& exact, const State& state, std::size_t row, double radius) const {
    Vec way = state.position[row] - exact.position;
    const Vec size = scene_.domain.max - scene_.domain.min;
    if (scene_.domain.kind == DomainKind::periodic)
      for (const int axis : {0, 1}) way[axis] -= size[axis] * std::round(way[axis] / size[axis]);
    const double turn = turns_ ? state.angle[row] - exact.angle : 0.0;
    return way.squaredNorm() / (radius * radius) + turn * turn;
  }

  const Scene& scene_;
  Truth truth_;
  double every_;  // s
  bool turns_;
  double sum_ = 0.0, last_ = 0.0;  // of squares
  int samples_ = 0;
};

}  // namespace

std::unique_ptr<Judge> trajectory_judge(const Scene& scene, Truth truth, double every, bool turns) {
  return std::make_unique<TrajectoryJudge>(scene, std::move(truth), every, turns);
}

std::vector<BodyState> states_of(const Scene& scene) {
  std::vector<BodyState> all;
  const Bodies& b = scene.bodies;
  for (std::size_t i = 0; i < b.size(); ++i)
    all.push_back({b.position[i], b.angle[i], b.velocity[i], b.spin[i]});
  return all;
}

}  // namespace throng::bench
