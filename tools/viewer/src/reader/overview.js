// SPDX-License-Identifier: MIT
// What a few frames say of the whole: where its bodies are, and how fast.
import { isFree } from "./scene.js";

const FRAMES = 8, BODIES = 20000;

/** @param {number} n @param {number} count @returns {number[]}  rows, evenly spread, with the first and the last */
export function spread(n, count) {
  const rows = Math.min(n, count);
  return Array.from({ length: rows }, (_, i) => rows === 1 ? 0 : Math.round(i * (n - 1) / (rows - 1)));
}

/** Two digits, rounded up: a top that reads well. @param {number} value */
export function niceTop(value) {
  if (!(value > 0)) return 0;
  const unit = 10 ** (Math.floor(Math.log10(value)) - 1);
  return Number((unit * Math.ceil(value / unit * (1 - 1e-12))).toPrecision(2));
}

/** The value that 99 % don't exceed; 0 of none. @param {number[]} values */
export function percentile99(values) {
  const sorted = Float64Array.from(values).sort();
  return sorted.length ? sorted[Math.floor((sorted.length - 1) * 0.99)] : 0;
}

/**
 * @typedef {{places: Float64Array, radii: Float64Array, topSpeed: number,
 *   starts: {heights: Float64Array, low: number, high: number}}} Overview  x, y, x, y of a sample of bodies over time,
 *   and their radii (m); the 99th percentile of speeds as they were last recorded, rounded up (m/s), 0 where velocities never were;
 *   the heights at which bodies were in the first frame, NaN of those that come later, and their 1st and 99th percentile (m)
 */

/** The heights of the first frame. @param {import("./recording.js").Recording} recording */
function startsOf(recording) {
  const { position } = recording.frame(0, ["position"]), { count } = recording.description.bodies;
  const heights = Float64Array.from({ length: count }, (_, row) => position ? position[2 * row + 1] : 0);
  const sorted = heights.filter(height => !Number.isNaN(height)).sort(), cut = Math.floor(sorted.length / 100);
  return { heights, low: sorted[cut] ?? 0, high: sorted[sorted.length - 1 - cut] ?? 0 };
}

/** @param {import("./recording.js").Recording} recording @returns {Overview} */
export function overview(recording) {
  const { bodies, times } = recording.description, places = [], radii = [], speeds = [];
  const rows = spread(bodies.count, BODIES);
  for (const i of spread(times.length, FRAMES)) {
    const { position, velocity } = recording.last(i, ["position", "velocity"]);
    for (const row of rows) {
      if (!position || Number.isNaN(position[2 * row])) continue;
      places.push(position[2 * row], position[2 * row + 1]);
      radii.push(bodies.radius[row]);
      if (velocity && !Number.isNaN(velocity[2 * row]) && isFree(bodies.kind[row])) speeds.push(Math.hypot(velocity[2 * row], velocity[2 * row + 1]));
    }
  }
  return { places: Float64Array.from(places), radii: Float64Array.from(radii), topSpeed: niceTop(percentile99(speeds)),
           starts: startsOf(recording) };
}
