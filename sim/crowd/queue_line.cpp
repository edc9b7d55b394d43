// SPDX-License-Identifier: MIT
#include "sim/crowd/queue_line.h"

#include <algorithm>
#include <limits>

namespace throng {

namespace {

constexpr double kPlaceRounding = 1e-9;  // of a place: a line of 6 m has 11 places 0.6 m apart

}  // namespace

QueueLine::QueueLine(const Queue& queue) : points_(queue.line), along_{0.0}, spacing_(queue.spacing) {
  for (std::size_t i = 1; i < points_.size(); ++i)
    along_.push_back(along_.back() + (points_[i] - points_[i - 1]).norm());
}

std::uint32_t QueueLine::places() const {
  return static_cast<std::uint32_t>(along_.back() / spacing_ + kPlaceRounding) + 1;
}

Vec QueueLine::at(double along) const {
  std::size_t i = 1;
  while (i + 1 < points_.size() && along_[i] < along) ++i;
  return on(i, along);
}

Vec QueueLine::on(std::size_t i, double along) const {
  const double t = (along - along_[i - 1]) / (along_[i] - along_[i - 1]);
  return points_[i - 1] + std::clamp(t, 0.0, 1.0) * (points_[i] - points_[i - 1]);
}

Vec QueueLine::place(std::uint32_t number) const {
  return at((std::clamp(number, 1u, places()) - 1.0) * spacing_);
}

std::vector<Vec> QueueLine::all_places() const {
  std::vector<Vec> all(places());
  std::size_t i = 1;
  for (std::size_t place = 0; place < all.size(); ++place) {
    const double along = static_cast<double>(place) * spacing_;
    while (i + 1 < points_.size() && along_[i] < along) ++i;
    all[place] = on(i, along);
  }
  return all;
}

double QueueLine::nearest(const Vec& p) const {
  double least = std::numeric_limits<double>::infinity(), along = 0.0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Vec q = nearest_on_segment(points_[i - 1], points_[i], p);
    if ((q - p).squaredNorm() >= least) continue;
    least = (q - p).squaredNorm();
    along = along_[i - 1] + (q - points_[i - 1]).norm();
  }
  return along;
}

double QueueLine::distance(const Vec& p) const {
  return (at(nearest(p)) - p).norm();
}

std::optional<Vec> QueueLine::bend(const Vec& p, std::uint32_t number) const {
  const double from = nearest(p), to = (std::clamp(number, 1u, places()) - 1.0) * spacing_;
  const double passed = 0.25 * spacing_;  // so near, a bend is reached
  if (to < from) {
    for (std::size_t i = points_.size(); i-- > 0;)
      if (along_[i] < from - passed && along_[i] > to) return points_[i];
  } else {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (along_[i] > from + passed && along_[i] < to) return points_[i];
  }
  return std::nullopt;
}

}  // namespace throng
