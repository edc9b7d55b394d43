// SPDX-License-Identifier: MIT
// Engines x scenes x threads x checkpoints at steps 1, 7 and 1000: a run that goes on has the bits of one
// that was never interrupted.
#include <gtest/gtest.h>

#include <ostream>

#include "sim/recording/checkpoint.h"
#include "sim/simulation.h"
#include "tests/durability/durable_run.h"
#include "tests/sim/recording/scenes.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

constexpr std::int64_t kFurther = 25;  // steps that both go on

struct Case {
  const char* scene;
  bool large;  ///< a thousand steps take long
};

void PrintTo(const Case& one, std::ostream* out) {
  *out << one.scene;
}

class ResumeMatrix : public ::testing::TestWithParam<Case> {
 protected:
  std::vector<std::int64_t> checkpoints() const {
    if (GetParam().large && !full_length()) return {1, 7};
    return {1, 7, 1000};
  }

  void go_on(Simulation& run, std::int64_t steps) {
    for (std::int64_t i = 0; i < steps; ++i) run.step();
  }

  State saved_and_read(const State& state) {
    recording::write_checkpoint(folder / "a.ckpt", {"", "", 1, 1}, state);
    return recording::read_checkpoint(folder / "a.ckpt").state;
  }

  testing_recordings::Folder folder;
};

TEST_P(ResumeMatrix, TheNativeEngineGoesOnBitForBitOnOneAndTwoThreads) {
  Scene scene = gallery_scene(GetParam().scene);
  scene.sensors.push_back({"near", {}, 0.5, 360.0, Screens::none, 3, false});
  const auto whole = simulation(scene, 2);
  for (const std::int64_t at : checkpoints()) {
    go_on(*whole, at - whole->state().step);
    const State saved = saved_and_read(whole->state());
    // the uninterrupted run is not touched: it, too, has memory of its own that must not matter
    go_on(*whole, at == 1 ? 5 : kFurther);
    for (int threads : {1, 2}) {
      const auto resumed = simulation(scene, threads);
      ASSERT_TRUE(resumed->restore(saved));
      EXPECT_EQ(resumed->state().step, at);
      go_on(*resumed, whole->state().step - at);
      EXPECT_EQ(hash(resumed->state()), hash(whole->state()))
          << "from step " << at << ", " << threads << " threads";
      EXPECT_EQ(resumed->state().sensed, whole->state().sensed) << "from step " << at;
      EXPECT_EQ(resumed->state().crowd.measured, whole->state().crowd.measured) << "from step " << at;
      EXPECT_EQ(resumed->contacts(), whole->contacts()) << "from step " << at;
    }
  }
}

TEST_P(ResumeMatrix, Box2dSaysThatItCannotAndGetsThereAgainByStepping) {
  Scene scene = gallery_scene(GetParam().scene);
  scene.engine = Engine::box2d;
  if (scene.domain.kind == DomainKind::periodic || scene.contact != ContactModel::impulse ||
      scene.crowd.size() > 0) {
    EXPECT_ANY_THROW(simulation(scene));  // nothing to go on with
    return;
  }
  const auto whole = simulation(scene), again = simulation(scene);
  go_on(*whole, 7);
  const State saved = saved_and_read(whole->state());
  EXPECT_FALSE(again->restore(saved));
  EXPECT_EQ(again->state().step, 0);
  go_on(*again, 7);
  EXPECT_EQ(hash(again->state()), hash(saved));
}

/// Without the impulses of the last step the bits would differ: the matrix would see a checkpoint that
/// forgets.
TEST(ResumeMatrixSample, HasContactsWhoseImpulsesMatter) {
  for (const char* name : {"pile", "pyramid", "mixed"}) {
    const Scene scene = gallery_scene(name);
    const auto whole = simulation(scene), forgetful = simulation(scene);
    const int steps = std::string(name) == "pyramid" ? 7 : 100;
    for (int i = 0; i < steps; ++i) whole->step();
    State state = whole->state();
    EXPECT_GT(state.disc_contacts.size() + state.point_contacts.size(), 10u) << name;
    state.disc_contacts.clear(), state.point_contacts.clear();
    forgetful->restore(state);
    for (int i = 0; i < 3; ++i) whole->step(), forgetful->step();
    EXPECT_NE(hash(whole->state()), hash(forgetful->state())) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, ResumeMatrix,
                         ::testing::Values(Case{"gas", false}, Case{"pile", true}, Case{"polygons", true},
                                           Case{"pyramid", true}, Case{"hopper", false}, Case{"gears", false},
                                           Case{"billiard", false}, Case{"cradle", false},
                                           Case{"mixed", false}, Case{"drum", true},
                                           Case{"counterflow", true}),
                         [](const auto& one) { return std::string(one.param.scene); });

}  // namespace
}  // namespace throng
