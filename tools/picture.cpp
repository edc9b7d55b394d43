// SPDX-License-Identifier: MIT
#include "tools/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "sim/input_error.h"
#include "tools/palette.h"
#include "tools/pen.h"
#include "tools/picture_bodies.h"
#include "tools/picture_floor.h"
#include "tools/replace_file.h"

namespace throng::tools {

namespace {

constexpr Colour kDomain{0.55, 0.57, 0.60};

using Context = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

void draw_domain(cairo_t* cairo, const Domain& domain, double pixel) {
  if (domain.kind == DomainKind::unbounded) return;
  const Vec size = domain.max - domain.min;
  const double dashes[] = {6 * pixel, 4 * pixel};
  if (domain.kind == DomainKind::periodic) cairo_set_dash(cairo, dashes, 2, 0);
  const double thickness = (domain.kind == DomainKind::periodic ? 1.2 : 3.0) * pixel;
  cairo_set_line_width(cairo, thickness);
  set_colour(cairo, kDomain);
  cairo_rectangle(cairo, domain.min.x() - thickness / 2, domain.min.y() - thickness / 2, size.x() + thickness,
                  size.y() + thickness);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0);
}

void draw_scene(cairo_t* cairo, const Page& page, const Extent& shown, const Scene& scene, const Frame& frame,
                double top) {
  cairo_save(cairo);
  cairo_rectangle(cairo, 0, page.top - 0.4 * page.unit, page.width,
                  page.height - page.top - page.bottom + 0.8 * page.unit);
  cairo_clip(cairo);
  const double left = (page.width - page.scale * shown.size().x()) / 2;
  cairo_translate(cairo, left, page.height - page.bottom);
  cairo_scale(cairo, page.scale, -page.scale);
  cairo_translate(cairo, -shown.min.x(), -shown.min.y());
  const double pixel = page.unit / 20 / page.scale;
  draw_domain(cairo, scene.domain, pixel);
  draw_floor(cairo, scene.crowd, pixel);
  draw_bodies(cairo, scene, frame, pixel, top);
  draw_walls(cairo, scene, 3.0 * pixel);
  name_floor(cairo, scene.crowd, 0.8 * page.unit, page.width);
  cairo_restore(cairo);
}

void draw_title(cairo_t* cairo, const Page& page, const Scene& scene, const Frame& frame) {
  set_colour(cairo, kInk);
  set_font(cairo, 1.25 * page.unit, true);
  write(cairo, scene.name, page.border, 2.0 * page.unit);
  set_font(cairo, page.unit, false);
  set_colour(cairo, kFaint);
  char time[64];
  std::snprintf(time, sizeof time, "t = %.3f s", frame.time);
  write(cairo, who_is_there(scene.bodies, frame) + "   " + time, page.width - page.border, 2.0 * page.unit,
        Align::right);
}

/// Beside the bar's name there is room for no more.
std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 0.001 ? "%.0e" : "%.3g", value);
  return text;
}

void draw_colour_bar(cairo_t* cairo, const Page& page, const SpeedScale& scale) {
  const double width = std::min(18 * page.unit, 0.4 * page.width), height = 0.8 * page.unit;
  const double x = page.width - page.border - width, y = page.height - 2.9 * page.unit - height / 2;
  std::unique_ptr<cairo_pattern_t, void (*)(cairo_pattern_t*)> ramp(
      cairo_pattern_create_linear(x, 0, x + width, 0), cairo_pattern_destroy);
  for (int i = 0; i <= 20; ++i) {
    const Colour c = palette(i / 20.0);
    cairo_pattern_add_color_stop_rgb(ramp.get(), i / 20.0, c.red, c.green, c.blue);
  }
  cairo_rectangle(cairo, x, y, width, height);
  cairo_set_source(cairo, ramp.get());
  cairo_fill(cairo);
  set_colour(cairo, kInk);
  const double baseline = y + height + 1.3 * page.unit;
  write(cairo, "0", x, baseline);
  write(cairo, "speed (m/s)", x + width / 2, baseline, Align::centre);
  write(cairo, (scale.beyond ? "≥ " : "") + short_number(scale.top), x + width, baseline, Align::right);
}

std::string why_no_velocity(const Record& record) {
  if (!record.velocity) return "velocity not recorded";
  return "velocity not in this frame; recorded each " + std::to_string(every(record, RecordField::velocity)) +
         " steps";
}

void draw_legend(cairo_t* cairo, const Page& page, const Record& record, const Frame& frame,
                 const SpeedScale& scale) {
  draw_scale_bar(cairo, page.border, page.height - 2.9 * page.unit, page.width, page.scale, page.unit);
  const double y = page.height - 2.6 * page.unit;
  if (scale.top > 0) return draw_colour_bar(cairo, page, scale);
  set_colour(cairo, kFaint);
  write(cairo, frame.velocity.empty() ? why_no_velocity(record) : "nobody moves", page.width - page.border, y,
        Align::right);
}

}  // namespace

Page::Page(const Extent& shown, int wanted) {
  wanted -= wanted % 2;
  unit = std::max(11.0, 0.0125 * wanted);
  border = 1.2 * unit;
  top = 3.2 * unit;
  bottom = 4.6 * unit;
  const Vec room(wanted - 2 * border, wanted - top - bottom);
  scale = room.cwiseQuotient(shown.size()).minCoeff();
  const double least = 30 * unit;  // for the legend
  const auto even = [](double size) { return 2 * static_cast<int>(std::ceil(size / 2)); };
  width = std::min(wanted, even(std::max(least, scale * shown.size().x() + 2 * border)));
  height = std::min(wanted, even(scale * shown.size().y() + top + bottom));
}

Picture::Picture(const Scene& scene, const View& view, int width)
    : scene_(scene),
      view_(view),
      page_(view.extent, width),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, page_.width, page_.height),
               cairo_surface_destroy) {
  const cairo_status_t status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS)
    throw InputError("cannot draw " + std::to_string(page_.width) + " x " + std::to_string(page_.height) +
                     " pixels: " + cairo_status_to_string(status));
}

void Picture::draw(const Frame& frame) {
  const Context cairo(cairo_create(surface_.get()), cairo_destroy);
  cairo_set_source_rgb(cairo.get(), 1, 1, 1);
  cairo_paint(cairo.get());
  draw_scene(cairo.get(), page_, view_.extent, scene_, frame, view_.speeds.top);
  draw_title(cairo.get(), page_, scene_, frame);
  draw_legend(cairo.get(), page_, scene_.record, frame, view_.speeds);
}

std::span<const unsigned char> Picture::pixels() {
  cairo_surface_flush(surface_.get());
  return {cairo_image_surface_get_data(surface_.get()), std::size_t{4} * page_.width * page_.height};
}

void Picture::write_png(const std::string& output) {
  replace_file(output, [&](const std::string& name) {
    const cairo_status_t status = cairo_surface_write_to_png(surface_.get(), name.c_str());
    if (status != CAIRO_STATUS_SUCCESS)
      throw InputError("cannot write " + output + ": " + cairo_status_to_string(status));
  });
}

}  // namespace throng::tools
