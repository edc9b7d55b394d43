// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <optional>

#include "scenarios/body_grid.h"
#include "scenarios/read_crowd.h"
#include "scenarios/region_sets.h"
#include "sim/crowd/model.h"
#include "sim/crowd/sampler.h"
#include "sim/crowd/walk.h"
#include "sim/crowd/ways.h"

namespace throng::scenarios {

namespace {

constexpr int kAgentTries = 20'000;                             // for one agent
constexpr std::int64_t kTries = 1'000'000, kTriesEach = 1'000;  // for all of them: an end within seconds

constexpr double kSparse = 0.125;  // of its box, that a region fills: less is drawn from by cells

constexpr double kTouch = 1e-9;  // of two radii: who is in another by less touches him

std::uint32_t disc_shape(Scene& scene) {
  Shape shape;
  shape.name = "agent";
  scene.shapes.push_back(shape);
  return static_cast<std::uint32_t>(scene.shapes.size() - 1);
}

void add_own_parameters(const AgentEntry& entry, std::uint32_t id, std::uint64_t seed, AgentGroup& group) {
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    Random random(seed, i, id, Purpose::parameter);
    group.parameters.push_back(draw(entry.parameters[i], random));
  }
}

void add_agent(const AgentEntry& entry, std::uint32_t group, std::uint32_t i, std::uint32_t shape,
               Scene& scene) {
  Bodies& bodies = scene.bodies;
  const auto id = static_cast<std::uint32_t>(bodies.size() + 1);
  Random radius(scene.seed, 0, id, Purpose::radius), speed(scene.seed, 0, id, Purpose::desired_speed);
  bodies.shape.push_back(shape);
  bodies.material.push_back(0);
  bodies.kind.push_back(BodyKind::agent);
  bodies.radius.push_back(draw(entry.radius, radius));
  bodies.position.push_back(entry.at);
  bodies.angle.push_back(0.0);
  bodies.velocity.push_back(Vec(0.0, 0.0));
  bodies.spin.push_back(0.0);
  Crowd& crowd = scene.crowd;
  crowd.group.push_back(group);
  crowd.desired_speed.push_back(draw(entry.desired_speed, speed));
  crowd.due.push_back(entry.appears ? entry.appears->due(i) : 0.0);
  Random premovement(scene.seed, 0, id, Purpose::premovement);
  crowd.start.push_back(crowd.due.back() + draw(entry.premovement, premovement));
  if (crowd.groups[group].own) add_own_parameters(entry, id, scene.seed, crowd.groups[group]);
  for (const Stay& stay : entry.stays) {
    Random random(scene.seed, stay.leg, id, Purpose::stay);
    crowd.groups[group].journey[stay.leg].times.push_back(draw(stay.time, random));
  }
}

/// Who stands where another does from the start, how often and how deep at the deepest.
struct Overlapped {
  int others = 0;
  double depth = 0.0;  // m
  Vec at{0.0, 0.0};    // m, the one
};

/// Those with a place of their own, then random sequential addition, each in the order of the ids.
class AgentPlacer {
 public:
  AgentPlacer(Scene& scene, Report& report, double farthest)
      : scene_(scene),
        report_(report),
        barriers_(barrier_lines(scene), farthest),
        movers_(scene),
        agents_(scene.domain, farthest, scene.crowd.size()),
        tries_left_(kTries + kTriesEach * static_cast<std::int64_t>(scene.crowd.size())) {
    movers_.show(initial_state(scene), barriers_);
  }

  void place(const AgentEntry& entry, std::uint32_t row) {
    entry.random ? place_at_random(entry, row) : place_by_hand(entry, row);
  }

 private:
  /// The area's name, or the box.
  static std::string where(const AgentEntry& entry) {
    const toml::node& within = *(*entry.node->as_table())["place"]["random"]["within"].node();
    if (within.is_string()) return in_quotes(within.as_string()->get());
    return "[" + to_text(box(within).min()) + ", " + to_text(box(within).max()) + "]";
  }

  bool stands(const Vec& p, double clear) const {
    return contains(scene_.crowd.walkable, p) && movers_.depth(p) == 0.0 &&
           !(barriers_.distance(p, clear) < clear);
  }

  void place_by_hand(const AgentEntry& entry, std::uint32_t row) {
    const double radius = scene_.bodies.radius[row];
    if (!stands(entry.at, radius))
      report_.error(*entry.node->as_table()->get("at"), entry.path + ".at",
                    "an agent of radius " + to_text(radius) + " m at " + to_text(entry.at) +
                        " is not wholly on the walkable area, or overlaps a wall or a body");
    warn_of_overlap(entry, radius);
    agents_.add(row, entry.at, radius);
  }

  /// Who stands in another from the start may be what is wanted.
  void warn_of_overlap(const AgentEntry& entry, double radius) {
    Overlapped overlapped;
    agents_.visit_near(entry.at, radius, [&](std::uint32_t, const Vec& at, double its) {
      const double depth = radius + its - (at - entry.at).norm();
      if (depth <= kTouch * (radius + its)) return false;
      ++overlapped.others;
      if (depth > overlapped.depth) overlapped.depth = depth, overlapped.at = at;
      return false;
    });
    if (overlapped.others == 0) return;
    report_.warning(entry.node->as_table()->get("at")->source(), entry.path + ".at",
                    "an agent of radius " + to_text(radius) + " m at " + to_text(entry.at) + " overlaps " +
                        (overlapped.others > 1 ? std::to_string(overlapped.others) + ", " : "") + "by " +
                        three_digits(overlapped.depth) + " m one that stands at " + to_text(overlapped.at));
  }

  static Vec anywhere(const Eigen::AlignedBox2d& box, Random& random) {
    const double x = random.uniform(box.min().x(), box.max().x());
    return {x, random.uniform(box.min().y(), box.max().y())};
  }

  /// Of an entry whose region fills little of its box; null for others.
  const Sampler* sampler_of(const AgentEntry& entry) {
    if (sampled_ == &entry) return sampler_ ? &*sampler_ : nullptr;
    sampled_ = &entry, sampler_.reset();
    if (common_area(entry.within, entry.within) < kSparse * bounds(entry.within).volume())
      sampler_.emplace(entry.within, 0.0);
    return sampler_ ? &*sampler_ : nullptr;
  }

  void place_at_random(const AgentEntry& entry, std::uint32_t row) {
    const double radius = scene_.bodies.radius[row];
    const Eigen::AlignedBox2d box = bounds(entry.within);
    Random random(scene_.seed, 0, row + 1, Purpose::place);
    const Sampler* sparse = sampler_of(entry);
    for (int i = 0; i < kAgentTries && tries_left_ > 0; ++i, --tries_left_) {
      const Vec p = sparse ? sparse->draw(random) : anywhere(box, random);
      if (!is_free(p, radius, entry)) continue;
      scene_.bodies.position[row] = p;
      if (!entry.appears) agents_.add(row, p, radius);
      return;
    }
    report_.mark_bad(*entry.node);
    report_.error(*entry.node->as_table()->get("place"), entry.path + ".place.random",
                  agent_name(scene_, row) + " found no free place in " + where(entry) +
                      (common_area(entry.within, scene_.crowd.walkable) > 0.0
                           ? std::string(": take a larger `within`, ") +
                                 (entry.gap > 0.0 ? "a smaller `gap`, " : "") + "or fewer or smaller agents"
                           : ", which has nothing in common with the walkable area"));
  }

  bool is_free(const Vec& p, double radius, const AgentEntry& entry) const {
    return contains(entry.within, p) && (nearest_on_border(entry.within, p) - p).norm() >= radius &&
           (entry.appears || !agents_.visit_near(p, radius + entry.gap,
                                                 [](std::uint32_t, const Vec&, double) { return true; })) &&
           stands(p, radius + entry.gap);
  }

  Scene& scene_;
  Report& report_;
  Barriers barriers_;
  Movers movers_;
  BodyGrid agents_;
  std::int64_t tries_left_;
  const AgentEntry* sampled_ = nullptr;  // whom `sampler_` is of
  std::optional<Sampler> sampler_;
};

void check_step(const AgentEntry& entry, const AgentGroup& group, std::uint32_t first, const Scene& scene,
                Report& report) {
  double longest = std::numeric_limits<double>::infinity();
  std::unique_ptr<WalkingModel> model;
  for (std::uint32_t agent = 0; agent < entry.count; ++agent) {
    if (!model || group.own) model = walking_models()[group.model].make(group.parameters_of(agent));
    longest = std::min(longest, model->longest_step(scene.bodies.radius[first + agent],
                                                    scene.crowd.desired_speed[group.first + agent]));
  }
  if (scene.time.dt <= longest) return;
  report.error(
      *entry.node->as_table()->get("model"), entry.path + ".model",
      "needs time.dt to be at most " + to_text(longest) + " s, and it is " + to_text(scene.time.dt) + " s");
}

}  // namespace

void place_agents(std::span<const AgentEntry> entries, Scene& scene, Report& report) {
  if (entries.empty()) return;
  const std::uint32_t shape = disc_shape(scene);
  scene.crowd.first = static_cast<std::uint32_t>(scene.bodies.size());
  std::vector<std::uint32_t> first;  // rows of the bodies
  double farthest = 0.0;
  for (std::uint32_t group = 0; group < entries.size(); ++group) {
    first.push_back(static_cast<std::uint32_t>(scene.bodies.size()));
    for (std::uint32_t i = 0; i < entries[group].count; ++i)
      add_agent(entries[group], group, i, shape, scene);
    scene.crowd.groups[group].first = first[group] - scene.crowd.first;
    scene.crowd.groups[group].count = entries[group].count;
    for (std::uint32_t row = first[group]; row < scene.bodies.size(); ++row)
      farthest = std::max(farthest, scene.bodies.radius[row] + entries[group].gap);
    check_step(entries[group], scene.crowd.groups[group], first[group], scene, report);
  }
  AgentPlacer placer(scene, report, farthest);
  for (const bool random : {false, true})
    for (std::uint32_t group = 0; group < entries.size(); ++group)
      for (std::uint32_t i = 0;
           entries[group].random == random && i < entries[group].count && !report.bad(*entries[group].node);
           ++i)
        placer.place(entries[group], first[group] + i);
}

}  // namespace throng::scenarios
