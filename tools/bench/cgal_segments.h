// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tools/bench/outlines.h"

namespace throng::bench {

/// CGAL's AABB tree over the edges of a polygon, at z = 0, with its kd-tree of hints.
class CgalSegments {
 public:
  explicit CgalSegments(const Ring& ring);
  ~CgalSegments();

  double distance(const Vec& point) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace throng::bench
