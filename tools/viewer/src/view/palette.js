// SPDX-License-Identifier: MIT
// Colours that those who can't tell red from green tell apart, too.

/** @typedef {[number, number, number]} Colour  0 to 255 */

// Viridis (van der Walt and Smith 2015), as tools/palette.cpp has it: pictures and pages show one speed in one colour.
const RAMP = [[68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 141], [34, 168, 132],
              [68, 191, 113], [122, 209, 81], [189, 223, 38], [253, 231, 37]];
const LOWEST = { light: 0.12, dark: 0.3 };  // the darkest end looks black on a screen, and is lost on a dark one

// The eight of Okabe and Ito (2008) but black, those first that stand apart best on white and on black.
const GROUPS = [[86, 180, 233], [230, 159, 0], [0, 158, 115], [204, 121, 167], [0, 114, 178], [213, 94, 0], [240, 228, 66]];

export const LEVELS = 240;
/** Places of colours in the texture: LEVELS of the ramp, then groups, then these. */
export const GROUP = LEVELS, PLAIN = 250, STATIC = 251, KINEMATIC = 252, PICKED = 253;

/** @param {number} value 0 to 1 @param {boolean} dark @returns {Colour} */
export function ramp(value, dark) {
  const lowest = dark ? LOWEST.dark : LOWEST.light, at = (lowest + (1 - lowest) * Math.min(1, Math.max(0, value))) * (RAMP.length - 1);
  const i = Math.min(Math.floor(at), RAMP.length - 2), t = at - i;
  return /** @type {Colour} */ ([0, 1, 2].map(k => Math.round(RAMP[i][k] + t * (RAMP[i + 1][k] - RAMP[i][k]))));
}

/** Seven, then again from the first. @param {number} group @returns {Colour} */
export const groupColour = group => /** @type {Colour} */ (GROUPS[group % GROUPS.length]);

/** The place of a value of the ramp, 0 to 1. @param {number} value */
export const level = value => Math.round((LEVELS - 1) * Math.min(1, Math.max(0, value)));

/** @param {number} group */
export const groupPlace = group => GROUP + group % GROUPS.length;

/** @param {Colour} colour */
export const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;

/** The ramp as a background. @param {boolean} dark */
export const gradient = dark => `linear-gradient(90deg, ${Array.from({ length: 17 }, (_, i) => css(ramp(i / 16, dark))).join(", ")})`;

/** All places, 256 times RGBA. @param {boolean} dark */
export function table(dark) {
  const bytes = new Uint8Array(4 * 256).fill(255);
  const put = (/** @type {number} */ place, /** @type {number[]} */ colour) => bytes.set(colour, 4 * place);
  for (let i = 0; i < LEVELS; ++i) put(i, ramp(i / (LEVELS - 1), dark));
  GROUPS.forEach((colour, i) => put(GROUP + i, colour));
  put(PLAIN, dark ? [122, 162, 196] : [108, 146, 179]);
  put(STATIC, dark ? [104, 109, 117] : [186, 189, 194]);
  put(KINEMATIC, dark ? [190, 196, 205] : [115, 120, 128]);
  put(PICKED, [213, 94, 0]);
  return bytes;
}
