// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <cstdint>

#include "sim/scene.h"
#include "tools/palette.h"

namespace throng::tools {

/// Paints discs straight into the pixels of a picture, six times as fast as cairo and more, and looks like
/// it: a pixel at the rim is covered as far as the rim is from its centre, and the whole has the disc's area.
///
/// Nothing else may draw on the surface while this lives.
class DiscBrush {
 public:
  /// Expects an image of four bytes a pixel, its context in metres, as wide as high, with y up, and clipped
  /// to a rectangle. Paints whole pixels of that.
  explicit DiscBrush(cairo_t* cairo);
  ~DiscBrush();
  DiscBrush(const DiscBrush&) = delete;
  DiscBrush& operator=(const DiscBrush&) = delete;

  /// All in metres. O(pixels), fewer where they are whole.
  void disc(const Vec& at, double radius, const Colour& colour);
  void ring(const Vec& at, double inner, double outer, const Colour& colour);

  /// A line from `at`, `length` far in the direction `angle` (rad), of that width.
  void spoke(const Vec& at, double length, double angle, double width, const Colour& colour);

 private:
  /// How much of a pixel is covered whose centre is so far (pixels) from that of the disc.
  struct Cover {
    explicit Cover(double radius);
    double at(double distance) const;
    double reach, most;
  };
  template <class Share>
  void paint(double x, double y, double reach, const Colour& colour, Share share);
  std::uint32_t* row(int y) const;
  Vec pixels(const Vec& at) const;

  cairo_surface_t* surface_;
  cairo_matrix_t to_pixels_;
  unsigned char* data_;
  int stride_, left_, top_, right_, bottom_;  // bytes; pixels that may be painted
};

}  // namespace throng::tools
