// SPDX-License-Identifier: MIT
// What the page takes from the scenario that a recording holds: gravity, areas, and which bodies were asked for together. The text is
// throng's own print of it (scenarios/print.cpp), a value a line; what can't be told from it is left out.

/**
 * @typedef {{name: string, entries: Map<string, string>}} Section  of the text; values as they stand there
 * @typedef {{name: string, rings: ArrayLike<number>[], use: "none" | "goal" | "wait"}} Area  rings: x, y, x, y (m), filled where a place is in an odd
 *   number of them; use: what agents do there
 * @typedef {{name: string, first: number, count: number}} Group  of the ids from `first` on
 */

const MOST_GROUPS = 1000;

/** The value as JSON has it, which these of TOML are too; undefined where it is none. @param {string | undefined} value @returns {any} */
function json(value) {
  try { return value === undefined ? undefined : JSON.parse(value); } catch { return undefined; }
}

/** The head, whose name is "", and the tables; entries of lists one by one. @param {string} text @returns {Section[]} */
export function sections(text) {
  const all = [{ name: "", entries: new Map() }];
  for (const line of text.split("\n")) {
    const table = /^\s*\[\[?([A-Za-z0-9_-]+)\]\]?\s*$/.exec(line), entry = /^\s*("(?:[^"\\]|\\.)*"|[A-Za-z0-9_-]+)\s*=\s*(.*)$/.exec(line);
    if (table) all.push({ name: table[1], entries: new Map() });
    else if (entry) all[all.length - 1].entries.set(json(entry[1]) ?? entry[1], entry[2].trim());
  }
  return all;
}

/** Gravity (m/s²), or null where it can't be told. @param {Section[]} all @returns {number[] | null} */
export function gravityOf([head]) {
  const value = head.entries.get("gravity"), gravity = json(value);
  if (value === undefined) return head.entries.has("throng") ? [0, 0] : null;
  return Array.isArray(gravity) && gravity.length === 2 && gravity.every(Number.isFinite) ? gravity : null;
}

/** @param {number[][]} points  x, y; the last may repeat the first */
function ring(points) {
  const flat = points.flat(), n = flat.length;
  if (n > 2 && flat[0] === flat[n - 2] && flat[1] === flat[n - 1]) flat.length = n - 2;
  return flat;
}

/** The rings of a well-known text, or of a list of points. @param {any} shape @returns {number[][]} */
function ringsOf(shape) {
  if (Array.isArray(shape)) return [ring(shape)];
  return typeof shape === "string" ? Array.from(shape.matchAll(/\(([^()]*)\)/g), ([, inner]) => ring(inner.split(",").map(pair => pair.trim().split(/\s+/).map(Number)))) : [];
}

/** The names in a goal: one, a list of them, the nearest of some, or some with weights. @param {string} [goal] @returns {string[]} */
function goalsIn(goal = "") {
  const weighted = /\bweights = \{([^}]*)\}/.exec(goal), names = weighted ? weighted[1].matchAll(/("(?:[^"\\]|\\.)*"|[A-Za-z0-9_-]+)\s*=/g) : goal.matchAll(/("(?:[^"\\]|\\.)*")/g);
  return Array.from(names, ([, name]) => json(name) ?? name);
}

/** By name, from files whose layout has no table of them; also where agents wait is a goal here. @param {Section[]} all @returns {Area[]} */
export function areasOf(all) {
  const goals = new Set(all.filter(({ name }) => name === "agents").flatMap(({ entries }) => goalsIn(entries.get("goal"))));
  const found = all.filter(({ name }) => name === "areas").flatMap(({ entries }) =>
    Array.from(entries, ([name, value]) => ({ name, rings: ringsOf(json(value)), use: goals.has(name) ? /** @type {const} */ ("goal") : /** @type {const} */ ("none") })));
  return found.filter(({ rings }) => rings.length > 0 && rings.every(points => points.length >= 6 && points.length % 2 === 0 && points.every(Number.isFinite)));
}

/** How many bodies an entry asks for; NaN where the text doesn't say. @param {Map<string, string>} entries */
function countOf(entries) {
  if (entries.has("count")) return Number(entries.get("count"));
  if (entries.has("appear")) return NaN;
  const place = entries.get("place") ?? "", lattice = /\blattice = \{[^}]*\bsize = \[(\d+), (\d+)\]/.exec(place);
  return lattice ? Number(lattice[1]) * Number(lattice[2]) : /\bfile = /.test(place) ? NaN : 1;
}

/** Names, of which those that come again are numbered. @param {string[]} names */
function distinct(names) {
  return names.map((name, i) => names.indexOf(name) === names.lastIndexOf(name) ? name : `${name} ${names.slice(0, i + 1).filter(other => other === name).length}`);
}

/**
 * The entries [[bodies]], then [[agents]], by the ids that they became: by what they are made of, agents by where they go. None where
 * the text doesn't say how many bodies each has.
 * @param {Section[]} all @param {number} bodies  of the run
 * @returns {Group[]}
 */
export function groupsOf(all, bodies) {
  const entries = ["bodies", "agents"].flatMap(kind => all.filter(({ name }) => name === kind)), counts = entries.map(({ entries: e }) => countOf(e));
  const known = counts.filter(count => !Number.isNaN(count)).reduce((a, b) => a + b, 0), unknown = counts.filter(Number.isNaN).length;
  if (entries.length > MOST_GROUPS || unknown > 1 || (unknown === 0 ? known !== bodies : known > bodies)) return [];
  const names = distinct(entries.map(({ name, entries: e }) => name === "agents" ? `to ${goalsIn(e.get("goal")).join(", ") || "?"}` : String(json(e.get("shape")) ?? "bodies")));
  let first = 1;
  return counts.map((count, i) => {
    const group = { name: names[i], first, count: Number.isNaN(count) ? bodies - known : count };
    first += group.count;
    return group;
  });
}
