// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "scenarios/limits.h"
#include "scenarios/read.h"
#include "sim/recording/packed.h"
#include "sim/recording/selection.h"

namespace throng::scenarios {

namespace {

RecordField field_of(const toml::node& entry) {
  const auto found = std::ranges::find(kRecordFieldName, entry.as_string()->get());
  return static_cast<RecordField>(found - kRecordFieldName.begin());
}

void read_fields(const toml::table& table, Record& record, Report& report) {
  if (!table.contains("fields")) return;
  for (RecordField field : kRecordFields) flag(record, field) = false;
  for (const toml::node& entry : *table.get("fields")->as_array()) {
    bool& is_recorded = flag(record, field_of(entry));
    if (is_recorded)
      report.error(entry, "record.fields", in_quotes(entry.as_string()->get()) + " stands there twice");
    is_recorded = true;
  }
}

/// A field has one rate.
void read_also(const toml::table& table, Record& record, Report& report) {
  if (!table.contains("also")) return;
  std::size_t index = 0;
  for (const toml::node& stream : *table.get("also")->as_array()) {
    const toml::table& entry = *stream.as_table();
    for (const toml::node& name : *entry.get("fields")->as_array()) {
      const RecordField field = field_of(name);
      if (flag(record, field))
        report.error(name, "record.also[" + std::to_string(index) + "].fields",
                     in_quotes(throng::name(field)) + " is recorded already, each " +
                         std::to_string(every(record, field)) +
                         " steps; must stand in one list of fields only");
      flag(record, field) = true;
      record.own_every[throng::index(field)] = static_cast<int>(number(*entry.get("every")));
    }
    ++index;
  }
}

void read_region(const toml::table& table, Record& record, Report& report) {
  const toml::node* node = table.get("within");
  if (!node) return;
  record.within = box(*node);
  if (!((record.within->max() - record.within->min()).minCoeff() >= kShortestEdge))
    report.error(*node, "record.within", least_first(*record.within));
}

void read_quantum(const toml::table& table, Record& record, Report& report) {
  const toml::node* node = table.get("quantize");
  if (!node) return;
  record.quantum = number(*node);
  if (!record.position) report.error(*node, "record.quantize", "rounds positions, which are not in fields");
}

/// Whether `value` is what `key` says, or one of its list; true without the key.
template <class Same>
bool fits(const toml::table& of, const char* key, Same same) {
  const toml::node* node = of.get(key);
  if (!node) return true;
  if (const toml::array* list = node->as_array())
    return std::any_of(list->begin(), list->end(), [&](const toml::node& one) { return same(one); });
  return same(*node);
}

/// Whether the body of this row is an agent of one of these groups.
bool is_of_group(const toml::table& of, const Crowd& crowd, std::size_t row) {
  return fits(of, "group", [&](const toml::node& name) {
    return crowd.size() > 0 && row >= crowd.first &&
           crowd.groups[crowd.group[row - crowd.first]].name == name.as_string()->get();
  });
}

bool is_chosen(const toml::table& of, const Scene& scene, std::size_t row) {
  constexpr const char* kinds[] = {"dynamic", "static", "kinematic", "agent"};
  const Bodies& bodies = scene.bodies;
  const auto is = [](const std::string& name) {
    return [&name](const toml::node& one) { return one.as_string()->get() == name; };
  };
  return fits(of, "shape", is(scene.shapes[bodies.shape[row]].name)) &&
         fits(of, "material", is(scene.materials[bodies.material[row]].name)) &&
         fits(of, "kind", is(kinds[static_cast<int>(bodies.kind[row])])) && is_of_group(of, scene.crowd, row);
}

/// Reports names that no entry of agents has.
void expect_groups(const toml::table& of, const std::string& path, const Crowd& crowd, Report& report) {
  std::vector<std::string> known;
  for (const AgentGroup& group : crowd.groups)
    if (!group.name.empty()) known.push_back(group.name);
  const auto expect = [&](const toml::node& node) {
    const std::string& name = node.as_string()->get();
    if (std::ranges::find(known, name) != known.end()) return;
    report.error(node, path + ".group",
                 "no [[agents]] are called " + in_quotes(name) +
                     (known.empty() ? ": none have a name" : nearest_or_all(name, known)));
  };
  const toml::node* node = of.get("group");
  if (!node) return;
  if (!node->is_array()) return expect(*node);
  for (const toml::node& one : *node->as_array()) expect(one);
}

/// Ids in the order of the rows; all rows without any.
std::vector<std::uint32_t> candidates(const toml::table& of, const std::string& path, const Scene& scene,
                                      Report& report) {
  std::vector<std::uint32_t> ids;
  const toml::node* node = of.get("ids");
  for (std::uint32_t id = 1; !node && id <= scene.bodies.size(); ++id) ids.push_back(id);
  if (!node) return ids;
  for (const toml::node& entry : *node->as_array()) {
    ids.push_back(static_cast<std::uint32_t>(number(entry)));
    if (ids.back() <= scene.bodies.size()) continue;
    report.error(entry, path + ".ids",
                 "there is no body " + std::to_string(ids.back()) + "; ids go from 1 to " +
                     std::to_string(scene.bodies.size()));
    return {};
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace

void read_record(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = good(root, "record", report);
  if (!node) return;
  const toml::table& table = *node->as_table();
  Record& record = scene.record;
  record.every = static_cast<int>(number(table, "every", record.every));
  record.observables = static_cast<int>(number(table, "observables", 0.0));
  record.single = text(table, "precision", "double") == "single";
  read_fields(table, record, report);
  read_also(table, record, report);
  read_region(table, record, report);
  read_quantum(table, record, report);
}

void check_region(const toml::table& root, const Scene& scene, Report& report) {
  const std::optional<Eigen::AlignedBox2d>& within = scene.record.within;
  const bool is_bounded = scene.domain.kind != DomainKind::unbounded || !scene.crowd.walkable.empty();
  if (!within || !is_bounded || within->intersects(recording::place_of_bodies(scene))) return;
  report.warning(root["record"]["within"].node()->source(), "record.within",
                 std::string("is wholly outside of the ") +
                     (scene.domain.kind != DomainKind::unbounded ? "domain" : "walkable area") +
                     ": nobody is recorded whom its border holds");
}

void check_quantum(const toml::table& root, const Scene& scene, Report& report) {
  const Record& record = scene.record;
  if (!(record.quantum > 0.0)) return;
  const bool is_bounded = scene.domain.kind != DomainKind::unbounded;
  Eigen::AlignedBox2d place = recording::place_of_bodies(scene);
  if (record.within) place = is_bounded ? place.intersection(*record.within) : *record.within;
  if (place.isEmpty()) return;
  const double farthest = std::max(place.min().cwiseAbs().maxCoeff(), place.max().cwiseAbs().maxCoeff());
  const double least = recording::least_quantum(farthest);
  if (record.quantum >= least) return;
  char text[120];
  std::snprintf(text, sizeof text,
                "is too fine where positions go up to %.6g m from 0: must be at least %.2g m", farthest,
                least);
  report.error(*root["record"]["quantize"].node(), "record.quantize", text);
}

void warn_of_empty_record(const toml::table& root, const Scene& scene, Report& report) {
  const Record& record = scene.record;
  const auto recorded = [&](RecordField field) { return is_recorded(record, field); };
  if (record.observables > 0 || !record.sensors.empty() || std::ranges::any_of(kRecordFields, recorded))
    return;
  report.warning(root["record"]["fields"].node()->source(), "record.fields",
                 "is empty, and nothing else is recorded: frames hold step, time and the state's hash, for "
                 "replay --verify");
}

std::vector<std::uint32_t> fitting_ids(const toml::table& of, const std::string& path, const Scene& scene,
                                       Report& report) {
  std::vector<std::uint32_t> ids;
  const int before = report.errors();
  expect_groups(of, path, scene.crowd, report);
  for (std::uint32_t id : candidates(of, path, scene, report))
    if (is_chosen(of, scene, id - 1)) ids.push_back(id);
  if (ids.empty() && report.errors() == before) report.error(of, path, "fits no body");
  return ids;
}

void read_recorded_bodies(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = good(root, "record", report);
  const toml::node* of = node ? node->as_table()->get("of") : nullptr;
  if (!of || report.errors() > 0) return;
  std::vector<std::uint32_t>& ids = scene.record.ids;
  ids = fitting_ids(*of->as_table(), "record.of", scene, report);
  if (ids.size() == scene.bodies.size()) ids.clear();
}

}  // namespace throng::scenarios
