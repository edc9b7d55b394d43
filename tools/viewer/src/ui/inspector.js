// SPDX-License-Identifier: MIT
// What is known of the picked body, and whom it senses.
import { count, length, short } from "../view/format.js";
import { AGENT } from "../reader/scene.js";
import { byId, fillList } from "./dom.js";

const KINDS = ["moves freely", "static", "driven", "agent"];

/**
 * When a field was recorded that a frame carries on from before: "0.5 s"; "" where it is the frame's own.
 * @param {import("../reader/recording.js").Description} d @param {number} frame @param {import("../reader/recording.js").Field} field
 */
export function carried({ rates, steps, times }, frame, field) {
  const step = steps[frame], last = step - step % (rates[field] ?? 1);
  return last === step ? "" : `${short(times[frame] * last / step, 4)} s`;
}

/** As part of a name: ", at 0.5 s". @param {Parameters<typeof carried>} of */
const since = (...of) => carried(...of) && `, at ${carried(...of)}`;

/**
 * @param {import("../reader/recording.js").Description} d @param {number} frame @param {number} row @param {import("../reader/source.js").Loaded} loaded
 * @returns {[string, string][]}
 */
export function facts(d, frame, row, { values: { position, angle, velocity, spin }, contacts }) {
  const here = !Number.isNaN(position?.[2 * row]);
  const { bodies, shapes, materials } = d, moved = since(d, frame, "velocity"), pair = (/** @type {ArrayLike<number>} */ v) => `${short(v[2 * row], 5)}, ${short(v[2 * row + 1], 5)}`;
  /** @type {([string, string] | false)[]} */
  const all = [
    !here && ["now", "not here"],
    ["shape", shapes[bodies.shape[row]].name],
    materials.length > 1 && ["material", materials[bodies.material[row]]],
    bodies.kind[row] > 0 && ["kind", KINDS[bodies.kind[row]]],
    ["radius", length(bodies.radius[row], 4)],
    bodies.mass[row] > 0 && ["mass", `${short(bodies.mass[row], 4)} kg`],
    here && position !== undefined && ["place", `${pair(position)} m`],
    here && velocity !== undefined && [`velocity${moved}`, `${pair(velocity)} m/s`],
    here && velocity !== undefined && [`speed${moved}`, `${short(Math.hypot(velocity[2 * row], velocity[2 * row + 1]), 5)} m/s`],
    here && angle !== undefined && bodies.kind[row] !== AGENT && [`angle${since(d, frame, "angle")}`, `${short(angle[row] * 180 / Math.PI, 5)}°`],
    here && spin !== undefined && bodies.kind[row] !== AGENT && [`spin${since(d, frame, "spin")}`, `${short(spin[row], 4)} rad/s`],
    here && contacts !== undefined && ["deepest overlap", length(contacts.deepest[row])],
  ];
  return all.filter(fact => fact !== false);
}

/** @param {[string, string][] | null} all */
export function showFacts(all) {
  byId("body").hidden = all === null;
  byId("follow").disabled = all === null;
  if (all) fillList(byId("facts"), all);
}

/** A recorded sensor tells of itself; without one the radius is the page's to choose; while that isn't known nothing is said. @param {ReturnType<typeof import("../physics/neighbours.js").neighbours>} found @param {Float64Array} id @param {number} radius  m @param {import("../reader/sensors.js").Found | null | undefined} recorded */
export function showSensed(found, id, radius, recorded) {
  byId("radius-text").textContent = recorded ? `${length(recorded.radius)}, by its sensor ${recorded.name}` : length(radius);
  byId("radius").hidden = recorded !== null;
  if (recorded === undefined) byId("radius-text").textContent = byId("sensed").textContent = "";
  if (recorded === undefined) return;
  const nearest = found.slice(0, 4).map(({ row, distance }) => `${id[row]} at ${length(distance)}`).join(", ");
  const all = recorded ? recorded.ids.length : found.length, unseen = all - found.length;  // those who are not in the recording
  const who = [nearest + (found.length > 4 ? " …" : ""), unseen > 0 ? `${count(unseen)} not recorded` : ""].filter(Boolean).join(", ");
  byId("sensed").textContent = all === 0 ? "senses nobody" : `senses ${count(all)}: ${who}`;
}
