// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/bvh_edges.h"
#include "narrowphase/bvh_outline.h"

/// What lies inside an outline: a point, another one, the deepest vertex of another. For the sources of
/// outlines alone.
namespace throng::narrowphase {

/// Whether a point lies in a solid that stands at `pose`: the even-odd rule over the edges that a ray passes.
template <class Volume>
bool holds(const Outline<Volume>& shape, const Pose& pose, const Frame<2>& frame, const Vec& point) {
  bool inside = false;
  TraversalStack<std::uint32_t> stack;
  stack.push(0);
  while (!stack.empty()) {
    const auto& node = shape.tree.nodes[stack.pop()];
    const Box<2> box = bounds(node.volume, frame);
    if (std::abs(point.y() - box.centre.y()) > box.half.y() || point.x() > box.centre.x() + box.half.x())
      continue;
    if (node.branch.count == 0) {
      stack.push(node.branch.first + 1);
      stack.push(node.branch.first);
      continue;
    }
    for (std::uint32_t i = node.branch.first; i < node.branch.first + node.branch.count; ++i)
      inside ^= ray_passes(point, pose * shape.edges[i].p, pose * shape.edges[i].q);
  }
  return inside;
}

template <class Volume>
Frame<2> at_rest(const Outline<Volume>& shape) {
  return frame(Pose{}, shape.tree.reach);
}

/// Two outlines in the frame of the first.
template <class Volume>
struct PlacedOutlines {
  const Outline<Volume>& a;
  const Outline<Volume>& b;
  const Pose b_in_a;
  const Frame<2> frame;
};

/// Of two solids whose outlines don't meet.
template <class Volume>
bool one_holds_the_other(const PlacedOutlines<Volume>& p) {
  if (apart(p.a.tree.root(), p.b.tree.root(), p.frame)) return false;
  return holds(p.a, Pose{}, at_rest(p.a), p.b_in_a * p.b.start) || holds(p.b, p.b_in_a, p.frame, p.a.start);
}

/// A vertex in the other solid, its nearest place on that one's outline, as places of edges.
struct Deepest {
  double depth = 0.0;
  std::uint32_t vertex = 0, edge = 0;
  Vec at{0.0, 0.0}, on_outline{0.0, 0.0};  ///< in the frame of the solid that holds the vertex
  bool found = false;
};

/// The vertex of `shape` deepest in `solid`. A volume is as deep as its centre and its radius, at most.
template <class Volume>
Deepest deepest_vertex(const Outline<Volume>& solid, const Outline<Volume>& shape, const Pose& shape_in_solid,
                       double slack) {
  struct Bounded {
    double depth;
    std::uint32_t node;
  };
  Deepest best;
  const Frame<2> rest = at_rest(solid);
  const auto depth_of = [&](const Vec& x, OutlineCache& cache) {
    const double distance = nearest(solid, x, &cache).distance;
    return holds(solid, Pose{}, rest, x) ? distance : -distance;
  };
  OutlineCache cache;
  const auto bounded = [&](std::uint32_t node) {
    const Volume& volume = shape.tree.nodes[node].volume;
    return Bounded{depth_of(shape_in_solid * Vec(volume.centre), cache) + radius(volume) + slack, node};
  };
  TraversalStack<Bounded> stack;
  stack.push(bounded(0));
  while (!stack.empty()) {
    const Bounded top = stack.pop();
    if (top.depth <= best.depth) continue;
    const Branch branch = shape.tree.nodes[top.node].branch;
    if (branch.count == 0) {
      const Bounded first = bounded(branch.first), second = bounded(branch.first + 1);
      stack.push(first.depth >= second.depth ? second : first);
      stack.push(first.depth >= second.depth ? first : second);
      continue;
    }
    for (std::uint32_t i = branch.first; i < branch.first + branch.count; ++i) {
      const Vec x = shape_in_solid * shape.edges[i].p;
      if (const double depth = depth_of(x, cache); depth > best.depth)
        best = {depth, i, cache.a, x, nearest(solid, x, &cache).point, true};
    }
  }
  return best;
}

}  // namespace throng::narrowphase
