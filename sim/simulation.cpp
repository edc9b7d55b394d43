// SPDX-License-Identifier: MIT
#include "sim/simulation.h"

#include "sim/contact/list_contacts.h"
#include "sim/engine_box2d.h"
#include "sim/step.h"

namespace throng {

namespace {

class Native : public Simulation {
 public:
  Native(const Scene& scene, int threads)
      : scene_(scene), plan_(plan_for(scene)), state_(initial_state(scene)), work_(scene, plan_, threads) {}

  void step() override { throng::step(scene_, plan_, state_, work_); }
  const State& state() const override { return state_; }
  bool restore(const State& state) override {
    state_ = state;
    return true;
  }
  std::size_t contacts() const override { return state_.disc_contacts.size() + state_.point_contacts.size(); }
  void list_contacts(std::vector<ContactRow>& rows) const override {
    throng::list_contacts(scene_, work_.contacts, state_, work_.bodies, rows);
  }

  std::vector<std::pair<std::string, double>> stage_times() const override {
    const StageTimes& times = work_.times;
    if (plan_.crowd) return crowd_times(times);
    if (!plan_.contacts()) return {{"integrate", times.solve}, {"store", times.store}};
    return {{"find_pairs", times.find_pairs},
            {"find_contacts", times.find_contacts},
            {"solve", times.solve},
            {"store", times.store}};
  }

 private:
  std::vector<std::pair<std::string, double>> crowd_times(const StageTimes& times) const {
    std::vector<std::pair<std::string, double>> all{
        {"look", times.look}, {"steer", times.steer}, {"walk", times.walk}, {"leave", times.leave}};
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
  return std::make_unique<Native>(scene, threads);
}

}  // namespace throng
