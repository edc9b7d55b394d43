// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/crowd/region.h"

/// What is counted while a crowd walks: who crosses a line, who is in an area.
namespace throng {

struct Measure {
  std::string name;
  std::array<Vec, 2> line{Vec(0.0, 0.0), Vec(0.0, 0.0)};  ///< m, from and to; of areas unused
  Region area;                                            ///< empty: a line
  double size = 0.0;                                      ///< m², the walkable part of the area
  double cutoff = 0.0;     ///< m, of Voronoi cells; 0: their density isn't measured
  Region ground;           ///< the walkable part of the area, where their density is
  std::int64_t after = 0;  ///< measured are the steps after this one
  std::int64_t last = std::numeric_limits<std::int64_t>::max();  ///< and up to this one

  bool is_on(std::int64_t step) const { return after < step && step <= last; }
};

/// Where its name stands in pictures.
inline Vec upper_left_end(const std::array<Vec, 2>& line) {
  return line[1].y() - line[1].x() > line[0].y() - line[0].x() ? line[1] : line[0];
}

/// What was measured so far; all of it zero before the first step.
struct Measured {
  std::int64_t count = 0;            ///< of a line crossings from its left to its right, of an area entries
  std::int64_t back = 0;             ///< of a line crossings from its right to its left
  std::int64_t first = 0, last = 0;  ///< steps of the first and the last of them
  std::int64_t steps = 0;            ///< that were measured
  std::int64_t samples = 0;          ///< of a line crossings, of an area agents in it, over all steps
  double speed = 0.0;                ///< m/s, the sum over the samples
  double voronoi = 0.0;              ///< 1/m², the sum over the steps of the density by Voronoi cells

  friend bool operator==(const Measured&, const Measured&) = default;
};

/// An agent's step.
struct Stride {
  Vec from, to;        ///< m
  double speed = 0.0;  ///< m/s
  std::uint32_t id = 0;
  double radius = 0.0;  ///< m
};

/// Who has crossed a line, or left an area, and isn't farther than his radius from it: so long he may sway.
struct OnLine {
  std::uint32_t line;  ///< row of Crowd::measures
  std::uint32_t id;
  std::int32_t uncounted;  ///< of his crossings, those from the line's left less those back; of areas 0

  friend bool operator==(const OnLine&, const OnLine&) = default;
};

/// +1 where the step goes over the line from the left of it, as seen by who looks from its first point to its
/// second, to the right, -1 where it goes back, else 0. On the line is to its right: who stops there and goes
/// on crosses it once.
int crossing(const std::array<Vec, 2>& line, const Vec& from, const Vec& to);

/// Those on one line, or beside one area, before a step, ascending by id, and after it, behind others.
struct OnLines {
  std::uint32_t line;
  std::vector<OnLine>&before, &after;
};

/// Adds a step of all agents, which ends at `step`. Who crosses a line counts at once; how he sways on it
/// then doesn't, but where he is on the wrong side of it, once he is farther off than his radius, he has
/// crossed it again. So far off an area he has left it; who steps over one has entered it, too. `before` is
/// used up. O(strides), little if far.
void measure(const Measure& measure, std::span<const Stride> strides, std::int64_t step, Measured& measured,
             const OnLines& on_lines);

/// Adds an agent who appears at `place` (m) at the end of `step`: in an area he has entered it.
void measure_entry(const Measure& measure, const Vec& place, std::int64_t step, Measured& measured);

/// What the measured says, in the words of the field. Nothing where too little was measured.
struct Reading {
  std::int64_t count;             ///< crossings both ways; entries
  std::optional<double> flow;     ///< 1/s: of crossings, from the first to the last; 1/(m s) in an area
  std::optional<double> density;  ///< 1/m², mean over time, of an area
  std::optional<double> speed;    ///< m/s, mean of those who cross, or of all in the area over time
  std::optional<double> density_voronoi;  ///< 1/m², mean over time, where it is measured
};

Reading reading(const Measure& measure, const Measured& measured, double dt);

/// The columns of a measure in a series over time. Of a line as `reading` has them: how many crossed it so
/// far, both ways, forward and back, their flow (1/s) and mean speed (m/s). Of an area how many entered it so
/// far, and density (1/m²), mean speed (m/s) and their product (1/(m s)) at the instant; where the density by
/// Voronoi cells is measured, that (1/m²) too.
std::span<const char* const> columns(const Measure& measure);

/// Who is there at the instant.
struct Instant {
  std::span<const Vec> position, velocity;  ///< m, m/s
  std::int64_t step;
  double dt;            ///< s
  const Region& floor;  ///< that they walk on
};

/// Appends a row of these columns: NaN where too little was measured, or the instant isn't measured.
/// O(agents) for an area, and as VoronoiDensity, which is made for it, where that is measured.
void append_columns(const Measure& measure, const Measured& measured, const Instant& instant,
                    std::vector<double>& row);

}  // namespace throng
