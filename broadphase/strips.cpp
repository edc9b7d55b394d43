// SPDX-License-Identifier: MIT
#include "broadphase/strips.h"

#include <algorithm>
#include <bit>

namespace throng::broadphase {

void Strips::reset(const Cells& cells) {
  dense_ = !cells.shared();
  periodic_ = cells.periodic();
  columns_ = cells.columns();
  rows_ = cells.rows();
  keys_.clear();
  if (dense_) return;
  if (slots_.empty()) slots_.resize(1024);
  slot_shift_ = 64 - std::countr_zero(slots_.size());
  slots_.assign(slots_.size(), kNone);
}

void Strips::sort() {
  const std::size_t count = keys_.size();
  order_.resize(count);
  place_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) order_[i] = {keys_[i], i};
  std::sort(order_.begin(), order_.end());
  for (std::uint32_t i = 0; i < count; ++i) {
    keys_[i] = order_[i].first;
    place_[order_[i].second] = i;
  }
  for (std::uint32_t& slot : slots_)
    if (slot != kNone) slot = place_[slot];
}

std::uint32_t Strips::append(const Key& key, std::size_t slot) {
  const auto strip = static_cast<std::uint32_t>(keys_.size());
  slots_[slot] = strip;
  keys_.push_back(key);
  if (4 * keys_.size() > slots_.size()) grow();
  return strip;
}

void Strips::grow() {
  --slot_shift_;
  slots_.assign(2 * slots_.size(), kNone);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t strip = 0; strip < keys_.size(); ++strip) {
    std::size_t slot = slot_of(keys_[strip]);
    while (slots_[slot] != kNone) slot = (slot + 1) & mask;
    slots_[slot] = strip;
  }
}

std::uint32_t Strips::find(const Key& key) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = slot_of(key); slots_[slot] != kNone; slot = (slot + 1) & mask)
    if (keys_[slots_[slot]] == key) return slots_[slot];
  return kNone;
}

std::uint32_t Strips::first_bucket(std::int64_t y, std::int64_t x) const {
  if (dense_) return static_cast<std::uint32_t>(y * columns_);
  const std::uint32_t strip = find({y, x});
  return strip == kNone ? kNone : strip << kBits;
}

Strips::Key Strips::key(std::size_t strip) const {
  return dense_ ? Key{static_cast<std::int64_t>(strip), 0} : keys_[strip];
}

/// Of the strip at x in its row.
std::uint32_t Strips::cells(std::int64_t x) const {
  if (dense_) return static_cast<std::uint32_t>(columns_);
  return static_cast<std::uint32_t>(std::min(kCells, columns_ - x * kCells));
}

Strips::Strip Strips::strip(std::size_t i) const {
  const Key key = this->key(i);
  const auto length = static_cast<std::uint32_t>(dense_ ? columns_ : kCells);
  return {static_cast<std::uint32_t>(i) * length, cells(key.x), key.x == 0, key.x == last_of_row()};
}

Strips::Beside Strips::beside(std::size_t i, int southward) const {
  const Key key = this->key(i);
  const bool wraps_x = periodic_ && columns_ > 1, wraps_y = periodic_ && rows_ > 1;
  const std::int64_t last = last_of_row();
  std::int64_t y = key.y + southward;
  Beside beside;
  beside.is_beyond = y < 0 || y >= rows_;
  if (beside.is_beyond && !wraps_y) return beside;
  if (beside.is_beyond) y = y < 0 ? rows_ - 1 : 0;
  const std::int64_t east = key.x < last ? key.x + 1 : wraps_x ? 0 : -1;
  const std::int64_t west = key.x > 0 ? key.x - 1 : wraps_x ? last : -1;
  beside.middle = first_bucket(y, key.x);
  if (east >= 0) beside.east = first_bucket(y, east);
  if (west >= 0) beside.west = first_bucket(y, west);
  if (beside.west != kNone) beside.west += cells(west) - 1;
  return beside;
}

}  // namespace throng::broadphase
