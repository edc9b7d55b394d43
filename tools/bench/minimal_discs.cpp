// SPDX-License-Identifier: MIT
#include "tools/bench/minimal_discs.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/solve.h"

namespace throng::bench {

namespace {

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{a} << 32 | b;
}

/// A disc may get as far within dt as its velocity and gravity take it, and be hit by the fastest one.
double margin(const Vec& velocity, double radius, double dt, double fall, double chain) {
  return velocity.norm() * dt + fall + std::min(chain, 0.1 * radius);
}

}  // namespace

MinimalDiscs::MinimalDiscs(const Scene& scene) : scene_(scene) {
  const std::size_t n = scene.bodies.size();
  h_ = scene.time.dt / scene.time.substeps;
  const Softness soft = softness(0.18 / h_, 20.0, h_);
  bias_rate_ = soft.bias_rate, mass_scale_ = soft.mass_scale, impulse_scale_ = soft.impulse_scale;
  friction_ = scene.materials[0].friction;
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec &p = scene.bodies.position[i], &v = scene.bodies.velocity[i];
    bodies_.push_back({p.x(), p.y(), v.x(), v.y(), scene.bodies.spin[i], 0.0, 1.0 / mass(scene, i),
                       1.0 / inertia(scene, i)});
    radius_.push_back(scene.bodies.radius[i]);
    sum += radius_.back();
  }
  bodies_.push_back({});
  push_out_ = 2.0 * sum / static_cast<double>(n);
  angle_ = scene.bodies.angle;
  reach_.resize(n), cell_of_.resize(n), by_cell_.resize(n);
}

/// All pairs within reach, ascending: a dense grid of cells as wide as the widest pair, points sorted into
/// it, then half of each cell's neighbours.
void MinimalDiscs::find_pairs() {
  const std::size_t n = radius_.size();
  const double dt = scene_.time.dt, fall = scene_.gravity.norm() * dt * dt;
  double fastest = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    fastest = std::max(fastest, bodies_[i].vx * bodies_[i].vx + bodies_[i].vy * bodies_[i].vy);
  for (std::size_t i = 0; i < n; ++i)
    reach_[i] =
        radius_[i] + margin({bodies_[i].vx, bodies_[i].vy}, radius_[i], dt, fall, std::sqrt(fastest) * dt);
  const double cell = 2.0 * *std::max_element(reach_.begin(), reach_.end());
  const Vec origin = scene_.domain.min - Vec(cell, cell), size = scene_.domain.max - origin + Vec(cell, cell);
  const auto columns = static_cast<int>(size.x() / cell) + 2, rows = static_cast<int>(size.y() / cell) + 2;
  const auto index = [&](double x, double from, int count) {
    return std::clamp(static_cast<int>((x - from) / cell), 0, count - 1);
  };
  cell_start_.assign(static_cast<std::size_t>(columns * rows) + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    cell_of_[i] = static_cast<std::uint32_t>(index(bodies_[i].y, origin.y(), rows) * columns +
                                             index(bodies_[i].x, origin.x(), columns));
    ++cell_start_[cell_of_[i] + 1];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  std::vector<std::uint32_t>& next = row_start_;
  next.assign(cell_start_.begin(), cell_start_.end());
  for (std::size_t i = 0; i < n; ++i) by_cell_[next[cell_of_[i]]++] = static_cast<std::uint32_t>(i);

  met_.clear();
  const auto test = [&](std::uint32_t i, std::uint32_t j) {
    const double x = bodies_[i].x - bodies_[j].x, y = bodies_[i].y - bodies_[j].y, r = reach_[i] + reach_[j];
    if (x * x + y * y <= r * r) met_.push_back(std::minmax(i, j));
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto here = static_cast<std::size_t>(row * columns + column);
      for (std::uint32_t i = cell_start_[here]; i < cell_start_[here + 1]; ++i) {
        for (std::uint32_t j = i + 1; j < cell_start_[here + 1]; ++j) test(by_cell_[i], by_cell_[j]);
        if (column + 1 < columns)
          for (std::uint32_t j = cell_start_[here + 1]; j < cell_start_[here + 2]; ++j)
            test(by_cell_[i], by_cell_[j]);
        if (row + 1 == rows) continue;
        const std::size_t above = here + static_cast<std::size_t>(columns);
        const std::size_t from = column > 0 ? above - 1 : above,
                          to = column + 1 < columns ? above + 1 : above;
        for (std::uint32_t j = cell_start_[from]; j < cell_start_[to + 1]; ++j)
          test(by_cell_[i], by_cell_[j]);
      }
    }
  row_start_.assign(n + 1, 0);
  for (const auto& pair : met_) ++row_start_[pair.first + 1];
  for (std::size_t i = 1; i <= n; ++i) row_start_[i] += row_start_[i - 1];
  pairs_.resize(met_.size());
  for (const auto& pair : met_) pairs_[row_start_[pair.first]++] = pair;
  for (std::size_t i = 0, begin = 0; i < n; begin = row_start_[i++])
    std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(begin), pairs_.begin() + row_start_[i]);
}

MinimalDiscs::Contact MinimalDiscs::contact(std::uint32_t a, std::uint32_t b, double radius_a,
                                            double radius_b) const {
  const Body &body_a = bodies_[a], &body_b = bodies_[b];
  const double masses = body_a.inverse_mass + body_b.inverse_mass;
  const double turns =
      body_a.inverse_inertia * radius_a * radius_a + body_b.inverse_inertia * radius_b * radius_b;
  return {a, b, 1.0, 0.0, 0.0, 1.0 / masses, 1.0 / (masses + turns), radius_a, radius_b, 0.0, 0.0};
}

void MinimalDiscs::recall(const std::vector<Kept>& kept, std::size_t& next, std::uint64_t key,
                          Contact& contact) const {
  while (next < kept.size() && kept[next].key < key) ++next;
  if (next == kept.size() || kept[next].key != key) return;
  contact.normal_impulse = kept[next].normal;
  contact.tangent_impulse = kept[next].tangent;
}

void MinimalDiscs::find_contacts() {
  std::size_t next = 0;
  pairs_contacts_.clear(), pair_keys_.clear();
  for (const auto& [a, b] : pairs_) {
    pairs_contacts_.push_back(contact(a, b, radius_[a], radius_[b]));
    pair_keys_.push_back(key_of(a, b));
    recall(pair_kept_, next, pair_keys_.back(), pairs_contacts_.back());
  }
}

void MinimalDiscs::find_wall_contacts() {
  const Domain& box = scene_.domain;
  const double planes[4][3] = {
      {1, 0, -box.min.x()}, {-1, 0, box.max.x()}, {0, 1, -box.min.y()}, {0, -1, box.max.y()}};
  const auto wall = static_cast<std::uint32_t>(radius_.size());
  std::size_t next = 0;
  wall_contacts_.clear(), wall_keys_.clear();
  for (std::uint32_t i = 0; i < wall; ++i)
    for (std::uint32_t side = 0; side < 4; ++side) {
      const auto& [nx, ny, offset] = planes[side];
      const double height = nx * bodies_[i].x + ny * bodies_[i].y + offset;
      if (height > reach_[i]) continue;
      Contact c = contact(i, wall, radius_[i], 0.0);
      c.nx = -nx, c.ny = -ny;
      c.offset = offset - radius_[i];  // separation = offset + n . (0 - position), n into the wall
      wall_keys_.push_back(key_of(i, side));
      recall(wall_kept_, next, wall_keys_.back(), c);
      wall_contacts_.push_back(c);
    }
}

void MinimalDiscs::prepare() {
  for (Contact& c : pairs_contacts_) {
    const double x = bodies_[c.b].x - bodies_[c.a].x, y = bodies_[c.b].y - bodies_[c.a].y;
    const double distance = std::sqrt(x * x + y * y);
    c.nx = x / distance, c.ny = y / distance;
    c.offset = -(c.radius_a + c.radius_b);
  }
}

namespace {

template <class Body, class Contact>
void apply(Body& a, Body& b, const Contact& c, double normal, double tangent) {
  const double x = normal * c.nx - tangent * c.ny, y = normal * c.ny + tangent * c.nx;
  a.vx -= a.inverse_mass * x, a.vy -= a.inverse_mass * y;
  b.vx += b.inverse_mass * x, b.vy += b.inverse_mass * y;
  a.spin -= a.inverse_inertia * c.radius_a * tangent;
  b.spin -= b.inverse_inertia * c.radius_b * tangent;
}

}  // namespace

void MinimalDiscs::warm_start(std::vector<Contact>& contacts) {
  for (const Contact& c : contacts) {
    if (c.normal_impulse > 0.0) apply(bodies_[c.a], bodies_[c.b], c, c.normal_impulse, c.tangent_impulse);
  }
}

template <bool kBiased>
void MinimalDiscs::sweep(std::vector<Contact>& contacts) {
  for (Contact& c : contacts) {
    Body &a = bodies_[c.a], &b = bodies_[c.b];
    const double s = c.offset + (c.nx * (b.x - a.x) + c.ny * (b.y - a.y));
    if (!kBiased && c.normal_impulse == 0.0) continue;
    const double speed = (b.vx - a.vx) * c.nx + (b.vy - a.vy) * c.ny;
    const double slip =
        (b.vy - a.vy) * c.nx - (b.vx - a.vx) * c.ny - (a.spin * c.radius_a + b.spin * c.radius_b);
    const double old = c.normal_impulse, old_rub = c.tangent_impulse;
    double wanted;
    if (kBiased && s <= 0.0)
      wanted = old - c.normal_mass * mass_scale_ * (speed + std::max(s * bias_rate_, -push_out_)) -
               impulse_scale_ * (push_out_ / std::max(-s * bias_rate_, push_out_)) * old;
    else
      wanted = old - c.normal_mass * (speed + std::max(s, 0.0) * (1.0 / h_));
    c.normal_impulse = std::max(wanted, 0.0);
    const double limit = friction_ * c.normal_impulse;
    c.tangent_impulse = std::clamp(old_rub - c.tangent_mass * slip, -limit, limit);
    apply(a, b, c, c.normal_impulse - old, c.tangent_impulse - old_rub);
  }
}

void MinimalDiscs::keep() {
  const auto copy = [](const auto& contacts, const auto& keys, auto& kept) {
    kept.clear();
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (contacts[i].normal_impulse > 0.0)
        kept.push_back({keys[i], contacts[i].normal_impulse, contacts[i].tangent_impulse});
  };
  copy(pairs_contacts_, pair_keys_, pair_kept_);
  copy(wall_contacts_, wall_keys_, wall_kept_);
}

void MinimalDiscs::step() {
  find_pairs();
  find_contacts();
  find_wall_contacts();
  const double kick_x = h_ * scene_.gravity.x(), kick_y = h_ * scene_.gravity.y();
  for (int i = 0; i < scene_.time.substeps; ++i) {
    prepare();
    for (std::size_t row = 0; row + 1 < bodies_.size(); ++row)
      bodies_[row].vx += kick_x, bodies_[row].vy += kick_y;
    warm_start(pairs_contacts_), warm_start(wall_contacts_);
    sweep<true>(pairs_contacts_), sweep<true>(wall_contacts_);
    for (Body& body : bodies_) body.x += h_ * body.vx, body.y += h_ * body.vy, body.turn += h_ * body.spin;
    sweep<false>(pairs_contacts_), sweep<false>(wall_contacts_);
  }
  for (std::size_t row = 0; row < angle_.size(); ++row)
    angle_[row] += bodies_[row].turn, bodies_[row].turn = 0.0;
  keep();
  ++step_;
}

State MinimalDiscs::state() const {
  State state = initial_state(scene_);
  state.step = step_;
  state.angle = angle_;
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    state.position[i] = {bodies_[i].x, bodies_[i].y};
    state.velocity[i] = {bodies_[i].vx, bodies_[i].vy};
    state.spin[i] = bodies_[i].spin;
  }
  return state;
}

}  // namespace throng::bench
