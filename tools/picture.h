// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <memory>
#include <span>
#include <string>

#include "sim/recording/recording.h"
#include "tools/view.h"

namespace throng::tools {

/// Sizes in pixels: the scene in the middle, a line of text above, the legend below.
struct Page {
  Page(const Extent& shown, int width);
  double unit;  ///< the size of the text
  double border, top, bottom, scale;
  int width, height;  ///< both even, as films need
};

/// A canvas on which frames of one scene are drawn: bodies coloured by speed, walls, the domain, a scale bar,
/// name, time and the scale of colours. Where no velocity was recorded, all moving bodies have one colour,
/// and the legend says so.
class Picture {
 public:
  /// At most `width` pixels wide and high. Expects `scene` to outlive it. Throws InputError where there is no
  /// memory for it.
  Picture(const Scene& scene, const View& view, int width = 1600);

  int width() const { return page_.width; }
  int height() const { return page_.height; }

  /// Replaces what was drawn before. Expects positions. O(bodies + pixels).
  void draw(const Frame& frame);

  /// Rows from above, four bytes a pixel: blue, green, red and one that means nothing.
  std::span<const unsigned char> pixels();

  /// Throws InputError where `output` can't be written; no half file stays.
  void write_png(const std::string& output);

 private:
  const Scene& scene_;
  View view_;
  Page page_;
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
};

}  // namespace throng::tools
