// SPDX-License-Identifier: MIT
#include "scenarios/motion_grammar.h"

#include "scenarios/schema.h"
#include "scenarios/types.h"

namespace throng::scenarios {

namespace {

using namespace types;

Type name() {
  return text(64, "a name of at most 64 bytes");
}

Type rounded_shape_table() {
  const Type disc = table({{required({"radius", length(), "Radius, m."})}});
  return table({{{"disc", disc, "A disc about the origin."},
                 polygon_field(),
                 {"segment", tuple({point(), point()}, "two points [[x, y], [x, y]]"), "A straight line, m."},
                 discs_field(),
                 holes_field(),
                 {"radius", number(0, kFarthest, "m"),
                  "By how much a polygon or a segment is rounded, m: it grows, its holes shrink.", "0.0"}},
                {"disc", "polygon", "segment", "discs"}});
}

Table obstacle_table() {
  return {{required({"shape", name_in("shapes"), "Name of a shape."}),
           {"name", name(), "What answers call it; obstacles[0] and so on when absent."},
           {"at", point(), "Where the shape's origin stands, m.", "[0.0, 0.0]"},
           {"angle", angle(), "Rotation about it, rad.", "0.0"}}};
}

Table rigid_body_table() {
  const Type pose = list(coordinate(), 2, "a pose [x, y] or [x, y, angle]", 3);
  return {
      {required({"shape", name_in("shapes"), "Name of a shape."}),
       {"name", name(), "What answers call it; bodies[0] and so on when absent."},
       required(
           {"waypoints", list(pose, 1, "a list of 1 to 10000 poses [x, y] or [x, y, angle]", kMostWaypoints),
            "Where the shape's origin stands, m, and how it is turned about it, rad; without an angle as "
            "before, at first by 0. One stands still, as all may."})}};
}

Table link_table() {
  return {
      {{"shape", name_in("shapes"), "Name of a shape; absent: nothing that could touch."},
       {"name", name(), "What answers call it, ROBOT.NAME; ROBOT.links[0] and so on when absent."},
       {"parent", either({name(), integer(0, kMostLinks)}),
        "The link that it hangs on: a name, a number from 0, or \"base\". Absent: the link before; of "
        "the first, the base."},
       {"joint", choice({"revolute", "prismatic", "fixed"}),
        "revolute: turns; prismatic: slides along `axis`; fixed: neither, and waypoints have no value for "
        "it. Two links with at most one joint between them that moves are not compared: what is fixed on a "
        "link counts as that link.",
        "\"revolute\""},
       {"at", point(), "Where the joint is, in the parent's frame, m.", "[0.0, 0.0]"},
       {"angle", angle(), "How the link is turned against its parent where its value is 0, rad.", "0.0"},
       {"axis", tuple({coordinate(), coordinate()}, "a direction [x, y]"),
        "Of a prismatic joint, in the parent's frame; its length doesn't matter.", "[1.0, 0.0]"},
       {"limits", tuple({coordinate(), coordinate()}, "two bounds [low, high]"),
        "The least and the largest value of the joint, rad or m."}}};
}

Table robot_table() {
  Type links = tables(link_table());
  const Type values =
      list(number(-kFarthest, kFarthest), 0, "a list of joint values, one a joint that moves", kMostLinks);
  return {
      {{"name", name(), "What answers call it; robots[0] and so on when absent."},
       {"base", list(coordinate(), 2, "a pose [x, y] or [x, y, angle]", 3),
        "Where the frame stands that the first link is mounted on: m, m and rad.", "[0.0, 0.0, 0.0]"},
       required({"links", links, "Its links, in an order in which parents come first."}),
       required(
           {"waypoints", list(values, 1, "a list of 1 to 10000 lists of joint values", kMostWaypoints),
            "Configurations: a value a joint that is not fixed, rad or m. Not wrapped: 6.28 is a turn. One "
            "stands still, as all may."})}};
}

Table motion_table() {
  const Type pair = tuple({name(), name()}, "a pair of names");
  return {{required({"motion", version(), "Version of this grammar."}),
           {"name", text(256), "A short name.", "\"\""},
           {"description", text(1000), "One line on what is asked.", "\"\""},
           {"durations", list(number(kShortestStep, 1e12, "s"), 1, "a list of durations", kMostWaypoints),
            "How long each segment takes, s: as many as waypoints, less one. Absent: times are fractions."},
           {"margin", number(0, kFarthest, "m"),
            "Clearance that a free path has at least, m: what comes as near counts as a hit.", "0.0"},
           {"shapes", named(rounded_shape_table()), "Shapes by name."},
           {"obstacles", tables(obstacle_table()), "What stands still."},
           {"walls", tables(wall_lines()), "Thin walls with two sides."},
           {"surroundings", text(4096, "the name of a scenario file"),
            "A scenario, beside this file, whose bodies, where they start, and walls are obstacles too: "
            "surroundings.bodies[0], each body counted, surroundings.walls[0] and so on."},
           {"bodies", tables(rigid_body_table()),
            "Rigid bodies. All move at once, straight and evenly from waypoint to waypoint."},
           {"robots", tables(robot_table()),
            "Links on joints, which move straight and evenly from value to value."},
           {"may_touch", list(pair, 0, "a list of pairs of names", kMostMayTouch),
            "Who may touch whom: bodies, links, robots (all of their links), obstacles, or \"obstacles\" for "
            "all.",
            "[]"}}};
}

}  // namespace

const Table& motion_grammar() {
  static const Table root = motion_table();
  return root;
}

std::string motion_schema() {
  return schema(motion_grammar(), "throng motion",
                "Printed by throng motion --schema; SI units and radians.");
}

}  // namespace throng::scenarios
