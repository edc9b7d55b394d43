// SPDX-License-Identifier: MIT
#include "scenarios/grammar_parts.h"
#include "scenarios/limits.h"
#include "scenarios/report.h"
#include "scenarios/types.h"
#include "sim/crowd/model.h"

namespace throng::scenarios::parts {

using namespace types;

namespace {

/// Of what is between `low` and `high`; a standard deviation may be nearer to 0.
Type distribution(double low, double high, const std::string& unit, const std::string& what) {
  const Type bound = number(low, high, unit);
  const Type bounds = tuple({bound, bound}, "two bounds [low, high]");
  const Type moments = tuple({bound, number(0, high, unit)}, "a pair [mean, standard deviation]");
  return either(
      {bound, table({{{"uniform", bounds, "Each agent's own " + what + " between these."},
                      {"normal", moments,
                       "Each agent's own; without `within` up to 3 standard deviations from the mean."},
                      {"lognormal", moments,
                       "Each agent's own: mean and standard deviation of itself, not of its logarithm."},
                      {"within", bounds, "What is drawn beyond these is drawn again."}},
                     {"uniform", "normal", "lognormal"}})});
}

/// "calibrated: for ...: time_gap 0.9, ..." for each: what differs from the parameters' own presets.
Field presets_of(const ModelKind& kind) {
  std::vector<std::string> names;
  std::string doc = "What is not said is as in the model's paper, or with";
  for (const ModelPreset& preset : kind.presets) {
    names.push_back(preset.name);
    doc += " " + std::string(preset.name) + ": " + preset.doc;
    for (std::size_t i = 0; i < kind.parameters.size(); ++i)
      if (const ModelParameter& p = kind.parameters[i]; preset.values[i] != p.preset)
        doc += std::string(", ") + p.key + " = " + to_text(preset.values[i]);
    doc += ".";
  }
  return {"preset", choice(std::move(names)), std::move(doc)};
}

Field model_parameters(const ModelKind& kind) {
  Table parameters;
  if (!kind.presets.empty()) parameters.fields.push_back(presets_of(kind));
  for (const ModelParameter& p : kind.parameters)
    parameters.fields.push_back(
        {p.key, p.is_whole ? integer(p.low, p.high) : distribution(p.low, p.high, p.unit, "number"), p.doc,
         to_text(p.preset)});
  return {kind.name, table(std::move(parameters)), kind.doc};
}

Table leg_table() {
  const auto some_of = [](const char* table, const char* called) { return list(name_in(table), 1, called); };
  return {{{"nearest", some_of("areas", "a list of names of areas, one or more"),
            "To the nearest of these areas, by the way there."},
           {"weights", named(number(0, 1e6)),
            "Each agent to one of these areas, by chance in proportion to its weight."},
           {"least_crowded",
            either({some_of("areas", "a list of names of areas, one or more"), named(number(0, 1e6, "1/s"))}),
            "To that of these areas which is expected to be got through first, by the way and those who go "
            "there too and are nearer: as many a second as the number says, without one 1.3."},
           {"wait", name_in("areas"), "To a free place in this area, and stands there."},
           {"for", distribution(0, 1e9, "s", "time, s,"),
            "How long, s, from when it gets into the area; without this and `until`: for ever."},
           {"until", distribution(0, 1e9, "s", "time, s,"), "Until when, s."},
           {"queue", either({name_in("queues"), some_of("queues", "a list of names of queues, one or more")}),
            "Lines up, of several queues in the least crowded, and goes on when it was served."}},
          {"nearest", "weights", "least_crowded", "wait", "queue"}};
}

Type goal() {
  return either({name_in("areas"),
                 list(either({name_in("areas"), table(leg_table())}), 1, "a list of goals, one or more"),
                 table(leg_table())});
}

Type appear_table() {
  return table({{{"rate", number(1e-9, 1e6, "1/s"), "How many agents a second."},
                 {"times", list(number(0, 1e12, "s"), 1, "a list of times, one or more, ascending"),
                  "When agents appear, s; ascending."},
                 {"from", number(0, 1e12, "s"), "When the first of a rate appear, s.", "0.0"},
                 {"together", integer(1, kMostBodies),
                  "So many are due at once, and appear beside each other as far as there is room.", "1"}},
                {"rate", "times"}});
}

}  // namespace

Type area() {
  return either({text(kMostBytes, "a well-known text such as \"POLYGON ((0 0, 1 0, 1 1, 0 0))\""),
                 points(3, "a list of at least 3 points [x, y]")});
}

Type open_table() {
  return table({{{"from", number(0, 1e12, "s"), "Closed until then, s.", "0.0"},
                 {"until", number(0, 1e12, "s"), "Closed from then on, s; absent: never."}}});
}

Type queue_table() {
  return table({{required({"line", points(2, "a list of at least 2 points [x, y]"),
                           "Where they stand, m: the first at the first point, the others behind along it."}),
                 required({"service", number(0, 1e6, "s"), "How long each is served, s."}),
                 {"spacing", number(1e-2, 1e3, "m"), "From place to place, m.", "0.6"}}});
}

Table agent_table() {
  const Type random = table(
      {{required({"within", either({name_in("areas"), box()}),
                  "Name of an area, or box, m, that holds all of every agent."}),
        {"gap", number(0, kFarthest, "m"),
         "Least distance to walls, and to agents placed before: those with `at`, and of entries above, m.",
         "0.0"}}});
  std::vector<std::string> names;
  for (const ModelKind& kind : walking_models()) names.push_back(kind.name);
  Table result{
      {required({"model", choice(names), "How agents decide how to walk."}),
       required(
           {"goal", goal(),
            "Where they walk to, by the shortest way, and leave: an area, or a table as below, or a list of "
            "such, one after the other. Of several areas at the end they leave from whichever is open and "
            "they get to."}),
       {"name", text(64), "What sensors.of and record.of call them; entries may share one."},
       {"at", point(), "Where the agent stands, m."},
       {"place", table({{required({"random", random, "Anywhere that is free, uniformly at random."})}}),
        "How to place more than one agent."},
       {"count", integer(0, kMostBodies), "How many agents; with appear.times as many as these make.", "1"},
       {"radius", distribution(kShortest, kFarthest, "m", "radius, m,"), "Radius, m.", "0.2"},
       {"desired_speed", distribution(0, kFastest, "m/s", "speed, m/s,"),
        "Speed when nothing is in the way, m/s.", "1.34"},
       {"premovement", distribution(0, 1e9, "s", "time, s,"),
        "How long they stand before they set out, s, from the start or from when they are due; "
        "social_force's may be pushed meanwhile, orca's step aside.",
        "0.0"},
       {"appear", appear_table(),
        "When they appear, at places of `place`, as soon as there is room; absent: all at the start."}},
      {"at", "place"}};
  for (const ModelKind& kind : walking_models())
    if (!kind.parameters.empty()) result.fields.push_back(model_parameters(kind));
  return result;
}

Table measure_table() {
  return {{required({"name", text(64), "What the summary calls it."}),
           {"line", tuple({point(), point()}, "two points [[x, y], [x, y]]"),
            "A line, m: crossings from its left to its right, seen from its first point, and back; its flow "
            "is of both."},
           {"area", name_in("areas"),
            "Name of an area: density and speed of those in it, and their product, the flow."},
           {"voronoi",
            table({{{"cutoff", number(1e-2, 1e3, "m"), "How far from its agent a cell ends, m.", "1.0"}}}),
            "Of an area: its density by the Voronoi cells of agents too, as density_voronoi."},
           {"from", number(0, 1e12, "s"), "Measured from then on, s.", "0.0"},
           {"until", number(0, 1e12, "s"), "Measured up to then, s; absent: to the end."}},
          {"line", "area"}};
}

}  // namespace throng::scenarios::parts
