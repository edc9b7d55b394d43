// SPDX-License-Identifier: MIT
#include "sim/recording/frame_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>

#include "tests/sim/recording/scenes.h"

namespace throng::recording {
namespace {

using namespace testing_recordings;

TEST(FrameQueue, HoldsAtLeastTwoFramesAndFewOfMany) {
  EXPECT_EQ(FrameQueue(mixed_scene(0)).capacity(), 16u);
  EXPECT_EQ(FrameQueue(mixed_scene(10)).capacity(), 16u);
  Scene many;
  many.bodies.shape.resize(3'000'000);
  EXPECT_EQ(FrameQueue(many).capacity(), 2u);
}

TEST(FrameQueue, GivesFramesInTheOrderInWhichTheyCame) {
  const Scene scene = mixed_scene(3);
  FrameQueue queue(scene);
  std::thread producer([&] {
    for (int i = 0; i < 1000; ++i) queue.push(state_at(scene, i));
    queue.close();
  });
  std::int64_t expected = 0;
  while (const QueueEntry* entry = queue.front()) {
    EXPECT_FALSE(entry->checkpoint);
    EXPECT_EQ(entry->state.step, expected);
    EXPECT_EQ(entry->hash, hash(state_at(scene, expected)));
    EXPECT_EQ(hash(entry->state), entry->hash);  // all fields are recorded
    ++expected;
    queue.pop();
  }
  producer.join();
  EXPECT_EQ(expected, 1000);
}

TEST(FrameQueue, KeepsContactsInCheckpointsOnly) {
  const Scene scene = mixed_scene(3);
  State state = initial_state(scene);
  state.disc_contacts = {{7, 0, 1.0, 0.5}};
  state.point_contacts = {{8, 3, 2.0, -0.5}, {9, 1, 3.0, 0.0}};
  FrameQueue queue(scene);
  queue.push(state);
  queue.push_checkpoint(state);
  EXPECT_FALSE(queue.front()->checkpoint);
  EXPECT_TRUE(queue.front()->state.disc_contacts.empty());
  queue.pop();
  const QueueEntry& entry = *queue.front();
  EXPECT_TRUE(entry.checkpoint);
  ASSERT_EQ(entry.state.disc_contacts.size(), 1u);
  ASSERT_EQ(entry.state.point_contacts.size(), 2u);
  EXPECT_EQ(entry.state.point_contacts[1].normal, 3.0);
}

TEST(FrameQueue, MakesTheProducerWaitWhereItIsFull) {
  const Scene scene = mixed_scene(3);
  FrameQueue queue(scene);
  std::atomic<std::size_t> pushed = 0;
  std::thread producer([&] {
    for (std::size_t i = 0; i <= queue.capacity(); ++i) {
      queue.push(state_at(scene, static_cast<std::int64_t>(i)));
      ++pushed;
    }
  });
  while (pushed < queue.capacity()) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(pushed, queue.capacity());
  queue.pop();
  producer.join();
  EXPECT_EQ(pushed, queue.capacity() + 1);
}

/// Which fields the queue copies of the state of a step: position, angle, velocity, spin.
std::string copied(const Scene& scene, std::int64_t step) {
  const State state = state_at(scene, step);
  FrameQueue queue(scene);
  for (std::size_t i = 0; i < queue.capacity(); ++i)
    queue.push(state_at(scene, 0)), queue.pop();  // nothing is left of it
  queue.push(state);
  const QueueEntry& entry = *queue.front();
  EXPECT_EQ(entry.hash, hash(state)) << "of all, copied or not";
  EXPECT_EQ(entry.state.id, state.id);
  std::string fields;
  const auto add = [&fields](const char* name, const auto& place, const auto& numbers) {
    if (place.empty()) return;
    fields += name;
    EXPECT_EQ(place, numbers) << name;
  };
  add("p", entry.state.position, state.position), add("a", entry.state.angle, state.angle);
  add("v", entry.state.velocity, state.velocity), add("s", entry.state.spin, state.spin);
  return fields;
}

TEST(FrameQueue, CopiesNoMoreThanTheFrameTakes) {
  Scene scene = mixed_scene(3);
  EXPECT_EQ(copied(scene, 1), "pavs");
  scene.record.velocity = scene.record.spin = false;
  EXPECT_EQ(copied(scene, 1), "pa");
  scene.record.own_every[index(RecordField::angle)] = 2;
  EXPECT_EQ(copied(scene, 1), "p");
  EXPECT_EQ(copied(scene, 2), "pa");
}

TEST(FrameQueue, CopiesAllThatObservablesAreMeasuredOn) {
  Scene scene = mixed_scene(3);
  scene.record.velocity = scene.record.spin = scene.record.angle = false;
  scene.record.observables = 3;
  EXPECT_EQ(copied(scene, 2), "p");
  EXPECT_EQ(copied(scene, 3), "pavs");
}

/// Places tell who is in a frame, though it may hold none.
TEST(FrameQueue, CopiesPlacesWhereBodiesComeAndGo) {
  Scene scene = mixed_scene(3);
  scene.record.position = scene.record.angle = scene.record.spin = false;
  scene.record.own_every[index(RecordField::velocity)] = 2;
  EXPECT_EQ(copied(scene, 2), "v");
  scene.record.within = Eigen::AlignedBox2d(Vec(0.0, 0.0), Vec(1.0, 1.0));
  EXPECT_EQ(copied(scene, 2), "pv");
  EXPECT_EQ(copied(scene, 3), "");
}

TEST(FrameQueue, GivesALoneFrameThoughNothingFollows) {
  const Scene scene = mixed_scene(3);
  const State state = initial_state(scene);
  FrameQueue queue(scene);
  std::atomic<bool> came = false;
  std::thread consumer([&] {
    while (queue.front()) {
      came = true;
      queue.pop();
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the consumer waits by now
  queue.push(state);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!came && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_TRUE(came);
  queue.close();
  consumer.join();
}

TEST(FrameQueue, UsesTheSameMemoryAgain) {
  const Scene scene = mixed_scene(100);
  FrameQueue queue(scene);
  std::set<const void*> places;
  for (std::size_t i = 0; i < 5 * queue.capacity(); ++i) {
    queue.push(state_at(scene, static_cast<std::int64_t>(i)));
    places.insert(queue.front()->state.position.data());
    queue.pop();
  }
  EXPECT_EQ(places.size(), queue.capacity());
}

/// One who senses so many.
Sensed crowd_of(std::uint32_t n) {
  Sensed sensed{{1}, {n}, std::vector<std::uint32_t>(n, 2)};
  return sensed;
}

/// Of 13 MB each: not as many as there are slots, though the bodies are few.
TEST(FrameQueue, TakesNoMoreThan64MegabytesAndAFrameOfWhatWasSensed) {
  const Scene scene = mixed_scene(3);
  const State state = initial_state(scene);
  const Sensed many = crowd_of(3'250'000);
  FrameQueue queue(scene);
  std::atomic<int> pushed = 0;
  std::thread producer([&] {
    for (int i = 0; i < 7; ++i) queue.push(state, {}, std::span(&many, 1)), ++pushed;
    queue.close();
  });
  while (pushed < 5) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(pushed, 5);
  int came = 0;
  while (const QueueEntry* entry = queue.front()) {
    EXPECT_EQ(entry->sensed.at(0), many);
    queue.pop();
    ++came;
  }
  producer.join();
  EXPECT_EQ(came, 7);
}

/// Slots that had to hold very much would together keep what the bound forbids.
TEST(FrameQueue, ForgetsTheRoomOfFramesThatWereVeryLarge) {
  const Scene scene = mixed_scene(3);
  const State state = initial_state(scene);
  const std::vector<ContactRow> many(1'000'000);
  const Sensed crowd = crowd_of(3'250'000);
  FrameQueue queue(scene);
  for (std::size_t i = 0; i < 2 * queue.capacity(); ++i) {
    const bool large = i < queue.capacity();
    queue.push(state, large ? many : std::vector<ContactRow>(1), std::span(&crowd, large ? 1 : 0));
    const QueueEntry& entry = *queue.front();
    if (!large) {
      EXPECT_LT(entry.contacts.capacity(), 1000u) << i;
      for (const Sensed& kept : entry.sensed) EXPECT_LT(kept.whom.capacity(), 1000u) << i;
    }
    queue.pop();
  }
}

TEST(FrameQueue, KeepsWhatItHoldsOfSensedBetweenFramesWithout) {
  const Scene scene = mixed_scene(3);
  const State state = initial_state(scene);
  const Sensed some = crowd_of(100);
  FrameQueue queue(scene);
  std::set<const void*> places;
  for (std::size_t i = 0; i < 5 * queue.capacity(); ++i) {
    const bool due = i / queue.capacity() % 2 == 0;
    queue.push(state, {}, due ? std::span(&some, 1) : std::span<const Sensed>());
    const QueueEntry& entry = *queue.front();
    EXPECT_EQ(entry.sensed.at(0), due ? some : Sensed{});
    places.insert(entry.sensed[0].whom.data());
    queue.pop();
  }
  EXPECT_EQ(places.size(), queue.capacity());
}

TEST(FrameQueue, TellsTheProducerWhyTheWriterGaveUp) {
  const Scene scene = mixed_scene(3);
  const State state = initial_state(scene);
  FrameQueue queue(scene);
  for (std::size_t i = 0; i < queue.capacity(); ++i) queue.push(state);
  std::thread writer([&] { queue.fail(std::make_exception_ptr(std::runtime_error("disk full"))); });
  EXPECT_THROW(queue.push(state), std::runtime_error);  // waits in a full queue until it is told
  writer.join();
  EXPECT_THROW(queue.check(), std::runtime_error);
}

}  // namespace
}  // namespace throng::recording
