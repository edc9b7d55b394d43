// SPDX-License-Identifier: MIT
// The worker that reads a recording in place: {open} answers with its description, {frame} with a frame, or with whom a body sensed then, {scan} with points.
import h5wasm from "h5wasm";
import { ContactFinder, tellsContacts } from "../physics/contacts.js";
import { mount } from "./mount.js";
import { overview } from "./overview.js";
import { HEAD, modeFor, Recording } from "./recording.js";
import { scan } from "./scan.js";

/** @type {Recording} */
let recording;
/** @type {ContactFinder} */
let finder;

const ready = h5wasm.ready.then(h5 => { h5.activate_throwing_error_handler(); return h5; });
ready.then(() => postMessage({ ready: true }), error => postMessage({ error: `this browser can't run the reader: ${error}` }));

/** @param {{open?: Blob, ticket?: number, frame?: number, fields?: import("./recording.js").Field[], contacts?: boolean, sensed?: number, scan?: number}} order  sensed: an id */
async function obey({ open, ticket, frame, fields, contacts, sensed, scan: slow }) {
  const h5 = await ready;
  if (open) {
    const head = new Uint8Array(await open.slice(0, HEAD).arrayBuffer());
    recording = new Recording(h5wasm, mount(h5, open), modeFor(head), open.size);
    finder = new ContactFinder(recording.description);
    if (slow === undefined) postMessage({ description: recording.description, overview: overview(recording) });
  }
  if (frame !== undefined && sensed !== undefined) {
    postMessage({ ticket, values: {}, sensed: recording.sensed(frame, sensed) });
  } else if (frame !== undefined) {
    const values = recording.last(frame, fields ?? []), found = contacts && tellsContacts(recording.description, frame) ? finder.find(values) : undefined;
    const buffers = [...Object.values(values), ...(found ? [found.pairs, found.depths, found.deepest] : [])].map(array => array.buffer);
    postMessage({ ticket, values, contacts: found }, { transfer: buffers });
  }
  if (slow !== undefined) {
    let points = [], at = performance.now();
    for (const point of scan(recording, finder, slow)) {
      points.push(point);
      if (performance.now() - at < 150) continue;
      postMessage({ points });
      points = [];
      at = performance.now();
    }
    postMessage({ points, scanned: true });
  }
}

let queue = Promise.resolve();
onmessage = ({ data }) => {
  queue = queue.then(() => obey(data)).catch(error => postMessage({ error: error.message || String(error), ticket: data.ticket }));
};
