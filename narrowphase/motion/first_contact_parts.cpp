// SPDX-License-Identifier: MIT
#include "narrowphase/motion/first_contact_parts-inl.h"

namespace throng::narrowphase {

namespace {

struct Parts {
  const PartsBvh& solid;

  const Bvh<BoxAndBall<2>>& tree() const { return solid.tree; }
  std::uint32_t name(std::uint32_t place) const { return solid.tree.order[place]; }
  const Convex& shape(std::uint32_t place) const { return solid.parts[name(place)]; }
};

}  // namespace

FirstPartsContact first_contact(const PartsBvh& a, const Motion& motion_a, const PartsBvh& b,
                                const Motion& motion_b, double duration, const PartsQuestion& question) {
  return Race<Parts>({a}, motion_a, {b}, motion_b, duration, question).run();
}

}  // namespace throng::narrowphase
