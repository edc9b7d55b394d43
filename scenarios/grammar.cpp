// SPDX-License-Identifier: MIT
#include "scenarios/grammar.h"

#include "scenarios/limits.h"
#include "scenarios/report.h"
#include "scenarios/types.h"
#include "sim/crowd/model.h"

namespace throng::scenarios {

namespace {

using namespace types;
using Kind = Type::Kind;

Type speed() {
  return number(-kFastest, kFastest, "m/s");
}

Type uniform(Type bound, const std::string& doc) {
  return table({{required({"uniform", tuple({bound, bound}, "two bounds [low, high]"), doc})}});
}

Type time_table() {
  return table(
      {{{"dt", either({number(kShortestStep, 1e6, "s"), choice({"auto"})}),
         "Length of a step, s; auto: chosen with the substeps so that `error` is met, as `throng plan` "
         "explains.",
         "0.01"},
        {"error", number(1e-12, 1),
         "With dt = \"auto\": what is allowed, of the smallest body's radius, or of what `throng plan` "
         "says."},
        {"until", number(0, 1e12, "s"), "When the simulation ends, s.", "10.0"},
        {"substeps", integer(1, 1000),
         "Substeps within a step; absent: so many that one takes 2.5 ms at most, 4 to 40, and with contacts "
         "that are springs 50 in the shortest impact."}}});
}

Type domain_table() {
  return table({{{"box", box(), "Four walls of the default material round this box, m."},
                 {"periodic", box(), "A box, m, whose opposite sides are one: what leaves comes in again."}},
                {"box", "periodic"}});
}

Type contact_table() {
  return table(
      {{{"model", choice({"impulse", "spring", "hertz", "none"}),
         "How bodies push each other: impulse: rigidly; spring, hertz: discs give way, by linear springs or "
         "as "
         "spheres do; none: they pass through.",
         "\"impulse\""},
        {"stiffness", number(1e-9, 1e15, "N/m"), "Of spring, which needs it: force over depth, N/m."},
        {"tangential_stiffness", number(0, 1), "Of spring: part of the normal one; absent: 2/7."},
        {"youngs_modulus", number(1e-9, 1e15, "Pa"), "Of hertz, which needs it: Young's modulus, Pa."},
        {"poisson_ratio", number(0, 0.5), "Of hertz: Poisson's ratio; absent: 0.3."},
        {"tangential_damping", number(0, 1),
         "Of spring and hertz: part of the normal dashpot, which follows from restitution; absent: 0.5."}}});
}

Type record_fields() {
  return list(choice({"position", "angle", "velocity", "spin", "contacts"}), 0, "a list of fields", 16);
}

/// One or several of what `part` is.
Type some(const Type& part, std::string called) {
  return either({part, list(part, 1, std::move(called))});
}

Type recorded_bodies_table() {
  return table(
      {{{"shape", some(name_in("shapes"), "a list of names of shapes"), "Of these shapes."},
        {"material", some(name_in("materials"), "a list of names of materials"), "Of these materials."},
        {"kind", some(choice({"dynamic", "static", "kinematic", "agent"}), "a list of kinds"),
         "Of these kinds."},
        {"ids", list(integer(1, kMostBodies), 1, "a list of ids"), "These alone."}}});
}

Type record_table() {
  const Table also{{required({"every", integer(1, 1e9), "Steps from one to the next."}),
                    required({"fields", record_fields(), "What is recorded at this rate."})}};
  return table(
      {{{"every", integer(1, 1e9), "Steps from one recorded frame to the next.", "1"},
        {"fields", record_fields(),
         "What a frame holds; contacts: where bodies press on each other or on obstacles.",
         "[\"position\", \"angle\", \"velocity\"]"},
        {"also", tables(also), "Further fields, at rates of their own.", "[]"},
        {"observables", integer(1, 1e9),
         "Steps from one measurement to the next of energies, momentum, contacts, overlaps, and of what "
         "measures count; absent: none."},
        {"precision", choice({"double", "single"}), "Width of recorded numbers.", "\"double\""},
        {"quantize", number(1e-9, 1e3, "m"),
         "Store positions rounded to whole multiples of this, m, and packed; absent: as they are."},
        {"of", recorded_bodies_table(), "Which bodies are recorded: those that all of it fits; absent: all."},
        {"within", box(), "Record bodies only while their centre is in this box, m."}}});
}

Type bins_table(Type up_to, const char* what) {
  return table(
      {{required({"up_to", std::move(up_to), std::string("Where the last bin ends, ") + what + "."}),
        {"bins", integer(1, kMostBins), "How many bins, all as wide, the first from 0 on; absent: 50."}}});
}

Type observe_table() {
  const Type quantity = choice(
      {"temperature", "packing_fraction", "coordination_number", "collisions", "compressibility_factor"});
  return table(
      {{{"quantities", list(quantity, 0, "a list of quantities", 16),
         "temperature: k T, J, of the centres. packing_fraction: which part of the area dynamic bodies take. "
         "coordination_number: on how many others one presses. collisions: how many so far, of pairs and "
         "with "
         "walls. compressibility_factor: P A / (n k T), by the virial and by how often pairs collide, both "
         "since the beginning; of soft contacts by their forces at the instant.",
         "[]"},
        {"packing_within", box(), "Box, m, in which packing_fraction is taken; absent: the domain."},
        {"speeds", bins_table(number(1e-12, 1e9, "m/s"), "m/s"),
         "How speeds are distributed: part of the bodies over the width of the bin, s/m."},
        {"pair_correlation", bins_table(length(), "m"),
         "g(r): pairs of bodies whose centres are r apart, over those of as many points anywhere."}}});
}

Type material_table() {
  return table(
      {{{"density", number(1e-9, 1e12, "kg/m^2"), "Mass per area, kg/m^2.", "1.0"},
        {"restitution", number(0, 1), "Speed after over speed before an impact; a pair takes the larger.",
         "0.0"},
        {"friction", number(0, 1e6), "Coulomb's coefficient; a pair takes the geometric mean.", "0.5"},
        {"rolling_resistance", number(0, 1e6),
         "Of discs: torque over radius times normal force; a pair takes the larger.", "0.0"}}});
}

Type disc_table() {
  return table(
      {{required({"radius", either({length(), uniform(length(), "Each body's own, m, between these.")}),
                  "Radius, m."})}});
}

Type shape_table() {
  return table({{{"disc", disc_table(), "A disc."}, polygon_field(), discs_field(), holes_field()},
                {"disc", "polygon", "discs"}});
}

Type place_table() {
  const Type random =
      table({{required({"within", box(), "Box, m, that holds all of every body."}),
              {"gap", number(0, kFarthest, "m"), "Least distance to any other body and wall, m.", "0.0"}}});
  const Type lattice =
      table({{required({"origin", point(), "Where the first body's centre of mass stands, m."}),
              required({"spacing", tuple({coordinate(), coordinate()}, "a pair [dx, dy]"),
                        "From column to column and from row to row, m."}),
              required({"size",
                        tuple({integer(1, kMostBodies), integer(1, kMostBodies)},
                              "a pair of counts [columns, rows]"),
                        "How many columns and rows; filled row by row."})}});
  return table({{{"random", random, "Anywhere that is free, uniformly at random."},
                 {"lattice", lattice, "A rectangular lattice."},
                 later("file", "Positions from a file.")},
                {"random", "lattice", "file"}});
}

Table body_table() {
  const Type maxwell = table({{required(
      {"maxwell", number(0, kFastest, "m/s"),
       "Standard deviation of each component, m/s; the total momentum of this entry is removed."})}});
  const Type angles = uniform(number(-kFarthest, kFarthest, "rad"), "Each body's own, rad, between these.");
  return {{required({"shape", name_in("shapes"), "Name of a shape."}),
           {"at", point(), "Where the centre of mass stands, m."},
           {"place", place_table(), "How to place more than one body."},
           {"count", integer(0, kMostBodies), "How many bodies; a lattice's own size when absent.", "1"},
           {"angle", either({number(-kFarthest, kFarthest, "rad"), angles}),
            "Rotation about the centre of mass, rad.", "0.0"},
           {"velocity", either({tuple({speed(), speed()}, "a velocity [vx, vy]"), maxwell}),
            "Of the centre of mass, m/s.", "[0.0, 0.0]"},
           {"spin", number(-kFastest, kFastest, "rad/s"), "Angular velocity, rad/s.", "0.0"},
           {"material", name_in("materials"), "Name of a material.", "\"default\""},
           {"kind", choice({"dynamic", "static", "kinematic"}),
            "dynamic: moved by forces; static: never moves; kinematic: moves as told, whatever it meets.",
            "\"dynamic\""}},
          {"at", "place"}};
}

Table wall_table() {
  Table table = wall_lines();
  table.fields.push_back({"material", name_in("materials"), "Name of a material.", "\"default\""});
  return table;
}

Type area() {
  return either({text(kMostBytes, "a well-known text such as \"POLYGON ((0 0, 1 0, 1 1, 0 0))\""),
                 points(3, "a list of at least 3 points [x, y]")});
}

Type distribution(const Type& bound, const std::string& what) {
  const Type bounds = tuple({bound, bound}, "two bounds [low, high]");
  const Type moments = tuple({bound, bound}, "a pair [mean, standard deviation]");
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
    parameters.fields.push_back({p.key, number(p.low, p.high, p.unit), p.doc, to_text(p.preset)});
  return {kind.name, table(std::move(parameters)), kind.doc};
}

Table leg_table() {
  const auto some_of = [](const char* table, const char* called) { return list(name_in(table), 1, called); };
  const Type time = number(0, 1e9, "s");
  return {
      {{"nearest", some_of("areas", "a list of names of areas"),
        "To the nearest of these areas, by the way there."},
       {"weights", named(number(0, 1e6)),
        "Each agent to one of these areas, by chance in proportion to its weight."},
       {"least_crowded", either({some_of("areas", "a list of names of areas"), named(number(0, 1e6, "1/s"))}),
        "To that of these areas which is expected to be got through first, by the way and those who go "
        "there too and are nearer: as many a second as the number says, without one 1.3."},
       {"wait", name_in("areas"), "To a free place in this area, and stands there."},
       {"for", distribution(time, "time, s,"),
        "How long, s, from when it gets into the area; without this and `until`: for ever."},
       {"until", distribution(time, "time, s,"), "Until when, s."},
       {"queue", either({name_in("queues"), some_of("queues", "a list of names of queues")}),
        "Lines up, of several queues in the least crowded, and goes on when it was served."}},
      {"nearest", "weights", "least_crowded", "wait", "queue"}};
}

Type goal() {
  return either({name_in("areas"), list(either({name_in("areas"), table(leg_table())}), 1, "a list of goals"),
                 table(leg_table())});
}

Type open_table() {
  return table({{{"from", number(0, 1e12, "s"), "Closed until then, s.", "0.0"},
                 {"until", number(0, 1e12, "s"), "Closed from then on, s; absent: never."}}});
}

Type queue() {
  return table({{required({"line", points(2, "a list of at least 2 points [x, y]"),
                           "Where they stand, m: the first at the first point, the others behind along it."}),
                 required({"service", number(0, 1e6, "s"), "How long each is served, s."}),
                 {"spacing", number(1e-2, 1e3, "m"), "From place to place, m.", "0.6"}}});
}

Type appear_table() {
  return table({{{"rate", number(1e-9, 1e6, "1/s"), "How many agents a second."},
                 {"times", list(number(0, 1e12, "s"), 1, "a list of times, ascending"),
                  "When agents appear, s; ascending."},
                 {"from", number(0, 1e12, "s"), "When the first of a rate appear, s.", "0.0"},
                 {"together", integer(1, kMostBodies), "So many appear at once.", "1"}},
                {"rate", "times"}});
}

Table agent_table() {
  const Type random =
      table({{required({"within", either({name_in("areas"), box()}),
                        "Name of an area, or box, m, that holds all of every agent."}),
              {"gap", number(0, kFarthest, "m"), "Least distance to any other agent and wall, m.", "0.0"}}});
  std::vector<std::string> names;
  for (const ModelKind& kind : walking_models()) names.push_back(kind.name);
  Table result{
      {required({"model", choice(names), "How agents decide how to walk."}),
       required(
           {"goal", goal(),
            "Where they walk to, by the shortest way, and leave: an area, or a table as below, or a list of "
            "such, one after the other."}),
       {"at", point(), "Where the agent stands, m."},
       {"place", table({{required({"random", random, "Anywhere that is free, uniformly at random."})}}),
        "How to place more than one agent."},
       {"count", integer(0, kMostBodies), "How many agents; with appear.times as many as these make.", "1"},
       {"radius", distribution(length(), "radius, m,"), "Radius, m.", "0.2"},
       {"desired_speed", distribution(number(0, kFastest, "m/s"), "speed, m/s,"),
        "Speed when nothing is in the way, m/s.", "1.34"},
       {"premovement", distribution(number(0, 1e9, "s"), "time, s,"),
        "How long they stand before they set out, s, from the start or from when they are due.", "0.0"},
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
            "A line, m: crossings from its left to its right, seen from its first point, and back."},
           {"area", name_in("areas"), "Name of an area: density and speed of those in it."},
           {"voronoi",
            table({{{"cutoff", number(1e-2, 1e3, "m"), "How far from its agent a cell ends, m.", "1.0"}}}),
            "Of an area: its density by the Voronoi cells of agents too, as density_voronoi."},
           {"from", number(0, 1e12, "s"), "Measured from then on, s.", "0.0"},
           {"until", number(0, 1e12, "s"), "Measured up to then, s; absent: to the end."}},
          {"line", "area"}};
}

Table sensor_table() {
  return {{required({"name", text(64), "What the summary and the recording call it."}),
           {"of", either({choice({"all"}), recorded_bodies_table()}),
            "Who has it: bodies and agents that all of this fits.", "\"all\""},
           required({"radius", number(0, kFarthest, "m"), "How far it reaches, m, from centre to centre."}),
           {"fov_degrees", number(1e-6, 360, "degrees"),
            "How wide the view is, degrees, its borders included: about an agent's velocity, about a body's "
            "angle; an agent who stands looks all around.",
            "360.0"},
           {"sight", either({boolean(), choice({"walls", "bodies"})}),
            "Whom it doesn't find: true or \"walls\": who is behind a wall; \"bodies\": or behind another "
            "body or agent.",
            "false"},
           {"every", integer(1, 1e9), "Steps from one look to the next; the first is at the start.", "1"},
           {"record", boolean(), "Whether a recording holds who senses whom, at each look.", "false"}}};
}

Table root_table() {
  return {{required({"throng", version(), "Version of this grammar."}),
           {"name", text(256), "A short name.", "\"\""},
           {"description", text(1000), "One line on what is to be seen.", "\"\""},
           {"seed", integer(0, 0x1p53 - 1), "All that is random follows from it.", "1"},
           {"engine", choice({"native", "box2d", "event_driven"}), "What computes the motion.", "\"native\""},
           {"gravity",
            tuple({number(-kFarthest, kFarthest, "m/s^2"), number(-kFarthest, kFarthest, "m/s^2")},
                  "an acceleration [x, y]"),
            "Acceleration of everything dynamic, m/s^2.", "[0.0, 0.0]"},
           {"sleep", boolean(), "Bodies at rest may leave the loop.", "true"},
           {"time", time_table(), "Steps and their end."},
           {"domain", domain_table(), "Where bodies may be; absent: the unbounded plane."},
           {"contact", contact_table(), "What happens where bodies touch."},
           {"record", record_table(), "What a recording holds."},
           {"observe", observe_table(), "What else is observed of all bodies, in summary and recording."},
           {"materials", named(material_table()), "Materials by name; one called default is always there."},
           {"shapes", named(shape_table()), "Shapes by name."},
           {"bodies", tables(body_table()), "Bodies, one or many an entry; ids count from 1 in this order."},
           {"walls", tables(wall_table()), "Thin walls with two sides, which never move."},
           {"walkable", area(),
            "Where agents may be, m: POLYGON with holes or MULTIPOLYGON, or one ring; its edges are walls."},
           {"areas", named(area()), "Named areas, m: POLYGON or MULTIPOLYGON, or a list of points [x, y]."},
           {"open", named(open_table()), "When areas that are goals let agents in; absent: always."},
           {"queues", named(queue()), "Queues by name, in which agents line up."},
           {"agents", tables(agent_table()),
            "Agents, who walk to a goal and leave there; they need walkable or domain.box."},
           {"sensors", tables(sensor_table()), "Who senses whom; `throng run` sums it up. At most 8."},
           {"measure", tables(measure_table()),
            "What is counted while agents walk; `throng run` sums it up. At most 1000."}}};
}

std::string range(const Type& type) {
  if (type.kind == Kind::integer)
    return " from " + std::to_string(static_cast<std::int64_t>(type.low)) + " to " +
           std::to_string(static_cast<std::int64_t>(type.high));
  return " from " + to_text(type.low) + " to " + to_text(type.high) +
         (type.unit.empty() ? "" : " " + type.unit);
}

std::string one_of(const std::vector<std::string>& words) {
  std::string result = "one of";
  for (const std::string& word : words) result += (&word == &words.front() ? " " : ", ") + in_quotes(word);
  return result;
}

std::string keys(const Table& table) {
  std::string result = "a table { ";
  for (const Field& field : table.fields)
    if (!field.later) result += (&field == &table.fields.front() ? "" : ", ") + field.key;
  return result + " }";
}

std::string alternatives(const std::vector<Type>& types) {
  std::string result;
  for (const Type& type : types) result += (result.empty() ? "" : ", or ") + describe(type);
  return result;
}

}  // namespace

const Table& grammar() {
  static const Table root = root_table();
  return root;
}

std::string describe(const Type& type) {
  if (!type.called.empty()) return type.called;
  switch (type.kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer" + range(type);
    case Kind::number:
      return "a number" + range(type);
    case Kind::text:
      return "a string of at most " + std::to_string(type.most) + " bytes";
    case Kind::choice:
      return one_of(type.choices);
    case Kind::name:
      return "the name of an entry of [" + type.of + "]";
    case Kind::table:
      return keys(*type.table);
    case Kind::tables:
      return "a list of tables [[...]]";
    case Kind::named:
      return "a table of names";
    case Kind::either:
      return alternatives(type.parts);
    case Kind::tuple:
    case Kind::list:
      break;
  }
  return "a list";
}

}  // namespace throng::scenarios
