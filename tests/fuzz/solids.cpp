// SPDX-License-Identifier: MIT
// Two polygons from bytes, some with holes, mostly on a grid, where things touch, coincide and stand in line:
// all that the hierarchies, the parts and the tracker say about them must agree with the definitions.
#include <algorithm>
#include <cmath>

#include "narrowphase/bvh_edges.h"
#include "narrowphase/bvh_exhaustive.h"
#include "narrowphase/bvh_parts.h"
#include "narrowphase/decompose.h"
#include "narrowphase/holes.h"
#include "narrowphase/nearest_parts.h"
#include "narrowphase/orientation.h"
#include "narrowphase/polygon.h"
#include "narrowphase/relative.h"
#include "narrowphase/tracker.h"
#include "tests/fuzz/fuzz.h"

namespace throng::fuzz {

namespace {

using namespace narrowphase;
using Ring = std::vector<Vec>;
using Rings = std::vector<Ring>;

/// Takes numbers from bytes; zeros where these have ended.
struct Bytes {
  const std::uint8_t* at;
  const std::uint8_t* end;

  int byte() { return at == end ? 0 : *at++; }
  int signed_byte() { return byte() - 128; }
};

/// Up to 20 vertices on a grid of 1/8, in a scale of a power of two, some of them a little off the grid.
Ring ring(Bytes& bytes, double scale) {
  const int count = 3 + bytes.byte() % 18, wobble = bytes.byte();
  Ring result;
  for (int i = 0; i < count; ++i) {
    Vec v(bytes.signed_byte() / 8.0, bytes.signed_byte() / 8.0);
    if (wobble & (1 << (i % 8))) v *= 1.0 + 0x1p-40 * bytes.signed_byte();
    result.push_back(scale * v);
  }
  return result;
}

/// The rings of a solid, those holes left out that are none; empty where the outline is none.
Rings rings(Bytes& bytes, double scale, int holes) {
  Rings result{ring(bytes, scale)};
  for (int i = 0; i < holes; ++i) {
    result.push_back(ring(bytes, scale));
    if (clean(result).rings.empty()) result.pop_back();
  }
  return clean(result).rings;
}

/// Every second one in quarter turns.
Pose place(Bytes& bytes, double scale) {
  const Vec at = scale * Vec(bytes.signed_byte() / 8.0, bytes.signed_byte() / 8.0);
  const int turn = bytes.byte();
  constexpr double kQuarters[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  if (turn % 2 == 0) return {at, kQuarters[turn / 2 % 4][0], kQuarters[turn / 2 % 4][1]};
  return pose(at, 0.0246 * turn);
}

struct Placed {
  Rings rings;
  Pose pose;
};

bool same(const Separation& one, const Separation& other) {
  return one.distance == other.distance && one.normal == other.normal && one.point_a == other.point_a &&
         one.point_b == other.point_b;
}

/// Of a point on no edge.
bool hold(const Rings& rings, const Vec& point) {
  bool inside = false;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      inside ^= ray_passes(point, ring[i], ring[next(i, ring.size())]);
  return inside;
}

/// Strictly convex parts, as much as the rings hold, one of them where these hold a point.
void check_decomposition(const Rings& rings, double scale) {
  double area = 0.0;
  const Ring& last = rings.back();
  const Vec probe = (last[0] + last[1] + last[2]) / 3.0;
  int holding = 0;
  bool on_a_rim = false;
  for (const Convex& part : decompose(rings)) {
    const Ring& v = part.vertices;
    int least = 1;
    for (std::size_t i = 0, j = 1, k = 2; i < v.size(); ++i, j = next(j, v.size()), k = next(k, v.size())) {
      expect(orientation(v[i], v[j], v[k]) > 0, "parts are strictly convex");
      least = std::min(least, orientation(v[i], v[j], probe));
    }
    holding += least > 0;
    on_a_rim |= least == 0;
    area += mass_properties(v).area;
  }
  expect(on_a_rim || holding == hold(rings, probe), "one part holds what the solid holds, else none");
  expect(std::abs(area - mass_properties(rings).area) <= 1e-14 * scale * scale,
         "parts are as large as their solid");
}

/// Parts one by one and in hierarchies. Returns their distance.
double check_parts(const Placed& a, const Placed& b, double radius) {
  const auto of_a = decompose(a.rings, radius), of_b = decompose(b.rings);
  const Separation all = separation(of_a, a.pose, of_b, b.pose);
  expect(same(all, separation(parts_bvh(of_a, {Split::sah, 1}), a.pose, parts_bvh(of_b), b.pose)),
         "a hierarchy of parts says what all pairs say");
  return all.distance;
}

template <class Volume>
void check_outlines(const Placed& a, const Placed& b, double scale, double of_parts) {
  const auto shape_a = outline<Volume>(a.rings, {Split::middle, 1}), shape_b = outline<Volume>(b.rings);
  const OutlineProximity all =
      exhaustive_proximity(outline_edges(a.rings), a.pose, outline_edges(b.rings), b.pose);
  const OutlineProximity found = proximity(shape_a, a.pose, shape_b, b.pose);
  const double rounding = 1e-13 * scale;
  expect(std::abs(found.upper - all.upper) <= rounding, "an outline is as far as all its edges say");
  expect(found.lower <= found.upper, "lower <= upper");
  if (found.upper > rounding) expect(std::abs(found.upper - of_parts) <= rounding, "parts are as far");
  if (of_parts < -rounding) expect(found.upper <= 0.0, "parts that overlap are outlines that do");
  const bool collides = collide(shape_a, a.pose, shape_b, b.pose);
  expect(collides == (found.upper <= 0.0), "what collides has no distance");
  expect(collides == collide(shape_b, b.pose, shape_a, a.pose, {Order::best_first}), "in any order");
  const OutlineProximity rough = proximity(shape_a, a.pose, shape_b, b.pose, {0.5, nullptr, nullptr});
  expect(found.upper <= 0.0 || (rough.lower <= found.upper && found.upper <= rough.upper &&
                                rough.upper <= 1.5 * rough.lower * (1.0 + 1e-15)),
         "an approximate distance keeps its promise");
}

/// Their first parts, along a motion: what is remembered never misleads.
void check_tracking(const Placed& a, Placed b, Bytes& bytes, double scale) {
  const Convex of_a = decompose(a.rings)[0], of_b = decompose(b.rings)[0];
  ClosestFeatures features;
  for (int step = 0; step < 6; ++step) {
    const Separation found = track(of_a, a.pose, of_b, b.pose, features);
    const double expected = separation(of_a, a.pose, of_b, b.pose).distance;
    expect(std::abs(found.distance - expected) <= 1e-13 * scale, "a tracked pair is as far");
    b.pose = place(bytes, scale);
  }
}

}  // namespace

}  // namespace throng::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng::fuzz;
  Bytes bytes{data, data + size};
  const int first = bytes.byte(), holes = first % 4;
  const double scale = std::ldexp(1.0, (first - 128) / 4);
  Placed a{rings(bytes, scale, holes), place(bytes, scale)},
      b{rings(bytes, scale, holes), place(bytes, scale)};
  if (a.rings.empty() || b.rings.empty()) return 0;
  const double radius = bytes.byte() % 4 == 3 ? scale * bytes.byte() / 64.0 : 0.0;
  const double reach = 64.0 * scale;
  check_decomposition(a.rings, reach);
  check_parts(a, b, radius);
  const double distance = check_parts(a, b, 0.0);
  constexpr decltype(&check_outlines<Box<2>>) kVolumes[] = {&check_outlines<Ball<2>>, &check_outlines<Box<2>>,
                                                            &check_outlines<OrientedBox<2>>,
                                                            &check_outlines<BoxAndBall<2>>};
  kVolumes[bytes.byte() % 4](a, b, reach, distance);
  check_tracking(a, b, bytes, reach);
  return 0;
}
