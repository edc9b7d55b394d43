// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "sim/recording/h5_read.h"
#include "sim/recording/observables.h"
#include "sim/scene.h"

namespace throng::recording {

/// Does what a file of layout 1.`minor` says of the run, materials, shapes, bodies, walls, floor and box fit
/// the scene that its scenario makes? Reads masses and the box, which other programs read and throng doesn't
/// need. `found` is the scene that the file's tables make, `ids` are its bodies, names in `scene`, which must
/// have them. O(scene). Throws h5::Error where anything is unreadable or otherwise.
void expect_tables(const h5::File& file, const Scene& found, std::span<const std::uint32_t> ids,
                   const Scene& scene, int minor);

/// Do histograms among what a file observed end where the scenario wants them to? Throws h5::Error.
void expect_bins(std::span<const Observable> found, const Scene& scene);

}  // namespace throng::recording
