// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/recorded_truth.h"

#include <cmath>

namespace throng::bench {

namespace {

std::vector<BodyState> body_states(const State& state) {
  std::vector<BodyState> all(state.id.size());
  for (std::size_t row = 0; row < state.id.size(); ++row)
    all[state.id[row] - 1] = {state.position[row], state.angle[row], state.velocity[row], state.spin[row]};
  return all;
}

}  // namespace

Truth recorded_truth(Scene scene, double every) {
  const auto run = simulation(scene);
  const std::int64_t stride = std::llround(every / scene.time.dt);
  std::vector<std::vector<BodyState>> frames{body_states(run->state())};
  for (std::int64_t i = 1; i <= scene.time.steps(); ++i) {
    run->step();
    if (i % stride == 0) frames.push_back(body_states(run->state()));
  }
  return [frames = std::make_shared<const decltype(frames)>(std::move(frames)), every](double time) {
    return frames->at(static_cast<std::size_t>(std::llround(time / every)));
  };
}

double difference(const Scene& scene, const Truth& a, const Truth& b) {
  const std::vector<BodyState> first = a(scene.time.until), second = b(scene.time.until);
  double sum = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i)
    sum += ((first[i].position - second[i].position) / scene.bodies.radius[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(first.size()));
}

}  // namespace throng::bench
