// SPDX-License-Identifier: MIT
#include "narrowphase/polygon.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/crossing.h"
#include "narrowphase/orientation.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

constexpr double kLargest = 1e100;  // m; products of four lengths stay finite
constexpr double kLeast = 1e-140;   // m; products of two keep all their digits, as `orientation` expects

/// A vertex and its place in the polygon as given.
struct Given {
  Vec point;
  std::size_t index;
};

std::string vertex_name(std::size_t index) {
  return "vertex " + std::to_string(index);
}

std::string name_faulty(std::span<const Vec> vertices) {
  const auto too_large = [](double x) { return !(std::abs(x) <= kLargest); };
  const auto too_small = [](double x) { return x != 0.0 && std::abs(x) < kLeast; };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec& v = vertices[i];
    if (too_large(v.x()) || too_large(v.y()))
      return vertex_name(i) + " is not finite or farther out than 1e100 m";
    if (too_small(v.x()) || too_small(v.y()))
      return vertex_name(i) + " has a coordinate that is not 0 but smaller than 1e-140 m";
  }
  return {};
}

std::vector<Given> weld_equal(std::span<const Vec> vertices, std::vector<std::string>& repairs) {
  std::size_t count = vertices.size();
  if (count > 1 && vertices[0] == vertices[count - 1]) --count;
  std::vector<Given> kept;
  for (std::size_t i = 0; i < count; ++i) {
    if (!kept.empty() && kept.back().point == vertices[i])
      repairs.push_back(vertex_name(i) + " repeats the one before it: dropped");
    else
      kept.push_back({vertices[i], i});
  }
  while (kept.size() > 1 && kept.back().point == kept.front().point) {
    repairs.push_back(vertex_name(kept.back().index) + " repeats vertex 0: dropped");
    kept.pop_back();
  }
  return kept;
}

bool all_on_a_line(const std::vector<Given>& vertices) {
  return std::all_of(vertices.begin(), vertices.end(), [&](const Given& v) {
    return orientation(vertices[0].point, vertices[1].point, v.point) == 0;
  });
}

/// Drops vertices that lie on the straight line from the one before to the one after; folds stay, to be
/// refused.
std::vector<Given> weld_straight(const std::vector<Given>& vertices, std::vector<std::string>& repairs) {
  std::vector<Given> kept;
  const std::size_t count = vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec& before = kept.empty() ? vertices[count - 1].point : kept.back().point;
    const Vec& here = vertices[i].point;
    const Vec& after = vertices[next(i, count)].point;
    if (orientation(before, here, after) == 0 && dot(here - before, after - here) > 0.0)
      repairs.push_back(vertex_name(vertices[i].index) + " lies on a straight edge: dropped");
    else
      kept.push_back(vertices[i]);
  }
  return kept;
}

std::string name_crossing(const Cleaned& cleaned, std::size_t i, std::size_t j) {
  return edge_name(cleaned, i) + " meets " + edge_name(cleaned, j) +
         " (vertices counted from 0): it must not cross or touch itself";
}

/// Of a simple polygon: by its turn at the leftmost, there lowest vertex.
bool is_clockwise(const std::vector<Vec>& polygon) {
  const std::size_t count = polygon.size();
  const auto i = static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end(), lies_before) -
                                          polygon.begin());
  return orientation(polygon[previous(i, count)], polygon[i], polygon[next(i, count)]) < 0;
}

Cleaned refused(std::string why) {
  return {{}, {}, {}, std::move(why)};
}

/// All but the sense of the vertices.
Cleaned mend(std::span<const Vec> vertices) {
  if (std::string fault = name_faulty(vertices); !fault.empty()) return refused(std::move(fault));
  Cleaned result;
  const std::vector<Given> distinct = weld_equal(vertices, result.repairs);
  if (distinct.size() < 3) return refused("a polygon needs three different vertices or more");
  if (all_on_a_line(distinct)) return refused("all vertices lie on a line: the polygon has no area");
  for (const Given& v : weld_straight(distinct, result.repairs)) {
    result.vertices.push_back(v.point);
    result.given.push_back(v.index);
  }
  if (const auto crossing = find_crossing(result.vertices))
    return refused(name_crossing(result, crossing->first, crossing->second));
  return result;
}

/// Vertex 0 stays.
void turn_round(Cleaned& polygon) {
  std::reverse(polygon.vertices.begin() + 1, polygon.vertices.end());
  std::reverse(polygon.given.begin() + 1, polygon.given.end());
}

struct ScaledMoments {
  double twice_area = 0.0;
  Vec first{0.0, 0.0};  // six times
  double second = 0.0;  // twelve times
};

/// About `origin`, by triangles from there to each edge.
ScaledMoments scaled_moments(std::span<const std::span<const Vec>> rings, const Vec& origin) {
  ScaledMoments m;
  for (const std::span<const Vec> ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec p = ring[i] - origin, q = ring[next(i, ring.size())] - origin;
      const double twice = cross(p, q);
      m.twice_area += twice;
      m.first += twice * (p + q);
      m.second += twice * (dot(p, p) + dot(p, q) + dot(q, q));
    }
  return m;
}

MassProperties mass_properties_of(std::span<const std::span<const Vec>> rings) {
  const Vec& vertex = rings[0][0];
  const ScaledMoments about_vertex = scaled_moments(rings, vertex);
  const Vec centroid = vertex + about_vertex.first / (3.0 * about_vertex.twice_area);
  const ScaledMoments m = scaled_moments(rings, centroid);
  return {0.5 * about_vertex.twice_area, centroid, m.second / (6.0 * m.twice_area)};
}

}  // namespace

std::string edge_name(const Cleaned& polygon, std::size_t edge) {
  const auto [first, last] =
      std::minmax(polygon.given[edge], polygon.given[next(edge, polygon.given.size())]);
  return "edge " + std::to_string(first) + "-" + std::to_string(last);
}

Cleaned clean(std::span<const Vec> vertices) {
  Cleaned result = mend(vertices);
  if (result.refusal.empty() && is_clockwise(result.vertices)) {
    turn_round(result);
    result.repairs.push_back("the vertices run clockwise: turned round");
  }
  return result;
}

Cleaned clean_hole(std::span<const Vec> vertices) {
  Cleaned result = mend(vertices);
  if (result.refusal.empty() && !is_clockwise(result.vertices)) turn_round(result);
  return result;
}

MassProperties mass_properties(std::span<const Vec> polygon) {
  return mass_properties_of({&polygon, 1});
}

MassProperties mass_properties(std::span<const std::vector<Vec>> rings) {
  return mass_properties_of(std::vector<std::span<const Vec>>(rings.begin(), rings.end()));
}

}  // namespace throng::narrowphase
