// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/body_distance.h"
#include "scenarios/body_grid.h"
#include "scenarios/place.h"

namespace throng::scenarios {

namespace {

constexpr std::size_t kNamed = 10, kEnough = 1000;
constexpr std::int64_t kSearchWork = 1'000'000'000;  // a few seconds

class Overlaps {
 public:
  Overlaps(const Scene& scene, double reach)
      : scene_(scene),
        movable_(scene.domain, reach, scene.bodies.size()),
        fixed_(scene.domain, reach, scene.bodies.size()),
        walls_(scene, reach) {}

  bool full() const { return found_ >= kEnough || tired(); }
  bool tired() const { return work_ > kSearchWork; }

  /// Compares the body with all that were added before, and with the walls.
  void add(std::uint32_t row) {
    const Placed body{row, scene_.bodies.position[row]};
    const double radius = scene_.bodies.radius[row];
    std::vector<Met> met;
    compare(movable_, body, radius, met);
    if (moves(row)) compare(fixed_, body, radius, met);  // what can't move is not asked about its like
    std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.other < b.other; });
    for (const Met& one : met)
      note(one.other, "body " + std::to_string(one.other + 1) + " and body " + std::to_string(row + 1),
           one.depth);
    (moves(row) ? movable_ : fixed_).add(row, body.position, radius);
    if (moves(row)) compare_with_walls(body, radius);
  }

  bool any() const { return found_ > 0; }

  /// The row that the first overlap names first.
  std::uint32_t first() const { return first_; }

  std::string message() const {
    if (found_ == 0) return tired() ? "were too many to look for all overlaps at the start" : "";
    return (full() ? "at least " : "") + std::to_string(found_) + (found_ == 1 ? " overlap" : " overlaps") +
           " at the start: " + pairs_ + (found_ > kNamed ? ", ..." : "");
  }

 private:
  struct Met {
    std::uint32_t other;
    double depth;  ///< m
  };

  bool moves(std::uint32_t row) const { return scene_.bodies.kind[row] == BodyKind::dynamic; }

  /// Adds whom of the grid the body overlaps, each once with its deepest image.
  void compare(const BodyGrid& grid, const Placed& body, double radius, std::vector<Met>& met) {
    grid.visit_near(
        body.position, radius, [&](std::uint32_t other, const Vec& position, double other_radius) {
          const Placed placed{other, position};
          const double least = touching(std::min(radius, other_radius), body.position);
          if (!is_closer(scene_, body, placed, -least, work_)) return full();
          const double depth = -distance(scene_, body, placed);
          const auto known =
              std::find_if(met.begin(), met.end(), [&](const Met& one) { return one.other == other; });
          if (known == met.end())
            met.push_back({other, depth});
          else
            known->depth = std::max(known->depth, depth);
          return found_ + met.size() >= kEnough || tired();
        });
  }

  void compare_with_walls(const Placed& body, double radius) {
    std::vector<std::uint32_t> met;  // a piece of wall may be seen twice
    walls_.visit_near(body.position, radius, [&](const WallGrid::Piece& piece) {
      if (!is_closer(scene_, body, piece, -touching(radius, body.position), work_)) return full();
      const double depth = -distance(scene_, body, piece);
      if (std::find(met.begin(), met.end(), piece.wall) != met.end()) return false;
      met.push_back(piece.wall);
      note(body.row,
           "body " + std::to_string(body.row + 1) + " and walls[" + std::to_string(piece.wall) + "]", depth);
      return full();
    });
  }

  void note(std::uint32_t row, const std::string& pair, double depth) {
    if (found_ == 0) first_ = row;
    if (++found_ <= kNamed)
      pairs_ += (pairs_.empty() ? "" : ", ") + pair + " by " + three_digits(depth) + " m";
  }

  const Scene& scene_;
  BodyGrid movable_, fixed_;
  WallGrid walls_;
  std::size_t found_ = 0;
  std::uint32_t first_ = 0;
  std::int64_t work_ = 0;  // so far, in units of a few nanoseconds
  std::string pairs_;
};

}  // namespace

void warn_of_overlaps(std::span<const Entry> entries, const Scene& scene, Report& report) {
  if (scene.contact == ContactModel::none || scene.bodies.size() == 0) return;
  Overlaps overlaps(scene, *std::max_element(scene.bodies.radius.begin(), scene.bodies.radius.end()));
  for (const Entry& entry : entries) {
    if (entry.place == Entry::Place::random) continue;
    for (std::uint32_t i = 0; i < entry.count && !overlaps.full(); ++i) overlaps.add(entry.first + i);
  }
  const std::string message = overlaps.message();
  if (message.empty()) return;
  const auto holds_first = [&](const Entry& entry) { return overlaps.first() < entry.first + entry.count; };
  const Entry& entry = *std::find_if(entries.begin(), entries.end(), holds_first);
  if (scene.engine == Engine::event_driven && overlaps.any())
    report.error(*entry.node, "bodies", message + ": hard discs can't");
  else
    report.warning(entry.node->source(), "bodies", message);
}

}  // namespace throng::scenarios
