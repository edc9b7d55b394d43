// SPDX-License-Identifier: MIT
#include "sim/simulation.h"

#include <algorithm>

#include "sim/contact/list_contacts.h"
#include "sim/engine_box2d.h"
#include "sim/engine_event_driven.h"
#include "sim/input_error.h"
#include "sim/soft_timing.h"
#include "sim/step.h"

namespace throng {

namespace {

/// Of soft contacts those that don't just hold back two that part.
std::size_t pressing(const std::vector<ContactImpulse>& contacts) {
  return static_cast<std::size_t>(
      std::ranges::count_if(contacts, [](const ContactImpulse& contact) { return contact.normal > 0.0; }));
}

class Native : public Simulation {
 public:
  Native(const Scene& scene, int threads)
      : scene_(scene), plan_(plan_for(scene)), state_(initial_state(scene)), work_(scene, plan_, threads) {
    work_.sensing.sense(state_);
  }

  void step() override { throng::step(scene_, plan_, state_, work_); }
  const State& state() const override { return state_; }
  bool restore(const State& state) override {
    state_ = state;
    work_.sleepers.look(state_, work_.candidates);
    work_.sensing.look(state_);
    return true;
  }
  std::size_t contacts() const override {
    if (plan_.soft) return pressing(state_.disc_contacts) + pressing(state_.point_contacts);
    return state_.disc_contacts.size() + state_.point_contacts.size() + state_.sleep.disc_contacts.size() +
           state_.sleep.point_contacts.size();
  }
  void list_contacts(std::vector<ContactRow>& rows) const override {
    if (plan_.soft)
      work_.soft.list(state_, work_.bodies.in_order(), rows);
    else
      throng::list_contacts(scene_, work_.contacts, plan_.sums_impulses ? &work_.impulses : nullptr, state_,
                            work_.bodies, rows);
    if (plan_.sleep) with_sleeping(scene_, state_, rows);
  }
  const Collisions* collisions() const override { return plan_.flights ? &state_.collisions : nullptr; }

  std::span<const Sensed> sensed() const override { return work_.sensing.sensed(); }

  std::vector<std::pair<std::string, double>> stage_times() const override {
    std::vector<std::pair<std::string, double>> all =
        plan_.crowd ? crowd_times(work_.times) : body_times(work_.times);
    if (plan_.sensors) all.push_back({"sense", work_.times.sense});
    return all;
  }

 private:
  std::vector<std::pair<std::string, double>> body_times(const StageTimes& times) const {
    if (plan_.soft) return {{"find_pairs", times.find_pairs}, {"solve", times.solve}, {"store", times.store}};
    if (!plan_.contacts()) return {{"integrate", times.solve}, {"store", times.store}};
    std::vector<std::pair<std::string, double>> all{{"find_pairs", times.find_pairs},
                                                    {"find_contacts", times.find_contacts},
                                                    {"solve", times.solve},
                                                    {"store", times.store}};
    if (plan_.flights) all.insert(all.begin() + 1, {"collide", times.collide});
    if (plan_.sleep) all.push_back({"sleep", times.sleep});
    return all;
  }

  std::vector<std::pair<std::string, double>> crowd_times(const StageTimes& times) const {
    std::vector<std::pair<std::string, double>> all{
        {"look", times.look}, {"steer", times.steer}, {"walk", times.walk}};
    if (plan_.measures) all.push_back({"measure", times.measure});
    all.push_back({"leave", times.leave});
    if (plan_.entrances) all.push_back({"appear", times.appear});
    return all;
  }

  const Scene& scene_;
  Plan plan_;
  State state_;
  Workspace work_;
};

}  // namespace

std::unique_ptr<Simulation> simulation(const Scene& scene, int threads) {
  if (scene.engine == Engine::box2d) return box2d_simulation(scene);
  if (scene.engine == Engine::event_driven) return event_driven_simulation(scene);
  if (const std::string refusal = is_soft(scene.contact) ? soft_refusal(scene) : ""; !refusal.empty())
    throw InputError("contact.model: " + refusal);
  return std::make_unique<Native>(scene, threads);
}

}  // namespace throng
