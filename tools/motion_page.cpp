// SPDX-License-Identifier: MIT
#include "tools/motion_page.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include "sim/input_error.h"
#include "tools/answer_json.h"
#include "tools/embeddable.h"
#include "tools/motion_lanes.h"
#include "tools/replace_file.h"
#include "tools/svg_path.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPageLanes = 12;

std::string css(const Colour& colour) {
  const auto byte = [](double part) { return std::to_string(std::lround(255 * part)); };
  return "rgb(" + byte(colour.red) + " " + byte(colour.green) + " " + byte(colour.blue) + ")";
}

Json index(std::uint32_t row) {
  return row == MotionLink::kNone ? Json() : Json(row);
}

Json to_json(const MotionLink& link) {
  return {{"shape", index(link.shape)},
          {"parent", index(link.parent)},
          {"joint", link.joint == narrowphase::Joint::prismatic ? "prismatic" : "revolute"},
          {"at", json(link.at)},
          {"angle", link.angle},
          {"axis", json(link.axis)}};
}

/// About `origin`, as all that the page draws.
Json to_json(const Mover& mover, std::size_t row, const Vec& origin) {
  Json links = Json::array();
  for (const MotionLink& link : mover.links) links.push_back(to_json(link));
  return {{"colour", css(mover_colour(row))},
          {"base", {mover.base.x() - origin.x(), mover.base.y() - origin.y(), mover.base_angle}},
          {"links", links},
          {"waypoints", mover.waypoints}};
}

Json to_json(const SegmentAnswer& segment, const Vec& origin) {
  Json result{{"verdict", segment.verdict ? word(*segment.verdict) : "not asked"}};
  if (!segment.verdict || *segment.verdict == narrowphase::Verdict::free) return result;
  result["from"] = segment.from, result["to"] = segment.to;
  result["pair"] = {segment.a, segment.b};
  if (!segment.contact) return result;
  result["point"] = json(segment.contact->point - origin), result["normal"] = json(segment.contact->normal);
  return result;
}

Json to_json(const Lane& lane) {
  Json strips = Json::array();
  for (const Lane::Strip& strip : lane.strips)
    strips.push_back({strip.from, strip.to, strip.at, strip.proven});
  return {{"label", lane.label}, {"strips", strips}};
}

Json given(const MotionSystem& system, const MotionAnswer& answer) {
  const MotionView view = view_of(system, answer);
  const MotionTask& task = system.task();
  const Vec origin = (view.extent.min + view.extent.max) / 2, half = view.extent.size() / 2;
  Json shapes = Json::array(), obstacles = Json::array(), movers = Json::array(), segments = Json::array(),
       rows = Json::array(), ghosts = Json::array();
  std::uint32_t moving = 0;  // shapes of obstacles need not be there twice
  for (const Mover& mover : task.movers)
    for (const MotionLink& link : mover.links)
      if (link.shape != MotionLink::kNone) moving = std::max(moving, link.shape + 1);
  for (std::uint32_t i = 0; i < moving; ++i) shapes.push_back(svg_path(task.shapes[i], {}, Vec(0.0, 0.0)));
  for (const Obstacle& obstacle : task.obstacles)
    obstacles.push_back(
        svg_path(task.shapes[obstacle.shape], narrowphase::pose(obstacle.at, obstacle.angle), origin));
  for (std::size_t i = 0; i < task.movers.size(); ++i) movers.push_back(to_json(task.movers[i], i, origin));
  for (const SegmentAnswer& segment : answer.segments) segments.push_back(to_json(segment, origin));
  for (const Lane& lane : lanes(system, answer, kPageLanes)) rows.push_back(to_json(lane));
  for (const MotionInstant& ghost : view.ghosts)
    ghosts.push_back(static_cast<double>(ghost.segment) + ghost.fraction);
  return {{"name", task.name},
          {"description", task.description},
          {"verdict", word(answer.verdict)},
          {"summary", summary(system, answer, view)},
          {"extent", {-half.x(), -half.y(), half.x(), half.y()}},
          {"durations", task.durations.empty() ? Json() : Json(task.durations)},
          {"shapes", shapes},
          {"obstacles", obstacles},
          {"movers", movers},
          {"segments", segments},
          {"lanes", rows},
          {"ghosts", ghosts}};
}

}  // namespace

std::string motion_page_data(const MotionSystem& system, const MotionAnswer& answer) {
  return embeddable(given(system, answer));
}

void write_motion_page(const MotionSystem& system, const MotionAnswer& answer, const std::string& output) {
  const std::string_view page = kMotionHtml;
  const std::size_t place = page.find(kGiven);
  const std::string data = motion_page_data(system, answer);
  replace_file(output, [&](const std::string& name) {
    std::ofstream out(name, std::ios::binary);
    out << page.substr(0, place) << data << page.substr(place + kGiven.size());
    out.close();
    if (!out) throw InputError("cannot write " + output + ": " + std::strerror(errno));
  });
}

}  // namespace throng::tools
