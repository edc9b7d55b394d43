// SPDX-License-Identifier: MIT
#include "narrowphase/motion/first_contact_parts-inl.h"

namespace throng::narrowphase {

namespace {

/// Each edge a segment, in a place that is kept for it.
template <class Volume>
class Segments {
 public:
  explicit Segments(const Outline<Volume>& solid) : solid_(&solid), edge_(segment({0.0, 0.0}, {1.0, 0.0})) {}

  const Bvh<Volume>& tree() const { return solid_->tree; }
  std::uint32_t name(std::uint32_t place) const { return solid_->edges[place].index; }

  const Convex& shape(std::uint32_t place) {
    const OutlineEdge& edge = solid_->edges[place];
    const Vec along = direction(edge.q - edge.p, {0.0, 1.0}).unit;
    edge_.vertices[0] = edge.p, edge_.vertices[1] = edge.q;
    edge_.normals[0] = {along.y(), -along.x()}, edge_.normals[1] = -edge_.normals[0];
    return edge_;
  }

 private:
  const Outline<Volume>* solid_;
  Convex edge_;
};

/// Two solids on their ways.
template <class Volume>
class Outlines {
 public:
  Outlines(const Outline<Volume>& a, const Motion& motion_a, const Outline<Volume>& b, const Motion& motion_b)
      : a_(a), b_(b), motion_a_(motion_a), motion_b_(motion_b) {}

  /// Whether they share a point then, and the edges that meet: the first where one is in the other.
  bool collide(double time, FirstPartsContact& found) const {
    OutlineCache cache;
    const CollisionQuestion question{Order::depth_first, &cache};
    if (!narrowphase::collide(a_, pose_at(motion_a_, time), b_, pose_at(motion_b_, time), question))
      return false;
    found.part_a = a_.edges[cache.a].index, found.part_b = b_.edges[cache.b].index;
    return true;
  }

  /// Segments that meet in line, as those of boxes do, pass through each other without a depth: the solids
  /// tell.
  void settle(const PartsQuestion& question, FirstPartsContact& found) const {
    constexpr int kDoublings = 16;
    const double doubt = found.contact.t_lo, far_a = a_.tree.nodes[0].far, far_b = b_.tree.nodes[0].far;
    const double rounding =
        4.0 * (pose_rounding(motion_a_, doubt, far_a) + pose_rounding(motion_b_, doubt, far_b));
    double ahead = std::max(question.width * std::min(far_a, far_b), rounding);
    ahead /= gap_rate(motion_a_, motion_b_).of(far_a, far_b);
    for (int i = 0; i < kDoublings; ++i, ahead *= 2.0) {
      const double time = std::min(doubt + ahead, found.contact.t_hi);
      if (collide(time, found)) found.contact.verdict = Verdict::hit, found.contact.t_hi = time;
      if (found.contact.verdict == Verdict::hit || time == found.contact.t_hi) return;
    }
  }

 private:
  const Outline<Volume>&a_, &b_;
  const Motion &motion_a_, &motion_b_;
};

}  // namespace

template <class Volume>
FirstPartsContact first_contact(const Outline<Volume>& a, const Motion& motion_a, const Outline<Volume>& b,
                                const Motion& motion_b, double duration, const PartsQuestion& question) {
  const Outlines<Volume> solids(a, motion_a, b, motion_b);
  FirstPartsContact found{{Verdict::hit, 0.0, 0.0, 0}, 0, 0};
  if (solids.collide(0.0, found)) return found;
  found = Race(Segments(a), motion_a, Segments(b), motion_b, duration, question).run();
  if (found.contact.verdict == Verdict::undecided) solids.settle(question, found);
  return found;
}

#define THRONG_FIRST_CONTACT(VOLUME)                                                                      \
  template FirstPartsContact first_contact(const Outline<VOLUME>&, const Motion&, const Outline<VOLUME>&, \
                                           const Motion&, double, const PartsQuestion&);
THRONG_FIRST_CONTACT(Ball<2>)
THRONG_FIRST_CONTACT(Box<2>)
THRONG_FIRST_CONTACT(OrientedBox<2>)
THRONG_FIRST_CONTACT(BoxAndBall<2>)
#undef THRONG_FIRST_CONTACT

}  // namespace throng::narrowphase
