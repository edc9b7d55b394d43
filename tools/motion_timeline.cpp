// SPDX-License-Identifier: MIT
#include "tools/motion_timeline.h"

#include <algorithm>
#include <optional>
#include <span>

#include "tools/answer_json.h"
#include "tools/motion_view.h"
#include "tools/pen.h"

namespace throng::tools {

namespace {

using narrowphase::Verdict;

constexpr Colour kProven{0.33, 0.55, 0.62};
constexpr double kApart = 4.0;  // pixels, from line to line at least

/// What was proven free, a lane a pair; time goes to the right.
class Timeline {
 public:
  Timeline(cairo_t* cairo, const Page& page, const MotionAnswer& answer, const std::vector<Lane>& lanes)
      : cairo_(cairo), unit_(page.unit), answer_(answer), lanes_(lanes) {
    left_ = page.border + std::min(0.24 * page.width, 16 * unit_);
    width_ = page.width - page.border - left_;
    label_ = page.border;
  }

  void draw(double top) {
    draw_segments(top);
    set_font(cairo_, 0.85 * unit_, false);
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      draw_lane(lanes_[i], top + (2.0 + 1.5 * static_cast<double>(i)) * unit_);
    draw_doubt(top);
  }

 private:
  double x(double at) const { return left_ + width_ * at / static_cast<double>(answer_.segments.size()); }

  void draw_segments(double top) {
    set_font(cairo_, 0.85 * unit_, false);
    const double each = width_ / static_cast<double>(answer_.segments.size());
    for (std::size_t i = 0; i < answer_.segments.size(); ++i) {
      const auto at = static_cast<double>(i);
      const std::optional<Verdict>& verdict = answer_.segments[i].verdict;
      set_colour(cairo_, verdict && *verdict != Verdict::free ? kContact : kFaint);
      const std::string name =
          "segment " + std::to_string(i) + (verdict ? std::string(": ") + word(*verdict) : "");
      if (each > text_width(cairo_, name) + unit_)
        write(cairo_, name, x(at + 0.5), top + 1.2 * unit_, Align::centre);
      if (each < kApart) continue;
      set_colour(cairo_, kFaint, 0.5);
      cairo_set_line_width(cairo_, 1);
      for (double border : {at, at + 1}) {
        cairo_move_to(cairo_, x(border), top + 0.4 * unit_);
        cairo_line_to(cairo_, x(border), top + (2.0 + 1.5 * static_cast<double>(lanes_.size())) * unit_);
      }
      cairo_stroke(cairo_);
    }
  }

  void draw_lane(const Lane& lane, double y) {
    set_colour(cairo_, kInk);
    write(cairo_, fitting(cairo_, lane.label, left_ - label_ - 0.5 * unit_), label_, y + 0.85 * unit_);
    std::vector<Lane::Strip> strips = lane.strips;
    std::ranges::sort(strips, {}, &Lane::Strip::from);
    draw_proven(strips, y);
    for (const Lane::Strip& strip : strips)
      if (!strip.proven) fill(strip.from, strip.to, y, kContact, 1.0);
    draw_ticks(lane, y);
  }

  void fill(double from, double to, double y, const Colour& colour, double opacity) {
    cairo_rectangle(cairo_, x(from), y, std::max(0.5, x(to) - x(from)), unit_);
    set_colour(cairo_, colour, opacity);
    cairo_fill(cairo_);
  }

  /// Strips that overlap are one: a thousand would be black.
  void draw_proven(std::span<const Lane::Strip> ascending, double y) {
    std::optional<std::pair<double, double>> all;
    for (const Lane::Strip& strip : ascending) {
      if (!strip.proven) continue;
      if (all && strip.from > all->second) fill(all->first, all->second, y, kProven, 0.45), all.reset();
      if (!all) all.emplace(strip.from, strip.to);
      all->second = std::max(all->second, strip.to);
    }
    if (all) fill(all->first, all->second, y, kProven, 0.45);
  }

  /// When distances were computed; where that is too dense to tell apart, some of them.
  void draw_ticks(const Lane& lane, double y) {
    std::vector<double> ticks;
    for (const Lane::Strip& strip : lane.strips) ticks.push_back(x(strip.at));
    std::ranges::sort(ticks);
    set_colour(cairo_, kInk);
    cairo_set_line_width(cairo_, 1);
    double last = -kApart;
    for (const double at : ticks) {
      if (at - last < kApart) continue;
      last = at;
      cairo_move_to(cairo_, at, y + 0.2 * unit_);
      cairo_line_to(cairo_, at, y + 0.8 * unit_);
    }
    cairo_stroke(cairo_);
  }

  /// Contacts and what is in doubt, across all lanes.
  void draw_doubt(double top) {
    for (std::size_t i = 0; i < answer_.segments.size(); ++i) {
      const SegmentAnswer& segment = answer_.segments[i];
      if (!segment.verdict || *segment.verdict == Verdict::free) continue;
      const double from = x(static_cast<double>(i) + segment.from),
                   to = x(static_cast<double>(i) + segment.to);
      set_colour(cairo_, kContact, 0.9);
      cairo_rectangle(cairo_, from - 1, top + 1.6 * unit_, std::max(2.5, to - from),
                      (0.4 + 1.5 * static_cast<double>(lanes_.size())) * unit_);
      cairo_fill(cairo_);
    }
  }

  cairo_t* cairo_;
  double unit_, left_, width_, label_;
  const MotionAnswer& answer_;
  const std::vector<Lane>& lanes_;
};

}  // namespace

double timeline_height(std::size_t lanes, double unit) {
  return (3.6 + 1.5 * static_cast<double>(lanes)) * unit;
}

void draw_timeline(cairo_t* cairo, const Page& page, const MotionAnswer& answer,
                   const std::vector<Lane>& lanes) {
  Timeline(cairo, page, answer, lanes).draw(page.height);
}

}  // namespace throng::tools
