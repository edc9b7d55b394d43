// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/limits.h"
#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

namespace {

BodyKind body_kind(const std::string& word) {
  if (word == "static") return BodyKind::fixed;
  return word == "kinematic" ? BodyKind::kinematic : BodyKind::dynamic;
}

class EntryReader {
 public:
  EntryReader(const toml::table& table, const Path& path, const Scene& scene, Report& report)
      : table_(table), path_(path), scene_(scene), report_(report) {}

  Entry read() {
    entry_.node = &table_;
    entry_.shape = shape_row();
    entry_.material = material_row(table_, scene_);
    entry_.kind = body_kind(text(table_, "kind", "dynamic"));
    entry_.spin = number(table_, "spin", 0.0);
    read_angle();
    read_velocity();
    read_place();
    check_rest();
    warn_of_lone_draw();
    return entry_;
  }

 private:
  std::uint32_t shape_row() const {
    const std::string name = text(table_, "shape", "");
    const auto found =
        std::lower_bound(scene_.shapes.begin(), scene_.shapes.end(), name,
                         [](const Shape& shape, const std::string& n) { return shape.name < n; });
    return static_cast<std::uint32_t>(found - scene_.shapes.begin());
  }

  void read_angle() {
    const toml::node* node = table_.get("angle");
    if (!node) return;
    if (!node->is_table()) {
      entry_.angle = {number(*node), number(*node)};
      return;
    }
    const Vec bounds = point(*node->as_table()->get("uniform"));
    entry_.angle = {bounds.x(), bounds.y()};
    if (!(bounds.x() <= bounds.y())) fail(*node, "angle", lower_first(bounds));
  }

  void read_velocity() {
    const toml::node* node = table_.get("velocity");
    if (!node) return;
    if (node->is_table())
      entry_.maxwell = number(*node->as_table()->get("maxwell"));
    else
      entry_.velocity = point(*node);
  }

  void read_place() {
    const toml::node* count = table_.get("count");
    entry_.count = count ? static_cast<std::uint32_t>(number(*count)) : 1;
    if (const toml::node* at = table_.get("at")) {
      entry_.origin = point(*at);
      if (entry_.count > 1)
        fail(*count, "count",
             "must be 1 for bodies placed by at, and is " + std::to_string(entry_.count) +
                 "; place more of them by place");
      return;
    }
    const toml::table& place = *table_.get("place")->as_table();
    if (const toml::node* lattice = place.get("lattice")) read_lattice(*lattice->as_table(), count);
    if (const toml::node* random = place.get("random")) read_random(*random->as_table());
  }

  void read_lattice(const toml::table& lattice, const toml::node* count) {
    entry_.place = Entry::Place::lattice;
    entry_.origin = point(*lattice.get("origin"));
    entry_.spacing = point(*lattice.get("spacing"));
    const Vec size = point(*lattice.get("size"));
    const double sites = size.x() * size.y();
    if (!(sites <= kMostBodies)) {
      fail(*lattice.get("size"), "place.lattice.size",
           "must make at most " + std::to_string(kMostBodies) + " sites");
      return;
    }
    entry_.columns = static_cast<std::uint32_t>(size.x());
    if (!count) entry_.count = static_cast<std::uint32_t>(sites);
    if (entry_.count > sites)
      fail(*count, "count",
           "must be at most the " + to_text(sites) + " sites of the lattice, and is " +
               std::to_string(entry_.count));
    const Vec last = entry_.origin + entry_.spacing.cwiseProduct(size - Vec(1.0, 1.0));
    if (!(last.cwiseAbs().maxCoeff() <= kFarthest))
      fail(lattice, "place.lattice", "must end within " + to_text(kFarthest) + " m of the origin");
  }

  void read_random(const toml::table& random) {
    entry_.place = Entry::Place::random;
    entry_.within = box(*random.get("within"));
    entry_.gap = number(random, "gap", 0.0);
    if (!((entry_.within.max() - entry_.within.min()).minCoeff() > 0.0))
      fail(*random.get("within"), "place.random.within", least_first(entry_.within));
  }

  void check_rest() {
    if (entry_.kind != BodyKind::fixed) return;
    if (entry_.maxwell || entry_.velocity != Vec(0.0, 0.0))
      fail(*table_.get("velocity"), "velocity", "must be absent for a static body");
    if (entry_.spin != 0.0) fail(*table_.get("spin"), "spin", "must be absent for a static body");
  }

  void warn_of_lone_draw() {
    if (entry_.kind == BodyKind::fixed || entry_.count != 1 || !(entry_.maxwell.value_or(0.0) > 0.0)) return;
    report_.warning(table_.get("velocity")->source(), path_.text() + ".velocity",
                    "leaves a single body at rest: the entry's momentum, all that it has, is removed");
  }

  void fail(const toml::node& node, std::string_view key, std::string message) {
    report_.mark_bad(table_);
    report_.error(node, path_.text() + "." + std::string(key), std::move(message));
  }

  const toml::table& table_;
  const Path& path_;
  const Scene& scene_;
  Report& report_;
  Entry entry_;
};

}  // namespace

std::vector<Entry> read_entries(const toml::table& root, const Scene& scene, Report& report) {
  std::vector<Entry> entries;
  const toml::node* node = root.get("bodies");
  if (!node || !node->is_array()) return entries;
  const Path root_path, bodies_path(root_path, "bodies");
  const toml::array& list = *node->as_array();
  std::size_t total = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const toml::node& item = *list.get(i);
    if (report.bad(item)) continue;
    const Path path(bodies_path, i);
    Entry entry = EntryReader(*item.as_table(), path, scene, report).read();
    entry.index = i, entry.first = static_cast<std::uint32_t>(total);
    if (report.bad(item)) continue;
    total += entry.count;
    if (total > kMostBodies) {
      report.error(item, path.text(), "makes more than " + std::to_string(kMostBodies) + " bodies in all");
      return entries;
    }
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace throng::scenarios
