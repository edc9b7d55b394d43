// SPDX-License-Identifier: MIT
#include "tools/bench/bvh_rows.h"

#include "narrowphase/bvh_outline.h"
#include "narrowphase/relative.h"
#include "tools/bench/interleave.h"
#include "tools/bench/outlines.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

constexpr std::size_t kVolumePairs = 4096;

double area(const Ball<2>& volume) {
  return std::numbers::pi * volume.radius * volume.radius;
}
template <class Boxes>
double area(const Boxes& volume) {
  return 4.0 * volume.half.x() * volume.half.y();
}

double area(const Points<2>& hull) {
  double twice = 0.0;
  for (std::size_t i = 2; i < hull.size(); ++i)
    twice += narrowphase::cross(hull[i - 1] - hull[0], hull[i] - hull[0]);
  return 0.5 * twice;
}

/// Of all nodes with some area inside, eight edges or more, the mean.
struct Quality {
  double area_over_hull = 0.0;  ///< the volume's over that of the hull of what it holds: 1 is tight
  double change = 0.0;  ///< by how much of itself the area changes when the shape turns: 0 is invariant
};

template <class Volume>
double fitted_area(Points<2> points) {
  reduce_to_hull<2>(points);
  Volume volume;
  enclose(points, volume);
  return area(volume);
}

template <class Volume>
Quality quality(const Outline<Volume>& shape) {
  const auto& nodes = shape.tree.nodes;
  std::vector<Points<2>> points(nodes.size());
  Quality sum;
  double count = 0.0;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const Branch branch = nodes[i].branch;
    for (std::size_t k = branch.first; k < branch.first + branch.count; ++k)
      points[i].insert(points[i].end(), {Vec(shape.edges[k].p), Vec(shape.edges[k].q)});
    if (branch.count == 0)
      for (const std::size_t child : {branch.first, branch.first + 1})
        points[i].insert(points[i].end(), points[child].begin(), points[child].end());
    reduce_to_hull<2>(points[i]);
    if (branch.count > 0 || area(points[i]) <= 0.0) continue;
    const double fitted = fitted_area<Volume>(points[i]);
    sum.area_over_hull += fitted / area(points[i]);
    sum.change += std::abs(fitted_area<Volume>(turned(points[i], 0.3)) / fitted - 1.0);
    ++count;
  }
  return {sum.area_over_hull / count, sum.change / count};
}

/// Pairs of nodes whose volumes are about as far apart as they are large: half of them meet.
template <class Volume>
struct Tests {
  Outline<Volume> shape;
  std::vector<narrowphase::Frame<2>> frames;
  std::vector<std::uint32_t> nodes;

  explicit Tests(const std::vector<Ring>& rings) : shape(outline<Volume>(rings)) {
    for (std::uint64_t i = 0; i < kVolumePairs; ++i) {
      const double place = 0.5 * (noise(5, i) + 1.0) * static_cast<double>(shape.tree.nodes.size());
      nodes.push_back(static_cast<std::uint32_t>(place));
      const Volume& volume = shape.tree.nodes[nodes.back()].volume;
      const Pose turn = pose({0.0, 0.0}, 3.0 * noise(6, i));
      const Vec off = 2.0 * radius(volume) * Vec(noise(7, i), noise(8, i));
      const Vec centre = volume.centre;
      frames.push_back(frame(Pose{centre - turn.rotate(centre) + off, turn.cos, turn.sin}, 4.0));
    }
  }
  double parted() const {
    double count = 0.0;
    for (std::size_t i = 0; i < kVolumePairs; ++i) {
      const Volume& volume = shape.tree.nodes[nodes[i]].volume;
      count += apart(volume, volume, frames[i]);
    }
    return count;
  }
  double bounded() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kVolumePairs; ++i) {
      const Volume& volume = shape.tree.nodes[nodes[i]].volume;
      sum += bound(volume, volume, frames[i]);
    }
    return sum;
  }
};

template <class Volume>
void add_rows(const std::string& family, const std::string& engine, const Ring& ring, const Options& options,
              std::vector<Row>& rows) {
  const Tests<Volume> tests({ring});
  double sink = 0.0;
  std::vector<Contestant> contestants{{"apart", [&] { sink += tests.parted(); }},
                                      {"bound", [&] { sink += tests.bounded(); }}};
  interleave(contestants, options.blocks, kVolumePairs);
  for (Contestant& one : contestants)
    for (double& ms : one.ms) ms *= 1e6;  // a million tests
  const Quality measured = quality(tests.shape);
  rows.push_back({"bvh",
                  "volume " + family + " n=" + std::to_string(ring.size()),
                  engine,
                  1,
                  contestants[0].ms,
                  1e6,
                  std::isfinite(sink) ? "finite" : "not finite",
                  {{"area_over_hull", measured.area_over_hull},
                   {"change_by_turn", measured.change},
                   {"bound_ms", median(contestants[1].ms)},
                   {"parted", tests.parted() / kVolumePairs},
                   {"bytes", static_cast<double>(sizeof(Volume))}}});
}

}  // namespace

std::vector<Row> bvh_volume_rows(const Options& options) {
  std::vector<Row> rows;
  const std::size_t n = options.quick ? 256 : 16384;
  const std::pair<const char*, Ring> shapes[] = {
      {"star", around(star_radii(n))}, {"gear", around(gear_radii(n))}, {"coast", around(coast_radii(n, 1))}};
  for (const auto& [family, ring] : shapes) {
    if (!chosen(std::string("volume ") + family, options)) continue;
    add_rows<Ball<2>>(family, "disc", ring, options, rows);
    add_rows<Box<2>>(family, "aabb", ring, options, rows);
    add_rows<OrientedBox<2>>(family, "obb", ring, options, rows);
    add_rows<BoxAndBall<2>>(family, "mixed", ring, options, rows);
  }
  return rows;
}

}  // namespace throng::bench
