// SPDX-License-Identifier: MIT
// What narrowphase/manifold.cpp and place() of describe_face.cpp do, in their order of operations, for pairs
// whose features are known: the same bits.
#include "sim/contact/held_faces.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/answer_held_faces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "sim/contact/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {
namespace {

using narrowphase::EndOf;
using narrowphase::kHeldRounding;

struct Vecs {
  Reals x, y;
};

HWY_INLINE Reals set(double value) {
  return hn::Set(D(), value);
}
HWY_INLINE Vecs load(const double* x, const double* y) {
  return {load(x), load(y)};
}
HWY_INLINE Vecs operator-(const Vecs& u, const Vecs& v) {
  return {hn::Sub(u.x, v.x), hn::Sub(u.y, v.y)};
}
HWY_INLINE Vecs operator+(const Vecs& u, const Vecs& v) {
  return {hn::Add(u.x, v.x), hn::Add(u.y, v.y)};
}
HWY_INLINE Vecs operator*(Reals scale, const Vecs& v) {
  return {hn::Mul(scale, v.x), hn::Mul(scale, v.y)};
}
HWY_INLINE Reals dot(const Vecs& u, const Vecs& v) {
  return dot(u.x, u.y, v.x, v.y);
}
HWY_INLINE Reals cross(const Vecs& u, const Vecs& v) {
  return hn::Sub(hn::Mul(u.x, v.y), hn::Mul(u.y, v.x));
}
HWY_INLINE Vecs turned_left(const Vecs& v) {
  return {hn::Neg(v.y), v.x};
}
HWY_INLINE Vecs choose(Mask mask, const Vecs& yes, const Vecs& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y)};
}
HWY_INLINE Reals length(const Vecs& v) {
  return hn::Sqrt(dot(v, v));
}

/// As narrowphase::Pose.
struct Poses {
  Vecs position;
  Reals cos, sin;

  HWY_INLINE Vecs rotate(const Vecs& v) const {
    return {hn::Sub(hn::Mul(cos, v.x), hn::Mul(sin, v.y)), hn::Add(hn::Mul(sin, v.x), hn::Mul(cos, v.y))};
  }
  HWY_INLINE Vecs unrotate(const Vecs& v) const {
    return {hn::Add(hn::Mul(cos, v.x), hn::Mul(sin, v.y)), hn::Sub(hn::Mul(cos, v.y), hn::Mul(sin, v.x))};
  }
  HWY_INLINE Vecs operator*(const Vecs& v) const { return rotate(v) + position; }
};

HWY_INLINE Poses relative(const Poses& a, const Poses& b) {
  return {a.unrotate(b.position - a.position), hn::Add(hn::Mul(a.cos, b.cos), hn::Mul(a.sin, b.sin)),
          hn::Sub(hn::Mul(a.cos, b.sin), hn::Mul(a.sin, b.cos))};
}
HWY_INLINE Poses inverse(const Poses& p) {
  const Vecs back = p.unrotate(p.position);
  return {{hn::Neg(back.x), hn::Neg(back.y)}, p.cos, hn::Neg(p.sin)};
}
HWY_INLINE Poses choose(Mask mask, const Poses& yes, const Poses& no) {
  return {choose(mask, yes.position, no.position), hn::IfThenElse(mask, yes.cos, no.cos),
          hn::IfThenElse(mask, yes.sin, no.sin)};
}

struct WideParts {
  Poses pose;
  Reals inverse_mass, inverse_inertia, reach, pace;
};

HWY_INLINE WideParts parts_of(const PlacedPart* parts, const std::uint32_t* rows) {
  const Four place = gather<8>(&parts->x, rows), rest = gather<8>(&parts->inverse_mass, rows);
  return {{{place.first, place.second}, place.third, place.fourth},
          rest.first,
          rest.second,
          rest.third,
          rest.fourth};
}

/// As Clip of manifold.cpp.
struct Clips {
  Vecs origin, normal, tangent;  // of the reference
  Reals face_length;
  Vecs head, tail;  // of the incident edge
  Reals head_along, tail_along, head_gap, tail_gap;
  Mask tail_is_deepest, covers;
  Reals separation, deepest_along;

  HWY_INLINE Reals gap_at(Reals along) const {
    return hn::Add(head_gap, hn::Mul(hn::Sub(tail_gap, head_gap),
                                     hn::Div(hn::Sub(along, head_along), hn::Sub(tail_along, head_along))));
  }
};

HWY_INLINE Clips clip(const HeldBlock& h, std::size_t k, const Poses& incident) {
  const D d;
  const Reals zero = hn::Zero(d);
  Clips c;
  c.origin = load(h.origin_x + k, h.origin_y + k), c.normal = load(h.normal_x + k, h.normal_y + k);
  c.tangent = turned_left(c.normal);
  c.face_length = dot(c.tangent, load(h.face_head_x + k, h.face_head_y + k) - c.origin);
  const Vecs head = load(h.head_x + k, h.head_y + k), tail = load(h.tail_x + k, h.tail_y + k);
  const Vecs normal = incident.unrotate(c.normal);
  const Reals head_height = dot(normal, head), tail_height = dot(normal, tail);
  c.tail_is_deepest = hn::Or(hn::Lt(tail_height, head_height),
                             hn::And(hn::Eq(tail_height, head_height), hn::Ne(load(h.tail_first + k), zero)));
  c.separation = hn::Add(hn::IfThenElse(c.tail_is_deepest, tail_height, head_height),
                         dot(c.normal, incident.position - c.origin));
  c.head = incident * head, c.tail = incident * tail;
  const Vecs to_head = c.head - c.origin, to_tail = c.tail - c.origin;
  c.head_along = dot(c.tangent, to_head), c.tail_along = dot(c.tangent, to_tail);
  c.head_gap = dot(c.normal, to_head), c.tail_gap = dot(c.normal, to_tail);
  c.covers = hn::And(hn::Gt(c.tail_along, c.head_along),
                     hn::And(hn::Gt(c.tail_along, zero), hn::Lt(c.head_along, c.face_length)));
  c.deepest_along = hn::IfThenElse(c.tail_is_deepest, c.tail_along, c.head_along);
  return c;
}

/// As End of manifold.cpp.
struct Ends {
  Reals along, gap, which;
};

HWY_INLINE Reals set(narrowphase::EndOf end) {
  return set(static_cast<double>(end));
}

HWY_INLINE Ends choose(Mask mask, const Ends& yes, const Ends& no) {
  return {hn::IfThenElse(mask, yes.along, no.along), hn::IfThenElse(mask, yes.gap, no.gap),
          hn::IfThenElse(mask, yes.which, no.which)};
}

HWY_INLINE Ends low(const Clips& c) {
  const Reals zero = hn::Zero(D());
  return choose(hn::Ge(c.head_along, zero), Ends{c.head_along, c.head_gap, set(EndOf::head)},
                Ends{zero, c.gap_at(zero), set(EndOf::above_tail)});
}
HWY_INLINE Ends high(const Clips& c) {
  return choose(hn::Le(c.tail_along, c.face_length), Ends{c.tail_along, c.tail_gap, set(EndOf::tail)},
                Ends{c.face_length, c.gap_at(c.face_length), set(EndOf::above_head)});
}
HWY_INLINE Ends deepest(const Clips& c) {
  const Reals zero = hn::Zero(D()), along = c.deepest_along;
  const Reals before_head = hn::IfThenElse(hn::Lt(c.face_length, along), c.face_length, along);
  return {hn::IfThenElse(hn::Lt(along, zero), zero, before_head), c.separation,
          hn::IfThenElse(c.tail_is_deepest, set(EndOf::tail), set(EndOf::head))};
}

/// How far the incident edge, as a face, would keep the reference outside; at most, as other vertices of the
/// reference may lie deeper than its two. By the edge's own normal: of a short one the ends say too little.
HWY_INLINE Reals rival(const Clips& c, const HeldBlock& h, std::size_t k, const Poses& incident) {
  const Vecs outward = incident.rotate(load(h.incident_normal_x + k, h.incident_normal_y + k));
  const Vecs face_head = load(h.face_head_x + k, h.face_head_y + k);
  return hn::Min(dot(outward, c.origin - c.tail), dot(outward, face_head - c.tail));
}

HWY_INLINE Reals effective_mass(const WideParts& a, const WideParts& b, const Vecs& arm_a, const Vecs& arm_b,
                                const Vecs& direction) {
  const Reals turn_a = cross(arm_a, direction), turn_b = cross(arm_b, direction);
  const Reals pushed =
      hn::Add(hn::Add(a.inverse_mass, b.inverse_mass), hn::Mul(hn::Mul(a.inverse_inertia, turn_a), turn_a));
  return hn::Div(set(1.0), hn::Add(pushed, hn::Mul(hn::Mul(b.inverse_inertia, turn_b), turn_b)));
}

/// Two bodies, the normal between them, and how to get from a to b itself.
struct WideContacts {
  const WideParts &a, &b;
  Vecs image_of_b, normal, between;

  /// Zero, and so without mass, where there is none.
  HWY_INLINE void write(FaceBlock::Point& p, std::size_t k, Mask is, const HeldBlock& h, const Clips& c,
                        const Poses& frame, const Ends& end) const {
    const Reals radius = load(h.radius_reference + k), incident_radius = load(h.radius_incident + k);
    const Reals separation = hn::Sub(end.gap, hn::Add(radius, incident_radius));
    const Reals middle = hn::Mul(set(0.5), hn::Sub(hn::Add(end.gap, radius), incident_radius));
    const Vecs point = frame * ((c.origin + end.along * c.tangent) + middle * c.normal);
    const Vecs first_a = point - a.pose.position, first_b = point - image_of_b;
    const auto store_if = [=](Reals v, double* row) HWY_ATTR { store(hn::IfThenElseZero(is, v), row + k); };
    store_if(first_a.x, p.first_ax), store_if(first_a.y, p.first_ay);
    store_if(first_b.x, p.first_bx), store_if(first_b.y, p.first_by);
    store_if(hn::Sub(separation, dot(normal, between + (first_b - first_a))), p.gap);
    store_if(effective_mass(a, b, first_a, first_b, normal), p.normal_mass);
    store_if(effective_mass(a, b, first_a, first_b, turned_left(normal)), p.tangent_mass);
  }
};

HWY_INLINE Mask are(Reals asked, Wanted what) {
  return hn::Eq(asked, set(static_cast<double>(what)));
}

/// How far two bodies have moved since, and how far apart they matter (m).
struct Ways {
  Reals movement, reach, enough, rounding;
};

HWY_INLINE Ways ways(const HeldBlock& h, std::size_t k, const WideParts& a, const WideParts& b,
                     const Poses& b_in_a) {
  const Vecs turn{hn::Sub(b_in_a.cos, load(h.cos + k)), hn::Sub(b_in_a.sin, load(h.sin + k))};
  const Vecs way = b_in_a.position - load(h.at_x + k, h.at_y + k);
  const Reals lever = load(h.lever + k), reach = hn::Add(a.reach, b.reach);
  const Reals enough = hn::Add(reach, hn::Add(load(h.radius_reference + k), load(h.radius_incident + k)));
  return {hn::Add(length(way), hn::Mul(lever, length(turn))), reach, enough,
          hn::Mul(set(kHeldRounding), hn::Add(lever, enough))};
}

HWY_INLINE Mask are_apart(const HeldBlock& h, std::size_t k, Reals asked, const Ways& w) {
  const Reals left = hn::Sub(hn::Sub(load(h.most + k), w.movement), w.enough);
  return hn::And(are(asked, Wanted::apart), hn::Gt(left, w.rounding));
}

/// The two ends of what both edges cover, and which of them are within reach.
struct Stretch {
  Ends first, second;
  Mask first_is_near, second_is_near;
};

HWY_INLINE Stretch stretch(const HeldBlock& h, std::size_t k, const Clips& c, Reals enough_of_gap) {
  const Ends first = choose(c.covers, low(c), deepest(c)), second = high(c);
  const Reals radii = hn::Add(load(h.radius_reference + k), load(h.radius_incident + k));
  return {first, second, hn::Le(hn::Sub(first.gap, radii), enough_of_gap),
          hn::And(c.covers, hn::Le(hn::Sub(second.gap, radii), enough_of_gap))};
}

/// Whether a search would describe the contact on this face, and not by two corners: where it is the widest,
/// or was the reference and no rival is wider by what that takes.
HWY_INLINE Mask stays(const HeldBlock& h, std::size_t k, Mask was_reference, const Clips& c,
                      const Poses& incident, const Stretch& s, const Ways& w) {
  const Reals zero = hn::Zero(D()), much = load(h.much + k), other = rival(c, h, k, incident);
  const Reals level = hn::Sub(hn::Add(c.separation, much), w.rounding);
  const Reals one_gap = hn::IfThenElse(s.first_is_near, s.first.gap, s.second.gap);
  const Reals least_gap =
      hn::IfThenElse(hn::And(s.first_is_near, s.second_is_near), hn::Min(s.first.gap, s.second.gap), one_gap);
  const Mask as_wide = hn::And(hn::And(hn::Le(other, level), hn::Le(least_gap, level)),
                               hn::Or(s.first_is_near, s.second_is_near));
  const Mask wider = hn::Lt(other, hn::Sub(c.separation, w.rounding));
  const Mask within = hn::Le(hn::Add(c.separation, much), hn::Sub(w.enough, w.rounding));
  const Mask at_corner = hn::And(hn::Gt(c.separation, zero), hn::Or(hn::Lt(c.deepest_along, zero),
                                                                    hn::Gt(c.deepest_along, c.face_length)));
  return hn::AndNot(at_corner, hn::And(within, hn::Or(wider, hn::And(was_reference, as_wide))));
}

/// Of who is known; -1 for others.
HWY_INLINE Reals count(Mask apart, Mask known, Mask first, Mask second) {
  const Reals zero = hn::Zero(D()), one = set(1.0);
  const Reals found = hn::Add(hn::IfThenElseZero(first, one), hn::IfThenElseZero(second, one));
  return hn::IfThenElse(apart, zero, hn::IfThenElse(known, found, set(-1.0)));
}

/// `solved`: where the contacts are solved, or null.
void answer_some(HeldBlock& h, HeldTalk& talk, FaceBlock* solved, std::size_t k, const PlacedPart* parts,
                 double fast) {
  const D d;
  const Reals asked = load(talk.asked + k);
  if (hn::AllTrue(d, are(asked, Wanted::nothing))) return store(set(-1.0), talk.count + k);
  const WideParts a = parts_of(parts, h.a + k), b = parts_of(parts, h.b + k);
  const Poses image{b.pose.position + load(h.shift_x + k, h.shift_y + k), b.pose.cos, b.pose.sin};
  const Poses b_in_a = relative(a.pose, image);
  const Ways w = ways(h, k, a, b, b_in_a);
  const Mask apart = are_apart(h, k, asked, w);
  const Mask was_reference = are(asked, Wanted::kept),
             face = hn::Or(was_reference, are(asked, Wanted::widest));
  if (hn::AllFalse(d, face)) return store(hn::IfThenElse(apart, hn::Zero(d), set(-1.0)), talk.count + k);

  const Mask of_b = hn::Ne(load(h.of_b + k), hn::Zero(d));
  const Poses incident = choose(of_b, inverse(b_in_a), b_in_a);
  const Clips c = clip(h, k, incident);
  const Stretch s = stretch(h, k, c, w.reach);
  const Mask beyond = hn::Gt(c.separation, hn::Add(w.enough, w.rounding));
  const Mask slow = hn::Lt(hn::Add(a.pace, b.pace), set(fast));
  const Mask described = hn::Or(beyond, hn::And(slow, stays(h, k, was_reference, c, incident, s, w)));
  const Mask known = hn::And(hn::And(face, hn::Le(w.movement, load(h.most + k))), described);
  const Mask touches = hn::AndNot(beyond, known);
  const Mask one = hn::And(touches, hn::Or(s.first_is_near, s.second_is_near));
  const Mask two = hn::And(touches, hn::And(s.first_is_near, s.second_is_near));
  store(count(apart, known, one, two), talk.count + k);
  const Ends first = choose(s.first_is_near, s.first, s.second);
  store(first.which, h.end[0] + k), store(s.second.which, h.end[1] + k);
  if (!solved) return;

  const Poses frame = choose(of_b, image, a.pose);
  const Vecs outward = choose(of_b, Vecs{hn::Neg(c.normal.x), hn::Neg(c.normal.y)}, c.normal);
  const WideContacts contacts{a, b, image.position, frame.rotate(outward), b.pose.position - a.pose.position};
  store(hn::IfThenElseZero(one, contacts.normal.x), solved->normal_x + k);
  store(hn::IfThenElseZero(one, contacts.normal.y), solved->normal_y + k);
  contacts.write(solved->points[0], k, one, h, c, frame, first);
  if (solved->count == 2) contacts.write(solved->points[1], k, two, h, c, frame, s.second);
}

void answer_all(std::span<HeldBlock> blocks, HeldTalk* talks, const PlacedPart* parts, double fast,
                std::span<FaceBlock> faces) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i + kAhead < blocks.size()) ask_for_bodies(blocks[i + kAhead], parts);
    FaceBlock* const solved = i < faces.size() ? &faces[i] : nullptr;
    for (std::size_t k = 0; k < BlockOrder::kWidth; k += kLanes)
      answer_some(blocks[i], talks[i], solved, k, parts, fast);
  }
}

}  // namespace
}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng {

namespace {
HWY_EXPORT(answer_all);
}  // namespace

void HeldFaces::answer(std::size_t begin, std::size_t end, std::span<const PlacedPart> parts, double fast,
                       std::span<FaceBlock> faces) {
  HWY_DYNAMIC_DISPATCH(answer_all)
  (std::span(blocks_).subspan(begin, end - begin), talks_.data() + begin, parts.data(), fast,
   faces.subspan(std::min(begin, faces.size())));
}

}  // namespace throng
#endif
