// SPDX-License-Identifier: MIT
// The bodies as the graphics card wants them: discs, triangles and edges, each with its body's row and places about its centre.

/**
 * @typedef {{count: number, data: ArrayBuffer, rows: Uint32Array, values: Float32Array}} Rows  of STRIDE words: row, then values
 * @typedef {{discs: Rows, composites: Rows, triangles: Rows, edges: Rows}} Mesh
 *   discs and composites: x, y, radius; triangles: x, y, three rows a triangle; edges: x, y, x, y
 */

const CORNER = 8;  // steps of a rounded corner

/** @param {number[]} words  row and values in turn @param {number} width  words a row @returns {Rows} */
function pack(words, width) {
  const data = new ArrayBuffer(4 * words.length), rows = new Uint32Array(data), values = new Float32Array(data);
  for (let i = 0; i < words.length; ++i) if (i % width === 0) rows[i] = words[i]; else values[i] = words[i];
  return { count: words.length / width, data, rows, values };
}

/** A convex part grown by its radius: straight along the edges, round at the vertices. @param {import("../reader/scene.js").Part} part @returns {ArrayLike<number>} */
export function rounded({ points, radius }) {
  if (radius === 0) return points;
  const out = [], n = points.length / 2;
  for (let i = 0; i < n; ++i) {
    const x = points[2 * i], y = points[2 * i + 1], b = (i + n - 1) % n, a = (i + 1) % n, quarter = Math.PI / 2;
    const from = Math.atan2(y - points[2 * b + 1], x - points[2 * b]) - quarter;
    let turn = Math.atan2(points[2 * a + 1] - y, points[2 * a] - x) - quarter - from;
    turn -= 2 * Math.PI * Math.floor(turn / (2 * Math.PI));
    for (let k = 0; k <= CORNER; ++k) out.push(x + radius * Math.cos(from + turn * k / CORNER), y + radius * Math.sin(from + turn * k / CORNER));
  }
  return out;
}

/** @param {number[]} out @param {number} row @param {ArrayLike<number>} points  convex */
function addFan(out, row, points) {
  for (let i = 4; i < points.length; i += 2) out.push(row, points[0], points[1], row, points[i - 2], points[i - 1], row, points[i], points[i + 1]);
}

/** @param {number[]} out @param {number} row @param {ArrayLike<number>} points */
function addLoop(out, row, points) {
  for (let i = 0, j = points.length - 2; i < points.length; j = i, i += 2) out.push(row, points[j], points[j + 1], points[i], points[i + 1]);
}

/** @param {import("../reader/scene.js").Scene} scene @returns {Mesh} */
export function mesh({ bodies, shapes }) {
  /** @type {number[][]} */
  const [discs, composites, triangles, edges] = [[], [], [], []];
  for (let row = 0; row < bodies.count; ++row) {
    const { kind, parts, outline, holes } = shapes[bodies.shape[row]];
    if (kind === 0) discs.push(row, 0, 0, bodies.radius[row]);
    else for (const part of parts) {
      if (part.points.length === 2) { composites.push(row, part.points[0], part.points[1], part.radius); continue; }
      const around = rounded(part);
      addFan(triangles, row, around);
      if (outline.length === 0) addLoop(edges, row, around);
    }
    if (outline.length > 0) for (const ring of [outline, ...holes]) addLoop(edges, row, ring);
  }
  return { discs: pack(discs, 4), composites: pack(composites, 4), triangles: pack(triangles, 3), edges: pack(edges, 5) };
}
