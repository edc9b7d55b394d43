// SPDX-License-Identifier: MIT
// Which bodies are in a frame, where they come and go: of a region, or agents, who leave at their goals.
import { damaged, dataset, numbers } from "./h5.js";
import { row } from "./quantized.js";

const PATH = "particles/trajectory/id";

export class Presence {
  #data;
  #rowOf;
  #steps;
  #samples = new Int32Array(0);  // of the file's frames; -1 of those that hold nothing of bodies
  #at = -1;
  #rows = new Int32Array(0);

  /** Throws BadFile. @param {import("./h5.js").OpenFile} file @param {Float64Array} ids  of all bodies, by row */
  constructor(file, ids) {
    this.#data = dataset(file, `${PATH}/value`, "int", [-1, ids.length], "sparse");
    this.#steps = numbers(file, `${PATH}/step`, "int", [-1]);
    this.#rowOf = new Map(Array.from(ids, (id, at) => [id, at]));
  }

  /**
   * Finds out which frames have ids, whose samples stand in their order. Throws BadFile where one with a field lacks them.
   * @param {Float64Array} steps  of the file's frames @param {number[]} rates  of the fields
   */
  find(steps, rates) {
    const stored = this.#steps.subarray(0, this.#data.metadata.shape[0]);
    let next = 0;
    this.#samples = Int32Array.from(steps, step => stored[next] === step ? next++ : -1);
    if (steps.some((step, i) => this.#samples[i] < 0 && rates.some(every => step % every === 0))) throw damaged("frames are missing that it says it holds");
  }

  /** The rows of the bodies that frame i holds, in its order, which ascends. Throws BadFile where it doesn't. @param {number} i  of the file, one with a field */
  rows(i) {
    if (this.#at === i) return this.#rows;
    const stored = row(this.#data, this.#samples[i]), end = stored.indexOf(0), rows = new Int32Array(end < 0 ? stored.length : end);
    for (let k = 0, before = -1; k < rows.length; before = rows[k++]) {
      rows[k] = this.#rowOf.get(stored[k]) ?? -1;
      if (rows[k] <= before) throw damaged(`${PATH}/value of frame ${i} is not in order`);
    }
    for (let k = rows.length; k < stored.length; ++k) if (stored[k] !== 0) throw damaged(`${PATH}/value of frame ${i} is not in order`);
    this.#at = i;
    return this.#rows = rows;
  }
}

/**
 * The values of the bodies `rows`, in their order, of those that have each body's in its row.
 * @param {Float64Array} all @param {Int32Array} rows @param {number} width  numbers a body
 */
export function gather(all, rows, width) {
  const values = new Float64Array(width * rows.length);
  for (let k = 0; k < rows.length; ++k) for (let c = 0; c < width; ++c) values[width * k + c] = all[width * rows[k] + c];
  return values;
}

/**
 * Each body's values in its row, NaN of those that are not there.
 * @template {Float32Array | Float64Array} T
 * @param {T} values  of the bodies `rows`, in their order @param {Int32Array} rows @param {number} bodies @param {number} width  numbers a body
 * @returns {T}
 */
export function scatter(values, rows, bodies, width) {
  const Kind = /** @type {new (length: number) => T} */ (values.constructor);
  const all = new Kind(width * bodies).fill(NaN);
  for (let k = 0; k < rows.length; ++k) for (let c = 0; c < width; ++c) all[width * rows[k] + c] = values[width * k + c];
  return /** @type {T} */ (all);
}
