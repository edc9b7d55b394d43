// SPDX-License-Identifier: MIT
#include "scenarios/read_crowd.h"

#include <algorithm>
#include <tuple>

#include "scenarios/limits.h"
#include "scenarios/path.h"
#include "scenarios/polygon_check.h"
#include "scenarios/polygon_repair.h"
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
  Wkt read = read_wkt(wkt, WktKind::polygons);
  if (!read.refusal.empty()) return fail(read.refusal);
  if (const std::string fault = polygon_fault(wkt); !fault.empty()) {
    Region repaired = repaired_polygon(wkt);
    if (repaired.empty()) return fail(fault);
    report.warning(node.source(), path.text(),
                   fault + "; repaired: what is in its outer rings and in none of their holes, " +
                       to_text(common_area(repaired, repaired)) + " m²");
    return repaired;
  }
  Region region;
  for (WktLine& line : read.lines) {
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
    std::tie(scene_.crowd.groups.back().journey, entry_.stays) = read_journey(table_, path_, scene_, report_);
    read_place();
    read_appearance();
    return entry_;
  }

 private:
  Distribution distribution(const char* key, double preset, double least, double most) {
    return distribution(table_, path_, key, preset, least, most);
  }

  Distribution distribution(const toml::table& table, const Path& path, const char* key, double preset,
                            double least, double most) {
    const toml::node* node = table.get(key);
    if (!node) return {Distribution::Kind::fixed, preset, 0.0, least, most};
    const int errors = report_.errors();
    const Distribution result = read_distribution(*node, least, most, Path(path, key).text(), report_);
    if (report_.errors() > errors) report_.mark_bad(table_);
    return result;
  }

  void read_group(std::uint32_t index) {
    const std::string name = text(table_, "model", "");
    const auto kinds = walking_models();
    AgentGroup group;
    group.name = text(table_, "name", "");
    group.index = index;
    for (std::uint32_t row = 0; row < kinds.size(); ++row) {
      const toml::node* node = table_.get(kinds[row].name);
      if (name == kinds[row].name) {
        group.model = row;
        static const toml::table none;
        read_parameters(kinds[row], node ? *node->as_table() : none, group);
      } else if (node) {
        fail(*node, kinds[row].name,
             "belongs to another model than " + in_quotes(name) + ", which this group has");
      }
    }
    warn_of_top_speed(kinds[group.model]);
    scene_.crowd.groups.push_back(std::move(group));
  }

  /// Models may have a speed that nobody goes beyond, whatever he desires.
  void warn_of_top_speed(const ModelKind& kind) {
    const auto top = std::ranges::find(kind.parameters, std::string_view("top_speed"), &ModelParameter::key);
    if (top == kind.parameters.end()) return;
    const auto& speed = entry_.parameters[static_cast<std::size_t>(top - kind.parameters.begin())];
    const toml::node* node = table_.get("desired_speed");
    const double wanted = usual_most(entry_.desired_speed), most = usual_least(speed);
    if (wanted > most)
      report_.warning((node ? *node : table_).source(), path_.text() + ".desired_speed",
                      "is " + to_text(wanted) + " m/s for some, and nobody goes beyond " + kind.name +
                          ".top_speed, which is " + to_text(most) +
                          (speed.kind == Distribution::Kind::fixed ? "" : " for some"));
  }

  /// Where each agent has its own they are drawn when it is placed.
  void read_parameters(const ModelKind& kind, const toml::table& table, AgentGroup& group) {
    const auto preset = std::ranges::find(kind.presets, text(table, "preset", ""), &ModelPreset::name);
    const Path path(path_, kind.name);
    for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
      const ModelParameter& its = kind.parameters[i];
      const double usual = preset == kind.presets.end() ? its.preset : preset->values[i];
      entry_.parameters.push_back(distribution(table, path, its.key, usual, its.low, its.high));
      group.own = group.own || entry_.parameters.back().kind != Distribution::Kind::fixed;
    }
    if (!group.own)
      for (const Distribution& fixed : entry_.parameters) group.parameters.push_back(fixed.a);
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
    scene_.crowd.groups.back().entrance = Entrance{entry_.within, entry_.gap, appears.together};
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
      fail(within, "place.random.within", least_first(box(within)));
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
  if (scene.domain.kind == DomainKind::periodic)
    report.error(*root["domain"].node(), "domain", "not supported yet: agents in a periodic domain");
  for (const auto& [key, why] :
       {std::pair("gravity", "agents aren't drawn by it, nor is what moves beside them"),
        std::pair("contact", "models say what happens where agents touch")})
    if (const toml::node* node = root.get(key); node && (node->is_table() || scene.gravity != Vec(0.0, 0.0)))
      report.warning(node->source(), key, std::string("has no meaning: ") + why);
  const toml::node* walkable = root.get("walkable");  // where it has faults they were reported
  if (scene.crowd.walkable.empty() && !(walkable && report.bad(*walkable)))
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
