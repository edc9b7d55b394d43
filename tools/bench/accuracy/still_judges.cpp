// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/still_judges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "narrowphase/distance.h"
#include "sim/observe.h"

namespace throng::bench {

namespace {

constexpr double kWatched = 1.0;  // s, before the end
constexpr double kLooks = 10.0;   // at overlaps in that time

bool is_watched(const Scene& scene, double time) {
  return time > scene.time.until - kWatched + 1e-9;
}

class PlaceJudge : public Judge {
 public:
  explicit PlaceJudge(const Scene& scene) : scene_(scene) {}

  void look(double time, const Simulation& simulation) override {
    if (!is_watched(scene_, time)) return;
    const State& state = simulation.state();
    for (std::size_t row = 0; row < state.id.size(); ++row)
      farthest_ =
          std::max(farthest_, (state.position[row] - scene_.bodies.position[state.id[row] - 1]).norm());
  }

  Figures figures() const override { return {{"error", farthest_}}; }

 private:
  const Scene& scene_;
  double farthest_ = 0.0;  // m
};

class TouchJudge : public Judge {
 public:
  explicit TouchJudge(const Scene& scene) : scene_(scene), next_(scene.time.until - kWatched) {
    double sum = 0.0, bodies = 0.0;
    for (std::size_t row = 0; row < scene.bodies.size(); ++row)
      if (scene.bodies.kind[row] == BodyKind::dynamic) sum += scene.bodies.radius[row], bodies += 1.0;
    radius_ = sum / bodies;
  }

  void look(double time, const Simulation& simulation) override {
    if (time < next_ - 1e-9) return;
    next_ += kWatched / kLooks;
    place(simulation.state());
    simulation.list_contacts(contacts_);
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;  // pairs that press at two points count once
    for (const ContactRow& row : contacts_)
      if (row.b != 0 && seen.insert({row.a, row.b}).second) off_ += std::abs(gap(row.a - 1, row.b - 1));
    pairs_ += static_cast<double>(seen.size());
    const Overlap found = overlap(scene_, simulation.state());
    overlap_ += found.mean / radius_;
    deepest_ = std::max(deepest_, found.max / radius_);
    kinetic_energy_ = kinetic_energy(scene_, simulation.state());
    ++looks_;
  }

  Figures figures() const override {
    const double off = pairs_ > 0.0 ? off_ / pairs_ / radius_ : std::numeric_limits<double>::infinity();
    return {{"error", off},
            {"overlap", overlap_ / std::max(looks_, 1)},
            {"max_overlap", deepest_},
            {"kinetic_energy", kinetic_energy_}};
  }

 private:
  void place(const State& state) {
    poses_.resize(state.id.size());
    for (std::size_t row = 0; row < state.id.size(); ++row)
      poses_[state.id[row] - 1] = narrowphase::pose(state.position[row], state.angle[row]);
  }

  narrowphase::Convex shape(std::size_t body) const {
    const Shape& shape = scene_.shapes[scene_.bodies.shape[body]];
    return shape.parts.empty() ? narrowphase::disc(scene_.bodies.radius[body]) : shape.parts[0];
  }

  /// m, signed, between two bodies.
  double gap(std::size_t a, std::size_t b) const {
    return narrowphase::separation(shape(a), poses_[a], shape(b), poses_[b]).distance;
  }

  const Scene& scene_;
  double radius_ = 1.0, next_;  // m, s
  std::vector<ContactRow> contacts_;
  std::vector<narrowphase::Pose> poses_;
  double off_ = 0.0, pairs_ = 0.0;                             // m, summed over pairs
  double overlap_ = 0.0, deepest_ = 0.0, kinetic_energy_ = 0;  // radii, radii, J
  int looks_ = 0;
};

class LoadJudge : public Judge {
 public:
  LoadJudge(const Scene& scene, Loads loads)
      : scene_(scene), loads_(std::move(loads)), sum_(loads_.force.size(), 0.0) {}

  void look(double time, const Simulation& simulation) override {
    if (!is_watched(scene_, time)) return;
    simulation.list_contacts(rows_);
    std::vector<double> force(sum_.size(), 0.0);
    for (const ContactRow& row : rows_)
      if (const int load = loads_.which(row); load >= 0)
        force[static_cast<std::size_t>(load)] += row.impulse / scene_.time.dt;
    for (std::size_t i = 0; i < force.size(); ++i) {
      sum_[i] += force[i];
      squares_ += std::pow(force[i] / loads_.force[i] - 1.0, 2);
    }
    known_ = known_ || !rows_.empty();
    ++looks_;
  }

  Figures figures() const override {
    if (!known_) return {{"error", std::numeric_limits<double>::infinity()}};
    double worst = 0.0;
    for (std::size_t i = 0; i < sum_.size(); ++i)
      worst = std::max(worst, std::abs(sum_[i] / looks_ / loads_.force[i] - 1.0));
    return {{"error", worst}, {"jitter", std::sqrt(squares_ / (looks_ * static_cast<double>(sum_.size())))}};
  }

 private:
  const Scene& scene_;
  Loads loads_;
  std::vector<ContactRow> rows_;
  std::vector<double> sum_;  // N
  double squares_ = 0.0;
  int looks_ = 0;
  bool known_ = false;
};

}  // namespace

std::unique_ptr<Judge> place_judge(const Scene& scene) {
  return std::make_unique<PlaceJudge>(scene);
}

std::unique_ptr<Judge> touch_judge(const Scene& scene) {
  return std::make_unique<TouchJudge>(scene);
}

std::unique_ptr<Judge> load_judge(const Scene& scene, Loads loads) {
  return std::make_unique<LoadJudge>(scene, std::move(loads));
}

}  // namespace throng::bench
