// SPDX-License-Identifier: MIT
#include "sim/contact/face_blocks.h"

namespace throng {

namespace {

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

void fill_point(FaceBlock::Point& point, std::size_t lane, const PointContact& contact) {
  point.normal_mass[lane] = contact.normal_mass, point.tangent_mass[lane] = contact.tangent_mass;
  point.normal_impulse[lane] = contact.normal_impulse, point.tangent_impulse[lane] = contact.tangent_impulse;
  point.preload[lane] = contact.preload;
  point.first_ax[lane] = contact.first_a.x(), point.first_ay[lane] = contact.first_a.y();
  point.first_bx[lane] = contact.first_b.x(), point.first_by[lane] = contact.first_b.y();
  point.gap[lane] = contact.gap;
}

void fill_point(FaceBlock::Point& to, std::size_t lane, const HeldBlock::Point& from, std::size_t of,
                const BlockImpulses& impulses) {
  to.normal_mass[lane] = from.normal_mass[of], to.tangent_mass[lane] = from.tangent_mass[of];
  to.normal_impulse[lane] = impulses.normal, to.tangent_impulse[lane] = impulses.tangent;
  to.preload[lane] = impulses.preload;
  to.first_ax[lane] = from.first_ax[of], to.first_ay[lane] = from.first_ay[of];
  to.first_bx[lane] = from.first_bx[of], to.first_by[lane] = from.first_by[of];
  to.gap[lane] = from.gap[of];
}

}  // namespace

void FaceBlocks::start(std::size_t bodies, std::size_t groups) {
  groups_.resize(groups);
  for (std::size_t i = 0; i < groups; ++i) {
    groups_[i].order.start(bodies);
    const auto nobody = static_cast<std::uint32_t>(bodies - groups + i);
    if (groups_[i].nobody != nobody)
      for (FaceBlock& block : groups_[i].blocks) block.used = BlockOrder::kWidth;
    groups_[i].nobody = nobody;
  }
  seat_.clear();
}

void FaceBlocks::seat(std::size_t i, std::size_t points, std::uint32_t a, bool a_moves, std::uint32_t b,
                      bool b_moves, std::size_t group) {
  Group& own = groups_[group];
  const std::uint32_t lane = own.order.place(a, a_moves, b, b_moves, points - 1);
  if (own.blocks.size() < own.order.blocks()) own.blocks.resize(own.order.blocks());
  FaceBlock& block = own.blocks[lane / BlockOrder::kWidth];
  block.count = points;
  block.a[lane % BlockOrder::kWidth] = a, block.b[lane % BlockOrder::kWidth] = b;
  for (std::uint16_t p = 0; p < points; ++p) seat_[i + p] = {lane, static_cast<std::uint16_t>(group), p};
}

void FaceBlocks::fill(std::size_t i, std::span<const PointContact> face) {
  FaceBlock& block = groups_[seat_[i].group].blocks[seat_[i].lane / BlockOrder::kWidth];
  const std::size_t lane = seat_[i].lane % BlockOrder::kWidth;
  assert(face.size() == block.count);
  fill_lane(block, lane, face[0]);
  for (std::size_t p = 0; p < face.size(); ++p) fill_point(block.points[p], lane, face[p]);
}

void FaceBlocks::fill(std::size_t i, const HeldBlock& held, std::size_t lane, double friction,
                      const std::array<BlockImpulses, 2>& impulses) {
  FaceBlock& block = groups_[seat_[i].group].blocks[seat_[i].lane / BlockOrder::kWidth];
  const std::size_t to = seat_[i].lane % BlockOrder::kWidth;
  block.normal_x[to] = held.contact_normal_x[lane], block.normal_y[to] = held.contact_normal_y[lane];
  block.friction[to] = friction;
  block.round_a[to] = block.round_b[to] = 0.0;
  for (std::size_t p = 0; p < block.count; ++p)
    fill_point(block.points[p], to, held.points[p], lane, impulses[p]);
}

void FaceBlocks::finish(std::size_t group) {
  Group& own = groups_[group];
  for (std::size_t i = 0; i < own.order.blocks(); ++i) {
    if (own.order.filled(i) == 0) own.blocks[i].count = 0;
    for (std::size_t lane = own.order.filled(i); lane < own.blocks[i].used; ++lane)
      clear_lane(own.blocks[i], lane, own.nobody);
    own.blocks[i].used = own.order.filled(i);
  }
}

BlockContact FaceBlocks::contact(std::size_t i) {
  FaceBlock& block = groups_[seat_[i].group].blocks[seat_[i].lane / BlockOrder::kWidth];
  FaceBlock::Point& point = block.points[seat_[i].point];
  const std::size_t lane = seat_[i].lane % BlockOrder::kWidth;
  return {block.a[lane],
          block.b[lane],
          &point.normal_mass[lane],
          &point.normal_impulse[lane],
          &point.tangent_impulse[lane],
          &point.preload[lane]};
}

PointContact FaceBlocks::operator[](std::size_t i) const {
  const FaceBlock& block = this->block(i);
  const FaceBlock::Point& p = point(i);
  const std::size_t lane = seat_[i].lane % BlockOrder::kWidth;
  PointContact contact;
  contact.a = block.a[lane], contact.b = block.b[lane];
  contact.normal = {block.normal_x[lane], block.normal_y[lane]};
  contact.arm_a = {p.arm_ax[lane], p.arm_ay[lane]}, contact.arm_b = {p.arm_bx[lane], p.arm_by[lane]};
  contact.normal_impulse = p.normal_impulse[lane], contact.tangent_impulse = p.tangent_impulse[lane];
  return contact;
}

}  // namespace throng
