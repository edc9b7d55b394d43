// SPDX-License-Identifier: MIT
// The frames at hand: those wanted are loaded in their order, those used longest ago are forgotten.

/** @typedef {import("../reader/source.js").Loaded} Loaded */

const IN_FLIGHT = 2, LEAST = 3;

/** @param {Loaded} loaded */
function bytesOf({ values, contacts }) {
  let bytes = 0;
  for (const array of Object.values(values)) bytes += array.byteLength;
  return bytes + (contacts ? contacts.pairs.byteLength + contacts.depths.byteLength + contacts.deepest.byteLength : 0);
}

export class Frames {
  #held = /** @type {Map<number, Loaded>} */ (new Map());  // used last stands last
  #wanted = /** @type {number[]} */ ([]);
  #flying = new Set();
  #bytes = 0;
  #generation = 0;
  fields = /** @type {import("../reader/recording.js").Field[]} */ ([]);
  contacts = false;

  /**
   * @param {(frame: number, fields: import("../reader/recording.js").Field[], contacts: boolean) => Promise<Loaded>} load
   * @param {() => void} arrived @param {(error: Error) => void} failed @param {number} limit  bytes
   */
  constructor(load, arrived, failed, limit) {
    this.load = load;
    this.arrived = arrived;
    this.failed = failed;
    this.limit = limit;
  }

  /** What frames must hold from now on; those that hold less are forgotten. @param {import("../reader/recording.js").Field[]} fields @param {boolean} contacts */
  need(fields, contacts) {
    const enough = fields.every(field => this.fields.includes(field)) && (this.contacts || !contacts);
    this.fields = fields;
    this.contacts = contacts;
    if (enough) return;
    this.#held.clear();
    this.#bytes = 0;
    ++this.#generation;
    this.#flying.clear();
    this.want(this.#wanted);
  }

  /** @param {number} frame */
  get(frame) {
    const loaded = this.#held.get(frame);
    if (loaded) { this.#held.delete(frame); this.#held.set(frame, loaded); }
    return loaded;
  }

  /** @param {number} frame */
  has(frame) { return this.#held.has(frame); }

  /** These are wanted now, the first most; earlier wishes are off. Of more than there is memory for, the first. @param {number[]} frames */
  want(frames) {
    const fit = this.#held.size ? Math.floor(this.limit / (this.#bytes / this.#held.size)) : frames.length;
    this.#wanted = frames.slice(0, Math.max(LEAST, fit));
    for (const frame of this.#wanted) {
      if (this.#flying.size >= IN_FLIGHT) return;
      if (!this.#held.has(frame) && !this.#flying.has(frame)) this.#fetch(frame);
    }
  }

  /** @param {number} frame */
  #fetch(frame) {
    const generation = this.#generation;
    this.#flying.add(frame);
    this.load(frame, this.fields, this.contacts).then(loaded => {
      if (generation !== this.#generation) return;
      this.#flying.delete(frame);
      this.#keep(frame, loaded);
      this.want(this.#wanted);
      this.arrived();
    }, error => {
      if (generation !== this.#generation) return;
      this.#flying.delete(frame);
      this.failed(error);
    });
  }

  /** @param {number} frame @param {Loaded} loaded */
  #keep(frame, loaded) {
    this.#held.set(frame, loaded);
    this.#bytes += bytesOf(loaded);
    for (const oldest of this.#held.keys()) {
      if (this.#bytes <= this.limit) break;
      if (!this.#wanted.includes(oldest)) this.#forget(oldest);
    }
  }

  /** @param {number} frame */
  #forget(frame) {
    const old = this.#held.get(frame);
    this.#held.delete(frame);
    if (old) this.#bytes -= bytesOf(old);
  }
}
