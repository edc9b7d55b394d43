// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/buckets.h"
#include "sim/contact/contact.h"
#include "sim/rows.h"
#include "sim/workers.h"

namespace throng {

/// Rows behind those of bodies that stand for obstacles and for nobody, one for each group of contacts: who
/// solves a group writes no row of another.
constexpr std::size_t kStillRows = 64;

inline std::uint32_t still_row(std::span<const SolverBody> bodies, std::size_t group) {
  return static_cast<std::uint32_t>(bodies.size() - kStillRows + group);
}

/// Which contacts may be solved by several threads, whatever their number. The plane is cut into strips of
/// about as many bodies each. Contacts within a strip are a group; so are those between a strip and the next;
/// and what is left, such as contacts of a body so large that it reaches farther, and of kinematic ones. The
/// groups within strips share no body that contacts move; nor does every second group between strips. So a
/// sweep has four phases, of groups that don't touch each other, and each group is solved in the order of its
/// list. Few contacts are one group, and strips are a power of two: they
/// suit two threads and four.
class Strips {
 public:
  static constexpr std::size_t kMost = kStillRows / 2, kPhases = 4;

  /// Where to cut for that step, for so many contacts of those `bodies` that are `awake`. `radius` (m): mean
  /// of them all. O(awake); allocates only to grow.
  void cut(std::span<const SolverBody> bodies, Rows awake, std::size_t contacts, double radius,
           Workers& workers);

  std::size_t count() const { return count_; }
  std::size_t groups() const { return count_ == 1 ? 1 : 2 * count_; }

  /// The group of a contact between rows a and b, of which one moves; b may stand for obstacles.
  std::uint8_t group(std::uint32_t a, std::uint32_t b) const;

  /// Calls f(group, phase) for all groups: those of a phase by several threads, phase after phase.
  /// Groups below count() are those within strips, the first phase.
  template <class F>
  void for_each_group(Workers& workers, F&& f) const {
    for (std::size_t phase = 0; phase < kPhases; ++phase) {
      const Series series = groups_of(phase);
      workers.for_each(series.count, [&](std::size_t i) { f(series.first + i * series.step, phase); });
    }
  }

  /// Bodies that contacts move, of that strip, ascending; and those that nothing moves.
  template <class F>
  void for_each_body(std::size_t strip, F&& f) const {
    for (const std::uint32_t i : bodies_[strip]) f(awake_[i]);
  }
  template <class F>
  void for_each_unmoved(F&& f) const {
    for_each_body(count_, f);
  }

 private:
  struct Series {
    std::size_t first, step, count;
  };

  Series groups_of(std::size_t phase) const;
  void choose_cuts(std::span<const SolverBody> bodies, std::size_t most, double least_width);

  std::size_t count_ = 1;
  std::array<double, kMost> cut_{};  // m, where strips end, ascending; the last has no end
  int axis_ = 0;                     // across which they are cut
  Rows awake_ = Rows::all(0);
  Buckets bodies_;                           // of awake_
  std::vector<std::uint8_t> of_, of_awake_;  // strip of each body, and of each in awake_; count_ for unmoved
  std::array<std::vector<double>, 2> sample_;
};

}  // namespace throng
