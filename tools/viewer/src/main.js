// SPDX-License-Identifier: MIT
// The replay page: opens what it was given or what people choose, and ties the parts of the page together.
import { Stage } from "./gl/stage.js";
import { Source } from "./reader/source.js";
import { Replay } from "./replay.js";
import { Charts } from "./ui/charts.js";
import { Controls } from "./ui/controls.js";
import { byId } from "./ui/dom.js";
import { bindFiles, embedded, readerUrl } from "./ui/file.js";

const given = JSON.parse(byId("given").textContent);  // name, bytes, embedded

/** @type {Promise<string>} */
const reader = readerUrl();
/** @type {Promise<Source> | null} */
let ready = null;  // a reader that waits for a file
/** @type {Source | null} */
let open = null;
let attempt = 0;
/** @type {Stage | null} */
let stage = null;
const controls = new Controls();

const nextSource = () => reader.then(url => new Source(url));

/** One line for people, as text. @param {string} text */
function say(text) {
  const line = byId("error");
  line.textContent = text;
  line.hidden = text === "";
}

/** Shows a recording; where it can't be shown, says why and leaves what was there. @param {Blob} blob @param {string} name */
async function show(blob, name) {
  const mine = ++attempt;
  say("");
  document.body.dataset.state = "opening";
  const coming = ready ?? nextSource();
  ready = null;  // at once: nobody else may take it
  const source = await coming;
  try {
    stage ??= new Stage(byId("canvas"));
    const opened = await source.open(blob);
    if (mine !== attempt) return source.close();
    open?.close();
    open = source;
    start(source, opened, blob, name);
  } catch (error) {
    source.close();
    if (mine !== attempt) return;
    say(`${name} ${/** @type {Error} */ (error).message}`);
    document.body.dataset.state = "failed";
    byId("ask").hidden = controls.replay !== null;
  }
  ready ??= nextSource();
}

/** @param {Source} source @param {import("./reader/source.js").Opened} opened @param {Blob} blob @param {string} name */
function start(source, opened, blob, name) {
  const { description, overview } = opened, slow = overview.topSpeed > 0 ? Number((0.05 * overview.topSpeed).toPrecision(1)) : 0;
  const replay = new Replay(source, opened, /** @type {Stage} */ (stage), error => say(`${name} ${error.message}`));
  const charts = new Charts(description, slow, time => controls.seek(time));
  byId("ask").hidden = true;
  controls.show(replay, charts);
  document.body.dataset.state = "open";
  Object.assign(globalThis, { replay });  // for tests and the curious
  source.scan(blob, slow, (points, done, error) => {
    if (replay !== controls.replay) return;
    charts.add(points);
    if (error) say(`${name} ${error}`);
    if (done) byId("curves").dataset.state = "done";
  });
}

/** Asks for the recording that this page was written for, or any. */
function ask() {
  byId("ask").hidden = false;
  byId("ask-text").textContent = given.name ? `Drop ${given.name} here, or choose it: it is too large to be part of this page.` : "Drop a recording of throng here, or choose one.";
}

bindFiles(file => show(file, file.name));
// The recording stands last in the page: the reader starts while it is still coming.
ready = nextSource();
if (given.embedded) addEventListener("DOMContentLoaded", () => show(embedded(), given.name)); else ask();
