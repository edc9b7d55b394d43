// SPDX-License-Identifier: MIT
// Numbers of a frame: energies, how many bodies move, and how many are there.
import { DYNAMIC, isFree } from "../reader/scene.js";

/**
 * @typedef {{kinetic: number, turning: number, potential: number, moving: number, present: number}} Measures
 *   kinetic, turning, potential: J (kg m²/s²), of dynamic bodies: of translation, of rotation, and of height, which is 0 at the scene's
 *   origin; NaN where what it takes was not recorded; moving, present: how many of those that move by themselves, agents too
 */

/** kg m² about the centre of mass. @param {import("../reader/scene.js").Scene} scene @param {number} row */
export function inertia({ bodies, shapes }, row) {
  const shape = shapes[bodies.shape[row]];
  return bodies.mass[row] * (shape.kind === 0 ? 0.5 * bodies.radius[row] ** 2 : shape.gyration2);
}

/**
 * @param {import("../reader/scene.js").Scene} scene @param {import("../reader/recording.js").Frame} frame
 * @param {number} slow  m/s, the speed from which a body counts as moving
 * @returns {Measures}
 */
export function measure(scene, { position, velocity, spin }, slow) {
  const { bodies, gravity } = scene;
  let kinetic = 0, turning = 0, potential = 0, moving = 0, present = 0;
  for (let row = 0; row < bodies.count; ++row) {
    const x = 2 * row, y = x + 1, mass = bodies.mass[row];
    if (!isFree(bodies.kind[row]) || (position && Number.isNaN(position[x]))) continue;
    ++present;
    const square = velocity ? velocity[x] ** 2 + velocity[y] ** 2 : 0;
    if (square > slow * slow) ++moving;
    if (bodies.kind[row] !== DYNAMIC) continue;
    kinetic += 0.5 * mass * square;
    if (spin) turning += 0.5 * inertia(scene, row) * spin[row] ** 2;
    if (gravity && position) potential -= mass * (gravity[0] * position[x] + gravity[1] * position[y]);
  }
  return { kinetic: velocity ? kinetic : NaN, turning: spin ? turning : NaN, potential: gravity ? potential : NaN, moving: velocity ? moving : NaN, present };
}
