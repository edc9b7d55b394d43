// SPDX-License-Identifier: MIT
// The reader's workers, seen from the page: one gives frames, one the curves.

/**
 * @typedef {{description: import("./recording.js").Description, overview: import("./overview.js").Overview}} Opened
 * @typedef {{values: import("./recording.js").Frame, contacts?: import("../physics/contacts.js").Contacts, sensed?: import("./sensors.js").Found | null}} Loaded
 * @typedef {{ticket: number, frame: number, fields?: import("./recording.js").Field[], contacts?: boolean, sensed?: number}} Order
 */

const PATIENCE = 30000;  // ms without an answer after which a file counts as damaged: HDF5 may wait for ever
const LATE = "can't be read: it seems to be damaged";

export class Source {
  #worker;
  #scanner = /** @type {Worker | null} */ (null);
  #blob = /** @type {Blob | null} */ (null);
  #opening = /** @type {{resolve: (opened: Opened) => void, reject: (error: Error) => void} | null} */ (null);
  #waiting = /** @type {Map<number, {order: Order, resolve: (loaded: Loaded) => void, reject: (error: Error) => void}>} */ (new Map());  // by ticket
  #ticket = 0;
  #watch = 0;  // runs out where an answer is due and the worker says nothing
  #scanWatch = 0;
  #closed = false;

  /** Starts the reader, so that it is ready when a file comes. @param {string} url  of the worker's code @param {number} [patience]  ms */
  constructor(url, patience = PATIENCE) {
    this.url = url;
    this.patience = patience;
    this.#worker = this.#start();
  }

  #start() {
    const worker = new Worker(this.url);
    worker.onerror = event => this.#opening?.reject(new Error(`can't be read: ${event.message}`));
    worker.onmessage = ({ data }) => this.#hear(data);
    return worker;
  }

  /** Rejects with a sentence where the file can't be shown. @param {Blob} blob @returns {Promise<Opened>} */
  open(blob) {
    this.#blob = blob;
    return new Promise((resolve, reject) => {
      this.#opening = { resolve, reject };
      this.#worker.postMessage({ open: blob });
      this.#expect();
    });
  }

  /** @param {any} data */
  #hear(data) {
    if (data.ticket !== undefined) this.#answer(data);
    else if (data.description) this.#opening?.resolve(data);
    else if (data.error) this.#opening?.reject(new Error(data.error));
    if (data.description || (data.error && data.ticket === undefined)) this.#opening = null;
    this.#expect();
  }

  /** Whoever waits, waits from now on, and not for ever. */
  #expect() {
    clearTimeout(this.#watch);
    if (!this.#closed && (this.#opening || this.#waiting.size)) this.#watch = setTimeout(() => this.#giveUp(), this.patience);
  }

  /** What the worker is stuck in is given up; another one goes on with the rest. */
  #giveUp() {
    const [stuck] = this.#waiting.values();
    this.#worker.terminate();
    this.#worker = this.#start();
    if (this.#opening) { this.#opening.reject(new Error(LATE)); this.#opening = null; return; }
    this.#worker.postMessage({ open: this.#blob });
    this.#answer({ ticket: stuck.order.ticket, error: `${LATE}, in frame ${stuck.order.frame}` });
    for (const { order } of this.#waiting.values()) this.#worker.postMessage(order);
    this.#expect();
  }

  /** @param {{ticket: number, error?: string, values?: import("./recording.js").Frame, contacts?: import("../physics/contacts.js").Contacts,
   *   sensed?: import("./sensors.js").Found | null}} data */
  #answer({ ticket, error, values, contacts, sensed }) {
    const waiting = this.#waiting.get(ticket);
    this.#waiting.delete(ticket);
    if (error || !values) waiting?.reject(new Error(error)); else waiting?.resolve({ values, contacts, sensed });
  }

  /** @param {number} frame @param {import("./recording.js").Field[]} fields @param {boolean} contacts @returns {Promise<Loaded>} */
  frame(frame, fields, contacts) {
    return this.#ask({ ticket: ++this.#ticket, frame, fields, contacts });
  }

  /** Whom a recorded sensor of the body of this id found; null where there is none. @param {number} frame @param {number} id */
  async sensed(frame, id) {
    return (await this.#ask({ ticket: ++this.#ticket, frame, sensed: id })).sensed ?? null;
  }

  /** @param {Order} order @returns {Promise<Loaded>} */
  #ask(order) {
    return new Promise((resolve, reject) => {
      this.#waiting.set(order.ticket, { order, resolve, reject });
      this.#worker.postMessage(order);
      this.#expect();
    });
  }

  /** Points of the curves as they come, from a second worker. @param {Blob} blob @param {number} slow @param {(points: import("./scan.js").Point[], done: boolean, error?: string) => void} take */
  scan(blob, slow, take) {
    const scanner = this.#scanner = new Worker(this.url);
    const late = () => { scanner.terminate(); take([], true, LATE); };
    this.#scanWatch = setTimeout(late, this.patience);
    scanner.onmessage = ({ data }) => {
      if (this.#closed) return;
      clearTimeout(this.#scanWatch);
      if (data.points || data.error) take(data.points ?? [], Boolean(data.scanned || data.error), data.error);
      if (data.scanned || data.error) scanner.terminate(); else this.#scanWatch = setTimeout(late, this.patience);
    };
    scanner.postMessage({ open: blob, scan: slow });
  }

  /** What was asked, or still is, gets no answer. */
  close() {
    this.#closed = true;
    clearTimeout(this.#watch);
    clearTimeout(this.#scanWatch);
    this.#worker.terminate();
    this.#scanner?.terminate();
  }
}
