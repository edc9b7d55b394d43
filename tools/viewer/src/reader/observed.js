// SPDX-License-Identifier: MIT
// What a run observed: points of contact that press; of its crowd who arrived and what measures count, column by column.
import { damaged, dataset, numbers, texts } from "./h5.js";
import { lastUpTo } from "./latest.js";
import { everyOf } from "./quantized.js";

const MOST = 64;  // columns that are shown
const OF_LINES = ["count", "flow", "speed"], OF_AREAS = ["count", "density", "density_voronoi", "speed"];
const NEWER = "density_voronoi";  // older recordings have none

/** A measure's name as part of a path, as the program writes it. @param {string} name */
const part = name => name === "." ? "%2E" : name.replace(/%(?=[0-9A-Fa-f]{2})/g, "%25").replaceAll("/", "%2F");

/** The name of the measure that a column is of, if it is of one. @param {string} path */
export function measureOf(path) {
  return path.split("/")[1]?.replace(/%(25|2F|2E)/g, code => String.fromCharCode(parseInt(code.slice(1), 16)));
}

/** Paths below /observables, of those that there are. @param {import("./h5.js").OpenFile} file */
function columnsOf(file) {
  if (!file.get("observables/agents")) return file.get("observables/contacts") ? ["contacts"] : [];
  const names = file.get("throng/measures") ? texts(file, "throng/measures/name", [-1]) : [];
  const has = (/** @type {string} */ path) => Boolean(file.get(`observables/${path}`));
  const of = (/** @type {string} */ name) => (has(`measure/${part(name)}/density`) ? OF_AREAS : OF_LINES).map(column => `measure/${part(name)}/${column}`).filter(path => !path.endsWith(NEWER) || has(path));
  return ["arrived", ...names.flatMap(of)].slice(0, MOST);
}

/** How many points of contact each recorded frame of them has. Throws BadFile. @param {import("./h5.js").OpenFile} file @param {number} samples */
function contactCounts(file, samples) {
  const offsets = numbers(file, "throng/contacts/offset", "int", [-1]), counts = new Float64Array(samples);
  for (let i = 0; i < samples; ++i) counts[i] = offsets[i + 1] - offsets[i];
  if (!counts.every(count => count >= 0)) throw damaged("contacts are missing that it says it holds");
  return counts;
}

export class Observed {
  columns;
  #every = 1;
  #steps = new Float64Array(0);  // of the samples
  #values = /** @type {ArrayLike<number>[]} */ ([]);

  /** Throws BadFile. @param {import("./h5.js").OpenFile} file @param {Float64Array} steps  of all frames */
  constructor(file, steps) {
    this.columns = columnsOf(file);
    if (this.columns.length === 0) { this.#count(file, steps); return; }
    this.#every = everyOf(file.get("observables"));
    this.#steps = steps.filter(step => step % this.#every === 0);
    this.#values = this.columns.map(path => dataset(file, `observables/${path}/value`, "float", [-1]).value ?? []);
    if (this.#values.some(values => values.length < this.#steps.length)) throw damaged("observables are missing that it says it holds");
  }

  /** Contacts themselves may be there, where their number wasn't observed. @param {import("./h5.js").OpenFile} file @param {Float64Array} steps */
  #count(file, steps) {
    const group = file.get("throng/contacts"), every = group ? everyOf(group) : 1;
    if (!group) return;
    this.columns = ["contacts"];
    this.#every = every;
    this.#steps = steps.filter(step => step % every === 0);
    this.#values = [contactCounts(file, this.#steps.length)];
  }

  /** The last row up to a step. @param {number} step */
  at(step) {
    const sample = lastUpTo(this.#steps, step);
    return this.#values.map(values => values[sample] ?? NaN);
  }
}
