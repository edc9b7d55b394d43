// SPDX-License-Identifier: MIT
#include "sim/sleepers.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/distance.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/list_contacts.h"

namespace throng {

namespace {

constexpr double kLift = 1e-5;          // of the radius: the height to which what is slow could rise
constexpr double kLeastPatience = 0.5;  // s, at least
constexpr double kFalls = 2.5;          // times sqrt(radius / g)
constexpr double kClear = 0.5;          // of the radius: how much farther than a step one looks
constexpr double kEvery = 0.1;          // s, between two looks for islands at rest
constexpr double kGain = 1e-6;          // of gravity: what gains speed faster isn't at rest

bool by_key(const SleepingContact& a, const SleepingContact& b) {
  return a.impulse.key < b.impulse.key;
}

/// Moves those whose bodies sleep to them. `rows`: of those awake. `island_of(key)`: 0 where they don't.
template <class F>
void put_aside(std::vector<ContactImpulse>& awake, std::span<const ContactRow> rows,
               std::vector<SleepingContact>& asleep, F island_of) {
  const auto before = static_cast<std::ptrdiff_t>(asleep.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < awake.size(); ++i) {
    const std::uint32_t island = island_of(awake[i].key);
    if (island == 0)
      awake[kept++] = awake[i];
    else
      asleep.push_back({awake[i], island, rows[i].a, rows[i].b, rows[i].point});
  }
  awake.resize(kept);
  std::inplace_merge(asleep.begin(), asleep.begin() + before, asleep.end(), by_key);
}

/// The other way round, of those islands, which ascend.
void take_back(std::vector<SleepingContact>& asleep, std::span<const std::uint32_t> islands,
               std::vector<ContactImpulse>& awake) {
  const auto before = static_cast<std::ptrdiff_t>(awake.size());
  std::erase_if(asleep, [&](const SleepingContact& contact) {
    const bool wakes = std::ranges::binary_search(islands, contact.island);
    if (wakes) awake.push_back(contact.impulse);
    return wakes;
  });
  std::inplace_merge(awake.begin(), awake.begin() + before, awake.end(),
                     [](const ContactImpulse& a, const ContactImpulse& b) { return a.key < b.key; });
}

/// Whether a kinematic body goes anywhere, as it then does for ever.
bool moves(const State& state, std::uint32_t body) {
  return state.velocity[body] != Vec(0.0, 0.0) || state.spin[body] != 0.0;
}

double square(double x) {
  return x * x;
}

/// m²/s², with that of its rim.
double squared_speed(const Scene& scene, const State& state, std::uint32_t body) {
  return state.velocity[body].squaredNorm() + square(state.spin[body] * scene.bodies.radius[body]);
}

broadphase::Box box(const Vec& centre, double reach) {
  return {centre.array() - reach, centre.array() + reach};
}

bool are_discs(const Colliders& colliders, broadphase::Pair pair) {
  return colliders.shape.empty() || (!colliders.shape[pair.a] && !colliders.shape[pair.b]);
}

/// Whether the two are near enough to touch within the step.
bool may_touch(const State& state, const Candidates& candidates, broadphase::Pair pair) {
  if (!candidates.may_meet(pair)) return false;
  const Colliders& colliders = candidates.colliders();
  if (are_discs(colliders, pair)) return true;
  thread_local narrowphase::Convex disc_a = narrowphase::disc(1.0), disc_b = disc_a;
  const auto shape = [&](std::uint32_t row, narrowphase::Convex& disc) -> const narrowphase::Convex& {
    disc.radius = colliders.radius[row];
    return colliders.shape[row] ? *colliders.shape[row] : disc;
  };
  const auto pose = [&](std::uint32_t row) {
    const std::uint32_t body = colliders.body[row];
    return narrowphase::pose(state.position[body], state.angle[body]);
  };
  narrowphase::Pose pose_b = pose(pair.b);
  pose_b.position += candidates.shift(pair);
  return narrowphase::separation(shape(pair.a, disc_a), pose(pair.a), shape(pair.b, disc_b), pose_b)
             .distance <= candidates.reach(pair);
}

}  // namespace

Sleepers::Sleepers(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan) {
  if (!plan.sleep) return;
  const double dt = scene.time.dt, g = scene.gravity.norm();
  every_ = std::max<std::int64_t>(1, std::llround(kEvery / dt));
  for (const double radius : scene.bodies.radius) {
    const double patience = std::max(kLeastPatience, kFalls * std::sqrt(radius / g));
    patience_.push_back(static_cast<std::uint32_t>(std::min(std::ceil(patience / dt), 4e9)));
  }
}

Rows Sleepers::bodies() const {
  return any_asleep_ ? Rows::of(bodies_) : Rows::all(scene_.bodies.size());
}

Rows Sleepers::colliders(const Candidates& candidates) const {
  return any_asleep_ ? Rows::of(colliders_) : Rows::all(candidates.colliders().size());
}

void Sleepers::look(const State& state, Candidates& candidates) {
  if (!plan_.sleep) return;
  list(state, candidates.colliders());
  index(state, candidates);
}

void Sleepers::list(const State& state, const Colliders& colliders) {
  bodies_.clear(), colliders_.clear();
  any_asleep_ = asleep(state.sleep) > 0;
  if (!any_asleep_) return;
  for (std::uint32_t row = 0; row < state.sleep.island.size(); ++row)
    if (state.sleep.island[row] == 0) bodies_.push_back(row);
  for (std::uint32_t row = 0; row < colliders.size(); ++row)
    if (state.sleep.island[colliders.body[row]] == 0) colliders_.push_back(row);
}

void Sleepers::index(const State& state, Candidates& candidates) {
  const Colliders& colliders = candidates.colliders();
  item_.clear();
  if (!any_asleep_) return;
  for (std::uint32_t row = 0; row < colliders.size(); ++row)
    if (state.sleep.island[colliders.body[row]] != 0) item_.push_back(row);
  candidates.place(state, 0.0, Rows::of(item_));
  std::vector<broadphase::Extent> extents;
  for (const std::uint32_t row : item_) {
    const Vec& centre = candidates.centre(row);
    const double reach = candidates.outer_reach(row);
    extents.push_back(broadphase::Extent::of(box(centre, reach)));
  }
  index_.build(extents);
  clear_.assign(colliders.size(), Clear());
}

void Sleepers::wake(State& state, Candidates& candidates) {
  Rows awake = colliders(candidates);
  while (any_asleep_) {
    touched_.clear();
    awake.for_each([&](std::uint32_t row) { find_touched(state, candidates, row); });
    if (touched_.empty()) return;
    rouse(state, candidates.colliders());
    awake = Rows::of(roused_);
    candidates.place_more(state, awake);
  }
}

/// Adds the islands that the collider may touch. Where the domain repeats, all of its images look. Looks a
/// little farther than it must, and where nobody is, not again until the collider has left there.
void Sleepers::find_touched(const State& state, const Candidates& candidates, std::uint32_t collider) {
  const Vec& centre = candidates.centre(collider);
  const double reach = candidates.outer_reach(collider);
  Clear& clear = clear_[collider];
  if (clear.room >= reach && (centre - clear.at).squaredNorm() <= square(clear.room - reach)) return;
  const std::uint32_t body = candidates.colliders().body[collider];
  if (!is_dynamic(body) && !moves(state, body)) return;
  const double room = reach + kClear * candidates.colliders().radius[collider];
  clear = {centre, room};
  const Vec period = scene_.domain.max - scene_.domain.min;
  const int images = plan_.periodic ? 1 : 0;
  for (int x = -images; x <= images; ++x)
    for (int y = -images; y <= images; ++y)
      index_.for_each_near(box(centre + Vec(x * period.x(), y * period.y()), room), [&](std::uint32_t item) {
        const std::uint32_t other = item_[item];
        const std::uint32_t island = state.sleep.island[candidates.colliders().body[other]];
        if (island == 0) return;
        clear.room = -1.0;
        if (!touched_.empty() && touched_.back() == island) return;
        if (may_touch(state, candidates, {collider, other})) touched_.push_back(island);
      });
}

/// Wakes the islands that are touched.
void Sleepers::rouse(State& state, const Colliders& colliders) {
  SleepState& sleep = state.sleep;
  std::ranges::sort(touched_);
  const auto wakes = [&](std::uint32_t body) {
    return sleep.island[body] != 0 && std::ranges::binary_search(touched_, sleep.island[body]);
  };
  roused_.clear();
  for (std::uint32_t row = 0; row < colliders.size(); ++row)
    if (wakes(colliders.body[row])) roused_.push_back(row);
  for (const std::uint32_t row : roused_) sleep.island[colliders.body[row]] = 0;
  take_back(sleep.disc_contacts, touched_, state.disc_contacts);
  take_back(sleep.point_contacts, touched_, state.point_contacts);
  list(state, colliders);
}

void Sleepers::settle(State& state, Candidates& candidates, const Contacts& contacts,
                      BodyRows<const SolverBody> bodies) {
  const bool some_calm = count_calm(state);
  if (state.step % every_ != 0) return;
  if (some_calm && let_sleep(state, candidates.colliders(), contacts)) {
    put_contacts_aside(state, candidates.colliders(), contacts, bodies);
    look(state, candidates);
  }
  this->bodies().for_each(
      [&](std::uint32_t row) { state.sleep.squared_speed[row] = squared_speed(scene_, state, row); });
}

double Sleepers::most_calm(std::uint32_t body) const {
  return 2.0 * kLift * scene_.gravity.norm() * scene_.bodies.radius[body];
}

void Sleepers::watch(State& state, std::uint32_t row, const SolverBody& body) const {
  const double dt = scene_.time.dt, turned = square(body.turn * scene_.bodies.radius[row]);
  const double squared = (body.position - state.position[row]).squaredNorm() + turned;
  if (!(squared <= dt * dt * most_calm(row))) state.sleep.calm[row] = 0;
}

/// Whether some have been slow for long enough.
bool Sleepers::count_calm(State& state) const {
  bool some = false;
  bodies().for_each([&](std::uint32_t row) {
    if (!is_dynamic(row)) return;
    const bool slow = squared_speed(scene_, state, row) <= most_calm(row);
    std::uint32_t& calm = state.sleep.calm[row];
    calm = slow ? std::min(calm + 1, patience_[row]) : 0;
    some |= calm == patience_[row];
  });
  return some;
}

/// Joins the islands that contacts of the last step connect. Who is near a kinematic body that moves can't
/// rest.
void Sleepers::connect(const State& state, const Colliders& colliders, std::span<const std::uint64_t> keys) {
  for (const std::uint64_t key : keys) {
    if (is_of_obstacle(key)) continue;
    const auto [row_a, row_b] = pair_of(key);
    const std::uint32_t a = colliders.body[row_a], b = colliders.body[row_b];
    if (is_dynamic(a) && is_dynamic(b)) islands_.join(a, b);
    if (!is_dynamic(a) && moves(state, a)) restless_[b] = 1;
    if (!is_dynamic(b) && moves(state, b)) restless_[a] = 1;
  }
}

/// Finds the islands, with those of their bodies that can't rest.
void Sleepers::find_islands(const State& state, const Colliders& colliders, const Contacts& contacts) {
  islands_.start(bodies(), scene_.bodies.size());
  restless_.resize(scene_.bodies.size());
  bodies().for_each([&](std::uint32_t row) {
    restless_[row] = !is_dynamic(row) || state.sleep.calm[row] < patience_[row];
  });
  connect(state, colliders, contacts.disc_key);
  connect(state, colliders, contacts.point_key);
  bodies().for_each([&](std::uint32_t row) {
    if (restless_[row]) restless_[islands_.first(row)] = 1;
  });
}

/// Of islands that together, by the root of the mean square, are faster than at the look before: by more
/// than gravity gives down a slope of a millionth.
void Sleepers::find_gaining(const State& state) {
  const double least = kGain * scene_.gravity.norm() * scene_.time.dt * static_cast<double>(every_);
  motion_.resize(scene_.bodies.size());
  bodies().for_each([&](std::uint32_t row) { motion_[row] = {}; });
  bodies().for_each([&](std::uint32_t row) {
    Motion& island = motion_[islands_.first(row)];
    island.bodies += 1.0;
    island.before += state.sleep.squared_speed[row];
    island.now += squared_speed(scene_, state, row);
  });
  bodies().for_each([&](std::uint32_t row) {
    const Motion& island = motion_[row];
    if (std::sqrt(island.now) > std::sqrt(island.before) + least * std::sqrt(island.bodies))
      restless_[row] = 1;
  });
}

/// Puts islands to sleep of which all are at rest. Returns whether there are any.
bool Sleepers::let_sleep(State& state, const Colliders& colliders, const Contacts& contacts) {
  find_islands(state, colliders, contacts);
  find_gaining(state);
  bool any = false;
  bodies().for_each([&](std::uint32_t row) {
    const std::uint32_t first = islands_.first(row);
    if (restless_[first]) return;
    state.sleep.island[row] = state.id[first];
    state.sleep.calm[row] = 0;
    state.velocity[row] = Vec(0.0, 0.0), state.spin[row] = 0.0;
    any = true;
  });
  return any;
}

void Sleepers::put_contacts_aside(State& state, const Colliders& colliders, const Contacts& contacts,
                                  BodyRows<const SolverBody> bodies) {
  list_contacts(scene_, contacts, nullptr, state, bodies, rows_);
  const auto island_of = [&](std::uint64_t key) {
    const auto [a, b] = pair_of(key);
    const std::uint32_t island = state.sleep.island[colliders.body[a]];
    return island != 0 || is_of_obstacle(key) ? island : state.sleep.island[colliders.body[b]];
  };
  const std::span<const ContactRow> rows = rows_;
  const std::size_t discs = state.disc_contacts.size(), points = state.point_contacts.size();
  put_aside(state.disc_contacts, rows.first(discs), state.sleep.disc_contacts, island_of);
  put_aside(state.point_contacts, rows.last(points), state.sleep.point_contacts, island_of);
}

}  // namespace throng
