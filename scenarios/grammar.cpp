// SPDX-License-Identifier: MIT
#include "scenarios/grammar.h"

#include "scenarios/grammar_parts.h"
#include "scenarios/limits.h"
#include "scenarios/types.h"

namespace throng::scenarios {

namespace {

using namespace types;
using namespace parts;

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
         "Substeps within a step; absent: so many that one takes 2.5 ms at most, or 0.025 √(d / g) where d, "
         "the least diameter of a disc, or 4 area / border of a polygon, asks for less, 4 to 40; with "
         "contacts that are springs 50 in the shortest impact."}}});
}

Type domain_table() {
  return table({{{"box", box(), "Four walls of the default material round this box, m."},
                 {"periodic", box(), "A box, m, whose opposite sides are one: what leaves comes in again."}},
                {"box", "periodic"}});
}

Table scenario_table() {
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
           {"queues", named(queue_table()), "Queues by name, in which agents line up."},
           {"agents", tables(agent_table()),
            "Agents, who walk to a goal and leave there; they need walkable or domain.box."},
           {"sensors", tables(sensor_table()), "Who senses whom; `throng run` sums it up. At most 8."},
           {"measure", tables(measure_table()),
            "What is counted while agents walk; `throng run` sums it up. At most 1000."}}};
}

}  // namespace

const Table& grammar() {
  static const Table root = scenario_table();
  return root;
}

}  // namespace throng::scenarios
