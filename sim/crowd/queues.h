// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/crowd/queue_line.h"
#include "sim/crowd/ways.h"
#include "sim/state.h"

namespace throng {

/// The queues of a scene: who stands in them, where who lines up goes, who is served. Rows are those of the
/// crowd's state.
class Queues {
 public:
  using Row = std::size_t;

  /// All must outlive this.
  Queues(const Scene& scene, const Barriers& barriers, const Ways& ways);

  bool empty() const { return lines_.empty(); }

  /// Looks who stands in line. Expects that places in line are 1 to as many as there are. O(agents).
  void look(const State& state);

  /// Where who is in a queue or on the way there wants to walk: straight to his place where he gets there,
  /// along the line where it bends, else by the ways to the line. Behind a full one he stops, the farther off
  /// the more wait there already. O(1) but for barriers near his way, and O(log agents) who wait.
  Heading heading(const State& state, Row row) const;

  /// Lets each who is nearer to a place than the one before him take it, takes those out of line who can't
  /// get to their place and stand, and serves: `served` becomes 1 for who has been.
  void advance(State& state, std::vector<std::uint8_t>& served);

  /// Takes the next free place for him, where he is near it. Where the line is full he waits: his leg begins
  /// anew, as only from when there is room does he get nowhere.
  void line_up(State& state, Row row);

 private:
  std::uint32_t queue(const State& state, Row row) const;
  std::uint32_t length(std::uint32_t queue) const { return static_cast<std::uint32_t>(line_[queue].size()); }
  double spacing(std::uint32_t queue) const { return scene_.crowd.queues[queue].spacing; }
  double radius(const State& state, Row row) const {
    return scene_.bodies.radius[state.id[scene_.crowd.first + row] - 1];
  }
  const Vec& position(const State& state, Row row) const { return state.position[scene_.crowd.first + row]; }
  bool is_full(std::uint32_t queue) const { return length(queue) >= lines_[queue].places(); }
  void look_behind(const State& state);
  double away(const State& state, std::uint32_t queue, std::uint32_t number) const;
  bool reaches(const State& state, Row row, const Vec& place) const;
  std::optional<Vec> straight(const State& state, Row row, std::uint32_t number) const;
  bool is_overtaken(const State& state, std::uint32_t queue, std::uint32_t k) const;
  bool is_lost(const State& state, std::uint32_t queue, std::uint32_t k) const;
  void keep_order(State& state, std::uint32_t queue);
  void take_out(State& state, std::uint32_t queue, std::uint32_t k);

  const Scene& scene_;
  const Barriers& barriers_;
  const Ways& ways_;
  std::vector<QueueLine> lines_;             // as Crowd::queues
  std::vector<std::int64_t> service_;        // steps, as Crowd::queues
  std::vector<std::vector<Row>> line_;       // of the queues: who stands in them, from the head
  std::vector<std::vector<double>> behind_;  // of full ones: m, from their ends to all who want in, ascending
};

}  // namespace throng
