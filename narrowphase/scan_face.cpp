// SPDX-License-Identifier: MIT
#include "narrowphase/scan_face.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/scan_face.cpp"
#include <hwy/foreach_target.h>  // compiles what follows for each instruction set
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace throng::narrowphase::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, 4>;
using Reals = hn::Vec<D>;
constexpr std::size_t kMostLanes = hn::MaxLanes(D());
static_assert(sizeof(Vec) == 2 * sizeof(double));

/// A face in each lane, edge and vertex as numbers.
struct WideFace {
  Reals separation, edge, vertex;
};

/// Those of the edges whose normals and first vertices begin there, elementwise: how many at a time changes
/// no bit.
HWY_INLINE WideFace face_at(const Vec* normals, const Vec* vertices, std::size_t edge, const Convex& b,
                            const Pose& b_in_a) {
  const D d;
  Reals x, y, from_x, from_y;
  hn::LoadInterleaved2(d, normals[edge].data(), x, y);
  hn::LoadInterleaved2(d, vertices[edge].data(), from_x, from_y);
  const Reals cos = hn::Set(d, b_in_a.cos), sin = hn::Set(d, b_in_a.sin), one = hn::Set(d, 1.0);
  const Reals in_b_x = hn::Add(hn::Mul(cos, x), hn::Mul(sin, y));
  const Reals in_b_y = hn::Sub(hn::Mul(cos, y), hn::Mul(sin, x));
  Reals least = hn::Set(d, std::numeric_limits<double>::infinity()), vertex = hn::Zero(d), j = hn::Zero(d);
  for (const Vec& v : b.vertices) {
    const Reals height = hn::Add(hn::Mul(in_b_x, hn::Set(d, v.x())), hn::Mul(in_b_y, hn::Set(d, v.y())));
    const auto lower = hn::Lt(height, least);
    least = hn::IfThenElse(lower, height, least), vertex = hn::IfThenElse(lower, j, vertex);
    j = hn::Add(j, one);
  }
  const Reals to_b_x = hn::Sub(hn::Set(d, b_in_a.position.x()), from_x);
  const Reals to_b_y = hn::Sub(hn::Set(d, b_in_a.position.y()), from_y);
  const Reals separation = hn::Add(least, hn::Add(hn::Mul(x, to_b_x), hn::Mul(y, to_b_y)));
  return {separation, hn::Iota(d, static_cast<double>(edge)), vertex};
}

/// The widest of the lanes, and of those the first edge's.
HWY_INLINE Face widest(const WideFace& face) {
  alignas(64) double separation[kMostLanes], edge[kMostLanes], vertex[kMostLanes];
  const D d;
  hn::Store(face.separation, d, separation);
  hn::Store(face.edge, d, edge);
  hn::Store(face.vertex, d, vertex);
  std::size_t best = 0;
  for (std::size_t lane = 1; lane < hn::Lanes(d); ++lane) {
    const bool wider = separation[lane] > separation[best];
    const bool before = separation[lane] == separation[best] && edge[lane] < edge[best];
    best = (wider | before) ? lane : best;
  }
  return {separation[best], static_cast<std::size_t>(edge[best]), static_cast<std::size_t>(vertex[best])};
}

Face scan_face(const Convex& a, const Convex& b, const Pose& b_in_a) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  assert(a.normals.size() >= 2 && !b.vertices.empty());
  const Vec *normals = a.normals.data(), *vertices = a.vertices.data();
  std::size_t count = a.normals.size();
  Vec few_normals[kMostLanes], few_vertices[kMostLanes];
  if (count < lanes) {  // the last edge fills up
    for (std::size_t i = 0; i < lanes; ++i) {
      few_normals[i] = normals[std::min(i, count - 1)], few_vertices[i] = vertices[std::min(i, count - 1)];
    }
    normals = few_normals, vertices = few_vertices, count = lanes;
  }
  WideFace best = face_at(normals, vertices, 0, b, b_in_a);
  for (std::size_t first = lanes; first < count; first += lanes) {  // the last ones once more, if need be
    const WideFace more = face_at(normals, vertices, std::min(first, count - lanes), b, b_in_a);
    const auto wider = hn::Gt(more.separation, best.separation);
    best = {hn::IfThenElse(wider, more.separation, best.separation),
            hn::IfThenElse(wider, more.edge, best.edge), hn::IfThenElse(wider, more.vertex, best.vertex)};
  }
  return widest(best);
}

}  // namespace
}  // namespace throng::narrowphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng::narrowphase {

HWY_EXPORT(scan_face);

Face scan_face(const Convex& a, const Convex& b, const Pose& b_in_a) {
  return HWY_DYNAMIC_DISPATCH(scan_face)(a, b, b_in_a);
}

}  // namespace throng::narrowphase
#endif
