// SPDX-License-Identifier: MIT
// The reader's workers, seen from the page: one gives frames, one the curves.

/**
 * @typedef {{description: import("./recording.js").Description, overview: import("./overview.js").Overview}} Opened
 * @typedef {{values: import("./recording.js").Frame, contacts?: import("../physics/contacts.js").Contacts}} Loaded
 */

const PATIENCE = 30000;  // ms without an answer after which a file counts as damaged: HDF5 may wait for ever

/** Rejects once patience is over. @template T @param {Promise<T>} promise @returns {Promise<T>} */
function patient(promise) {
  let timer = 0;
  const late = new Promise((_, reject) => { timer = setTimeout(() => reject(new Error("can't be read: it seems to be damaged")), PATIENCE); });
  return Promise.race([promise, /** @type {Promise<T>} */ (late)]).finally(() => clearTimeout(timer));
}

export class Source {
  #worker;
  #scanner = /** @type {Worker | null} */ (null);
  #waiting = /** @type {Map<number, {resolve: (loaded: Loaded) => void, reject: (error: Error) => void}>} */ (new Map());

  /** Starts the reader, so that it is ready when a file comes. @param {string} url  of the worker's code */
  constructor(url) {
    this.url = url;
    this.#worker = new Worker(url);
  }

  /** Rejects with a sentence where the file can't be shown. @param {Blob} blob @returns {Promise<Opened>} */
  open(blob) {
    return patient(new Promise((resolve, reject) => {
      this.#worker.onerror = event => reject(new Error(`can't be read: ${event.message}`));
      this.#worker.onmessage = ({ data }) => {
        if (data.description) resolve(data);
        else if (data.frame !== undefined) this.#answer(data);
        else if (data.error) reject(new Error(data.error));
      };
      this.#worker.postMessage({ open: blob });
    }));
  }

  /** @param {{frame: number, error?: string} & Loaded} data */
  #answer({ frame, error, values, contacts }) {
    const waiting = this.#waiting.get(frame);
    this.#waiting.delete(frame);
    if (error) waiting?.reject(new Error(error)); else waiting?.resolve({ values, contacts });
  }

  /** @param {number} frame @param {import("./recording.js").Field[]} fields @param {boolean} contacts @returns {Promise<Loaded>} */
  frame(frame, fields, contacts) {
    return patient(new Promise((resolve, reject) => {
      this.#waiting.set(frame, { resolve, reject });
      this.#worker.postMessage({ frame, fields, contacts });
    }));
  }

  /** Points of the curves as they come, from a second worker. @param {Blob} blob @param {number} slow @param {(points: import("./scan.js").Point[], done: boolean, error?: string) => void} take */
  scan(blob, slow, take) {
    this.#scanner = new Worker(this.url);
    this.#scanner.onmessage = ({ data }) => {
      if (data.points || data.error) take(data.points ?? [], Boolean(data.scanned || data.error), data.error);
      if (data.scanned || data.error) this.#scanner?.terminate();
    };
    this.#scanner.postMessage({ open: blob, scan: slow });
  }

  close() {
    this.#worker.terminate();
    this.#scanner?.terminate();
  }
}
