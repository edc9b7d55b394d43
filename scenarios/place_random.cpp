// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/body_distance.h"
#include "scenarios/body_grid.h"
#include "scenarios/place.h"
#include "sim/random.h"

namespace throng::scenarios {

namespace {

constexpr int kBodyTries = 200'000;                  ///< for one body
constexpr std::int64_t kWorkOfTry = 16;              ///< in units of a few nanoseconds, and pairs of parts
constexpr std::int64_t kPlacingWork = 200'000'000;   ///< for all bodies together, and
constexpr std::int64_t kWorkEach = 10 * kWorkOfTry;  ///< this much more per body: an end within seconds

/// Random sequential addition: each body goes to the first of its random places that is free. The large ones
/// go first, which packs better and depends on no order in the file.
class Placer {
 public:
  Placer(std::span<const Entry> entries, Scene& scene, Report& report)
      : entries_(entries),
        scene_(scene),
        report_(report),
        reach_(longest_reach()),
        bodies_(scene.domain, reach_, scene.bodies.size()),
        walls_(scene, reach_) {}

  void place() {
    std::vector<Row> rows;
    for (const Entry& entry : entries_)
      for (std::uint32_t i = 0; i < entry.count; ++i) add(entry, entry.first + i, rows);
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
      return a.radius != b.radius ? a.radius > b.radius : a.row < b.row;
    });
    wanted_ = rows.size();
    work_left_ = kPlacingWork + kWorkEach * static_cast<std::int64_t>(rows.size());
    for (const Row& row : rows)
      if (!report_.bad(*row.entry->node)) place(row);
  }

 private:
  struct Row {
    double radius;
    std::uint32_t row;
    const Entry* entry;
  };

  double longest_reach() const {
    double radius = 0.0, gap = 0.0;
    for (double r : scene_.bodies.radius) radius = std::max(radius, r);
    for (const Entry& entry : entries_) gap = std::max(gap, entry.gap);
    return radius + gap;
  }

  void add(const Entry& entry, std::uint32_t row, std::vector<Row>& rows) {
    const double radius = scene_.bodies.radius[row];
    if (entry.place == Entry::Place::random)
      rows.push_back({radius, row, &entry});
    else
      bodies_.add(row, scene_.bodies.position[row], radius);
  }

  /// Where the body's centre may be for all of it to lie within.
  Eigen::AlignedBox2d region(const Row& row) const {
    const Eigen::AlignedBox2d body = extent(scene_, row.row);
    const Domain& domain = scene_.domain;
    Eigen::AlignedBox2d result(row.entry->within.min() - body.min(), row.entry->within.max() - body.max());
    if (domain.kind != DomainKind::periodic) return result;
    for (int axis : {0, 1}) {  // all of a period has no ends to keep away from
      if (!(row.entry->within.sizes()[axis] >= domain.max[axis] - domain.min[axis])) continue;
      result.min()[axis] = domain.min[axis], result.max()[axis] = domain.max[axis];
    }
    return result;
  }

  void place(const Row& row) {
    const Eigen::AlignedBox2d region_ = region(row);
    if (!(region_.sizes().minCoeff() >= 0.0))
      return fail(row, "is too large for `within`: " + to_text(2.0 * row.radius) + " m across");
    Random random(scene_.seed, 0, row.row + 1, Purpose::place);
    for (int i = 0; i < kBodyTries && work_left_ > 0; ++i) {
      const double x = random.uniform(region_.min().x(), region_.max().x());
      const double y = random.uniform(region_.min().y(), region_.max().y());
      const Vec position = wrapped(scene_.domain, {x, y});
      std::int64_t work = kWorkOfTry;
      const bool free = is_free({row.row, position}, row, work);
      work_left_ -= work;
      if (!free) continue;
      scene_.bodies.position[row.row] = position;
      bodies_.add(row.row, position, row.radius);
      ++placed_;
      return;
    }
    fail(row, "found no free place");
  }

  bool is_free(const Placed& body, const Row& row, std::int64_t& work) const {
    const double reach = row.radius + row.entry->gap, gap = row.entry->gap;
    const bool disc = scene_.shapes[row.entry->shape].kind == ShapeKind::disc;
    const auto hits_body = [&](std::uint32_t other, const Vec& position, double) {
      const bool discs = disc && scene_.shapes[scene_.bodies.shape[other]].kind == ShapeKind::disc;
      return discs || is_closer(scene_, body, Placed{other, position}, gap, work);
    };
    const auto hits_wall = [&](const WallGrid::Piece& piece) {
      return disc || is_closer(scene_, body, piece, gap, work);
    };
    return !bodies_.visit_near(body.position, reach, hits_body) &&
           !walls_.visit_near(body.position, reach, hits_wall);
  }

  void fail(const Row& row, const std::string& why) {
    const toml::table& random =
        *row.entry->node->as_table()->get("place")->as_table()->get("random")->as_table();
    report_.mark_bad(*row.entry->node);
    report_.error(
        *random.get("within"), "bodies[" + std::to_string(row.entry->index) + "].place.random",
        "body " + std::to_string(row.row + 1) + " " + why + ", after " + std::to_string(placed_) +
            " of the " + std::to_string(wanted_) +
            " bodies to be placed at random, the largest first: take a larger `within`, or fewer or "
            "smaller bodies");
  }

  std::span<const Entry> entries_;
  Scene& scene_;
  Report& report_;
  double reach_;
  BodyGrid bodies_;
  WallGrid walls_;
  std::int64_t work_left_ = 0;
  std::size_t placed_ = 0, wanted_ = 0;
};

}  // namespace

void place_at_random(std::span<const Entry> entries, Scene& scene, Report& report) {
  const bool any = std::any_of(entries.begin(), entries.end(), [](const Entry& entry) {
    return entry.place == Entry::Place::random && entry.count > 0;
  });
  if (any) Placer(entries, scene, report).place();
}

}  // namespace throng::scenarios
