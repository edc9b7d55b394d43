// SPDX-License-Identifier: MIT
// The curves of a run: which there are, and the axes they stand on.
import { measureOf } from "../reader/observed.js";
import { DYNAMIC } from "../reader/scene.js";
import { length, short, si } from "./format.js";

/**
 * @typedef {import("../reader/scan.js").Point} Point
 * @typedef {{name: string, colour: string, value: (point: Point) => number}} Curve
 * @typedef {{title: string, unit: (value: number) => string, decades?: boolean, curves: Curve[]}} Chart  decades: on a logarithmic axis
 */

/** @param {import("../reader/recording.js").Description} d @param {number} slow  m/s @param {number} lowest  J, of the potential energy @returns {Chart[]} */
export function charts(d, slow, lowest) {
  const joule = (/** @type {number} */ value) => si(value, "J"), number = (/** @type {number} */ value) => short(Math.round(value), 6);
  const changes = d.bodies.changes;  // then the height of all says more of who is here than of how high they are
  const pressing = (d.observed ?? []).indexOf("contacts"), moves = d.fields.includes("velocity"), spins = d.fields.includes("spin"), falls = !changes && d.gravity !== null && d.gravity.some(g => g !== 0);
  const kinetic = (/** @type {Point} */ p) => p.kinetic + (spins ? p.turning : 0), height = (/** @type {Point} */ p) => p.potential - lowest;
  /** @type {Curve[]} */
  const energies = [];
  if (falls && moves) energies.push({ name: "total", colour: "var(--ink)", value: p => kinetic(p) + height(p) });
  if (moves) energies.push({ name: spins ? "kinetic" : "kinetic, without spin", colour: "var(--curve-1)", value: kinetic });
  if (falls) energies.push({ name: "of height", colour: "var(--curve-2)", value: height });
  /** @type {Chart[]} */
  const all = [
    { title: changes ? "Energy of those here" : "Energy", unit: joule, curves: d.bodies.kind.includes(DYNAMIC) ? energies : [] },
    { title: "Overlap", unit: length, decades: true, curves: [{ name: "largest", colour: "var(--curve-2)", value: p => p.largest }, { name: "mean", colour: "var(--curve-1)", value: p => p.mean }] },
    { title: "Counts", unit: number, curves: [...(changes ? [{ name: "here", colour: "var(--ink)", value: (/** @type {Point} */ p) => p.present }] : []), { name: "pairs that touch", colour: "var(--curve-1)", value: p => p.contacts },
      ...(pressing >= 0 ? [{ name: "points that press", colour: "var(--stay)", value: (/** @type {Point} */ p) => p.observed[pressing] }] : []),
      ...(moves ? [{ name: `faster than ${short(slow, 2)} m/s`, colour: "var(--curve-2)", value: (/** @type {Point} */ p) => p.moving }] : [])] },
  ];
  return [...all, ...crowdCharts(d)].filter(chart => chart.curves.length > 0);
}

const COLOURS = ["var(--curve-1)", "var(--curve-2)", "var(--ink)"];

/** What the scenario measured of its crowd; each kind of column is a chart. @param {import("../reader/recording.js").Description} d @returns {Chart[]} */
function crowdCharts({ observed = [] }) {
  const of = (/** @type {string} */ title, /** @type {(value: number) => string} */ unit, /** @type {string} */ column, /** @type {string[]} */ more = []) => {
    const paths = [...more, ...observed.filter(path => path.startsWith("measure/") && path.endsWith(`/${column}`))].filter(path => observed.includes(path));
    return { title, unit, curves: paths.map((path, i) => ({ name: measureOf(path) ?? path, colour: COLOURS[i % COLOURS.length],
                                                            value: (/** @type {Point} */ p) => p.observed[observed.indexOf(path)] ?? NaN })) };
  };
  return [of("Counted", value => short(Math.round(value), 6), "count", ["arrived"]), of("Flow", value => `${short(value, 3)} /s`, "flow"),
          of("Density", value => `${short(value, 3)} /m²`, "density"),
          of("Density by Voronoi cells", value => `${short(value, 3)} /m²`, "density_voronoi"), of("Speed", value => si(value, "m/s"), "speed")];
}

/** Up to `most` + 1 round values from low to high. @param {number} low @param {number} high @param {number} [most] @returns {number[]} */
export function ticks(low, high, most = 3) {
  const range = high - low;
  if (!(range > 0) || !Number.isFinite(range)) return [];
  const power = 10 ** Math.floor(Math.log10(range / most)), step = power * ([1, 2, 5, 10].find(d => range / (d * power) <= most + 0.01) ?? 10), out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * range; ++k) out.push(Number((k * step).toPrecision(12)));
  return out;
}

/**
 * The axis of a chart: where a value stands, 0 at its foot to 1, and the values that have a line. One of decades starts at the
 * 5th percentile of what is above 0.
 * @param {Chart} chart @param {Point[]} points
 * @returns {{at: (value: number) => number, lines: number[]}}
 */
export function axis({ curves, decades }, points) {
  const values = Float64Array.from(curves.flatMap(({ value }) => points.map(value)).filter(v => v > 0)).sort(), top = values[values.length - 1] ?? 1;
  if (values.length === 0) return { at: () => 0, lines: [] };
  if (!decades) return { at: value => value / (1.06 * top), lines: ticks(0, 1.06 * top).filter(v => v > 0) };
  const low = Math.floor(Math.log10(values[Math.floor(values.length / 20)])), high = Math.max(low + 1, Math.log10(1.2 * top)), lines = [];
  const every = Math.max(1, Math.ceil((high - low) / 4));
  for (let k = low + every; k <= high; k += every) lines.push(Number((10 ** k).toPrecision(6)));
  return { at: value => Math.max(0, (Math.log10(Math.max(value, 1e-300)) - low) / (high - low)), lines };
}

/** Inserts points by time; a frame comes once. @param {Point[]} points @param {Point[]} more */
export function merge(points, more) {
  return [...points, ...more].sort((a, b) => a.frame - b.frame);
}

/** The point nearest in time that has a value. @param {Point[]} points @param {number} time @param {(point: Point) => number} value */
export function valueAt(points, time, value) {
  let best = NaN, least = Infinity;
  for (const point of points) {
    const away = Math.abs(point.time - time), v = value(point);
    if (away < least && Number.isFinite(v)) { least = away; best = v; }
  }
  return best;
}
