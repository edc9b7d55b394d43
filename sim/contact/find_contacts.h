// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "narrowphase/manifold.h"
#include "narrowphase/motion/motion.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contact.h"
#include "sim/contact/disc_blocks.h"
#include "sim/contact/face_blocks.h"
#include "sim/contact/find_discs.h"
#include "sim/contact/held_faces.h"
#include "sim/contact/kept_impulses.h"
#include "sim/contact/parts.h"
#include "sim/contact/roll.h"
#include "sim/contact/seat_book.h"
#include "sim/rows.h"
#include "sim/workers.h"

namespace throng {

/// The contacts of one step, with the names under which `State` keeps their impulses. Ascending by key: the
/// smaller collider, then the other; contacts with obstacles come after all pairs.
struct Contacts {
  DiscBlocks discs;
  std::vector<std::uint64_t> disc_key;
  FaceBlocks faces;
  std::vector<std::uint64_t> point_key;
  std::vector<std::uint32_t> point_feature;
  std::vector<RollContact> disc_rolls;  ///< of the same contacts; empty where nothing resists rolling
  std::vector<RollContact> point_rolls;
  std::vector<DiscContact> disc_bounces;    ///< the same contacts once more; empty where no surface bounces
  std::vector<PointContact> point_bounces;  ///< the same; those of faces that hit alone where none bounces

  /// Forgets all; of so many rows of bodies the last ones, one a group, never move.
  void start(std::size_t bodies, std::size_t groups);

  /// The impulses of contacts that press, for the next step.
  void save(State& state) const;
};

/// Narrowphase: what the solver must look at among the candidates, with the impulses of the step before. A
/// pair whose contact pressed then keeps its reference face while that is as good as the widest.
class ContactFinder {
 public:
  ContactFinder(const Scene& scene, const Plan& plan, const Colliders& colliders);

  /// m/s: see fast.h; faces that don't bounce and hit are listed among bounces, too.
  double hit_speed() const { return hit_speed_; }

  /// m: of two that get together no farther in a step, none nears the other fast.
  double slow_way() const { return slow_way_; }

  /// Contacts are in that many groups: see Parts.
  const Parts& parts() const { return parts_; }

  /// Of whom contacts were known without a search.
  const HeldFaces& held() const { return held_; }

  /// Finds out who of those awake is in which part; before each find().
  void divide(const State& state, Rows awake) { moved_ |= parts_.place(state, awake); }

  /// Replaces `contacts`. `bodies` has a row for each body of `state`, then one a group that stands for all
  /// obstacles; candidates are of those whom divide() was given.
  void find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
            Contacts& contacts, Workers& workers);

 private:
  struct Touch {  // candidates of which one is no disc about its body's centre
    broadphase::Pair pair;
    bool obstacle;                         // the pair's b is an obstacle
    Vec shift;                             // m, to the image of b that is nearest to a
    bool held = false;                     // has a lane of held_
    std::uint32_t lane = SeatBook::kNone;  // there, and of the solver's faces where it sits there

    std::uint64_t key() const;
  };

  struct Neighbour {
    std::uint64_t key;
    std::uint32_t a, b;  // bodies that move
    std::uint32_t group, lane;
  };

  struct TouchPoses {
    narrowphase::Pose a, b;  // of an obstacle, its image
  };

  /// How two go on that near each other fast, from some time of the step on.
  struct Courses {
    narrowphase::Motion a, b;  // of b's image
    double from;               // s
  };

  /// Where they meet, or pass.
  struct Meeting {
    double when = 0.0;                  // s, when their contact is to be found
    Vec at_a, at_b;                     // m, where the bodies are then
    double turns_aside = kUndisturbed;  // s, when it makes them go on otherwise
    Vec normal;                         // then, from a to b
  };
  static constexpr double kUndisturbed = std::numeric_limits<double>::infinity();

  /// How a body goes on after the first that it meets.
  struct TurnedAside {
    double when = kUndisturbed;  // s
    Vec velocity;                // m/s
  };

  void find_touches(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                    bool moved, Contacts& contacts, Workers& workers);
  void search(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
              Workers& workers);
  void sort_out(const Candidates& candidates, Contacts& contacts);
  TouchPoses poses(const Candidates& candidates, const State& state, const Touch& touch) const;
  narrowphase::Manifold manifold(const Candidates& candidates, const Touch& touch, const TouchPoses& poses,
                                 const ContactImpulse* kept) const;
  double slow_way(const Colliders& colliders, const Touch& touch) const;
  bool nears_fast(const Colliders& colliders, std::span<const SolverBody> bodies, std::size_t touch) const;
  void look_ahead(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                  Workers& workers);
  Courses courses(const State& state, std::span<const SolverBody> bodies, const Colliders& colliders,
                  const Touch& touch) const;
  Meeting meeting(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                  std::size_t touch) const;
  Meeting meeting(const Candidates& candidates, const Touch& touch, const Courses& courses) const;
  void find_who_turns_aside(const Candidates& candidates, std::span<const SolverBody> bodies);
  void turn_aside(const Candidates& candidates, std::span<const SolverBody> bodies, const Touch& touch,
                  const Meeting& meeting);
  void meet_later(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                  const Touch& touch, Meeting& meeting) const;
  void find_ahead(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                  std::size_t approach, const ContactImpulse* kept);
  const Meeting* ahead(std::size_t touch) const;
  Vec velocity_ahead(std::span<const SolverBody> bodies, std::uint32_t row) const;
  bool is_known(const Touch& touch) const { return touch.held && held_.knows(touch.lane); }
  void ask_held(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                Workers& workers);
  void answer_held(FaceBlocks& faces, Workers& workers);
  double slow() const { return std::min(hit_speed_, slow_way_ / scene_.time.dt); }  // m/s, who may be held
  bool is_worth_holding();

  void find_who_may_be_held(const Colliders& colliders);
  void name_lanes(FaceBlocks& faces);
  void hold_seats(const Colliders& colliders, FaceBlocks& faces);
  PlacedPart place_part(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                        std::uint32_t collider) const;
  void hold(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
            std::size_t touch);
  void fetch_held(std::size_t touch, std::size_t end, const FaceBlocks& faces) const;
  void fill_held(std::size_t touch, KeptImpulses& memory, Contacts& contacts);
  std::uint32_t other_row(const Colliders& colliders, const Touch& touch) const;
  bool all_sit_well(const Colliders& colliders, FaceBlocks& faces);
  bool seat_newcomers(const Colliders& colliders, FaceBlocks& faces);
  Neighbour neighbour(const Colliders& colliders, const Touch& touch) const;
  void list_neighbours(const Colliders& colliders, const FaceBlocks& faces);
  bool squeeze_in(const Colliders& colliders, FaceBlocks& faces, std::uint32_t touch);
  void take_seats(FaceBlocks& faces);
  void seat_anew(const Colliders& colliders, std::size_t bodies, FaceBlocks& faces, Workers& workers);
  void seat_group(const Colliders& colliders, std::size_t group, FaceBlocks& faces);
  std::size_t group_of(const Colliders& colliders, const Touch& touch) const;
  void fill_faces(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                  Contacts& contacts, Workers& workers);
  void fill_searched(const Candidates& candidates, std::span<const SolverBody> bodies, std::size_t touch,
                     KeptImpulses& memory, std::array<PointContact, 2>& points, Contacts& contacts);
  std::span<std::uint32_t> names(std::size_t touch, Contacts& contacts) const;
  const Surface& surface(std::uint32_t body, std::uint32_t other_material) const;
  const Surface& surface_of(const Colliders& colliders, broadphase::Pair pair) const {
    return surface(colliders.body[pair.a], scene_.bodies.material[colliders.body[pair.b]]);
  }
  void list_hits(const Candidates& candidates, std::span<const SolverBody> bodies,
                 std::vector<PointContact>& bounces) const;
  double pace(const Candidates& candidates, std::span<const SolverBody> bodies, std::uint32_t collider) const;
  bool hits(std::span<const PointContact> face, std::span<const SolverBody> bodies) const;
  std::span<PointContact> face(const Candidates& candidates, std::span<const SolverBody> bodies,
                               std::size_t touch, std::array<PointContact, 2>& points) const;
  void describe(const Colliders& colliders, const Obstacles& obstacles, const Touch& touch, const Vec& normal,
                PointContact& contact) const;

  const Scene& scene_;
  const Plan& plan_;
  double hit_speed_, slow_way_;
  Parts parts_;
  bool moved_ = false;  // somebody is in another part than when contacts were found last
  DiscFinder discs_;
  std::vector<std::uint8_t> may_be_held_;  // of each collider; empty where nothing is
  std::vector<PlacedPart> placed_;         // likewise
  HeldFaces held_;
  bool holds_ = false;
  std::size_t named_ = 0;  // pairs that may be held
  SeatBook book_;
  std::vector<std::uint32_t> newcomers_;   // touches that have no seat yet, or one without room
  std::vector<std::uint8_t> is_newcomer_;  // of each body, for a while: it is one of theirs
  std::vector<Neighbour> neighbours_;      // with seats, of these bodies
  std::vector<std::uint32_t> held_again_;  // blocks of held_ in which one of them sits now
  int age_ = 0;                            // finds that these seats served
  int rests_ = 0, in_vain_ = 0;  // finds for which nothing will be held yet; in which most was searched
  std::vector<Touch> touches_;
  std::vector<narrowphase::Manifold> manifolds_;    // of each touch that held_ doesn't know
  std::vector<std::uint8_t> nears_;                 // of each touch: fast
  std::vector<std::uint32_t> approaches_;           // the touches that do
  std::vector<Meeting> meetings_;                   // of each of these
  std::vector<TurnedAside> turned_;                 // of each body; where something nears
  std::vector<std::uint8_t> pressed_;               // of each body, in the last step; likewise
  std::vector<std::uint8_t> points_;                // how many each has: who seats reads no more of them
  std::vector<std::vector<std::uint32_t>> seated_;  // of each group: the touches with points
  std::vector<std::uint32_t> seat_;                 // of each touch, while they are made anew
  std::vector<HeldFaces::Move> moves_;              // likewise, of those that are held
  std::vector<std::uint32_t> first_point_;          // of each touch: how many come before
  std::vector<std::uint8_t> hits_;                  // of each touch
};

}  // namespace throng
