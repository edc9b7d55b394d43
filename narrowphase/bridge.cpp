// SPDX-License-Identifier: MIT
#include "narrowphase/bridge.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "narrowphase/orientation.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

using Line = std::vector<Vec>;

/// An edge that a horizontal line crosses, from below: `low` on the line or under it, `high` above it.
struct Crossed {
  Vec low, high;
};

/// The edge of the line that is hit first on the way from `m` to the left, or rather just above that way, so
/// that it is never hit at a vertex.
Crossed first_to_the_left(const Line& line, const Vec& m) {
  std::optional<Crossed> first;
  const auto is_nearer = [&](const Crossed& e) {
    if (!first) return true;
    if (e.low.y() >= first->low.y()) {
      const int side = orientation(first->low, first->high, e.low);
      if (side != 0) return side < 0;
    } else if (const int side = orientation(e.low, e.high, first->low); side != 0) {
      return side > 0;
    }
    return orientation(first->low, first->high, e.high) < 0;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec &p = line[i], &q = line[next(i, line.size())];
    if ((p.y() > m.y()) == (q.y() > m.y())) continue;
    const Crossed e = p.y() > m.y() ? Crossed{q, p} : Crossed{p, q};
    if (orientation(e.low, e.high, m) < 0 && is_nearer(e)) first = e;
  }
  assert(first);
  return *first;
}

/// A vertex that sees `m`. m looks left and sees an edge. Its left end, unless vertices stand in the triangle
/// between: then, of these, the one nearest to that way in angle (Eberly 2002, Triangulation by Ear
/// Clipping).
Vec seen_from(const Line& line, const Vec& m) {
  const Crossed wall = first_to_the_left(line, m);
  const bool above = lies_before(wall.high, wall.low);
  const int inwards = above ? 1 : -1;
  Vec best = above ? wall.high : wall.low;
  for (const Vec& v : line) {
    if ((v.y() > m.y()) != above || !lies_before(v, m) || orientation(wall.low, wall.high, v) >= 0) continue;
    const int side = inwards * orientation(m, best, v);
    if (side > 0 || (side == 0 && v.x() > best.x())) best = v;
  }
  return best;
}

/// Whether the way from line[i] to `m`, which runs along no edge, begins inside.
bool opens_towards(const Line& line, std::size_t i, const Vec& m) {
  const Vec &before = line[previous(i, line.size())], &here = line[i], &after = line[next(i, line.size())];
  const bool left_of_before = orientation(before, here, m) > 0;
  const bool left_of_after = orientation(here, after, m) > 0;
  return orientation(before, here, after) > 0 ? left_of_before && left_of_after
                                              : left_of_before || left_of_after;
}

/// Of the times that the line comes by `place`, the one that sees `m`.
std::size_t visit_that_sees(const Line& line, const Vec& place, const Vec& m) {
  std::size_t i = 0;
  while (i < line.size() && !(line[i] == place && opens_towards(line, i, m))) ++i;
  assert(i < line.size());
  return i;
}

/// Lets the line run to the hole's first vertex, round and back.
void add_hole(Line& line, const Line& hole) {
  const Vec here = seen_from(line, hole[0]);
  const std::size_t at = visit_that_sees(line, here, hole[0]);
  Line detour = hole;
  detour.push_back(hole[0]);
  detour.push_back(here);
  line.insert(line.begin() + static_cast<std::ptrdiff_t>(at) + 1, detour.begin(), detour.end());
}

}  // namespace

std::vector<Vec> bridged(std::span<const std::vector<Vec>> rings) {
  std::vector<Line> holes(rings.begin() + 1, rings.end());
  for (Line& hole : holes)
    std::rotate(hole.begin(), std::min_element(hole.begin(), hole.end(), lies_before), hole.end());
  std::sort(holes.begin(), holes.end(), [](const Line& g, const Line& h) { return lies_before(g[0], h[0]); });
  Line line = rings[0];
  for (const Line& hole : holes) add_hole(line, hole);
  return line;
}

}  // namespace throng::narrowphase
