// SPDX-License-Identifier: MIT
#include "tools/disc_brush.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/trigonometry.h"

namespace throng::tools {

namespace {

std::uint32_t byte_of(double x) {
  return static_cast<std::uint32_t>(255.0 * x + 0.5);
}

std::uint32_t pixel_of(const Colour& c) {
  return 0xff000000u | byte_of(c.red) << 16 | byte_of(c.green) << 8 | byte_of(c.blue);
}

/// `share` of 256 of `over`, the rest of what is there: two colours of a pixel at a time.
std::uint32_t blended(std::uint32_t under, std::uint32_t over, std::uint32_t share) {
  const auto two = [&](int shift) {
    const std::uint32_t a = under >> shift & 0xff00ffu, b = over >> shift & 0xff00ffu;
    return ((a * (256 - share) + b * share + 0x800080u) >> 8 & 0xff00ffu) << shift;
  };
  return two(0) | two(8);
}

/// How much of a pixel about x is between `from` and `to`.
double overlap(double x, double from, double to) {
  return std::clamp(std::min(x + 0.5, to) - std::max(x - 0.5, from), 0.0, 1.0);
}

}  // namespace

/// A rim that fades over one pixel adds 1/12 to the square of the radius, if that is to keep its area. The
/// smallest discs are points that fade.
DiscBrush::Cover::Cover(double radius) {
  const double square = radius * radius;
  most = std::min(1.0, 3.0 * square);
  reach = square > 1.0 / 3.0 ? std::sqrt(square - 1.0 / 12.0) + 0.5 : 1.0;
}

double DiscBrush::Cover::at(double distance) const {
  return most * std::clamp(reach - distance, 0.0, 1.0);
}

DiscBrush::DiscBrush(cairo_t* cairo)
    : surface_(cairo_get_target(cairo)),
      data_((cairo_surface_flush(surface_), cairo_image_surface_get_data(surface_))),
      stride_(cairo_image_surface_get_stride(surface_)) {
  cairo_get_matrix(cairo, &to_pixels_);
  double left, top, right, bottom;  // top: of the scene
  cairo_clip_extents(cairo, &left, &bottom, &right, &top);
  const Vec first = pixels({left, top}), last = pixels({right, bottom});
  left_ = std::max(0, static_cast<int>(std::lround(first.x())));
  top_ = std::max(0, static_cast<int>(std::lround(first.y())));
  right_ = std::min(cairo_image_surface_get_width(surface_), static_cast<int>(std::lround(last.x())));
  bottom_ = std::min(cairo_image_surface_get_height(surface_), static_cast<int>(std::lround(last.y())));
}

DiscBrush::~DiscBrush() {
  cairo_surface_mark_dirty(surface_);
}

Vec DiscBrush::pixels(const Vec& at) const {
  double x = at.x(), y = at.y();
  cairo_matrix_transform_point(&to_pixels_, &x, &y);
  return {x, y};
}

std::uint32_t* DiscBrush::row(int y) const {
  return reinterpret_cast<std::uint32_t*>(data_ + static_cast<std::ptrdiff_t>(y) * stride_);
}

/// Asks of each pixel that may be within `reach` of (x, y) which share is painted, by where its centre is
/// from there.
template <class Share>
void DiscBrush::paint(double x, double y, double reach, const Colour& colour, Share share) {
  const std::uint32_t full = pixel_of(colour);
  const auto place = [](double at, int least, int most) {
    return static_cast<int>(std::clamp<double>(at, least, std::max(least, most)));
  };
  const int end = place(std::ceil(y + reach), top_, bottom_);
  for (int i = place(std::floor(y - reach), top_, bottom_); i < end; ++i) {
    const double dy = i + 0.5 - y, half = std::sqrt(std::max(0.0, reach * reach - dy * dy));
    std::uint32_t* const pixel = row(i);
    const int stop = place(std::ceil(x + half), left_, right_);
    for (int k = place(std::floor(x - half), left_, right_); k < stop; ++k) {
      const auto part = static_cast<std::uint32_t>(256.0 * share(k + 0.5 - x, dy) + 0.5);
      pixel[k] = part == 256 ? full : blended(pixel[k], full, part);
    }
  }
}

void DiscBrush::disc(const Vec& at, double radius, const Colour& colour) {
  ring(at, 0.0, radius, colour);
}

void DiscBrush::ring(const Vec& at, double inner, double outer, const Colour& colour) {
  const Cover in(inner * to_pixels_.xx), out(outer * to_pixels_.xx);
  const Vec centre = pixels(at);
  paint(centre.x(), centre.y(), out.reach, colour, [&](double dx, double dy) {
    const double distance = std::sqrt(dx * dx + dy * dy);
    return out.at(distance) - in.at(distance);
  });
}

void DiscBrush::spoke(const Vec& at, double length, double angle, double width, const Colour& colour) {
  const auto [sin, cos] = narrowphase::sin_cos(angle);
  const double far = length * to_pixels_.xx, half = 0.5 * width * to_pixels_.xx;
  const Vec centre = pixels(at);
  paint(centre.x() + 0.5 * far * cos, centre.y() - 0.5 * far * sin, 0.5 * far + half + 1.0, colour,
        [&, sin = sin, cos = cos](double dx, double dy) {
          return overlap(dx * sin + dy * cos, -half, half) *
                 overlap(dx * cos - dy * sin, -0.5 * far, 0.5 * far);
        });
}

}  // namespace throng::tools
