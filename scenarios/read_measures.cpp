// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/limits.h"
#include "scenarios/path.h"
#include "scenarios/read_crowd.h"
#include "scenarios/region_sets.h"
#include "sim/recording/observables.h"

namespace throng::scenarios {

namespace {

class MeasureReader {
 public:
  MeasureReader(const toml::table& table, const Path& path, Scene& scene, Report& report)
      : table_(table), path_(path), scene_(scene), report_(report) {}

  void read() {
    measure_.name = text(table_, "name", "");
    if (measure_.name.empty()) fail("name", "must not be empty");
    for (const Measure& other : scene_.crowd.measures)
      if (other.name == measure_.name)
        fail("name", in_quotes(measure_.name) + " is the name of another measure too");
    read_times();
    table_.contains("line") ? read_line() : read_area();
    scene_.crowd.measures.push_back(std::move(measure_));
  }

 private:
  void read_times() {
    const double from = number(table_, "from", 0.0);
    measure_.after = steps(from);
    if (table_.contains("until")) measure_.last = steps(number(*table_.get("until")));
    if (measure_.last <= measure_.after)
      fail("until", "must be at least a step after `from`, which is " + to_text(from) + " s");
  }

  /// That it takes to get there, as the end of the run is understood.
  std::int64_t steps(double time) const { return Time{scene_.time.dt, time, 1}.steps(); }

  void read_line() {
    const std::vector<Vec> ends = points(*table_.get("line"));
    measure_.line = {ends[0], ends[1]};
    if (table_.contains("voronoi")) fail("voronoi", "belongs to an area");
    if (ends[0] == ends[1]) return fail("line", "must have two different ends");
    const Region& floor = scene_.crowd.walkable;  // where it has faults they were reported
    if (!floor.empty() && !runs_through(ends[0], ends[1], floor))
      fail("line", "from " + to_text(ends[0]) + " to " + to_text(ends[1]) +
                       " is nowhere inside the walkable area: nobody can cross it");
  }

  void read_area() {
    const std::string name = text(table_, "area", "");
    for (const Area& area : scene_.crowd.areas)
      if (area.name == name) measure_.area = area.region;
    if (measure_.area.empty() || scene_.crowd.walkable.empty()) return;  // their faults were reported
    if (const toml::node* voronoi = table_.get("voronoi"))
      measure_.cutoff = number(*voronoi->as_table(), "cutoff", 1.0);
    find_ground(scene_.crowd.walkable, measure_);
    if (!(measure_.size > 0.0)) fail("area", "has nothing in common with the walkable area");
  }

  void fail(std::string_view key, std::string message) {
    const toml::node* node = table_.get(key);
    report_.error(node ? *node : table_, path_.text() + "." + std::string(key), std::move(message));
  }

  const toml::table& table_;
  const Path& path_;
  Scene& scene_;
  Report& report_;
  Measure measure_;
};

}  // namespace

void find_ground(const Region& walkable, Measure& measure) {
  measure.size = common_area(measure.area, walkable);
  if (measure.cutoff > 0.0) measure.ground = common(measure.area, walkable);
}

void read_measures(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = root.get("measure");
  if (!node || !node->is_array()) return;
  if (!root.contains("agents"))
    return report.error(*node, "measure", "counts agents, and there are none: it needs [[agents]]");
  const Path root_path, path(root_path, "measure");
  const toml::array& list = *node->as_array();
  if (list.size() > recording::kMostMeasures)
    return report.error(*node, "measure",
                        "must be at most " + std::to_string(recording::kMostMeasures) + ", and are " +
                            std::to_string(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const Path entry(path, i); !report.bad(*list.get(i)))
      MeasureReader(*list.get(i)->as_table(), entry, scene, report).read();
}

}  // namespace throng::scenarios
