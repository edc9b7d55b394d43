// SPDX-License-Identifier: MIT
// How long the page takes, in Chromium without a window or a graphics card: to open, from frame to frame, playing. As a test it is
// small and asserts what holds on any machine; THRONG_FULL=1 node --test tests/viewer/bench_page.test.mjs prints the figures of the
// case that the page is made for, 50,000 discs and polygons in 160 MB.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { after, before, test } from "node:test";
import { gzipSync } from "node:zlib";
import { browser, path, record, throng } from "./helper.mjs";

const FULL = Boolean(process.env.THRONG_FULL), BODIES = FULL ? 50000 : 2000, FRAMES = FULL ? 80 : 10, ROUNDS = FULL ? 5 : 2, SIDE = Math.sqrt(BODIES);

const scene = (bodies, frames) => `throng = 1
name = "figures"
time = { dt = 0.01, until = ${frames / 100}, substeps = 1 }
domain = { box = [[0, 0], [${SIDE}, ${SIDE}]] }
contact = { model = "none" }
record = { fields = ["position", "angle", "velocity"] }
[shapes]
ball = { disc = { radius = 0.3 } }
brick = { polygon = [[0, 0], [0.5, 0], [0.7, 0.2], [0.5, 0.4], [0, 0.4]] }
${["ball", "brick"].map(shape => `[[bodies]]
shape = "${shape}"
count = ${bodies / 2}
place = { random = { within = [[0, 0], [${SIDE}, ${SIDE}]] } }
velocity = { maxwell = 1.0 }
spin = 1.0
`).join("")}`;

let chromium;
const rows = /** @type {string[][]} */ ([]);
const spread = times => { const sorted = times.slice().sort((a, b) => a - b); return { least: sorted[0], median: sorted[sorted.length >> 1] }; };
const tell = (what, { least, median }) => rows.push([what, least.toFixed(1), median.toFixed(1)]);

before(async () => {
  chromium = await browser();
  record("figures", scene(BODIES, FRAMES));
  record("few", scene(BODIES, Math.max(2, FRAMES / 4)));
  for (const name of ["figures", "few"]) assert.equal(throng("replay", path(`${name}.h5`), "--html", path(`${name}.html`)).status, 0);
});
after(() => chromium?.close());

async function blank(name) {
  const context = await chromium.newContext({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce" }), page = await context.newPage(), start = performance.now();
  await page.goto(`file://${path(name)}`);
  return { page, start, done: () => context.close() };
}

const shown = page => page.waitForFunction(() => document.body.dataset.state === "open" && globalThis.replay.shown, null, { timeout: 60000 });

test("the page is small", async () => {
  record("two", scene(2, 2));
  throng("replay", path("two.h5"), "--html", path("two.html"));
  const page = readFileSync(path("two.html")), bytes = page.length - 4 / 3 * statSync(path("two.h5")).size;
  rows.push(["page without recording, kB; compressed", (bytes / 1e3).toFixed(0), (gzipSync(page).length / 1e3).toFixed(0)]);
  assert.ok(bytes < 2.5e6, `${bytes} bytes`);
});

test("a page that holds its recording opens", async () => {
  const times = [];
  for (let k = 0; k < ROUNDS; ++k) {
    const { page, start, done } = await blank("few.html");
    await shown(page);
    times.push(performance.now() - start);
    await done();
  }
  tell(`page with ${(statSync(path("few.h5")).size / 1e6).toFixed(0)} MB in it: open, first frame, ms`, spread(times));
});

test("a recording opens where it lies, and goes from frame to frame", async () => {
  const times = [];
  for (let k = 0; k < ROUNDS; ++k) {
    const { page, done } = await blank(FULL ? "figures.html" : "few.html");
    if (!FULL) await shown(page);
    const start = performance.now();
    await page.evaluate(() => { document.body.dataset.state = "waiting"; });
    await page.setInputFiles("#file", path("figures.h5"));
    await shown(page);
    times.push(performance.now() - start);
    if (k === ROUNDS - 1) await steps(page);
    await done();
  }
  tell(`recording of ${(statSync(path("figures.h5")).size / 1e6).toFixed(0)} MB: open, first frame, ms`, spread(times));
});

/** One frame on: read, until it is drawn. Then what the page's own part of that is, all frames at hand, and playing. @param {any} page */
async function steps(page) {
  await page.waitForSelector("#curves[data-state=done]", { state: "attached", timeout: 120000 });
  const read = await page.evaluate(async frames => {
    const { replay } = globalThis, { gl } = replay.stage, { frames: held } = replay, { arrived } = held, times = [];
    for (let i = 2; i < frames; i += 3) {  // neither at hand nor next to one that is
      const start = performance.now();
      replay.player.stand(i);
      replay.tick(0);  // asks for it
      while (!held.has(i)) await new Promise(resolve => { held.arrived = () => { arrived(); resolve(0); }; });
      replay.dirty = true;
      replay.tick(0);
      times.push(performance.now() - start);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // the picture is not to hold the next one up
      await new Promise(resolve => setTimeout(resolve, 100));  // nor are frames that are loaded ahead
    }
    held.arrived = arrived;
    return times;
  }, FRAMES);
  tell("one frame on, from the file until it is handed to be drawn, ms", spread(read));
  const own = await page.evaluate(async frames => {
    const { replay } = globalThis, { gl } = replay.stage, own = [], paint = [];
    for (let i = 0; i < frames; ++i) {
      replay.player.stand(i % 2);
      replay.dirty = true;
      const start = performance.now();
      replay.tick(0);
      const submitted = performance.now();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for the picture
      own.push(submitted - start);
      paint.push(performance.now() - submitted);
    }
    return { own, paint };
  }, 40);
  tell("a frame at hand: the page's own work, ms", spread(own.own));
  tell("a frame at hand: the picture, without a graphics card, ms", spread(own.paint));
  const played = await page.evaluate(() => new Promise(resolve => {
    const { replay } = globalThis, { player, stats } = replay, first = stats.frames, start = performance.now();
    player.seek(player.first);
    player.loop = true;
    player.speed = 0.3;
    player.play(true);
    setTimeout(() => { player.play(false); resolve((stats.frames - first) / (performance.now() - start) * 1000); }, 4000);
  }));
  rows.push(["playing, frames a second", "", played.toFixed(1)]);
  assert.ok(spread(own.own).median < (FULL ? 16 : 100) && played > 0);
}

test("the figures are told", () => {
  const width = Math.max(...rows.map(([what]) => what.length));
  console.log(`${BODIES} bodies, ${(statSync(path("figures.h5")).size / 1e6).toFixed(1)} MB; the picture by the processor\n${"".padEnd(width)}   least  median`);
  for (const [what, ...numbers] of rows) console.log(`${what.padEnd(width)} ${numbers.map(number => number.padStart(7)).join(" ")}`);
  assert.equal(rows.length, 7);
});
