// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tools/bench/options.h"
#include "tools/bench/rows.h"

namespace throng::bench {

/// Scenes of bodies step by step: native, Box2D, Chipmunk, and for discs the minimal loop of minimal_discs.h.
std::vector<Row> bench_step(const Options& options);

/// Settled beds of discs on springs and dashpots, beside LAMMPS; `error` has the time of a disc and substep.
std::vector<Row> bench_soft(const Options& options);

/// One scene with features added one at a time: what each of them costs.
std::vector<Row> bench_lean(const Options& options);

/// How far apart convex polygons are, moving and not: throng's engines, Box2D's and CGAL's. Times are for a
/// million queries; errors in ulp of the coordinates' scale, against long double.
std::vector<Row> bench_narrowphase(const Options& options);

/// The case of bench_narrowphase that is about discs.
std::vector<Row> bench_disc_gaps(const Options& options);

/// What recording each step costs, and how fast a million bodies get to the disk and back.
std::vector<Row> bench_recording(const Options& options);

/// All pairs of clouds: throng, a plain grid, nanoflann and Box2D's tree.
std::vector<Row> bench_broadphase(const Options& options);

/// The cases of bench_broadphase whose boxes move: throng, Box2D's tree, and where they are few each with
/// each.
std::vector<Row> bench_broadphase_boxes(const Options& options);

/// The cases of bench_broadphase that ask who is near every point: throng, nanoflann, Box2D's tree, and all
/// pairs at once.
std::vector<Row> bench_broadphase_queries(const Options& options);

/// Hierarchies over large polygons: what their volumes are worth, building, points, collisions, distances.
std::vector<Row> bench_bvh(const Options& options);

/// Do moving solids meet, and when first: bisection, advancement, sampling, Box2D; against 50 digits.
std::vector<Row> bench_motion(const Options& options);

/// Each model of walking, and each preset, against the cases of validation_cases.h: pass or fail with its
/// number.
std::vector<Row> bench_validation(const Options& options);

/// Their table from row `begin` on, on stdout: a paragraph per case.
void print_verdicts(const std::vector<Row>& rows, std::size_t begin);

/// Scenes with exact solutions, each engine at several settings: time per simulated second against error.
std::vector<Row> bench_accuracy(const Options& options);

/// Their table from row `begin` on, on stdout: a paragraph per scene.
void print_accuracy(const std::vector<Row>& rows, std::size_t begin);

/// What stands below it: the observed orders.
void print_orders(const std::vector<Row>& rows);

/// What beside dt and substeps may be chosen: width of vectors, threads, sleep; times, and that bits agree.
std::vector<Row> bench_knobs(const Options& options);

/// A stack, a pile and a gas under stress: stable, drifting or exploded, in `error`.
std::vector<Row> bench_stability(const Options& options);

/// Their table from row `begin` on, on stdout: a paragraph per factor or two.
void print_stability(const std::vector<Row>& rows, std::size_t begin);

/// What stands below it: how many are stable.
void print_stable(const std::vector<Row>& rows);

/// Steps of crowds of each model, beside two threads and their plain twins: scalar, neighbours from
/// nanoflann.
std::vector<Row> bench_crowd(const Options& options);

/// The case of bench_crowd that is about finding the way: a floor plan and a distance field of a million
/// nodes.
std::vector<Row> bench_ways(const Options& options);

/// The case of bench_crowd that is the stadium of the gallery: its steps, and what of them each stage takes.
std::vector<Row> bench_stadium(const Options& options);

}  // namespace throng::bench
