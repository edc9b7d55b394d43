// SPDX-License-Identifier: MIT
// What the page shows at first: as tools/framing.cpp, so that a picture and a page of one recording show the same.
import { AGENT } from "../reader/scene.js";

const SPREAD = 0.6;  // of the domain, in both directions: then show all of it

/** From the 1st to the 99th percentile of every second value, widened by its own size on both sides. @param {Float64Array} places @param {number} axis @param {number} radius */
function crowd(places, axis, radius) {
  const values = places.filter((_, i) => i % 2 === axis).sort(), cut = Math.floor(values.length / 100);
  const low = values[cut], high = values[values.length - 1 - cut], margin = high - low + 2 * radius;
  return [low - margin, high + margin];
}

/** The bodies that belong to the crowd, and the walls' points that lie where it does. @param {import("../reader/scene.js").Scene} scene @param {{places: Float64Array, radii: Float64Array}} overview */
function tight(scene, { places, radii }) {
  const largest = radii.reduce((a, b) => Math.max(a, b), 0), [x, y] = [crowd(places, 0, largest), crowd(places, 1, largest)];
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const include = (/** @type {number} */ px, /** @type {number} */ py, /** @type {number} */ r) => {
    if (!(px >= x[0] && px <= x[1] && py >= y[0] && py <= y[1])) return;
    box[0] = Math.min(box[0], px - r); box[1] = Math.min(box[1], py - r); box[2] = Math.max(box[2], px + r); box[3] = Math.max(box[3], py + r);
  };
  for (let i = 0; i < radii.length; ++i) include(places[2 * i], places[2 * i + 1], radii[i]);
  for (const { points } of scene.walls) for (let i = 0; i < points.length; i += 2) include(points[i], points[i + 1], 0);
  return box;
}

/** Room to breathe, and no empty extent. @param {number[]} box */
function withMargin(box) {
  const longer = Math.max(box[2] - box[0], box[3] - box[1], 1e-9 * (1 + Math.max(...box.map(Math.abs))));
  const lack = [0, 1].map(axis => Math.max(0, 0.15 * longer - (box[axis + 2] - box[axis])) / 2 + 0.02 * longer);
  return [box[0] - lack[0], box[1] - lack[1], box[2] + lack[0], box[3] + lack[1]];
}

/** The floor that agents walk on, and all walls. @param {import("../reader/scene.js").Scene} scene */
function ofFloor({ walkable, walls }) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const points of [...walkable, ...walls.map(wall => wall.points)])
    for (let i = 0; i < points.length; ++i) { box[i % 2] = Math.min(box[i % 2], points[i]); box[2 + i % 2] = Math.max(box[2 + i % 2], points[i]); }
  return box[0] <= box[2] ? box : [0, 0, 1, 1];
}

/**
 * left, bottom, right, top (m): of agents all of their floor; else all of a bounded domain where bodies are spread over it, else the bodies and the walls near them;
 * a few bodies far from all others don't count. Never empty.
 * @param {import("../reader/scene.js").Scene} scene @param {{places: Float64Array, radii: Float64Array}} overview
 */
export function framing(scene, overview) {
  const { kind, min, max } = scene.domain, bounded = kind !== "unbounded", domain = [...min, ...max];
  if (overview.radii.length === 0) return withMargin(bounded ? domain : ofFloor(scene));
  if (scene.bodies.kind.includes(AGENT)) return withMargin(ofFloor(scene));
  const box = tight(scene, overview);
  if (!bounded) return withMargin(box);
  const wide = [0, 1].map(axis => box[axis + 2] - box[axis] >= SPREAD * (max[axis] - min[axis]));
  const meets = [0, 1].every(axis => box[axis] < max[axis] && box[axis + 2] > min[axis]);
  if (kind === "periodic" || !meets || (wide[0] && wide[1])) return withMargin(domain);
  return withMargin(box.map((value, i) => wide[i % 2] ? domain[i] : i < 2 ? Math.max(value, min[i]) : Math.min(value, max[i - 2])));
}
