// SPDX-License-Identifier: MIT
#include "narrowphase/orientation.h"

#include <array>
#include <cmath>

namespace throng::narrowphase {

namespace {

int sign(double x) {
  return (x > 0.0) - (x < 0.0);
}

/// A sum of doubles that don't overlap, smallest first: exact, whatever is added.
class Expansion {
 public:
  void add_product(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }
  int sign_of_sum() const { return size_ == 0 ? 0 : sign(terms_[size_ - 1]); }

 private:
  /// Shewchuk's Grow-Expansion; each step is Knuth's Two-Sum, whose error goes into the next smaller term.
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + terms_[i], virtual_term = sum - x;
      const double error = (x - (sum - virtual_term)) + (terms_[i] - virtual_term);
      if (error != 0.0) terms_[kept++] = error;
      x = sum;
    }
    if (x != 0.0) terms_[kept++] = x;
    size_ = kept;
  }

  std::array<double, 12> terms_{};
  std::size_t size_ = 0;
};

int exact_orientation(const Vec& a, const Vec& b, const Vec& c) {
  Expansion determinant;
  determinant.add_product(a.x(), b.y());
  determinant.add_product(-a.y(), b.x());
  determinant.add_product(b.x(), c.y());
  determinant.add_product(-b.y(), c.x());
  determinant.add_product(c.x(), a.y());
  determinant.add_product(-c.y(), a.x());
  return determinant.sign_of_sum();
}

}  // namespace

int orientation(const Vec& a, const Vec& b, const Vec& c) {
  constexpr double kUnitRoundoff = 0x1p-53;
  constexpr double kErrorBound = (3.0 + 16.0 * kUnitRoundoff) * kUnitRoundoff;
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  if (std::abs(determinant) > kErrorBound * (std::abs(left) + std::abs(right))) return sign(determinant);
  return exact_orientation(a, b, c);
}

}  // namespace throng::narrowphase
