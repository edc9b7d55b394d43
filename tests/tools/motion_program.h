// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>

#include "narrowphase/nearest_parts.h"
#include "scenarios/read_motion.h"
#include "tests/tools/program.h"

namespace throng {

using narrowphase::Pose;
using nlohmann::json;

const std::string kExamples = THRONG_SOURCE_DIR "/scenarios/motions/";

class MotionCommand : public Program {
 protected:
  json ask_file(const std::string& file, const std::string& options = "") const {
    const Result result = throng("motion " + file + " " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  json ask(const std::string& text, const std::string& options = "") const {
    return ask_file(write("m.toml", "motion = 1\n" + text), options);
  }
};

struct Placed {
  std::size_t mover, link;
  const MotionShape* shape;
  Pose pose;
};

inline std::vector<Placed> placed(const MotionTask& task, std::size_t segment, double part) {
  std::vector<Placed> result;
  for (std::size_t m = 0; m < task.movers.size(); ++m) {
    const Mover& mover = task.movers[m];
    std::vector<std::pair<Vec, double>> frames;
    for (std::size_t i = 0; i < mover.links.size(); ++i) {
      const MotionLink& link = mover.links[i];
      const double from = mover.waypoints[segment][i], to = mover.waypoints[segment + 1][i];
      const double q = from + part * (to - from);
      const auto [at, turn] =
          link.parent == MotionLink::kNone ? std::pair(mover.base, mover.base_angle) : frames[link.parent];
      const bool slides = link.joint == narrowphase::Joint::prismatic;
      const Vec local = slides ? Vec(link.at + q * link.axis) : link.at;
      frames.emplace_back(narrowphase::pose(at, turn) * local, turn + link.angle + (slides ? 0.0 : q));
      if (link.shape != MotionLink::kNone)
        result.push_back(
            {m, i, &task.shapes[link.shape], narrowphase::pose(frames[i].first, frames[i].second)});
    }
  }
  return result;
}

/// The least distance of what may not touch: below 0 where something overlaps.
inline double least_distance(const MotionTask& task, std::size_t segment, double part) {
  const std::vector<Placed> movers = placed(task, segment, part);
  double least = 1e300;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const auto meet = [&](const MotionShape& other, const Pose& pose) {
      least = std::min(
          least, narrowphase::separation(movers[i].shape->parts, movers[i].pose, other.parts, pose).distance);
    };
    for (const Obstacle& obstacle : task.obstacles)
      meet(task.shapes[obstacle.shape], narrowphase::pose(obstacle.at, obstacle.angle));
    for (std::size_t k = 0; k < i; ++k)
      if (movers[k].mover != movers[i].mover || movers[k].link + 1 < movers[i].link)
        meet(*movers[k].shape, movers[k].pose);
  }
  return least;
}

}  // namespace throng
