// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/gas_judges.h"

#include <algorithm>
#include <cmath>

#include "sim/observe.h"

namespace throng::bench {

void CollisionRate::look(double time, const State& state) {
  if (!before_.empty()) {
    for (std::size_t row = 0; row < before_.size(); ++row)
      changed_ += before_[row] != state.velocity[row] ? 1.0 : 0.0;
    seen_ += static_cast<double>(before_.size());
    dt_ = time - last_;
  }
  before_ = state.velocity;
  last_ = time;
}

double CollisionRate::rate() const {
  return -std::log(1.0 - changed_ / seen_) / dt_;
}

double CollisionRate::relative_error() const {
  return std::sqrt(2.0 / changed_);
}

namespace {

class RateJudge : public Judge {
 public:
  RateJudge(const Scene& scene, std::function<double(double)> expected)
      : scene_(scene), expected_(std::move(expected)), energy_(kinetic_energy(scene, initial_state(scene))) {}

  void look(double time, const Simulation& simulation) override {
    const State& state = simulation.state();
    rate_.look(time, state);
    for (const auto& velocity : state.velocity) {
      const double v2 = velocity.squaredNorm();
      v2_ += v2, v4_ += v2 * v2, n_ += 1.0;
    }
    heat_ += kinetic_energy(scene_, state) / energy_ - 1.0;
    ++looks_;
  }

  Figures figures() const override {
    const double rate = rate_.rate();
    return {{"error", std::abs(rate / expected_(scene_.time.dt) - 1.0)},
            {"rate", rate},
            {"statistical", rate_.relative_error()},
            {"temperature", heat_ / looks_},
            {"kurtosis", v4_ / n_ / (2.0 * std::pow(v2_ / n_, 2)) - 1.0}};
  }

 private:
  const Scene& scene_;
  std::function<double(double)> expected_;
  double energy_;  // J, at the beginning
  CollisionRate rate_;
  double v2_ = 0.0, v4_ = 0.0, n_ = 0.0, heat_ = 0.0;
  int looks_ = 0;
};

class EnergyJudge : public Judge {
 public:
  explicit EnergyJudge(const Scene& scene)
      : scene_(scene), first_(kinetic_energy(scene, initial_state(scene))) {}

  void look(double, const Simulation& simulation) override {
    worst_ = std::max(worst_, std::abs(kinetic_energy(scene_, simulation.state()) / first_ - 1.0));
  }

  Figures figures() const override { return {{"error", worst_}}; }

 private:
  const Scene& scene_;
  double first_, worst_ = 0.0;  // J, relative
};

}  // namespace

std::unique_ptr<Judge> rate_judge(const Scene& scene, std::function<double(double)> expected) {
  return std::make_unique<RateJudge>(scene, std::move(expected));
}

std::unique_ptr<Judge> energy_judge(const Scene& scene) {
  return std::make_unique<EnergyJudge>(scene);
}

}  // namespace throng::bench
