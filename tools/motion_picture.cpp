// SPDX-License-Identifier: MIT
#include "tools/motion_picture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "sim/input_error.h"
#include "tools/motion_timeline.h"
#include "tools/pen.h"
#include "tools/picture.h"
#include "tools/replace_file.h"

namespace throng::tools {

namespace {

using narrowphase::Pose;
using narrowphase::Verdict;

constexpr std::size_t kPictureLanes = 6;

void add_shape(cairo_t* cairo, const MotionShape& shape) {
  for (const std::vector<Vec>& ring : shape.rings) add_ring(cairo, ring);
  if (!shape.rings.empty()) return;
  for (const narrowphase::Convex& part : shape.parts) add_part(cairo, part);
}

struct Look {
  Colour colour;
  double fill, line;  ///< opacity
  double thickness;   ///< pixels
};

/// The path that `shape` is, filled, and stroked upon it.
void draw_plain(cairo_t* cairo, const MotionShape& shape, const Look& look, double width) {
  add_shape(cairo, shape);
  set_colour(cairo, look.colour, look.fill);
  cairo_fill_preserve(cairo);
  set_colour(cairo, shade(look.colour), look.line);
  cairo_set_line_width(cairo, width);
  cairo_stroke(cairo);
}

/// Of several parts no seams are shown: all outlines, twice as wide, of which then goes what lies inside.
void draw_seamless(cairo_t* cairo, const MotionShape& shape, const Look& look, double width) {
  double left, low, right, high;
  cairo_set_line_width(cairo, 2 * width);
  add_shape(cairo, shape);
  cairo_stroke_extents(cairo, &left, &low, &right, &high);
  cairo_new_path(cairo);
  cairo_rectangle(cairo, left, low, right - left, high - low);
  cairo_clip(cairo);
  cairo_push_group(cairo);  // as large as the clip, no more
  add_shape(cairo, shape);
  set_colour(cairo, shade(look.colour), look.line);
  cairo_stroke_preserve(cairo);
  cairo_set_operator(cairo, CAIRO_OPERATOR_CLEAR);
  cairo_fill_preserve(cairo);
  cairo_set_operator(cairo, CAIRO_OPERATOR_OVER);
  set_colour(cairo, look.colour, look.fill);
  cairo_fill(cairo);
  cairo_pop_group_to_source(cairo);
  cairo_paint(cairo);
}

void draw_shape(cairo_t* cairo, const MotionShape& shape, const Pose& pose, const Look& look, double pixel) {
  cairo_save(cairo);
  const cairo_matrix_t matrix{pose.cos, pose.sin, -pose.sin, pose.cos, pose.position.x(), pose.position.y()};
  cairo_transform(cairo, &matrix);
  const bool plain = !shape.rings.empty() || shape.parts.size() == 1;
  (plain ? draw_plain : draw_seamless)(cairo, shape, look, look.thickness * pixel);
  cairo_restore(cairo);
}

/// Paints the picture, in metres with y up.
class Plot {
 public:
  Plot(cairo_t* cairo, const MotionSystem& system, const MotionAnswer& answer, const MotionView& view,
       double pixel)
      : cairo_(cairo), system_(system), task_(system.task()), answer_(answer), view_(view), pixel_(pixel) {}

  void draw() {
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_tolerance(cairo_, 0.1);
    for (const Obstacle& obstacle : task_.obstacles)
      draw_shape(cairo_, task_.shapes[obstacle.shape], narrowphase::pose(obstacle.at, obstacle.angle),
                 {kObstacle, 1.0, 1.0, 1.6}, pixel_);
    for (const MotionInstant& ghost : view_.ghosts) draw_movers(ghost, 0.05, 0.28, 0.8);
    draw_ways();
    draw_movers(view_.ghosts.front(), 0.18, 0.9, 1.6);
    draw_movers(view_.ghosts.back(), 0.55, 0.9, 1.6);
    if (view_.contact) draw_contact();
  }

 private:
  void draw_movers(const MotionInstant& instant, double fill, double line, double thickness,
                   const Colour* colour = nullptr) {
    const std::vector<Pose> poses = system_.poses(instant.segment, instant.fraction);
    std::size_t link = 0;
    for (std::size_t i = 0; i < task_.movers.size(); ++i)
      for (const MotionLink& one : task_.movers[i].links) {
        const Pose& pose = poses[link++];
        if (one.shape != MotionLink::kNone)
          draw_shape(cairo_, task_.shapes[one.shape], pose,
                     {colour ? *colour : mover_colour(i), fill, line, thickness}, pixel_);
      }
  }

  /// Where the origin of each mover's last link comes.
  std::vector<std::vector<Vec>> last_origins() const {
    std::vector<std::vector<Vec>> ways(task_.movers.size());
    for (std::size_t k = 0; k <= 32 * system_.segments(); ++k) {
      const std::size_t segment = std::min(k / 32, system_.segments() - 1);
      const std::vector<Pose> poses = system_.poses(segment, static_cast<double>(k - 32 * segment) / 32);
      std::size_t link = 0;
      for (std::size_t i = 0; i < ways.size(); ++i)
        ways[i].push_back(poses[(link += task_.movers[i].links.size()) - 1].position);
    }
    return ways;
  }

  /// These ways, dashed.
  void draw_ways() {
    const std::vector<std::vector<Vec>> ways = last_origins();
    const double dashes[] = {5 * pixel_, 3 * pixel_};
    cairo_set_dash(cairo_, dashes, 2, 0);
    cairo_set_line_width(cairo_, 1.6 * pixel_);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      cairo_new_path(cairo_);
      for (const Vec& at : ways[i]) cairo_line_to(cairo_, at.x(), at.y());
      set_colour(cairo_, shade(mover_colour(i)));
      cairo_stroke(cairo_);
    }
    cairo_set_dash(cairo_, nullptr, 0, 0);
  }

  void draw_contact() {
    draw_movers(*view_.contact, 0.22, 1.0, 2.4, &kContact);
    const SegmentAnswer& segment = answer_.segments[view_.contact->segment];
    if (!segment.contact) return;
    const auto [point, normal] = *segment.contact;
    const Vec tip = point + 34 * pixel_ * normal, side(-normal.y(), normal.x());
    set_colour(cairo_, kInk);
    cairo_set_line_width(cairo_, 2.4 * pixel_);
    cairo_move_to(cairo_, point.x(), point.y());
    cairo_line_to(cairo_, tip.x(), tip.y());
    cairo_stroke(cairo_);
    for (const Vec& corner :
         {Vec(tip + 8 * pixel_ * normal), Vec(tip + 5 * pixel_ * side), Vec(tip - 5 * pixel_ * side)})
      cairo_line_to(cairo_, corner.x(), corner.y());
    cairo_fill(cairo_);
    cairo_arc(cairo_, point.x(), point.y(), 5 * pixel_, 0, 2 * std::numbers::pi);
    cairo_fill(cairo_);
  }

  cairo_t* cairo_;
  const MotionSystem& system_;
  const MotionTask& task_;
  const MotionAnswer& answer_;
  const MotionView& view_;
  double pixel_;  // m
};

void draw_words(cairo_t* cairo, const Page& page, const MotionSystem& system, const MotionAnswer& answer,
                const MotionView& view) {
  set_colour(cairo, kInk);
  set_font(cairo, 1.25 * page.unit, true);
  const double room = page.width - 2 * page.border;
  const std::string name = fitting(cairo, system.task().name, 0.4 * room);
  write(cairo, name, page.border, 2.0 * page.unit);
  const double taken = text_width(cairo, name) + page.unit;
  set_font(cairo, page.unit, false);
  set_colour(cairo, answer.verdict == Verdict::free ? kFaint : kContact);
  write(cairo, fitting(cairo, summary(system, answer, view), room - taken), page.width - page.border,
        2.0 * page.unit, Align::right);
}

void draw_all(cairo_t* cairo, const Page& page, const MotionSystem& system, const MotionAnswer& answer,
              const MotionView& view, const std::vector<Lane>& rows) {
  set_colour(cairo, {1, 1, 1});
  cairo_paint(cairo);
  cairo_save(cairo);
  cairo_rectangle(cairo, 0, page.top - 0.4 * page.unit, page.width,
                  page.height - page.top - page.bottom + 0.8 * page.unit);
  cairo_clip(cairo);
  cairo_translate(cairo, (page.width - page.scale * view.extent.size().x()) / 2, page.height - page.bottom);
  cairo_scale(cairo, page.scale, -page.scale);
  cairo_translate(cairo, -view.extent.min.x(), -view.extent.min.y());
  Plot(cairo, system, answer, view, page.unit / 20 / page.scale).draw();
  cairo_restore(cairo);
  draw_words(cairo, page, system, answer, view);
  draw_scale_bar(cairo, page.border, page.height - 2.9 * page.unit, page.width, page.scale, page.unit);
  set_colour(cairo, kFaint);
  set_font(cairo, 0.85 * page.unit, false);
  const std::string red = view.contact ? view.doubt ? ", in doubt red" : ", contact red" : "";
  const char* blank =
      answer.verdict == Verdict::hit ? ", blank: not asked, as a contact ends the search" : "";
  write(
      cairo,
      fitting(cairo, "start pale, end full" + red + "; below: what each distance (tick) proves free" + blank,
              page.width - 2 * page.border),
      page.width - page.border, page.height - 1.4 * page.unit, Align::right);
  draw_timeline(cairo, page, answer, rows);
}

}  // namespace

void write_motion_png(const MotionSystem& system, const MotionAnswer& answer, const std::string& output,
                      int width) {
  const MotionView view = view_of(system, answer);
  const std::vector<Lane> rows = lanes(system, answer, kPictureLanes);
  const Page page(view.extent, width);
  const int height = page.height + static_cast<int>(std::ceil(timeline_height(rows.size(), page.unit)));
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, page.width, height), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo(cairo_create(surface.get()), cairo_destroy);
  if (const cairo_status_t status = cairo_status(cairo.get()); status != CAIRO_STATUS_SUCCESS)
    throw InputError("cannot draw " + output + ": " + cairo_status_to_string(status));
  draw_all(cairo.get(), page, system, answer, view, rows);
  replace_file(output, [&](const std::string& name) {
    const cairo_status_t status = cairo_surface_write_to_png(surface.get(), name.c_str());
    if (status != CAIRO_STATUS_SUCCESS)
      throw InputError("cannot write " + output + ": " + cairo_status_to_string(status));
  });
}

}  // namespace throng::tools
