// SPDX-License-Identifier: MIT
// Whom the sensors of a run found, where that was recorded.
import { attribute, damaged, dataset } from "./h5.js";
import { everyOf } from "./quantized.js";

const MOST = 8;  // of the layout

/** @typedef {{name: string, radius: number, ids: Float64Array}} Found  radius: m; ids: of those who were found, ascending */

class Sensor {
  #columns; #samples; #every;

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

  /** Rows [begin, end) of a column. @param {string} name @param {number} begin @param {number} end */
  #rows(name, begin, end) {
    const column = this.#columns.get(name);
    if (!(begin <= end && end <= column.metadata.shape[0])) throw damaged("what a sensor found is missing");
    return begin === end ? [] : Array.from(column.slice([[begin, end]]), Number);
  }

  /** Whom the body of this id found in the last look up to a step; null where it didn't look. @param {number} id @param {number} step @returns {Found | null} */
  found(id, step) {
    let sample = -1;
    while (sample + 1 < this.#samples.length && this.#samples[sample + 1] <= step) ++sample;
    if (sample < 0) return null;
    const [begin, end] = this.#rows("offset", sample, sample + 2), [first, last] = this.#rows("whom_offset", sample, sample + 2);
    const row = this.#rows("who", begin, end).indexOf(id);
    if (row < 0) return null;
    const counts = this.#rows("count", begin, begin + row + 1), own = counts[row], before = counts.reduce((sum, count) => sum + count, -own);
    if (first + before + own > last) throw damaged("what a sensor found is missing");
    return { name: this.name, radius: this.radius, ids: Float64Array.from(this.#rows("whom", first + before, first + before + own)) };
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
