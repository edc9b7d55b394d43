// SPDX-License-Identifier: MIT
#include "tools/bench/clouds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace throng::bench {

namespace {

using broadphase::Point;
using std::numbers::pi;

constexpr double kBlob = 1000.0;  // points
constexpr std::uint64_t kPlace = 1, kSecond = 2, kCentre = 3, kRadius = 4;

Point in_square(std::uint64_t seed, std::uint64_t index, double side) {
  return {side * random_unit(seed, 2 * index), side * random_unit(seed, 2 * index + 1)};
}

/// Two independent normal numbers (Box, Muller 1958).
Point normal(std::uint64_t index) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random_unit(kPlace, index)));
  const double angle = 2.0 * pi * random_unit(kSecond, index);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// In blobs that leave three quarters of the plane about empty. A point meets three quarters of its
/// neighbours in its own blob: their mean number there is blob / (4 sigma^2).
Point in_blob(std::size_t n, double k, std::uint64_t index) {
  const double side = 2.0 * std::sqrt(static_cast<double>(n) * pi / k);
  const double sigma = std::sqrt(kBlob / (4.0 * 0.75 * k));
  const auto blob = static_cast<std::uint64_t>(static_cast<double>(index) / kBlob);
  return in_square(kCentre, blob, side) + sigma * normal(index);
}

/// Between 1 / ratio and 1, evenly on a logarithmic scale.
std::vector<double> radii(std::size_t n, double ratio) {
  std::vector<double> result;
  for (std::size_t i = 0; i < n; ++i) result.push_back(std::pow(ratio, random_unit(kRadius, i) - 1.0));
  return result;
}

/// The mean of (r_i + r_j)^2.
double mean_square_reach(const std::vector<double>& radii) {
  double sum = 0.0, squares = 0.0;
  for (const double r : radii) {
    sum += r;
    squares += r * r;
  }
  const double n = static_cast<double>(radii.size());
  return 2.0 * squares / n + 2.0 * (sum / n) * (sum / n);
}

/// Brings a cloud into an order: that of `key`, ties as they are.
template <class Key>
void sort(Cloud& cloud, Key&& key) {
  std::vector<std::size_t> order(cloud.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
  const Cloud old = cloud;
  for (std::size_t i = 0; i < order.size(); ++i) {
    cloud.points[i] = old.points[order[i]];
    if (!old.radii.empty()) cloud.radii[i] = old.radii[order[i]];
  }
}

}  // namespace

std::string case_name(Kind kind, std::size_t n, double k, bool spatial) {
  const char* kinds[] = {"uniform", "clustered", "line", "mixed"};
  return std::string(kinds[static_cast<int>(kind)]) + " n=" + std::to_string(n) +
         " k=" + std::to_string(static_cast<int>(k)) + (spatial ? " spatial" : " random");
}

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = (seed << 56) + (index + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double random_unit(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(random_bits(seed, index) >> 11) * 0x1p-53;
}

Cloud cloud(Kind kind, std::size_t n, double k, bool spatial, double size_ratio) {
  Cloud cloud{case_name(kind, n, k, spatial), {}, 1.0, {}};
  const double count = static_cast<double>(n);
  double square = count * pi / k;  // m^2
  if (kind == Kind::mixed) {
    cloud.radii = radii(n, size_ratio);
    square *= mean_square_reach(cloud.radii);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (kind == Kind::clustered)
      cloud.points.push_back(in_blob(n, k, i));
    else if (kind == Kind::line)
      cloud.points.push_back({2.0 * count / k * random_unit(kPlace, i), 0.0});
    else
      cloud.points.push_back(in_square(kPlace, i, std::sqrt(square)));
  }
  if (spatial) {
    sort(cloud, [&](std::size_t i) { return cloud.points[i].x(); });
    sort(cloud, [&](std::size_t i) { return std::floor(cloud.points[i].y() / cloud.reach); });
  } else if (kind == Kind::clustered) {
    sort(cloud, [](std::size_t i) { return random_bits(kRadius, i); });
  }
  return cloud;
}

}  // namespace throng::bench
