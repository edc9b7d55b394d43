// SPDX-License-Identifier: MIT
#include "sim/contact/held_faces.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <utility>

#include "narrowphase/relative.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::HeldFace;

namespace {

constexpr std::size_t kCacheLine = 64;  // bytes
constexpr std::uint32_t kMostAway = 8;
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

}  // namespace

void HeldFaces::start() {
  if (4 * moved_in_ > 3 * seats_.size() + 1000) forget_all();
  std::swap(seats_, last_);
  seats_.clear(), next_ = 0, named_ = 0;
}

std::uint32_t HeldFaces::lane_of(std::uint64_t key, broadphase::Pair pair) {
  while (next_ < last_.size() && last_[next_].key < key) leave_out(last_[next_++]);
  const bool known = next_ < last_.size() && last_[next_].key == key;
  const std::uint32_t lane = known ? last_[next_++].lane : take(pair);
  seats_.push_back({key, lane, 0}), ++named_;
  return lane;
}

void HeldFaces::finish() {
  while (next_ < last_.size()) leave_out(last_[next_++]);
}

/// Steps that are taken again look for pairs farther off: these come and go.
void HeldFaces::leave_out(const Seat& seat) {
  if (seat.away == kMostAway) return release(seat.lane);
  talk(seat.lane).asked[at(seat.lane)] = static_cast<double>(Wanted::nothing);
  seats_.push_back({seat.key, seat.lane, seat.away + 1});
}

/// Lanes in the order of keys walk through memory as bodies do; it doesn't last where many come and go.
void HeldFaces::forget_all() {
  seats_.clear(), free_.clear(), blocks_.clear(), talks_.clear(), notes_.clear();
  lanes_ = 0, named_ = 0, moved_in_ = 0;
}

std::size_t HeldFaces::known() const {
  std::size_t sum = 0;
  for (const HeldTalk& talk : talks_)
    sum += static_cast<std::size_t>(std::ranges::count_if(talk.count, [](double c) { return c >= 0.0; }));
  return sum;
}

std::uint32_t HeldFaces::take(broadphase::Pair pair) {
  std::uint32_t lane = lanes_;
  if (free_.empty()) {
    ++lanes_;
    if (lanes_ > notes_.size()) {
      blocks_.push_back({}), talks_.push_back({});
      std::ranges::fill(talks_.back().count, -1.0);
      notes_.resize(notes_.size() + BlockOrder::kWidth);
    }
  } else {
    lane = free_.back();
    free_.pop_back();
    ++moved_in_;
  }
  HeldBlock& own = own_block(lane);
  own.a[at(lane)] = pair.a, own.b[at(lane)] = pair.b;
  notes_[lane] = {};
  return lane;
}

void HeldFaces::release(std::uint32_t lane) {
  HeldBlock& own = own_block(lane);
  own.a[at(lane)] = own.b[at(lane)] = 0;
  talk(lane).asked[at(lane)] = static_cast<double>(Wanted::nothing);
  free_.push_back(lane);
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
  const HeldBlock& own = block(lane);
  const auto* first = reinterpret_cast<const char*>(&own.contact_normal_x);
  const auto* end = reinterpret_cast<const char*>(&own + 1);
  for (const char* line = first; line < end; line += kCacheLine) hwy::Prefetch(line);
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
