// SPDX-License-Identifier: MIT
// The queue against its definition: in each sweep all contacts are looked at, one after the other, part after
// part, those that join parts last.
#include "sim/contact/bounce_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <sstream>
#include <utility>

#include "sim/contact/face_stand.h"
#include "sim/contact/solve.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

struct Strikes {
  int all = 0, joining = 0;  // those of contacts that join parts
};

template <class Contact>
bool bounces(std::span<const Contact> contacts) {
  return std::ranges::any_of(contacts, [](const Contact& contact) { return contact.restitution > 0.0; });
}

/// Sweeps over all, with who was struck before in mind.
class AllOfThem {
 public:
  AllOfThem(Contacts& contacts, const Parts& parts, std::vector<SolverBody>& bodies)
      : contacts_(contacts),
        parts_(parts),
        bodies_(bodies),
        struck_(bodies.size()),
        touched_(bodies.size()),
        stopped_(bodies.size()) {
    prepare_all();
  }

  Strikes sweep(const BounceRule& rule) {
    Strikes strikes;
    for (std::size_t group = 0; group < parts_.groups(); ++group) {
      const int n = sweep(group, rule);
      strikes.all += n;
      if (parts_.groups() > 1 && group + 1 == parts_.groups()) strikes.joining = n;
    }
    return strikes;
  }

  /// From now on only those who touch somebody that was struck.
  void go_on() {
    struck_.assign(struck_.size(), false), of_touched_ = true;
    prepare_all();
  }

  /// Of each body, since the beginning: by what it hit without a bounce.
  const std::vector<bool>& stopped() const { return stopped_; }

 private:
  void prepare_all() {
    prepare(contacts_.disc_bounces, bodies_, nullptr);
    prepare(contacts_.point_bounces, bodies_);
  }

  int sweep(std::size_t group, const BounceRule& rule) {
    int n = 0;
    for (DiscContact& contact : contacts_.disc_bounces)
      if (parts_.group(contact.a, contact.b) == group)
        n += look(contact.a, contact.b, bounces<DiscContact>({&contact, 1}), rule,
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
    turn_faces(pair, stands, a, b, rule.turning_h);
    return look(pair[0].a, pair[0].b, bounces<PointContact>(pair), rule,
                [&](const BounceRule& r) { return bounce(pair, bodies_, r); });
  }

  template <class F>
  bool look(std::uint32_t a, std::uint32_t b, bool bounces, BounceRule rule, F f) {
    if (of_touched_ && !touched_[a] && !touched_[b]) return false;
    if (struck_[a] || struck_[b]) rule.hit_speed = rule.follow_speed;
    if (!f(rule)) return false;
    for (const std::uint32_t i : {a, b})
      if (bodies_[i].is_dynamic()) struck_[i] = touched_[i] = true, stopped_[i] = stopped_[i] || !bounces;
    return true;
  }

  Contacts& contacts_;
  const Parts& parts_;
  std::vector<SolverBody>& bodies_;
  std::vector<bool> struck_, touched_;  // since prepare_all(), and since the beginning
  std::vector<bool> stopped_;
  bool of_touched_ = false;
};

/// The same bodies, each in some other's slot.
struct Shuffled {
  BodySlots slots;
  std::vector<SolverBody> bodies;

  Shuffled(const std::vector<SolverBody>& in_order, std::mt19937& random) : bodies(in_order) {
    std::vector<std::uint32_t> slot(in_order.size());
    std::iota(slot.begin(), slot.end(), 0u);
    std::ranges::shuffle(slot, random);
    slots = BodySlots(std::move(slot));
    copy(in_order);
  }

  void copy(const std::vector<SolverBody>& in_order) {
    for (std::uint32_t row = 0; row < in_order.size(); ++row) bodies[slots.slot(row)] = in_order[row];
  }

  BodyRows<SolverBody> rows() { return {bodies, slots}; }
};

/// `wide` times as many as fit into 9 m, `high` times as high; two boxes don't bounce off each other.
std::string bouncing_heap(double restitution, int wide, int high) {
  std::ostringstream text;
  const int width = 9 * wide, low = 14 * high, top = 24 * high;
  text << "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\nseed = 5\n"
       << material(restitution, 0.4) << "[domain]\nbox = [[0, 0], [" << width << ", " << top + 16
       << "]]\n[shapes]\nball = { disc = { radius = { uniform = [0.2, 0.4] } } }\n"
          "box = { polygon = [[0, 0], [0.6, 0], [0.6, 0.4], [0, 0.4]] }\n[materials.dull]\nfriction = 0.4\n"
          "[[bodies]]\nshape = \"ball\"\ncount = "
       << 90 * wide * high << "\nplace = { random = { within = [[0, 0], [" << width << ", " << low
       << "]] } }\n[[bodies]]\nshape = \"box\"\nmaterial = \"dull\"\ncount = " << 60 * wide * high
       << "\nplace = { random = { within = [[0, " << low << "], [" << width << ", " << top << "]] } }\n";
  return text.str();
}

void throw_about(std::vector<SolverBody>& bodies, std::mt19937& random) {
  std::normal_distribution<double> speed(0.0, 1.0);
  for (SolverBody& body : bodies)
    if (body.is_dynamic() && random() % 4 == 0)
      body.velocity += Vec(speed(random), speed(random)), body.spin += speed(random);
}

void move(std::vector<SolverBody>& bodies, double h) {
  for (SolverBody& body : bodies) body.position += h * body.velocity, body.turn += h * body.spin;
}

void expect_same(const std::vector<SolverBody>& bodies, BodyRows<const SolverBody> others) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    ASSERT_EQ(bodies[i].velocity, others[i].velocity) << "body " << i;
    ASSERT_EQ(bodies[i].spin, others[i].spin) << "body " << i;
  }
}

void expect_stopped(const std::vector<bool>& stopped, const BounceQueue& queue,
                    BodyRows<const SolverBody> bodies) {
  std::vector<bool> told(stopped.size());
  queue.for_each_stopped(bodies, [&](std::uint32_t row) { told[row] = true; });
  EXPECT_EQ(told, stopped);
}

/// Compares `rounds` times, so many steps apart, a substep's sweeps before and after bodies move, thrown
/// about each time; who was struck.
Strikes compare(Trial& run, int rounds, int steps) {
  std::mt19937 random(7);
  const Parts& parts = run.work.finder.parts();
  Workers two(2);
  BounceQueue queue;
  Strikes strikes;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    run.steps(steps);
    std::vector<SolverBody> bodies;
    for (std::size_t row = 0; row < run.work.bodies.size(); ++row) bodies.push_back(run.work.bodies[row]);
    throw_about(bodies, random);
    Shuffled others(bodies, random);
    Contacts contacts = run.work.contacts, same = contacts;
    const double h = run.work.solver.h;
    const Vec kick = h * run.scene.gravity;
    const BounceRule before{h, h, 2.0 * kick.norm(), 0.1, 0.005, kick, nullptr, 0.0, h};
    BounceRule after = before;
    after.turning_h = -h, after.threshold = std::numeric_limits<double>::infinity();
    AllOfThem all(contacts, parts, bodies);
    queue.start_step(same, parts);
    queue.start(others.rows(), before, two);
    const auto sweep = [&](const BounceRule& rule) {
      for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        const Strikes now = all.sweep(rule);
        strikes.all += now.all, strikes.joining += now.joining;
        queue.sweep(same, others.rows(), rule, two);
        expect_same(bodies, others.rows());
        if (testing::Test::HasFatalFailure()) return;
      }
    };
    sweep(before);
    expect_stopped(all.stopped(), queue, others.rows());
    move(bodies, h), throw_about(bodies, random), others.copy(bodies);
    all.go_on(), queue.go_on();
    sweep(after);
    if (testing::Test::HasFatalFailure()) break;
  }
  return strikes;
}

TEST(BounceQueue, StrikesWhomSweepsOverAllStrike) {
  for (const double restitution : {0.0, 0.3}) {
    Trial run(bouncing_heap(restitution, 1, 1));
    ASSERT_EQ(run.work.finder.parts().count(), 1u);
    EXPECT_GT(compare(run, 60, 5).all, 100) << restitution;
  }
}

TEST(BounceQueue, StrikesInPartsWhomSweepsOverAllStrike) {
  for (const double restitution : {0.0, 0.3}) {
    Trial run(bouncing_heap(restitution, 15, 4));
    ASSERT_EQ(run.work.finder.parts().count(), 2u);
    const Strikes strikes = compare(run, 3, 60);
    EXPECT_GT(strikes.all, 10'000) << restitution;
    EXPECT_GT(strikes.joining, 10) << restitution;
  }
}

}  // namespace
}  // namespace throng
