// SPDX-License-Identifier: MIT
#include "scenarios/grammar_parts.h"
#include "scenarios/limits.h"
#include "scenarios/types.h"
#include "sim/measure/asked.h"

namespace throng::scenarios::parts {

using namespace types;

namespace {

Type record_fields(std::size_t least) {
  return list(choice({"position", "angle", "velocity", "spin", "contacts"}), least,
              least > 0 ? "a list of fields, one or more" : "a list of fields", 16);
}

/// One or several of what `part` is.
Type some(const Type& part, std::string called) {
  return either({part, list(part, 1, std::move(called))});
}

Type recorded_bodies_table() {
  return table(
      {{{"shape", some(name_in("shapes"), "a list of names of shapes, one or more"), "Of these shapes."},
        {"material", some(name_in("materials"), "a list of names of materials, one or more"),
         "Of these materials."},
        {"kind", some(choice({"dynamic", "static", "kinematic", "agent"}), "a list of kinds, one or more"),
         "Of these kinds."},
        {"group", some(text(64), "a list of names of [[agents]], one or more"),
         "Agents of the entries of these names."},
        {"ids", list(integer(1, kMostBodies), 1, "a list of ids, one or more"), "These alone."}}});
}

Type bins_table(Type up_to, const char* what) {
  return table(
      {{required({"up_to", std::move(up_to), std::string("Where the last bin ends, ") + what + "."}),
        {"bins", integer(1, kMostBins), "How many bins, all as wide, the first from 0 on; absent: 50."}}});
}

}  // namespace

Type record_table() {
  const Table also{{required({"every", integer(1, 1e9), "Steps from one to the next."}),
                    required({"fields", record_fields(1), "What is recorded at this rate."})}};
  return table(
      {{{"every", integer(1, 1e9),
         "Steps from one recorded frame to the next, from 0 on; the run's last state is one where this "
         "divides "
         "its steps.",
         "1"},
        {"fields", record_fields(0),
         "What a frame holds; contacts: where bodies press on each other (a, b: their ids) or on what is "
         "static (b: 0), with the impulse of the step, N s. []: nothing of this.",
         "[\"position\", \"angle\", \"velocity\"]"},
        {"also", tables(also), "Further fields, at rates of their own.", "[]"},
        {"observables", integer(1, 1e9),
         "Steps from one measurement to the next of energies (of motion and of gravity; what springs store "
         "isn't in them), momentum, contacts, overlaps, and of what measures count; absent: none."},
        {"precision", choice({"double", "single"}),
         "Width of positions, angles, velocities and spins; contacts and observables are double.",
         "\"double\""},
        {"quantize", number(1e-9, 1e3, "m"),
         "Store positions rounded to whole multiples of this, m, and packed; at least the farthest place "
         "over 2^31; absent: as they are."},
        {"of", recorded_bodies_table(),
         "Which bodies are recorded: those that all of it fits, and contacts of which one side is such a "
         "body; absent: all. Observables and sensors go by their own."},
        {"within", box(),
         "Record bodies only while their centre is in this box, m, and contacts of which one side is such a "
         "body."}}});
}

Type observe_table() {
  const Type quantity = choice(
      {"temperature", "packing_fraction", "coordination_number", "collisions", "compressibility_factor"});
  return table(
      {{{"quantities", list(quantity, 0, "a list of quantities", 16),
         "temperature: k T, J, of the centres, beside the motion of all together where nothing stands in "
         "their "
         "way and nothing pulls. packing_fraction: which part of the area dynamic bodies take. "
         "coordination_number: on how many others, walls too, a dynamic body presses, by the mean over all; "
         "unknown "
         "before the first step. "
         "collisions: how many so far, of pairs and with walls. compressibility_factor: P A / (n k T), by "
         "the virial of pairs alone (the push of a box's "
         "walls isn't "
         "in it) and by how often pairs collide, both since the beginning; of soft contacts by their forces "
         "at the instant.",
         "[]"},
        {"packing_within", box(), "Box, m, in which packing_fraction is taken; absent: the domain."},
        {"speeds", bins_table(number(1e-12, 1e9, "m/s"), "m/s"),
         "How speeds are distributed: part of the bodies over the width of the bin, s/m."},
        {"pair_correlation", bins_table(length(), "m"),
         "g(r): pairs of bodies whose centres are r apart, over those of as many points anywhere."},
        {"correlation_within", box(),
         "Box, m: pair_correlation is of the bodies whose centres are in it, as many points anywhere in it; "
         "absent: of all, in the domain."}}});
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

}  // namespace throng::scenarios::parts
