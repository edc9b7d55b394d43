// SPDX-License-Identifier: MIT
// throng query: who is near whom, in a scenario as it starts or in a frame of a recording.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "broadphase/neighbours.h"
#include "sim/input_error.h"
#include "sim/periodic.h"
#include "sim/sensing/body_screens.h"
#include "sim/sensing/heading.h"
#include "sim/sensing/sight.h"
#include "tools/commands.h"
#include "tools/crowd.h"
#include "tools/printable.h"

namespace throng::tools {

namespace {

using broadphase::FieldOfView;
using broadphase::Near;
using broadphase::Place;
using broadphase::ProximityTree;

constexpr double kFarthest = 1e12;          // m, of a place that is asked about
constexpr std::uint32_t kBlock = 1U << 16;  // bodies whose neighbours are held at a time

struct QueryOptions {
  std::string source, format = "csv";
  std::optional<std::string> point, heading;
  std::optional<double> radius, at, fov;
  std::optional<std::int64_t> id, nearest;
  bool all = false, sight = false, bodies_hide = false;
};

void check(const QueryOptions& options) {
  if (options.id.has_value() + options.point.has_value() + options.all != 1)
    throw InputError("query: give one of --id I, --point X,Y and --all");
  if (!options.radius && !options.nearest) throw InputError("query: give --radius R, --nearest K or both");
  if (options.radius && !(*options.radius >= 0.0))
    throw InputError("query: --radius must be 0 or more metres, or inf, not " + text_of(*options.radius));
  if (options.nearest && *options.nearest < 1)
    throw InputError("query: --nearest must be 1 or more, not " + std::to_string(*options.nearest));
  if (options.at && !std::isfinite(*options.at))
    throw InputError("query: --at must be a finite time in seconds, not " + text_of(*options.at));
  if (options.fov && !(*options.fov > 0.0 && *options.fov <= 360.0))
    throw InputError("query: --fov must be above 0 and at most 360 degrees, not " + text_of(*options.fov));
  if (options.bodies_hide && !options.sight) throw InputError("query: --bodies-hide needs --sight");
  if (options.heading && !options.fov) throw InputError("query: --heading needs --fov DEG");
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

/// A heading in degrees, where it is one.
std::optional<double> heading_in_degrees(const QueryOptions& options) {
  if (!options.heading || *options.heading == "velocity" || *options.heading == "angle") return {};
  double degrees = 0.0;
  const char *begin = options.heading->data(), *end = begin + options.heading->size();
  const auto [stop, error] = std::from_chars(begin, end, degrees);
  if (error != std::errc() || stop != end || !std::isfinite(degrees))
    throw InputError("query: --heading must be velocity, angle or a finite number of degrees, not '" +
                     *options.heading + "'");
  return degrees;
}

/// Where each body looks; empty where it looks all around.
std::vector<Vec> headings(const QueryOptions& options, const CrowdSnapshot& crowd, const FieldOfView& view) {
  if (view.all_around()) return {};
  if (const auto degrees = heading_in_degrees(options))
    return std::vector<Vec>(crowd.id.size(), direction(*degrees));
  if (options.point) throw InputError("query: --point with --fov needs --heading DEG");
  const bool by_angle = options.heading == "angle";
  if ((by_angle ? crowd.angle.size() : crowd.velocity.size()) != crowd.id.size())
    throw InputError(options.source + ": " +
                     (by_angle ? "angles " + crowd.no_angle : "velocities " + crowd.no_velocity) +
                     "; choose another --at or --heading");
  if (!by_angle) return crowd.velocity;
  std::vector<Vec> result;
  for (const double angle : crowd.angle) result.push_back(direction_of_angle(angle));
  return result;
}

/// Prints one list after the other.
class Printer {
 public:
  Printer(const std::string& format, const CrowdSnapshot& crowd) : json_(format == "json"), crowd_(crowd) {
    text_ = json_ ? "[" : "id,neighbour,distance\n";
  }

  void begin(std::optional<std::uint32_t> row) {
    id_ = row ? std::to_string(crowd_.id[*row]) : json_ ? "null" : "";
    if (json_) text_ += (first_ ? "\n{\"id\":" : ",\n{\"id\":") + id_ + ",\"neighbours\":[";
    first_ = false;
    separator_ = "";
  }

  void add(std::uint32_t row, double distance) {
    text_ += json_ ? separator_ : id_;
    text_ += json_ ? "{\"id\":" : ",";
    add_number(crowd_.id[row]);
    text_ += json_ ? ",\"distance\":" : ",";
    add_number(distance);
    text_ += json_ ? "}" : "\n";
    separator_ = ",";
    if (text_.size() > kEnough) write();
  }

  void end() {
    if (json_) text_ += "]}";
  }

  void finish() {
    if (json_) text_ += "\n]\n";
    write();
  }

 private:
  static constexpr std::size_t kEnough = 1 << 16;  // bytes to write at once

  /// The shortest text that reads back as the same number.
  template <class Number>
  void add_number(Number number) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  }

  void write() {
    std::fwrite(text_.data(), 1, text_.size(), stdout);
    text_.clear();
  }

  bool json_, first_ = true;
  const CrowdSnapshot& crowd_;
  std::string text_, id_;
  const char* separator_ = "";
};

using Neighbours = std::vector<broadphase::Neighbour>;

/// What is asked of whom.
struct Query {
  const CrowdSnapshot& crowd;
  const ProximityTree& tree;
  const Sight* sight;          ///< null: nobody looks
  const BodyScreens* screens;  ///< null: bodies hide nobody
  const Near& near;

  /// Replaces `neighbours` by those of a place. Where some are out of sight asks for ever more, until as many
  /// as are wanted are in sight, or no more are left.
  void find(const Place& place, Neighbours& neighbours) const {
    for (Near more = near;; more.most *= 2) {
      find_near(tree, place, more, neighbours);
      if (!sight) return;
      const bool are_all = neighbours.size() < more.most;
      std::erase_if(neighbours, [&](const auto& n) {
        return !sight->sees(place.at, crowd.position[n.row]) ||
               (screens && screens->hide(place.at, place.except, n.row));
      });
      if (neighbours.size() < near.most && !are_all) continue;
      if (neighbours.size() > near.most) neighbours.resize(near.most);
      return;
    }
  }
};

/// Of one body, or of a place.
void print_one(const Query& query, const Place& place, Printer& printer) {
  Neighbours neighbours;
  query.find(place, neighbours);
  printer.begin(place.except);
  for (const broadphase::Neighbour& n : neighbours) printer.add(n.row, n.distance);
  printer.end();
}

/// Of every body, some at a time so that memory stays small.
void print_all(const Query& query, const std::vector<Vec>& heading, Printer& printer) {
  const CrowdSnapshot& crowd = query.crowd;
  broadphase::NeighbourSearch search;
  broadphase::NeighbourLists lists;
  for (std::uint32_t first = 0; first < crowd.id.size(); first += kBlock) {
    const std::size_t count = std::min<std::size_t>(kBlock, crowd.id.size() - first);
    broadphase::Places places{.at = std::span(crowd.position).subspan(first, count), .own = first};
    if (!heading.empty()) places.heading = std::span(heading).subspan(first, count);
    search.find(query.tree, places, query.near, lists);
    for (std::uint32_t i = 0; i < count; ++i) {
      printer.begin(first + i);
      for (std::size_t k = lists.begin[i]; k < lists.begin[i + 1]; ++k)
        printer.add(lists.row[k], lists.distance[k]);
      printer.end();
    }
  }
}

/// The same between walls, one body after the other.
void print_all_in_sight(const Query& query, const std::vector<Vec>& heading, Printer& printer) {
  for (std::uint32_t row = 0; row < query.crowd.id.size(); ++row)
    print_one(query, {query.crowd.position[row], heading.empty() ? Vec(0.0, 0.0) : heading[row], row},
              printer);
}

/// Who hides others needs its angle, unless it is a disc.
void place_screens(const QueryOptions& options, const CrowdSnapshot& crowd,
                   std::optional<BodyScreens>& screens) {
  const Bodies& bodies = crowd.scene.bodies;
  const auto is_disc = [&](std::uint32_t row) {
    return crowd.scene.shapes[bodies.shape[row - 1]].kind == ShapeKind::disc;
  };
  if (crowd.angle.size() != crowd.id.size() && !std::ranges::all_of(crowd.body, is_disc))
    throw InputError(options.source + ": --bodies-hide needs angles, which " + crowd.no_angle);
  screens.emplace(crowd.scene);
  screens->place(crowd.body, crowd.position, crowd.angle);
}

void query(const QueryOptions& options) {
  check(options);
  Place place;
  if (options.point) place.at = parse_point(*options.point);
  const auto degrees = heading_in_degrees(options);
  const CrowdSnapshot crowd = read_crowd(options.source, options.at);
  const broadphase::Period* period = crowd.period ? &*crowd.period : nullptr;
  Near near{.view = field_of_view(options.fov.value_or(360.0))};
  if (options.radius) near.radius = *options.radius;
  if (options.nearest) near.most = static_cast<std::size_t>(*options.nearest);
  const std::vector<Vec> heading = headings(options, crowd, near.view);

  if (options.id) {
    const std::uint32_t row = row_of(crowd, *options.id, options.source);
    place = {crowd.position[row], heading.empty() ? Vec(0.0, 0.0) : heading[row], row};
  } else if (options.point) {
    if (period) place.at = wrapped(place.at, crowd.scene.domain);
    if (degrees) place.heading = direction(*degrees);
  }
  ProximityTree tree;
  tree.build(crowd.position, period);
  Printer printer(options.format, crowd);
  std::optional<Sight> sight;
  if (options.sight) sight.emplace(crowd.scene.walls, crowd.period, near.radius);
  std::optional<BodyScreens> screens;
  if (options.bodies_hide) place_screens(options, crowd, screens);
  const Query ask{crowd, tree, sight ? &*sight : nullptr, screens ? &*screens : nullptr, near};
  if (!options.all)
    print_one(ask, place, printer);
  else if (sight)
    print_all_in_sight(ask, heading, printer);
  else
    print_all(ask, heading, printer);
  printer.finish();
}

/// CLI11 takes an empty value for an option that isn't there.
CLI::Validator something() {
  const auto check = [](std::string& text) {
    return text.empty() ? std::string("a value is missing") : std::string();
  };
  return {check, ""};
}

}  // namespace

void add_query(CLI::App& app, int&) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* command = app.add_subcommand(
      "query",
      "Tells who is within a radius, or nearest, of a body, a point, or every body: from centre to centre,\n"
      "in a periodic domain to the nearest image; nearest first, then by id");
  command->add_option("SOURCE", options->source, "scenario or recording (.h5)")->required();
  command
      ->add_option("--radius", options->radius,
                   "how far away neighbours may be, centre to centre (m), 0 or more; any distance without it")
      ->check(real_number());
  command->add_option("--nearest", options->nearest, "at most so many, the nearest: 1 or more")
      ->transform(whole_number());
  command->add_option("--id", options->id, "of the body with this id")->transform(whole_number());
  command
      ->add_option("--point", options->point,
                   "X,Y (m): of a place, which has no id: an empty column, null in json")
      ->check(something());
  command->add_flag("--all", options->all, "of every body, in order of id");
  command
      ->add_option("--at", options->at,
                   "time (s): the nearest frame, by default the last; a scenario is asked as it starts")
      ->check(real_number());
  command->add_option("--fov", options->fov, "only what is in a view so wide (degrees), its borders included")
      ->check(real_number());
  command
      ->add_option("--heading", options->heading,
                   "what the view is centred on: velocity (default; who rests sees all around), angle, or\n"
                   "degrees from the x axis, which --point needs")
      ->check(something());
  command->add_flag("--sight", options->sight,
                    "only whom no wall hides: none that the line from centre to centre touches");
  command->add_flag("--bodies-hide", options->bodies_hide, "with --sight: nor whom another body hides");
  command
      ->add_option("--format", options->format,
                   "csv (id,neighbour,distance) or json ([{id, neighbours: [{id, distance}]}])")
      ->check(CLI::IsMember({"csv", "json"}))
      ->capture_default_str();
  command->footer(
      "Examples: throng query scenarios/pile.toml --radius 1 --id 17\n"
      "          throng query out.h5 --at 2.5 --point 3,4 --nearest 5 --fov 120 --heading 90");
  command->callback([options] { query(*options); });
}

}  // namespace throng::tools
