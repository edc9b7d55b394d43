// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/fixed_grid.h"
#include "broadphase/higher_rows.h"
#include "broadphase/items.h"
#include "broadphase/pairs.h"

/// The innermost loops of all pairs, compiled for each width of vectors and chosen at run time. The pairs and
/// their order are the same for each.
namespace throng::broadphase {

/// Appends the pairs of a grid of which the first in its order lies in strips [first, end), in that order.
void gather_pairs(const FixedGrid& grid, const Items& items, std::size_t first, std::size_t end,
                  PairBuffer& found);

/// Replaces `found` by the partners of higher rows of each disc of a grid that holds them all.
void gather_higher(const FixedGrid& grid, const Items& items, HigherRows& found);

/// Appends the pairs of each item of `fine`, from place `first` to `end` in its order, with all of `coarse`,
/// whose cells are as large as the largest of these pairs is wide.
void gather_across(const FixedGrid& fine, const FixedGrid& coarse, const Items& items, std::size_t first,
                   std::size_t end, PairBuffer& found);

}  // namespace throng::broadphase
