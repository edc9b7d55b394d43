// SPDX-License-Identifier: MIT
// Discs and polygons against what cairo makes of the same arcs and lines, pixel by pixel.
#include "tools/brush.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace throng::tools {
namespace {

constexpr int kWide = 120, kHigh = 90;  // pixels
constexpr double kScale = 10.0;         // pixels a metre
constexpr Colour kBlue{0.1, 0.3, 0.8};

/// A white picture in metres with y up, its origin in the lower left.
struct Canvas {
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface{
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, kWide, kHigh), cairo_surface_destroy};
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo{cairo_create(surface.get()), cairo_destroy};

  Canvas() {
    cairo_set_source_rgb(cairo.get(), 1, 1, 1);
    cairo_paint(cairo.get());
    cairo_translate(cairo.get(), 0, kHigh);
    cairo_scale(cairo.get(), kScale, -kScale);
    cairo_set_source_rgb(cairo.get(), kBlue.red, kBlue.green, kBlue.blue);
    cairo_set_tolerance(cairo.get(), 0.01);
  }

  int red(int x, int y) const {
    const unsigned char* data = cairo_image_surface_get_data(surface.get());
    return data[y * cairo_image_surface_get_stride(surface.get()) + 4 * x + 2];
  }
};

/// Of red, 0 to 255: the mean over the pixels in which either has painted, and the most; and of all that is
/// painted, the share by which they differ.
struct Difference {
  double mean = 0.0, most = 0.0, area = 0.0;
};

Difference difference(const Canvas& a, const Canvas& b) {
  Difference found;
  double touched = 0.0, painted = 0.0;
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      const double d = a.red(x, y) - b.red(x, y);
      found.mean += std::abs(d), found.most = std::max(found.most, std::abs(d)), found.area += d;
      touched += a.red(x, y) < 255 || b.red(x, y) < 255;
      painted += 255 - b.red(x, y);
    }
  return {found.mean / std::max(1.0, touched), found.most, std::abs(found.area) / std::max(1.0, painted)};
}

/// `paint` and `pen` draw the same thing, of a random place (m) and size, two hundred times.
template <class Paint, class Pen>
Difference worst(double least, double most, Paint paint, Pen pen) {
  std::mt19937 random(11);
  const auto within = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  Difference worst;
  for (int i = 0; i < 200; ++i) {
    const Vec at(within(3.0, 9.0), within(3.0, 6.0));
    const double size = within(least, most), angle = within(-4.0, 4.0);
    Canvas painted, drawn;
    Brush(painted.cairo.get()).disc({-50.0, 1e9}, 1.0, kBlue);  // out of the picture
    {
      Brush tip(painted.cairo.get());
      paint(tip, at, size, angle);
    }
    pen(drawn.cairo.get(), at, size, angle);
    const Difference one = difference(painted, drawn);
    worst = {std::max(worst.mean, one.mean), std::max(worst.most, one.most), std::max(worst.area, one.area)};
  }
  return worst;
}

void fill(cairo_t* cairo, const Vec& at, double radius, double) {
  cairo_arc(cairo, at.x(), at.y(), radius, 0, 2 * std::numbers::pi);
  cairo_fill(cairo);
}

void paint_disc(Brush& brush, const Vec& at, double radius, double) {
  brush.disc(at, radius, kBlue);
}

TEST(Brush, FillsDiscsAsCairoDoes) {
  const Difference found = worst(0.2, 2.9, paint_disc, fill);
  EXPECT_LT(found.mean, 5.0);
  EXPECT_LT(found.most, 40.0);
  EXPECT_LT(found.area, 0.015);
}

TEST(Brush, FillsTheSmallestDiscsAsDarkAsTheyAreLarge) {
  const Difference found = worst(0.03, 0.2, paint_disc, fill);
  EXPECT_LT(found.area, 0.125);
  EXPECT_LT(found.most, 100.0);
}

TEST(Brush, DrawsRingsAsCairoDoes) {
  const Difference found = worst(
      0.4, 2.9,
      [](Brush& brush, const Vec& at, double radius, double) {
        brush.ring(at, radius - 0.06, radius + 0.06, kBlue);
      },
      [](cairo_t* cairo, const Vec& at, double radius, double) {
        cairo_set_line_width(cairo, 0.12);
        cairo_arc(cairo, at.x(), at.y(), radius, 0, 2 * std::numbers::pi);
        cairo_stroke(cairo);
      });
  EXPECT_LT(found.mean, 15.0);
  EXPECT_LT(found.area, 0.03);
}

TEST(Brush, DrawsLinesAsCairoDoes) {
  const Difference found = worst(
      0.4, 2.9,
      [](Brush& brush, const Vec& at, double length, double angle) {
        brush.spoke(at, length, angle, 0.14, kBlue);
      },
      [](cairo_t* cairo, const Vec& at, double length, double angle) {
        cairo_set_line_width(cairo, 0.14);
        cairo_move_to(cairo, at.x(), at.y());
        cairo_line_to(cairo, at.x() + length * std::cos(angle), at.y() + length * std::sin(angle));
        cairo_stroke(cairo);
      });
  EXPECT_LT(found.mean, 25.0);
  EXPECT_LT(found.area, 0.12);
}

/// About the origin, as far from it as `size` (m) at most.
narrowphase::Convex brick(double size) {
  return narrowphase::convex({{-size, -0.5 * size},
                              {0.4 * size, -0.6 * size},
                              {0.9 * size, 0.1 * size},
                              {0.5 * size, 0.7 * size},
                              {-0.8 * size, 0.5 * size}});
}
/// Thirty times as long as wide.
narrowphase::Convex sliver(double size) {
  return narrowphase::convex({{-size, -0.033 * size}, {size, -0.033 * size}, {-size, 0.033 * size}});
}

/// Filled, or a line of that width (m) round it.
void draw(cairo_t* cairo, const narrowphase::Convex& part, const Vec& at, double angle, double width) {
  cairo_translate(cairo, at.x(), at.y());
  cairo_rotate(cairo, angle);
  for (const Vec& vertex : part.vertices) cairo_line_to(cairo, vertex.x(), vertex.y());
  cairo_close_path(cairo);
  cairo_set_line_width(cairo, width);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  width > 0.0 ? cairo_stroke(cairo) : cairo_fill(cairo);
}

Difference worst_polygon(narrowphase::Convex (*part)(double), double least, double most, double width) {
  return worst(
      least, most,
      [&](Brush& brush, const Vec& at, double size, double angle) {
        const narrowphase::Pose pose = narrowphase::pose(at, angle);
        width > 0.0 ? brush.rim(part(size), pose, 0.5 * width, kBlue) : brush.convex(part(size), pose, kBlue);
      },
      [&](cairo_t* cairo, const Vec& at, double size, double angle) {
        draw(cairo, part(size), at, angle, width);
      });
}

TEST(Brush, FillsPolygonsAsCairoDoes) {
  const Difference found = worst_polygon(brick, 0.2, 2.9, 0.0);
  EXPECT_LT(found.mean, 6.0);
  EXPECT_LT(found.most, 60.0);
  EXPECT_LT(found.area, 0.05);
}

TEST(Brush, FillsWhatIsThinnerThanAPixelAsPaleAsCairoDoes) {
  const Difference found = worst_polygon(sliver, 1.0, 2.9, 0.0);
  EXPECT_LT(found.mean, 10.0);
  EXPECT_LT(found.area, 0.15);
}

TEST(Brush, GoesRoundCornersAsCairosRoundLinesDo) {
  for (const auto part : {brick, sliver}) {
    const Difference found = worst_polygon(part, 0.2, 2.9, 0.16);
    EXPECT_LT(found.mean, 8.0);
    EXPECT_LT(found.most, 60.0);
    EXPECT_LT(found.area, 0.07);
  }
}

/// Of a disc as large as the picture, whole pixels within the clip and none outside.
TEST(Brush, KeepsWithinTheClip) {
  Canvas canvas;
  cairo_rectangle(canvas.cairo.get(), 2.0, 1.0, 5.0, 4.0);
  cairo_clip(canvas.cairo.get());
  Brush(canvas.cairo.get()).disc({5.0, 4.0}, 1e4, kBlue);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x)
      ASSERT_EQ(canvas.red(x, y) < 255, x >= 20 && x < 70 && y >= kHigh - 50 && y < kHigh - 10)
          << x << " " << y;
}

// It happened: a file's disc of 1e308 m, as far away beside the picture, was written into memory before it.
TEST(Brush, PaintsNothingThatIsNotFiniteInPixels) {
  constexpr double kHuge = 1e308;
  for (const Vec& at : {Vec(kHuge, 4.0), Vec(-kHuge, 4.0), Vec(6.0, -kHuge), Vec(kHuge, kHuge)}) {
    const Canvas canvas;
    Brush brush(canvas.cairo.get());
    brush.disc(at, kHuge, kBlue);
    brush.ring(at, 0.9 * kHuge, kHuge, kBlue);
    brush.spoke(at, kHuge, 0.7, 0.1 * kHuge, kBlue);
    brush.convex(brick(kHuge), narrowphase::pose(at, 0.2), kBlue);
    brush.rim(brick(kHuge), narrowphase::pose(at, 0.2), 0.1 * kHuge, kBlue);
    EXPECT_EQ(difference(canvas, Canvas()).mean, 0.0);
  }
}

/// Processor time, s, for some polygons of that size (pixels), their rims and what is within: of three times
/// the least.
double time_of_polygons(double size) {
  constexpr int kSide = 1000;
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, kSide, kSide), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo(cairo_create(surface.get()), cairo_destroy);
  cairo_translate(cairo.get(), 0, kSide);
  cairo_scale(cairo.get(), 1.0, -1.0);
  Brush brush(cairo.get());
  std::clock_t least = std::numeric_limits<std::clock_t>::max();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    for (int k = 0; k < 20; ++k) {
      const narrowphase::Pose pose = narrowphase::pose({500.0, 500.0 + 0.1 * k}, 0.3 * k);
      brush.rim(brick(size), pose, 0.8, kBlue);
      brush.convex(brick(size), pose, kBlue);
    }
    least = std::min(least, std::clock() - start);
  }
  return static_cast<double>(least);
}

// It happened: where one polygon filled a picture, that took thirty times as long as by cairo.
TEST(Brush, TakesTimeForTheRimsOfPolygonsNotForWhatIsWithin) {
  EXPECT_LT(time_of_polygons(400.0), 40.0 * time_of_polygons(40.0)) << "a hundred times as many pixels";
}

}  // namespace
}  // namespace throng::tools
