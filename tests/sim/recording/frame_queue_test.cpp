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
  EXPECT_EQ(FrameQueue(0).capacity(), 16u);
  EXPECT_EQ(FrameQueue(10).capacity(), 16u);
  EXPECT_EQ(FrameQueue(3'000'000).capacity(), 2u);
}

TEST(FrameQueue, GivesFramesInTheOrderInWhichTheyCame) {
  const Scene scene = mixed_scene(3);
  FrameQueue queue(scene.bodies.size());
  std::thread producer([&] {
    for (int i = 0; i < 1000; ++i) queue.push(state_at(scene, i));
    queue.close();
  });
  std::int64_t expected = 0;
  while (const QueueEntry* entry = queue.front()) {
    EXPECT_FALSE(entry->checkpoint);
    EXPECT_EQ(entry->state.step, expected);
    EXPECT_EQ(hash(entry->state), hash(state_at(scene, expected)));
    ++expected;
    queue.pop();
  }
  producer.join();
  EXPECT_EQ(expected, 1000);
}

TEST(FrameQueue, KeepsContactsInCheckpointsOnly) {
  State state = initial_state(mixed_scene(3));
  state.disc_contacts = {{7, 0, 1.0, 0.5}};
  state.point_contacts = {{8, 3, 2.0, -0.5}, {9, 1, 3.0, 0.0}};
  FrameQueue queue(state.id.size());
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
  FrameQueue queue(scene.bodies.size());
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
  EXPECT_FALSE(queue.front()->hash);
  queue.pop();
  producer.join();
  EXPECT_EQ(pushed, queue.capacity() + 1);
  while (queue.front()->state.step < static_cast<std::int64_t>(queue.capacity())) queue.pop();
  const QueueEntry& last = *queue.front();  // who had to wait, had the time to hash it
  EXPECT_EQ(last.hash, hash(last.state));
}

TEST(FrameQueue, GivesALoneFrameThoughNothingFollows) {
  const State state = initial_state(mixed_scene(3));
  FrameQueue queue(state.id.size());
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
  FrameQueue queue(scene.bodies.size());
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
  const State state = initial_state(mixed_scene(3));
  const Sensed many = crowd_of(3'250'000);
  FrameQueue queue(state.id.size());
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
  const State state = initial_state(mixed_scene(3));
  const std::vector<ContactRow> many(1'000'000);
  const Sensed crowd = crowd_of(3'250'000);
  FrameQueue queue(state.id.size());
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
  const State state = initial_state(mixed_scene(3));
  const Sensed some = crowd_of(100);
  FrameQueue queue(state.id.size());
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
  const State state = initial_state(mixed_scene(3));
  FrameQueue queue(state.id.size());
  for (std::size_t i = 0; i < queue.capacity(); ++i) queue.push(state);
  std::thread writer([&] { queue.fail(std::make_exception_ptr(std::runtime_error("disk full"))); });
  EXPECT_THROW(queue.push(state), std::runtime_error);  // waits in a full queue until it is told
  writer.join();
  EXPECT_THROW(queue.check(), std::runtime_error);
}

}  // namespace
}  // namespace throng::recording
