// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/linkage.h"

#include <cmath>

#include "narrowphase/trigonometry.h"

namespace throng::narrowphase {

namespace {

bool finite(const Vec& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y());
}

const char* fault(const Link& link, std::size_t index) {
  if (link.parent != kWorld && link.parent >= index) return "hangs on a link that does not come before it";
  if (!finite(link.at) || !std::isfinite(link.angle))
    return "stands at a place or an angle that is not finite";
  if (!finite(link.axis) || !(std::abs(link.axis.norm() - 1.0) <= 1e-9))
    return "has an axis that is not of length 1";
  if (!(link.lower <= link.upper)) return "has limits the wrong way round";
  return nullptr;
}

}  // namespace

std::uint32_t mount(Linkage& linkage, std::span<const Link> robot, const Vec& position, double angle) {
  const auto first = static_cast<std::uint32_t>(linkage.size());
  const Pose frame = pose(position, angle);
  for (Link link : robot) {
    if (link.parent == kWorld)
      link.at = frame * link.at, link.axis = frame.rotate(link.axis), link.angle += angle;
    else
      link.parent += first;
    linkage.push_back(link);
  }
  return first;
}

std::string fault(std::span<const Link> linkage) {
  for (std::size_t i = 0; i < linkage.size(); ++i)
    if (const char* what = fault(linkage[i], i)) return "link " + std::to_string(i) + " " + what;
  return {};
}

std::optional<std::uint32_t> beyond_limits(std::span<const Link> linkage, std::span<const double> values) {
  for (std::uint32_t i = 0; i < linkage.size(); ++i)
    if (!(linkage[i].lower <= values[i] && values[i] <= linkage[i].upper)) return i;
  return std::nullopt;
}

void place_links(std::span<const Link> linkage, std::span<const double> values, std::span<Pose> poses) {
  const auto parent = [&](std::size_t i) {
    return linkage[i].parent == kWorld ? Pose{{}, 0.0} : poses[linkage[i].parent];
  };
  for (std::size_t i = 0; i < linkage.size(); ++i) {  // angles first, where their cosines will stand
    const double turned = linkage[i].joint == Joint::revolute ? values[i] : 0.0;
    poses[i].cos = parent(i).cos + linkage[i].angle + turned;
  }
  for (std::size_t i = 0; i < linkage.size(); ++i) {
    const Pose frame = linkage[i].parent == kWorld ? Pose{} : poses[linkage[i].parent];
    poses[i] = pose(frame * offset(linkage[i], values[i]), poses[i].cos);
  }
}

}  // namespace throng::narrowphase
