// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/manifold.h"
#include "sim/contact/held_faces.h"
#include "sim/contact/touch.h"
#include "sim/workers.h"

namespace throng {

/// Contacts that nothing but a seam makes: who slides over two surfaces that lie flush, a wall's and a
/// tile's, is in the first by what it sags, and so would run into the edge of the second. Parts of one whole
/// know their seams (narrowphase/rim.h); here are those between any two.
///
/// A contact of the bodies A and B is one where another of A, beside it, shows a surface that A is over and
/// all of B is under and comes up to, it presses otherwise than that surface does, and A slides along that
/// towards B. As good as flush is a step as high as A sags into that, but no more than a hundredth of the
/// smaller radius. Surfaces are of what is at least as heavy as A: lighter things are pushed ahead, or borne
/// down, by contacts.
class Stumbles {
 public:
  /// For steps of that length (s).
  explicit Stumbles(double dt) : dt_(dt) {}

  /// Forgets all, of so many touches.
  void start(std::size_t touches) { suspects_.assign(touches, 0); }

  /// Whether the touch, which has that manifold, may be one, as the two near each other at a point: it is
  /// asked about before find(). Of different touches at the same time, if need be. O(1).
  bool ask(const StepStart& start, std::span<const Touch> touches, std::size_t touch,
           const narrowphase::Manifold& m);

  /// The touches, ascending, that are. `manifolds`: of those whose contacts `held` doesn't know. O(touches)
  /// where any was asked about, else a look at a byte of each.
  std::span<const std::uint32_t> find(const StepStart& start, std::span<const Touch> touches,
                                      std::span<const narrowphase::Manifold> manifolds, const HeldFaces& held,
                                      Workers& workers);

  /// Whether find() found that one. O(log found).
  bool has(std::size_t touch) const { return std::ranges::binary_search(found_, touch); }

 private:
  /// What all share in a step.
  struct Step {
    double dt;  // s
    const StepStart& start;
    std::span<const Touch> touches;
    std::span<const narrowphase::Manifold> manifolds;
    const HeldFaces& held;
  };

  void join(const Step& step);
  bool is_one(const Step& step, std::uint32_t touch) const;
  bool is_hidden(const Step& step, std::uint32_t touch, std::uint32_t body) const;
  static narrowphase::Manifold manifold(const Step& step, std::uint32_t touch);
  static bool hides(const Step& step, std::uint32_t surface, std::uint32_t touch, std::uint32_t body);

  double dt_;                                 // s
  std::vector<std::uint8_t> suspects_;        // of each touch
  std::vector<std::uint32_t> found_;          // the suspects, then those of them that are
  std::vector<std::uint8_t> are_;             // of each suspect
  std::vector<std::uint32_t> first_of_, of_;  // of each body its touches
};

}  // namespace throng
