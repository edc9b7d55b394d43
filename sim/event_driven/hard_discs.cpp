// SPDX-License-Identifier: MIT
#include "sim/event_driven/hard_discs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <utility>

#include "narrowphase/disc_flight.h"
#include "sim/contact/collide_discs.h"
#include "sim/input_error.h"
#include "sim/periodic.h"
#include "sim/prefetch.h"
#include "sim/simulation_error.h"

namespace throng {

namespace {

constexpr std::uint32_t kMostStill = 1000;                          // collisions in a row that lead nowhere
constexpr std::size_t kFetch = 8, kFetchCells = 6, kFetchNear = 3;  // events before they are needed
constexpr std::size_t kManyDiscs = 30'000;         // as many or more don't fit into the nearest caches
constexpr std::uint32_t kEventsPerLook = 1 << 14;  // between two looks at what wants the run to end

std::vector<std::uint32_t> dynamic_rows(const Bodies& bodies) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 0; row < bodies.size(); ++row)
    if (bodies.kind[row] == BodyKind::dynamic) rows.push_back(row);
  return rows;
}

double largest_radius(const Bodies& bodies, std::span<const std::uint32_t> rows) {
  double largest = 0.0;
  for (const std::uint32_t row : rows) largest = std::max(largest, bodies.radius[row]);
  return largest;
}

Eigen::AlignedBox2d box_round(const Bodies& bodies, std::span<const std::uint32_t> rows) {
  Eigen::AlignedBox2d box;
  for (const std::uint32_t row : rows) box.extend(bodies.position[row]);
  return rows.empty() ? Eigen::AlignedBox2d(Vec(0, 0), Vec(0, 0)) : box;
}

double slack(double reach) {
  return (1.0 + kTouchRounding) * reach;
}

Vec place_in(const Domain& domain, const Vec& place) {
  return domain.kind == DomainKind::periodic ? wrapped(place, domain) : place;
}

}  // namespace

HardDiscs::HardDiscs(const Scene& scene, const Plan& plan)
    : scene_(scene),
      plan_(plan),
      pull_(plan.gravity ? scene.gravity : Vec(0.0, 0.0)),
      period_(plan.periodic ? Vec(scene.domain.max - scene.domain.min) : Vec(0.0, 0.0)),
      obstacles_(obstacles(scene, largest_radius(scene.bodies, dynamic_rows(scene.bodies)))),
      bodies_(dynamic_rows(scene.bodies)),
      cells_(scene.domain, box_round(scene.bodies, bodies_),
             slack(2.0 * largest_radius(scene.bodies, bodies_)), bodies_.size()),
      soonest_(bodies_.size()),
      near_(FoldedCells::kMostAtOnce) {
  place_discs();
  refuse_overlaps();
  for (std::uint32_t disc = 0; disc < discs_.size(); ++disc) foresee(disc, 0.0, kNobody);
}

void HardDiscs::place_discs() {
  const Bodies& bodies = scene_.bodies;
  const auto cell = [&](std::uint32_t row) {
    Cell at = cells_.cell_of(place_in(scene_.domain, bodies.position[row]));
    if (plan_.periodic)  // whose last place is before the border, though by rounding in no cell
      for (int axis : {0, 1}) at.at[axis] = std::min(at.at[axis], cells_.count(axis) - 1);
    return at;
  };
  std::ranges::stable_sort(bodies_, {}, [&](std::uint32_t row) {
    const Cell at = cell(row);
    return std::pair(at.at[1], at.at[0]);
  });
  discs_.reserve(bodies_.size()), next_.reserve(bodies_.size());
  for (const std::uint32_t row : bodies_) {
    discs_.push_back({place_in(scene_.domain, bodies.position[row]), bodies.velocity[row], 0.0,
                      bodies.radius[row], bodies.spin[row], 0, row});
    next_.push_back({.cell = cell(row), .inverse_mass = 1.0 / mass(scene_, row)});
    cells_.add(static_cast<std::uint32_t>(discs_.size() - 1), cells_.slot(next_.back().cell));
  }
  cells_.list(obstacles_, slack(largest_radius(bodies, bodies_)));
  bodies_ = {};
}

/// Id of a body, or what else it is.
std::string HardDiscs::name(std::uint32_t other) const {
  return is_disc(other) ? "body " + std::to_string(body(other) + 1) : "a wall, a border or a static body";
}

void HardDiscs::refuse_overlaps() {
  const auto refuse = [&](std::uint32_t disc, std::uint32_t other, double gap) {
    if (gap >= -kTouchRounding * discs_[disc].radius) return;
    char depth[32];
    std::snprintf(depth, sizeof depth, "%.3g", -gap);
    throw InputError("engine event_driven: body " + std::to_string(body(disc) + 1) + " and " + name(other) +
                     " overlap by " + depth + " m at the beginning: hard discs can't");
  };
  for (std::uint32_t disc = 0; disc < discs_.size(); ++disc) {
    const Flying& one = discs_[disc];
    for_each_near(disc, {}, [&](std::span<const std::uint32_t> near, const Vec& shift) {
      for (const std::uint32_t other : near) {
        const Vec between = discs_[other].position + shift - one.position;
        if (other != disc) refuse(disc, other, between.norm() - one.radius - discs_[other].radius);
      }
    });
    for (const std::uint32_t row : cells_.obstacles(cells_.slot(next_[disc].cell))) {
      const auto count = static_cast<std::uint32_t>(discs_.size());
      refuse(disc, count + row,
             obstacles_.is_side(row)
                 ? narrowphase::disc_flight(one.position, one.radius, one.velocity, obstacles_.side[row]).gap
                 : narrowphase::disc_flight(one.position, one.radius, one.velocity, obstacles_.part_at(row))
                       .gap);
    }
  }
}

const Surface& HardDiscs::surface(std::uint32_t disc, std::uint32_t other) const {
  if (plan_.surfaces.size() == 1) return plan_.surfaces[0];
  const std::vector<std::uint32_t>& material = scene_.bodies.material;
  const std::uint32_t second =
      is_disc(other) ? material[body(other)] : obstacles_.material[other - discs_.size()];
  return plan_.surface(material[body(disc)], second);
}

bool HardDiscs::run_until(double time, std::vector<ContactRow>& rows, bool (*stop)()) {
  rows.clear();
  for (std::uint32_t events = 1; soonest_.time() <= time; ++events) {
    if (stop && events % kEventsPerLook == 0 && stop()) return false;
    const double now = soonest_.time();
    const std::uint32_t disc = soonest_.row();
    fetch_ahead();
    const Next& next = next_[disc];
    if (next.crossing <= next.collision)
      cross(disc);
    else if (is_disc(next.other) && discs_[next.other].had != next.had)
      foresee(disc, now, kNobody);
    else
      collide(disc, now, rows);
  }
  return true;
}

/// What will be needed of the disc.
void HardDiscs::fetch(std::uint32_t disc) const {
  prefetch(&next_[disc]), prefetch(&discs_[disc]);
  soonest_.fetch(disc);
}

/// The lists of those that will be near, and whom it meets.
void HardDiscs::fetch_cells(std::uint32_t disc) const {
  const Next& next = next_[disc];
  Cell cell = next.cell;
  cell.at[next.axis] += next.crossing <= next.collision ? next.step : 0;
  cells_.fetch(cell);
  if (is_disc(next.other)) prefetch(&discs_[next.other]), prefetch(&next_[next.other]);
}

/// Memory takes its time to answer: what will be needed is sent for. Of two who meet each has an entry, and
/// with one event both have passed: of entries none is left out.
void HardDiscs::fetch_ahead() {
  const std::size_t passed = soonest_.passed(), last = std::min(passed - std::min(sent_, passed), kFetchNear);
  for (std::size_t back = last; back-- > 0;) {
    fetch(soonest_.row_after(kFetch - back));
    if (discs_.size() < kManyDiscs) continue;
    fetch_cells(soonest_.row_after(kFetchCells - back));
    fetch_near(soonest_.row_after(kFetchNear - back));
  }
  sent_ = passed;
}

/// Those round its cell, of which it will look at most, and the lists round whom it meets.
void HardDiscs::fetch_near(std::uint32_t disc) {
  const Next& next = next_[disc];
  Cell cell = next.cell;
  const bool crosses = next.crossing <= next.collision;
  cell.at[next.axis] += crosses ? next.step : 0;
  if (!crosses && is_disc(next.other)) cells_.fetch(next_[next.other].cell);
  if (!cells_.inside(cell)) return;
  Range range;
  if (crosses) range.first[next.axis] = range.last[next.axis] = next.step;
  const std::size_t count = cells_.copy_near(cell, range.first, range.last, near_.data());
  if (count == FoldedCells::kCrowded) return;
  for (const std::uint32_t one : std::span(near_).first(count)) prefetch(&discs_[one]);
}

/// Into the next cell: three more cells are near, and other obstacles.
void HardDiscs::cross(std::uint32_t disc) {
  Next& next = next_[disc];
  Flying& one = discs_[disc];
  Cell& cell = next.cell;
  const double now = next.crossing;
  cells_.remove(disc, cells_.slot(cell));
  cell.at[next.axis] += next.step;
  if (plan_.periodic && (cell.at[next.axis] < 0 || cell.at[next.axis] == cells_.count(next.axis))) {
    cell.at[next.axis] -= next.step * cells_.count(next.axis);
    one.position[next.axis] -= next.step * period_[next.axis];
  }
  cells_.add(disc, cells_.slot(cell));
  Range range;
  range.first[next.axis] = range.last[next.axis] = next.step;
  std::array<int, 2> entered{0, 0};
  entered[next.axis] = next.step;
  foresee_crossing(disc, now, entered);
  foresee_obstacles(disc, now, kNobody);
  foresee_discs(disc, now, range, kNobody);
  set(disc);
}

/// To where it is now: there its way bends. Returns for how long it has flown (s).
double HardDiscs::advance(std::uint32_t disc, double now) {
  Flying& one = discs_[disc];
  const double flown = now - one.since;
  one.position = place(one, now);
  one.velocity = velocity(one, now);
  next_[disc].turn += flown * one.spin;
  one.since = now;
  ++one.had;
  return flown;
}

/// m/s, of the two, who touch; below 0 where they part.
double HardDiscs::closing_speed(std::uint32_t disc, std::uint32_t other, const Vec& normal) const {
  const Vec& velocity = discs_[disc].velocity;
  return normal.dot(is_disc(other) ? Vec(velocity - discs_[other].velocity) : velocity);
}

/// Of the disc, which has flown for so long (s) since its last collision. One leads nowhere where time stands
/// still, and where nobody comes nearer faster than one who fell as far as rounding may put him wrong: who
/// rests would do that for ever.
void HardDiscs::watch_for_collapse(std::uint32_t disc, std::uint32_t other, double flown, double speed) {
  constexpr double kSpacing = 4.0 * std::numeric_limits<double>::epsilon();
  const Flying& one = discs_[disc];
  const bool slow = speed * speed <= 2.0 * pull_.norm() * kTouchRounding * one.radius;
  std::uint32_t& still = next_[disc].still;
  still = slow || flown <= kSpacing * one.since ? still + 1 : 0;
  if (still < kMostStill) return;
  const bool elastic = surface(disc, other).restitution == 1.0;
  throw SimulationError(
      "at " + std::to_string(one.since) + " s body " + std::to_string(body(disc) + 1) + " and " +
      name(other) + " collide without end " +
      (elastic ? "(they touch others all round, or rest): where discs have no room between them, collisions "
                 "take no time; leave gaps, or take engine native"
               : "(inelastic collapse): hard discs come to rest on one another only in infinitely many "
                 "collisions; let the run end before, or take engine native"));
}

SolverBody HardDiscs::solver_body(std::uint32_t other) const {
  if (!is_disc(other)) return {Vec(0, 0), 0.0, 0.0, Vec(0, 0), 0.0, 0.0};
  const Flying& one = discs_[other];
  const double inverse_mass = next_[other].inverse_mass, gyration2 = 0.5 * one.radius * one.radius;
  return {one.velocity, one.spin, inverse_mass, one.position, 0.0, inverse_mass / gyration2};
}

/// From the disc to the other, which touch.
Vec HardDiscs::normal(std::uint32_t disc, std::uint32_t other) const {
  const Vec& from = discs_[disc].position;
  if (is_disc(other)) {
    const Vec way = discs_[other].position - from;
    return (plan_.periodic ? nearest_image(way, period_) : way).normalized();
  }
  const auto row = static_cast<std::uint32_t>(other - discs_.size());
  if (obstacles_.is_side(row)) return -obstacles_.side[row].normal;
  return narrowphase::towards(from, obstacles_.part_at(row));
}

void HardDiscs::collide(std::uint32_t disc, double now, std::vector<ContactRow>& rows) {
  const std::uint32_t other = next_[disc].other;
  const bool pair = is_disc(other);
  if (pair) cells_.fetch(next_[other].cell);
  const double flown = advance(disc, now), other_flown = pair ? advance(other, now) : 0.0;
  const Vec n = normal(disc, other);
  const double speed = closing_speed(disc, other, n);
  watch_for_collapse(disc, other, flown, speed);
  if (pair) watch_for_collapse(other, disc, other_flown, speed);
  SolverBody a = solver_body(disc), b = solver_body(other);
  const DiscTouch touch{n, discs_[disc].radius, pair ? discs_[other].radius : 0.0};
  const double impulse = collide_discs(a, b, touch, surface(disc, other));
  discs_[disc].velocity = a.velocity, discs_[disc].spin = a.spin;
  if (pair) discs_[other].velocity = b.velocity, discs_[other].spin = b.spin;
  if (pair)
    collisions_.add_pair(touch.radius_a + touch.radius_b, impulse, a.inverse_mass + b.inverse_mass);
  else
    ++collisions_.walls;
  rows.push_back(row(disc, other, n, impulse));
  foresee(disc, now, other);
  if (pair) foresee(other, now, disc);
}

ContactRow HardDiscs::row(std::uint32_t disc, std::uint32_t other, const Vec& normal, double impulse) const {
  const Flying& one = discs_[disc];
  std::uint32_t a = body(disc) + 1, b = is_disc(other) ? body(other) + 1 : 0;
  if (b != 0 && b < a) std::swap(a, b);
  return {a, b, impulse, place_in(scene_.domain, one.position + one.radius * normal)};
}

void HardDiscs::store(double time, State& state) const {
  for (std::uint32_t disc = 0; disc < discs_.size(); ++disc) {
    const Flying& one = discs_[disc];
    const std::uint32_t row = body(disc);
    state.position[row] = place_in(scene_.domain, place(one, time));
    state.velocity[row] = velocity(one, time);
    state.spin[row] = one.spin;
    state.angle[row] = scene_.bodies.angle[row] + (next_[disc].turn + (time - one.since) * one.spin);
    check_body(state, row);
  }
}

}  // namespace throng
