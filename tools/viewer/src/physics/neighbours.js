// SPDX-License-Identifier: MIT
// Whom a body senses: as `throng query --radius`, centre to centre.

/**
 * Rows of the bodies whose centres are at most `radius` from that of `row`, nearest first, ties by row; over the borders of a
 * periodic domain, too. O(n).
 * @param {Float32Array | Float64Array} position @param {number} row @param {number} radius  m
 * @param {import("../reader/scene.js").Domain} domain
 * @returns {{row: number, distance: number, dx: number, dy: number}[]}  dx, dy: from the body to its neighbour (m)
 */
export function neighbours(position, row, radius, { kind, min, max }) {
  const width = max[0] - min[0], height = max[1] - min[1], px = position[2 * row], py = position[2 * row + 1], found = [];
  for (let other = 0; other < position.length / 2; ++other) {
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
