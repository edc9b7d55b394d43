// SPDX-License-Identifier: MIT
// The wide solver against its definition, contact after contact in solve.cpp: equal bits on every machine.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <random>
#include <utility>

#include "sim/contact/disc_blocks.h"
#include "sim/contact/face_blocks.h"
#include "sim/periodic.h"

namespace throng {
namespace {

constexpr std::uint32_t kSolverBodies = 90;  // the last stands for all obstacles
const Vec kPeriod(12.0, 11.0);
/// By which some contacts learn, and others bear too much or pass each other.
constexpr Learning kLearning{0.3, 5e-4, 2.0, 0.2, 1000.0};

/// What both ways begin with.
class Blocks : public ::testing::TestWithParam<std::int64_t> {
 protected:
  Blocks() {
    SCOPED_TRACE(seed_);
    hwy::SetSupportedTargetsForTest(GetParam());
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (std::uint32_t i = 0; i < kSolverBodies; ++i) bodies_.push_back(body(i));
  }
  ~Blocks() override {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec vec(double most) { return {uniform(-most, most), uniform(-most, most)}; }

  SolverBody body(std::uint32_t row) {
    SolverBody result{};
    if (row + 1 == kSolverBodies) return result;
    result.position = row == 4 ? bodies_[3].position : Vec(uniform(0.0, 12.0), uniform(0.0, 11.0));
    result.velocity = vec(2.0), result.spin = uniform(-3.0, 3.0), result.turn = uniform(-0.2, 0.2);
    const bool moves = row % 7 != 0;
    result.inverse_mass = moves ? uniform(0.1, 10.0) : 0.0;
    result.inverse_inertia = moves ? uniform(0.1, 10.0) : 0.0;
    return result;
  }

  /// Two bodies of which one moves; now and then the second is an obstacle.
  void choose(ContactBase& contact) {
    do {
      contact.a = static_cast<std::uint32_t>(random_() % (kSolverBodies - 1));
      contact.b =
          random_() % 9 == 0 ? kSolverBodies - 1 : static_cast<std::uint32_t>(random_() % kSolverBodies);
    } while (contact.a == contact.b ||
             (bodies_[contact.a].inverse_mass == 0.0 && bodies_[contact.b].inverse_mass == 0.0));
    const SolverBody &a = bodies_[contact.a], &b = bodies_[contact.b];
    // Not more than what they feel with arms of 1.4 m: else impulses grow from sweep to sweep.
    contact.normal_mass =
        1.0 / (a.inverse_mass + b.inverse_mass + 2.0 * (a.inverse_inertia + b.inverse_inertia));
    contact.tangent_mass = uniform(0.5, 1.0) * contact.normal_mass;
    contact.friction = uniform(0.0, 0.8);
    const bool pressed = random_() % 3 != 0;
    contact.normal_impulse = pressed ? uniform(0.0, 0.1) : 0.0;
    contact.tangent_impulse = pressed ? uniform(-0.05, 0.05) : 0.0;
    contact.preload = random_() % 2 ? uniform(0.0, 1.0) * contact.normal_impulse : 0.0;
  }

  SolverSettings settings(bool friction) const {
    // Half of what overlaps is so deep that the speed is limited.
    return {0.0025, softness(0.18 / 0.0025, 10.0, 0.0025), Learning{}, 1.0, friction, 0.03};
  }

  void move(std::vector<SolverBody>& bodies) const {
    for (SolverBody& body : bodies) body.position += 0.0025 * body.velocity, body.turn += 0.0025 * body.spin;
  }

  void expect_same(BodyRows<const SolverBody> one, BodyRows<const SolverBody> other) const {
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].velocity, other[i].velocity) << "body " << i;
      EXPECT_EQ(one[i].position, other[i].position) << "body " << i;
      EXPECT_EQ(one[i].spin, other[i].spin) << "body " << i;
      EXPECT_EQ(one[i].inverse_mass, other[i].inverse_mass) << "body " << i;
    }
  }

  static void expect_same(const ContactBase& one, const ContactBase& other) {
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(one.normal_impulse, other.normal_impulse);
    EXPECT_EQ(one.tangent_impulse, other.tangent_impulse);
  }

  /// Both kinds of answer must be among the contacts, or little was tested.
  template <class Contact>
  static void expect_some_press(const std::vector<Contact>& contacts) {
    const auto pressing =
        std::ranges::count_if(contacts, [](const Contact& c) { return c.normal_impulse > 0.0; });
    EXPECT_GT(pressing, static_cast<std::ptrdiff_t>(contacts.size() / 8));
    EXPECT_LT(pressing, static_cast<std::ptrdiff_t>(contacts.size() * 9 / 10));
  }

  /// As above: some learn, some bear too much, and some pass each other.
  template <class Contact>
  void expect_some_learn(const std::vector<Contact>& contacts) const {
    int learn = 0, bear_too_much = 0, pass = 0;
    for (const Contact& c : contacts) {
      if (!(c.normal_impulse > 0.0)) continue;
      const bool much = c.normal_impulse >= kLearning.most * c.normal_mass * kLearning.weight;
      const bool fast = (bodies_[c.b].velocity - bodies_[c.a].velocity).norm() >= kLearning.slow;
      learn += !much && !fast, bear_too_much += much && !fast, pass += fast && !much;
    }
    EXPECT_GT(learn, 3);
    EXPECT_GT(bear_too_much, 3);
    EXPECT_GT(pass, 3);
  }

  const unsigned seed_ = std::random_device()();
  std::mt19937 random_{seed_};
  std::vector<SolverBody> bodies_;
};

class DiscBlocksOnEachTarget : public Blocks {
 protected:
  std::vector<DiscContact> contacts(const Vec* period) {
    std::vector<DiscContact> result(250);
    for (DiscContact& contact : result) {
      choose(contact);
      if (&contact == &result[0]) contact.a = 3, contact.b = 4;  // in one place
      reach(contact, period);
    }
    return result;
  }

  /// As wide as the two are apart, nearly.
  void reach(DiscContact& contact, const Vec* period) {
    const SolverBody &a = bodies_[contact.a], &b = bodies_[contact.b];
    const Vec between = b.position - a.position;
    const double width = (period ? nearest_image(between, *period) : between).norm() + uniform(0.0, 0.3);
    contact.radius_a = uniform(0.2, 0.8) * width, contact.radius_b = width - contact.radius_a - 0.1;
    contact.normal_mass = 1.0 / (a.inverse_mass + b.inverse_mass);
    contact.tangent_mass =
        1.0 / (1.0 / contact.normal_mass + a.inverse_inertia * contact.radius_a * contact.radius_a +
               b.inverse_inertia * contact.radius_b * contact.radius_b);
  }

  /// Seats for the contacts, under even keys, and between them for others, who leave again.
  void fill(DiscBlocks& blocks, const std::vector<DiscContact>& contacts,
            const std::vector<DiscContact>& others) const {
    blocks.start(bodies_.size());
    std::vector<std::uint64_t> even, odd;
    for (const DiscContact& contact : contacts) {
      const DiscContact& other = others[even.size()];
      even.push_back(2 * even.size()), odd.push_back(even.back() + 1);
      blocks.add(even.back(), contact, bodies_[contact.a], bodies_[contact.b]);
      blocks.add(odd.back(), other, bodies_[other.a], bodies_[other.b]);
    }
    blocks.finish();
    Workers alone(1);
    EXPECT_TRUE(blocks.take(odd, alone));
    EXPECT_TRUE(blocks.take(even, alone));
    EXPECT_EQ(blocks.size(), contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i)
      blocks.set_impulses(i, {contacts[i].normal_impulse, contacts[i].tangent_impulse, contacts[i].preload});
  }

  /// How many normals are others as they look ahead.
  std::ptrdiff_t turned(const std::vector<DiscContact>& contacts, const Vec* period, double ahead) const {
    std::vector<DiscContact> now = contacts, then = contacts;
    prepare(now, bodies_, period), prepare(then, bodies_, period, ahead);
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < now.size(); ++i) count += now[i].normal != then[i].normal;
    return count;
  }

  void compare(const Vec* period, bool friction, double ahead = 0.0) {
    std::vector<DiscContact> one = contacts(period);
    if (ahead > 0.0) {
      EXPECT_GT(turned(one, period, ahead), 10);
    }
    std::vector<SolverBody> bodies = bodies_;
    SolverSettings how = settings(friction);
    DiscBlocks blocks;
    fill(blocks, contacts(period), one);  // forgotten, and then other lanes are left over
    fill(blocks, one, contacts(period));
    expect_some_learn(one);
    learn(one, bodies_, kLearning), learn(blocks.blocks(), bodies, kLearning);
    for (int i = 0; i < 3; ++i) {
      how.backward = i == 1;
      prepare(one, bodies_, period, ahead), warm_start(one, bodies_);
      push_apart(one, bodies_, how);
      expect_some_press(one);
      move(bodies_), relax(one, bodies_, how);
      prepare_and_start(blocks.blocks(), bodies, period, ahead);
      push_apart(blocks.blocks(), bodies, how), move(bodies), relax(blocks.blocks(), bodies, how, period);
    }
    expect_same(bodies_, bodies);
    for (std::size_t i = 0; i < one.size(); ++i) {
      expect_same(one[i], blocks[i]);
      EXPECT_EQ(one[i].preload, blocks.impulses(i).preload);
    }
  }
};

TEST_P(DiscBlocksOnEachTarget, GiveTheBitsOfContactAfterContact) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  compare(nullptr, true);
}

TEST_P(DiscBlocksOnEachTarget, GiveThemWithoutFriction) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  compare(nullptr, false);
}

TEST_P(DiscBlocksOnEachTarget, GiveThemInADomainThatRepeats) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  compare(&kPeriod, true);
}

TEST_P(DiscBlocksOnEachTarget, GiveThemOfDiscsThatLookAhead) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  compare(nullptr, true, 0.1);
  compare(&kPeriod, false, 0.1);
}

TEST(DiscBlocks, SayWhoHasNoSeat) {
  std::vector<SolverBody> bodies(3);
  bodies[0].inverse_mass = bodies[1].inverse_mass = 1.0;
  DiscContact contact;
  contact.a = 0, contact.b = 1, contact.normal_mass = 0.5;
  DiscBlocks blocks;
  blocks.start(bodies.size());
  for (const std::uint64_t key : {3, 5}) blocks.add(key, contact, bodies[0], bodies[1]);
  blocks.finish();
  Workers alone(1);
  const std::vector<std::vector<std::uint64_t>> unknown{{2}, {3, 4}, {4, 5}, {3, 5, 6}};
  for (const auto& keys : unknown) EXPECT_FALSE(blocks.take(keys, alone));
  const std::vector<std::vector<std::uint64_t>> known{{}, {5}, {3}, {3, 5}};
  for (const auto& keys : known) {
    EXPECT_TRUE(blocks.take(keys, alone));
    EXPECT_EQ(blocks.size(), keys.size());
  }
}

TEST(DiscBlocks, TakeTheSameSeatsForAnyNumberOfThreads) {
  constexpr std::uint64_t kSeats = 4000;
  std::vector<SolverBody> bodies(2 * kSeats + 1);
  for (SolverBody& body : bodies) body.inverse_mass = 1.0;
  DiscBlocks one, two;
  for (DiscBlocks* blocks : {&one, &two}) {
    blocks->start(bodies.size());
    for (std::uint32_t key = 0; key < kSeats; ++key) {
      DiscContact contact;
      contact.a = 2 * key, contact.b = 2 * key + 1, contact.normal_mass = 0.5 + key;
      blocks->add(key, contact, bodies[contact.a], bodies[contact.b]);
    }
    blocks->finish();
  }
  Workers alone(1), both(2);
  std::mt19937 random(3);
  for (const unsigned share : {2u, 7u, 1u}) {
    std::vector<std::uint64_t> keys;
    for (std::uint64_t key = 0; key < kSeats; ++key)
      if (random() % share == 0) keys.push_back(key);
    ASSERT_TRUE(one.take(keys, alone));
    ASSERT_TRUE(two.take(keys, both));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      EXPECT_EQ(two.contact(i).a, 2 * keys[i]);
      EXPECT_EQ(*two.contact(i).normal_mass, 0.5 + static_cast<double>(keys[i]));
    }
    ASSERT_EQ(one.blocks().size(), two.blocks().size());
    for (std::size_t i = 0; i < one.blocks().size(); ++i)
      for (std::size_t lane = 0; lane < BlockOrder::kWidth; ++lane) {
        EXPECT_EQ(one.blocks()[i].a[lane], two.blocks()[i].a[lane]);
        EXPECT_EQ(one.blocks()[i].normal_mass[lane], two.blocks()[i].normal_mass[lane]);
      }
    keys.push_back(kSeats);
    EXPECT_FALSE(two.take(keys, both)) << "one has no seat";
  }
}

class FaceBlocksOnEachTarget : public Blocks {
 protected:
  /// Faces of one or two points: those of the same bodies that follow each other.
  std::vector<PointContact> contacts() {
    std::vector<PointContact> result;
    while (result.size() < 400) {
      PointContact point;
      choose(point);
      const double angle = uniform(-3.0, 3.0);
      point.normal = {std::cos(angle), std::sin(angle)};
      point.round_a = random_() % 4 ? 0.0 : uniform(0.1, 0.5);
      point.round_b = random_() % 4 ? 0.0 : uniform(0.1, 0.5);
      for (std::uint64_t n = 1 + random_() % 2; n > 0; --n) {
        point.first_a = vec(1.0), point.first_b = vec(1.0);
        point.gap = uniform(-0.1, 0.1) -
                    point.normal.dot(bodies_[point.b].position - bodies_[point.a].position + point.first_b -
                                     point.first_a) +
                    point.round_a + point.round_b;
        point.normal_impulse *= uniform(0.5, 1.0);
        result.push_back(point);
        point.is_second = true;
      }
    }
    return result;
  }

  struct Face {
    std::span<const PointContact> points;
    bool seated, kept;  // from the beginning on; until the end
    std::uint32_t lane = kNoLane;
  };

  bool is_dynamic(std::uint32_t row) const { return bodies_[row].is_dynamic(); }

  static std::vector<Face> faces_of(std::span<const PointContact> points) {
    std::vector<Face> faces;
    for (std::size_t i = 0; i < points.size(); i += faces.back().points.size()) {
      const bool two = i + 1 < points.size() && points[i + 1].is_second;
      faces.push_back({points.subspan(i, two ? 2 : 1), true, true});
    }
    return faces;
  }

  /// Seats those that are seated from the beginning on, with that much room at least.
  void seat(FaceBlocks& blocks, std::vector<Face>& faces, auto room) const {
    blocks.start(bodies_.size());
    for (Face& face : faces) {
      if (!face.seated) continue;
      const auto [a, b] = std::pair(face.points[0].a, face.points[0].b);
      face.lane =
          blocks.seat(std::max<std::size_t>(face.points.size(), room()), a, is_dynamic(a), b, is_dynamic(b));
    }
    blocks.finish();
    for (const Face& face : faces)
      if (face.seated) blocks.name(face.lane, face.points[0].a, face.points[0].b);
  }

  /// Fills in those that are kept.
  static void fill(FaceBlocks& blocks, const std::vector<Face>& faces) {
    blocks.clear();
    std::size_t next = 0;
    for (const Face& face : faces) blocks.take(face.lane, face.kept ? face.points.size() : 0);
    for (const Face& face : faces)
      if (face.kept) blocks.fill(next, face.points), next += face.points.size();
  }

  /// Gives a seat to who has none, if there is a place for it between the others.
  bool squeeze_in(FaceBlocks& blocks, std::vector<Face>& faces, std::size_t i) const {
    const std::uint32_t a = faces[i].points[0].a, b = faces[i].points[0].b;
    std::size_t first = 0, end = blocks.blocks().size();
    for (std::size_t j = 0; j < faces.size(); ++j) {
      const auto is_shared = [&](std::uint32_t row) { return is_dynamic(row) && (row == a || row == b); };
      if (faces[j].lane == kNoLane) continue;
      if (!is_shared(faces[j].points[0].a) && !is_shared(faces[j].points[0].b)) continue;
      if (j < i) first = std::max(first, blocks.rank(faces[j].lane) + 1);
      if (j > i) end = std::min(end, blocks.rank(faces[j].lane));
    }
    faces[i].lane = blocks.squeeze_in(faces[i].points.size(), 0, first, end);
    if (faces[i].lane != kNoLane) blocks.name(faces[i].lane, a, b);
    return faces[i].lane != kNoLane;
  }

  void fill(FaceBlocks& blocks, std::span<const PointContact> points) const {
    std::vector<Face> faces = faces_of(points);
    seat(blocks, faces, [] { return 0u; });
    fill(blocks, faces);
  }

  void compare(bool friction) {
    const std::vector<PointContact> one = contacts();
    FaceBlocks blocks;
    fill(blocks, contacts());  // forgotten, and then other lanes are left over
    fill(blocks, one);
    compare(one, blocks, friction);
  }

  void compare(std::vector<PointContact> one, FaceBlocks& blocks, bool friction) {
    std::vector<SolverBody> bodies = bodies_;
    SolverSettings how = settings(friction);
    expect_some_learn(one);
    learn(one, bodies_, kLearning), learn(blocks.blocks(), bodies, kLearning);
    for (int i = 0; i < 3; ++i) {
      how.backward = i == 1;
      prepare(one, bodies_), warm_start(one, bodies_);
      push_apart(one, bodies_, how);
      expect_some_press(one);
      move(bodies_), relax(one, bodies_, how);
      prepare_and_start(blocks.blocks(), bodies);
      push_apart(blocks.blocks(), bodies, how), move(bodies), relax(blocks.blocks(), bodies, how);
    }
    expect_same(bodies_, bodies);
    for (std::size_t i = 0; i < one.size(); ++i) {
      expect_same(one[i], blocks[i]);
      EXPECT_EQ(one[i].preload, blocks.impulses(i).preload);
      EXPECT_EQ(one[i].arm_a, blocks[i].arm_a);
      EXPECT_EQ(one[i].arm_b, blocks[i].arm_b);
    }
  }
};

TEST_P(FaceBlocksOnEachTarget, GiveTheBitsOfContactAfterContact) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  compare(true);
}

TEST_P(FaceBlocksOnEachTarget, GiveThemWithoutFriction) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  compare(false);
}

// Seats with too much room, seats that nobody takes any more, and others between them.
TEST_P(FaceBlocksOnEachTarget, GiveThemWhicheverSeatsThereAre) {
  SCOPED_TRACE("seed " + std::to_string(seed_));
  const std::vector<PointContact> all = contacts();
  std::vector<Face> faces = faces_of(all);
  for (Face& face : faces) face.seated = random_() % 10 > 0, face.kept = !face.seated || random_() % 8 > 0;
  FaceBlocks blocks;
  seat(blocks, faces, [&] { return random_() % 4 ? 1u : 2u; });
  std::vector<Face> seated = faces;
  std::erase_if(seated, [](const Face& face) { return !face.seated; });
  for (Face& face : seated) face.kept = true;
  fill(blocks, seated);
  std::size_t squeezed = 0, out = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].seated) continue;
    if (squeeze_in(blocks, faces, i)) blocks.leave(std::exchange(faces[i].lane, kNoLane), 0);
    ++(squeeze_in(blocks, faces, i) ? squeezed : out);
  }
  EXPECT_GT(squeezed, 5u) << "beside " << out;
  std::erase_if(faces, [](const Face& face) { return face.lane == kNoLane; });
  fill(blocks, faces);
  std::vector<PointContact> kept;
  for (const Face& face : faces)
    if (face.kept) kept.insert(kept.end(), face.points.begin(), face.points.end());
  EXPECT_LT(kept.size() + 10, all.size());
  compare(kept, blocks, true);
}

TEST_P(FaceBlocksOnEachTarget, SqueezeInNobodyWhereTheOrderForbidsIt) {
  FaceBlocks blocks;
  const std::vector<PointContact> all = contacts();
  std::vector<Face> faces = faces_of(all);
  seat(blocks, faces, [] { return 0u; });
  EXPECT_EQ(blocks.squeeze_in(1, 0, 3, 2), kNoLane);
  const std::uint32_t lane = blocks.squeeze_in(1, 0, 3, 3);
  EXPECT_EQ(blocks.rank(lane), 3u);
  EXPECT_EQ(blocks.squeeze_in(1, 0, 3, 4), lane + 1) << "in the same block";
  EXPECT_NE(blocks.squeeze_in(2, 0, 3, 4), lane + 2) << "which has no room for two points";
  while (blocks.squeeze_in(1, 0, 3, 3) != kNoLane) continue;
  EXPECT_EQ(blocks.squeeze_in(1, 0, 3, 3), kNoLane) << "there is no end of them";
}

// Else the lane would write back what it read of a body that another one in the block has pushed meanwhile.
TEST_P(FaceBlocksOnEachTarget, LeaveNoBodyInASeatThatIsGivenUp) {
  FaceBlocks blocks;
  blocks.start(kSolverBodies);
  blocks.finish();
  const std::uint32_t lane = blocks.squeeze_in(1, 0, 0, 0);
  blocks.name(lane, 1, 2);
  blocks.leave(lane, 0);
  EXPECT_EQ(blocks.blocks()[0].a[lane % BlockOrder::kWidth], kSolverBodies - 1);
  EXPECT_EQ(blocks.blocks()[0].b[lane % BlockOrder::kWidth], kSolverBodies - 1);
}

std::vector<std::int64_t> targets() {
  return hwy::SupportedAndGeneratedTargets();
}

const auto name_of = [](const auto& target) { return std::string(hwy::TargetName(target.param)); };
INSTANTIATE_TEST_SUITE_P(, DiscBlocksOnEachTarget, ::testing::ValuesIn(targets()), name_of);
INSTANTIATE_TEST_SUITE_P(, FaceBlocksOnEachTarget, ::testing::ValuesIn(targets()), name_of);

}  // namespace
}  // namespace throng
