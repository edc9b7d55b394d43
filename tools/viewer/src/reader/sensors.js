// SPDX-License-Identifier: MIT
// Whom the sensors of a run found, where that was recorded.
import { attribute, damaged, dataset } from "./h5.js";
import { lastUpTo } from "./latest.js";
import { everyOf } from "./quantized.js";

const MOST = 8;  // of the layout

/** @typedef {{name: string, radius: number, ids: Float64Array}} Found  radius: m; ids: of those who were found, ascending */

/** @typedef {{sample: number, who: ArrayLike<number>, begin: Float64Array, first: number}} Look  who: ids, ascending; of the k-th it found
 *    rows first + begin[k] to first + begin[k + 1] of whom */

class Sensor {
  #columns; #samples; #every;
  #look = /** @type {Look | null} */ (null);  // the last that was asked for: many frames may show one

  /** Throws BadFile. @param {import("./h5.js").OpenFile} file @param {string} path @param {Float64Array} steps  of all frames */
  constructor(file, path, steps) {
    const group = file.get(path);
    this.name = String(attribute(group, "name") ?? "");
    this.radius = Number(attribute(group, "radius"));
    this.#every = everyOf(group);
    this.#samples = steps.filter(step => step % this.#every === 0);
    this.#columns = new Map(["offset", "who", "count", "whom_offset", "whom"].map(name => [name, dataset(file, `${path}/${name}`, "int", [-1])]));
    if (!(this.radius >= 0)) throw damaged("a sensor's radius");
  }

  /** Rows [begin, end) of a column. @param {string} name @param {number} begin @param {number} end @returns {ArrayLike<number>} */
  #rows(name, begin, end) {
    const column = this.#columns.get(name);
    if (!(begin <= end && end <= column.metadata.shape[0])) throw damaged("what a sensor found is missing");
    return begin === end ? [] : column.slice([[begin, end]]);
  }

  /** @param {string} name @param {number} sample */
  #ends(name, sample) { return Array.from(this.#rows(name, sample, sample + 2), Number); }

  /** @param {number} sample @returns {Look} */
  #read(sample) {
    const [from, to] = this.#ends("offset", sample), [first, last] = this.#ends("whom_offset", sample);
    const who = this.#rows("who", from, to), count = this.#rows("count", from, to), begin = new Float64Array(count.length + 1);
    for (let k = 0; k < count.length; ++k) begin[k + 1] = begin[k] + count[k];
    if (first + begin[count.length] !== last) throw damaged("what a sensor found is missing");
    return { sample, who, begin, first };
  }

  /** Whom the body of this id found in the last look up to a step; null where it didn't look. @param {number} id @param {number} step @returns {Found | null} */
  found(id, step) {
    const sample = lastUpTo(this.#samples, step);
    if (sample < 0) return null;
    if (this.#look?.sample !== sample) this.#look = this.#read(sample);
    const { who, begin, first } = this.#look, k = lastUpTo(who, id);
    if (who[k] !== id) return null;
    return { name: this.name, radius: this.radius, ids: Float64Array.from(this.#rows("whom", first + begin[k], first + begin[k + 1])) };
  }
}

export class Sensors {
  #all = /** @type {Sensor[]} */ ([]);

  /** Throws BadFile. @param {import("./h5.js").OpenFile} file @param {Float64Array} steps  of all frames */
  constructor(file, steps) {
    for (let k = 0; k < MOST && file.get(`throng/sensors/${k}`); ++k) this.#all.push(new Sensor(file, `throng/sensors/${k}`, steps));
  }

  get count() { return this.#all.length; }

  /** What the first sensor that the body of this id has found up to a step. Throws BadFile. @param {number} id @param {number} step */
  found(id, step) {
    for (const sensor of this.#all) {
      const found = sensor.found(id, step);
      if (found) return found;
    }
    return null;
  }
}
