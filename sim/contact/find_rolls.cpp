// SPDX-License-Identifier: MIT
#include "sim/contact/find_rolls.h"

#include "sim/contact/contact_key.h"
#include "sim/contact/kept_impulses.h"
#include "sim/contact/roll.h"

namespace throng {

namespace {

double rolling_radius(const Colliders& colliders, std::uint32_t row) {
  return is_disc(colliders, row) ? colliders.radius[row] : throng::rolling_radius(*colliders.shape[row]);
}

double rolling_radius(const Obstacles& obstacles, std::uint32_t row) {
  return obstacles.is_side(row) ? 0.0 : throng::rolling_radius(obstacles.part_at(row));
}

double rolling(const ContactImpulse* kept) {
  return kept ? kept->rolling : 0.0;
}

/// Bounces are those of the same contacts.
template <class Contact>
void tell_bounces(std::span<const RollContact> rolls, std::vector<Contact>& bounces) {
  for (const RollContact& roll : rolls) bounces[roll.contact].lever = roll.lever;
}

class RollFinder {
 public:
  RollFinder(const Scene& scene, const Plan& plan, const Candidates& candidates,
             BodyRows<const SolverBody> bodies)
      : scene_(scene), plan_(plan), candidates_(candidates), bodies_(bodies) {}

  void add(std::uint64_t key, std::uint32_t contact, double kept, std::vector<RollContact>& rolls) const {
    const Colliders& colliders = candidates_.colliders();
    const Obstacles& obstacles = candidates_.obstacles();
    const auto [row_a, row_b] = pair_of(key);
    const bool fixed = is_of_obstacle(key);
    const std::uint32_t a = colliders.body[row_a];
    const std::uint32_t b = fixed ? static_cast<std::uint32_t>(bodies_.size() - 1) : colliders.body[row_b];
    const std::uint32_t material_b = fixed ? obstacles.material[row_b] : scene_.bodies.material[b];
    const double coefficient = plan_.surface(scene_.bodies.material[a], material_b).rolling;
    const double radius =
        effective_radius(rolling_radius(colliders, row_a),
                         fixed ? rolling_radius(obstacles, row_b) : rolling_radius(colliders, row_b));
    if (!(coefficient * radius > 0.0)) return;
    const double turns = bodies_[a].inverse_inertia + bodies_[b].inverse_inertia;
    rolls.push_back({a, b, contact, coefficient * radius, 1.0 / turns, kept});
  }

 private:
  const Scene& scene_;
  const Plan& plan_;
  const Candidates& candidates_;
  BodyRows<const SolverBody> bodies_;
};

}  // namespace

void find_rolls(const Scene& scene, const Plan& plan, const Candidates& candidates, const State& state,
                BodyRows<const SolverBody> bodies, Contacts& contacts) {
  const RollFinder finder(scene, plan, candidates, bodies);
  KeptImpulses kept_discs(state.disc_contacts), kept_points(state.point_contacts);
  for (std::uint32_t i = 0; i < contacts.disc_key.size(); ++i) {
    const std::uint64_t key = contacts.disc_key[i];
    finder.add(key, i, rolling(kept_discs.find(key)), contacts.disc_rolls);
  }
  for (std::uint32_t i = 0; i < contacts.point_key.size();) {
    const std::uint64_t key = contacts.point_key[i];
    const std::uint32_t first = i;
    const bool two = i + 1 < contacts.point_key.size() && contacts.point_key[i + 1] == key;
    const auto features = std::span(contacts.point_feature).subspan(first, two ? 2 : 1);
    for (; i < first + features.size(); ++i)
      finder.add(key, i, rolling(kept_points.find(key, features, i - first)), contacts.point_rolls);
  }
  if (!plan.restitution) return;
  tell_bounces(contacts.disc_rolls, contacts.disc_bounces);
  tell_bounces(contacts.point_rolls, contacts.point_bounces);
}

}  // namespace throng
