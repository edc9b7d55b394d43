// SPDX-License-Identifier: MIT
#include "sim/recording/frame_queue.h"

#include <algorithm>
#include <chrono>

namespace throng::recording {

namespace {

constexpr std::size_t kBytes = 64'000'000, kBytesPerBody = 52;
constexpr auto kPatience = std::chrono::milliseconds(50);

std::size_t depth(std::size_t bodies) {
  return std::clamp<std::size_t>(kBytes / (kBytesPerBody * bodies + 1), 2, 16);
}

void reserve(std::size_t bodies, State& state) {
  state.id.reserve(bodies);
  state.position.reserve(bodies);
  state.angle.reserve(bodies);
  state.velocity.reserve(bodies);
  state.spin.reserve(bodies);
}

void copy_frame(const State& from, State& to) {
  to.step = from.step;
  to.id = from.id;
  to.position = from.position;
  to.angle = from.angle;
  to.velocity = from.velocity;
  to.spin = from.spin;
  to.crowd.arrived = from.crowd.arrived;
  to.crowd.measured = from.crowd.measured;
  to.collisions = from.collisions;
}

void copy_sensed(std::span<const Sensed> from, std::vector<Sensed>& to) {
  if (to.size() < from.size()) to.resize(from.size());
  for (std::size_t i = 0; i < to.size(); ++i) i < from.size() ? void(to[i] = from[i]) : to[i].clear();
}

std::size_t rows_bytes(const QueueEntry& entry) {
  std::size_t ids = 0;
  for (const Sensed& one : entry.sensed) ids += one.who.size() + one.count.size() + one.whom.size();
  return entry.contacts.size() * sizeof(ContactRow) + ids * sizeof(std::uint32_t);
}

}  // namespace

FrameQueue::FrameQueue(std::size_t bodies) : slots_(depth(bodies)) {
  for (QueueEntry& slot : slots_) reserve(bodies, slot.state);
}

void FrameQueue::push(const State& state, std::span<const ContactRow> contacts,
                      std::span<const Sensed> sensed, bool checkpoint) {
  std::unique_lock lock(mutex_);
  std::optional<std::uint64_t> hash;
  if (is_full() && !checkpoint) {
    lock.unlock();
    hash = throng::hash(state);
    lock.lock();
  }
  changed_.wait(lock, [&] { return !is_full() || error_; });
  if (error_) std::rethrow_exception(error_);
  QueueEntry& slot = slots_[(head_ + count_) % slots_.size()];
  lock.unlock();  // the slot is the producer's until it is counted
  slot.checkpoint = checkpoint;
  slot.hash = hash;
  slot.contacts.assign(contacts.begin(), contacts.end());
  copy_sensed(sensed, slot.sensed);
  slot.bytes = rows_bytes(slot);
  if (checkpoint)
    slot.state = state;
  else
    copy_frame(state, slot.state);
  lock.lock();
  ++count_;
  bytes_ += slot.bytes;
  if (count_ == batch() || is_full()) changed_.notify_all();
}

bool FrameQueue::is_full() const {
  return count_ == slots_.size() || bytes_ > kBytes;
}

void FrameQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

const QueueEntry* FrameQueue::front(const std::function<void()>& idle) {
  std::unique_lock lock(mutex_);
  while (count_ == 0 && !closed_) {
    changed_.wait_for(lock, kPatience, [&] { return count_ >= batch() || is_full() || closed_; });
    if (count_ > 0 || closed_ || !idle) continue;
    lock.unlock();
    idle();
    lock.lock();
  }
  return count_ > 0 ? &slots_[head_] : nullptr;
}

void FrameQueue::pop() {
  const std::lock_guard lock(mutex_);
  QueueEntry& slot = slots_[head_];
  const bool was_full = is_full();
  bytes_ -= slot.bytes;
  if (slot.bytes > kBytes / slots_.size())
    slot.contacts = std::vector<ContactRow>(), slot.sensed = std::vector<Sensed>();  // else all keep as much
  head_ = (head_ + 1) % slots_.size();
  --count_;
  if (was_full) changed_.notify_all();
}

void FrameQueue::fail(std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  error_ = std::move(error);
  changed_.notify_all();
}

void FrameQueue::check() {
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(error_);
}

}  // namespace throng::recording
