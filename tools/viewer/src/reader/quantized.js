// SPDX-License-Identifier: MIT
// Positions that are stored as whole multiples of a quantum, packed: sim/recording/packed.h says how.
import { attribute, damaged, dataset } from "./h5.js";

/** One row of a dataset [rows, ...]. @param {any} data @param {number} i */
export const row = (data, i) => data.slice([[i, i + 1], ...data.metadata.shape.slice(1).map(() => [])]);

/** Steps from one sample to the next; 1 in files before 1.2, where all had the frames' own. @param {any} element */
export function everyOf(element) {
  const every = Number(attribute(element, "every") ?? 1);
  if (!(every >= 1 && every <= 1e9)) throw damaged("the rate of a field");
  return every;
}

export class Quantized {
  #data; #quantum; #keyEvery;
  #at = -1;
  #now; #before;

  /** Throws BadFile. @param {import("./h5.js").OpenFile} file @param {number} count  bodies */
  constructor(file, count) {
    const path = "throng/quantized", group = file.get(path);
    this.#data = dataset(file, `${path}/position`, "int", [-1, count, 2], "packed");
    this.#quantum = Number(attribute(group, "quantum")), this.#keyEvery = Number(attribute(group, "key_every"));
    if (!(this.#quantum > 0 && this.#keyEvery >= 1 && this.#keyEvery <= 1024)) throw damaged(path);
    this.#now = new Int32Array(2 * count), this.#before = new Int32Array(2 * count);
  }

  get extent() { return this.#data.metadata.shape[0]; }

  /** @param {number} i */
  #next(i) {
    const stored = row(this.#data, i), order = Math.min(i % this.#keyEvery, 2), now = this.#now, next = this.#before;
    this.#at = -1;
    for (let k = 0; k < next.length; ++k) {
      const grown = (stored[k] >>> 1) ^ -(stored[k] & 1);
      next[k] = order === 0 ? grown : order === 1 ? now[k] + grown : 2 * now[k] - next[k] + grown;
    }
    this.#now = next, this.#before = now, this.#at = i;
  }

  /** Sample i in metres: x, y, x, y. O(bodies), from the key frame before. @param {number} i */
  frame(i) {
    const key = i - i % this.#keyEvery;
    if (this.#now.length > 0) for (let k = this.#at >= key && this.#at <= i ? this.#at + 1 : key; k <= i; ++k) this.#next(k);
    return Float64Array.from(this.#now, n => n * this.#quantum);
  }
}
