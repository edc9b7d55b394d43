// SPDX-License-Identifier: MIT
#include "sim/sensing/sensing.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "broadphase/all_lists.h"
#include "sim/periodic.h"
#include "sim/sensing/body_screens.h"
#include "sim/sensing/heading.h"
#include "sim/sensing/sight.h"
#include "sim/workers.h"

namespace throng {

using broadphase::FieldOfView;

struct Sensing::Impl {
  Impl(const Scene& its_scene, int its_threads);

  void look(const State& state);
  void take(const State& state);
  void choose(const Sensor& sensor);
  void find_lists(const Sensor& sensor);
  void drop_unsensed(const Sensor& sensor);
  void store(Sensed& sensed) const;
  bool is_seen(const Sensor& sensor, std::uint32_t from, std::uint32_t to) const;
  const broadphase::Period* its_period() const { return period ? &*period : nullptr; }

  const Scene& scene;
  int threads;
  Workers workers;
  std::optional<broadphase::Period> period;
  std::optional<Sight> walls;          // where any sensor heeds them
  std::optional<BodyScreens> screens;  // likewise
  bool needs_tree = false;
  std::vector<Sensed> sensed;

  // Of the step: those who are there, ascending by id.
  std::vector<std::uint32_t> order, id;
  std::vector<Vec> position, velocity;
  std::vector<double> angle;
  broadphase::ProximityTree tree;

  // Of the sensor: who has it, by rows of these, and whom each senses.
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};
  std::vector<std::uint32_t> has;
  std::vector<Vec> at, heading;
  broadphase::AllLists all;
  broadphase::NeighbourSearch search;
  broadphase::NeighbourLists lists;
};

Sensing::Impl::Impl(const Scene& its_scene, int its_threads)
    : scene(its_scene),
      threads(its_threads),
      workers(its_threads),
      sensed(its_scene.sensors.size()),
      all(its_threads) {
  if (scene.domain.kind == DomainKind::periodic)
    period = {scene.domain.min, scene.domain.max - scene.domain.min};
  bool sees = false;
  double farthest = 0.0;
  for (const Sensor& sensor : scene.sensors) {
    sees = sees || sensor.screens != Screens::none;
    if (sensor.screens != Screens::none) farthest = std::max(farthest, sensor.radius);
    if (sensor.screens == Screens::bodies && !screens) screens.emplace(scene);
    if (screens || sensor.fov < 360.0 || !sensor.ids.empty()) needs_tree = true;
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
  id.resize(n), position.resize(n), velocity.resize(n), angle.resize(n);
  for (std::size_t row = 0; row < n; ++row) {
    const std::uint32_t from = order[row];
    id[row] = state.id[from], angle[row] = state.angle[from], velocity[row] = state.velocity[from];
    position[row] = period ? wrapped(state.position[from], scene.domain) : state.position[from];
  }
  if (needs_tree) tree.build(position, its_period());
  if (screens) screens->place(id, position, angle, tree);
}

void Sensing::Impl::choose(const Sensor& sensor) {
  has.clear();
  for (std::uint32_t row = 0; row < id.size(); ++row)
    if (sensor.ids.empty() || std::ranges::binary_search(sensor.ids, id[row])) has.push_back(row);
}

/// In rows, in any order, with the one who asks or without.
void Sensing::Impl::find_lists(const Sensor& sensor) {
  const FieldOfView view = field_of_view(sensor.fov);
  if (view.all_around() && has.size() == id.size())
    return all.find(position, sensor.radius, its_period(), lists);
  at.clear(), heading.clear();
  for (const std::uint32_t row : has) {
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

/// Leaves each list in order of rows, with kNobody in place of those who are not sensed.
void Sensing::Impl::drop_unsensed(const Sensor& sensor) {
  workers.for_ranges(has.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::span<std::uint32_t> list =
          std::span(lists.row).subspan(lists.begin[i], lists.begin[i + 1] - lists.begin[i]);
      std::ranges::sort(list);
      for (std::uint32_t& row : list)
        if (row == has[i] || !is_seen(sensor, has[i], row)) row = kNobody;
    }
  });
}

void Sensing::Impl::store(Sensed& to) const {
  for (std::size_t i = 0; i < has.size(); ++i) {
    const std::size_t before = to.whom.size();
    for (std::size_t k = lists.begin[i]; k < lists.begin[i + 1]; ++k)
      if (lists.row[k] != kNobody) to.whom.push_back(id[lists.row[k]]);
    to.who.push_back(id[has[i]]);
    to.count.push_back(static_cast<std::uint32_t>(to.whom.size() - before));
  }
}

void Sensing::Impl::look(const State& state) {
  bool is_taken = false;
  for (std::size_t i = 0; i < sensed.size(); ++i) {
    const Sensor& sensor = scene.sensors[i];
    sensed[i].clear();
    if (!is_due(sensor.every, state.step)) continue;
    if (!is_taken) take(state);
    is_taken = true;
    choose(sensor);
    find_lists(sensor);
    drop_unsensed(sensor);
    store(sensed[i]);
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
  for (std::size_t i = 0; i < impl_->sensed.size(); ++i) {
    state.sensed[i].looks += static_cast<std::int64_t>(impl_->sensed[i].who.size());
    state.sensed[i].sensed += static_cast<std::int64_t>(impl_->sensed[i].whom.size());
  }
}

std::span<const Sensed> Sensing::sensed() const {
  return impl_ ? std::span<const Sensed>(impl_->sensed) : std::span<const Sensed>();
}

}  // namespace throng
