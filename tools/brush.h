// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <cstdint>
#include <vector>

#include "narrowphase/convex.h"
#include "sim/scene.h"
#include "tools/palette.h"

namespace throng::tools {

/// Paints discs and convex polygons straight into the pixels of a picture, small ones several times as fast
/// as cairo, and looks like it: a pixel at the rim is covered as far as the rim is from its centre, and the
/// whole has about the area of what it shows.
///
/// Nothing else may draw on the surface while this lives.
class Brush {
 public:
  /// Expects an image of four bytes a pixel, its context in metres, as wide as high, with y up, and clipped
  /// to a rectangle. Paints whole pixels of that.
  explicit Brush(cairo_t* cairo);
  ~Brush();
  Brush(const Brush&) = delete;
  Brush& operator=(const Brush&) = delete;

  /// All in metres. What would not be finite in pixels isn't painted.
  void disc(const Vec& at, double radius, const Colour& colour);
  void ring(const Vec& at, double inner, double outer, const Colour& colour);

  /// A line from `at`, `length` far in the direction `angle` (rad), of that width.
  void spoke(const Vec& at, double length, double angle, double width, const Colour& colour);

  /// All within the part, or its rim: from `half` inside of it to as far outside. Expects three vertices or
  /// more.
  void convex(const narrowphase::Convex& part, const narrowphase::Pose& pose, const Colour& colour);
  void rim(const narrowphase::Convex& part, const narrowphase::Pose& pose, double half, const Colour& colour);

 private:
  /// How much of a pixel is covered whose centre is so far (pixels) from that of the disc.
  struct Cover {
    explicit Cover(double radius);
    double at(double distance) const;
    double reach, most;
  };
  /// A side of a polygon, in pixels with y down, from where its body is.
  struct Side {
    Vec normal, start, along;  ///< unit but for the start
    double offset, length;     ///< of the line along the normal
    double corner = 0.0;       ///< of what this side and the one before cut off, times each other, both do

    double outside(double dx, double dy) const { return normal.x() * dx + normal.y() * dy - offset; }
    double square_from(double dx, double dy) const;
  };
  struct Stretch {
    double from, to;
  };
  static constexpr Stretch kNowhere{1.0, -1.0};
  /// Of a row of pixels: where something is painted, and where in that all of them are alike.
  struct Across {
    Stretch touched, alike;
  };
  void add_sides(const narrowphase::Convex& part, const narrowphase::Pose& pose);
  template <class Share>
  void paint_within(const Vec& centre, double radius, double inside, const Colour& colour, Share share);
  Stretch stretch(double dy, double reach) const;
  double share(double dx, double dy, double radius) const;
  template <class Look, class Share>
  void paint(const Vec& centre, double up, double down, const Colour& colour, Look across, Share share);
  template <class Share>
  void paint_round(const Vec& centre, double reach, double core, const Colour& colour, Share share);
  std::uint32_t* row(int y) const;
  Vec pixels(const Vec& at) const;

  cairo_surface_t* surface_;
  cairo_matrix_t to_pixels_;
  unsigned char* data_;
  int stride_, left_, top_, right_, bottom_;  // bytes; pixels that may be painted
  std::vector<Side> sides_;                   // of the polygon that is being painted
};

}  // namespace throng::tools
