// SPDX-License-Identifier: MIT
// The run as curves: energies, overlap, contacts of frames all over the recording, coarse first.
import { tellsContacts } from "../physics/contacts.js";
import { measure } from "../physics/measures.js";
import { spread } from "./overview.js";

const POINTS = 400;        // of a curve
const PARTS = 5e6;         // parts times frames of which overlaps are looked for: some seconds of work

/** The rows 0 to n - 1 so that each beginning of the list is spread over all of them. @param {number} n @returns {number[]} */
export function coarseFirst(n) {
  /** @type {number[]} */
  const order = [], seen = new Set();
  for (let step = 2 ** Math.ceil(Math.log2(Math.max(1, n))); step >= 1; step /= 2)
    for (let i = 0; i < n; i += step) if (!seen.has(i)) { seen.add(i); order.push(i); }
  return order;
}

/**
 * The frames that curves are of, spread over the recording; where not all frames hold all fields, half of them over those that do.
 * @param {import("./recording.js").Description} description @returns {number[]}
 */
export function scanned({ steps, rates }) {
  const whole = [...steps.keys()].filter(i => Object.values(rates).every(every => steps[i] % every === 0));
  if (whole.length === steps.length) return spread(steps.length, POINTS);
  return [...new Set([...spread(steps.length, POINTS / 2), ...spread(whole.length, POINTS / 2).map(k => whole[k])])].sort((a, b) => a - b);
}

/**
 * @typedef {{frame: number, time: number, kinetic: number, turning: number, potential: number, moving: number, present: number, contacts: number,
 *   largest: number, mean: number, observed: number[]}} Point  as Measures and Contacts have them; observed: by description.observed
 */

/**
 * Yields one point a time. Overlaps of long recordings are found in fewer frames, and of shapes
 * that turn in those that hold their angles: NaN in the others.
 * @param {import("./recording.js").Recording} recording @param {import("../physics/contacts.js").ContactFinder} finder
 * @param {number} slow  m/s
 * @returns {Generator<Point>}
 */
export function* scan(recording, finder, slow) {
  const { description } = recording, rows = scanned(description);
  const withContacts = Math.max(20, Math.floor(PARTS / Math.max(1, finder.parts.body.length)));
  for (const [done, k] of coarseFirst(rows.length).entries()) {
    const i = rows[k], frame = recording.frame(i, ["position", "angle", "velocity", "spin"]);
    const contacts = done < withContacts && tellsContacts(description, i) ? finder.find(frame) : null;
    yield { frame: i, time: description.times[i], ...measure(description, frame, slow),
            contacts: contacts ? contacts.pairs.length / 2 : NaN, largest: contacts?.largest ?? NaN, mean: contacts?.mean ?? NaN, observed: recording.observed(i) };
  }
}
