// SPDX-License-Identifier: MIT
#include "tools/pen.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace throng::tools {

using narrowphase::Convex;
using narrowphase::Vec;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

void set_colour(cairo_t* cairo, const Colour& c, double opacity) {
  cairo_set_source_rgba(cairo, c.red, c.green, c.blue, opacity);
}

double text_width(cairo_t* cairo, const std::string& text) {
  cairo_text_extents_t size;
  cairo_text_extents(cairo, text.c_str(), &size);
  return size.x_advance;
}

void write(cairo_t* cairo, const std::string& text, double x, double y, Align align) {
  const double shift = align == Align::left ? 0 : align == Align::centre ? 0.5 : 1;
  cairo_move_to(cairo, x - shift * text_width(cairo, text), y);
  cairo_show_text(cairo, text.c_str());
}

std::string fitting(cairo_t* cairo, std::string text, double width) {
  if (text_width(cairo, text) <= width) return text;
  while (!text.empty() && text_width(cairo, text + "…") > width) {
    text.pop_back();
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
    if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xC0) text.pop_back();
  }
  return text + "…";
}

void set_font(cairo_t* cairo, double size, bool bold) {
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
}

std::string length_text(double metres) {
  if (metres >= 1000) return number(metres / 1000) + " km";
  if (metres >= 1) return number(metres) + " m";
  if (metres >= 0.01) return number(metres * 100) + " cm";
  return number(metres * 1000) + " mm";
}

void draw_scale_bar(cairo_t* cairo, double x, double y, double width, double scale, double unit) {
  const double metres = round_below(0.22 * width / scale), bar = metres * scale, tick = 0.3 * unit;
  set_colour(cairo, kInk);
  cairo_set_line_width(cairo, 0.12 * unit);
  cairo_move_to(cairo, x, y - tick);
  cairo_line_to(cairo, x, y + tick);
  cairo_move_to(cairo, x, y);
  cairo_line_to(cairo, x + bar, y);
  cairo_move_to(cairo, x + bar, y - tick);
  cairo_line_to(cairo, x + bar, y + tick);
  cairo_stroke(cairo);
  set_font(cairo, unit, false);
  write(cairo, length_text(metres), x + bar / 2, y + 1.7 * unit, Align::centre);
}

void add_part(cairo_t* cairo, const Convex& part) {
  cairo_new_sub_path(cairo);
  const std::size_t n = part.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec& vertex = part.vertices[i];
    const Vec before = vertex - part.vertices[(i + n - 1) % n], after = part.vertices[(i + 1) % n] - vertex;
    if (part.radius <= 0) {
      cairo_line_to(cairo, vertex.x(), vertex.y());
    } else if (n == 1) {
      cairo_arc(cairo, vertex.x(), vertex.y(), part.radius, 0, 2 * std::numbers::pi);
    } else {
      const double quarter = std::numbers::pi / 2;
      cairo_arc(cairo, vertex.x(), vertex.y(), part.radius, std::atan2(before.y(), before.x()) - quarter,
                std::atan2(after.y(), after.x()) - quarter);
    }
  }
  cairo_close_path(cairo);
}

void add_ring(cairo_t* cairo, const std::vector<Vec>& ring) {
  cairo_new_sub_path(cairo);
  for (const Vec& point : ring) cairo_line_to(cairo, point.x(), point.y());
  cairo_close_path(cairo);
}

}  // namespace throng::tools
