#include <cstdio>
#include <vector>

#include "broadphase/all_lists.h"
#include "broadphase/neighbours.h"

int main() {
  using namespace throng::broadphase;
  const std::vector<Point> crowd{{0, 0}, {3, 4}, {0, 1}, {9, 9}};  // m

  NeighbourLists lists;  // who is within 5 m of each
  AllLists().find(crowd, 5.0, nullptr, lists);
  for (std::size_t i = 0; i < lists.size(); ++i)
    for (std::size_t k = lists.begin[i]; k < lists.begin[i + 1]; ++k)
      std::printf("%zu sees %u at %g m\n", i, lists.row[k], lists.distance[k]);

  ProximityTree tree;  // the nearest one that somebody at (1, 1) sees who looks along x, a quarter turn wide
  tree.build(crowd);
  const FieldOfView quarter{0.70710678118654752, 0.70710678118654752};  // cosine and sine of half the turn
  std::vector<Neighbour> nearest;
  find_near(tree, {.at = {1, 1}, .heading = {1, 0}}, {.most = 1, .view = quarter}, nearest);
  for (const Neighbour& one : nearest) std::printf("%u, %g m away\n", one.row, one.distance);
}
