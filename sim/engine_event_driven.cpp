// SPDX-License-Identifier: MIT
#include "sim/engine_event_driven.h"

#include <algorithm>
#include <cstdio>

#include "sim/event_driven/hard_discs.h"
#include "sim/input_error.h"
#include "sim/meeting_materials.h"
#include "sim/sensing/sensing.h"
#include "sim/stage_clock.h"

namespace throng {

namespace {

class EventDriven : public Simulation {
 public:
  explicit EventDriven(const Scene& scene)
      : scene_(scene),
        plan_(plan_for(scene)),
        state_(initial_state(scene)),
        discs_(scene, plan_),
        sensing_(scene, 1) {
    sensing_.sense(state_);
  }

  void step() override {
    StageClock clock;
    const double time = static_cast<double>(state_.step + 1) * scene_.time.dt;
    if (!discs_.run_until(time, next_rows_, stop_)) throw Interrupted{};
    rows_.swap(next_rows_);
    clock.lap(collide_);
    ++state_.step;
    discs_.store(time, state_);
    state_.collisions = discs_.collisions();
    clock.lap(store_);
    if (scene_.sensors.empty()) return;
    sensing_.sense(state_);
    clock.lap(sense_);
  }

  void heed(bool (*stop)()) override { stop_ = stop; }

  const State& state() const override { return state_; }

  /// What its collisions left stands in HardDiscs to more digits than the state of a step holds.
  bool restore(const State&) override { return false; }

  std::size_t contacts() const override { return rows_.size(); }
  void list_contacts(std::vector<ContactRow>& rows) const override { rows = rows_; }
  const Collisions* collisions() const override { return &state_.collisions; }
  std::span<const Sensed> sensed() const override { return sensing_.sensed(); }

  std::vector<std::pair<std::string, double>> stage_times() const override {
    std::vector<std::pair<std::string, double>> all{{"collide", collide_}, {"store", store_}};
    if (!scene_.sensors.empty()) all.push_back({"sense", sense_});
    return all;
  }

 private:
  const Scene& scene_;
  const Plan plan_;
  State state_;
  HardDiscs discs_;
  Sensing sensing_;
  bool (*stop_)() = nullptr;
  std::vector<ContactRow> rows_, next_rows_;  ///< collisions of the last step, and of one that goes on
  double collide_ = 0.0, store_ = 0.0, sense_ = 0.0;  ///< s
};

/// What a body is that isn't a disc which flies, or stands still; "" where it is.
std::string refusal_of(const Scene& scene, std::size_t row) {
  const BodyKind kind = scene.bodies.kind[row];
  const std::string body = "body " + std::to_string(row + 1);
  if (kind == BodyKind::agent) return "agents: they choose their ways; take engine native";
  if (kind == BodyKind::kinematic) return body + " is kinematic: what moves must be a dynamic disc";
  const Shape& shape = scene.shapes[scene.bodies.shape[row]];
  if (kind == BodyKind::dynamic && shape.kind != ShapeKind::disc)
    return "shapes." + shape.name + ": " + body + " isn't a disc, and what moves must be";
  return "";
}

/// Why a domain that repeats after `period` (m) is too narrow for a disc of radius `largest` (m).
std::string narrow(double largest, double period) {
  char text[200];
  std::snprintf(text, sizeof text,
                "domain.periodic: must be at least %.6g m wide and high, four times the largest disc (%.6g m "
                "across), and it is %.6g m; native needs 2.5 times",
                8.0 * largest, 2.0 * largest, period);
  return text;
}

}  // namespace

std::string event_driven_refusal(const Scene& scene) {
  if (scene.contact == ContactModel::none)
    return "contact.model = \"none\": collisions are all that this engine knows";
  if (is_soft(scene.contact))
    return "contact.model: discs are hard here; \"spring\" and \"hertz\" need native";
  double largest = 0.0;
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (std::string refusal = refusal_of(scene, row); !refusal.empty()) return refusal;
    if (scene.bodies.kind[row] == BodyKind::dynamic) largest = std::max(largest, scene.bodies.radius[row]);
  }
  if (const std::string rolls = rolling_refusal(scene, "this engine's collisions know none"); !rolls.empty())
    return rolls;
  if (scene.domain.kind != DomainKind::periodic) return "";
  const double period = (scene.domain.max - scene.domain.min).minCoeff();
  return period < 8.0 * largest ? narrow(largest, period) : "";
}

std::unique_ptr<Simulation> event_driven_simulation(const Scene& scene) {
  if (const std::string refusal = event_driven_refusal(scene); !refusal.empty())
    throw InputError("engine event_driven: " + refusal);
  return std::make_unique<EventDriven>(scene);
}

}  // namespace throng
