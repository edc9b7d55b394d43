// SPDX-License-Identifier: MIT
// Where bodies are at a time between two frames, as the stage wants it.

import { AGENT } from "../reader/scene.js";

const TURN = 2 * Math.PI;
const STANDS = 0.05;  // m/s below which an agent has no heading

/** The angle of an agent that stands, which none has; what has it shows no line. */
export const NOWHERE = -10;

/** The colour of a body that is not there; what has it is not drawn. */
export const ABSENT = -1;

/**
 * Fills states with x, y from the camera (m), angle and colour of every body. Over the borders of a periodic domain bodies take
 * the short way, and are shown where they are inside it. Who leaves stands until the next frame, who comes is there with it.
 * @param {import("../reader/recording.js").Frame} a @param {import("../reader/recording.js").Frame} b @param {number} t  0 to 1
 * @param {{x: number, y: number}} camera @param {import("../reader/scene.js").Domain} domain @param {Float32Array} places  of colours
 * @param {Float32Array} states  four a body
 */
export function blend(a, b, t, camera, domain, places, states) {
  const from = a.position, to = b.position, count = places.length;
  if (!from || !to) return;
  const periodic = domain.kind === "periodic", width = domain.max[0] - domain.min[0], height = domain.max[1] - domain.min[1];
  for (let row = 0; row < count; ++row) {
    const at = 4 * row, stays = to[2 * row] === to[2 * row];  // not NaN
    if (from[2 * row] !== from[2 * row]) { states[at] = states[at + 1] = NaN; states[at + 3] = ABSENT; continue; }
    let dx = stays ? to[2 * row] - from[2 * row] : 0, dy = stays ? to[2 * row + 1] - from[2 * row + 1] : 0;
    if (periodic) {
      dx -= width * Math.round(dx / width);
      dy -= height * Math.round(dy / height);
    }
    let x = from[2 * row] + t * dx, y = from[2 * row + 1] + t * dy;
    if (periodic) {
      x -= width * Math.floor((x - domain.min[0]) / width);
      y -= height * Math.floor((y - domain.min[1]) / height);
    }
    states[at] = x - camera.x;
    states[at + 1] = y - camera.y;
    const angle = angleOf(a, b, t, row);
    states[at + 2] = angle - TURN * Math.floor(angle / TURN);
    states[at + 3] = places[row];
  }
}

/** 0 where none is known. @param {import("../reader/recording.js").Frame} a @param {import("../reader/recording.js").Frame} b @param {number} t @param {number} row */
function angleOf(a, b, t, row) {
  const from = a.angle ? a.angle[row] : 0, to = b.angle ? b.angle[row] : 0;
  return from !== from ? 0 : to !== to ? from : from + t * (to - from);
}

/** Turns agents, whose angle says nothing, to where they walk. @param {Float32Array} states @param {Float64Array} kind @param {import("../reader/recording.js").Frame} frame */
export function faceForward(states, kind, { velocity }) {
  for (let row = 0; row < kind.length; ++row) {
    if (kind[row] !== AGENT) continue;
    const vx = velocity?.[2 * row] ?? 0, vy = velocity?.[2 * row + 1] ?? 0;
    states[4 * row + 2] = Math.hypot(vx, vy) > STANDS ? Math.atan2(vy, vx) : NOWHERE;
  }
}

/** Where one body is, as blend has it; NaN where it is not there. @param {Float32Array} states @param {number} row @param {{x: number, y: number}} camera */
export const placeOf = (states, row, camera) => [states[4 * row] + camera.x, states[4 * row + 1] + camera.y];

/**
 * The body under a place, that whose centre is nearest in its own radii; -1 where there is none within `reach` of one.
 * @param {Float32Array} states @param {Float64Array} radii @param {number} x  m, from the camera @param {number} y @param {number} reach  m
 */
export function bodyAt(states, radii, x, y, reach) {
  let best = -1, least = Infinity;
  for (let row = 0; row < radii.length; ++row) {
    const distance = Math.hypot(states[4 * row] - x, states[4 * row + 1] - y), near = distance / Math.max(radii[row], 1e-300);
    if (distance <= radii[row] + reach && near < least) { least = near; best = row; }
  }
  return best;
}
