// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "narrowphase/convex.h"

/// Where one shape stands in the frame of another. Poses are subtracted first: what follows works on lengths
/// of the shapes' own size, and a million metres from the origin cost no digit.
namespace throng::narrowphase {

inline double dot(const Vec& u, const Vec& v) {
  return u.x() * v.x() + u.y() * v.y();
}
inline double cross(const Vec& u, const Vec& v) {
  return u.x() * v.y() - u.y() * v.x();
}
/// From left to right, and upwards on one vertical: as if the plane leaned by an infinitesimal angle.
inline bool lies_before(const Vec& p, const Vec& q) {
  return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
}
inline std::size_t next(std::size_t i, std::size_t count) {
  return i + 1 == count ? 0 : i + 1;
}
inline std::size_t previous(std::size_t i, std::size_t count) {
  return i == 0 ? count - 1 : i - 1;
}

/// The pose of b in the frame of a.
inline Pose relative(const Pose& a, const Pose& b) {
  return {a.unrotate(b.position - a.position), a.cos * b.cos + a.sin * b.sin, a.cos * b.sin - a.sin * b.cos};
}

inline Pose inverse(const Pose& p) {
  return {-p.unrotate(p.position), p.cos, -p.sin};
}

/// A length and the unit vector that it belongs to.
struct Direction {
  double length;
  Vec unit;
};

/// Of `v`; `fallback` stands in for the direction of the zero vector. Holds from 1e-300 to 1e150 m.
inline Direction direction(const Vec& v, const Vec& fallback) {
  constexpr double kSquaresKeepTheirDigits = 0x1p-960;
  const double squared = dot(v, v);
  if (!(squared <= kSquaresKeepTheirDigits)) [[likely]] {  // nor with NaN, which would go on for ever
    const double length = std::sqrt(squared);
    return {length, {v.x() / length, v.y() / length}};
  }
  if (v.x() == 0.0 && v.y() == 0.0) return {0.0, fallback};
  const Direction scaled = direction(v * 0x1p600, fallback);
  return {scaled.length * 0x1p-600, scaled.unit};
}

/// Holds as `direction` does.
inline double length(const Vec& v) {
  return direction(v, {1.0, 0.0}).length;
}

}  // namespace throng::narrowphase
