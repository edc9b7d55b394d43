// SPDX-License-Identifier: MIT
#include "sim/crowd/model.h"

namespace throng {

namespace {

constexpr ModelParameter kParameters[] = {
    {"room", 0.5, 0.0, 10.0, "m", "Who has somebody ahead that near, between their edges, stands, m."}};

class Polite : public WalkingModel {
 public:
  explicit Polite(double room) : room_(room) {}

  void steer(const CrowdView& crowd, std::span<const std::uint32_t> places,
             std::span<Vec> velocity) const override {
    for (const std::uint32_t own : places) {
      bool free = true;
      crowd.cells.for_each_stretch(
          crowd.position(own), reach(crowd.largest), [&](std::size_t first, std::size_t end) {
            for (std::size_t other = first; other < end; ++other) {
              const Vec to = Vec(crowd.x[other], crowd.y[other]) - crowd.position(own);
              free = free && (to.dot(crowd.towards(own)) <= 0.0 ||
                              to.norm() > crowd.radius[own] + crowd.radius[other] + room_);
            }
          });
      velocity[own] = (free ? crowd.desired_speed[own] : 0.0) * crowd.towards(own);
    }
  }
  double reach(const Largest& largest) const override { return 2.0 * largest.radius + room_; }
  double longest_step(double, double desired_speed) const override { return 0.5 * room_ / desired_speed; }

 private:
  double room_;
};

}  // namespace

ModelKind polite() {
  return {"polite", "Stands while somebody is ahead.", kParameters,
          [](std::span<const double> values) -> std::unique_ptr<WalkingModel> {
            return std::make_unique<Polite>(values[0]);
          }};
}

}  // namespace throng
