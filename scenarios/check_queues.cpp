// SPDX-License-Identifier: MIT
#include "scenarios/path.h"
#include "scenarios/read_crowd.h"
#include "sim/crowd/queue_line.h"
#include "sim/crowd/walk.h"

namespace throng::scenarios {

namespace {

/// What keeps agents from standing there in line; "" where nothing does.
std::string fault(const QueueLine& line, const Region& walkable, const Barriers& barriers) {
  for (std::uint32_t number = 1; number <= line.places(); ++number) {
    const Vec p = line.place(number);
    const std::string which =
        "its place " + std::to_string(number) + " at [" + to_text(p.x()) + ", " + to_text(p.y()) + "] ";
    if (!contains(walkable, p)) return which + "is not on the walkable area";
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
  const Path root_path, path(root_path, "queues");
  for (const Queue& queue : scene.crowd.queues)
    if (const std::string why = fault(QueueLine(queue), scene.crowd.walkable, barriers); !why.empty())
      report.error(*root["queues"][queue.name]["line"].node(), Path(path, queue.name).text() + ".line", why);
}

}  // namespace throng::scenarios
