// SPDX-License-Identifier: MIT
#include "scenarios/grammar_parts.h"
#include "scenarios/limits.h"
#include "scenarios/types.h"

namespace throng::scenarios::parts {

using namespace types;

namespace {

Type speed() {
  return number(-kFastest, kFastest, "m/s");
}

Type uniform(Type bound, const std::string& doc) {
  return table({{required({"uniform", tuple({bound, bound}, "two bounds [low, high]"), doc})}});
}

Type disc_table() {
  return table(
      {{required({"radius", either({length(), uniform(length(), "Each body's own, m, between these.")}),
                  "Radius, m."})}});
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

}  // namespace

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

Type material_table() {
  return table(
      {{{"density", number(1e-9, 1e12, "kg/m^2"), "Mass per area, kg/m^2.", "1.0"},
        {"restitution", number(0, 1), "Speed after over speed before an impact; a pair takes the larger.",
         "0.0"},
        {"friction", number(0, 1e6), "Coulomb's coefficient; a pair takes the geometric mean.", "0.5"},
        {"rolling_resistance", number(0, 1e6),
         "Of discs: torque over radius times normal force; a pair takes the larger.", "0.0"}}});
}

Type shape_table() {
  return table({{{"disc", disc_table(), "A disc."}, polygon_field(), discs_field(), holes_field()},
                {"disc", "polygon", "discs"}});
}

Table body_table() {
  const Type maxwell = table({{required(
      {"maxwell", number(0, kFastest, "m/s"),
       "Standard deviation of each component, m/s; the total momentum of this entry, all that a single body "
       "has, is removed."})}});
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
            "dynamic: moved by forces; static: never moves; kinematic: keeps its velocity and spin, whatever "
            "it meets.",
            "\"dynamic\""}},
          {"at", "place"}};
}

Table wall_table() {
  Table table = wall_lines();
  table.fields.push_back({"material", name_in("materials"), "Name of a material.", "\"default\""});
  return table;
}

}  // namespace throng::scenarios::parts
