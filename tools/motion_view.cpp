// SPDX-License-Identifier: MIT
#include "tools/motion_view.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

#include "tools/answer_json.h"

namespace throng::tools {

namespace {

using narrowphase::Convex;
using narrowphase::Pose;

constexpr std::size_t kGhosts = 32;     // about, all segments together
constexpr std::size_t kSamples = 1024;  // about, at which the extent is looked for beside all waypoints

void include(Extent& extent, const Convex& part, const Pose& pose) {
  for (const Vec& vertex : part.vertices) {
    const Vec at = pose * vertex, reach(part.radius, part.radius);
    extent.min = extent.min.cwiseMin(at - reach);
    extent.max = extent.max.cwiseMax(at + reach);
  }
}

Extent nothing() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {Vec(kInfinity, kInfinity), Vec(-kInfinity, -kInfinity)};
}

void include_movers(const MotionSystem& system, const MotionInstant& instant, Extent& extent) {
  const std::vector<Pose> poses = system.poses(instant.segment, instant.fraction);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (const narrowphase::PartsBvh* shape = system.scene().linkage[i].shape)
      for (const Convex& part : shape->parts) include(extent, part, poses[i]);
}

/// About `count` instants from the start to the end: waypoints, each `stride`th of them, and between two as
/// many as that leaves room for.
std::vector<MotionInstant> instants(std::size_t segments, std::size_t count, std::size_t stride) {
  const std::size_t each = std::clamp<std::size_t>(count / segments, 1, count);
  std::vector<MotionInstant> result;
  for (std::size_t i = 0; i < segments; i += stride)
    for (std::size_t k = 0; k < each; ++k)
      result.push_back({i, static_cast<double>(k) / static_cast<double>(each)});
  result.push_back({segments - 1, 1.0});
  return result;
}

/// What obstacles have within so much of the extent's longer side belongs to it.
void include_near(const MotionSystem& system, Extent& extent) {
  const double near = 0.2 * extent.size().maxCoeff();
  const Extent wide{extent.min - Vec(near, near), extent.max + Vec(near, near)};
  const MotionTask& task = system.task();
  for (const Obstacle& obstacle : task.obstacles)
    for (const Convex& part : task.shapes[obstacle.shape].parts) {
      Extent own = nothing();
      include(own, part, narrowphase::pose(obstacle.at, obstacle.angle));
      own.min = own.min.cwiseMax(wide.min), own.max = own.max.cwiseMin(wide.max);
      if (!(own.size().minCoeff() >= 0.0)) continue;
      extent.min = extent.min.cwiseMin(own.min), extent.max = extent.max.cwiseMax(own.max);
    }
}

Extent with_wide_margin(Extent extent) {
  const double longer = std::max(extent.size().maxCoeff(), 1e-9 * (1.0 + extent.min.cwiseAbs().maxCoeff()));
  const Vec lack = ((0.3 * longer - extent.size().array()).max(0.0) / 2 + 0.04 * longer).matrix();
  return {extent.min - lack, extent.max + lack};
}

void find_contact(const MotionAnswer& answer, MotionView& view) {
  for (std::size_t i = 0; i < answer.segments.size(); ++i) {
    const SegmentAnswer& segment = answer.segments[i];
    if (!segment.verdict || *segment.verdict == narrowphase::Verdict::free) continue;
    if (!segment.contact && view.contact) continue;
    view.contact = MotionInstant{i, segment.contact ? segment.to : segment.from};
    view.doubt = !segment.contact;
    if (segment.contact) return;
  }
}

}  // namespace

MotionView view_of(const MotionSystem& system, const MotionAnswer& answer) {
  const std::size_t segments = system.segments();
  MotionView view{nothing(), instants(segments, kGhosts, std::max<std::size_t>(1, segments / kGhosts)),
                  std::nullopt, false};
  for (const MotionInstant& instant : instants(segments, kSamples, 1))
    include_movers(system, instant, view.extent);
  include_near(system, view.extent);
  view.extent = with_wide_margin(view.extent);
  find_contact(answer, view);
  return view;
}

std::string summary(const MotionSystem& system, const MotionAnswer& answer, const MotionView& view) {
  std::string text = word(answer.verdict);
  char number[40];
  if (system.margin() > 0.0) {
    std::snprintf(number, sizeof number, " at a margin of %.6g m", system.margin());
    text += number;
  }
  if (view.contact) {
    const SegmentAnswer& segment = answer.segments[view.contact->segment];
    std::snprintf(number, sizeof number, "%.6g", segment.contact ? segment.to : segment.from);
    text += ": " + segment.a + " – " + segment.b + " at " + number + " of segment " +
            std::to_string(view.contact->segment);
    if (const auto time =
            seconds(system.task(), view.contact->segment, segment.contact ? segment.to : segment.from)) {
      std::snprintf(number, sizeof number, ", %.6g s", *time);
      text += number;
    }
  }
  return text;
}

Colour mover_colour(std::size_t mover) {
  constexpr std::array<Colour, 5> kColours{{{0.0, 0.447, 0.698},
                                            {0.902, 0.624, 0.0},
                                            {0.0, 0.62, 0.451},
                                            {0.8, 0.475, 0.655},
                                            {0.337, 0.706, 0.914}}};
  return kColours[mover % kColours.size()];
}

}  // namespace throng::tools
