// SPDX-License-Identifier: MIT
#include "sim/sensing/sensing.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "broadphase/neighbours.h"
#include "sim/periodic.h"
#include "sim/sensing/body_screens.h"
#include "sim/sensing/heading.h"
#include "sim/sensing/sight.h"
#include "sim/workers.h"

namespace throng {

using broadphase::FieldOfView;

namespace {

/// Who asks at a time: the answers of all would take six times the memory of what is kept of them.
constexpr std::size_t kBlock = 4096;

}  // namespace

struct Sensing::Impl {
  Impl(const Scene& its_scene, int its_threads);

  void look(const State& state);
  void take(const State& state);
  void choose(const Sensor& sensor);
  void find_lists(const Sensor& sensor, std::size_t first, std::size_t count);
  void drop_unsensed(const Sensor& sensor, std::size_t first);
  void store(std::size_t first, Sensed& to) const;
  bool is_seen(const Sensor& sensor, std::uint32_t from, std::uint32_t to) const;
  SensedSum look_with(const Sensor& sensor, Sensed* found);
  const broadphase::Period* its_period() const { return period ? &*period : nullptr; }

  const Scene& scene;
  int threads;
  Workers workers;
  std::optional<broadphase::Period> period;
  std::optional<Sight> walls;          // where any sensor heeds them
  std::optional<BodyScreens> screens;  // likewise
  bool needs_headings = false;
  std::vector<Sensed> sensed;   // of each recorded sensor
  std::vector<SensedSum> last;  // of each sensor, of one look

  // Of the step: those who are there, ascending by id.
  std::vector<std::uint32_t> order, id;
  std::vector<Vec> position, velocity;
  std::vector<double> angle;
  broadphase::ProximityTree tree;
  bool is_placed = false;  // of the screens

  // Of the sensor: who has it, by rows of these, and whom some of them sense.
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};
  std::vector<std::uint32_t> has;
  std::vector<Vec> at, heading;
  broadphase::NeighbourSearch search;
  broadphase::NeighbourLists lists;
};

Sensing::Impl::Impl(const Scene& its_scene, int its_threads)
    : scene(its_scene),
      threads(its_threads),
      workers(its_threads),
      sensed(its_scene.record.sensors.size()),
      last(its_scene.sensors.size()) {
  if (scene.domain.kind == DomainKind::periodic)
    period = {scene.domain.min, scene.domain.max - scene.domain.min};
  bool sees = false;
  double farthest = 0.0;
  for (const Sensor& sensor : scene.sensors) {
    sees = sees || sensor.screens != Screens::none;
    if (sensor.screens != Screens::none) farthest = std::max(farthest, sensor.radius);
    if (sensor.screens == Screens::bodies && !screens) screens.emplace(scene);
    needs_headings = needs_headings || sensor.fov < 360.0;
  }
  if (sees) walls.emplace(scene.walls, period, farthest);
}

/// Rows move from step to step, ids name.
void Sensing::Impl::take(const State& state) {
  const std::size_t n = state.id.size();
  order.resize(n);
  std::iota(order.begin(), order.end(), 0u);
  if (!std::ranges::is_sorted(state.id))
    std::ranges::sort(order, {}, [&](std::uint32_t row) { return state.id[row]; });
  const auto bring = [&](const auto& from, auto& to) {
    to.resize(n);
    for (std::size_t row = 0; row < n; ++row) to[row] = from[order[row]];
  };
  bring(state.id, id), bring(state.position, position);
  if (needs_headings) bring(state.velocity, velocity);
  if (needs_headings || screens) bring(state.angle, angle);
  if (period)
    for (Vec& p : position) p = wrapped(p, scene.domain);
  tree.build(position, its_period());
  is_placed = false;
}

void Sensing::Impl::choose(const Sensor& sensor) {
  has.clear();
  for (std::uint32_t row = 0; row < id.size(); ++row)
    if (sensor.ids.empty() || std::ranges::binary_search(sensor.ids, id[row])) has.push_back(row);
}

/// Of some who have it: in rows, in any order, with the one who asks.
void Sensing::Impl::find_lists(const Sensor& sensor, std::size_t first, std::size_t count) {
  const FieldOfView view = field_of_view(sensor.fov);
  at.clear(), heading.clear();
  for (const std::uint32_t row : std::span(has).subspan(first, count)) {
    at.push_back(position[row]);
    if (!view.all_around())
      heading.push_back(throng::heading(scene.bodies.kind[id[row] - 1], angle[row], velocity[row]));
  }
  search.find(tree, {.at = at, .heading = heading}, {.radius = sensor.radius, .view = view}, lists, threads);
}

bool Sensing::Impl::is_seen(const Sensor& sensor, std::uint32_t from, std::uint32_t to) const {
  if (sensor.screens == Screens::none) return true;
  if (!walls->sees(position[from], position[to])) return false;
  return sensor.screens == Screens::walls || !screens->hide(position[from], from, to);
}

/// Puts kNobody in place of those who are not sensed; leaves lists that are recorded in order of rows.
void Sensing::Impl::drop_unsensed(const Sensor& sensor, std::size_t first) {
  workers.for_ranges(lists.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t own = has[first + i];
      const std::span<std::uint32_t> list =
          std::span(lists.row).subspan(lists.begin[i], lists.begin[i + 1] - lists.begin[i]);
      if (sensor.record) std::ranges::sort(list);
      for (std::uint32_t& row : list)
        if (row == own || !is_seen(sensor, own, row)) row = kNobody;
    }
  });
}

void Sensing::Impl::store(std::size_t first, Sensed& to) const {
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const std::size_t before = to.whom.size();
    for (std::size_t k = lists.begin[i]; k < lists.begin[i + 1]; ++k)
      if (lists.row[k] != kNobody) to.whom.push_back(id[lists.row[k]]);
    to.who.push_back(id[has[first + i]]);
    to.count.push_back(static_cast<std::uint32_t>(to.whom.size() - before));
  }
}

/// Whom it senses is kept where it is recorded, else counted alone.
SensedSum Sensing::Impl::look_with(const Sensor& sensor, Sensed* found) {
  if (sensor.screens == Screens::bodies && !is_placed) screens->place(id, position, angle), is_placed = true;
  choose(sensor);
  std::size_t sum = 0, count = 0;
  for (std::size_t first = 0; first < has.size(); first += count) {
    count = std::min(kBlock, has.size() - first);
    find_lists(sensor, first, count);
    const bool is_all = !found && sensor.screens == Screens::none;  // but who asks
    if (!is_all) drop_unsensed(sensor, first);
    if (found) store(first, *found);
    sum += is_all ? lists.row.size() - count
                  : lists.row.size() - static_cast<std::size_t>(std::ranges::count(lists.row, kNobody));
  }
  return {static_cast<std::int64_t>(has.size()), static_cast<std::int64_t>(sum)};
}

void Sensing::Impl::look(const State& state) {
  bool is_taken = false;
  std::size_t recorded = 0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    const Sensor& sensor = scene.sensors[i];
    Sensed* const found = sensor.record ? &sensed[recorded++] : nullptr;
    if (found) found->clear();
    last[i] = {};
    if (!is_due(sensor.every, state.step)) continue;
    if (!is_taken) take(state);
    is_taken = true;
    last[i] = look_with(sensor, found);
  }
}

Sensing::Sensing(const Scene& scene, int threads)
    : impl_(scene.sensors.empty() ? nullptr : std::make_unique<Impl>(scene, threads)) {}
Sensing::~Sensing() = default;

void Sensing::look(const State& state) {
  if (impl_) impl_->look(state);
}

void Sensing::sense(State& state) {
  if (!impl_) return;
  impl_->look(state);
  for (std::size_t i = 0; i < impl_->last.size(); ++i) {
    state.sensed[i].looks += impl_->last[i].looks;
    state.sensed[i].sensed += impl_->last[i].sensed;
  }
}

std::span<const Sensed> Sensing::sensed() const {
  return impl_ ? std::span<const Sensed>(impl_->sensed) : std::span<const Sensed>();
}

}  // namespace throng
