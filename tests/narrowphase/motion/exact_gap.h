// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <vector>

#include "narrowphase/motion/motion.h"

/// Two moving shapes in 50 digits: the reference for times of contact.
namespace throng::narrowphase {

using Digits =
    boost::multiprecision::number<boost::multiprecision::cpp_dec_float<50>, boost::multiprecision::et_off>;
using ExactVec = std::array<Digits, 2>;

inline ExactVec minus(const ExactVec& p, const ExactVec& q) {
  return {p[0] - q[0], p[1] - q[1]};
}
inline Digits exact_dot(const ExactVec& u, const ExactVec& v) {
  return u[0] * v[0] + u[1] * v[1];
}
inline Digits exact_cross(const ExactVec& u, const ExactVec& v) {
  return u[0] * v[1] - u[1] * v[0];
}

inline std::vector<ExactVec> exact_vertices(const Convex& shape, const Motion& motion, double time) {
  const Digits angle = Digits(motion.angle) + Digits(time) * Digits(motion.spin), c = cos(angle),
               s = sin(angle);
  std::vector<ExactVec> placed;
  for (const Vec& v : shape.vertices)
    placed.push_back({c * v.x() - s * v.y() + motion.position.x() + Digits(time) * motion.velocity.x(),
                      s * v.x() + c * v.y() + motion.position.y() + Digits(time) * motion.velocity.y()});
  return placed;
}

inline Digits squared_to_segment(const ExactVec& x, const ExactVec& p, const ExactVec& q) {
  const ExactVec along = minus(q, p), from = minus(x, p);
  const Digits length = exact_dot(along, along), s = exact_dot(from, along);
  if (length == 0 || s <= 0) return exact_dot(from, from);
  if (s >= length) return exact_dot(minus(x, q), minus(x, q));
  const Digits height = exact_cross(along, from);
  return height * height / length;
}

/// Whether an edge of p keeps all of q outside.
inline bool parts(const std::vector<ExactVec>& p, const std::vector<ExactVec>& q) {
  for (std::size_t i = 0; i < p.size() && p.size() > 1; ++i) {
    bool outside = true;
    for (const ExactVec& v : q)
      outside = outside && exact_cross(minus(p[(i + 1) % p.size()], p[i]), minus(v, p[i])) < 0;
    if (outside) return true;
  }
  return false;
}

/// The distance of two solids less their radii, where their cores are apart; below 0 else.
inline Digits exact_gap(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                        double time) {
  const std::vector<ExactVec> p = exact_vertices(a, motion_a, time), q = exact_vertices(b, motion_b, time);
  const bool discs = p.size() == 1 && q.size() == 1;
  const bool one_stroke = p.size() + q.size() == 3;  // a disc and a segment, whose line both may be on
  if (!discs && !one_stroke && !parts(p, q) && !parts(q, p)) return -1;
  Digits least = exact_dot(minus(p[0], q[0]), minus(p[0], q[0]));
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j)
      least = std::min(least, std::min(squared_to_segment(p[i], q[j], q[(j + 1) % q.size()]),
                                       squared_to_segment(q[j], p[i], p[(i + 1) % p.size()])));
  return sqrt(least) - Digits(a.radius) - Digits(b.radius);
}

}  // namespace throng::narrowphase
