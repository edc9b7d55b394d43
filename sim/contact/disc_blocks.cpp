// SPDX-License-Identifier: MIT
#include "sim/contact/disc_blocks.h"

#include <algorithm>
#include <atomic>

namespace throng {

namespace {

void clear_lane(DiscBlock& block, std::size_t lane, std::uint32_t nobody) {
  block.a[lane] = block.b[lane] = nobody;
  for (DiscBlock::Row* row :
       {&block.normal_x, &block.normal_y, &block.image, &block.separation, &block.normal_mass,
        &block.tangent_mass, &block.friction, &block.normal_impulse, &block.tangent_impulse, &block.preload,
        &block.radius_a, &block.radius_b, &block.turn_a, &block.turn_b})
    (*row)[lane] = 0.0;
}

void fill_lane(DiscBlock& block, std::size_t lane, const DiscContact& contact, const SolverBody& a,
               const SolverBody& b) {
  block.normal_mass[lane] = contact.normal_mass, block.tangent_mass[lane] = contact.tangent_mass;
  block.friction[lane] = contact.friction;
  block.normal_impulse[lane] = contact.normal_impulse, block.tangent_impulse[lane] = contact.tangent_impulse;
  block.preload[lane] = contact.preload;
  block.radius_a[lane] = contact.radius_a, block.radius_b[lane] = contact.radius_b;
  block.turn_a[lane] = a.inverse_inertia * contact.radius_a;
  block.turn_b[lane] = b.inverse_inertia * contact.radius_b;
}

}  // namespace

void DiscBlocks::start(std::size_t bodies, std::size_t groups, const BodySlots& slots) {
  slots_ = &slots;
  groups_.resize(groups);
  for (std::size_t i = 0; i < groups; ++i) {
    groups_[i].order.start(bodies);
    groups_[i].nobody = slots_->slot(static_cast<std::uint32_t>(bodies - groups + i));
  }
  key_.clear(), seat_lane_.clear(), taken_.clear(), owner_.clear(), lane_.clear();
}

void DiscBlocks::add(std::uint64_t key, const DiscContact& contact, const SolverBody& a, const SolverBody& b,
                     std::size_t group) {
  Group& own = groups_[group];
  const std::uint32_t lane = own.order.place(contact.a, a.is_dynamic(), contact.b, b.is_dynamic());
  key_.push_back(key), taken_.push_back(1);
  owner_.push_back({slots_->slot(contact.a), slots_->slot(contact.b), contact.normal_mass});
  seat_lane_.push_back({static_cast<std::uint32_t>(group), lane});
  lane_.push_back(seat_lane_.back());
  if (own.blocks.size() < own.order.blocks()) own.blocks.resize(own.order.blocks());
  DiscBlock& block = own.blocks[lane / BlockOrder::kWidth];
  block.a[lane % BlockOrder::kWidth] = owner_.back().a, block.b[lane % BlockOrder::kWidth] = owner_.back().b;
  fill_lane(block, lane % BlockOrder::kWidth, contact, a, b);
}

void DiscBlocks::finish() {
  for (Group& group : groups_)
    for (std::size_t i = 0; i < group.order.blocks(); ++i)
      for (std::size_t lane = group.order.filled(i); lane < BlockOrder::kWidth; ++lane)
        clear_lane(group.blocks[i], lane, group.nobody);
}

/// A lane as good as empty: without mass no impulse comes to be, and nobody would feel it.
void DiscBlocks::vacate(std::size_t seat) {
  if (!taken_[seat]) return;
  taken_[seat] = 0;
  DiscBlock& block = this->block(seat_lane_[seat]);
  const std::size_t lane = seat_lane_[seat].lane % BlockOrder::kWidth;
  block.a[lane] = block.b[lane] = groups_[seat_lane_[seat].group].nobody;
  block.normal_mass[lane] = block.normal_impulse[lane] = block.tangent_impulse[lane] = block.preload[lane] =
      0.0;
}

void DiscBlocks::occupy(std::size_t seat) {
  if (taken_[seat]) return;
  taken_[seat] = 1;
  DiscBlock& block = this->block(seat_lane_[seat]);
  const std::size_t lane = seat_lane_[seat].lane % BlockOrder::kWidth;
  block.a[lane] = owner_[seat].a, block.b[lane] = owner_[seat].b;
  block.normal_mass[lane] = owner_[seat].normal_mass;
}

bool DiscBlocks::take(std::span<const std::uint64_t> keys, Workers& workers) {
  lane_.resize(keys.size());
  std::atomic<bool> all = true;
  workers.for_ranges(keys.size(), [&](std::size_t begin, std::size_t end) {
    if (!take(keys, begin, end)) all = false;
  });
  return all;
}

/// The keys of a range, and what seats stand from the first of them on to that of the next range.
bool DiscBlocks::take(std::span<const std::uint64_t> keys, std::size_t begin, std::size_t end) {
  const auto seat_of = [&](std::size_t i) {
    return static_cast<std::size_t>(std::ranges::lower_bound(key_, keys[i]) - key_.begin());
  };
  std::size_t seat = begin == 0 ? 0 : seat_of(begin);
  const std::size_t last = end == keys.size() ? key_.size() : seat_of(end);
  for (std::size_t i = begin; i < end; ++i) {
    while (seat < last && key_[seat] < keys[i]) vacate(seat++);
    if (seat == last || key_[seat] != keys[i]) return false;
    occupy(seat);
    lane_[i] = seat_lane_[seat++];
  }
  while (seat < last) vacate(seat++);
  return true;
}

void DiscBlocks::set_impulses(std::size_t i, const BlockImpulses& impulses) {
  DiscBlock& block = this->block(lane_[i]);
  const std::size_t lane = lane_[i].lane % BlockOrder::kWidth;
  block.normal_impulse[lane] = impulses.normal;
  block.tangent_impulse[lane] = impulses.tangent;
  block.preload[lane] = impulses.preload;
}

BlockContact DiscBlocks::contact(std::size_t i) {
  DiscBlock& block = this->block(lane_[i]);
  const std::size_t lane = lane_[i].lane % BlockOrder::kWidth;
  return {slots_->row(block.a[lane]),  slots_->row(block.b[lane]),   &block.normal_mass[lane],
          &block.normal_impulse[lane], &block.tangent_impulse[lane], &block.preload[lane]};
}

DiscContact DiscBlocks::operator[](std::size_t i) const {
  const DiscBlock& block = this->block(lane_[i]);
  const std::size_t lane = lane_[i].lane % BlockOrder::kWidth;
  DiscContact contact;
  contact.a = slots_->row(block.a[lane]), contact.b = slots_->row(block.b[lane]);
  contact.normal = {block.normal_x[lane], block.normal_y[lane]};
  contact.radius_a = block.radius_a[lane], contact.radius_b = block.radius_b[lane];
  contact.normal_impulse = block.normal_impulse[lane], contact.tangent_impulse = block.tangent_impulse[lane];
  return contact;
}

}  // namespace throng
