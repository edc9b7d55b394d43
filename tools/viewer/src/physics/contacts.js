// SPDX-License-Identifier: MIT
// Which bodies of a frame touch, and how deep they are in one another.
import { eachMeeting } from "./grid.js";
import { AGENT, isFree } from "../reader/scene.js";
import { separation } from "./separation.js";

/**
 * @typedef {{pairs: Int32Array, depths: Float64Array, deepest: Float32Array, overlapping: number, largest: number, mean: number}} Contacts
 *   pairs: rows a, b of each pair of convex parts that touch or overlap, b = -1 for a wall or a side of the domain; depths: m of
 *   each pair, 0 at least; deepest: m of each body; overlapping, largest, mean: over the pairs that overlap (m)
 * @typedef {{body: Int32Array, points: Float64Array[], radius: Float64Array}} Colliders  a row a convex part, about its body's centre
 */

const POINT = new Float64Array(2);

/** The convex parts of all bodies. @param {import("../reader/scene.js").Scene} scene @returns {Colliders} */
export function colliders({ bodies, shapes }) {
  const body = [], points = [], radius = [];
  for (let row = 0; row < bodies.count; ++row) {
    const { kind, parts } = shapes[bodies.shape[row]];
    for (const part of kind === 0 ? [{ points: POINT, radius: bodies.radius[row] }] : parts) {
      body.push(row);
      points.push(part.points);
      radius.push(part.radius);
    }
  }
  return { body: Int32Array.from(body), points, radius: Float64Array.from(radius) };
}

/** Segments ax, ay, bx, by of all walls. @param {import("../reader/scene.js").Wall[]} walls */
function wallSegments(walls) {
  const segments = [];
  for (const { points, closed } of walls)
    for (let i = closed ? 0 : 2; i < points.length; i += 2) {
      const before = i === 0 ? points.length - 2 : i - 2;
      segments.push(Float64Array.of(points[before], points[before + 1], points[i], points[i + 1]));
    }
  return segments;
}

/**
 * Of the segments of a crowd's walls: those that meet at an end, by its coordinates, in the order in which the program lets one of
 * them tell of it. @param {Float64Array[]} segments @returns {Map<string, { rank: number, far: number[], row: number }[]>}
 */
function meetings(segments) {
  /** @type {Map<string, { rank: number, far: number[], row: number }[]>} */
  const ends = new Map();
  segments.forEach(([ax, ay, bx, by], row) => {
    const here = { rank: row, far: [bx, by], row }, there = { rank: segments.length + row, far: [ax, ay], row };
    ends.set(`${ax},${ay}`, [...(ends.get(`${ax},${ay}`) ?? []), here]);
    ends.set(`${bx},${by}`, [...(ends.get(`${bx},${by}`) ?? []), there]);
  });
  return ends;
}

/** The sides of a box, which hold agents as walls do. @param {import("../reader/scene.js").Domain} domain */
const sidesOf = ({ kind, min, max }) =>
  kind === "box" ? [{ points: Float64Array.of(min[0], min[1], max[0], min[1], max[0], max[1], min[0], max[1]), closed: true }] : [];

/** Each once, whichever way round. @param {Float64Array[]} segments */
function once(segments) {
  const known = new Set();
  return segments.filter(([ax, ay, bx, by]) => {
    const key = ax < bx || (ax === bx && ay < by) ? `${ax},${ay},${bx},${by}` : `${bx},${by},${ax},${ay}`;
    return !known.has(key) && known.add(key);
  });
}

/**
 * Whether a frame says which of its bodies touch: all are discs, or it says how they are turned, not only an earlier one.
 * @param {import("../reader/recording.js").Description} description @param {number} frame
 */
export function tellsContacts({ bodies, shapes, rates, steps }, frame) {
  const angles = rates.angle !== undefined && steps[frame] % rates.angle === 0;
  return angles || bodies.shape.every(shape => shapes[shape].kind === 0);
}

/** Finds contacts of the frames of one scene; memory is used again from frame to frame. */
export class ContactFinder {
  /** @param {import("../reader/scene.js").Scene} scene */
  constructor(scene) {
    this.scene = scene;
    this.parts = colliders(scene);
    const crowd = scene.bodies.kind.includes(AGENT), walls = wallSegments(crowd ? [...scene.walls, ...sidesOf(scene.domain)] : scene.walls);
    this.walls = crowd ? once(walls) : walls;
    this.ends = crowd ? meetings(this.walls) : undefined;
    this.world = this.parts.points.map(points => new Float64Array(points.length));
    this.here = new Int32Array(this.world.length);  // the parts of the bodies that are there: `present` of them
    this.present = 0;
    this.boxes = new Float64Array(4 * (this.world.length + this.walls.length));  // in the order of `here`, then the walls'
  }

  /**
   * Expects the positions, and the angles of the same time where tellsContacts() wants them. Who is not there (NaN) touches nobody. O(bodies).
   * @param {import("../reader/recording.js").Frame} frame
   * @returns {Contacts}
   */
  find(frame) {
    this.#place(frame);
    const { body } = this.parts, { kind } = this.scene.bodies, { here } = this, parts = this.present, { periodic, width, height } = this.#domain();
    this.found = { pairs: /** @type {number[]} */ ([]), depths: /** @type {number[]} */ ([]), deepest: new Float32Array(this.scene.bodies.count), overlapping: 0, largest: 0, sum: 0 };
    const meet = (/** @type {number} */ i, /** @type {number} */ j) => {
      const a = here[i], b = here[j];
      if (j >= parts) this.#wall(a, j - parts);
      else if (body[a] !== body[b] && (isFree(kind[body[a]]) || isFree(kind[body[b]]))) this.#pair(a, b);
    };
    eachMeeting(this.boxes.subarray(0, 4 * (parts + this.walls.length)), parts, meet);
    if (periodic) this.#acrossBorders(width, height);
    if (this.scene.domain.kind === "box" && !this.ends) for (let i = 0; i < parts; ++i) this.#sides(here[i]);
    const { pairs, depths, deepest, overlapping, largest, sum } = this.found;
    return { pairs: Int32Array.from(pairs), depths: Float64Array.from(depths), deepest, overlapping, largest, mean: overlapping ? sum / overlapping : 0 };
  }

  #domain() {
    const { kind, min, max } = this.scene.domain;
    return { periodic: kind === "periodic", width: max[0] - min[0], height: max[1] - min[1] };
  }

  /** Every part of those that are there in the world, and its box; then the walls'. @param {import("../reader/recording.js").Frame} frame */
  #place({ position, angle }) {
    this.present = 0;
    if (!position) return;
    const { body, points, radius } = this.parts, { periodic, width, height } = this.#domain(), { min } = this.scene.domain;
    for (let part = 0; part < points.length; ++part) {
      const row = body[part], local = points[part], world = this.world[part];
      const turn = angle?.[row] || 0, c = Math.cos(turn), s = Math.sin(turn);  // 0 where it is not known
      let x = position[2 * row], y = position[2 * row + 1];
      if (x !== x) continue;  // NaN: not there
      if (periodic) {
        x -= width * Math.floor((x - min[0]) / width);
        y -= height * Math.floor((y - min[1]) / height);
      }
      let left = Infinity, bottom = Infinity, right = -Infinity, top = -Infinity;
      for (let k = 0; k < local.length; k += 2) {
        const px = world[k] = x + c * local[k] - s * local[k + 1], py = world[k + 1] = y + s * local[k] + c * local[k + 1];
        left = Math.min(left, px); right = Math.max(right, px); bottom = Math.min(bottom, py); top = Math.max(top, py);
      }
      const r = radius[part];
      this.#box(this.present, left - r, bottom - r, right + r, top + r);
      this.here[this.present++] = part;
    }
    this.walls.forEach(([ax, ay, bx, by], i) => this.#box(this.present + i, Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by)));
  }

  /** @param {number} i @param {number} left @param {number} bottom @param {number} right @param {number} top */
  #box(i, left, bottom, right, top) {
    this.boxes[4 * i] = left; this.boxes[4 * i + 1] = bottom; this.boxes[4 * i + 2] = right; this.boxes[4 * i + 3] = top;
  }

  /** @param {number} a @param {number} b @param {Float64Array} [points]  of b, where it is seen elsewhere */
  #pair(a, b, points = this.world[b]) {
    const { body, radius } = this.parts;
    const A = this.world[a];
    const gap = A.length === 2 && points.length === 2 ? Math.hypot(A[0] - points[0], A[1] - points[1]) - radius[a] - radius[b]
                                                      : separation(A, radius[a], points, radius[b]);
    this.#count(body[a], body[b], gap);
  }

  /** @param {number} a @param {number} wall */
  #wall(a, wall) {
    const row = this.parts.body[a];
    if (!isFree(this.scene.bodies.kind[row])) return;
    if (this.ends && !this.#isNearest(this.world[a], wall)) return;
    this.#count(row, -1, separation(this.world[a], this.parts.radius[a], this.walls[wall], 0));
  }

  /**
   * Whether the wall's place that is nearest to an agent's is a local minimum over all that meet there, and for this one to tell: a
   * tip that sticks out counts once, a straight wall in pieces too. @param {Float64Array} place @param {number} wall
   */
  #isNearest([x, y], wall) {
    const [ax, ay, bx, by] = this.walls[wall], along = (x - ax) * (bx - ax) + (y - ay) * (by - ay), length = (bx - ax) ** 2 + (by - ay) ** 2;
    if (along > 0 && along < length) return true;
    const [px, py] = along > 0 ? [bx, by] : [ax, ay], met = this.ends?.get(`${px},${py}`) ?? [];
    const own = met.find(one => one.row === wall);
    return met.every(one => one === own || ((x - px) * (px - one.far[0]) + (y - py) * (py - one.far[1]) >= 0 && one.rank > (own?.rank ?? 0)));
  }

  /** How far a part is from the four sides of the box. @param {number} a */
  #sides(a) {
    const row = this.parts.body[a], { min, max } = this.scene.domain, points = this.world[a], radius = this.parts.radius[a];
    if (!isFree(this.scene.bodies.kind[row])) return;
    for (let axis = 0; axis < 2; ++axis) {
      let low = Infinity, high = -Infinity;
      for (let k = axis; k < points.length; k += 2) { low = Math.min(low, points[k]); high = Math.max(high, points[k]); }
      this.#count(row, -1, low - radius - min[axis]);
      this.#count(row, -1, max[axis] - high - radius);
    }
  }

  /** Pairs that meet over a border of a periodic domain: of parts that reach over it, with their images. @param {number} width @param {number} height */
  #acrossBorders(width, height) {
    const { min, max } = this.scene.domain, { body } = this.parts, { kind } = this.scene.bodies, { here } = this, reach = this.#reach();
    /** @type {number[]} */
    const near = [];
    for (let i = 0; i < this.present; ++i) {
      const p = 4 * i;
      if (this.boxes[p] < min[0] + reach || this.boxes[p + 1] < min[1] + reach || this.boxes[p + 2] > max[0] - reach || this.boxes[p + 3] > max[1] - reach) near.push(i);
    }
    for (const [dx, dy] of [[width, 0], [0, height], [width, height], [width, -height]]) {
      const boxes = new Float64Array(8 * near.length);
      near.forEach((at, i) => {
        const p = 4 * at, [left, bottom, right, top] = this.boxes.subarray(p, p + 4);
        boxes.set([left, bottom, right, top], 4 * i);
        boxes.set([left + dx, bottom + dy, right + dx, top + dy], 4 * (near.length + i));
      });
      eachMeeting(boxes, near.length, (i, j) => {
        if (j < near.length) return;
        const a = here[near[i]], b = here[near[j - near.length]];
        if (body[a] === body[b] || !(isFree(kind[body[a]]) || isFree(kind[body[b]]))) return;
        this.#pair(a, b, this.world[b].map((value, k) => value + (k % 2 ? dy : dx)));
      });
    }
  }

  /** The largest extent of a part. */
  #reach() {
    let reach = 0;
    for (let p = 0; p < 4 * this.present; p += 4) reach = Math.max(reach, this.boxes[p + 2] - this.boxes[p], this.boxes[p + 3] - this.boxes[p + 1]);
    return reach;
  }

  /** @param {number} a @param {number} b @param {number} gap */
  #count(a, b, gap) {
    const { found } = this;
    if (!found || gap > 0) return;
    found.pairs.push(a, b);
    found.depths.push(0 - gap);
    if (!(gap < 0)) return;
    ++found.overlapping;
    found.sum -= gap;
    found.largest = Math.max(found.largest, -gap);
    found.deepest[a] = Math.max(found.deepest[a], -gap);
    if (b >= 0) found.deepest[b] = Math.max(found.deepest[b], -gap);
  }
}
