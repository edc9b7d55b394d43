// SPDX-License-Identifier: MIT
#include "tools/brush.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// The pixel from `least` to `most` that is nearest to this place.
int pixel_at(double place, int least, int most) {
  return place > least ? static_cast<int>(std::min<double>(place, std::max(least, most))) : least;
}

}  // namespace

/// A rim that fades over one pixel adds 1/12 to the square of the radius, if that is to keep its area. The
/// smallest discs are points that fade.
Brush::Cover::Cover(double radius) {
  const double square = radius * radius;
  most = std::min(1.0, 3.0 * square);
  reach = square > 1.0 / 3.0 ? std::sqrt(square - 1.0 / 12.0) + 0.5 : 1.0;
}

double Brush::Cover::at(double distance) const {
  return most * std::clamp(reach - distance, 0.0, 1.0);
}

Brush::Brush(cairo_t* cairo)
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

Brush::~Brush() {
  cairo_surface_mark_dirty(surface_);
}

Vec Brush::pixels(const Vec& at) const {
  double x = at.x(), y = at.y();
  cairo_matrix_transform_point(&to_pixels_, &x, &y);
  return {x, y};
}

std::uint32_t* Brush::row(int y) const {
  return reinterpret_cast<std::uint32_t*>(data_ + static_cast<std::ptrdiff_t>(y) * stride_);
}

/// Asks of each pixel, of rows from `up` above the centre to `down` below it and there of those that `across`
/// says are touched, which share is painted, by where its centre is from there; of those alike only once.
template <class Look, class Share>
void Brush::paint(const Vec& centre, double up, double down, const Colour& colour, Look across, Share share) {
  const std::uint32_t full = pixel_of(colour);
  const double x = centre.x(), y = centre.y();
  if (!std::isfinite(x + y + up + down)) return;
  const auto part = [&](int k, double dy) {
    return static_cast<std::uint32_t>(256.0 * share(k + 0.5 - x, dy) + 0.5);
  };
  const int end = pixel_at(std::ceil(y + down), top_, bottom_);
  for (int i = pixel_at(std::floor(y - up), top_, bottom_); i < end; ++i) {
    const double dy = i + 0.5 - y;
    const Across its = across(dy);
    std::uint32_t* const pixel = row(i);
    const auto paint_each = [&](int from, int to) {
      for (int k = from; k < to; ++k) pixel[k] = blended(pixel[k], full, part(k, dy));
    };
    const int first = pixel_at(std::floor(x + its.touched.from), left_, right_),
              stop = pixel_at(std::ceil(x + its.touched.to), first, right_),
              alike = pixel_at(std::ceil(x + its.alike.from - 0.5), first, stop),
              other = pixel_at(std::floor(x + its.alike.to + 0.5), alike, stop);
    paint_each(first, alike);
    if (alike < other) {
      if (const std::uint32_t all = part(alike, dy); all == 256)
        std::fill(pixel + alike, pixel + other, full);
      else if (all > 0)
        paint_each(alike, other);
    }
    paint_each(other, stop);
  }
}

/// All within `reach` (pixels), alike up to `core`.
template <class Share>
void Brush::paint_round(const Vec& centre, double reach, double core, const Colour& colour, Share share) {
  const auto half = [](double radius, double dy) { return std::sqrt(radius * radius - dy * dy); };
  const auto across = [&](double dy) {
    const double touched = std::abs(dy) < reach ? half(reach, dy) : 0.0;
    if (!(std::abs(dy) < core)) return Across{{-touched, touched}, kNowhere};
    return Across{{-touched, touched}, {-half(core, dy), half(core, dy)}};
  };
  paint(centre, reach, reach, colour, across, share);
}

void Brush::disc(const Vec& at, double radius, const Colour& colour) {
  ring(at, 0.0, radius, colour);
}

void Brush::ring(const Vec& at, double inner, double outer, const Colour& colour) {
  const Cover in(inner * to_pixels_.xx), out(outer * to_pixels_.xx);
  const double core = (in.most > 0.0 ? in : out).reach - 1.0;
  paint_round(pixels(at), out.reach, core, colour, [&](double dx, double dy) {
    const double distance = std::sqrt(dx * dx + dy * dy);
    return out.at(distance) - in.at(distance);
  });
}

void Brush::spoke(const Vec& at, double length, double angle, double width, const Colour& colour) {
  const auto [sin, cos] = narrowphase::sin_cos(angle);
  const double far = length * to_pixels_.xx, half = 0.5 * width * to_pixels_.xx;
  paint_round(pixels(at) + 0.5 * far * Vec(cos, -sin), 0.5 * far + half + 1.0, 0.0, colour,
              [&, sin = sin, cos = cos](double dx, double dy) {
                return overlap(dx * sin + dy * cos, -half, half) *
                       overlap(dx * cos - dy * sin, -0.5 * far, 0.5 * far);
              });
}

double Brush::Side::square_from(double dx, double dy) const {
  const Vec to = Vec(dx, dy) - start;
  return (to - std::clamp(to.dot(along), 0.0, length) * along).squaredNorm();
}

void Brush::add_sides(const narrowphase::Convex& part, const narrowphase::Pose& pose) {
  const auto seen = [&](const Vec& v) {
    const Vec turned = pose.rotate(v);
    return Vec(turned.x(), -turned.y());
  };
  sides_.clear();
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const Vec start = to_pixels_.xx * seen(part.vertices[i]),
              end = to_pixels_.xx * seen(part.vertices[(i + 1) % part.vertices.size()]),
              normal = seen(part.normals[i]);
    const double length = (end - start).norm();
    sides_.push_back({normal, start, (end - start) / length, normal.dot(start), length});
  }
  const Side* before = &sides_.back();
  for (Side& side : sides_) {
    side.corner = std::min(1.0, 1.0 + before->normal.dot(side.normal));
    before = &side;
  }
}

/// Where a row that is `dy` below the body is within `reach` of all sides' lines.
Brush::Stretch Brush::stretch(double dy, double reach) const {
  Stretch found{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Side& side : sides_) {
    const double room = reach - side.outside(0.0, dy), nx = side.normal.x();
    if (nx > 0.0)
      found.to = std::min(found.to, room / nx);
    else if (nx < 0.0)
      found.from = std::max(found.from, room / nx);
    else if (room < 0.0)
      return kNowhere;
  }
  return found;
}

/// Inside, what the sides' lines cut off a pixel, less what two neighbours both do; outside, as far as the
/// rim goes round.
double Brush::share(double dx, double dy, double radius) const {
  const auto cut_by = [&](double outside) { return std::clamp(outside - radius + 0.5, 0.0, 1.0); };
  double cut = 0.0, nearest = std::numeric_limits<double>::infinity();
  double before = cut_by(sides_.back().outside(dx, dy));
  for (const Side& side : sides_) {
    const double outside = side.outside(dx, dy), own = cut_by(outside);
    if (own >= 1.0) return 0.0;
    cut += own - side.corner * before * own;
    before = own;
    if (radius > 0.0 && outside > 0.0) nearest = std::min(nearest, side.square_from(dx, dy));
  }
  if (nearest < std::numeric_limits<double>::infinity())
    return std::clamp(radius + 0.5 - std::sqrt(nearest), 0.0, 1.0);
  return std::max(0.0, 1.0 - cut);
}

/// What is within `radius` (pixels) of the sides, or of what they enclose; alike where it is at least
/// `inside` them.
template <class Share>
void Brush::paint_within(const Vec& centre, double radius, double inside, const Colour& colour, Share share) {
  const double reach = radius + 0.5;
  Eigen::AlignedBox2d box;
  for (const Side& side : sides_) box.extend(side.start);
  const auto across = [&](double dy) {
    const Stretch touched = stretch(dy, reach);
    return Across{
        {std::max(touched.from, box.min().x() - reach), std::min(touched.to, box.max().x() + reach)},
        stretch(dy, -inside)};
  };
  paint(centre, reach - box.min().y(), reach + box.max().y(), colour, across, share);
}

void Brush::convex(const narrowphase::Convex& part, const narrowphase::Pose& pose, const Colour& colour) {
  add_sides(part, pose);
  const double radius = part.radius * to_pixels_.xx;
  paint_within(pixels(pose.position), radius, std::max(0.0, 0.5 - radius), colour,
               [&](double dx, double dy) { return share(dx, dy, radius); });
}

void Brush::rim(const narrowphase::Convex& part, const narrowphase::Pose& pose, double half,
                const Colour& colour) {
  add_sides(part, pose);
  const double inner = (part.radius - half) * to_pixels_.xx, outer = (part.radius + half) * to_pixels_.xx;
  paint_within(pixels(pose.position), outer, std::max(0.0, 0.5 - inner), colour, [&](double dx, double dy) {
    return std::max(0.0, share(dx, dy, outer) - share(dx, dy, inner));
  });
}

}  // namespace throng::tools
