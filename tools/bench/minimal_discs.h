// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sim/scene.h"
#include "sim/state.h"

namespace throng::bench {

/// The loop that one would write by hand for one scene of discs of one material in a box: the same physics
/// and the same order of contacts as the engine, a dense grid, nothing else. What the engine's generality
/// costs is measured against it.
class MinimalDiscs {
 public:
  /// Expects dynamic discs only, one material, a box, no walls, no restitution.
  explicit MinimalDiscs(const Scene& scene);

  void step();
  State state() const;

 private:
  struct Body {
    double x, y, vx, vy, spin, turn, inverse_mass, inverse_inertia;
  };
  struct Contact {
    std::uint32_t a, b;  ///< b of a wall is the last body
    double nx, ny, offset, normal_mass, tangent_mass, radius_a, radius_b, normal_impulse, tangent_impulse;
  };
  struct Kept {
    std::uint64_t key;
    double normal, tangent;
  };

  void find_pairs();
  void find_contacts();
  void find_wall_contacts();
  Contact contact(std::uint32_t a, std::uint32_t b, double radius_a, double radius_b) const;
  void recall(const std::vector<Kept>& kept, std::size_t& next, std::uint64_t key, Contact& contact) const;
  void prepare();
  template <bool kBiased>
  void sweep(std::vector<Contact>& contacts);
  void warm_start(std::vector<Contact>& contacts);
  void keep();

  const Scene& scene_;
  double h_, bias_rate_, mass_scale_, impulse_scale_, push_out_, friction_;
  std::int64_t step_ = 0;
  std::vector<Body> bodies_;
  std::vector<double> radius_, reach_, angle_;
  std::vector<std::uint32_t> cell_start_, cell_of_, by_cell_, row_start_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> met_, pairs_;
  std::vector<Contact> pairs_contacts_, wall_contacts_;
  std::vector<std::uint64_t> pair_keys_, wall_keys_;
  std::vector<Kept> pair_kept_, wall_kept_;
};

}  // namespace throng::bench
