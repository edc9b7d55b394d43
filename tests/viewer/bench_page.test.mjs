// SPDX-License-Identifier: MIT
// How long the page takes, in Chromium without a window or a graphics card: to open, from frame to frame, by key and playing. As a
// test it is small and asserts what holds on any machine; THRONG_FULL=1 node --test tests/viewer/bench_page.test.mjs prints the figures
// of the case that the page is made for, 50,000 discs, or discs and polygons, in 160 MB.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { after, before, test } from "node:test";
import { gzipSync } from "node:zlib";
import { browser, path, record, throng } from "./helper.mjs";

const FULL = Boolean(process.env.THRONG_FULL), BODIES = FULL ? 50000 : 2000, FRAMES = FULL ? 80 : 10, ROUNDS = FULL ? 5 : 2, SIDE = Math.sqrt(BODIES);

const scene = (bodies, frames, shapes = ["ball", "brick"]) => `throng = 1
name = "figures"
time = { dt = 0.01, until = ${frames / 100}, substeps = 1 }
domain = { box = [[0, 0], [${SIDE}, ${SIDE}]] }
contact = { model = "none" }
record = { fields = ["position", "angle", "velocity"] }
[shapes]
ball = { disc = { radius = 0.3 } }
brick = { polygon = [[0, 0], [0.5, 0], [0.7, 0.2], [0.5, 0.4], [0, 0.4]] }
${shapes.map(shape => `[[bodies]]
shape = "${shape}"
count = ${bodies / shapes.length}
place = { random = { within = [[0, 0], [${SIDE}, ${SIDE}]] } }
velocity = { maxwell = 1.0 }
spin = 1.0
`).join("")}`;

let chromium;
const rows = /** @type {string[][]} */ ([]);
const spread = times => { const sorted = times.slice().sort((a, b) => a - b); return { least: sorted[0], median: sorted[sorted.length >> 1] }; };
const tell = (what, { least, median }) => {
  rows.push([what, least.toFixed(1), median.toFixed(1)]);
  if (FULL) console.log(rows.at(-1)?.join("  "));  // the whole takes minutes
};

before(async () => {
  chromium = await browser();
  record("figures", scene(BODIES, FRAMES));
  if (FULL) record("discs", scene(BODIES, FRAMES, ["ball"]));
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

for (const [name, what] of FULL ? [["figures", "discs and polygons"], ["discs", "discs"]] : [["figures", "discs and polygons"]])
  test(`a recording of ${what} opens where it lies, and goes from frame to frame`, async () => {
    const times = [];
    for (let k = 0; k < ROUNDS; ++k) {
      const { page, done } = await blank(FULL ? "figures.html" : "few.html");
      if (!FULL) await shown(page);
      const start = performance.now();
      await page.evaluate(() => { document.body.dataset.state = "waiting"; });
      await page.setInputFiles("#file", path(`${name}.h5`));
      await shown(page);
      times.push(performance.now() - start);
      if (k === ROUNDS - 1) await steps(page, what);
      await done();
    }
    tell(`${what}, ${(statSync(path(`${name}.h5`)).size / 1e6).toFixed(0)} MB: open, first frame, ms`, spread(times));
  });

/** What a frame takes that was not at hand, one that a key asks for, one at hand; then playing. @param {any} page @param {string} what */
async function steps(page, what) {
  await page.waitForSelector("#curves[data-state=done]", { state: "attached", timeout: 120000 });
  await page.evaluate(() => {
    const { replay } = globalThis, { stage: { gl }, frames: held } = replay, { arrived } = held;
    const pause = ms => new Promise(resolve => setTimeout(resolve, ms));
    globalThis.bench = {
      pause,
      painted: () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)),  // waits for the picture
      /** Until the frame is handed to be drawn, ms, from when `ask` asks for it. */
      until: async (frame, ask) => {
        const start = performance.now();
        ask();
        replay.tick(0);
        while (!held.has(frame)) await new Promise(resolve => { held.arrived = () => { arrived(); resolve(0); }; });
        held.arrived = arrived;
        if (replay.shown.frame !== frame) { replay.dirty = true; replay.tick(0); }
        const took = performance.now() - start;
        globalThis.bench.painted();  // the picture is not to hold the next one up,
        await pause(100);            // nor are frames that are loaded ahead
        return took;
      },
    };
    held.limit = 30e6;  // of what was seen little is kept
  });
  tell(`${what}: a frame not at hand, until it is handed to be drawn, ms`, spread(await page.evaluate(async frames => {
    const { replay, bench } = globalThis, times = [];
    for (let i = 2; i < frames; i += 4) times.push(await bench.until(i, () => replay.player.stand(i)));  // nor next to one that was
    return times;
  }, FRAMES)));
  tell(`${what}: a key to the next frame, until it is handed to be drawn, ms`, spread(await page.evaluate(async frames => {
    const { replay, bench } = globalThis, times = [];
    replay.player.stand(0);
    await bench.pause(500);
    for (let i = 1; i < Math.min(frames, 30); ++i)
      times.push(await bench.until(i, () => document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }))));
    return times;
  }, FRAMES)));
  tell(`${what}: frames read and decoded one after the other, ms`, spread(await page.evaluate(async frames => {
    const { source, frames: { fields, contacts } } = globalThis.replay, times = [];
    for (let i = 0; i < frames; ++i) {
      const start = performance.now();
      await source.frame(i, fields, contacts);
      times.push(performance.now() - start);
    }
    return times;
  }, FRAMES)));
  const own = await page.evaluate(async () => {
    const { replay, bench } = globalThis, own = [], paint = [];
    for (const i of [0, 1]) await bench.until(i, () => replay.player.stand(i));
    for (let i = 0; i < 20; ++i) {
      replay.player.stand(i % 2);
      replay.dirty = true;
      const start = performance.now();
      replay.tick(0);
      const submitted = performance.now();
      bench.painted();
      own.push(submitted - start);
      paint.push(performance.now() - submitted);
    }
    return { own, paint };
  });
  tell(`${what}: a frame at hand, the page's own work, ms`, spread(own.own));
  tell(`${what}: its picture, without a graphics card, ms`, spread(own.paint));
  const playing = (/** @type {boolean} */ pictures) => page.evaluate(async ({ pictures, seconds }) => {
    const { replay } = globalThis, { player, stage } = replay, gaps = [];
    if (!pictures) stage.clear = stage.draw = () => {};  // what a graphics card would do beside
    player.seek(player.first);
    player.loop = true;
    player.speed = 60 * (player.last - player.first) / (player.times.length - 1);  // a frame each time that the screen is drawn anew
    player.play(true);
    for (let start = performance.now(), last = start, frame = -1; gaps.length < 2 || performance.now() < start + 1000 * seconds;) {
      await new Promise(requestAnimationFrame);
      if (replay.shown.frame === frame) continue;
      const now = performance.now();
      if (frame >= 0) gaps.push(now - last);
      last = now;
      ({ frame } = replay.shown);
    }
    player.play(false);
    return gaps;
  }, { pictures, seconds: FULL ? 4 : 1 });
  tell(`${what}: playing, from frame to frame, ms`, spread(await playing(true)));
  tell(`${what}: the same without the picture, ms`, spread(await playing(false)));
  assert.ok(spread(own.own).median < (FULL ? 16 : 100));
}

test("the figures are told", () => {
  const width = Math.max(...rows.map(([what]) => what.length));
  console.log(`${BODIES} bodies, the picture by the processor\n${"".padEnd(width)}   least  median`);
  for (const [what, ...numbers] of rows) console.log(`${what.padEnd(width)} ${numbers.map(number => number.padStart(7)).join(" ")}`);
  assert.equal(rows.length, FULL ? 18 : 10);
});
