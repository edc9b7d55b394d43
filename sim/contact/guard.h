// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/manifold.h"
#include "narrowphase/motion/motion.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/candidates.h"
#include "sim/contact/contact.h"
#include "sim/contact/hearts.h"
#include "sim/contact_row.h"
#include "sim/plan.h"
#include "sim/rows.h"
#include "sim/scene.h"
#include "sim/state.h"
#include "sim/workers.h"

namespace throng {

/// Keeps fast bodies from getting through walls and each other. Contacts are found as a step begins and
/// solved by sweeps: whoever goes or turns far in it may have been missed, or may have been stopped too late.
/// So each step looks back on how far bodies got: where a heart may have met another's, or an obstacle, the
/// step is taken again, under guard. Then each substep moves bodies as far as their hearts meet, strikes the
/// two, and lets them go on. Keeps where `scene`, `plan` and `candidates` are.
class Guard {
 public:
  Guard(const Scene& scene, const Plan& plan, const Candidates& candidates);

  /// Whether, in the step that took bodies from `state` to where they are, hearts may have met that were
  /// apart before. Surely so where one went through another on a straight way, turning evenly; a way that
  /// contacts bent is straightened. O(1) where nobody is fast, else O(candidates).
  bool saw_meeting(const State& state, BodyRows<const SolverBody> bodies, Workers& workers);

  /// To be called before a step is taken under guard, each time that it is.
  void start_step() {
    stood_.assign(scene_.bodies.size() + 1, 0), wall_.assign(stood_.size(), Vec(0.0, 0.0)), strikes_.clear();
  }

  /// Those of the substeps since then, where contacts are recorded.
  std::span<const ContactRow> strikes() const { return strikes_; }

  /// How many steps saw_meeting() was true of: all of these are taken under guard.
  std::int64_t guarded_steps() const { return guarded_steps_; }

  /// Moves those bodies by h (s): none gets into another's heart, nor into an obstacle, but for those that
  /// were in the smallest already, and who is crushed between what no impulse moves. Where no hearts meet,
  /// exactly as without guard. `bodies` has a row for obstacles behind those of the bodies. Where many meet
  /// at once: O(meetings · pairs of fast bodies).
  void move(const State& state, BodyRows<SolverBody> bodies, Rows awake, double h);

 private:
  /// Two that may meet. In a substep under guard, when they do.
  struct Meeting {
    std::uint32_t row_a, row_b;  // colliders, or an obstacle's row
    std::uint32_t a, b;          // rows of the bodies
    bool obstacle;
    Vec shift;              // m, to the image of b that is nearest to a
    bool watched = false;   // in this substep
    std::size_t depth = 0;  // of the hearts that are apart
    int pushes = 0;         // by a driven body, at the last depth
    double time = 0.0;      // s, in the substep; infinite where they don't
  };

  /// The earliest first, of equals the first of meetings_.
  struct Event {
    double time;
    std::uint32_t meeting;
    bool operator<(const Event& o) const { return time > o.time || (time == o.time && meeting > o.meeting); }
  };

  Meeting meeting(broadphase::Pair pair, bool obstacle) const;
  void list_all();
  double thickness(const Meeting& m) const;
  const narrowphase::Convex& heart_of_a(const Meeting& m) const;
  const narrowphase::Convex& heart_of_b(const Meeting& m) const;

  bool list_far(const State& state, BodyRows<const SolverBody> bodies);
  bool any_met(const State& state, BodyRows<const SolverBody> bodies, Workers& workers) const;
  bool met(Meeting m, const State& state, BodyRows<const SolverBody> bodies) const;

  double first_meeting(Meeting& m, const narrowphase::Motion& a, const narrowphase::Motion& b,
                       double duration) const;
  narrowphase::Manifold manifold(const Meeting& m, const narrowphase::Motion& a,
                                 const narrowphase::Motion& b) const;

  /// What moves under guard: all that a substep's stages share.
  struct Substep {
    const State& state;
    BodyRows<SolverBody> bodies;
    double h;  // s
  };
  void watch(const Substep& sub, std::uint32_t k);
  void foresee(const Substep& sub, std::uint32_t k);
  void expect(std::uint32_t k);
  narrowphase::Motion motion(const Substep& sub, const Meeting& m, bool of_b, double time) const;
  void collide(const Substep& sub, Meeting& m);
  void list(const Substep& sub, const Meeting& m, const Vec& point, double impulse);
  void advance(const Substep& sub, std::uint32_t body, double time);
  void go_on_held(const Substep& sub, const Meeting& m, const Vec& normal);
  void stand(const SolverBody& body, std::uint32_t row);
  void rest(SolverBody& body, std::uint32_t row, const Vec& normal);
  void leave(std::uint32_t row, const Vec& push);
  void look_again(const Substep& sub, std::uint32_t body);
  const Surface& surface(const Meeting& m) const;

  const Scene& scene_;
  const Plan& plan_;
  const Candidates& candidates_;
  Hearts hearts_;
  std::vector<narrowphase::Convex> sides_;  // of the domain's box, as bodies see them
  std::int64_t guarded_steps_ = 0;
  std::vector<double> reach_;         // m, of each body: how far from its centre turning moves points
  std::vector<std::uint8_t> is_far_;  // of each collider, as saw_meeting() looks back
  std::uint64_t listed_ = 0;          // the candidates' pairs that are listed below
  std::vector<Meeting> meetings_;
  std::vector<std::uint32_t> begin_, of_body_;  // of each body, where its meetings' rows begin; and these
  std::vector<std::uint32_t> next_;             // of each body, while they are made
  std::vector<Event> events_;                   // a heap
  std::vector<double> since_;         // s, of each body, in the substep: when it was where its row has it
  std::vector<std::uint8_t> stands_;  // of each body: stays there for the rest of the substep
  std::vector<std::uint8_t> stood_;   // likewise, of the step under guard: it has stood before
  std::vector<Vec> wall_;             // and at what that doesn't move, towards it; or zero
  std::vector<ContactRow> strikes_;   // of that step
};

}  // namespace throng
