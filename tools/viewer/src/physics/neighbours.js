// SPDX-License-Identifier: MIT
// Whom a body senses: as `throng query --radius`, centre to centre.

/** @typedef {{row: number, distance: number, dx: number, dy: number}} Neighbour  dx, dy: from the body to its neighbour (m) */

/**
 * Those of `rows` whose centres are at most `radius` from that of `row`, nearest first, ties by row; over the borders of a periodic
 * domain, too.
 * @param {Float32Array | Float64Array} position @param {number} row @param {Iterable<number>} rows @param {number} radius  m
 * @param {import("../reader/scene.js").Domain} domain
 * @returns {Neighbour[]}
 */
export function among(position, row, rows, radius, { kind, min, max }) {
  const width = max[0] - min[0], height = max[1] - min[1], px = position[2 * row], py = position[2 * row + 1], found = [];
  for (const other of rows) {
    let dx = position[2 * other] - px, dy = position[2 * other + 1] - py;
    if (kind === "periodic") {
      dx -= width * Math.round(dx / width);
      dy -= height * Math.round(dy / height);
    }
    if (other === row || !(Math.abs(dx) <= radius && Math.abs(dy) <= radius)) continue;
    const distance = Math.hypot(dx, dy);
    if (distance <= radius) found.push({ row: other, distance, dx, dy });
  }
  return found.sort((a, b) => a.distance - b.distance || a.row - b.row);
}

/** All bodies within `radius` (m) of that of `row`, as `among`. O(n). @param {Float32Array | Float64Array} position @param {number} row @param {number} radius @param {import("../reader/scene.js").Domain} domain */
export const neighbours = (position, row, radius, domain) => among(position, row, Array(position.length / 2).keys(), radius, domain);
