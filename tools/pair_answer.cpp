// SPDX-License-Identifier: MIT
#include "tools/pair_answer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "narrowphase/bvh_fit.h"
#include "narrowphase/bvh_parts.h"
#include "narrowphase/manifold.h"
#include "narrowphase/motion/first_contact_parts.h"
#include "sim/input_error.h"
#include "tools/answer_json.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;
using narrowphase::Convex;
using narrowphase::Vec;

/// How far the solid reaches along a unit vector, from `origin`.
double support(const Solid& solid, const Vec& along, const Vec& origin) {
  double farthest = -std::numeric_limits<double>::infinity();
  const Vec local = solid.pose.unrotate(along);
  for (const Convex& part : solid.parts)
    for (const Vec& v : part.vertices) farthest = std::max(farthest, local.dot(v) + part.radius);
  return farthest + along.dot(solid.pose.position - origin);
}

/// What is to be parted: the solid's hull as one part if its parts are equally rounded, else the solid.
Solid hull_if_equally_rounded(const Solid& solid) {
  const double radius = solid.parts[0].radius;
  narrowphase::Points<2> points;
  for (const Convex& part : solid.parts) {
    if (part.radius != radius) return solid;
    points.insert(points.end(), part.vertices.begin(), part.vertices.end());
  }
  narrowphase::reduce_to_hull<2>(points);
  return {{narrowphase::convex(std::move(points), radius)}, solid.pose, solid.motion};
}

/// Where b can move, along a unit vector, and how far it must to be surely apart from a.
struct WayOut {
  double length;
  Vec along;
};

/// The shortest of the ways out along the faces' normals and along `normal`: of two convex parts the shortest
/// there is.
WayOut way_out(const Solid& a, const Solid& b, const Vec& normal) {
  WayOut shortest{std::numeric_limits<double>::infinity(), normal};
  const auto try_along = [&](const Vec& n) {
    const double length = support(a, n, a.pose.position) + support(b, -n, a.pose.position);
    if (length < shortest.length) shortest = {length, n};
  };
  try_along(normal);
  for (const Convex& part : a.parts)
    for (const Vec& n : part.normals) try_along(a.pose.rotate(n));
  for (const Convex& part : b.parts)
    for (const Vec& n : part.normals) try_along(-b.pose.rotate(n));
  return shortest;
}

Json to_json(const narrowphase::Manifold& m) {
  Json points = Json::array();
  for (int i = 0; i < m.count; ++i) {
    const narrowphase::ManifoldPoint& p = m.points[static_cast<std::size_t>(i)];
    points.push_back({{"point", json(p.point)}, {"separation", p.separation}});
  }
  return points;
}

bool is_finite(const Json& value) {
  if (value.is_structured()) return std::all_of(value.begin(), value.end(), is_finite);
  return !value.is_number_float() || std::isfinite(value.get<double>());
}

/// JSON has no word for infinity or NaN, and an answer has no use for them.
Json checked(Json result) {
  if (!is_finite(result)) throw InputError("the answer is too large or too small for a double");
  return result;
}

/// Of solids that overlap and are not both convex, whose depth lies between their deepest parts' and this.
void add_way_out(const PairQuery& q, const narrowphase::Separation& s, Json& result) {
  const WayOut out = way_out(hull_if_equally_rounded(q.a), hull_if_equally_rounded(q.b), s.normal);
  const double length = std::max(out.length, -s.distance);
  result["lower"] = -length;
  result["way_out"] = json(Vec(length * out.along));
}

/// As `distance` says of the start.
narrowphase::FirstPartsContact first_contact(const PairQuery& q, const narrowphase::Separation& start) {
  if (start.distance <= 0.0) return {{narrowphase::Verdict::hit, 0.0, 0.0, 0}, 0, 0};
  return first_contact(parts_bvh(q.a.parts), q.a.motion, parts_bvh(q.b.parts), q.b.motion, *q.until);
}

/// Where the two parts touch, midway between what is nearest when the last moment without contact begins.
void add_impact(const PairQuery& q, const narrowphase::FirstPartsContact& found,
                const narrowphase::Separation& start, Json& result) {
  const double time = found.contact.t_lo;
  const narrowphase::Separation s = start.distance <= 0.0
                                        ? start
                                        : separation(q.a.parts[found.part_a], pose_at(q.a.motion, time),
                                                     q.b.parts[found.part_b], pose_at(q.b.motion, time));
  result["time_of_impact"] = found.contact.t_hi;
  result["impact_point"] = json(Vec(0.5 * (s.point_a + s.point_b)));
  result["impact_normal"] = json(s.normal);
}

/// Returns how many distances it took.
int add_motion(const PairQuery& q, const narrowphase::Separation& start, Json& result) {
  using narrowphase::Verdict;
  const narrowphase::FirstPartsContact found = first_contact(q, start);
  const Verdict verdict = found.contact.verdict;
  result["motion"] = word(verdict);
  if (verdict == Verdict::hit) add_impact(q, found, start, result);
  if (verdict != Verdict::free) result["time_bracket"] = {found.contact.t_lo, found.contact.t_hi};
  return found.contact.evaluations;
}

}  // namespace

Json answer(const PairQuery& q, bool work) {
  narrowphase::BvhCounters counters;
  const auto begin = std::chrono::steady_clock::now();
  const auto [s, lower] =
      rough_separation(parts_bvh(q.a.parts), q.a.pose, parts_bvh(q.b.parts), q.b.pose, q.epsilon, &counters);
  const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - begin;
  const bool convex = q.a.parts.size() == 1 && q.b.parts.size() == 1;
  Json result;
  result["distance"] = s.distance;
  result["lower"] = lower;
  result["upper"] = s.distance;
  result["collide"] = s.distance <= 0.0;
  result["normal"] = json(s.normal);
  result["point_a"] = json(s.point_a);
  result["point_b"] = json(s.point_b);
  if (convex && s.distance <= 0.0)
    result["manifold"] = to_json(manifold(q.a.parts[0], q.a.pose, q.b.parts[0], q.b.pose, 0.0));
  if (!convex && s.distance < 0.0) add_way_out(q, s, result);
  const int looks = q.until ? add_motion(q, s, result) : 0;
  if (!q.repairs.empty()) result["repairs"] = q.repairs;
  if (work) result["work"] = {{"nodes", counters.nodes}, {"leaves", counters.leaves}, {"us", spent.count()}};
  if (work && q.until) result["work"]["looks"] = looks;
  return checked(std::move(result));
}

}  // namespace throng::tools
