// SPDX-License-Identifier: MIT
#include "tools/replay_page.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "sim/input_error.h"
#include "tools/base64.h"
#include "tools/framing.h"
#include "tools/palette.h"
#include "tools/replace_file.h"

namespace throng::tools {

namespace {

using Json = nlohmann::json;

constexpr double kBytes = 14e6;            // of frames, before base64
constexpr std::size_t kSamples = 12;       // frames that decide on extent and colours
constexpr std::uint16_t kNowhere = 65535;  // a body outside the box
constexpr double kSteps = 65534;

/// What of the recording goes into the page, and how.
struct Selection {
  std::vector<std::size_t> frames;  ///< evenly spread, the first and the last among them
  Extent shown, box;                ///< at the start; as far as places are kept
  double top = 0.0;                 ///< m/s
  bool angles = false, speeds = false;
};

/// `count` of `n` rows, evenly spread, with the first and the last.
std::vector<std::size_t> spread(std::size_t n, std::size_t count) {
  count = std::min(n, std::max<std::size_t>(count, 2));
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < count; ++i) rows.push_back(count == 1 ? 0 : i * (n - 1) / (count - 1));
  return rows;
}

Selection select(const Recording& recording) {
  const Scene& scene = recording.geometry();
  Selection result;
  result.angles = scene.record.angle;
  result.speeds = scene.record.velocity;
  const double per_frame =
      (4.0 + 2 * result.angles + result.speeds) * static_cast<double>(recording.bodies()) + 1;
  result.frames = spread(recording.frames(), static_cast<std::size_t>(kBytes / per_frame));

  std::vector<Vec> positions;
  std::vector<double> speeds;
  for (std::size_t i : spread(recording.frames(), kSamples)) {
    const Frame frame = recording.frame(i);
    positions.insert(positions.end(), frame.position.begin(), frame.position.end());
    for (std::size_t row = 0; row < frame.velocity.size(); ++row)
      if (scene.bodies.kind[row] == BodyKind::dynamic) speeds.push_back(frame.velocity[row].norm());
  }
  result.shown = framing(scene, positions);
  result.box = {result.shown.min - result.shown.size(), result.shown.max + result.shown.size()};
  result.top = top_speed(speeds.data(), static_cast<long>(speeds.size()));
  return result;
}

void put(std::vector<std::uint8_t>& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 255));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

std::uint16_t place(const Vec& position, const Extent& box, int axis) {
  const Vec at = (position - box.min).cwiseQuotient(box.size());
  const bool inside = (at.array() >= 0).all() && (at.array() <= 1).all();
  return inside ? static_cast<std::uint16_t>(std::lround(at[axis] * kSteps)) : kNowhere;
}

std::uint16_t turn(double angle) {
  const double turns = angle / (2 * std::numbers::pi);
  return static_cast<std::uint16_t>(std::lround((turns - std::floor(turns)) * 65536) & 65535);
}

void put_frame(std::vector<std::uint8_t>& bytes, const Frame& frame, const Selection& selection) {
  for (int axis = 0; axis < 2; ++axis)
    for (const Vec& position : frame.position) put(bytes, place(position, selection.box, axis));
  for (double angle : frame.angle) put(bytes, turn(angle));
  for (const Vec& v : frame.velocity) {
    const double part = selection.top > 0 ? std::min(1.0, v.norm() / selection.top) : 0.0;
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * part)));
  }
  if (bytes.size() % 2 != 0) bytes.push_back(0);
}

Json flat(const std::vector<Vec>& points) {
  Json json = Json::array();
  for (const Vec& p : points) {
    json.push_back(p.x());
    json.push_back(p.y());
  }
  return json;
}

Json rectangle(const Extent& e) {
  return {e.min.x(), e.min.y(), e.max.x(), e.max.y()};
}

/// A list of rounded polygons; empty for a disc, whose radius is its body's.
Json shape(const Shape& shape) {
  if (!shape.outline.empty()) return {{{"points", flat(shape.outline)}, {"radius", 0}}};
  Json parts = Json::array();
  for (const narrowphase::Convex& part : shape.parts)
    parts.push_back({{"points", flat(part.vertices)}, {"radius", part.radius}});
  return parts;
}

Json domain(const Domain& domain) {
  constexpr const char* kinds[] = {"unbounded", "box", "periodic"};
  return {{"kind", kinds[static_cast<int>(domain.kind)]},
          {"min", {domain.min.x(), domain.min.y()}},
          {"max", {domain.max.x(), domain.max.y()}}};
}

Json colours() {
  Json json = Json::array();
  for (int i = 0; i <= 16; ++i) {
    const Colour c = palette(i / 16.0);
    json.push_back({std::lround(255 * c.red), std::lround(255 * c.green), std::lround(255 * c.blue)});
  }
  return json;
}

Json describe(const Recording& recording, const Selection& selection) {
  const Scene& scene = recording.geometry();
  Json shapes = Json::array(), walls = Json::array(), kinds = Json::array(), times = Json::array(),
       steps = Json::array();
  for (const Shape& s : scene.shapes) shapes.push_back(shape(s));
  for (const Wall& wall : scene.walls) {
    Json points = Json::array();
    for (const Vec& p : wall.points) points.push_back({p.x(), p.y()});
    walls.push_back({{"points", points}, {"closed", wall.closed}});
  }
  for (BodyKind kind : scene.bodies.kind) kinds.push_back(static_cast<int>(kind));
  for (std::size_t i : selection.frames) {
    times.push_back(recording.times()[i]);
    steps.push_back(recording.steps()[i]);
  }
  return {{"name", scene.name},
          {"version", recording.origin().version},
          {"frames", recording.frames()},
          {"complete", recording.complete()},
          {"domain", domain(scene.domain)},
          {"shapes", shapes},
          {"walls", walls},
          {"times", times},
          {"steps", steps},
          {"shown", rectangle(selection.shown)},
          {"box", rectangle(selection.box)},
          {"top", selection.top},
          {"angles", selection.angles},
          {"speeds", selection.speeds},
          {"palette", colours()},
          {"bodies", {{"shape", scene.bodies.shape}, {"radius", scene.bodies.radius}, {"kind", kinds}}}};
}

/// JSON that may stand in a script element: no text can end it.
std::string embeddable(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
  for (char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

std::string encode_frames(const Recording& recording, const Selection& selection) {
  std::vector<std::uint8_t> bytes;
  Frame frame;
  for (std::size_t i : selection.frames) {
    recording.read(i, frame);
    put_frame(bytes, frame, selection);
  }
  return base64(bytes);
}

void write_filled(std::ostream& out, std::string_view page, const std::string& scene,
                  const std::string& frames) {
  constexpr std::string_view scene_mark = "@SCENE@", frames_mark = "@FRAMES@";
  const std::size_t a = page.find(scene_mark), b = page.find(frames_mark);
  out << page.substr(0, a) << scene << page.substr(a + scene_mark.size(), b - a - scene_mark.size()) << frames
      << page.substr(b + frames_mark.size());
}

}  // namespace

void write_replay_page(const Recording& recording, const std::string& output) {
  if (recording.frames() == 0) throw InputError("there is nothing to replay: the recording holds no frames");
  if (!recording.geometry().record.position)
    throw InputError("there is nothing to replay: the recording holds no positions");
  const Selection selection = select(recording);
  std::string page;
  for (const char* const* piece = kReplayHtml; *piece; ++piece) page += *piece;
  const std::string scene = embeddable(describe(recording, selection)),
                    frames = encode_frames(recording, selection);
  replace_file(output, [&](const std::string& name) {
    std::ofstream out(name, std::ios::binary);
    write_filled(out, page, scene, frames);
    out.close();
    if (!out) throw InputError("cannot write " + output + ": " + std::strerror(errno));
  });
}

}  // namespace throng::tools
