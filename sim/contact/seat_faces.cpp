// SPDX-License-Identifier: MIT
// Where ContactFinder seats faces, over steps: those that touch for the first time are squeezed in between
// the others; seats are made anew where these are many, or where too much room is left.
#include <algorithm>

#include "sim/contact/contact_key.h"
#include "sim/contact/find_contacts.h"

namespace throng {

namespace {

constexpr int kLeastAge = 4;             // finds: seats aren't made anew before, only as there are too many
constexpr double kMostRoom = 1.15;       // for points, for each that there is
constexpr std::size_t kFewPoints = 100;  // don't matter
constexpr std::size_t kMostNewcomers = 64;
constexpr std::uint32_t kNobody = ~std::uint32_t{0};

}  // namespace

void ContactFinder::name_lanes(FaceBlocks& faces) {
  book_.start(), named_ = 0;
  for (Touch& touch : touches_) {
    const std::uint64_t key = touch.key();
    touch.lane = book_.lane_of(key);
    touch.held = holds_ && !touch.obstacle && may_be_held_[touch.pair.a] && may_be_held_[touch.pair.b];
    named_ += touch.held;
    if (touch.held && touch.lane == kNoLane) book_.add(key, touch.lane = held_.take(touch.pair));
  }
  book_.finish();
  for (const std::uint32_t lane : book_.unnamed()) {
    if (lane < faces.lanes()) faces.take(lane, 0);
    if (holds_) held_.ask_nothing(lane);
  }
}

/// Whether everybody has a seat with room for its points, and they aren't too many seats. Gives seats to a
/// few who haven't.
bool ContactFinder::all_sit_well(FaceBlocks& faces) {
  newcomers_.clear(), held_again_.clear();
  std::size_t points = 0;
  for (std::uint32_t i = 0; i < touches_.size(); ++i) {
    if (points_[i] == 0) continue;
    const std::uint32_t lane = touches_[i].lane;
    if (!(lane < faces.lanes()) || faces.room(lane) < points_[i]) {
      if (newcomers_.size() == kMostNewcomers) return false;
      newcomers_.push_back(i);
    }
    points += points_[i];
  }
  const double most = kMostRoom * static_cast<double>(points + kFewPoints);
  if (age_ >= kLeastAge && static_cast<double>(faces.room()) > most) return false;
  return newcomers_.empty() || seat_newcomers(faces);
}

bool ContactFinder::seat_newcomers(FaceBlocks& faces) {
  list_neighbours(faces);
  return std::ranges::all_of(newcomers_, [&](std::uint32_t touch) { return squeeze_in(faces, touch); });
}

ContactFinder::Neighbour ContactFinder::neighbour(const Touch& touch) const {
  const std::uint32_t a = colliders_.movable[touch.pair.a] ? touch.a : kNobody;
  const std::uint32_t b = !touch.obstacle && colliders_.movable[touch.pair.b] ? touch.b : kNobody;
  return {touch.key(), a, b, static_cast<std::uint32_t>(parts_.group(touch.a, touch.b)), touch.lane};
}

/// Who shares a body that moves with them and has a seat, whether or not it is taken.
void ContactFinder::list_neighbours(const FaceBlocks& faces) {
  is_newcomer_.resize(scene_.bodies.size());
  const auto mark = [&](std::uint8_t marked) {
    for (const std::uint32_t i : newcomers_) {
      const Neighbour one = neighbour(touches_[i]);
      if (one.a != kNobody) is_newcomer_[one.a] = marked;
      if (one.b != kNobody) is_newcomer_[one.b] = marked;
    }
  };
  const auto is_marked = [&](std::uint32_t body) { return body != kNobody && is_newcomer_[body]; };
  mark(1);
  neighbours_.clear();
  book_.for_each([&](std::uint64_t key, std::uint32_t lane) {
    if (lane >= faces.lanes()) return;
    Touch touch = this->touch(pair_of(key), is_of_obstacle(key), Vec(0.0, 0.0));
    touch.lane = lane;
    const Neighbour one = neighbour(touch);
    if (is_marked(one.a) || is_marked(one.b)) neighbours_.push_back(one);
  });
  mark(0);
}

/// Behind the seats of earlier contacts of its bodies, and before those of later ones. False where that can't
/// be.
bool ContactFinder::squeeze_in(FaceBlocks& faces, std::uint32_t i) {
  Touch& touch = touches_[i];
  Neighbour own = neighbour(touch);
  const auto is_own = [&](std::uint32_t body) { return body != kNobody && (body == own.a || body == own.b); };
  std::size_t first = 0, end = faces.blocks(own.group).size();
  for (const Neighbour& one : neighbours_) {
    if (one.group != own.group || !(is_own(one.a) || is_own(one.b))) continue;
    if (one.key < own.key) first = std::max(first, faces.rank(one.lane) + 1);
    if (one.key > own.key) end = std::min(end, faces.rank(one.lane));
  }
  own.lane = faces.squeeze_in(points_[i], own.group, first, end);
  if (own.lane == kNoLane) return false;
  std::erase_if(neighbours_, [&](const Neighbour& one) { return one.key == own.key; });
  neighbours_.push_back(own);
  book_.change(own.key, own.lane);
  faces.name(own.lane, touch.a, touch.b);
  if (touch.lane < faces.lanes()) faces.leave(touch.lane, own.group);
  if (touch.held) {
    held_.move(touch.lane, own.lane), held_again_.push_back(own.lane / BlockOrder::kWidth);
    set_polygons(touch, own.lane, faces);
  }
  touch.lane = own.lane;
  return true;
}

void ContactFinder::take_seats(FaceBlocks& faces) {
  first_point_.resize(touches_.size());
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    first_point_[i] = static_cast<std::uint32_t>(faces.size());
    if (touches_[i].lane < faces.lanes()) faces.take(touches_[i].lane, points_[i]);
  }
}

/// In the order of touches, each group by itself: what a lane then holds may come in any.
void ContactFinder::seat_anew(BodyRows<const SolverBody> bodies, FaceBlocks& faces, Workers& workers) {
  seated_.resize(parts_.groups()), seat_.assign(touches_.size(), kNoLane);
  for (auto& touches : seated_) touches.clear();
  for (std::uint32_t i = 0; i < touches_.size(); ++i)
    if (points_[i] > 0) seated_[parts_.group(touches_[i].a, touches_[i].b)].push_back(i);
  faces.start(bodies.size(), parts_.groups(), bodies.slots());
  workers.for_few(parts_.groups(), [&](std::size_t group) { seat_group(group, faces); });
  faces.finish();
  for (std::size_t group = 0; group < seated_.size(); ++group)
    for (const std::uint32_t i : seated_[group]) {
      seat_[i] = faces.lane(group, seat_[i]);
      faces.name(seat_[i], touches_[i].a, touches_[i].b);
    }
  if (holds_) hold_seats(faces);
  book_.forget_all();
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    touches_[i].lane = seat_[i];
    if (seat_[i] != kNoLane) book_.add(touches_[i].key(), seat_[i]);
  }
}

void ContactFinder::seat_group(std::size_t group, FaceBlocks& faces) {
  for (const std::uint32_t i : seated_[group]) {
    const Touch& touch = touches_[i];
    const bool a_moves = colliders_.movable[touch.pair.a];
    const bool b_moves = !touch.obstacle && colliders_.movable[touch.pair.b];
    seat_[i] = faces.seat(points_[i], touch.a, a_moves, touch.b, b_moves, group);
  }
}

}  // namespace throng
