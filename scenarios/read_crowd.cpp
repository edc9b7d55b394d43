// SPDX-License-Identifier: MIT
#include "scenarios/read_crowd.h"

#include <algorithm>

#include "scenarios/limits.h"
#include "scenarios/path.h"
#include "scenarios/polygon_check.h"
#include "scenarios/region_sets.h"
#include "sim/crowd/model.h"

namespace throng::scenarios {

namespace {

/// The region of a well-known text or of a list of points; empty where it was reported.
Region read_region(const toml::node& node, const Path& path, Report& report) {
  const auto fail = [&](const std::string& why) {
    report.mark_bad(node);
    report.error(node, path.text(), why);
    return Region();
  };
  const std::string wkt = node.is_string() ? node.as_string()->get() : polygon_wkt(points(node));
  Wkt read = read_wkt(wkt);
  if (!read.refusal.empty()) return fail(read.refusal);
  if (const std::string fault = polygon_fault(wkt); !fault.empty()) return fail(fault);
  Region region;
  for (WktLine& line : read.lines) {
    if (!line.closed) return fail("must be a POLYGON or a MULTIPOLYGON");
    if (const std::string fault = too_short(line.points, true); !fault.empty()) return fail(fault);
    line.points.erase(std::unique(line.points.begin(), line.points.end()), line.points.end());
    region.rings.push_back(std::move(line.points));
  }
  return region;
}

Region region_of(const Eigen::AlignedBox2d& box) {
  const Vec &low = box.min(), &high = box.max();
  return {{{low, {high.x(), low.y()}, high, {low.x(), high.y()}}}};
}

/// Row of the area of this name; behind the last one where there is none.
std::uint32_t area_row(const std::string& name, const Scene& scene) {
  const std::vector<Area>& areas = scene.crowd.areas;
  const auto found =
      std::find_if(areas.begin(), areas.end(), [&](const Area& area) { return area.name == name; });
  return static_cast<std::uint32_t>(found - areas.begin());
}

class AgentReader {
 public:
  AgentReader(const toml::table& table, const Path& path, Scene& scene, Report& report)
      : table_(table), path_(path), scene_(scene), report_(report) {}

  AgentEntry read(std::uint32_t index) {
    entry_.node = &table_;
    entry_.path = path_.text();
    entry_.count = static_cast<std::uint32_t>(number(table_, "count", 1.0));
    entry_.radius = distribution("radius", 0.2, kShortest, kFarthest);
    entry_.desired_speed = distribution("desired_speed", 1.34, 0.0, kFastest);
    entry_.premovement = distribution("premovement", 0.0, 0.0, 1e9);
    read_group(index);
    read_goal();
    read_place();
    read_appearance();
    return entry_;
  }

 private:
  Distribution distribution(const char* key, double preset, double least, double most) {
    const toml::node* node = table_.get(key);
    if (!node) return {Distribution::Kind::fixed, preset, 0.0, least, most};
    const int errors = report_.errors();
    const Distribution result = read_distribution(*node, least, most, Path(path_, key).text(), report_);
    if (report_.errors() > errors) report_.mark_bad(table_);
    return result;
  }

  void read_group(std::uint32_t index) {
    const std::string name = text(table_, "model", "");
    const auto kinds = walking_models();
    AgentGroup group;
    group.index = index;
    for (std::uint32_t row = 0; row < kinds.size(); ++row) {
      const toml::node* node = table_.get(kinds[row].name);
      if (name == kinds[row].name) {
        group.model = row;
        group.parameters = parameters_of(kinds[row], node ? *node->as_table() : toml::table());
      } else if (node) {
        fail(*node, kinds[row].name,
             "belongs to another model than " + in_quotes(name) + ", which this group has");
      }
    }
    scene_.crowd.groups.push_back(std::move(group));
  }

  static std::vector<double> parameters_of(const ModelKind& kind, const toml::table& table) {
    const auto preset = std::ranges::find(kind.presets, text(table, "preset", ""), &ModelPreset::name);
    std::vector<double> values;
    for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
      const ModelParameter& own = kind.parameters[i];
      values.push_back(number(table, own.key, preset == kind.presets.end() ? own.preset : preset->values[i]));
    }
    return values;
  }

  /// The row of the goal, which is made where it is new.
  std::uint32_t goal_row(const toml::node& node) {
    std::vector<std::string> names;
    if (node.is_string())
      names.push_back(node.as_string()->get());
    else
      for (const toml::node& name : *node.as_table()->get("nearest")->as_array())
        names.push_back(name.as_string()->get());
    Goal goal;
    for (const std::string& name : names) {
      goal.name += (goal.name.empty() ? "" : " or ") + in_quotes(name);
      goal.areas.push_back(area_row(name, scene_));
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

  void add_journey(Journey journey, double weight) {
    const double before = entry_.weights.empty() ? 0.0 : entry_.weights.back();
    entry_.journeys.push_back(static_cast<std::uint32_t>(scene_.crowd.journeys.size()));
    entry_.weights.push_back(before + weight);
    scene_.crowd.journeys.push_back(std::move(journey));
  }

  void read_goal() {
    const toml::node& node = *table_.get("goal");
    const toml::node* weights = node.is_table() ? node.as_table()->get("weights") : nullptr;
    Journey journey;
    if (weights) return read_weights(*weights->as_table());
    if (node.is_array())
      for (const toml::node& goal : *node.as_array()) journey.push_back(goal_row(goal));
    else
      journey.push_back(goal_row(node));
    add_journey(std::move(journey), 1.0);
  }

  void read_weights(const toml::table& weights) {
    for (const auto& [name, weight] : weights) {
      const toml::value<std::string> goal{std::string(name.str())};
      if (area_row(goal.get(), scene_) == scene_.crowd.areas.size())
        return fail(weight, "goal.weights." + goal.get(), "is not the name of an entry of [areas]");
      if (number(weight) > 0.0) add_journey({goal_row(goal)}, number(weight));
    }
    if (entry_.journeys.empty()) fail(weights, "goal.weights", "must hold a weight above 0");
  }

  void read_appearance() {
    const toml::node* node = table_.get("appear");
    if (!node) return;
    const toml::table& table = *node->as_table();
    Appearance appears{number(table, "rate", 0.0),
                       number(table, "from", 0.0),
                       {},
                       static_cast<std::uint32_t>(number(table, "together", 1.0))};
    if (const toml::node* times = table.get("times")) {
      for (const toml::node& time : *times->as_array()) appears.times.push_back(number(time));
      if (!std::is_sorted(appears.times.begin(), appears.times.end()))
        fail(*times, "appear.times", "must be ascending");
      if (table.contains("from")) fail(*table.get("from"), "appear.from", "belongs to a rate");
      const std::size_t all = appears.times.size() * appears.together;
      const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(all, kMostBodies + 1));
      if (!table_.contains("count")) entry_.count = most;
      if (entry_.count != most)
        fail(*times, "appear.times",
             "make " + std::to_string(all) + " agents appear, and count is " + std::to_string(entry_.count));
    } else if (!table_.contains("count")) {
      fail(*node, "appear.rate", "needs count: how many appear in all");
    }
    if (!entry_.random)
      fail(*node, "appear", "needs place.random: where there is room is found when they appear");
    scene_.crowd.groups.back().entrance = Entrance{entry_.within, entry_.gap};
    entry_.appears = std::move(appears);
  }

  void read_place() {
    if (const toml::node* at = table_.get("at")) {
      entry_.at = point(*at);
      if (entry_.count > 1) fail(*at, "at", "must place one agent; place more of them by place");
      return;
    }
    const toml::table& random = *table_.get("place")->as_table()->get("random")->as_table();
    const toml::node& within = *random.get("within");
    entry_.random = true;
    entry_.gap = number(random, "gap", 0.0);
    if (within.is_string()) {
      entry_.within = scene_.crowd.areas[area_row(within.as_string()->get(), scene_)].region;
      return;
    }
    entry_.within = region_of(box(within));
    if (!(box(within).sizes().minCoeff() > 0.0))
      fail(within, "place.random.within",
           "must have its least x and y first, [[min x, min y], [max x, max y]]");
  }

  void fail(const toml::node& node, const std::string& key, const std::string& message) {
    report_.mark_bad(table_);
    report_.error(node, path_.text() + "." + key, message);
  }

  const toml::table& table_;
  const Path& path_;
  Scene& scene_;
  Report& report_;
  AgentEntry entry_;
};

/// What agents can't do yet, and what they need.
void check_ground(const toml::table& root, const toml::node& agents, const Scene& scene, Report& report) {
  if (const toml::node* bodies = root.get("bodies"))
    report.error(*bodies, "bodies", "not supported yet: bodies beside agents");
  if (scene.domain.kind == DomainKind::periodic)
    report.error(*root["domain"].node(), "domain", "not supported yet: agents in a periodic domain");
  if (scene.crowd.walkable.empty())
    report.error(agents, "agents", "need a floor to walk on: walkable, or domain.box");
}

}  // namespace

double Appearance::due(std::uint32_t agent) const {
  const std::uint32_t batch = agent / together;
  return times.empty() ? from + static_cast<double>(batch) * together / rate : times[batch];
}

void read_areas(const toml::table& root, Scene& scene, Report& report) {
  const Path root_path;
  if (const toml::node* node = good(root, "walkable", report)) {
    scene.crowd.walkable = read_region(*node, Path(root_path, "walkable"), report);
    for (const std::vector<Vec>& ring : scene.crowd.walkable.rings) scene.walls.push_back({ring, true, 0});
  } else if (scene.domain.kind == DomainKind::box && root.contains("agents")) {
    scene.crowd.walkable = region_of({scene.domain.min, scene.domain.max});
  }
  const toml::node* areas = root.get("areas");
  if (!areas || !areas->is_table()) return;
  const Path path(root_path, "areas");
  for (const auto& [name, node] : *areas->as_table()) {
    Area area{std::string(name.str()), {}};
    if (!report.bad(node)) area.region = read_region(node, Path(path, name.str()), report);
    scene.crowd.areas.push_back(std::move(area));
  }
}

std::vector<AgentEntry> read_agents(const toml::table& root, Scene& scene, Report& report) {
  std::vector<AgentEntry> entries;
  const toml::node* node = root.get("agents");
  if (!node || !node->is_array()) return entries;
  const Path root_path, path(root_path, "agents");
  const toml::array& list = *node->as_array();
  std::size_t total = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const toml::node& item = *list.get(i);
    if (report.bad(item)) continue;
    const Path entry(path, i);
    entries.push_back(
        AgentReader(*item.as_table(), entry, scene, report).read(static_cast<std::uint32_t>(i)));
    total += entries.back().count;
    if (total <= kMostBodies) continue;
    report.error(item, entry.text(), "makes more than " + std::to_string(kMostBodies) + " agents in all");
    return entries;
  }
  if (!entries.empty()) check_ground(root, *node, scene, report);
  return entries;
}

}  // namespace throng::scenarios
