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

/// What keeps agents of that radius (m) from standing there in line; "" where nothing does. Who is less than
/// a place's width from his place stands there.
std::string fault(const QueueLine& line, const Queue& queue, double radius, const Inside& is_floor,
                  const Barriers& barriers) {
  for (std::uint32_t number = 1; number <= line.places(); ++number) {
    const Vec p = line.place(number);
    const std::string which = "its place " + std::to_string(number) + " at " + to_text(p) + " ";
    if (!is_floor(p)) return which + "is not on the walkable area";
    const double clear = barriers.distance(p, std::max(1.0, radius));
    if (!(clear > 0.0)) return which + "is on a wall";
    if (clear + queue.spacing < radius)
      return which + "is " + to_text(clear) + " m from a wall: agents of radius " + to_text(radius) +
             " m get no nearer to it than `spacing`, " + to_text(queue.spacing) + " m";
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
    const std::string why = fault(QueueLine(queue), queue, largest_radius(scene, row), is_floor, barriers);
    if (!why.empty())
      report.error(*root["queues"][queue.name]["line"].node(), Path(path, queue.name).text() + ".line", why);
  }
}

}  // namespace throng::scenarios
