// SPDX-License-Identifier: MIT
// How deep convex shapes are in one another. The definition is narrowphase/; this is its small sister for pictures.

/**
 * The largest gap along A's edge normals: the distance of B's nearest vertex in front of A's best edge, negative where none is
 * in front. Expects counter-clockwise points x, y, x, y. O(n m).
 * @param {Float64Array} a @param {Float64Array} b
 */
function frontOf(a, b) {
  let best = -Infinity;
  for (let i = 0, j = a.length - 2; i < a.length; j = i, i += 2) {
    let nx = a[i + 1] - a[j + 1], ny = a[j] - a[i];
    const length = Math.hypot(nx, ny);
    if (!(length > 0)) continue;
    nx /= length;
    ny /= length;
    let least = Infinity;
    for (let k = 0; k < b.length; k += 2) least = Math.min(least, (b[k] - a[j]) * nx + (b[k + 1] - a[j + 1]) * ny);
    best = Math.max(best, least);
  }
  return best;
}

/** Distance of the point p from the segment a b. @param {number} px @param {number} py @param {number} ax @param {number} ay @param {number} bx @param {number} by */
function pointSegment(px, py, ax, ay, bx, by) {
  const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const t = square > 0 ? Math.min(1, Math.max(0, ((px - ax) * dx + (py - ay) * dy) / square)) : 0;
  return Math.hypot(px - ax - t * dx, py - ay - t * dy);
}

/** The least distance of A's vertices from B's edges. @param {Float64Array} a @param {Float64Array} b */
function verticesToEdges(a, b) {
  let best = Infinity;
  for (let i = 0; i < a.length; i += 2)
    for (let k = 0, j = b.length - 2; k < b.length; j = k, k += 2)
      best = Math.min(best, pointSegment(a[i], a[i + 1], b[j], b[j + 1], b[k], b[k + 1]));
  return best;
}

/**
 * The signed distance of two convex polygons (or segments, or points), each grown by its radius: below 0, minus the depth of
 * the least push that parts them. Segments have no inside: their two sides are both fronts. O(n m).
 * @param {Float64Array} a @param {number} ra @param {Float64Array} b @param {number} rb
 */
export function separation(a, ra, b, rb) {
  const flat = a.length < 6 && b.length < 6;
  const gap = flat ? 0 : Math.max(a.length > 2 ? frontOf(a, b) : -Infinity, b.length > 2 ? frontOf(b, a) : -Infinity);
  if (gap < 0) return gap - ra - rb;
  return Math.min(verticesToEdges(a, b), verticesToEdges(b, a)) - ra - rb;
}
