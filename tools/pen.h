// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <string>
#include <vector>

#include "narrowphase/convex.h"
#include "tools/palette.h"

/// What pictures have in common: text, colours, shapes, the scale.
namespace throng::tools {

inline constexpr Colour kInk{0.16, 0.17, 0.20}, kFaint{0.45, 0.47, 0.50};

enum class Align { left, centre, right };

void set_colour(cairo_t* cairo, const Colour& colour, double opacity = 1.0);
void set_font(cairo_t* cairo, double size, bool bold);
double text_width(cairo_t* cairo, const std::string& text);
void write(cairo_t* cairo, const std::string& text, double x, double y, Align align = Align::left);

/// The text, cut so that it is at most so wide.
std::string fitting(cairo_t* cairo, std::string text, double width);

/// A number for people: four digits.
std::string number(double value);

/// A length for people: "20 cm".
std::string length_text(double metres);

/// The scale in metres, at most 22 % of the picture's `width`, its left end at x. `scale`: pixels a metre;
/// `unit`: the size of text.
void draw_scale_bar(cairo_t* cairo, double x, double y, double width, double scale, double unit);

/// Adds a convex part grown by its radius to the path: straight along the edges, round at the vertices.
void add_part(cairo_t* cairo, const narrowphase::Convex& part);

/// Adds a closed ring to the path.
void add_ring(cairo_t* cairo, const std::vector<narrowphase::Vec>& ring);

}  // namespace throng::tools
