// SPDX-License-Identifier: MIT
#include "tools/picture_floor.h"

#include <algorithm>

#include "tools/pen.h"

namespace throng::tools {

namespace {

constexpr Colour kPlace{0.00, 0.45, 0.70}, kGoal{0.70, 0.35, 0.04}, kStay{0.00, 0.45, 0.35},
    kCount{0.55, 0.15, 0.40};
constexpr std::size_t kMostNames = 100;
constexpr double kSeen = 24.0;  // pixels of an area that has a name

const Colour& colour_of(AreaUse use) {
  return use == AreaUse::wait ? kStay : use == AreaUse::goal ? kGoal : kPlace;
}

void stroke_dashed(cairo_t* cairo, const Colour& colour, double width, double pixel) {
  const double dashes[] = {5 * pixel, 4 * pixel};
  cairo_set_dash(cairo, dashes, 2, 0);
  cairo_set_line_width(cairo, width * pixel);
  set_colour(cairo, colour);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0);
}

void draw_area(cairo_t* cairo, const Area& area, double pixel) {
  for (const std::vector<Vec>& ring : area.region.rings) add_ring(cairo, ring);
  const Colour& colour = colour_of(area.use);
  set_colour(cairo, colour, area.use == AreaUse::none ? 0.08 : 0.16);
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill_preserve(cairo);
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_WINDING);
  stroke_dashed(cairo, colour, 1.5, pixel);
}

void draw_queue(cairo_t* cairo, const Queue& queue, double pixel) {
  cairo_new_path(cairo);
  for (const Vec& point : queue.line) cairo_line_to(cairo, point.x(), point.y());
  stroke_dashed(cairo, kStay, 2.0, pixel);
  cairo_arc(cairo, queue.line[0].x(), queue.line[0].y(), 4.5 * pixel, 0, 6.2831853071795865);
  cairo_fill(cairo);
}

/// Dashed, and an arrow from its left to its right, the way that it counts forward.
void draw_line(cairo_t* cairo, const std::array<Vec, 2>& line, double pixel) {
  const Vec along = (line[1] - line[0]).normalized(), forward(along.y(), -along.x());
  const Vec middle = 0.5 * (line[0] + line[1]), tip = middle + 26 * pixel * forward;
  const auto to = [&](const Vec& point) { cairo_line_to(cairo, point.x(), point.y()); };
  cairo_new_path(cairo);
  to(line[0]), to(line[1]);
  stroke_dashed(cairo, kCount, 2.0, pixel);
  to(middle), to(tip);
  cairo_stroke(cairo);
  to(tip), to(tip - 10 * pixel * (forward + 0.5 * along)), to(tip - 10 * pixel * (forward - 0.5 * along));
  cairo_fill(cairo);
}

/// Of its corners the one that is farthest to the upper left: on the region, even where that is of many
/// pieces, or round.
Vec upper_left(const Region& region) {
  Vec corner = region.rings[0][0];
  for (const std::vector<Vec>& ring : region.rings)
    for (const Vec& point : ring)
      if (point.y() - point.x() > corner.y() - corner.x()) corner = point;
  return corner;
}

/// A text in pixels whose upper left corner is `corner` (m), or more to the left, so that all of it is seen.
void put_name(cairo_t* cairo, const std::string& name, Vec corner, const Colour& colour, double size,
              int width) {
  cairo_user_to_device(cairo, &corner.x(), &corner.y());
  cairo_save(cairo);
  cairo_identity_matrix(cairo);
  set_font(cairo, size, false);
  const std::string text = fitting(cairo, name, width - size);
  const double most = width - 0.5 * size - text_width(cairo, text);
  cairo_move_to(cairo, std::clamp(corner.x() + 0.35 * size, 0.5 * size, most), corner.y() + 1.15 * size);
  cairo_text_path(cairo, text.c_str());
  cairo_set_line_width(cairo, 0.3 * size);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgba(cairo, 1, 1, 1, 0.8);
  cairo_stroke_preserve(cairo);
  set_colour(cairo, colour);
  cairo_fill(cairo);
  cairo_restore(cairo);
}

}  // namespace

void draw_floor(cairo_t* cairo, const Crowd& crowd, double pixel) {
  for (const Area& area : crowd.areas) draw_area(cairo, area, pixel);
  for (const Queue& queue : crowd.queues) draw_queue(cairo, queue, pixel);
  for (const Measure& measure : crowd.measures)
    if (measure.area.empty()) draw_line(cairo, measure.line, pixel);
}

void name_floor(cairo_t* cairo, const Crowd& crowd, double size, int width) {
  for (std::size_t i = 0; i < std::min(kMostNames, crowd.areas.size()); ++i) {
    const Area& area = crowd.areas[i];
    if (area.region.empty()) continue;
    const Eigen::AlignedBox2d box = bounds(area.region);
    double across = box.sizes().x(), up = 0.0;
    cairo_user_to_device_distance(cairo, &across, &up);
    if (across >= kSeen)
      put_name(cairo, area.name, upper_left(area.region), colour_of(area.use), size, width);
  }
  for (std::size_t i = 0; i < std::min(kMostNames, crowd.queues.size()); ++i)
    put_name(cairo, crowd.queues[i].name, crowd.queues[i].line[0], kStay, size, width);
  for (std::size_t i = 0; i < std::min(kMostNames, crowd.measures.size()); ++i)
    if (const Measure& measure = crowd.measures[i]; measure.area.empty())
      put_name(cairo, measure.name, upper_left_end(measure.line), kCount, size, width);
}

}  // namespace throng::tools
