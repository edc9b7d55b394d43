// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "narrowphase/manifold.h"
#include "narrowphase/motion/motion.h"
#include "sim/contact/body_rows.h"
#include "sim/contact/kept_impulses.h"
#include "sim/contact/touch.h"
#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/workers.h"

namespace throng {

/// Which way two will press that near each other fast: that shows where they meet or pass, not where they are
/// as the step begins. A plane between them as they are then would stop whoever passes.
class LookAhead {
 public:
  /// Where two meet or pass.
  struct Meeting {
    double when = 0.0;                  ///< s, since the step began, when their contact is to be found
    Vec at_a, at_b;                     ///< m, where the bodies are then
    double turns_aside = kUndisturbed;  ///< s, when it makes them go on otherwise
    Vec normal;                         ///< then, from a to b
  };

  LookAhead(const Scene& scene, const Plan& plan, const Colliders& colliders);

  /// m: of two that get together no farther in a step, none nears the other fast, but where it bounces.
  double least_way() const { return least_way_; }

  /// Forgets all, of so many touches.
  void start(std::size_t touches) { nears_.assign(touches, 0); }

  /// Whether these two may get past the plane between them within the step, and not by little, is asked
  /// before look(). `m`: what they touch with as it begins. Of different touches at the same time, if need
  /// be.
  void ask(const StepStart& start, std::span<const Touch> touches, std::size_t touch,
           const narrowphase::Manifold& m) {
    nears_[touch] = nears(start, touches[touch], m);
  }

  void ask_nothing(std::size_t touch) { nears_[touch] = 0; }

  /// Replaces the manifolds of those that do by those that they have when they meet or pass, if one of them
  /// has met somebody before, who turns it aside, on the way that it goes from there. Where that would be the
  /// contact of a part's neighbour, which wasn't looked for ahead, what was found as the step begins stays.
  void look(const StepStart& start, std::span<const Touch> touches,
            std::span<narrowphase::Manifold> manifolds, Workers& workers);

  /// The touches that look() looked at, ascending.
  std::span<const std::uint32_t> approaches() const { return approaches_; }

  /// Where the touch's contact was found; null where that wasn't ahead.
  const Meeting* meeting(std::size_t touch) const;

 private:
  static constexpr double kUndisturbed = std::numeric_limits<double>::infinity();

  /// How two go on from some time of the step on.
  struct Courses {
    narrowphase::Motion a, b;  // of b's image
    double from;               // s
  };

  /// How a body goes on after the first that it meets.
  struct TurnedAside {
    double when = kUndisturbed;  // s
    Vec velocity;                // m/s
  };

  double slow_way(const Colliders& colliders, const Touch& touch) const;
  bool bounces(const StepStart& start, const Touch& touch) const;
  bool nears(const StepStart& start, const Touch& touch, const narrowphase::Manifold& m) const;
  Vec velocity_ahead(BodyRows<const SolverBody> bodies, std::uint32_t row) const;
  Courses courses(const StepStart& start, const Touch& touch) const;
  Meeting first_meeting(const StepStart& start, const Touch& touch, const narrowphase::Manifold& m) const;
  Meeting meeting_on(const Candidates& candidates, const Touch& touch, const Courses& courses) const;
  void find_who_turns_aside(const StepStart& start, std::span<const Touch> touches);
  void turn_aside(const StepStart& start, const Touch& touch, const Meeting& meeting);
  void meet_later(const StepStart& start, const Touch& touch, Meeting& meeting) const;
  void find_there(const StepStart& start, const Touch& touch, Meeting& meeting, const ContactImpulse* kept,
                  narrowphase::Manifold& m) const;

  const Scene& scene_;
  const Plan& plan_;
  double least_way_;
  std::vector<std::uint8_t> nears_;        // of each touch: fast
  std::vector<std::uint32_t> approaches_;  // the touches that do
  std::vector<Meeting> meetings_;          // of each of these
  std::vector<TurnedAside> turned_;        // of each body; where something nears
  std::vector<std::uint8_t> pressed_;      // of each body, in the last step; likewise
};

}  // namespace throng
