// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "narrowphase/convex.h"

/// The bounding volumes of a hierarchy, in the plane and in space: ball (disc), axis-parallel box, oriented
/// box, oriented box with a ball. Each kind answers the same questions about two of itself, one placed in the
/// frame of the other.
namespace throng::narrowphase {

template <int kDim>
using Point = Eigen::Matrix<double, kDim, 1>;
template <int kDim>
using Rotation = Eigen::Matrix<double, kDim, kDim>;

template <int kDim>
struct Ball {
  static constexpr int kDimension = kDim;
  Point<kDim> centre;
  double radius;
};

template <int kDim>
struct Box {
  static constexpr int kDimension = kDim;
  Point<kDim> centre, half;  ///< half: of each side
};

template <int kDim>
struct OrientedBox {
  static constexpr int kDimension = kDim;
  Point<kDim> centre, half;
  Rotation<kDim> axes;  ///< a column a side
};

/// An oriented box and a ball around its centre, which both hold the same: where the balls show enough, the
/// boxes aren't compared.
template <int kDim>
struct BoxAndBall : OrientedBox<kDim> {
  double radius;
};

/// Where hierarchy b stands in the frame of hierarchy a, and what rounding may do there.
template <int kDim>
struct Frame {
  Rotation<kDim> turn, turn_sizes;  ///< the rotation, and the absolute values of its entries, rounded up
  Point<kDim> shift;
  double slack;  ///< m, above all rounding errors of a bound, of a volume's fit, and of placing a leaf
};

/// `reach`: how far from their origins the coordinates of a and b go, summed.
template <int kDim>
Frame<kDim> frame(const Rotation<kDim>& turn, const Point<kDim>& shift, double reach) {
  constexpr double kRounding = 0x1p-47;
  return {turn, (turn.array().abs() + kRounding).matrix(), shift,
          kRounding * (shift.template lpNorm<1>() + reach)};
}

inline Frame<2> frame(const Pose& b_in_a, double reach) {
  Rotation<2> turn;
  turn << b_in_a.cos, -b_in_a.sin, b_in_a.sin, b_in_a.cos;
  return frame<2>(turn, b_in_a.position, reach);
}

/// Two boxes, each in its own axes: `turn` takes b's axes to a's, `offset` goes from a's centre to b's.
template <int kDim>
struct BoxPair {
  const Point<kDim>& half_a;
  const Point<kDim>& half_b;
  Rotation<kDim> turn, turn_sizes;
  Point<kDim> offset;

  Point<kDim> gaps_of_a() const { return offset.cwiseAbs() - half_a - turn_sizes * half_b; }
  Point<kDim> gaps_of_b() const {
    return (turn.transpose() * offset).cwiseAbs() - half_b - turn_sizes.transpose() * half_a;
  }
  /// The length of the gaps that are open, seen from a or from b, whichever is longer; where none is, the one
  /// that is nearest to it, below 0.
  double bound() const {
    const Point<kDim> of_a = gaps_of_a(), of_b = gaps_of_b();
    const double widest = std::max(of_a.maxCoeff(), of_b.maxCoeff());
    if (widest <= 0.0) return widest;
    return std::sqrt(std::max(of_a.cwiseMax(0.0).squaredNorm(), of_b.cwiseMax(0.0).squaredNorm()));
  }

  /// By the faces' axes, in space also by the nine that are across two edges. The axis of parallel edges is
  /// null and shows nothing: turn_sizes is rounded up.
  bool apart(double slack) const {
    if (gaps_of_a().maxCoeff() > slack || gaps_of_b().maxCoeff() > slack) return true;
    if constexpr (kDim == 3)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (gap_across(i, j) > slack) return true;
    return false;
  }

 private:
  /// Along a's axis i x b's axis j, shorter than 1: the gap only shrinks by it.
  double gap_across(int i, int j) const {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    const double of_a = half_a[i1] * turn_sizes(i2, j) + half_a[i2] * turn_sizes(i1, j);
    const double of_b = half_b[j1] * turn_sizes(i, j2) + half_b[j2] * turn_sizes(i, j1);
    return std::abs(offset[i2] * turn(i1, j) - offset[i1] * turn(i2, j)) - (of_a + of_b);
  }
};

template <int kDim>
BoxPair<kDim> box_pair(const Box<kDim>& a, const Box<kDim>& b, const Frame<kDim>& b_in_a) {
  return {a.half, b.half, b_in_a.turn, b_in_a.turn_sizes, b_in_a.turn * b.centre + b_in_a.shift - a.centre};
}

template <int kDim>
BoxPair<kDim> box_pair(const OrientedBox<kDim>& a, const OrientedBox<kDim>& b, const Frame<kDim>& b_in_a) {
  const Rotation<kDim> turn = a.axes.transpose() * (b_in_a.turn * b.axes);
  constexpr double kRounding = 0x1p-47;
  return {a.half, b.half, turn, (turn.array().abs() + kRounding).matrix(),
          a.axes.transpose() * (b_in_a.turn * b.centre + b_in_a.shift - a.centre)};
}

/// No more than the distance of what the two hold; below 0 the two volumes may overlap, and no convex thing
/// in one is deeper in one of the other than that. m.
template <int kDim>
double bound(const Ball<kDim>& a, const Ball<kDim>& b, const Frame<kDim>& b_in_a) {
  return (b_in_a.turn * b.centre + b_in_a.shift - a.centre).norm() - (a.radius + b.radius) - b_in_a.slack;
}
template <class Boxes, int kDim>
double bound(const Boxes& a, const Boxes& b, const Frame<kDim>& b_in_a) {
  return box_pair(a, b, b_in_a).bound() - b_in_a.slack;
}

/// The same for who asks only whether it reaches `enough`: then it may be any bound that does.
template <class Volume, int kDim>
double bound(const Volume& a, const Volume& b, const Frame<kDim>& b_in_a, double) {
  return bound(a, b, b_in_a);
}
template <int kDim>
double bound(const BoxAndBall<kDim>& a, const BoxAndBall<kDim>& b, const Frame<kDim>& b_in_a, double enough) {
  const double of_balls = (b_in_a.turn * b.centre + b_in_a.shift - a.centre).norm() - (a.radius + b.radius);
  return of_balls - b_in_a.slack >= enough ? of_balls - b_in_a.slack : bound(a, b, b_in_a);
}

/// Whether the two certainly share no point: the separating axes of the kind, 4 in the plane and 15 in space
/// (Gottschalk, Lin and Manocha 1996).
template <int kDim>
bool apart(const Ball<kDim>& a, const Ball<kDim>& b, const Frame<kDim>& b_in_a) {
  const double reach = a.radius + b.radius + b_in_a.slack;
  return (b_in_a.turn * b.centre + b_in_a.shift - a.centre).squaredNorm() > reach * reach;
}
template <class Boxes, int kDim>
bool apart(const Boxes& a, const Boxes& b, const Frame<kDim>& b_in_a) {
  return box_pair(a, b, b_in_a).apart(b_in_a.slack);
}

template <int kDim>
bool apart(const BoxAndBall<kDim>& a, const BoxAndBall<kDim>& b, const Frame<kDim>& b_in_a) {
  const double reach = a.radius + b.radius + b_in_a.slack;
  return (b_in_a.turn * b.centre + b_in_a.shift - a.centre).squaredNorm() > reach * reach ||
         box_pair(a, b, b_in_a).apart(b_in_a.slack);
}

/// The radius of a ball around the volume's centre that holds it. m.
template <int kDim>
double radius(const Ball<kDim>& volume) {
  return volume.radius;
}
template <class Boxes>
double radius(const Boxes& volume) {
  return volume.half.norm();
}
template <int kDim>
double radius(const BoxAndBall<kDim>& volume) {
  return volume.radius;
}

/// The axis-parallel box, in the frame of a, of a volume in the frame of b.
template <int kDim>
Box<kDim> bounds(const Ball<kDim>& volume, const Frame<kDim>& b_in_a) {
  return {b_in_a.turn * volume.centre + b_in_a.shift, Point<kDim>::Constant(volume.radius + b_in_a.slack)};
}
template <int kDim>
Box<kDim> bounds(const Box<kDim>& volume, const Frame<kDim>& b_in_a) {
  return {b_in_a.turn * volume.centre + b_in_a.shift,
          ((b_in_a.turn_sizes * volume.half).array() + b_in_a.slack).matrix()};
}
template <int kDim>
Box<kDim> bounds(const OrientedBox<kDim>& volume, const Frame<kDim>& b_in_a) {
  return {b_in_a.turn * volume.centre + b_in_a.shift,
          (((b_in_a.turn * volume.axes).cwiseAbs() * volume.half).array() + b_in_a.slack).matrix()};
}

/// The square of no more than the distance from a point of the same frame, 0 inside; up to the rounding that
/// `slack` of a frame covers. m².
template <int kDim>
double squared_bound(const Ball<kDim>& volume, const Point<kDim>& point) {
  const double beyond = std::max(0.0, (point - volume.centre).norm() - volume.radius);
  return beyond * beyond;
}
template <int kDim>
double squared_bound(const Box<kDim>& volume, const Point<kDim>& point) {
  return ((point - volume.centre).cwiseAbs() - volume.half).cwiseMax(0.0).squaredNorm();
}
template <int kDim>
double squared_bound(const OrientedBox<kDim>& volume, const Point<kDim>& point) {
  const Point<kDim> along = volume.axes.transpose() * (point - volume.centre);
  return (along.cwiseAbs() - volume.half).cwiseMax(0.0).squaredNorm();
}

}  // namespace throng::narrowphase
