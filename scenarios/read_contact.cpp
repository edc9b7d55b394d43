// SPDX-License-Identifier: MIT
// How bodies push each other, and whether the steps are short enough for it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scenarios/read.h"
#include "sim/soft_timing.h"
#include "sim/uses_substeps.h"

namespace throng::scenarios {

namespace {

constexpr double kPerContact = 50.0;     // substeps in the shortest impact, where the scenario doesn't say
constexpr double kFewPerContact = 20.0;  // fewer deserve a word
constexpr double kMostSubsteps = 1000.0;

constexpr double kRigidStep = 0.05;  // of √(d / g), d an equivalent diameter: what longer do, README says
constexpr double kHeavyStep = 0.2;   // likewise, of √(d / (r g)), r the ratio of masses
constexpr double kHeavy = 16.0;      // of which from here on that is the stricter
constexpr double kByDefault =
    0.5;  // of the first, where the scenario doesn't say; not more substeps than that
constexpr double kMostByDefault = 40.0;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct ContactKey {
  const char* key;
  bool spring, hertz;  // to which models it belongs
};
constexpr std::array kKeys = {
    ContactKey{"stiffness", true, false}, ContactKey{"tangential_stiffness", true, false},
    ContactKey{"youngs_modulus", false, true}, ContactKey{"poisson_ratio", false, true},
    ContactKey{"tangential_damping", true, true}};

ContactModel model_of(const std::string& name) {
  if (name == "none") return ContactModel::none;
  if (name == "spring") return ContactModel::spring;
  return name == "hertz" ? ContactModel::hertz : ContactModel::impulse;
}

std::string models_of(const ContactKey& key) {
  if (key.spring && key.hertz) return "\"spring\" or \"hertz\"";
  return key.spring ? "\"spring\"" : "\"hertz\"";
}

/// The fewest substeps none of which is longer than that (s).
double fewest_substeps(const Scene& scene, double longest) {
  return std::max(1.0, std::ceil(scene.time.dt / longest * (1.0 - 1e-9)));
}

/// How many substeps there `must` be, or how long dt, where no number of substeps would do.
std::string remedy(const Scene& scene, double longest, const std::string& must) {
  const double fewest = fewest_substeps(scene, longest);
  if (fewest <= kMostSubsteps) return "time.substeps " + must + " be at least " + to_text(fewest);
  return "time.dt " + must + " be at most " + three_digits(0.99 * kMostSubsteps * longest) +
         " s, with time.substeps = " + to_text(kMostSubsteps);
}

/// Where the length of a substep stands, or, in the entry of that name, what asks for it.
std::pair<const toml::node*, const char*> place_of_step(const toml::table& root, const char* asks) {
  for (const auto& [key, path] : {std::pair{"substeps", "time.substeps"}, {"dt", "time.dt"}})
    if (const toml::node* node = root["time"][key].node()) return {node, path};
  return {root.get(asks), asks};
}

void check_step(const toml::table& root, const Scene& scene, const SoftTiming& timing, Report& report) {
  const double h = scene.time.dt / scene.time.substeps, per_contact = timing.contact / h;
  const auto [node, path] = place_of_step(root, "contact");
  const std::string impact = "an impact lasts " + three_digits(timing.contact) + " s, " +
                             three_digits(per_contact) + " substeps of " + three_digits(h) + " s";
  if (h > timing.longest)
    report.error(*node, path,
                 impact + ": unstable in a dense packing; " + remedy(scene, timing.longest, "must"));
  else if (per_contact < kFewPerContact * (1.0 - 1e-9))
    report.warning(node->source(), path,
                   impact + ": fewer than 20 are not accurate; " +
                       remedy(scene, timing.contact / kFewPerContact, "should"));
}

/// Whether bodies move so fast that they may pass others unseen: from the beginning, or once they have fallen
/// as far as the scene is high.
void check_ways(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.bodies.size() + scene.walls.size() < 2 && scene.domain.kind == DomainKind::unbounded) return;
  const double h = scene.time.dt / scene.time.substeps, most = longest_way(scene);
  const double first = first_speed_of_ways(scene), later = first + fall_speed(scene);
  if (!(h * later > most)) return;
  const bool now = h * first > most;
  const double speed = now ? first : later;
  const auto [node, path] = place_of_step(root, "contact");
  const std::string why =
      (now ? "the fastest body moves at " : "who falls as far as the scene is high may get to ") +
      three_digits(speed) + " m/s, so " + three_digits(h * speed) +
      " m in a substep, farther than the smallest disc's radius, " + three_digits(most) +
      " m, and passes others unseen; ";
  const std::string most_dt = " (or time.dt at most " +
                              three_digits(0.99 * scene.time.substeps * most / speed) +
                              " s, with time.substeps = " + to_text(scene.time.substeps) + ")";
  if (now)
    report.error(*node, path, why + remedy(scene, most / speed, "must") + most_dt);
  else
    report.warning(node->source(), path, why + remedy(scene, most / speed, "should") + most_dt);
}

/// Whether others may be in it and whirl with it.
bool may_hold_others(const Scene& scene, std::size_t row) {
  return scene.bodies.kind[row] == BodyKind::kinematic &&
         scene.shapes[scene.bodies.shape[row]].parts.size() > 1;
}

/// m, of a shape, the diameter of the disc that is as thick: 4 area / border, of a plate twice its thickness;
/// of several discs that of the smallest.
double equivalent_diameter(const Shape& shape) {
  double border = 0.0;
  const auto walk = [&](const std::vector<Vec>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) border += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  };
  walk(shape.outline);
  for (const std::vector<Vec>& hole : shape.holes) walk(hole);
  if (border > 0.0) return 4.0 * shape.area / border;
  double least = 2.0 * shape.radius;
  for (const narrowphase::Convex& part : shape.parts) least = std::min(least, 2.0 * part.radius);
  return least;
}

/// Calls f(row, equivalent diameter) for dynamic bodies.
template <class F>
void for_dynamic_sizes(const Scene& scene, F f) {
  std::vector<double> of_shapes;
  for (const Shape& shape : scene.shapes) of_shapes.push_back(equivalent_diameter(shape));
  for_dynamic(scene, [&](std::size_t row) {
    const std::uint32_t shape = scene.bodies.shape[row];
    const bool is_disc = scene.shapes[shape].kind == ShapeKind::disc;
    f(row, is_disc ? 2.0 * scene.bodies.radius[row] : of_shapes[shape]);
  });
}

/// m, of dynamic bodies; infinite where there are none.
double least_equivalent_diameter(const Scene& scene) {
  double least = kNever;
  for_dynamic_sizes(scene, [&](std::size_t, double diameter) { least = std::min(least, diameter); });
  return least;
}

/// m/s², with which bodies may be pressed on others: by gravity, and in what holds them and spins.
double load_acceleration(const Scene& scene) {
  double whirl = 0.0;
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (const double spin = scene.bodies.spin[row]; may_hold_others(scene, row))
      whirl = std::max(whirl, spin * spin * scene.bodies.radius[row]);
  return scene.gravity.norm() + whirl;
}

/// What presses small bodies, and how long substeps may be before that is deep into what they lie on.
struct RigidStep {
  double acceleration, equivalent_diameter;  ///< m/s², m
  double longest = kNever;                   ///< s

  explicit RigidStep(const Scene& scene)
      : acceleration(load_acceleration(scene)), equivalent_diameter(least_equivalent_diameter(scene)) {
    const bool any = scene.bodies.size() + scene.walls.size() > 1 || scene.domain.kind == DomainKind::box;
    if (any && acceleration > 0.0) longest = kRigidStep * std::sqrt(equivalent_diameter / acceleration);
  }
};

void check_rigid_step(const toml::table& root, const Scene& scene, const RigidStep& step, Report& report) {
  const double h = scene.time.dt / scene.time.substeps;
  if (!(h > step.longest * (1.0 + 1e-9))) return;
  const auto [node, path] = place_of_step(root, root.contains("gravity") ? "gravity" : "bodies");
  report.warning(node->source(), path,
                 "substeps of " + three_digits(h) + " s are long for bodies as small as discs " +
                     three_digits(step.equivalent_diameter) + " m across that " +
                     three_digits(step.acceleration) + " m/s² press on others: from " +
                     three_digits(step.longest) +
                     " s on they overlap by a tenth of their radius, from four times that on they pass "
                     "through one another and steps take ever longer; " +
                     remedy(scene, step.longest, "should"));
}

bool holds_bodies_up(const Scene& scene) {
  return !scene.walls.empty() || scene.domain.kind == DomainKind::box ||
         std::ranges::any_of(scene.bodies.kind, [](BodyKind kind) { return kind != BodyKind::dynamic; });
}

/// The heaviest body, the one that it would press deepest into what holds it up, and how long substeps may be
/// for that.
struct HeavyStep {
  double heavy = 0.0, light = 0.0;  ///< kg
  double longest = kNever;          ///< s

  explicit HeavyStep(const Scene& scene) {
    const double g = scene.gravity.norm();
    if (g == 0.0 || !holds_bodies_up(scene)) return;
    for_dynamic(scene, [&](std::size_t row) { heavy = std::max(heavy, mass(scene, row)); });
    for_dynamic_sizes(scene, [&](std::size_t row, double diameter) {
      const double its = mass(scene, row), step = kHeavyStep * std::sqrt(diameter * its / (heavy * g));
      if (heavy >= kHeavy * its && step < longest) light = its, longest = step;
    });
  }
};

void check_heavy_step(const toml::table& root, const Scene& scene, Report& report) {
  const HeavyStep step(scene);
  const double h = scene.time.dt / scene.time.substeps;
  if (!(h > step.longest * (1.0 + 1e-9))) return;
  const auto [node, path] = place_of_step(root, "gravity");
  report.warning(node->source(), path,
                 "substeps of " + three_digits(h) + " s are long should a body of " +
                     three_digits(step.heavy) + " kg come to lie on one of " + three_digits(step.light) +
                     " kg, " + three_digits(step.heavy / step.light) + " times lighter: from " +
                     three_digits(step.longest) +
                     " s on the light one overlaps what it lies on by a tenth of its radius, from four times "
                     "that on it may be pressed through; " +
                     remedy(scene, step.longest, "should"));
}

void settle_rigid_contacts(const toml::table& root, Scene& scene, Report& report) {
  if (scene.time.error > 0.0 || !uses_substeps(scene)) return;
  const RigidStep step(scene);
  const double fewest = std::min(kMostByDefault, fewest_substeps(scene, kByDefault * step.longest));
  if (!root["time"]["substeps"])
    scene.time.substeps = std::max(scene.time.substeps, static_cast<int>(fewest));
  check_rigid_step(root, scene, step, report);
  check_heavy_step(root, scene, report);
}

void settle_soft_contacts(const toml::table& root, Scene& scene, Report& report) {
  if (const std::string refusal = soft_refusal(scene); !refusal.empty())
    return report.error(*root["contact"]["model"].node(), "contact.model", refusal);
  const SoftTiming timing = soft_timing(scene);
  if (!root["time"]["substeps"] && !(scene.time.error > 0.0))
    scene.time.substeps =
        static_cast<int>(std::min(kMostSubsteps, fewest_substeps(scene, timing.contact / kPerContact)));
  check_step(root, scene, timing, report);
  check_ways(root, scene, report);
}

}  // namespace

void read_contact(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = good(root, "contact", report);
  if (!node) return;
  const toml::table& table = *node->as_table();
  const std::string name = text(table, "model", "impulse");
  scene.contact = model_of(name);
  const bool spring = scene.contact == ContactModel::spring, hertz = scene.contact == ContactModel::hertz;
  for (const ContactKey& key : kKeys)
    if (const toml::node* value = table.get(key.key);
        value && !(spring && key.spring) && !(hertz && key.hertz))
      report.error(*value, std::string("contact.") + key.key,
                   "belongs to contact.model " + models_of(key) + ", and it is " + in_quotes(name));
  const char* needed = spring ? "stiffness" : "youngs_modulus";
  if ((spring || hertz) && !table.contains(needed))
    report.error(*node, std::string("contact.") + needed,
                 "is missing: contact.model " + in_quotes(name) + " needs it");
  SoftContact& soft = scene.soft;
  soft.stiffness = number(table, "stiffness", soft.stiffness);
  soft.tangential_stiffness = number(table, "tangential_stiffness", soft.tangential_stiffness);
  soft.youngs_modulus = number(table, "youngs_modulus", soft.youngs_modulus);
  soft.poisson_ratio = number(table, "poisson_ratio", soft.poisson_ratio);
  soft.tangential_damping = number(table, "tangential_damping", soft.tangential_damping);
}

void settle_contacts(const toml::table& root, Scene& scene, Report& report) {
  if (scene.engine != Engine::native) return;
  if (is_soft(scene.contact)) return settle_soft_contacts(root, scene, report);
  if (scene.contact == ContactModel::impulse) settle_rigid_contacts(root, scene, report);
}

}  // namespace throng::scenarios
