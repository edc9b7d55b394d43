// SPDX-License-Identifier: MIT
#include "sim/contact/face_blocks.h"

#include <hwy/cache_control.h>

#include <algorithm>

namespace throng {

namespace {

constexpr std::size_t kFewSpare = 8, kSpareShare = 32;  // blocks to be squeezed in
constexpr std::size_t kBehind = 3;  // blocks from what must come before to what is squeezed in

void clear_point(FaceBlock::Point& p, std::size_t lane) {
  for (FaceBlock::Row* row : {&p.arm_ax, &p.arm_ay, &p.arm_bx, &p.arm_by, &p.offset, &p.separation,
                              &p.normal_mass, &p.tangent_mass, &p.normal_impulse, &p.tangent_impulse,
                              &p.preload, &p.first_ax, &p.first_ay, &p.first_bx, &p.first_by, &p.gap})
    (*row)[lane] = 0.0;
}

void clear_lane(FaceBlock& block, std::size_t lane, std::uint32_t nobody) {
  block.a[lane] = block.b[lane] = nobody;
  for (FaceBlock::Row* row :
       {&block.normal_x, &block.normal_y, &block.friction, &block.round_a, &block.round_b})
    (*row)[lane] = 0.0;
  clear_point(block.points[0], lane), clear_point(block.points[1], lane);
}

/// What both points of a face share.
void fill_lane(FaceBlock& block, std::size_t lane, const PointContact& contact) {
  block.normal_x[lane] = contact.normal.x(), block.normal_y[lane] = contact.normal.y();
  block.friction[lane] = contact.friction;
  block.round_a[lane] = contact.round_a, block.round_b[lane] = contact.round_b;
}

void place_point(FaceBlock::Point& point, std::size_t lane, const PointContact& contact) {
  point.normal_mass[lane] = contact.normal_mass, point.tangent_mass[lane] = contact.tangent_mass;
  point.first_ax[lane] = contact.first_a.x(), point.first_ay[lane] = contact.first_a.y();
  point.first_bx[lane] = contact.first_b.x(), point.first_by[lane] = contact.first_b.y();
  point.gap[lane] = contact.gap;
}

void fill_point(FaceBlock::Point& point, std::size_t lane, const PointContact& contact) {
  place_point(point, lane, contact);
  point.normal_impulse[lane] = contact.normal_impulse, point.tangent_impulse[lane] = contact.tangent_impulse;
  point.preload[lane] = contact.preload;
}

}  // namespace

void FaceBlocks::start(std::size_t bodies, std::size_t groups, const BodySlots& slots) {
  slots_ = &slots;
  groups_.resize(groups);
  for (std::size_t i = 0; i < groups; ++i) {
    groups_[i].order.start(bodies);
    groups_[i].room.clear(), groups_[i].sequence.clear(), groups_[i].first = 0;
    groups_[i].nobody = slots_->slot(static_cast<std::uint32_t>(bodies - groups + i));
  }
  seat_.clear(), room_.clear(), taken_.clear(), rank_.clear(), squeezed_.clear(), all_room_ = 0;
}

std::uint32_t FaceBlocks::seat(std::size_t points, std::uint32_t a, bool a_moves, std::uint32_t b,
                               bool b_moves, std::size_t group) {
  Group& own = groups_[group];
  const std::uint32_t lane = own.order.place(a, a_moves, b, b_moves, points - 1);
  own.room.resize(own.order.blocks());
  own.room[lane / BlockOrder::kWidth] = static_cast<std::uint8_t>(points);
  return lane;
}

void FaceBlocks::finish() {
  for (Group& own : groups_) {
    own.first = room_.size();
    for (const std::uint8_t room : own.room) {
      own.sequence.push_back(static_cast<std::uint32_t>(room_.size()));
      room_.push_back(room), all_room_ += BlockOrder::kWidth * room;
    }
  }
  const std::size_t spare = kFewSpare + room_.size() / kSpareShare;
  room_.resize(room_.size() + spare, 0), rank_.resize(room_.size()), taken_.assign(lanes(), 0);
  if (blocks_.size() < room_.size()) blocks_.resize(room_.size());
  for (const Group& own : groups_) {
    set_ranks(own, 0);
    for (std::size_t i = 0; i < own.order.blocks(); ++i) {
      FaceBlock& block = blocks_[own.first + i];
      block.count = own.room[i];
      for (std::size_t lane = own.order.filled(i); lane < BlockOrder::kWidth; ++lane)
        clear_lane(block, lane, own.nobody);
    }
  }
}

void FaceBlocks::set_ranks(const Group& group, std::size_t first) {
  for (std::size_t i = first; i < group.sequence.size(); ++i)
    rank_[group.sequence[i]] = static_cast<std::uint32_t>(i);
}

std::uint32_t FaceBlocks::squeeze_in(std::size_t points, std::size_t group, std::size_t first,
                                     std::size_t end) {
  if (first > end) return kNoLane;
  for (Squeezed& one : squeezed_)
    if (one.group == group && one.filled < BlockOrder::kWidth && room_[one.block] == points &&
        first <= rank_[one.block] && rank_[one.block] < end)
      return static_cast<std::uint32_t>(one.block * BlockOrder::kWidth + one.filled++);
  return add_squeezed(points, group, first + std::min(kBehind, (end - first) / 2));
}

std::uint32_t FaceBlocks::add_squeezed(std::size_t points, std::size_t group, std::size_t rank) {
  Group& own = groups_[group];
  const std::size_t block = groups_.back().first + groups_.back().room.size() + squeezed_.size();
  if (block == room_.size()) return kNoLane;
  const auto number = static_cast<std::uint32_t>(block);
  squeezed_.push_back({number, static_cast<std::uint32_t>(group), 1});
  own.sequence.insert(own.sequence.begin() + static_cast<std::ptrdiff_t>(rank), number);
  set_ranks(own, rank);
  room_[block] = static_cast<std::uint8_t>(points), all_room_ += BlockOrder::kWidth * points;
  blocks_[block].count = points;
  for (std::size_t lane = 0; lane < BlockOrder::kWidth; ++lane) clear_lane(blocks_[block], lane, own.nobody);
  return static_cast<std::uint32_t>(block * BlockOrder::kWidth);
}

void FaceBlocks::name(std::uint32_t lane, std::uint32_t a, std::uint32_t b) {
  FaceBlock& block = blocks_[lane / BlockOrder::kWidth];
  block.a[lane % BlockOrder::kWidth] = slots_->slot(a), block.b[lane % BlockOrder::kWidth] = slots_->slot(b);
}

void FaceBlocks::take(std::uint32_t lane, std::size_t points) {
  assert(points <= room(lane));
  for (std::size_t p = points; p < taken_[lane]; ++p)
    clear_point(blocks_[lane / BlockOrder::kWidth].points[p], lane % BlockOrder::kWidth);
  taken_[lane] = static_cast<std::uint8_t>(points);
  for (std::uint32_t p = 0; p < points; ++p) seat_.push_back({lane, p});
}

void FaceBlocks::leave(std::uint32_t lane, std::size_t group) {
  take(lane, 0);
  FaceBlock& block = blocks_[lane / BlockOrder::kWidth];
  block.a[lane % BlockOrder::kWidth] = block.b[lane % BlockOrder::kWidth] = groups_[group].nobody;
}

void FaceBlocks::fill(std::size_t i, std::span<const PointContact> face) {
  FaceBlock& block = this->block(i);
  fill_lane(block, at(i), face[0]);
  for (std::size_t p = 0; p < face.size(); ++p) fill_point(block.points[p], at(i), face[p]);
}

void FaceBlocks::place(std::size_t i, std::span<const PointContact> face) {
  FaceBlock& block = this->block(i);
  fill_lane(block, at(i), face[0]);
  for (std::size_t p = 0; p < face.size(); ++p) place_point(block.points[p], at(i), face[p]);
}

void FaceBlocks::set_polygons(std::uint32_t lane, double friction) {
  FaceBlock& block = blocks_[lane / BlockOrder::kWidth];
  const std::size_t at = lane % BlockOrder::kWidth;
  block.friction[at] = friction, block.round_a[at] = block.round_b[at] = 0.0;
}

void FaceBlocks::set_impulses(std::size_t i, const BlockImpulses& impulses) {
  FaceBlock::Point& p = block(i).points[seat_[i].point];
  p.normal_impulse[at(i)] = impulses.normal, p.tangent_impulse[at(i)] = impulses.tangent;
  p.preload[at(i)] = impulses.preload;
}

void FaceBlocks::fetch_impulses(std::uint32_t lane) const {
  const FaceBlock& block = blocks_[lane / BlockOrder::kWidth];
  for (std::size_t p = 0; p < room(lane); ++p)
    for (const auto* row :
         {&block.points[p].normal_impulse, &block.points[p].tangent_impulse, &block.points[p].preload})
      hwy::Prefetch(row);
}

BlockContact FaceBlocks::contact(std::size_t i) {
  FaceBlock& block = this->block(i);
  FaceBlock::Point& point = block.points[seat_[i].point];
  const std::size_t lane = at(i);
  return {slots_->row(block.a[lane]),  slots_->row(block.b[lane]),   &point.normal_mass[lane],
          &point.normal_impulse[lane], &point.tangent_impulse[lane], &point.preload[lane]};
}

PointContact FaceBlocks::operator[](std::size_t i) const {
  const FaceBlock& block = this->block(i);
  const FaceBlock::Point& p = point(i);
  const std::size_t lane = at(i);
  PointContact contact;
  contact.a = slots_->row(block.a[lane]), contact.b = slots_->row(block.b[lane]);
  contact.normal = {block.normal_x[lane], block.normal_y[lane]};
  contact.arm_a = {p.arm_ax[lane], p.arm_ay[lane]}, contact.arm_b = {p.arm_bx[lane], p.arm_by[lane]};
  contact.round_a = block.round_a[lane], contact.round_b = block.round_b[lane];
  contact.normal_impulse = p.normal_impulse[lane], contact.tangent_impulse = p.tangent_impulse[lane];
  return contact;
}

}  // namespace throng
