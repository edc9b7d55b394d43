// SPDX-License-Identifier: MIT
#include "sim/crowd/slide.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/crossing.h"

namespace throng {

namespace {

using Segment = Barriers::Segment;

constexpr int kSlides = 3;
constexpr double kRadiusRounding = 0x1p-40;  // of a radius, and
constexpr double kAlong = 0x1p-49;           // of a movement: who comes nearer by less goes along
constexpr double kUlps = 0x1p-49;  // of a coordinate: so much nearer than touching is as good as touching

/// When and against what direction a moving disc first touches.
struct Hit {
  double time = 2.0;  ///< of the movement; above 1: not within it
  Vec normal{0.0, 0.0};
};

/// What was made to go along a barrier comes nearer by rounding, and would be stopped for it.
bool comes_nearer(double approach, double length2) {
  return approach < 0.0 && approach * approach > kAlong * kAlong * length2;
}

/// Of a point at `p` that moves by `d` against a disc round `centre`; only where it comes nearer.
void hit_disc(const Vec& centre, double radius, const Vec& p, const Vec& d, Hit& hit) {
  const Vec out = p - centre;
  const double approach = out.dot(d), outside = out.squaredNorm() - radius * radius;
  if (!comes_nearer(approach, d.squaredNorm() * out.squaredNorm())) return;
  double time = 0.0;
  if (outside > 0.0) {
    const double speed2 = d.squaredNorm(), discriminant = approach * approach - speed2 * outside;
    if (!(discriminant >= 0.0)) return;
    time = outside / (-approach + std::sqrt(discriminant));
  }
  if (!(time < hit.time)) return;
  const Vec normal = out + time * d;
  const double length = normal.norm();
  if (length > 0.0) hit = {time, normal / length};
}

/// Against the two long sides of a segment as thick as the disc.
void hit_side(const Segment& segment, double radius, const Vec& p, const Vec& d, Hit& hit) {
  const Vec along = segment.b - segment.a;
  const double length = along.norm();
  if (!(length > 0.0)) return;
  Vec normal(-along.y() / length, along.x() / length);
  double height = normal.dot(p - segment.a);
  if (height < 0.0) normal = -normal, height = -height;
  const double approach = normal.dot(d);
  if (!comes_nearer(approach, d.squaredNorm())) return;
  const double time = std::max(0.0, (height - radius) / -approach);
  if (!(time < hit.time)) return;
  const double at = along.dot(p + time * d - segment.a);
  if (at >= 0.0 && at <= length * length) hit = {time, normal};
}

Hit first_hit(const Barriers& barriers, const Vec& p, const Vec& d, double radius) {
  Hit hit;
  const Vec far(radius, radius);
  const Eigen::AlignedBox2d box(Vec(p.cwiseMin(Vec(p + d)) - far), Vec(p.cwiseMax(Vec(p + d)) + far));
  barriers.for_each_near(box, [&](const Segment& segment) {
    hit_disc(segment.a, radius, p, d, hit);
    hit_disc(segment.b, radius, p, d, hit);
    hit_side(segment, radius, p, d, hit);
  });
  return hit;
}

/// Whether the way is as good as promised, whatever was rounded.
bool is_sound(const Barriers& barriers, const Vec& from, const Vec& to, double radius) {
  bool sound = true;
  const double rounding = kRadiusRounding * radius + kUlps * to.cwiseAbs().maxCoeff();
  const Vec far(radius, radius);
  const Eigen::AlignedBox2d box(Vec(from.cwiseMin(to) - far), Vec(from.cwiseMax(to) + far));
  barriers.for_each_near(box, [&](const Segment& segment) {
    if (!sound) return;
    const double before = (nearest_on_segment(segment.a, segment.b, from) - from).norm();
    const double after = (nearest_on_segment(segment.a, segment.b, to) - to).norm();
    sound = after >= std::min(before, radius) - rounding &&
            !narrowphase::segments_meet(from, to, segment.a, segment.b);
  });
  return sound;
}

}  // namespace

Moved slide(const Barriers& barriers, const Vec& from, const Vec& by, double radius) {
  Moved moved{from, false};
  Vec left = by;
  for (int i = 0; i < kSlides && left != Vec(0.0, 0.0); ++i) {
    const Hit hit = first_hit(barriers, moved.to, left, radius);
    const Vec step = std::min(hit.time, 1.0) * left, to = moved.to + step;
    if (step != Vec(0.0, 0.0) && !is_sound(barriers, moved.to, to, radius)) return {moved.to, true};
    moved.to = to;
    if (hit.time > 1.0) return moved;
    moved.corrected = true;
    left = (1.0 - hit.time) * left;
    left -= left.dot(hit.normal) * hit.normal;
  }
  return moved;
}

}  // namespace throng
