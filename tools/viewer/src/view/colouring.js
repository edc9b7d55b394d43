// SPDX-License-Identifier: MIT
// Which colour a body has: a place of palette.js by speed, id, group and so on.
import { count, length, short } from "./format.js";
import { isFree } from "../reader/scene.js";
import { groupColour, groupPlace, css, KINEMATIC, level, PLAIN, STATIC } from "./palette.js";

/**
 * @typedef {import("../reader/recording.js").Description} Description
 * @typedef {import("../reader/recording.js").Frame} Frame
 * @typedef {{values: Frame, contacts?: import("../physics/contacts.js").Contacts}} Loaded
 * @typedef {{range: [string, string]} | {groups: {name: string, css: string}[], more: number}} Legend
 * @typedef {{key: string, name: string, needs: "velocity" | "contacts" | null, legend: Legend | null,
 *   place: (row: number, loaded: Loaded) => number}} Colouring
 */

const SHOWN = 7;  // names of groups in the legend

/** @param {string} low @param {string} high @returns {Legend} */
const scale = (low, high) => ({ range: [low, high] });

/** @param {string[]} names @returns {Legend} */
const groups = names => ({ groups: names.slice(0, SHOWN).map((name, i) => ({ name, css: css(groupColour(i)) })), more: Math.max(0, names.length - SHOWN) });

/** Names of the groups that moving bodies are in, by first body, and each body's place among them. @param {Float64Array} group @param {Float64Array} kind @param {string[]} names */
function ranked(group, kind, names) {
  const rank = new Map();
  group.forEach((value, row) => { if (isFree(kind[row]) && !rank.has(value)) rank.set(value, rank.size); });
  return { names: [...rank.keys()].map(value => names[value] || "(no name)"), rank: (/** @type {number} */ row) => rank.get(group[row]) };
}

/** The group of each body, by row. @param {Description} d */
function groupRows({ bodies, groups: all }) {
  const rows = new Float64Array(bodies.count);
  for (let row = 0, group = 0; row < bodies.count; ++row) {
    while (group < all.length - 1 && bodies.id[row] >= all[group + 1].first) ++group;  // ids ascend
    rows[row] = group;
  }
  return rows;
}

/** Whether two ways to tell bodies apart tell the same ones apart. @param {Float64Array} a @param {Float64Array} b */
function sameGroups(a, b) {
  return new Set(Array.from(a, (value, row) => `${value} ${b[row]}`)).size === new Set(a).size && new Set(a).size === new Set(b).size;
}

/** The colourings that say something of this recording. @param {Description} d @param {import("../reader/overview.js").Overview} overview @returns {Colouring[]} */
export function colourings(d, { topSpeed, starts }) {
  const { bodies, shapes, materials } = d, shape = ranked(bodies.shape, bodies.kind, shapes.map(s => s.name)), material = ranked(bodies.material, bodies.kind, materials);
  const grouped = groupRows(d), group = ranked(grouped, bodies.kind, d.groups.map(({ name }) => name));
  const radii = bodies.radius.slice().sort(), middle = radii.length ? radii[radii.length >> 1] : 1, deep = 0.05 * middle;
  /** @type {(Colouring | false)[]} */
  const all = [
    d.fields.includes("velocity") && { key: "speed", name: "speed", needs: "velocity",
      legend: topSpeed > 0 ? scale("0", `${short(topSpeed)} m/s`) : null,
      place: (row, { values: { velocity } }) => !velocity ? PLAIN : level(topSpeed > 0 ? Math.sqrt(velocity[2 * row] ** 2 + velocity[2 * row + 1] ** 2) / topSpeed : 0) },
    shape.names.length > 1 && { key: "shape", name: "shape", needs: null, legend: groups(shape.names), place: row => groupPlace(shape.rank(row)) },
    group.names.length > 1 && !sameGroups(grouped, bodies.shape) &&
      { key: "group", name: "group", needs: null, legend: groups(group.names), place: row => groupPlace(group.rank(row)) },
    material.names.length > 1 && { key: "material", name: "material", needs: null, legend: groups(material.names), place: row => groupPlace(material.rank(row)) },
    bodies.count > 1 && { key: "id", name: "id", needs: null, legend: scale(count(bodies.id[0]), count(bodies.id[bodies.count - 1])),
      place: row => level(row / (bodies.count - 1)) },
    starts.high > starts.low && { key: "start", name: "start height", needs: null, legend: scale(length(starts.low), length(starts.high)),
      place: row => starts.heights[row] === starts.heights[row] ? level((starts.heights[row] - starts.low) / (starts.high - starts.low)) : PLAIN },
    { key: "overlap", name: "overlap", needs: "contacts", legend: scale("0", length(deep)),
      place: (row, { contacts }) => contacts ? level(contacts.deepest[row] / deep) : PLAIN },
    { key: "plain", name: "one colour", needs: null, legend: null, place: () => PLAIN },
  ];
  return all.filter(colouring => colouring !== false);
}

/**
 * Fills `places` with every body's; what doesn't move freely is grey.
 * @param {Colouring} colouring @param {Description} d @param {Loaded} loaded @param {Float32Array} places
 */
export function colour(colouring, { bodies }, loaded, places) {
  for (let row = 0; row < bodies.count; ++row) {
    const kind = bodies.kind[row];
    const place = isFree(kind) ? colouring.place(row, loaded) : kind === 1 ? STATIC : KINEMATIC;
    places[row] = place === place ? place : PLAIN;  // NaN: not known of this body
  }
}
