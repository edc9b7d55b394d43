// SPDX-License-Identifier: MIT
#include "narrowphase/disc_flight.h"

#include <algorithm>

namespace throng::narrowphase {

namespace {

/// Where a shape's core is nearest to a point.
struct NearestOnCore {
  double distance;  // m, below 0 inside of a polygon
  Vec towards;      // unit
};

bool is_inside(const Vec& point, const Convex& shape) {
  if (shape.vertices.size() < 3) return false;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i)
    if (dot(shape.normals[i], point - shape.vertices[i]) >= 0.0) return false;
  return true;
}

NearestOnCore nearest_of_point(const Vec& point, const Vec& other, const Vec& fallback) {
  const Direction way = direction(other - point, fallback);
  return {way.length, way.unit};
}

/// Over the edge along its normal, to the last bit: what slides along it doesn't near it.
NearestOnCore nearest_of_edge(const Vec& point, const Convex& shape, std::size_t i) {
  const Vec &tail = shape.vertices[i], &head = shape.vertices[next(i, shape.vertices.size())];
  const Vec& normal = shape.normals[i];
  if (!(dot(point - tail, head - tail) > 0.0)) return nearest_of_point(point, tail, -normal);
  if (!(dot(point - head, tail - head) > 0.0)) return nearest_of_point(point, head, -normal);
  const double height = dot(normal, point - tail);
  return {std::abs(height), height >= 0.0 ? Vec(-normal) : normal};
}

NearestOnCore nearest_on_core(const Vec& point, const Convex& shape) {
  if (shape.vertices.size() == 1) return nearest_of_point(point, shape.vertices[0], {1.0, 0.0});
  NearestOnCore best{kNever, {0.0, 0.0}};
  for (std::size_t i = 0; i < shape.vertices.size(); ++i)
    if (const NearestOnCore one = nearest_of_edge(point, shape, i); one.distance < best.distance) best = one;
  if (is_inside(point, shape)) return {-best.distance, -best.towards};
  return best;
}

/// When the centre crosses an edge's line, moved out by `grown`, in front of the edge itself.
double time_to_edge(const Vec& centre, const Vec& velocity, const Convex& shape, std::size_t i,
                    double grown) {
  const Vec &tail = shape.vertices[i], &head = shape.vertices[next(i, shape.vertices.size())];
  const double height = dot(shape.normals[i], centre - tail) - grown;
  const double nearing = -dot(shape.normals[i], velocity);
  if (!(height >= 0.0 && nearing > 0.0)) return kNever;
  const double time = height / nearing;
  const double along = dot(centre + time * velocity - tail, head - tail);
  return along >= 0.0 && along <= dot(head - tail, head - tail) ? time : kNever;
}

}  // namespace

DiscFlight disc_flight(const Vec& centre, double radius, const Vec& velocity, const HalfPlane& free) {
  const double gap = dot(free.normal, centre - free.point) - radius;
  const double nearing = -dot(free.normal, velocity);
  return {gap, nearing > 0.0 ? std::max(gap, 0.0) / nearing : kNever};
}

DiscFlight disc_flight(const Vec& centre, double radius, const Vec& velocity, const Convex& shape) {
  const double grown = radius + shape.radius;
  const NearestOnCore at = nearest_on_core(centre, shape);
  const double gap = at.distance - grown;
  if (gap <= 0.0) return {gap, dot(velocity, at.towards) > 0.0 ? 0.0 : kNever};
  double time = kNever;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    time = std::min(time, disc_flight(shape.vertices[i] - centre, -velocity, grown, kNever).time);
    if (shape.vertices.size() > 1) time = std::min(time, time_to_edge(centre, velocity, shape, i, grown));
  }
  return {gap, time};
}

Vec towards(const Vec& point, const Convex& shape) {
  return nearest_on_core(point, shape).towards;
}

}  // namespace throng::narrowphase
