// SPDX-License-Identifier: MIT
#pragma once

#include "scenarios/grammar.h"

/// What the root of the grammar is made of: a file for bodies, for crowds and for what is recorded.
namespace throng::scenarios::parts {

// Bodies.
Type contact_table();
Type material_table();
Type shape_table();
Table body_table();
Table wall_table();

// Crowds.
Type area();
Type open_table();
Type queue_table();
Table agent_table();
Table measure_table();

// What is told of them.
Type record_table();
Type observe_table();
Table sensor_table();

}  // namespace throng::scenarios::parts
