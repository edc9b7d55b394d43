// SPDX-License-Identifier: MIT
// throng query: who is near whom, in a scenario as it starts or in a frame of a recording.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>

#include "broadphase/box_index.h"
#include "broadphase/neighbours.h"
#include "sim/input_error.h"
#include "sim/recording/recording.h"
#include "tools/commands.h"
#include "tools/scenario.h"

namespace throng::tools {

namespace {

using broadphase::Near;
using broadphase::Neighbour;
using broadphase::Period;
using broadphase::PointGrid;

constexpr double kFarthest = 1e12;       // m, of a place that is asked about
constexpr double kFarthestBody = 1e150;  // m; squared distances stay finite

struct Options {
  std::string source, format = "csv";
  std::optional<std::string> point;
  std::optional<double> radius, at, fov;
  std::optional<std::int64_t> id, nearest;
  bool all = false, sight = false;
};

/// The bodies that are asked about, a row each in order of id.
struct Crowd {
  std::vector<std::uint32_t> id;
  std::vector<Vec> position;  ///< m, in the period where there is one
  std::optional<Period> period;
};

void check(const Options& options) {
  if (options.fov) throw InputError("not supported yet: --fov");
  if (options.sight) throw InputError("not supported yet: --sight");
  if (options.id.has_value() + options.point.has_value() + options.all != 1)
    throw InputError("query: give one of --id I, --point X,Y and --all");
  if (!options.radius && !options.nearest) throw InputError("query: give --radius R, --nearest K or both");
  if (options.radius && !(*options.radius >= 0.0))
    throw InputError("query: --radius must be 0 or more metres, or inf");
  if (options.nearest && *options.nearest < 1) throw InputError("query: --nearest must be 1 or more");
  if (options.at && !std::isfinite(*options.at))
    throw InputError("query: --at must be a finite time in seconds");
}

Vec parse_point(const std::string& text) {
  Vec p{0.0, 0.0};
  const char *at = text.data(), *end = at + text.size();
  for (int axis = 0; axis < 2; ++axis) {
    const auto [next, error] = std::from_chars(at, end, p[axis]);
    const bool last = axis == 1;
    if (error != std::errc() || !std::isfinite(p[axis]) || (last ? next != end : next == end || *next != ','))
      throw InputError("query: --point must be two finite numbers X,Y in metres, not '" + text + "'");
    at = next + 1;
  }
  if (p.cwiseAbs().maxCoeff() > kFarthest)
    throw InputError("query: --point must be at most 1e12 m from the origin on either axis, not '" + text +
                     "'");
  return p;
}

bool is_recording(const std::string& file) {
  char signature[8] = {};
  std::ifstream(file, std::ios::binary).read(signature, sizeof signature);
  return std::string(signature, sizeof signature) == "\x89HDF\r\n\x1a\n" || file.ends_with(".h5") ||
         file.ends_with(".h5.part");
}

/// A scenario as it starts.
Crowd crowd_of_scenario(const Options& options, Scene& scene) {
  if (options.at.value_or(0.0) != 0.0)
    throw InputError(
        options.source +
        ": a scenario is asked at its start, --at 0; for later times record a run with 'throng run " +
        options.source + " -o FILE.h5' and ask the recording");
  scene = load_or_throw(options.source).scene;
  Crowd crowd;
  for (std::uint32_t row = 0; row < scene.bodies.size(); ++row) crowd.id.push_back(row + 1);
  crowd.position = scene.bodies.position;
  return crowd;
}

/// The frame nearest to the time that is asked for, else the last one.
Crowd crowd_of_recording(const Options& options, Scene& scene) {
  const Recording recording(options.source);
  if (recording.frames() == 0) throw InputError(options.source + ": holds no frame yet");
  const double first = recording.times().front(), last = recording.times().back();
  const double at = options.at.value_or(last), slack = 1e-9 * std::abs(last);
  if (at < first - slack || at > last + slack)
    throw InputError(options.source + ": --at " + std::to_string(at) +
                     " is outside the recording, which goes from " + std::to_string(first) + " s to " +
                     std::to_string(last) + " s");
  Frame frame = recording.frame_at(at);
  if (frame.position.size() != frame.id.size())
    throw InputError(options.source + ": positions were not recorded (record.fields)");
  scene = recording.geometry();
  return {std::move(frame.id), std::move(frame.position), {}};
}

/// Brings a point into the period that starts at `origin`.
Vec wrap(Vec p, const Period& period) {
  for (int axis = 0; axis < 2; ++axis) {
    const double low = period.origin[axis], size = period.size[axis];
    if (p[axis] < low || p[axis] > low + size)
      p[axis] = std::clamp(p[axis] - size * std::floor((p[axis] - low) / size), low, low + size);
  }
  return p;
}

Crowd crowd(const Options& options) {
  Scene scene;
  Crowd crowd =
      is_recording(options.source) ? crowd_of_recording(options, scene) : crowd_of_scenario(options, scene);
  if (scene.domain.kind == DomainKind::periodic)
    crowd.period = {scene.domain.min, scene.domain.max - scene.domain.min};
  for (std::size_t row = 0; row < crowd.id.size(); ++row) {
    if (!crowd.position[row].allFinite() || crowd.position[row].cwiseAbs().maxCoeff() > kFarthestBody)
      throw InputError(options.source + ": body " + std::to_string(crowd.id[row]) +
                       " has no position within 1e150 m of the origin");
    if (crowd.period) crowd.position[row] = wrap(crowd.position[row], *crowd.period);
  }
  return crowd;
}

std::uint32_t row_of(const Crowd& crowd, std::int64_t id, const std::string& source) {
  const auto found = std::ranges::find_if(crowd.id, [id](std::uint32_t other) { return other == id; });
  if (found == crowd.id.end())
    throw InputError(source + ": no body has the id " + std::to_string(id) +
                     (crowd.id.empty() ? ": there are none"
                                       : "; ids go from " + std::to_string(crowd.id.front()) + " to " +
                                             std::to_string(crowd.id.back())));
  return static_cast<std::uint32_t>(found - crowd.id.begin());
}

/// Cells that suit the question: as wide as the radius, but where a few are enough no wider than those few
/// need.
double cell_size(const Crowd& crowd, const Near& near) {
  broadphase::Box box;
  for (const Vec& p : crowd.position) box.extend(p);
  const double count = static_cast<double>(std::max<std::size_t>(crowd.position.size(), 1));
  const double few = static_cast<double>(std::min(near.most, crowd.position.size()));
  const double enough = box.isEmpty() ? 0.0 : box.sizes().maxCoeff() * std::sqrt((few + 1.0) / count);
  return std::min(near.radius, enough);
}

/// The shortest text that reads back as the same number.
std::string text(double x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

/// Prints one list after the other, so that no more than one is held.
class Printer {
 public:
  Printer(const std::string& format, const Crowd& crowd) : json_(format == "json"), crowd_(crowd) {
    std::fputs(json_ ? "[" : "id,neighbour,distance\n", stdout);
  }

  void print(std::optional<std::uint32_t> row, const std::vector<Neighbour>& neighbours) {
    const std::string id = row ? std::to_string(crowd_.id[*row]) : json_ ? "null" : "";
    if (json_) std::printf("%s\n{\"id\":%s,\"neighbours\":[", first_ ? "" : ",", id.c_str());
    first_ = false;
    const char* separator = "";
    for (const Neighbour& n : neighbours) {
      const char* form = json_ ? "%s{\"id\":%u,\"distance\":%s}" : "%s,%u,%s\n";
      std::printf(form, json_ ? separator : id.c_str(), crowd_.id[n.row], text(n.distance).c_str());
      separator = ",";
    }
    if (json_) std::fputs("]}", stdout);
  }

  void finish() {
    if (json_) std::fputs("\n]\n", stdout);
  }

 private:
  bool json_, first_ = true;
  const Crowd& crowd_;
};

void query(const Options& options) {
  check(options);
  const Vec point = options.point ? parse_point(*options.point) : Vec(0.0, 0.0);
  const Crowd crowd = tools::crowd(options);
  Near near;
  if (options.radius) near.radius = *options.radius;
  if (options.nearest) near.most = static_cast<std::size_t>(*options.nearest);
  const std::optional<std::uint32_t> one =
      options.id ? std::optional(row_of(crowd, *options.id, options.source)) : std::nullopt;

  PointGrid grid;
  grid.rebuild(crowd.position, cell_size(crowd, near), crowd.period ? &*crowd.period : nullptr);
  std::vector<Neighbour> neighbours;
  Printer printer(options.format, crowd);
  if (options.point) {
    find_near(grid, crowd.period ? wrap(point, *crowd.period) : point, near, neighbours);
    printer.print({}, neighbours);
  } else {
    const std::uint32_t end = one ? *one + 1 : static_cast<std::uint32_t>(crowd.id.size());
    for (std::uint32_t row = one.value_or(0); row < end; ++row) {
      find_near(grid, crowd.position[row], near, neighbours, row);
      printer.print(row, neighbours);
    }
  }
  printer.finish();
}

/// CLI11 takes an empty value for an option that isn't there.
CLI::Validator something() {
  const auto check = [](std::string& text) {
    return text.empty() ? std::string("a value is missing") : std::string();
  };
  return {check, ""};
}

/// Leaves a whole number in decimals as CLI11 reads it, which alone takes 010 for 8 and what is out of range
/// for the largest there is.
CLI::Validator whole_number() {
  const auto check = [](std::string& text) -> std::string {
    std::int64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc::result_out_of_range) return text + " is out of range";
    if (error != std::errc() || stop != end) return "'" + text + "' is no whole number";
    text = std::to_string(number);
    return {};
  };
  return {check, ""};
}

}  // namespace

void add_query(CLI::App& app, int&) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "query",
      "Tells which bodies are within a radius, or nearest, of a body, a point, or of every body.\n"
      "Distances go from centre to centre, in a periodic domain to the nearest image; nearest first, then by "
      "id.\n"
      "csv: a line 'id,neighbour,distance' for each; json: [{\"id\", \"neighbours\": [{\"id\", "
      "\"distance\"}]}].\n"
      "For --point the id is empty in csv and null in json.");
  command->add_option("SOURCE", options->source, "scenario, asked as it starts, or recording (.h5)")
      ->required();
  command->add_option("--radius", options->radius, "how far away neighbours may be (m); inf without it")
      ->check(something());
  command->add_option("--id", options->id, "neighbours of the body with this id, itself left out")
      ->transform(whole_number());
  command->add_option("--point", options->point, "X,Y (m): neighbours of a place")->check(something());
  command->add_flag("--all", options->all, "neighbours of every body, in order of id");
  command->add_option("--at", options->at, "time (s); the nearest recorded frame, the last one without it")
      ->check(something());
  command->add_option("--nearest", options->nearest, "at most so many, the nearest")
      ->transform(whole_number());
  command->add_option("--fov", options->fov, "not supported yet");
  command->add_flag("--sight", options->sight, "not supported yet");
  command->add_option("--format", options->format, "csv or json")->check(CLI::IsMember({"csv", "json"}));
  command->footer(
      "Examples: throng query scenarios/pile.toml --radius 1 --id 17\n"
      "          throng query out.h5 --at 2.5 --point 3,4 --nearest 5");
  command->callback([options] { query(*options); });
}

}  // namespace throng::tools
