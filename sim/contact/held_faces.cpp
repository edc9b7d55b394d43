// SPDX-License-Identifier: MIT
#include "sim/contact/held_faces.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "narrowphase/relative.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::HeldFace;

namespace {

constexpr std::uint8_t kSearchesBetween = 16;  // searches

void set_face(HeldBlock& block, std::size_t i, const HeldFace& held, const Convex& reference,
              const Convex& other) {
  const std::size_t head = narrowphase::next(held.incident, other.vertices.size());
  const std::size_t face_head = narrowphase::next(held.reference, reference.vertices.size());
  const Vec &origin = reference.vertices[held.reference], &end = reference.vertices[face_head];
  const Vec &normal = reference.normals[held.reference], &tail = other.vertices[held.incident];
  const Vec& tip = other.vertices[head];
  block.of_b[i] = held.of_b;
  block.origin_x[i] = origin.x(), block.origin_y[i] = origin.y();
  block.face_head_x[i] = end.x(), block.face_head_y[i] = end.y();
  block.normal_x[i] = normal.x(), block.normal_y[i] = normal.y();
  block.head_x[i] = tip.x(), block.head_y[i] = tip.y();
  block.tail_x[i] = tail.x(), block.tail_y[i] = tail.y();
  block.tail_first[i] = held.incident < head;
  const Vec& incident_normal = other.normals[held.incident];
  block.incident_normal_x[i] = incident_normal.x(), block.incident_normal_y[i] = incident_normal.y();
  block.much[i] = narrowphase::kMuchWider * std::min((end - origin).norm(), (tip - tail).norm());
}

/// All that is held of a pair.
void copy_rows(const HeldBlock& from, std::size_t of, HeldBlock& to, std::size_t lane) {
  constexpr std::size_t kRows =
      (offsetof(HeldBlock, end) - offsetof(HeldBlock, at_x)) / sizeof(HeldBlock::Row);
  const auto* source = reinterpret_cast<const HeldBlock::Row*>(&from.at_x);
  auto* target = reinterpret_cast<HeldBlock::Row*>(&to.at_x);
  for (std::size_t row = 0; row < kRows; ++row) target[row][lane] = source[row][of];
}

}  // namespace

std::size_t HeldFaces::known() const {
  std::size_t sum = 0;
  for (const HeldTalk& talk : talks_)
    sum += static_cast<std::size_t>(std::ranges::count_if(talk.count, [](double c) { return c >= 0.0; }));
  return sum;
}

/// Lanes that nobody has ask nothing.
void HeldFaces::grow(std::size_t blocks) {
  const std::size_t before = talks_.size();
  if (blocks_.size() < blocks) blocks_.resize(blocks);
  talks_.resize(blocks), notes_.resize(blocks * BlockOrder::kWidth);
  for (std::size_t i = before; i < blocks; ++i) std::ranges::fill(talks_[i].count, -1.0);
}

void HeldFaces::move(std::size_t blocks, std::span<Move> moves) {
  std::swap(blocks_, last_blocks_), std::swap(talks_, last_talks_), std::swap(notes_, last_notes_);
  talks_.clear(), notes_.clear();
  lanes_ = blocks * BlockOrder::kWidth;
  for (Move& move : moves)
    if (move.to == kNoLane) move.to = static_cast<std::uint32_t>(lanes_++);
  grow((lanes_ + BlockOrder::kWidth - 1) / BlockOrder::kWidth);
  for (const Move& move : moves) {
    HeldBlock& own = own_block(move.to);
    own.a[at(move.to)] = move.pair.a, own.b[at(move.to)] = move.pair.b;
    if (move.from == kNoLane) continue;
    talk(move.to).asked[at(move.to)] = last_talks_[move.from / BlockOrder::kWidth].asked[at(move.from)];
    notes_[move.to] = last_notes_[move.from];
    if (notes_[move.to].kind != HeldFace::Kind::none)
      copy_rows(last_blocks_[move.from / BlockOrder::kWidth], at(move.from), own, at(move.to));
  }
}

void HeldFaces::move(std::uint32_t from, std::uint32_t to) {
  const HeldBlock& old = own_block(from);
  HeldBlock& own = own_block(to);
  own.a[at(to)] = old.a[at(from)], own.b[at(to)] = old.b[at(from)];
  copy_rows(old, at(from), own, at(to));
  notes_[to] = notes_[from];
  talk(to).asked[at(to)] = talk(from).asked[at(from)];
  ask_nothing(from);
}

void HeldFaces::forget_all() {
  talks_.clear(), notes_.clear();
  lanes_ = 0;
}

std::uint32_t HeldFaces::take(broadphase::Pair pair) {
  const auto lane = static_cast<std::uint32_t>(lanes_++);
  if (lanes_ > notes_.size()) grow(blocks() + 1);
  HeldBlock& own = own_block(lane);
  own.a[at(lane)] = pair.a, own.b[at(lane)] = pair.b;
  return lane;
}

void HeldFaces::ask_nothing(std::uint32_t lane) {
  talk(lane).asked[at(lane)] = static_cast<double>(Wanted::nothing);
}

Wanted HeldFaces::wanted(const Note& note, const std::uint32_t* kept) const {
  switch (note.kind) {
    case HeldFace::Kind::none:
      return Wanted::nothing;
    case HeldFace::Kind::apart:
      return Wanted::apart;
    case HeldFace::Kind::face:
      break;
  }
  if (!kept) return Wanted::widest;
  return std::ranges::find(note.names, *kept) != note.names.end() ? Wanted::kept : Wanted::nothing;
}

void HeldFaces::ask(std::uint32_t lane, const std::uint32_t* kept, const Vec* shift) {
  talk(lane).asked[at(lane)] = static_cast<double>(wanted(notes_[lane], kept));
  if (!shift) return;
  HeldBlock& own = own_block(lane);
  own.shift_x[at(lane)] = shift->x(), own.shift_y[at(lane)] = shift->y();
}

void HeldFaces::fetch(std::uint32_t lane) const {
  hwy::Prefetch(&notes_[lane]);
  for (const auto& end : block(lane).end) hwy::Prefetch(&end);
}

bool HeldFaces::wants_hold(std::uint32_t lane, const std::uint32_t* feature,
                           const narrowphase::Pose& b_in_a) {
  std::uint8_t& wait = notes_[lane].wait;
  if (wait == 0) return !feature || !holds(lane, *feature, b_in_a);
  --wait;
  return false;
}

/// Whether the reference of that feature is held, but for a rival that is about as wide.
bool HeldFaces::holds(std::uint32_t lane, std::uint32_t feature, const narrowphase::Pose& b_in_a) const {
  const Note& note = notes_[lane];
  if (note.kind != HeldFace::Kind::face || std::ranges::find(note.names, feature) == note.names.end())
    return false;
  const HeldBlock& own = block(lane);
  const std::size_t i = at(lane);
  HeldFace held;
  held.b_in_a = {Vec(own.at_x[i], own.at_y[i]), own.cos[i], own.sin[i]}, held.lever = own.lever[i];
  return movement(held, b_in_a) <= own.most[i];
}

void HeldFaces::hold(std::uint32_t lane, const HeldFace& held, const Convex& a, const Convex& b,
                     double least) {
  const bool worthwhile = held.kind != HeldFace::Kind::none && held.most > least;
  notes_[lane].kind = worthwhile ? held.kind : HeldFace::Kind::none;
  notes_[lane].wait = worthwhile ? 0 : kSearchesBetween;
  if (!worthwhile) return;
  HeldBlock& own = own_block(lane);
  const std::size_t i = at(lane);
  own.at_x[i] = held.b_in_a.position.x(), own.at_y[i] = held.b_in_a.position.y();
  own.cos[i] = held.b_in_a.cos, own.sin[i] = held.b_in_a.sin;
  own.lever[i] = held.lever, own.most[i] = held.most;
  const Convex &reference = held.of_b ? b : a, &other = held.of_b ? a : b;
  own.radius_reference[i] = reference.radius, own.radius_incident[i] = other.radius;
  if (held.kind == HeldFace::Kind::apart) return;
  set_face(own, i, held, reference, other);
  notes_[lane].names = narrowphase::end_names(reference, held.reference, other, held.incident, held.of_b);
}

}  // namespace throng
