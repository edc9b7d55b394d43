// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/manifold.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contacts.h"
#include "sim/contact/find_discs.h"
#include "sim/contact/held_faces.h"
#include "sim/contact/kept_impulses.h"
#include "sim/contact/look_ahead.h"
#include "sim/contact/parts.h"
#include "sim/contact/seat_book.h"
#include "sim/contact/stumbles.h"
#include "sim/contact/touch.h"
#include "sim/islands.h"
#include "sim/rows.h"
#include "sim/workers.h"

namespace throng {

/// Narrowphase: what the solver must look at among the candidates, with the impulses of the step before. A
/// pair whose contact pressed then keeps its reference face while that is as good as the widest.
class ContactFinder {
 public:
  ContactFinder(const Scene& scene, const Plan& plan, const Colliders& colliders);

  /// m/s: see fast.h; what doesn't bounce and hits is listed among bounces, too.
  double hit_speed() const { return hit_speed_; }

  /// m: as LookAhead::least_way().
  double least_way() const { return ahead_.least_way(); }

  /// Contacts are in that many groups: see Parts.
  const Parts& parts() const { return parts_; }

  /// Of whom contacts were known without a search.
  const HeldFaces& held() const { return held_; }

  /// Finds out who of those awake is in which part; before each find(). Returns whether somebody is in
  /// another one than before.
  bool divide(const State& state, Rows awake) {
    const bool moved = parts_.place(state, awake);
    moved_ |= moved;
    return moved;
  }

  /// Replaces `contacts`. Candidates are of those whom divide() was given.
  void find(const StepStart& start, Contacts& contacts, Workers& workers);

 private:
  /// Of two discs, as the step begins.
  enum class Nearness : std::uint8_t { apart, near, hits };

  /// Who shares a body with a newcomer.
  struct Neighbour {
    std::uint64_t key;
    std::uint32_t a, b;  // bodies that move
    std::uint32_t group, lane;
  };

  /// Two bodies at a contact of discs, or a touch.
  struct Meeting {
    std::uint32_t a, b;
    std::size_t contact;  // which of the discs' contacts, or of the touches
    bool discs;
    bool hits;
    std::uint32_t weight;
  };

  /// Bodies that hang together by meetings. Left to the sweeps is who hits alone, at one point, and touches
  /// nobody: one sweep stops him.
  struct Cluster {
    std::uint32_t meetings = 0, weight = 0;
    bool hit = false;

    bool is_stopped() const { return hit && (weight >= 2 || meetings >= 2); }
  };

  // find_contacts.cpp
  Touch touch(broadphase::Pair pair, bool obstacle, const Vec& shift) const;
  void sort_out(const Candidates& candidates, Contacts& contacts, Workers& workers);
  void find_touches(const StepStart& start, bool moved, Contacts& contacts, Workers& workers);
  void search(const StepStart& start, Workers& workers);
  void take_out_stumbles(const StepStart& start, Workers& workers);
  void search_one(const StepStart& start, std::size_t touch, KeptImpulses& memory);
  void fill_faces(const StepStart& start, Contacts& contacts, Workers& workers);
  void fill_searched(const StepStart& start, std::size_t touch, KeptImpulses& memory,
                     std::array<PointContact, 2>& points, Contacts& contacts);
  static void list_bounces(std::span<const PointContact> face, std::uint32_t row, Contacts& contacts);
  void list_turning(const StepStart& start, Contacts& contacts) const;
  std::span<PointContact> face(const StepStart& start, std::size_t touch,
                               std::array<PointContact, 2>& points) const;
  std::span<std::uint32_t> names(std::size_t touch, Contacts& contacts) const;

  // find_hits.cpp
  Nearness nearness(const StepStart& start, std::uint64_t disc_key) const;
  void search_known(const StepStart& start, std::size_t touch, KeptImpulses& memory);
  std::uint32_t weight(const StepStart& start, std::size_t touch, KeptImpulses& memory);
  bool find_disc_meetings(const StepStart& start, std::span<const std::uint64_t> disc_keys);
  static bool both_move(const Meeting& meeting, BodyRows<const SolverBody> bodies);
  bool find_meetings(const StepStart& start, std::span<const std::uint64_t> disc_keys);
  void find_clusters(BodyRows<const SolverBody> bodies);
  Cluster& cluster_of(const Meeting& meeting, BodyRows<const SolverBody> bodies);
  void list_hits(const StepStart& start, Contacts& contacts);
  void list_disc(const StepStart& start, std::size_t contact, Contacts& contacts) const;
  void list_touch(const StepStart& start, std::size_t touch, KeptImpulses& memory, Contacts& contacts);

  // find_held.cpp
  bool is_known(const Touch& touch) const { return touch.held && held_.knows(touch.lane); }
  double held_speed() const { return std::min(hit_speed_, least_way() / scene_.time.dt); }
  bool is_worth_holding();
  void find_who_may_be_held();
  PlacedPart place_part(const StepStart& start, std::uint32_t collider) const;
  void ask_held(const StepStart& start, Workers& workers);
  void answer_held(FaceBlocks& faces, Workers& workers);
  void hold(const StepStart& start, std::size_t touch);
  void hold_seats(FaceBlocks& faces);
  void set_polygons(const Touch& touch, std::uint32_t lane, FaceBlocks& faces) const;
  void fetch_held(std::size_t touch, std::size_t end, const FaceBlocks& faces) const;
  void fill_held(std::size_t touch, KeptImpulses& memory, Contacts& contacts);

  // seat_faces.cpp
  void name_lanes(FaceBlocks& faces);
  bool all_sit_well(FaceBlocks& faces);
  bool seat_newcomers(FaceBlocks& faces);
  Neighbour neighbour(const Touch& touch) const;
  void list_neighbours(const FaceBlocks& faces);
  bool squeeze_in(FaceBlocks& faces, std::uint32_t touch);
  void take_seats(FaceBlocks& faces);
  void seat_anew(BodyRows<const SolverBody> bodies, FaceBlocks& faces, Workers& workers);
  void seat_group(std::size_t group, FaceBlocks& faces);

  const Scene& scene_;
  const Plan& plan_;
  const Colliders& colliders_;
  double hit_speed_;
  double fall_;      // m/s, what gravity gives in a step, and not to who is held
  bool all_bounce_;  // whatever hits is listed, and nothing is to be stopped
  Parts parts_;
  bool moved_ = false;  // somebody is in another part than when contacts were found last
  DiscFinder discs_;
  LookAhead ahead_;
  Stumbles stumbles_;
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
  std::vector<std::uint8_t> points_;                // how many each has: who seats reads no more of them
  std::vector<std::vector<std::uint32_t>> seated_;  // of each group: the touches with points
  std::vector<std::uint32_t> seat_;                 // of each touch, while they are made anew
  std::vector<HeldFaces::Move> moves_;              // likewise, of those that are held
  std::vector<std::uint32_t> first_point_;          // of each touch: how many come before
  std::vector<std::uint8_t> hits_;                  // of each touch
  std::vector<std::uint8_t> turns_;                 // of each touch: its face does, far
  std::vector<Meeting> meetings_;                   // where somebody may hit
  Islands islands_;                                 // by them
  std::vector<Cluster> clusters_;                   // likewise, of each body that is the first of one
};

}  // namespace throng
