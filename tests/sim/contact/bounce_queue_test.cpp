// SPDX-License-Identifier: MIT
// The queue against its definition: in each sweep all contacts are looked at, one after the other.
#include "sim/contact/bounce_queue.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/contact/face_stand.h"
#include "sim/contact/solve.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Sweeps over all, with who was struck before in mind.
class AllOfThem {
 public:
  AllOfThem(Contacts& contacts, std::vector<SolverBody>& bodies)
      : contacts_(contacts), bodies_(bodies), struck_(bodies.size()) {
    prepare(contacts.disc_bounces, bodies, nullptr);
    prepare(contacts.point_bounces, bodies);
  }

  bool sweep(const BounceRule& rule) {
    bool any = false;
    for (DiscContact& contact : contacts_.disc_bounces)
      any |=
          look(contact.a, contact.b, rule, [&](const BounceRule& r) { return bounce(contact, bodies_, r); });
    std::span<PointContact> left = contacts_.point_bounces;
    while (!left.empty()) {
      std::size_t count = 1;
      while (count < left.size() && left[count].a == left[0].a && left[count].b == left[0].b) ++count;
      const std::span<PointContact> pair = left.first(count);
      const SolverBody &a = bodies_[pair[0].a], &b = bodies_[pair[0].b];
      std::vector<FaceStand> stands(pair.size());
      find_stands(pair, a, b, stands);
      turn_faces(pair, stands, a, b, rule.h);
      any |= look(pair[0].a, pair[0].b, rule, [&](const BounceRule& r) { return bounce(pair, bodies_, r); });
      left = left.subspan(count);
    }
    return any;
  }

 private:
  template <class F>
  bool look(std::uint32_t a, std::uint32_t b, BounceRule rule, F f) {
    if (struck_[a] || struck_[b]) rule.hit_speed = rule.follow_speed;
    if (!f(rule)) return false;
    for (const std::uint32_t i : {a, b}) struck_[i] = bodies_[i].inverse_mass > 0.0;
    return true;
  }

  Contacts& contacts_;
  std::vector<SolverBody>& bodies_;
  std::vector<bool> struck_;
};

std::string bouncing_heap(double restitution) {
  return "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\nseed = 5\n" +
         material(restitution, 0.4) +
         "[domain]\nbox = [[0, 0], [9, 40]]\n[shapes]\nball = { disc = { radius = { uniform = [0.2, 0.4] } } "
         "}\n"
         "box = { polygon = [[0, 0], [0.6, 0], [0.6, 0.4], [0, 0.4]] }\n"
         "[[bodies]]\nshape = \"ball\"\ncount = 90\nplace = { random = { within = [[0, 0], [9, 14]] } }\n"
         "[[bodies]]\nshape = \"box\"\ncount = 60\nplace = { random = { within = [[0, 14], [9, 24]] } }\n";
}

/// The heap's bodies, thrown about as it rests.
std::vector<SolverBody> in_new_haste(const Trial& run, std::mt19937& random) {
  std::normal_distribution<double> speed(0.0, 1.0);
  const std::span<const SolverBody> at_rest = run.work.bodies.in_order();
  std::vector<SolverBody> bodies(at_rest.begin(), at_rest.end());
  for (SolverBody& body : bodies)
    if (body.inverse_mass > 0.0 && random() % 4 == 0)
      body.velocity += Vec(speed(random), speed(random)), body.spin += speed(random);
  return bodies;
}

TEST(BounceQueue, StrikesWhomSweepsOverAllStrike) {
  for (const double restitution : {0.0, 0.3}) {
    Trial run(bouncing_heap(restitution));
    std::mt19937 random(7);
    int struck = 0;
    for (int round = 0; round < 60; ++round) {
      run.steps(5);
      if (restitution == 0.0 && run.work.contacts.hits == 0) continue;
      std::vector<SolverBody> bodies = in_new_haste(run, random), others = bodies;
      Contacts contacts = run.work.contacts, same = contacts;
      const double h = run.work.solver.h;
      const Vec kick = h * run.scene.gravity;
      const BounceRule rule{h, h, 2.0 * kick.norm(), 0.1, 0.005, kick, nullptr, 0.0, h};
      AllOfThem all(contacts, bodies);
      BounceQueue queue;
      queue.start_step(same);
      queue.start(others, rule);
      for (int sweep = 0; sweep < 12; ++sweep) {
        struck += all.sweep(rule);
        queue.sweep(same, others, rule);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
          ASSERT_EQ(bodies[i].velocity, others[i].velocity) << "round " << round << ", sweep " << sweep;
          ASSERT_EQ(bodies[i].spin, others[i].spin) << "round " << round << ", sweep " << sweep;
        }
      }
    }
    EXPECT_GT(struck, 100) << restitution;
  }
}

}  // namespace
}  // namespace throng
