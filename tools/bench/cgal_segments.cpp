// SPDX-License-Identifier: MIT
#include "tools/bench/cgal_segments.h"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

namespace throng::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Segments = std::vector<Kernel::Segment_3>;
using Primitive = CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>;

Segments segments(const Ring& ring) {
  Segments result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec &p = ring[i], &q = ring[(i + 1) % ring.size()];
    result.emplace_back(Kernel::Point_3(p.x(), p.y(), 0.0), Kernel::Point_3(q.x(), q.y(), 0.0));
  }
  return result;
}

}  // namespace

struct CgalSegments::Tree {
  Segments edges;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree;

  explicit Tree(const Ring& ring) : edges(segments(ring)), tree(edges.cbegin(), edges.cend()) {
    tree.build();
    tree.accelerate_distance_queries();
  }
};

CgalSegments::CgalSegments(const Ring& ring) : tree_(std::make_unique<Tree>(ring)) {}
CgalSegments::~CgalSegments() = default;

double CgalSegments::distance(const Vec& point) const {
  return std::sqrt(tree_->tree.squared_distance(Kernel::Point_3(point.x(), point.y(), 0.0)));
}

}  // namespace throng::bench
