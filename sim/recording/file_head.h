// SPDX-License-Identifier: MIT
#pragma once

#include "sim/recording/h5.h"
#include "sim/recording/provenance.h"
#include "sim/scene.h"

/// What stands in a trajectory file before its first frame. All functions throw h5::Error.
namespace throng::recording {

void write_h5md(hid_t file);

/// /parameters: where the recording comes from, and how it was made.
void write_parameters(hid_t file, const Scene& scene, const Provenance& provenance);

/// `box` of a particles group.
void write_box(hid_t group, const Domain& domain);

}  // namespace throng::recording
