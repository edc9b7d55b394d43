// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/path.h"
#include "scenarios/read_crowd.h"
#include "scenarios/region_sets.h"
#include "sim/crowd/queue_line.h"

namespace throng::scenarios {

namespace {

constexpr double kDoor = 1.3;             // 1/s: what a door 1 m wide lets through, after SFPE and IMO
constexpr double kFastestService = 1e-9;  // s: who is served in no time still is one after the other

class JourneyReader {
 public:
  JourneyReader(const toml::table& agents, const Path& path, Scene& scene, Report& report)
      : agents_(agents), path_(path, "goal"), scene_(scene), report_(report) {}

  std::pair<Journey, std::vector<Stay>> read() {
    const toml::node& goal = *agents_.get("goal");
    if (const toml::array* list = goal.as_array()) {
      for (std::size_t i = 0; i < list->size(); ++i) read_leg(*list->get(i), Path(path_, i));
    } else {
      read_leg(goal, path_);
    }
    if (report_.errors() == 0) expect_an_end(goal);
    return {std::move(journey_), std::move(stays_)};
  }

 private:
  /// The row of the goal of these areas, which is made where it is new.
  std::uint32_t goal_row(const std::vector<std::string>& names, AreaUse use = AreaUse::goal) {
    Goal goal;
    for (const std::string& name : names) {
      goal.name += (goal.name.empty() ? "" : " or ") + in_quotes(name);
      goal.areas.push_back(area_row(name, scene_));
      Area& area = scene_.crowd.areas[goal.areas.back()];
      area.use = std::max(area.use, use);
    }
    std::ranges::sort(goal.areas);
    goal.areas.erase(std::unique(goal.areas.begin(), goal.areas.end()), goal.areas.end());
    std::vector<Goal>& goals = scene_.crowd.goals;
    const auto found = std::ranges::find(goals, goal.areas, &Goal::areas);
    const auto row = static_cast<std::uint32_t>(found - goals.begin());
    if (found != goals.end()) return row;
    std::vector<Region> regions;
    for (const std::uint32_t area : goal.areas) regions.push_back(scene_.crowd.areas[area].region);
    if (report_.errors() == 0) goal.region = united(regions);
    goals.push_back(std::move(goal));
    return row;
  }

  static std::vector<std::string> names(const toml::node& node) {
    std::vector<std::string> result;
    if (node.is_string())
      result.push_back(node.as_string()->get());
    else
      for (const toml::node& name : *node.as_array()) result.push_back(name.as_string()->get());
    return result;
  }

  void expect_once(const toml::node& list, const Path& path) {
    const std::vector<std::string> all = names(list);
    for (std::size_t i = 1; i < all.size(); ++i)
      if (std::find(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), all[i]) !=
          all.begin() + static_cast<std::ptrdiff_t>(i))
        fail(list, path, in_quotes(all[i]) + " stands there twice");
  }

  void read_leg(const toml::node& node, const Path& path) {
    Leg leg;
    if (node.is_string()) {
      leg.options = {goal_row(names(node))};
    } else {
      const toml::table& table = *node.as_table();
      for (const char* key : {"nearest", "least_crowded", "queue"})
        if (const toml::node* list = table.get(key); list && list->is_array())
          expect_once(*list, Path(path, key));
      if (const toml::node* nearest = table.get("nearest")) leg.options = {goal_row(names(*nearest))};
      if (const toml::node* weights = table.get("weights")) read_weights(*weights->as_table(), path, leg);
      if (const toml::node* choice = table.get("least_crowded")) read_least_crowded(*choice, path, leg);
      if (const toml::node* queue = table.get("queue")) read_queue(*queue, leg);
      read_wait(table, path, leg);
    }
    journey_.push_back(std::move(leg));
  }

  /// The numbers of a table of areas, and their goals; false where it was reported.
  bool read_shares(const toml::table& shares, const Path& path, std::vector<std::uint32_t>& goals,
                   std::vector<double>& numbers) {
    for (const auto& [key, share] : shares) {
      const std::string name(key.str());
      if (area_row(name, scene_) == scene_.crowd.areas.size())
        return fail(share, Path(path, name), "is not the name of an entry of [areas]");
      if (!(number(share) > 0.0)) continue;
      goals.push_back(goal_row({name}));
      numbers.push_back(number(share));
    }
    return !goals.empty() || fail(shares, path, "must hold a number above 0");
  }

  void read_weights(const toml::table& weights, const Path& path, Leg& leg) {
    if (!read_shares(weights, Path(path, "weights"), leg.options, leg.weights)) return;
    for (std::size_t i = 1; i < leg.weights.size(); ++i) leg.weights[i] += leg.weights[i - 1];
  }

  void read_least_crowded(const toml::node& node, const Path& path, Leg& leg) {
    if (node.is_table()) {
      read_shares(*node.as_table(), Path(path, "least_crowded"), leg.options, leg.capacity);
    } else {
      for (const std::string& name : names(node)) leg.options.push_back(goal_row({name}));
      leg.capacity.assign(leg.options.size(), kDoor);
    }
  }

  void read_queue(const toml::node& node, Leg& leg) {
    leg.kind = Leg::Kind::queue;
    for (const std::string& name : names(node)) {
      const auto queue = std::ranges::find(scene_.crowd.queues, name, &Queue::name);
      if (queue == scene_.crowd.queues.end()) continue;  // its faults were reported
      leg.options.push_back(static_cast<std::uint32_t>(queue - scene_.crowd.queues.begin()));
      leg.capacity.push_back(1.0 / std::max(queue->service, kFastestService));
    }
  }

  void read_wait(const toml::table& table, const Path& path, Leg& leg) {
    const toml::node *length = table.get("for"), *end = table.get("until"), *area = table.get("wait");
    if (!area) {
      if (const toml::node* time = length ? length : end)
        fail(*time, Path(path, length ? "for" : "until"), "belongs to `wait`");
      return;
    }
    leg.kind = Leg::Kind::wait;
    leg.options = {goal_row(names(*area), AreaUse::wait)};
    if (length && end) fail(*end, Path(path, "until"), "must not stand beside `for`");
    leg.until = end != nullptr;
    if (const toml::node* time = length ? length : end)
      stays_.push_back(
          {journey_.size(),
           read_distribution(*time, 0.0, 1e9, Path(path, length ? "for" : "until").text(), report_)});
  }

  /// At the end agents leave, or wait for ever.
  void expect_an_end(const toml::node& goal) {
    for (std::size_t i = 0; i < journey_.size(); ++i) {
      const bool is_last = i + 1 == journey_.size();
      const bool for_ever =
          journey_[i].kind == Leg::Kind::wait && std::ranges::find(stays_, i, &Stay::leg) == stays_.end();
      if (for_ever && !is_last)
        fail(goal, path_, "goes on after a `wait` that has no end: it needs `for` or `until`");
      if (is_last && !for_ever && journey_[i].kind != Leg::Kind::pass)
        fail(goal, path_, "must end with an area where the agents leave, or with a `wait` without end");
    }
  }

  bool fail(const toml::node& node, const Path& path, const std::string& message) {
    report_.mark_bad(agents_);
    report_.error(node, path.text(), message);
    return false;
  }

  const toml::table& agents_;
  Path path_;
  Scene& scene_;
  Report& report_;
  Journey journey_;
  std::vector<Stay> stays_;
};

/// Reports what keeps the line from being one to stand in; how wide its band is follows from `spacing`.
void read_queue(const toml::table& table, const Path& path, Queue& queue, Scene& scene, Report& report) {
  queue.line = points(*table.get("line"));
  queue.service = number(table, "service", 0.0);
  queue.spacing = number(table, "spacing", queue.spacing);
  const auto fail = [&](const std::string& why) {
    report.error(*table.get("line"), path.text() + ".line", why);
  };
  if (std::ranges::adjacent_find(queue.line) != queue.line.end())
    return fail("must not hold a point twice in a row");
  if (const std::string fault = too_short(queue.line, false); !fault.empty()) return fail(fault);
  double length = 0.0;
  for (std::size_t i = 1; i < queue.line.size(); ++i) length += (queue.line[i] - queue.line[i - 1]).norm();
  if (!(length / queue.spacing < QueueLine::kMostPlaces))
    return fail("has places for " + to_text(length / queue.spacing) + " agents, must have at most " +
                to_text(QueueLine::kMostPlaces));
  queue.goal = static_cast<std::uint32_t>(scene.crowd.goals.size());
  scene.crowd.goals.push_back({in_quotes(queue.name), {}, band(queue.line, 0.25 * queue.spacing), {}});
}

}  // namespace

std::uint32_t area_row(const std::string& name, const Scene& scene) {
  const std::vector<Area>& areas = scene.crowd.areas;
  return static_cast<std::uint32_t>(std::ranges::find(areas, name, &Area::name) - areas.begin());
}

void read_queues(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* queues = root.get("queues");
  if (!queues || !queues->is_table()) return;
  const Path root_path, path(root_path, "queues");
  for (const auto& [name, node] : *queues->as_table()) {
    if (report.bad(node)) continue;
    Queue queue{.name = std::string(name.str()), .line = {}};
    read_queue(*node.as_table(), Path(path, name.str()), queue, scene, report);
    scene.crowd.queues.push_back(std::move(queue));
  }
}

std::pair<Journey, std::vector<Stay>> read_journey(const toml::table& agents, const Path& path, Scene& scene,
                                                   Report& report) {
  return JourneyReader(agents, path, scene, report).read();
}

}  // namespace throng::scenarios
