// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "scenarios/path.h"
#include "scenarios/read_crowd.h"
#include "sim/crowd/crowd_cells.h"
#include "sim/crowd/inside.h"
#include "sim/crowd/queue_line.h"
#include "sim/crowd/walk.h"

namespace throng::scenarios {

namespace {

constexpr double kAtBends = 0.70710678118654752;  // of a width, where a line turns by a right angle
constexpr double kPlaceRounding = 1e-6;  // of an agent's width, in which places may lie far from the origin

/// m, of the largest agent that lines up there.
double largest_radius(const Scene& scene, std::uint32_t queue) {
  double largest = 0.0;
  for (const AgentGroup& group : scene.crowd.groups)
    for (const Leg& leg : group.journey) {
      if (leg.kind != Leg::Kind::queue || std::ranges::find(leg.options, queue) == leg.options.end())
        continue;
      for (std::uint32_t agent = group.first; agent < group.first + group.count; ++agent)
        largest = std::max(largest, scene.bodies.radius[scene.crowd.first + agent]);
    }
  return largest;
}

/// Without the digits that rounding makes.
std::string six_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// The place as messages name it, counted from 1 at the head.
std::string name(const std::vector<Vec>& places, std::size_t place) {
  const Vec& p = places[place];
  return std::to_string(place + 1) + " at [" + six_digits(p.x()) + ", " + six_digits(p.y()) + "]";
}

/// What keeps agents from standing there in line; "" where nothing does. Who is less than a place's width
/// from his place stands there, be it near a wall.
std::string fault(const std::vector<Vec>& places, const Inside& is_floor, const Barriers& barriers) {
  for (std::size_t place = 0; place < places.size(); ++place) {
    const Vec& p = places[place];
    const std::string which = "its place " + name(places, place) + " ";
    if (!is_floor(p)) return which + "is not on the walkable area";
    if (!(barriers.distance(p, 1.0) > 0.0)) return which + "is on a wall";
    if (place > 0 && barriers.block(places[place - 1], p))
      return which + "is behind a wall, seen from the one before it";
  }
  return "";
}

/// The first place of a line that folds back on an earlier one, in words: it is nearer to that than `width`
/// (m, above 0), or, where they follow one another, than a right angle brings them; "" where none is.
/// O(places), as long as few are near one another.
std::string folded(const std::vector<Vec>& places, double width) {
  CrowdCells cells;
  cells.sort(places, width);
  const double least = width * (1.0 - kPlaceRounding), at_bends = width * (kAtBends - kPlaceRounding);
  for (std::size_t place = 0; place < places.size(); ++place) {
    std::size_t other = place;
    cells.for_each_stretch(places[place], width, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i)
        if (const std::size_t near = cells.row()[i];
            near < place && (places[near] - places[place]).norm() < (near + 1 < place ? least : at_bends))
          other = std::min(other, near);
    });
    if (other < place)
      return "its places " + name(places, other) + " and " + name(places, place) + " are " +
             six_digits((places[place] - places[other]).norm()) +
             " m apart: the line folds back, and one who lines up there is " + to_text(width) + " m wide";
  }
  return "";
}

}  // namespace

void check_queues(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.crowd.queues.empty()) return;
  const Barriers barriers(barrier_lines(scene), 1.0);
  const Inside is_floor(scene.crowd.walkable);
  const Path root_path, path(root_path, "queues");
  for (std::uint32_t row = 0; row < scene.crowd.queues.size(); ++row) {
    const Queue& queue = scene.crowd.queues[row];
    const double radius = largest_radius(scene, row);
    const std::vector<Vec> places = QueueLine(queue).all_places();
    const std::string why = fault(places, is_floor, barriers);
    const toml::node &line = *root["queues"][queue.name]["line"].node(),
                     *spacing = root["queues"][queue.name]["spacing"].node();
    const auto refuse_line = [&](const std::string& reason) {
      report.error(line, Path(path, queue.name).text() + ".line", reason);
    };
    if (!why.empty())
      refuse_line(why);
    else if (queue.spacing < 2.0 * radius)
      report.error(spacing ? *spacing : line, Path(path, queue.name).text() + ".spacing",
                   "must be at least " + to_text(2.0 * radius) +
                       " m, as wide as one who lines up there, and is " + to_text(queue.spacing) +
                       " m: nobody would stand at his place");
    else if (const std::string both = radius > 0.0 ? folded(places, 2.0 * radius) : ""; !both.empty())
      refuse_line(both);
  }
}

}  // namespace throng::scenarios
