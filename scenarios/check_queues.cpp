// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/path.h"
#include "scenarios/read_crowd.h"
#include "sim/crowd/inside.h"
#include "sim/crowd/queue_line.h"
#include "sim/crowd/walk.h"

namespace throng::scenarios {

namespace {

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

/// What keeps agents from standing there in line; "" where nothing does. Who is less than a place's width
/// from his place stands there, be it near a wall.
std::string fault(const QueueLine& line, const Inside& is_floor, const Barriers& barriers) {
  for (std::uint32_t number = 1; number <= line.places(); ++number) {
    const Vec p = line.place(number);
    const std::string which = "its place " + std::to_string(number) + " at " + to_text(p) + " ";
    if (!is_floor(p)) return which + "is not on the walkable area";
    if (!(barriers.distance(p, 1.0) > 0.0)) return which + "is on a wall";
    if (number > 1 && barriers.block(line.place(number - 1), p))
      return which + "is behind a wall, seen from the one before it";
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
    const std::string why = fault(QueueLine(queue), is_floor, barriers);
    const toml::node &line = *root["queues"][queue.name]["line"].node(),
                     *spacing = root["queues"][queue.name]["spacing"].node();
    if (!why.empty())
      report.error(line, Path(path, queue.name).text() + ".line", why);
    else if (queue.spacing < 2.0 * radius)
      report.error(spacing ? *spacing : line, Path(path, queue.name).text() + ".spacing",
                   "must be at least " + to_text(2.0 * radius) +
                       " m, as wide as one who lines up there, and is " + to_text(queue.spacing) +
                       " m: nobody would stand at his place");
  }
}

}  // namespace throng::scenarios
