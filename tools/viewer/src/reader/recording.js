// SPDX-License-Identifier: MIT
// A recording: its scene, and its frames one by one, that of a run still going or killed included.
import { attribute, BadFile, damaged, dataset, numbers, OpenFile } from "./h5.js";
import { everyOf, Quantized } from "./quantized.js";
import { Observed } from "./observed.js";
import { gather, Presence, scatter } from "./presence.js";
import { readScene } from "./scene.js";
import { Sensors } from "./sensors.js";

/**
 * @typedef {"position" | "angle" | "velocity" | "spin"} Field
 * @typedef {{[field in Field]?: Float32Array | Float64Array}} Frame  a row a body; x, y, x, y of position and velocity; NaN of bodies
 *   that are not there
 * @typedef {{frame: (sample: number, bodies: number, rows?: Int32Array) => Float32Array | Float64Array, extent: number, every: number}} Stored
 *   frame: of the first so many bodies of a sample
 * @typedef {import("./scene.js").Scene & {fields: Field[], rates: {[field in Field]?: number}, times: Float64Array,
 *   steps: Float64Array, frames: number, complete: boolean, observed: string[], sensors: number}} Description  rates: steps from one sample of a field
 *   to the next; times, steps: of the frames that hold positions, which alone are shown; frames: all that the file has; observed: the columns
 *   of what was observed; sensors: how many were recorded
 */

/** @type {[Field, number][]} */
const FIELDS = [["position", 2], ["angle", 1], ["velocity", 2], ["spin", 1]];
const WIDTH = new Map(FIELDS);

/** Bytes at the beginning of a file that modeFor looks at. */
export const HEAD = 12;

/**
 * How to open a file: that of a run that goes on or was killed is marked, and opens in SWMR mode alone. There HDF5 waits, in effect
 * for ever, for damaged metadata to become sound, so that complete files are opened without.
 * @param {Uint8Array} head
 */
export const modeFor = head => head[11] ? "Sr" : "r";

/** The first `count` values, or pairs of them, of a row. @param {any} data @param {number} i @param {number} count */
const part = (data, i, count) => count === 0 ? new Float64Array(0) : data.slice([[i, i + 1], [0, count], ...data.metadata.shape.slice(2).map(() => [])]);

/** @param {any} h5 @param {string} path @param {"r" | "Sr"} mode @param {number} bytes */
function opened(h5, path, mode, bytes) {
  try {
    return new OpenFile(h5, path, mode, bytes);
  } catch {
    throw new BadFile("is no HDF5 file, or one whose beginning is damaged");
  }
}

export class Recording {
  #data = /** @type {Map<Field, Stored>} */ (new Map());
  #steps = new Float64Array(0);  // of all frames
  #samples = /** @type {Map<number, {sample: Int32Array, frame: Int32Array}>} */ (new Map());  // by rate: the last up to each frame
  #presence = /** @type {Presence | null} */ (null);  // null: all bodies are in all frames
  #observed = /** @type {Observed | null} */ (null);
  #sensors = /** @type {Sensors | null} */ (null);
  #chosen = /** @type {number[]} */ ([]);  // the frames of the file that hold positions, which alone are shown
  /** @type {Description} */
  description;

  /**
   * Opens and checks everything but the frames' values. Throws BadFile.
   * @param {any} h5  h5wasm, ready @param {string} path @param {"r" | "Sr"} mode  see modeFor @param {number} bytes  of the file
   */
  constructor(h5, path, mode, bytes) {
    this.file = opened(h5, path, mode, bytes);
    try {
      this.description = this.#describe();
      this.#readFields();
      this.#readRows();
      this.#observed = new Observed(this.file, this.#steps);
      this.description.observed = this.#observed.columns;
      this.#sensors = new Sensors(this.file, this.#steps);
      this.description.sensors = this.#sensors.count;
    } catch (error) {
      this.file.close();
      throw error;
    }
  }

  /** @returns {Description} */
  #describe() {
    const scene = readScene(this.file);
    return { ...scene, fields: [], observed: [], sensors: 0, rates: {}, times: new Float64Array(0), steps: new Float64Array(0), frames: 0,
             complete: numbers(this.file, "throng/finished", "int", [])[0] !== 0 };
  }

  #readFields() {
    const { bodies, fields } = this.description, storage = bodies.changes ? "sparse" : "whole";
    if (bodies.changes) this.#presence = new Presence(this.file, bodies.id);
    this.#readQuantized();
    for (const [field, components] of FIELDS) {
      const group = this.file.get(`particles/trajectory/${field}`);
      if (!group) continue;
      const data = dataset(this.file, `particles/trajectory/${field}/value`, "float", components === 2 ? [-1, bodies.count, 2] : [-1, bodies.count], storage);
      this.#add(field, { frame: (sample, count) => part(data, sample, count), extent: data.metadata.shape[0], every: everyOf(group) });
    }
    if (!fields.includes("position")) throw new BadFile("holds no positions: there is nothing to show");
  }

  #readQuantized() {
    const group = this.file.get("throng/quantized"), { bodies } = this.description;
    if (!group) return;
    const quantized = new Quantized(this.file, bodies.count);
    this.#add("position", { frame: (sample, _, rows) => rows ? gather(quantized.frame(sample), rows, 2) : quantized.frame(sample), extent: quantized.extent, every: everyOf(group) });
  }

  /** @param {Field} field @param {Stored} data */
  #add(field, data) {
    this.#data.set(field, data);
    this.description.fields.push(field);
    this.description.rates[field] = data.every;
  }

  /** A frame counts once its hash stands, whatever the extents of the other datasets say. */
  #readRows() {
    const hashes = dataset(this.file, "throng/frames/frame_hash", "int", [-1]).value ?? [];
    let frames = hashes.findIndex((/** @type {bigint} */ hash) => hash === 0n);
    if (frames < 0) frames = hashes.length;
    const steps = numbers(this.file, "throng/frames/step", "int", [-1]), times = numbers(this.file, "throng/frames/time", "float", [-1]);
    const samples = (/** @type {number} */ every) => steps.subarray(0, frames).filter(step => step % every === 0).length;
    if (steps.length < frames || times.length < frames || [...this.#data.values()].some(data => data.extent < samples(data.every))) throw damaged("frames are missing that it says it holds");
    if (frames === 0) throw new BadFile("holds no frames: there is nothing to show");
    this.description.frames = frames;
    this.description.steps = steps.slice(0, frames);
    this.description.times = times.slice(0, frames);
    this.#expectTimes();
    this.#presence?.find(this.description.steps, Array.from(this.#data.values(), ({ every }) => every));
    this.#choose();
  }

  /** Fields may have rates of their own: what is shown are the frames that hold positions. */
  #choose() {
    const { steps, times } = this.description;
    this.#steps = steps.slice();
    const every = this.#data.get("position")?.every ?? 1;
    this.#chosen = [...steps.keys()].filter(i => steps[i] % every === 0);
    if (this.#chosen.length === steps.length) return;
    this.description.steps = Float64Array.from(this.#chosen, i => steps[i]);
    this.description.times = Float64Array.from(this.#chosen, i => times[i]);
  }

  /** The rows carry no checksum: times are steps times dt, to the bit, and steps ascend. */
  #expectTimes() {
    const { steps, times } = this.description, dt = attribute(this.file.get("parameters"), "dt");
    for (let i = 0; i < steps.length; ++i)
      if (!(times[i] === steps[i] * dt && (i === 0 || steps[i] > steps[i - 1]))) throw damaged(`the time of frame ${i} is wrong`);
  }

  /**
   * Frame i, of the fields asked for those that it holds. Throws BadFile where it is damaged. O(bodies).
   * @param {number} i @param {Field[]} fields
   * @returns {Frame}
   */
  frame(i, fields) {
    return this.last(i, fields.filter(field => this.description.steps[i] % (this.#data.get(field)?.every ?? 1) === 0));
  }

  /**
   * What is known at frame i: of each field, which may have a rate of its own, the last that was recorded. Throws BadFile where that is
   * damaged. O(bodies).
   * @param {number} i @param {Field[]} fields
   * @returns {Frame}
   */
  last(i, fields) {
    /** @type {Frame} */
    const frame = {};
    for (const field of fields) {
      const values = this.#read(i, field);
      if (values) frame[field] = values;
    }
    return frame;
  }

  /** What was observed up to frame i, by description.observed; NaN where that isn't known. @param {number} i */
  observed(i) {
    return this.#observed?.at(this.description.steps[i]) ?? [];
  }

  /** Whom the body of this id sensed at frame i, by the first recorded sensor that it has; null where it has none. Throws BadFile. @param {number} i @param {number} id */
  sensed(i, id) {
    try {
      return this.#sensors?.found(id, this.description.steps[i]) ?? null;
    } catch (error) {
      throw error instanceof BadFile ? error : damaged("what sensors found can't be read");
    }
  }

  /** The last up to frame i: which sample, and which frame of the file that was. @param {number} i @param {number} every */
  #sample(i, every) {
    let known = this.#samples.get(every);
    if (!known) {
      let count = 0, last = 0;
      const sample = Int32Array.from(this.#steps, step => step % every === 0 ? count++ : count - 1);
      this.#samples.set(every, known = { sample, frame: Int32Array.from(this.#steps, (step, k) => step % every === 0 ? last = k : last) });
    }
    return { sample: known.sample[this.#chosen[i]], frame: known.frame[this.#chosen[i]] };
  }

  /** @param {number} i @param {Field} field */
  #read(i, field) {
    const data = this.#data.get(field), { count } = this.description.bodies;
    if (!data) return undefined;
    const { sample, frame } = this.#sample(i, data.every), rows = this.#presence?.rows(frame);
    let values;
    try {
      values = data.frame(sample, rows?.length ?? count, rows);
    } catch {
      throw damaged(`${field} of frame ${frame} can't be read`);
    }
    let sum = 0;
    for (let k = 0; k < values.length; ++k) sum += values[k] * 0;  // 0 unless one is not finite
    if (sum !== 0) throw damaged(`${field} of frame ${frame} holds what is no number`);
    return rows ? scatter(values, rows, count, WIDTH.get(field) ?? 1) : values;
  }
}
