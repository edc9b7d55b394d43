// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <array>
#include <string>

namespace throng {

/// A picture as a user gets it, by its pixels.
class Picture {
 public:
  explicit Picture(const std::string& file) : surface_(cairo_image_surface_create_from_png(file.c_str())) {}
  ~Picture() { cairo_surface_destroy(surface_); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  int width() const { return cairo_image_surface_get_width(surface_); }
  int height() const { return cairo_image_surface_get_height(surface_); }
  /// Red, green and blue.
  std::array<int, 3> at(int x, int y) const {
    const unsigned char* pixel =
        cairo_image_surface_get_data(surface_) + y * cairo_image_surface_get_stride(surface_) + 4 * x;
    return {pixel[2], pixel[1], pixel[0]};
  }

 private:
  cairo_surface_t* surface_;
};

}  // namespace throng
