// SPDX-License-Identifier: MIT
#pragma once

#include "sim/scene.h"

namespace throng::recording {

/// About what all frames of a run of the scene take in the file, in bytes. Of regions, whose bodies nobody
/// knows in advance, all; of contacts three a body; of quantized positions three bytes a body.
double expected_bytes(const Scene& scene);

/// What they take at least: of all these nothing.
double least_bytes(const Scene& scene);

}  // namespace throng::recording
