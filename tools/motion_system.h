// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "narrowphase/linkage/check_linkage.h"
#include "scenarios/motion_task.h"

namespace throng::tools {

/// A motion task as the narrowphase has it: all movers are one linkage, a body being two slides and a turn;
/// all obstacles are one solid, but those that some may touch and others not, which are links that don't
/// move.
class MotionSystem {
 public:
  /// Which pairs of links are compared: all that may not touch, for distances of single configurations; or
  /// without those that the joint limits keep farther apart than the margin, for questions about a path.
  enum class Pairs { all, within_reach };

  /// Expects a task without faults, which must outlive this. Every shape is grown by half of `margin` (m,
  /// rounded up): what touches is at most so far apart, what is free is farther. As costly as
  /// `pairs_to_check`. Throws InputError where links or pairs within reach, times segments, are too many to
  /// be asked at once.
  MotionSystem(const MotionTask& task, double margin, Pairs pairs = Pairs::within_reach);
  explicit MotionSystem(const MotionTask& task) : MotionSystem(task, task.margin) {}
  MotionSystem(const MotionSystem&) = delete;
  MotionSystem& operator=(const MotionSystem&) = delete;

  const narrowphase::LinkageScene& scene() const { return scene_; }
  const MotionTask& task() const { return task_; }
  double margin() const { return margin_; }  ///< m

  /// Changes the margin (m), but not the pairs. Expects one no larger than at first, at which what is out of
  /// reach is so too. As costly as building the hierarchies of all shapes.
  void grow(double margin);

  /// More than distances on the path may be off by, m. O(links * waypoints).
  double rounding() const;

  std::size_t segments() const { return task_.waypoints() - 1; }

  /// All configurations, one behind the other.
  std::span<const double> path() const { return path_; }
  std::span<const double> waypoint(std::size_t i) const;

  /// The configuration at a fraction of a segment.
  std::vector<double> values(std::size_t segment, double fraction) const;

  /// Where all movers' links stand, in the order of the task.
  std::vector<narrowphase::Pose> poses(std::size_t segment, double fraction) const;

  /// What the two are called; `part` is that of the obstacles, where it is known.
  static constexpr std::uint32_t kNoPart = 0xFFFFFFFF;
  std::pair<std::string, std::string> names(const narrowphase::LinkPair& pair, std::uint32_t part) const;

  /// How two parts lie to each other, grown as they are: of what `pair` is.
  narrowphase::Separation separation(const narrowphase::LinkPair& pair, std::uint32_t part_a,
                                     std::uint32_t part_b, std::size_t segment, double fraction) const;

 private:
  using LinkPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

  std::span<const narrowphase::Convex> grown(std::uint32_t row);
  const narrowphase::PartsBvh* shape(std::uint32_t row);
  void add_movers();
  void add_obstacles();
  void build_obstacles();
  bool are_all_obstacles(const Solids& solids) const;
  std::vector<std::uint32_t> links_of(const Solids& solids) const;  // all obstacles: kWorld, too
  LinkPairs pairs_that_may_touch() const;                           // the lower one first
  void add_pairs(Pairs pairs);
  void check_size(std::size_t pairs) const;
  std::string link_name(std::uint32_t link) const;

  const MotionTask& task_;
  double margin_;                                        // m
  [[maybe_unused]] double most_;                         // m, the margin at first: what asserts expect
  std::vector<std::vector<narrowphase::Convex>> grown_;  // a row each of the task's shapes; empty but where
                                                         // there is a margin
  std::vector<narrowphase::PartsBvh> shapes_;            // a row each of the task's; empty but those of links
  std::vector<narrowphase::Link> linkage_;
  std::uint32_t moving_ = 0;                   // links of movers, before the obstacles that are links
  std::vector<std::uint32_t> obstacle_links_;  // which obstacles these are
  std::vector<narrowphase::Convex> parts_;     // of all other obstacles, in the world's frame
  std::vector<std::uint32_t> obstacle_of_;     // of each of these
  narrowphase::PartsBvh obstacles_;
  std::vector<narrowphase::LinkPair> pairs_;
  std::vector<double> path_;
  narrowphase::LinkageScene scene_;
};

}  // namespace throng::tools
