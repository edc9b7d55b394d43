// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sim/record.h"

// clang-format off
/// Where everything stands in a trajectory file: H5MD 1.1 (nongnu.org/h5md), throng's own data below /throng.
///
/// F frames, N recorded bodies; all types little-endian and of fixed size; texts of fixed length, UTF-8. Created
/// whole before the first frame with `libver=latest`, then only appended to, in SWMR mode: readers may follow a
/// run. Since 1.2 is marked with (1.2), and so on.
/// ```
/// /h5md                   attribute version int32[2] = {1, 1}; author and creator as H5MD wants them
/// /parameters             attributes dt, until, checkpoint (f64), substeps, every, threads (i64), seed (u64),
///                         engine, precision, version, compiler, flags; scenario_hash, resolved_hash and
///                         command_line_hash (u64, hash_bytes of the texts); bodies i64 of the run (1.2)
///   scenario, resolved    texts: the scenario as given, and with every override applied
///   command_line          text
/// /particles/trajectory
///   box                   attributes dimension = 2, boundary[2]; dataset edges f64[2] in a bounded domain
///   id                    i64[N], ascending; the row of a body is the same in every frame
///   position, velocity    groups with value f64[F,N,2] (f32 with record.precision = "single"), step, time; attribute
///                         every i64 (1.2)
///   angle, spin           the same with value [F,N]; only what the scenario records is there
/// /observables            (1.2) attribute every; kinetic_energy, potential_energy, contacts, max_overlap,
///                         mean_overlap with value f64[], momentum with value f64[,2]; each with step, time; of
///                         agents also (1.5) agents, arrived and measure/NAME/C, NAME as `path_part` of observables.h
///                         and C as `columns` of crowd/measure.h have them, NaN where too little was measured; of
///                         bodies also (1.7) what the scenario asks for, as `known_columns` of
///                         measure/measured_bodies.h, NaN where it isn't known: histograms, value f64[,B], have an
///                         attribute up_to f64, where the last of their equal bins ends, the first at 0
/// /throng                 attributes version int32[2] = {kMajor, kMinor}, name, description
///   finished              u64: 0 while the run goes on, then chain_hash of frames/frame_hash
///   frames                step i64[F], time f64[F] = step * dt, state_hash u64[F], frame_hash u64[F]
///   rates/R               (1.2) step and time of the frames whose step is a multiple of R, where not all are. Every
///                         other `step` and `time`, but those of `id`, is a hard link to these or to those of `frames`
///   quantized             (1.2) with record.quantize, instead of the positions of H5MD: position u32[F,N,2] through
///                         shuffle and deflate, step, time; attributes every, quantum f64 (m), key_every i64, how;
///                         of bodies that come and go, too (1.4): each keeps its row, with 0 while it is away
///   contacts              (1.2) attribute every; a u32, b u32, impulse f64 (of rigid bodies since 1.11 that of all
///                         substeps and of what struck in them), point f64[,2], rows as ContactRow has
///                         them; those of sample s are offset[s] to offset[s + 1], u64; step, time
///   sensors/K             (1.5) the K-th recorded sensor, from 0: attributes name, every, radius f64 (m),
///                         fov_degrees f64, sight (none, walls, bodies); who u32, count u32: ids, ascending, of those
///                         who have it, and how many each senses, those of sample s from offset[s] to offset[s + 1],
///                         u64; whom u32: whom they sense, one after the other, from whom_offset[s] on; step, time
///   measures              (1.5) of agents, where any are: name, line f64[M,4] (x, y from, x, y to), size f64 (m²);
///                         area_offset u64[M+1] -> offset u64[rings+1] -> points f64[,2]; no rings: a line; cutoff
///                         f64[M] (1.9), m, of its Voronoi cells, 0: not measured
///   arrivals              (1.10) where there are agents, of a run that has ended: id u32[], step i64[]: all who got to
///                         their goals and left, recorded or not, and when, by step and then by id; written once,
///                         with fletcher32, and covered by no hash
///   domain                attributes kind, min f64[2], max f64[2]
///   materials             name, density, restitution, friction
///   shapes                name, kind u8 (0 disc, 1 polygon, 2 composite), centre, area, gyration2, radius;
///                         outline_offset u64[S+1] -> outline f64[,2]; part_offset u64[S+1] -> part_radius
///                         f64, vertex_offset u64[parts+1] -> vertices f64[,2]; since 1.1 hole_offset
///                         u64[S+1] -> ring_offset u64[holes+1] -> rings f64[,2]
///   bodies                a row for each recorded body: shape u32, material u32, kind u8 (0 dynamic, 1 static,
///                         2 kinematic, 3 agent (1.3)), radius, mass; id i64[N] where frames hold some of them only (1.2)
///   walls                 offset u64[W+1] -> points f64[,2]; closed u8, material u32
///   walkable              (1.3) where there are agents: offset u64[R+1] -> points f64[,2], the rings of the floor
///   areas                 (1.6) where the scenario has any: name, use u8 (0 none, 1 agents go there, 2 they wait there);
///                         area_offset u64[A+1] -> offset u64[rings+1] -> points f64[,2]
///   queues                (1.6) likewise: name, spacing f64 (m), service f64 (s); offset u64[Q+1] -> points f64[,2]
/// ```
/// What has an attribute `every` is in the frames whose step is a multiple of it, and has a row for each of these:
/// their number is its F. Where bodies come and go, with record.within (1.2) and among agents (1.3), `id` is a group,
/// too, with value u32[,N]: a frame's bodies stand in front, ascending by id, and 0, the fill value, in the other
/// places; fields have the same order, and chunks of which nothing is written are not there. It has a row for each
/// frame that holds a field of bodies or contacts, and rows of its own, step i64[] and time f64[], that list these
/// frames. With record.within it has attributes min and max f64[2], the region.
///
/// `state_hash` is throng::hash of the whole state, so that a run can be checked against another (before 1.1 it
/// was another function, and there was no attribute `checkpoint`). `frame_hash`
/// covers step, time, state_hash and exactly what the frame stores: ids where they change, the numbers of each
/// field (whole multiples of the quantum, i32, where they are quantized), a, b, impulse, point of the contacts, who,
/// count, whom of each sensor, the observables; 0 never occurs. It is the commit
/// record: a frame counts once its row stands there, whatever the extents of the other datasets say. Values of
/// bodies carry fletcher32, and no chunk of theirs is of two frames (at most kMaxChunk bytes, or kRegionChunk bodies
/// where these come and go). Rows that grow a little at a time (`frames`, `rates`, contacts, sensors, observables, step
/// and time of `id`) carry none: their last chunk is rewritten as it fills, and a reader or a crash in between would see
/// a wrong checksum; `frame_hash` and `finished` cover them.
// clang-format on
namespace throng::recording {

inline constexpr int kMajor = 1;  ///< a reader refuses a newer one
/// A reader takes any. Since 1 polygons may have holes, which readers of 1.0 overlook, there is an attribute
/// `checkpoint`, and `state_hash` is another function: to a throng of 1.0 such states differ from those that
/// it computes. Since 2 fields have rates, and there are quantized positions, contacts, observables and
/// regions: readers of 1.1 take frames that have them for damaged. Since 3 there are agents. The first
/// regions of 2 had a row of `id` for every frame, even without bodies, its step and time links to those of
/// `frames`; the last ones have what 3 has. Readers find rows of `id` by its step, and so take both. Since 4
/// positions of bodies that come and go may be quantized: readers of 3 refuse these.
/// Since 5 there are sensors, and of a crowd its measures, which readers of 4 overlook: to them such frames
/// are damaged. What wrote 5 before it was settled kept the "%41" in a measure's name as it stands: damaged,
/// too. Since 6 areas and queues are there, which readers of 5 overlook. Since
/// 7 there is what scenarios ask to be observed: to readers of 6 such frames are damaged.
/// Since 8 the mass of an agent is its model's, where that has one: before, all had 80 kg.
/// Since 9 the density by Voronoi cells is there, where a measure has it: to readers of 8 such frames are
/// damaged. Since 10 there is who arrived when. Since 11 contacts of rigid bodies (engine
/// native) tell what pressed in the whole step: before, what pressed at its end, as much in each substep as
/// in the last.
inline constexpr int kMinor = 11;

inline constexpr std::size_t kMaxChunk = std::size_t{1} << 20;  ///< bytes
inline constexpr std::size_t kRegionChunk = 256;                ///< bodies, where frames hold few of them
inline constexpr std::size_t kRowChunk = 512;                   ///< rows: one page of 8-byte numbers
inline constexpr std::size_t kContactChunk = 16384;     ///< rows of contacts and of what was sensed, at most
inline constexpr std::int64_t kRarest = 1'000'000'000;  ///< steps from one sample to the next

/// Rows of contacts, of a scene of so many bodies: few of a few, so that their file stays small.
constexpr std::size_t contact_chunk(std::size_t bodies) {
  return std::clamp(std::bit_ceil(32 * bodies), kRowChunk, kContactChunk);
}

/// What may be recorded of a body, in the order in which frame_hash covers it.
inline constexpr auto kBodyFields = std::span(kRecordFields).first<4>();

/// Does `work` with a body's field of a Frame or a State, a vector of Vec or double.
template <class Of, class Work>
decltype(auto) with_field(Of& of, RecordField field, Work work) {
  switch (field) {
    case RecordField::position:
      return work(of.position);
    case RecordField::angle:
      return work(of.angle);
    case RecordField::velocity:
      return work(of.velocity);
    default:
      return work(of.spin);
  }
}

/// Numbers a body.
inline constexpr std::size_t components(RecordField field) {
  return field == RecordField::position || field == RecordField::velocity ? 2 : 1;
}

inline bool is_quantized(const Record& record, RecordField field) {
  return field == RecordField::position && record.quantum > 0.0;
}

/// What the file says of its quantized positions.
inline constexpr const char* kHowQuantized =
    "v = position[k] of sample k, d = (v >> 1) ^ -(v & 1) modulo 2^32; n[k] = d where k is a multiple of "
    "key_every, "
    "n[k - 1] + d in the sample after that, else 2 n[k - 1] - n[k - 2] + d, as int32; metres are n * "
    "quantum. "
    "throng_read.py reads them.";

}  // namespace throng::recording
