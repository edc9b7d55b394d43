// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/gas_judges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/observe.h"
#include "tools/bench/accuracy/exact_gas.h"

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

class TheoryJudge : public Judge {
 public:
  TheoryJudge(const Scene& scene, std::function<double(double)> seen)
      : scene_(scene), seen_(std::move(seen)), energy_(kinetic_energy(scene, initial_state(scene))) {
    const double n = static_cast<double>(scene.bodies.size()), radius = scene.bodies.radius[0];
    const Vec size = scene.domain.max - scene.domain.min;
    fraction_ = n * std::numbers::pi * radius * radius / (size.x() * size.y());
    const double mean_square_speed = 2.0 * energy_ / (mass(scene, 0) * (n - 1.0));  // n - 1: momentum is 0
    expected_ = exact_collision_rate(fraction_, 2.0 * radius, mean_square_speed);
  }

  void look(double time, const Simulation& simulation) override {
    rate_.look(time, simulation.state());
    if (simulation.collisions()) counted_ = counted_rate(scene_, simulation);
    last_energy_ = kinetic_energy(scene_, simulation.state());
  }

  Figures figures() const override {
    const double off = (counted_ > 0.0 ? counted_ : rate_.rate() / seen_(scene_.time.dt)) / expected_ - 1.0;
    const double theory = exact_compressibility(fraction_);
    return {{"error", std::abs(off)},
            {"statistical", rate_.relative_error()},
            {"temperature", last_energy_ / energy_ - 1.0},
            {"compressibility", 1.0 + (theory - 1.0) * (1.0 + off)},
            {"theory", theory}};
  }

 private:
  const Scene& scene_;
  std::function<double(double)> seen_;
  double energy_, last_energy_ = 0.0;       // J
  double fraction_ = 0.0, expected_ = 0.0;  // of the area; 1/s
  CollisionRate rate_;
  double counted_ = 0.0;  // 1/s
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

class MomentumJudge : public Judge {
 public:
  explicit MomentumJudge(const Scene& scene) : scene_(scene), first_(momentum(scene, initial_state(scene))) {
    for (std::size_t row = 0; row < scene.bodies.size(); ++row)
      all_ += mass(scene, row) * scene.bodies.velocity[row].norm();
  }

  void look(double, const Simulation& simulation) override {
    worst_ = std::max(worst_, (momentum(scene_, simulation.state()) - first_).norm() / all_);
  }

  Figures figures() const override { return {{"error", worst_}}; }

 private:
  const Scene& scene_;
  Vec first_;         // kg m/s
  double all_ = 0.0;  // kg m/s
  double worst_ = 0.0;
};

class SpeedJudge : public Judge {
 public:
  void look(double, const Simulation& simulation) override {
    const std::vector<Vec>& velocity = simulation.state().velocity;
    double mean = 0.0;  // square
    for (const Vec& v : velocity) mean += v.squaredNorm() / static_cast<double>(velocity.size());
    for (const Vec& v : velocity) {
      const double share = 1.0 - std::exp(-v.squaredNorm() / mean);  // of Maxwell's that is slower
      ++count_[std::min(static_cast<std::size_t>(share * kBins), kBins - 1)];
    }
    all_ += static_cast<double>(velocity.size());
  }

  Figures figures() const override {
    double worst = 0.0, slower = 0.0;
    for (std::size_t i = 0; i < kBins; ++i) {
      slower += count_[i] / all_;
      worst = std::max(worst, std::abs(slower - static_cast<double>(i + 1) / kBins));
    }
    return {{"error", worst}};
  }

 private:
  static constexpr std::size_t kBins = 200;
  std::array<double, kBins> count_{};
  double all_ = 0.0;
};

}  // namespace

std::unique_ptr<Judge> momentum_judge(const Scene& scene) {
  return std::make_unique<MomentumJudge>(scene);
}

std::unique_ptr<Judge> speed_judge(const Scene&) {
  return std::make_unique<SpeedJudge>();
}

std::unique_ptr<Judge> rate_judge(const Scene& scene, std::function<double(double)> expected) {
  return std::make_unique<RateJudge>(scene, std::move(expected));
}

std::unique_ptr<Judge> theory_judge(const Scene& scene, std::function<double(double)> seen) {
  return std::make_unique<TheoryJudge>(scene, std::move(seen));
}

double counted_rate(const Scene& scene, const Simulation& simulation) {
  const double time = static_cast<double>(simulation.state().step) * scene.time.dt;
  return 2.0 * static_cast<double>(simulation.collisions()->pairs) /
         (static_cast<double>(scene.bodies.size()) * time);
}

std::unique_ptr<Judge> energy_judge(const Scene& scene) {
  return std::make_unique<EnergyJudge>(scene);
}

}  // namespace throng::bench
