// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/contact/candidates.h"
#include "sim/contact/soft_bodies.h"
#include "sim/contact/soft_places.h"
#include "sim/contact/soft_touch.h"
#include "sim/contact_row.h"

namespace throng {

/// Soft contacts of discs with what no contact moves: the domain's sides, walls, static bodies and the parts
/// of kinematic ones. What several of them share, such as the corner where two walls meet, presses once.
class SoftSolids {
 public:
  SoftSolids(const Scene& scene, const Plan& plan);

  /// As those of SoftDiscs.
  void find(const Candidates& candidates, const State& state, const SoftPlaces& places,
            std::span<const SolverBody> bodies);

  /// Finds who is in contact in this substep, and how they push by the velocities of its beginning.
  void press(const SoftSubstep& now);

  /// Adds how those push whose place is before `end`, and which weren't added yet.
  void add_pushes(const SoftSubstep& now, std::uint32_t end);

  /// The same by the velocities of the middle, as SoftDiscs::press_again().
  void press_again(const SoftSubstep& now, std::uint32_t end);
  void finish(const SoftSubstep& now);
  void save(double h, State& state) const;
  void list(const State& state, double h, const SoftPlaces& places, std::span<const SolverBody> bodies,
            std::vector<ContactRow>& rows) const;
  const SoftSqueeze& squeeze() const { return squeeze_; }

 private:
  struct Pair {
    std::uint64_t key;
    std::uint32_t disc, solid;           // places of bodies; that of obstacles stands for what never moves
    double radius;                       // m, of the disc
    const narrowphase::HalfPlane* side;  // of the domain, or null
    const narrowphase::Convex* part;     // else this
    Vec shift;                           // m, to the part's image
    SoftPair law;
  };

  struct Touch {
    std::uint32_t pair;
    std::uint32_t heir_of;  // the pair whose springs it goes on with
    double depth;           // m, in the middle of the substep
    Vec normal;             // from the disc into the solid
    Vec lever;              // m, from the solid's centre to where they touch
    SoftSprings springs;
    double force;  // N, along the normal
  };

  struct Push {
    std::uint32_t disc;  // place
    SoftPush push;       // the disc feels the opposite
  };

  struct Turning {
    std::uint32_t body;  // its place
    double angle;        // rad, as the step begins
  };

  static constexpr double kSame = 1e-6;  // of the radius: places that are one

  void find_kinematic(const Candidates& candidates, const State& state, const SoftPlaces& places,
                      std::span<const SolverBody> bodies);
  void find_obstacles(const Candidates& candidates, const SoftPlaces& places,
                      std::span<const SolverBody> bodies);
  void add(Pair pair, std::uint32_t disc, std::uint32_t material, const SolverBody& body);
  void recall(const State& state);
  template <class Law>
  void press_disc(const Law& law, std::span<const std::uint32_t> pairs, const SoftSubstep& now);
  void find_near(std::span<const std::uint32_t> pairs, const SoftSubstep& now);
  void drop_shared(const SoftSubstep& now);
  NearestSurface nearest(const Pair& pair, const Vec& point) const;
  SoftMotion motion(const Touch& touch, const SoftSubstep& now, const Vec& velocity, double spin) const;
  Push push_of(const Touch& touch, const SoftForce& force) const;
  static void add(const Push& push, std::span<SoftPush> pushes);
  SoftSprings springs_after(const Touch& touch, const SoftSubstep& now) const;
  SoftSprings springs_of(const Touch& touch, const SoftMotion& moves, const SoftSubstep& now) const;
  const Touch* before(std::uint32_t pair) const;
  double arm(const Touch& touch) const;

  const Scene& scene_;
  const Plan& plan_;
  std::vector<double> ratios_;            // damping ratio of each surface
  std::vector<Pair> pairs_;               // in the order of the keys
  std::vector<std::uint32_t> by_disc_;    // rows of pairs
  std::vector<Turning> turning_;          // kinematic bodies
  std::vector<narrowphase::Pose> poses_;  // by place: of those, in this substep; empty without such
  std::vector<Touch> touches_, last_;     // of this substep and of the one before, ascending by pair
  std::vector<Touch> near_;               // of one disc
  std::vector<Push> pushes_;              // of this substep, by place
  std::vector<std::uint32_t> by_place_;   // touches_, of each place as they are there
  std::size_t added_ = 0, pressed_ = 0;   // of these two
  SoftSqueeze squeeze_;
};

}  // namespace throng
