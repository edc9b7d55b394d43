// SPDX-License-Identifier: MIT
// throng info: what a recording holds.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sim/recording/recording.h"
#include "tools/commands.h"
#include "tools/printable.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> fields(const Record& record) {
  std::vector<std::string> names;
  for (RecordField field : kRecordFields)
    if (is_recorded(record, field)) names.push_back(name(field));
  return names;
}

/// Steps from one sample to the next, of each field.
std::vector<int> steps_apart(const Record& record) {
  std::vector<int> steps;
  for (RecordField field : kRecordFields)
    if (const int rate = every(record, field)) steps.push_back(rate);
  return steps;
}

/// The frames that hold what is recorded each so many steps.
std::int64_t frames_with(const Recording& recording, int every) {
  return std::ranges::count_if(recording.steps(), [every](std::int64_t step) { return step % every == 0; });
}

std::vector<std::int64_t> samples(const Recording& recording) {
  std::vector<std::int64_t> counts;
  for (const int rate : steps_apart(recording.geometry().record))
    counts.push_back(frames_with(recording, rate));
  return counts;
}

/// Of the recorded ones.
Json sensors(const Scene& scene) {
  Json all = Json::array();
  for (const Sensor& sensor : scene.sensors)
    all.push_back({{"name", sensor.name},
                   {"radius", sensor.radius},
                   {"fov_degrees", sensor.fov},
                   {"sight", name(sensor.screens)},
                   {"every", sensor.every}});
  return all.empty() ? Json(nullptr) : all;
}

Json measures(const Scene& scene) {
  Json all = Json::array();
  for (const Measure& measure : scene.crowd.measures)
    all.push_back({{"name", measure.name}, {"of", measure.area.empty() ? "line" : "area"}});
  return all.empty() ? Json(nullptr) : all;
}

Json walkable(const Region& floor) {
  if (floor.empty()) return nullptr;
  const Eigen::AlignedBox2d box = bounds(floor);
  return {{"min", {box.min().x(), box.min().y()}},
          {"max", {box.max().x(), box.max().y()}},
          {"rings", floor.rings.size()}};
}

Json areas(const Crowd& crowd) {
  constexpr const char* uses[] = {"none", "goal", "wait"};
  Json all = Json::array();
  for (const Area& area : crowd.areas)
    all.push_back({{"name", area.name}, {"use", uses[static_cast<int>(area.use)]}});
  return all.empty() ? Json(nullptr) : all;
}

Json queues(const Crowd& crowd) {
  Json all = Json::array();
  for (const Queue& queue : crowd.queues)
    all.push_back({{"name", queue.name}, {"spacing", queue.spacing}, {"service", queue.service}});
  return all.empty() ? Json(nullptr) : all;
}

/// How many arrived, and s, of the first and the last who did: none of it known where the file doesn't say
/// it, null where nobody could.
Json arrivals(const Recording& recording) {
  if (recording.geometry().crowd.walkable.empty()) return nullptr;
  const std::optional<Arrivals> all = recording.arrivals();
  if (!all) return {{"count", nullptr}, {"first", nullptr}, {"last", nullptr}};
  const auto time = [&](std::int64_t step) {
    return rounded(static_cast<double>(step) * recording.geometry().time.dt);
  };
  const bool any = !all->step.empty();
  return {{"count", all->id.size()},
          {"first", any ? Json(time(all->step.front())) : Json(nullptr)},
          {"last", any ? Json(time(all->step.back())) : Json(nullptr)}};
}

Json region(const Record& record) {
  if (!record.within) return nullptr;
  const Vec &low = record.within->min(), &high = record.within->max();
  return {{low.x(), low.y()}, {high.x(), high.y()}};
}

const char* status(const Recording& recording) {
  return recording.complete()  ? "complete"
         : recording.running() ? "being written"
                               : "part of a run that did not end";
}

Json domain(const Domain& domain) {
  constexpr const char* kinds[] = {"unbounded", "box", "periodic"};
  Json json{{"kind", kinds[static_cast<int>(domain.kind)]}};
  if (domain.kind == DomainKind::unbounded) return json;
  json["min"] = {domain.min.x(), domain.min.y()};
  json["max"] = {domain.max.x(), domain.max.y()};
  return json;
}

Json describe(const Recording& recording) {
  const Scene& scene = recording.geometry();
  const RecordingOrigin& origin = recording.origin();
  const bool any = recording.frames() > 0;
  return {{"scenario", scene.name},
          {"description", scene.description},
          {"status", status(recording)},
          {"engine", engine_name(scene.engine)},
          {"bodies", recording.bodies()},
          {"bodies_of_run", recording.bodies_of_run()},
          {"agents", std::ranges::count(scene.bodies.kind, BodyKind::agent)},
          {"shapes", scene.shapes.size()},
          {"walls", scene.walls.size()},
          {"domain", domain(scene.domain)},
          {"walkable", walkable(scene.crowd.walkable)},
          {"areas", areas(scene.crowd)},
          {"queues", queues(scene.crowd)},
          {"arrivals", arrivals(recording)},
          {"frames", recording.frames()},
          {"every", scene.record.every},
          {"dt", scene.time.dt},
          {"substeps", scene.time.substeps},
          {"first_time", any ? Json(recording.times().front()) : Json(nullptr)},
          {"last_time", any ? Json(recording.times().back()) : Json(nullptr)},
          {"until", scene.time.until},
          {"fields", fields(scene.record)},
          {"rates", steps_apart(scene.record)},
          {"samples", samples(recording)},
          {"observables", scene.record.observables > 0 ? Json(scene.record.observables) : Json(nullptr)},
          {"observed", recording.observed()},
          {"sensors", sensors(scene)},
          {"measures", measures(scene)},
          {"precision", scene.record.single ? "single" : "double"},
          {"quantum", scene.record.quantum > 0.0 ? Json(scene.record.quantum) : Json(nullptr)},
          {"within", region(scene.record)},
          {"bytes", static_cast<std::int64_t>(recording.bytes())},
          {"seed", scene.seed},
          {"threads", origin.provenance.threads},
          {"version", origin.version},
          {"compiler", origin.compiler},
          {"flags", origin.flags},
          {"command_line", origin.provenance.command_line}};
}

std::string readable(const Json& value);

std::string nine_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// As "name ahead, radius 1.5".
std::string readable_entry(const Json& object) {
  std::string text;
  for (const auto& [key, value] : object.items())
    text += (text.empty() ? "" : ", ") + key + " " + readable(value);
  return text;
}

/// Lists as words, those of objects with a semicolon between them, texts without quotes, everything else as
/// JSON has it.
std::string readable(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "none";
  if (value.is_number_float()) return nine_digits(value);
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const Json& item : value)
    if (value.is_array() && item.is_object())
      text += (text.empty() ? "" : "; ") + readable_entry(item);
    else
      text += (text.empty() ? "" : " ") + readable(item);
  return text;
}

/// "each 4 steps, in 76 frames".
std::string how_often(std::int64_t every, std::int64_t frames) {
  return (every == 1 ? "each step" : "each " + std::to_string(every) + " steps") + ", in " +
         counted(frames, "frame");
}

/// As "position each 4 steps, in 76 frames; velocity ...": what JSON has in three lists.
std::string fields_and_rates(const Json& d) {
  std::string text;
  for (std::size_t i = 0; i < d["fields"].size(); ++i)
    text +=
        (i ? "; " : "") + d["fields"][i].get<std::string>() + " " + how_often(d["rates"][i], d["samples"][i]);
  return text.empty() ? "none" : text;
}

/// "40, from 12.4 s to 31.02 s".
std::string first_to_last(const Json& arrivals, const Recording& recording) {
  if (arrivals["count"].is_null())
    return recording.complete() ? "not known: an older throng wrote the file"
                                : "not known: the run has not ended";
  const std::string count = arrivals["count"].dump();
  if (arrivals["count"] == 0) return count;
  return count + ", from " + readable(arrivals["first"]) + " s to " + readable(arrivals["last"]) + " s";
}

/// "each step", or "each step that is a multiple of 4 or 10": of which there are frames.
std::string steps_of_frames(const Record& record) {
  std::vector<int> bases;  // multiples of others say nothing new
  for (const int rate : rates(record))
    if (std::ranges::none_of(bases, [rate](int base) { return rate % base == 0; })) bases.push_back(rate);
  if (bases.front() == 1) return "each step";
  std::string text = "each step that is a multiple of " + std::to_string(bases.front());
  for (std::size_t i = 1; i < bases.size(); ++i)
    text += (i + 1 < bases.size() ? ", " : " or ") + std::to_string(bases[i]);
  return text;
}

/// What follows the value of a name that doesn't say it: its unit, or of what it is.
const std::map<std::string_view, const char*> kMeanings = {
    {"bodies", ", that are recorded"},
    {"bodies_of_run", ", that the scenario makes"},
    {"agents", ", of those recorded"},
    {"dt", " s, from step to step"},
    {"first_time", " s, of the first frame"},
    {"last_time", " s, of the last frame"},
    {"until", " s, the end of the run"},
    {"precision", ", of numbers in the file"},
    {"quantum", " m, of which positions are multiples"},
    {"within", " (m), where bodies are recorded"},
    {"bytes", ", of the file"},
    {"seed", ", of all randomness"},
    {"threads", ", of the run, whose result doesn't depend on them"}};

std::string meaning(const std::string& key, const Json& value, const Json& description) {
  if (value.is_null()) return "";
  if (key == "every")
    return std::string(value == 1 ? " step" : " steps") + ", of what has no rate of its own below";
  const bool solves = description["agents"] == 0 && description["engine"] != "event_driven";
  if (key == "substeps") return solves ? " a step" : " a step, which do nothing here";
  const bool change = description["agents"] != 0 || !description["within"].is_null();
  if (key == "bodies" && change) return ", that are recorded while they are there";
  const auto found = kMeanings.find(key);
  return found == kMeanings.end() ? "" : found->second;
}

void print_description(const Json& description, const Recording& recording) {
  const Record& record = recording.geometry().record;
  for (const auto& [key, value] : description.items()) {
    if (key == "rates" || key == "samples") continue;
    std::string text = readable(value);
    if (key == "walkable" && !value.is_null()) text = readable_entry(value);
    if (key == "arrivals" && !value.is_null()) text = first_to_last(value, recording);
    if (key == "frames") text += ", of " + steps_of_frames(record);
    if (key == "fields") text = fields_and_rates(description);
    if (key == "observables" && !value.is_null()) text = how_often(value, frames_with(recording, value));
    text += meaning(key, value, description);
    std::printf("%-13s %s\n", key.c_str(), printable(text).c_str());
  }
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  struct Options {
    std::string file;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("info", "Tells what a recording holds");
  command->add_option("FILE", options->file, "recording (.h5, or the .h5.part of a run that is going on)")
      ->required();
  command->add_flag("--json", options->json, "as JSON");
  command->footer("Example: throng info pile.h5");
  command->callback([options, &exit_code] {
    const Recording recording(options->file);
    const Json description = describe(recording);
    if (options->json)
      std::puts(description.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    else
      print_description(description, recording);
    exit_code = 0;
  });
}

}  // namespace throng::tools
