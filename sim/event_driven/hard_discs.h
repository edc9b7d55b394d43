// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/collisions.h"
#include "sim/contact/contact.h"
#include "sim/contact_row.h"
#include "sim/event_driven/flying.h"
#include "sim/event_driven/folded_cells.h"
#include "sim/event_driven/soonest.h"
#include "sim/event_driven/soonest_meeting.h"
#include "sim/plan.h"
#include "sim/state.h"

namespace throng {

/// Hard discs from collision to collision, in the order of their times (Alder and Wainwright, J. Chem. Phys.
/// 31, 459, 1959): no time step, no error but rounding. Each disc flies, or falls, from its last collision on
/// and is looked at again only where it collides, crosses the border of its cell, or where whom it was to
/// meet was turned aside before. It keeps the soonest of its collisions alone; those of a pair not kept are
/// found again when one of the two is looked at, which happens before (Lubachevsky, J. Comput. Phys. 94, 255,
/// 1991).
///
/// Times count from the scene's beginning: they are right to the spacing of doubles there, 1e-14 s at 100 s.
class HardDiscs {
 public:
  /// Expects what `event_driven_refusal` has nothing against. Throws InputError where discs overlap by more
  /// than rounding.
  HardDiscs(const Scene& scene, const Plan& plan);

  /// O(1) a collision, nearly. Replaces `rows` by the collisions. False where `stop`, if any, which is asked
  /// each ten thousand of them or so, said true: then it isn't that time yet. Throws SimulationError where
  /// collisions don't end (inelastic collapse): after a thousand of one disc in a row between which no time
  /// passes, or of bounces lower than 1e-9 of its radius.
  bool run_until(double time, std::vector<ContactRow>& rows, bool (*stop)() = nullptr);

  /// Writes where all are at `time` (s), at or after the last collision. O(n).
  void store(double time, State& state) const;

  const Collisions& collisions() const { return collisions_; }

 private:
  static constexpr std::uint32_t kNobody = UINT32_MAX;

  /// What comes next to a disc, and what only it itself needs.
  struct alignas(64) Next {
    double crossing = Soonest::kNever;   // s, of the border of its cell
    double collision = Soonest::kNever;  // s
    std::uint32_t other = kNobody;       // whom it meets: a disc, or behind all discs an obstacle
    std::uint32_t had = 0;               // collisions that the other had had when it was foreseen
    Cell cell;
    double inverse_mass = 0.0;       // 1/kg
    double turn = 0.0;               // rad, at its last collision, since the beginning
    std::uint32_t still = 0;         // the last so many collisions that led nowhere
    std::int8_t axis = 0, step = 0;  // of the crossing
  };

  /// The part of the 3 x 3 cells round a disc's cell that is looked at.
  struct Range {
    std::array<int, 2> first{-1, -1}, last{1, 1};
  };

  void place_discs();
  void refuse_overlaps();
  std::uint32_t body(std::uint32_t disc) const { return discs_[disc].body; }
  bool is_disc(std::uint32_t other) const { return other < discs_.size(); }
  const Surface& surface(std::uint32_t disc, std::uint32_t other) const;
  std::string name(std::uint32_t other) const;

  Vec place(const Flying& disc, double time) const {
    const double way = time - disc.since;
    if (!plan_.gravity) return disc.position + way * disc.velocity;
    return disc.position + way * (disc.velocity + 0.5 * way * pull_);
  }
  Vec velocity(const Flying& disc, double time) const {
    return plan_.gravity ? Vec(disc.velocity + (time - disc.since) * pull_) : disc.velocity;
  }
  /// Calls visit(discs, shift) for the discs in the range of cells round the disc's, itself among them, some
  /// at a time: their images there are moved by `shift` (m). May write kMeetingPadding rows behind them.
  template <class Visit>
  void for_each_near(std::uint32_t disc, const Range& range, Visit visit) {
    const Cell& cell = next_[disc].cell;
    if (cells_.inside(cell)) {
      const std::size_t count = cells_.copy_near(cell, range.first, range.last, near_.data());
      if (count != FoldedCells::kCrowded) [[likely]]
        return visit(std::span(near_).first(count), Vec(0.0, 0.0));
    }
    cells_.for_each_near(cell, range.first, range.last, [&](std::size_t slot, int x, int y) {
      const std::size_t count = cells_.copy(slot, near_, 0);
      if (count + kMeetingPadding > near_.size()) near_.resize(2 * count + kMeetingPadding);
      visit(std::span(near_).first(count), Vec(x * period_.x(), y * period_.y()));
    });
  }

  void foresee(std::uint32_t disc, double now, std::uint32_t collided);
  void foresee_crossing(std::uint32_t disc, double now, const std::array<int, 2>& entered);
  void foresee_straight_crossing(const Flying& one, double now, Next& next) const;
  void foresee_obstacles(std::uint32_t disc, double now, std::uint32_t collided);
  void foresee_discs(std::uint32_t disc, double now, const Range& range, std::uint32_t collided);
  void set(std::uint32_t disc);

  void fetch_ahead();
  void fetch(std::uint32_t disc) const;
  void fetch_cells(std::uint32_t disc) const;
  void fetch_near(std::uint32_t disc);
  void cross(std::uint32_t disc);
  void collide(std::uint32_t disc, double now, std::vector<ContactRow>& rows);
  double advance(std::uint32_t disc, double now);
  double closing_speed(std::uint32_t disc, std::uint32_t other, const Vec& normal) const;
  void watch_for_collapse(std::uint32_t disc, std::uint32_t other, double flown, double speed);
  SolverBody solver_body(std::uint32_t other) const;
  Vec normal(std::uint32_t disc, std::uint32_t other) const;
  ContactRow row(std::uint32_t disc, std::uint32_t other, const Vec& normal, double impulse) const;

  const Scene& scene_;
  const Plan& plan_;
  const Vec pull_;    // m/s²
  const Vec period_;  // m
  const Obstacles obstacles_;
  std::vector<std::uint32_t> bodies_;  // those that fly, until they are placed: neighbours near one another
  FoldedCells cells_;
  std::vector<Flying, HugePages<Flying>> discs_;
  std::vector<Next, HugePages<Next>> next_;
  Soonest soonest_;
  std::size_t sent_ = 0;             // entries passed when it was last sent for what is needed next
  std::vector<std::uint32_t> near_;  // discs of the last search
  Collisions collisions_;
};

}  // namespace throng
