// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "sim/contact_row.h"
#include "sim/state.h"

namespace throng::recording {

/// What the loop hands to the writer.
struct QueueEntry {
  State state;
  bool checkpoint = false;  ///< all of the state, to go on from; else a frame: step, ids, motion, collisions,
                            ///< and what of a crowd is observed
  std::optional<std::uint64_t> hash = {};  ///< of a frame's state, where the producer had the time for it
  std::vector<ContactRow> contacts = {};   ///< of a frame, where it is to hold any
  std::vector<Sensed> sensed = {};         ///< of each recorded sensor, where a frame is to hold any
  std::size_t bytes = 0;                   ///< of contacts and sensed
};

/// Frames and checkpoints on their way from the loop to the writer: a ring of buffers made in advance, one
/// producer, one consumer. Waking the consumer takes as long as copying a frame of some thousand bodies, so
/// the consumer is woken only when the ring is half full and at the end, and looks by itself each 50 ms.
class FrameQueue {
 public:
  /// As many frames as fit into 64 MB, at least 2 and at most 16, all of so many bodies. Contacts and what
  /// was sensed come on top: of these, too, 64 MB and those of one frame at most, and room for as many again.
  explicit FrameQueue(std::size_t bodies);

  /// Copies a frame in; waits while the queue is full, and hashes the state meanwhile. Allocates nothing
  /// while there are no more bodies, and the slot has held as many contacts and sensed before,
  /// unless these are so many that few such frames fit. Throws what the consumer failed with.
  void push(const State& state, std::span<const ContactRow> contacts = {},
            std::span<const Sensed> sensed = {}) {
    push(state, contacts, sensed, false);
  }

  /// The same for a checkpoint, whose contacts may take more memory.
  void push_checkpoint(const State& state) { push(state, {}, {}, true); }

  /// Nothing more will come.
  void close();

  /// The oldest entry, once there is one; nullptr after the last. It stays until `pop`. Calls `idle`, if any,
  /// about each 50 ms that nothing came.
  const QueueEntry* front(const std::function<void()>& idle = {});
  void pop();

  /// The consumer gives up: every later push and check throws `error`.
  void fail(std::exception_ptr error);
  void check();

  std::size_t capacity() const { return slots_.size(); }

 private:
  void push(const State& state, std::span<const ContactRow> contacts, std::span<const Sensed> sensed,
            bool checkpoint);
  std::size_t batch() const { return slots_.size() / 2; }
  bool is_full() const;

  std::vector<QueueEntry> slots_;
  std::size_t head_ = 0, count_ = 0;
  std::size_t bytes_ = 0;  ///< of contacts and sensed on their way
  bool closed_ = false;
  std::exception_ptr error_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace throng::recording
