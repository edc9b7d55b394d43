// SPDX-License-Identifier: MIT
// The queue against its definition: in each sweep all contacts are looked at, one after the other, part after
// part, those that join parts last.
#include "sim/contact/bounce_queue.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "sim/contact/face_stand.h"
#include "sim/contact/solve.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Sweeps over all, with who was struck before in mind.
class AllOfThem {
 public:
  AllOfThem(Contacts& contacts, const Parts& parts, std::vector<SolverBody>& bodies)
      : contacts_(contacts), parts_(parts), bodies_(bodies), struck_(bodies.size()) {
    prepare(contacts.disc_bounces, bodies, nullptr);
    prepare(contacts.point_bounces, bodies);
  }

  /// Returns how many were struck or corrected.
  int sweep(const BounceRule& rule) {
    int n = 0;
    for (std::size_t group = 0; group < parts_.groups(); ++group) n += sweep(group, rule);
    return n;
  }

 private:
  int sweep(std::size_t group, const BounceRule& rule) {
    int n = 0;
    for (DiscContact& contact : contacts_.disc_bounces)
      if (parts_.group(contact.a, contact.b) == group)
        n += look(contact.a, contact.b, rule,
                  [&](const BounceRule& r) { return bounce(contact, bodies_, r); });
    std::span<PointContact> left = contacts_.point_bounces;
    while (!left.empty()) {
      std::size_t count = 1;
      while (count < left.size() && left[count].a == left[0].a && left[count].b == left[0].b) ++count;
      if (parts_.group(left[0].a, left[0].b) == group) n += look_at_points(left.first(count), rule);
      left = left.subspan(count);
    }
    return n;
  }

  bool look_at_points(std::span<PointContact> pair, const BounceRule& rule) {
    const SolverBody &a = bodies_[pair[0].a], &b = bodies_[pair[0].b];
    std::vector<FaceStand> stands(pair.size());
    find_stands(pair, a, b, stands);
    turn_faces(pair, stands, a, b, rule.h);
    return look(pair[0].a, pair[0].b, rule, [&](const BounceRule& r) { return bounce(pair, bodies_, r); });
  }

  template <class F>
  bool look(std::uint32_t a, std::uint32_t b, BounceRule rule, F f) {
    if (struck_[a] || struck_[b]) rule.hit_speed = rule.follow_speed;
    if (!f(rule)) return false;
    for (const std::uint32_t i : {a, b}) struck_[i] = bodies_[i].is_dynamic();
    return true;
  }

  Contacts& contacts_;
  const Parts& parts_;
  std::vector<SolverBody>& bodies_;
  std::vector<bool> struck_;
};

/// `wide` times as many as fit into 9 m.
std::string bouncing_heap(double restitution, int wide) {
  std::ostringstream text;
  const int width = 9 * wide;
  text << "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\nseed = 5\n"
       << material(restitution, 0.4) << "[domain]\nbox = [[0, 0], [" << width
       << ", 40]]\n[shapes]\nball = { disc = { radius = { uniform = [0.2, 0.4] } } }\n"
          "box = { polygon = [[0, 0], [0.6, 0], [0.6, 0.4], [0, 0.4]] }\n[[bodies]]\nshape = \"ball\"\ncount "
          "= "
       << 90 * wide << "\nplace = { random = { within = [[0, 0], [" << width
       << ", 14]] } }\n[[bodies]]\nshape = \"box\"\ncount = " << 60 * wide
       << "\nplace = { random = { within = [[0, 14], [" << width << ", 24]] } }\n";
  return text.str();
}

/// The heap's bodies by their rows, thrown about as it rests.
std::vector<SolverBody> in_new_haste(const Trial& run, std::mt19937& random) {
  std::normal_distribution<double> speed(0.0, 1.0);
  std::vector<SolverBody> bodies;
  for (std::size_t row = 0; row < run.work.bodies.size(); ++row) bodies.push_back(run.work.bodies[row]);
  for (SolverBody& body : bodies)
    if (body.is_dynamic() && random() % 4 == 0)
      body.velocity += Vec(speed(random), speed(random)), body.spin += speed(random);
  return bodies;
}

/// Compares `rounds` times, so many steps apart; how many were struck.
int compare(Trial& run, int rounds, int steps) {
  std::mt19937 random(7);
  const Parts& parts = run.work.finder.parts();
  Workers two(2);
  int struck = 0;
  for (int round = 0; round < rounds; ++round) {
    run.steps(steps);
    std::vector<SolverBody> bodies = in_new_haste(run, random), others = bodies;
    Contacts contacts = run.work.contacts, same = contacts;
    const double h = run.work.solver.h;
    const Vec kick = h * run.scene.gravity;
    const BounceRule rule{h, h, 2.0 * kick.norm(), 0.1, 0.005, kick, nullptr, 0.0, h};
    AllOfThem all(contacts, parts, bodies);
    BounceQueue queue;
    queue.start_step(same, parts);
    queue.start(others, rule, two);
    for (int sweep = 0; sweep < 12; ++sweep) {
      struck += all.sweep(rule);
      queue.sweep(same, others, rule, two);
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        EXPECT_EQ(bodies[i].velocity, others[i].velocity) << "round " << round << ", sweep " << sweep;
        EXPECT_EQ(bodies[i].spin, others[i].spin) << "round " << round << ", sweep " << sweep;
        if (testing::Test::HasFailure()) return struck;
      }
    }
  }
  return struck;
}

TEST(BounceQueue, StrikesWhomSweepsOverAllStrike) {
  for (const double restitution : {0.0, 0.3}) {
    Trial run(bouncing_heap(restitution, 1));
    ASSERT_EQ(run.work.finder.parts().count(), 1u);
    EXPECT_GT(compare(run, 60, 5), 100) << restitution;
  }
}

TEST(BounceQueue, StrikesInPartsWhomSweepsOverAllStrike) {
  for (const double restitution : {0.0, 0.3}) {
    Trial run(bouncing_heap(restitution, 60));
    ASSERT_EQ(run.work.finder.parts().count(), 2u);
    EXPECT_GT(compare(run, 3, 60), 10'000) << restitution;
  }
}

}  // namespace
}  // namespace throng
