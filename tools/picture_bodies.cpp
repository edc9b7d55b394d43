// SPDX-License-Identifier: MIT
#include "tools/picture_bodies.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "tools/brush.h"
#include "tools/images.h"
#include "tools/pen.h"

namespace throng::tools {

namespace {

constexpr Colour kFixed{0.62, 0.63, 0.65}, kKinematic{0.45, 0.47, 0.50}, kWall{0.20, 0.21, 0.24};
constexpr double kSmallest = 1.5;       // pixels of radius below which a body has no outline
constexpr double kTurnShows = 4.0;      // pixels of radius from which a disc shows how it turned
constexpr std::size_t kMostSides = 12;  // of what the brush paints faster than cairo, but where it is large
constexpr double kStands = 0.05;        // m/s up to which an agent walks nowhere

/// What draws: most is painted straight into the pixels, the rest by cairo, each in its turn.
class Painter {
 public:
  explicit Painter(cairo_t* cairo) : cairo_(cairo) {}

  Brush& brush() { return brush_ ? *brush_ : brush_.emplace(cairo_); }
  cairo_t* cairo() {
    brush_.reset();
    return cairo_;
  }

 private:
  cairo_t* cairo_;
  std::optional<Brush> brush_;
};

bool is_outlined(double radius, double pixel) {
  return radius > kSmallest * pixel;
}
double outline_width(double radius, double pixel) {
  return std::min(1.6 * pixel, 0.24 * radius);
}

/// Holes run against the outline, which leaves them unfilled.
void add_shape(cairo_t* cairo, const Shape& shape) {
  if (!shape.outline.empty()) {
    add_ring(cairo, shape.outline);
    for (const std::vector<Vec>& hole : shape.holes) add_ring(cairo, hole);
  } else {
    for (const narrowphase::Convex& part : shape.parts) add_part(cairo, part);
  }
}

/// The outline first and twice as wide, then the filling over it: right for shapes of several parts, too.
void paint(cairo_t* cairo, const Shape& shape, double radius, const Colour& colour, double pixel) {
  add_shape(cairo, shape);
  if (is_outlined(radius, pixel)) {
    cairo_set_line_width(cairo, outline_width(radius, pixel));
    set_colour(cairo, shade(colour));
    cairo_stroke_preserve(cairo);
  }
  set_colour(cairo, colour);
  cairo_fill(cairo);
}

/// Of few sides, at each of which the brush looks for each pixel of the rim. The smallest ones, mere points,
/// cairo shows as dark as they are large.
bool is_for_brush(const Shape& shape, double radius, double pixel) {
  if (!is_outlined(radius, pixel) || shape.parts.size() != 1 || !shape.holes.empty()) return false;
  const std::size_t sides = shape.parts[0].vertices.size();
  return sides > 2 && sides <= kMostSides;
}

void paint(Brush& brush, const narrowphase::Convex& part, const narrowphase::Pose& pose, double radius,
           const Colour& colour, double pixel) {
  brush.rim(part, pose, 0.5 * outline_width(radius, pixel), shade(colour));
  brush.convex(part, pose, colour);
}

Colour colour_of(const Scene& scene, const Frame& frame, std::size_t row, double top) {
  if (scene.bodies.kind[row] == BodyKind::fixed) return kFixed;
  if (scene.bodies.kind[row] == BodyKind::kinematic) return kKinematic;
  if (frame.velocity.empty()) return palette(0.35);
  return palette(top > 0 ? frame.velocity[row].norm() / top : 0.0);
}

/// How a body has turned, where that was recorded (rad); agents, whose angle says nothing, face where they
/// walk.
std::optional<double> facing(const Scene& scene, const Frame& frame, std::size_t row) {
  if (scene.bodies.kind[row] == BodyKind::agent) {
    if (frame.velocity.empty() || !(frame.velocity[row].norm() > kStands)) return std::nullopt;
    return std::atan2(frame.velocity[row].y(), frame.velocity[row].x());
  }
  if (frame.angle.empty()) return std::nullopt;
  return std::fmod(frame.angle[row], 2 * std::numbers::pi);
}

/// A disc, and how it turned.
void draw_disc(Brush& brush, const Vec& at, double radius, const std::optional<double>& turned,
               const Colour& colour, double pixel) {
  const double half = 0.5 * outline_width(radius, pixel);
  if (is_outlined(radius, pixel)) brush.ring(at, radius - half, radius + half, shade(colour));
  brush.disc(at, radius, colour);
  if (turned && radius >= kTurnShows * pixel)
    brush.spoke(at, 0.92 * radius, *turned, std::min(1.6 * pixel, 0.16 * radius), shade(colour));
}

void draw_at(Painter& painter, const Scene& scene, const Frame& frame, std::size_t row, const Vec& at,
             const Colour& colour, double pixel) {
  const std::optional<double> turned = facing(scene, frame, row);
  const Shape& shape = scene.shapes[scene.bodies.shape[row]];
  const double radius = scene.bodies.radius[row];
  if (shape.kind == ShapeKind::disc) return draw_disc(painter.brush(), at, radius, turned, colour, pixel);
  if (is_for_brush(shape, radius, pixel))
    return paint(painter.brush(), shape.parts[0], narrowphase::pose(at, turned.value_or(0.0)), radius, colour,
                 pixel);
  cairo_t* const cairo = painter.cairo();
  cairo_save(cairo);
  cairo_translate(cairo, at.x(), at.y());
  cairo_rotate(cairo, turned.value_or(0.0));
  paint(cairo, shape, radius, colour, pixel);
  cairo_restore(cairo);
}

/// The body, and in a periodic domain its images that reach over a border.
void draw_body(Painter& painter, const Scene& scene, const Frame& frame, std::size_t row, double pixel,
               double top) {
  const Colour colour = colour_of(scene, frame, row, top);
  at_images(scene.domain, frame.position[row], scene.bodies.radius[row],
            [&](const Vec& at) { draw_at(painter, scene, frame, row, at, colour, pixel); });
}

}  // namespace

void draw_bodies(cairo_t* cairo, const Scene& scene, const Frame& frame, double pixel, double top) {
  cairo_save(cairo);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_tolerance(cairo, 0.1);
  if (scene.domain.kind == DomainKind::periodic) {
    const Vec size = scene.domain.max - scene.domain.min;
    cairo_rectangle(cairo, scene.domain.min.x(), scene.domain.min.y(), size.x(), size.y());
    cairo_clip(cairo);
  }
  Painter painter(cairo);
  for (std::size_t row = 0; row < frame.position.size(); ++row)
    if (frame.has(row)) draw_body(painter, scene, frame, row, pixel, top);
  cairo_restore(painter.cairo());
}

void draw_walls(cairo_t* cairo, const Scene& scene, double thickness) {
  set_colour(cairo, kWall);
  cairo_set_line_width(cairo, thickness);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  for (const Wall& wall : scene.walls) {
    cairo_new_sub_path(cairo);
    for (const Vec& point : wall.points) cairo_line_to(cairo, point.x(), point.y());
    if (wall.closed) cairo_close_path(cairo);
  }
  cairo_stroke(cairo);
}

}  // namespace throng::tools
