// SPDX-License-Identifier: MIT
#include "tools/dots.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/bvh_edges.h"
#include "narrowphase/relative.h"
#include "tools/images.h"
#include "tools/palette.h"

namespace throng::tools {

namespace {

constexpr std::uint8_t kBorderDot = 240, kWallDot = 250, kStillDot = 245;               // greys
constexpr std::uint8_t kPlaceDot = 67, kGoalDot = 172, kStayDot = 72, kCountDot = 132;  // as pictures
constexpr char32_t kNoDots = 0x2800, kAllDots = 0x28FF;

/// The nearest of the 6 x 6 x 6 colours that every terminal has.
std::uint8_t terminal_colour(const Colour& colour) {
  constexpr int kLevels[] = {0, 95, 135, 175, 215, 255};
  int index = 16, weight = 36;
  for (const double part : {colour.red, colour.green, colour.blue}) {
    const auto distance = [&](int level) { return std::abs(255.0 * part - level); };
    const int* best = std::min_element(std::begin(kLevels), std::end(kLevels),
                                       [&](int a, int b) { return distance(a) < distance(b); });
    index += weight * static_cast<int>(best - kLevels);
    weight /= 6;
  }
  return static_cast<std::uint8_t>(index);
}

std::uint8_t colour_of(const Scene& scene, const Frame& frame, const View& view, std::size_t row) {
  constexpr double kDarkest = 0.35;  // of the palette: below it nothing shows on black
  const BodyKind kind = scene.bodies.kind[row];
  if (kind == BodyKind::fixed || kind == BodyKind::kinematic) return kStillDot;
  const bool known = !frame.velocity.empty() && view.speeds.top > 0;
  const double speed = known ? std::min(1.0, frame.velocity[row].norm() / view.speeds.top) : 0.0;
  return terminal_colour(palette(kDarkest + (1 - kDarkest) * speed));
}

/// The dots of an area, and where in the plane they lie.
class Dots {
 public:
  Dots(Screen& screen, const Cells& area, const Extent& extent)
      : screen_(screen), area_(area), width_(2 * area.columns), height_(4 * area.rows) {
    const Vec size = extent.size();
    dot_ = std::max(size.x() / width_, size.y() / height_);
    corner_ = extent.min - 0.5 * (dot_ * Vec(width_, height_) - size);
  }

  double dot() const { return dot_; }  ///< m from one dot to the next

  void set(int x, int y, std::uint8_t colour) {
    constexpr unsigned kBits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};  // from above
    if (x < 0 || x >= width_ || y < 0 || y >= height_) return;
    const int down = height_ - 1 - y;
    Cell& cell = screen_.at(area_.column + x / 2, area_.row + down / 4);
    if (cell.glyph < kNoDots || cell.glyph > kAllDots) cell.glyph = kNoDots;
    cell.glyph |= kBits[down % 4][x % 2];
    cell.colour = colour;
  }

  /// The dot that a point lies in.
  void set(const Vec& point, std::uint8_t colour) { set(column(point.x()), line(point.y()), colour); }

  /// The dots in a box that a predicate on their middles chooses.
  template <class Chosen>
  void fill(const Vec& min, const Vec& max, std::uint8_t colour, Chosen chosen) {
    for (int y = std::max(0, line(min.y())); y <= std::min(height_ - 1, line(max.y())); ++y)
      for (int x = std::max(0, column(min.x())); x <= std::min(width_ - 1, column(max.x())); ++x)
        if (chosen(Vec(corner_ + dot_ * Vec(x + 0.5, y + 0.5)))) set(x, y, colour);
  }

  /// Puts a text below the cell of `at`, from the next column on; nothing where it doesn't fit before `right`
  /// (m).
  void name(const std::string& text, const Vec& at, double right, std::uint8_t colour) {
    const int first = column(at.x()) / 2 + 1, under = (height_ - 1 - line(at.y())) / 4 + 1;
    const bool fits = first + tools::width(text) <= column(right) / 2;
    if (fits && column(at.x()) >= 0 && line(at.y()) >= 0 && line(at.y()) < height_ && under < area_.rows)
      screen_.put(area_.column + first, area_.row + under, text, colour);
  }

  double right() const { return corner_.x() + dot_ * width_; }  ///< m, of all that is shown

  /// Each `every`-th dot along a line, as far as it is seen.
  void draw_line(Vec from, Vec to, std::uint8_t colour, int every = 1) {
    if (!clip(from, to)) return;
    const int steps = static_cast<int>(std::ceil((to - from).cwiseAbs().maxCoeff() / dot_));
    for (int i = 0; i <= steps; i += every) set(from + (to - from) * i / std::max(1, steps), colour);
  }

 private:
  int column(double x) const { return index((x - corner_.x()) / dot_, width_); }
  int line(double y) const { return index((y - corner_.y()) / dot_, height_); }

  /// Whole, and -1 or `count` for all that is outside.
  static int index(double at, int count) {
    return static_cast<int>(std::floor(std::clamp(at, -1.0, static_cast<double>(count))));
  }

  /// Cuts off what lies outside of the area (Liang and Barsky 1984). False where nothing is left.
  bool clip(Vec& from, Vec& to) const {
    const Vec low = corner_, high = corner_ + dot_ * Vec(width_, height_), along = to - from;
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      if (along[axis] == 0.0) {
        if (from[axis] < low[axis] || from[axis] > high[axis]) return false;
        continue;
      }
      const double a = (low[axis] - from[axis]) / along[axis], b = (high[axis] - from[axis]) / along[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) return false;
    to = from + leave * along;
    from += enter * along;
    return true;
  }

  Screen& screen_;
  Cells area_;
  int width_, height_;
  double dot_;
  Vec corner_;
};

void draw_domain(Dots& dots, const Domain& domain) {
  if (domain.kind == DomainKind::unbounded) return;
  const int every = domain.kind == DomainKind::periodic ? 3 : 1;
  const Vec half(0.5 * dots.dot(), 0.5 * dots.dot());  // around it, not on what touches it
  const Vec a = domain.min - half, c = domain.max + half, b(c.x(), a.y()), d(a.x(), c.y());
  dots.draw_line(a, b, kBorderDot, every);
  dots.draw_line(b, c, kBorderDot, every);
  dots.draw_line(d, c, kBorderDot, every);
  dots.draw_line(a, d, kBorderDot, every);
}

void draw_wall(Dots& dots, const Wall& wall) {
  for (std::size_t i = 0; i + 1 < wall.points.size(); ++i)
    dots.draw_line(wall.points[i], wall.points[i + 1], kWallDot);
  if (wall.closed) dots.draw_line(wall.points.back(), wall.points.front(), kWallDot);
}

void draw_area(Dots& dots, const Area& area) {
  const std::uint8_t colour = area.use == AreaUse::wait   ? kStayDot
                              : area.use == AreaUse::goal ? kGoalDot
                                                          : kPlaceDot;
  for (const std::vector<Vec>& ring : area.region.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      dots.draw_line(ring[i], ring[narrowphase::next(i, ring.size())], colour, 3);
  if (area.region.empty()) return;
  const Eigen::AlignedBox2d box = bounds(area.region);
  dots.name(area.name, {box.min().x(), box.max().y()}, box.max().x(), colour);
}

void draw_queue(Dots& dots, const Queue& queue) {
  for (std::size_t i = 0; i + 1 < queue.line.size(); ++i)
    dots.draw_line(queue.line[i], queue.line[i + 1], kStayDot, 2);
  dots.name(queue.name, queue.line[0], dots.right(), kStayDot);
}

void draw_line(Dots& dots, const Measure& measure) {
  dots.draw_line(measure.line[0], measure.line[1], kCountDot, 2);
  dots.name(measure.name, upper_left_end(measure.line), dots.right(), kCountDot);
}

/// Whether a point lies in a polygon, in its frame, and farther than `rim` from its border.
bool is_within(const Shape& polygon, const Vec& point, double rim) {
  bool inside = false, clear = true;
  const auto look_at = [&](const std::vector<Vec>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec &p = ring[i], &q = ring[narrowphase::next(i, ring.size())];
      inside ^= narrowphase::ray_passes(point, p, q);
      clear &= narrowphase::nearest_on_edge(point, p, q).squared >= rim * rim;
    }
  };
  look_at(polygon.outline);
  for (const std::vector<Vec>& hole : polygon.holes) look_at(hole);
  return inside && clear;
}

/// Whether a point lies in a disc of a composite, and farther than `rim` from that one's border.
bool is_within_a_disc(const Shape& discs, const Vec& point, double rim) {
  return std::ranges::any_of(discs.parts, [&](const narrowphase::Convex& part) {
    return (point - part.vertices[0]).norm() <= part.radius - rim;
  });
}

/// Those dots that lie in the body and not in its outermost half dot.
void draw_body(Dots& dots, const Shape& shape, double radius, const narrowphase::Pose& pose,
               std::uint8_t colour) {
  const bool is_polygon = shape.kind == ShapeKind::polygon, is_small = radius < dots.dot();
  if (is_small || !is_polygon || is_within(shape, Vec(0.0, 0.0), 0.0)) dots.set(pose.position, colour);
  if (is_small) return;
  const double rim = std::min(0.5 * dots.dot(), 0.25 * radius);
  const Vec reach(radius, radius);
  dots.fill(pose.position - reach, pose.position + reach, colour, [&](const Vec& point) {
    const Vec own = pose.unrotate(point - pose.position);
    if (shape.kind == ShapeKind::disc) return own.norm() <= radius - rim;
    return is_polygon ? is_within(shape, own, rim) : is_within_a_disc(shape, own, rim);
  });
}

}  // namespace

void draw_dots(Screen& screen, const Cells& area, const Scene& scene, const View& view, const Frame& frame) {
  if (area.columns <= 0 || area.rows <= 0) return;
  Dots dots(screen, area, view.extent);
  draw_domain(dots, scene.domain);
  for (const Area& each : scene.crowd.areas) draw_area(dots, each);
  for (const Queue& queue : scene.crowd.queues) draw_queue(dots, queue);
  for (const Measure& measure : scene.crowd.measures)
    if (measure.area.empty()) draw_line(dots, measure);
  for (const Wall& wall : scene.walls) draw_wall(dots, wall);
  for (std::size_t row = 0; row < frame.position.size(); ++row) {
    if (!frame.has(row)) continue;
    const Shape& shape = scene.shapes[scene.bodies.shape[row]];
    const double radius = scene.bodies.radius[row], angle = frame.angle.empty() ? 0.0 : frame.angle[row];
    narrowphase::Pose pose = narrowphase::pose(frame.position[row], angle);
    at_images(scene.domain, frame.position[row], radius, [&](const Vec& at) {
      pose.position = at;
      draw_body(dots, shape, radius, pose, colour_of(scene, frame, view, row));
    });
  }
}

}  // namespace throng::tools
