// SPDX-License-Identifier: MIT
// The page as people use it: opened from a file, without network, in Chromium.
import assert from "node:assert/strict";
import { copyFileSync, readFileSync, statSync, truncateSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { alter, browser, GAS, MIXED, path, record, throng } from "./helper.mjs";

const EVIL = MIXED.replace('name = "mixed"', 'name = "<script>document.title=1</script><img src=x onerror=document.title=2>"');

const AREAS = `throng = 1
name = "areas"
time = { dt = 0.01, until = 0.2 }
walkable = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))"
[areas]
start = "POLYGON ((0 0, 2 0, 2 5, 0 5, 0 0), (0.5 2, 1.5 2, 1.5 3, 0.5 3, 0.5 2))"
"<b>exit</b>" = [[9, 2], [10, 2], [10, 3], [9.5, 2.3], [9, 3]]
[shapes]
ball = { disc = { radius = 0.1 } }
[[bodies]]
shape = "ball"
at = [4, 1]
[[bodies]]
shape = "ball"
at = [6, 1]
`;

const LINE = `throng = 1
time = { dt = 0.01, until = 0.02 }
walkable = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))"
areas = { exit = [[9, 0], [10, 0], [10, 1], [9, 1]] }
[[agents]]
at = [1, 1]
model = "constant_velocity"
goal = "exit"
[[measure]]
name = "door"
line = [[6, 3], [6, 5]]
`;

let chromium;

before(async () => {
  chromium = await browser();
  record("mixed", MIXED);
  record("gas", GAS);
  record("large", MIXED, ["--until", "100"]);
  assert.equal(throng("replay", path("mixed.h5"), "--html", path("mixed.html")).status, 0);
  const large = throng("replay", path("large.h5"), "--html", path("large.html"));
  assert.equal(large.status, 0);
  assert.match(large.stderr, /large\.h5 is not inside .*large\.html: the page asks for it/);
});
after(() => chromium?.close());

/** Opens a page; every request and every error of it is kept. */
async function visit(name, { width = 1100, height = 750, dark = false, phone = false } = {}) {
  const context = await chromium.newContext({ viewport: { width, height }, colorScheme: dark ? "dark" : "light", hasTouch: phone, isMobile: phone, reducedMotion: "reduce" });
  const page = await context.newPage(), requests = [], errors = [];
  page.on("request", request => requests.push(request.url()));
  page.on("pageerror", error => errors.push(error.message));
  page.on("console", message => { if (message.type() === "error") errors.push(message.text()); });
  await page.goto(`file://${path(name)}`);
  return { page, requests, errors, done: () => context.close() };
}

/** Waits until a recording is shown, or until the error line says why not. */
const state = (page, wanted) => page.waitForFunction(s => document.body.dataset.state === s && (s !== "open" || globalThis.replay.shown !== null), wanted, { timeout: 60000 });
const text = (page, id) => page.textContent(`#${id}`);

/** The share of the picture that is not background. */
const drawn = page => page.evaluate(async () => {
  globalThis.replay.dirty = true;
  globalThis.replay.tick(0);
  const { gl, canvas } = globalThis.replay.stage, bytes = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  let other = 0;
  for (let i = 0; i < bytes.length; i += 4) other += bytes[i] !== bytes[0] || bytes[i + 1] !== bytes[1] || bytes[i + 2] !== bytes[2];
  return other / (bytes.length / 4);
});

test("a page opens from a file without network and shows its recording", async () => {
  const { page, requests, errors, done } = await visit("mixed.html");
  await state(page, "open");
  assert.equal(await text(page, "name"), "mixed");
  assert.match(await text(page, "about"), /a bit of everything · 151 bodies, 101 frames/);
  assert.match(await page.title(), /^mixed/);
  const share = await drawn(page);
  assert.ok(share > 0.02 && share < 0.6, `${share}`);
  assert.deepEqual(requests.filter(url => !/^(file|blob):/.test(url)), []);
  assert.deepEqual(errors, []);
  await page.waitForSelector("#curves[data-state=done]", { state: "attached" });
  assert.match(await text(page, "curves"), /Energy.*J.*Overlap.*m.*Counts/s);
  await done();
});

test("it plays, scrubs, and obeys keys", async () => {
  const { page, errors, done } = await visit("mixed.html");
  await state(page, "open");
  const frame = () => page.evaluate(() => globalThis.replay.player.frame);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Shift+ArrowRight");
  assert.equal(await frame(), 11);
  await page.waitForFunction(() => document.getElementById("frame").textContent === "step 11");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await frame(), 10);
  await page.keyboard.press("End");
  assert.equal(await frame(), 100);
  await page.keyboard.press("Home");
  for (let i = 0; i < 4; ++i) await page.keyboard.press("[");
  assert.equal(await page.inputValue("#speed"), "0.05");
  await page.keyboard.press(" ");
  await page.waitForFunction(() => globalThis.replay.player.frame > 1);
  await page.keyboard.press(" ");
  assert.equal(await page.evaluate(() => globalThis.replay.player.playing), false);
  await page.fill("#scrub", "60");
  assert.equal(await frame(), 60);
  await page.keyboard.press("]");
  assert.equal(await page.inputValue("#speed"), "0.1");
  const scale = () => page.evaluate(() => globalThis.replay.camera.scale), before = await scale();
  await page.keyboard.press("+");
  assert.ok(Math.abs(await scale() / before - 1.25) < 1e-9);
  await page.keyboard.press("0");
  assert.equal(await scale(), before);
  await page.keyboard.press("c");
  assert.equal(await page.inputValue("#colouring"), "shape");
  await page.keyboard.press("t");
  await page.keyboard.press("k");
  await page.waitForFunction(() => globalThis.replay.shown.a.contacts?.pairs.length > 0);
  await page.keyboard.press("?");
  assert.equal(await page.evaluate(() => document.getElementById("keys").open), true);
  await page.keyboard.press("Escape");
  assert.deepEqual(errors, []);
  await done();
});

test("the picture changes with time", async () => {
  const { page, done } = await visit("mixed.html");
  await state(page, "open");
  const first = await page.screenshot({ clip: { x: 0, y: 100, width: 700, height: 500 } });
  await page.keyboard.press("End");
  await page.waitForFunction(() => globalThis.replay.shown.frame === 100);
  await page.waitForTimeout(100);
  assert.notDeepEqual(await page.screenshot({ clip: { x: 0, y: 100, width: 700, height: 500 } }), first);
  await done();
});

test("a click picks a body, says what it is and whom it senses, and the camera follows it", async () => {
  const { page, errors, done } = await visit("mixed.html");
  await state(page, "open");
  const [x, y] = await page.evaluate(() => {
    const { camera, shown } = globalThis.replay, p = shown.a.values.position, box = document.getElementById("canvas").getBoundingClientRect();
    return [box.left + camera.width / 2 + (p[40] - camera.x) * camera.scale, box.top + camera.height / 2 - (p[41] - camera.y) * camera.scale];
  });
  await page.mouse.click(x, y);
  assert.equal(await page.inputValue("#pick"), "21");
  await page.waitForSelector("#body:not([hidden])");
  await page.waitForFunction(() => /spin/.test(document.getElementById("facts").textContent));
  assert.match(await text(page, "facts"), /shapeball.*radius.*cm.*place/s);
  assert.match(await text(page, "sensed"), /senses \d+: \d+ at/);
  await page.keyboard.press("f");
  await page.keyboard.press("End");
  await page.waitForFunction(() => globalThis.replay.shown.frame === 100);
  await page.waitForFunction(() => {
    const { camera, shown } = globalThis.replay, p = shown.a.values.position;
    return Math.abs(p[40] - camera.x) + Math.abs(p[41] - camera.y) < 1e-5;
  });
  await page.keyboard.press("Escape");
  assert.equal(await page.inputValue("#pick"), "");
  assert.deepEqual(errors, []);
  await done();
});

test("whom a recorded sensor found is shown instead of who is near", async () => {
  record("senses", `${MIXED}[[sensors]]\nname = "<b>eyes"\nradius = 3\nfov_degrees = 90\nevery = 5\nrecord = true\nof = { ids = [21, 22] }\n`);
  assert.equal(throng("replay", path("senses.h5"), "--html", path("senses.html")).status, 0);
  const { page, errors, done } = await visit("senses.html");
  await state(page, "open");
  const told = () => page.evaluate(() => ["radius-text", "sensed"].map(id => document.getElementById(id).textContent));
  const pick = async id => { await page.fill("#pick", String(id)); await page.keyboard.press("Enter"); };
  await pick(21);
  await page.waitForFunction(() => /by its sensor/.test(document.getElementById("radius-text").textContent));
  const [by, whom] = await told();
  assert.equal(by, "3 m, by its sensor <b>eyes");
  const asked = JSON.parse(throng("query", path("senses.h5"), "--radius", "3", "--id", "21", "--fov", "90", "--heading", "angle", "--at", "0", "--format", "json").stdout)[0].neighbours;
  assert.deepEqual(await page.evaluate(() => [...globalThis.replay.recorded.ids]), asked.map(({ id }) => id).sort((a, b) => a - b));
  assert.ok(asked.length > 3 && whom.startsWith(`senses ${asked.length}: `), `${asked.length} ${whom}`);
  assert.equal(await page.isVisible("#radius"), false);
  await page.evaluate(() => {
    const { source } = globalThis.replay, ask = source.sensed.bind(source);
    source.sensed = (...of) => new Promise(resolve => { globalThis.answer = async () => resolve(await ask(...of)); });
  });
  await pick(30);
  await page.waitForFunction(() => globalThis.answer && document.getElementById("sensed").textContent === "");
  assert.deepEqual(await told(), ["", ""], "not known yet");
  await page.evaluate(() => globalThis.answer());
  await page.waitForFunction(() => /senses/.test(document.getElementById("sensed").textContent));
  await page.waitForFunction(() => !/by its sensor/.test(document.getElementById("radius-text").textContent));
  assert.equal(await page.isVisible("#radius"), true);
  assert.deepEqual(errors, []);
  await done();
});

test("those whom a sensor found count though the recording leaves them out", async () => {
  record("few", `${MIXED}[[sensors]]\nname = "eyes"\nradius = 3\nevery = 5\nrecord = true\nof = { ids = [21] }\n`.replace('"spin"] }', '"spin"], of = { ids = [21, 22, 30] } }'));
  const found = JSON.parse(throng("query", path("few.toml"), "--radius", "3", "--id", "21", "--format", "json").stdout)[0].neighbours.length;
  assert.equal(throng("replay", path("few.h5"), "--html", path("few.html")).status, 0);
  const { page, errors, done } = await visit("few.html");
  await state(page, "open");
  await page.fill("#pick", "21");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /by its sensor/.test(document.getElementById("radius-text").textContent));
  const whom = await page.textContent("#sensed");
  assert.ok(found > 3 && whom.startsWith(`senses ${found}: `) && /not recorded$/.test(whom), `${found} ${whom}`);
  assert.deepEqual(errors, []);
  await done();
});

test("a large recording is asked for by name, and read where it lies", async () => {
  assert.ok(statSync(path("large.h5")).size > 64e6);
  const { page, requests, errors, done } = await visit("large.html");
  assert.match(await text(page, "ask-text"), /Drop large\.h5 here/);
  await page.setInputFiles("#file", path("large.h5"));
  await state(page, "open");
  await page.keyboard.press("End");
  await page.waitForFunction(() => globalThis.replay.shown.frame === globalThis.replay.description.times.length - 1);
  await page.setInputFiles("#file", path("gas.h5"));
  await page.waitForFunction(() => document.getElementById("name").textContent === "gas");
  await state(page, "open");
  assert.ok(await drawn(page) > 0.05);
  assert.deepEqual(requests.filter(url => !/^(file|blob):/.test(url)), []);
  assert.deepEqual(errors, []);
  await done();
});

test("what has a rate of its own is drawn as it was last, and says since when", async () => {
  record("turning", MIXED.replace(/record = .*/, 'record = { every = 2, fields = ["position"], also = [{ every = 3, fields = ["angle", "velocity"] }] }'));
  const { page, errors, done } = await visit("mixed.html");
  await page.setInputFiles("#file", path("turning.h5"));
  await page.waitForFunction(() => globalThis.replay?.description.times.length === 51);
  assert.match(await text(page, "about"), /51 of 68 frames: those that hold positions/);
  await page.fill("#pick", "70");
  await page.keyboard.press("Enter");
  await page.fill("#scrub", "32");
  await page.waitForFunction(() => globalThis.replay.shown?.frame === 32);
  await page.waitForFunction(() => document.getElementById("no-velocity").textContent === "No velocity in this frame: speeds are those of 0.63 s.");
  assert.equal(await page.isVisible("#no-velocity"), true);
  const [angle, drawn] = await page.evaluate(() => [globalThis.replay.shown.a.values.angle[69], globalThis.replay.stage.stateTexels[4 * 69 + 2]]);
  assert.ok(angle !== 0 && Math.abs(Math.sin(drawn - angle)) < 1e-6, `${angle}, drawn ${drawn}`);
  await page.waitForFunction(() => /velocity, at 0.63 s.*angle, at 0.63 s/s.test(document.getElementById("facts").textContent));
  await page.fill("#scrub", "33");
  await page.waitForFunction(() => /velocity(?!,).*angle(?!,)/s.test(document.getElementById("facts").textContent));
  assert.equal(await page.isVisible("#no-velocity"), false);
  await page.keyboard.press("Escape");
  await page.keyboard.press("k");
  await page.waitForFunction(() => globalThis.replay.shown.a.contacts?.pairs.length > 0);
  assert.equal(await page.isVisible("#no-contacts"), false);
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => globalThis.replay.shown.frame === 32);
  assert.equal(await page.evaluate(() => globalThis.replay.shown.a.contacts), undefined);
  await page.waitForSelector("#no-contacts:not([hidden])");
  assert.deepEqual(errors, []);
  await done();
});

test("bodies that come and go are drawn while they are there, and counted", async () => {
  record("region", MIXED, ["--set", "record.within=[[0, 0], [4, 4]]"]);
  const { page, errors, done } = await visit("mixed.html");
  await page.setInputFiles("#file", path("region.h5"));
  await page.waitForFunction(() => globalThis.replay?.description.bodies.changes);
  await page.selectOption("#trails", { index: 2 });
  await page.fill("#scrub", "100");
  await page.waitForFunction(() => globalThis.replay.shown?.frame === 100);
  const here = await page.evaluate(() => Array.from(globalThis.replay.shown.a.values.position).filter((x, i) => i % 2 === 0 && i > 0 && x === x).length);  // but the static one
  assert.ok(here > 20 && here < 120, `${here}`);
  const share = await drawn(page);
  assert.ok(share > 0.02 && share < 0.6, `${share}`);
  await page.waitForSelector("#curves[data-state=done]", { state: "attached" });
  await page.waitForFunction(n => document.getElementById("curves").textContent.includes(`here ${n}`), here);
  const gone = await page.evaluate(() => globalThis.replay.shown.a.values.position.findIndex(Number.isNaN) / 2 + 1);
  await page.fill("#pick", String(gone));
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /now.*not here/s.test(document.getElementById("facts").textContent));
  await page.keyboard.press("Escape");  // out of the field
  await page.keyboard.press("f");
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => globalThis.replay.shown?.frame === 99);
  assert.equal(await page.evaluate(() => globalThis.replay.following), true);
  assert.ok(Number.isFinite(await page.evaluate(() => globalThis.replay.camera.x)));
  assert.deepEqual(errors, []);
  await done();
});

test("agents are drawn with a line to where they walk, and without one where they stand", async () => {
  record("corridor", readFileSync(new URL("../../scenarios/corridor.toml", import.meta.url), "utf8"), ["--every", "10"]);
  const { page, errors, done } = await visit("mixed.html");
  await page.setInputFiles("#file", path("corridor.h5"));
  await page.waitForFunction(() => globalThis.replay?.walks && globalThis.replay.shown);
  assert.match(await text(page, "about"), /60 agents, 451 frames/);
  for (const [frame, walks] of [[0, false], [90, true]]) {
    await page.fill("#scrub", String(frame));
    await page.waitForFunction(i => globalThis.replay.shown.frame === i, frame);
    const [ahead, behind] = await page.evaluate(() => {
      const { replay } = globalThis, { camera, shown: { a: { values: { position: [x, y], velocity: [vx, vy] } } }, stage: { gl, canvas }, description: { bodies } } = replay;
      camera.fit([x - 1, y - 1, x + 1, y + 1]);
      replay.dirty = true;
      replay.tick(0);
      const ratio = canvas.width / camera.width, speed = Math.hypot(vx, vy), [ux, uy] = speed > 0 ? [vx / speed, vy / speed] : [1, 0];
      return [0.5, -0.5].map(part => {
        const bytes = new Uint8Array(4), [px, py] = camera.pixel(x + part * bodies.radius[0] * ux, y + part * bodies.radius[0] * uy);
        gl.readPixels(Math.round(px * ratio), canvas.height - Math.round(py * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        return String(bytes);
      });
    });
    assert.equal(ahead !== behind, walks, `${ahead} before, ${behind} behind it in frame ${frame}`);
  }
  assert.deepEqual(errors, []);
  await done();
});

/** What is painted at a place (m), RGB. */
const shadeOn = (page, x, y) => page.evaluate(([x, y]) => {
  const { stage: { gl, canvas }, camera } = globalThis.replay, [px, py] = camera.pixel(x, y), ratio = canvas.width / camera.width, bytes = new Uint8Array(4);
  globalThis.replay.dirty = true;
  globalThis.replay.tick(0);
  gl.readPixels(Math.round(px * ratio), canvas.height - Math.round(py * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  return [...bytes.subarray(0, 3)];
}, [x, y]);

test("measured lines are named, and an arrow goes to where they count forward", async () => {
  record("line", LINE);
  const { page, errors, done } = await visit("mixed.html");
  await page.setInputFiles("#file", path("line.h5"));
  await page.waitForFunction(() => globalThis.replay?.description.measuredLines.length === 1 && globalThis.replay.shown);
  await page.evaluate(() => { globalThis.replay.camera.fit([0, 0, 10, 5]); globalThis.replay.dirty = true; });
  await page.waitForSelector("#areas span.count");
  assert.deepEqual(await page.locator("#areas span:visible").allTextContents(), ["exit", "door"]);
  const pixel = await page.evaluate(() => 1 / globalThis.replay.camera.scale);
  assert.ok((await shadeOn(page, 6 + 9 * pixel, 4))[1] < 160);
  assert.deepEqual(await shadeOn(page, 6 - 9 * pixel, 4), [255, 255, 255]);
  assert.deepEqual(errors, []);
  await done();
});

test("areas are filled and named, and those who go together have a colour of their own", async () => {
  record("areas", AREAS);
  const { page, errors, done } = await visit("mixed.html");
  await page.setInputFiles("#file", path("areas.h5"));
  await page.waitForFunction(() => globalThis.replay?.description.areas.length === 2 && globalThis.replay.shown);
  await page.evaluate(() => { globalThis.replay.camera.fit([0, 0, 10, 5]); globalThis.replay.dirty = true; });
  await page.waitForSelector("#areas span.goal", { state: "detached" });  // nobody goes anywhere
  assert.deepEqual(await page.locator("#areas span:visible").allTextContents(), ["<b>exit</b>", "start"]);
  const shade = (x, y) => shadeOn(page, x, y);
  const [start, hole, notch, floor] = [await shade(1, 4.2), await shade(1, 2.5), await shade(9.5, 2.7), await shade(5, 4)];
  assert.deepEqual([hole, notch, floor], [[255, 255, 255], [255, 255, 255], [255, 255, 255]]);
  assert.ok(start[0] < 240 && start[2] > 245, `${start}`);
  assert.ok((await shade(9.2, 2.2))[0] < 240);
  await page.selectOption("#colouring", "group");
  assert.match(await text(page, "legend"), /ball 1.*ball 2/);
  await page.keyboard.press("g");
  await page.waitForFunction(() => [...document.querySelectorAll("#areas span")].every(label => label.hidden));
  assert.deepEqual(await shade(1, 4.2), [255, 255, 255]);
  assert.deepEqual(errors, []);
  await done();
});

test("damaged, foreign and unfinished files get their sentence, and the page stays usable", async () => {
  const { page, done } = await visit("mixed.html");
  await state(page, "open");
  const refuses = async (name, sentence) => {
    await page.setInputFiles("#file", path(name));
    await page.waitForFunction(n => !document.getElementById("error").hidden && document.getElementById("error").textContent.startsWith(n), name);
    assert.match(await text(page, "error"), sentence);
    assert.equal(await text(page, "name"), "mixed");
  };
  writeFileSync(path("text.h5"), "hello");
  await refuses("text.h5", /^text\.h5 is no HDF5 file/);
  copyFileSync(path("mixed.h5"), path("foreign.h5"));
  alter("foreign.h5", "del f['throng']");
  await refuses("foreign.h5", /is HDF5 but not a recording of throng/);
  copyFileSync(path("mixed.h5"), path("cut.h5"));
  truncateSync(path("cut.h5"), 200000);
  await refuses("cut.h5", /cut\.h5 is /);
  copyFileSync(path("mixed.h5"), path("wrong.h5"));
  alter("wrong.h5", "f['particles/trajectory/position/value'][0, 5, 0] = np.nan");
  await refuses("wrong.h5", /position of frame 0 holds what is no number/);
  copyFileSync(path("mixed.h5"), path("endless.h5"));
  alter("endless.h5", "f['throng/frames/frame_hash'].resize(2**40, axis=0)");
  await refuses("endless.h5", /frame_hash claims more than the file can hold/);
  await page.setInputFiles("#file", path("gas.h5"));
  await page.waitForFunction(() => document.getElementById("name").textContent === "gas" && document.getElementById("error").hidden);
  await done();
});

test("a frame that is damaged is told, and the others are shown", async () => {
  copyFileSync(path("mixed.h5"), path("hole.h5"));
  alter("hole.h5", "f['particles/trajectory/position/value'][50, 5, 0] = np.nan");
  const { page, done } = await visit("mixed.html");
  await page.setInputFiles("#file", path("hole.h5"));
  await state(page, "open");
  await page.fill("#scrub", "50");
  await page.waitForFunction(() => /frame 50 holds what is no number/.test(document.getElementById("error").textContent));
  await page.fill("#scrub", "60");
  await page.waitForFunction(() => globalThis.replay.shown.frame === 60);
  await done();
});

test("what a file says is shown as text and never obeyed", async () => {
  record("evil", EVIL);
  copyFileSync(path("evil.h5"), path("<b>evil<b>.h5"));
  assert.equal(throng("replay", path("<b>evil<b>.h5"), "--html", path("evil.html")).status, 0);
  const { page, done } = await visit("evil.html");
  await state(page, "open");
  assert.match(await text(page, "name"), /^<script>.*<img src=x/);
  assert.match(await page.title(), /^<script>/);
  assert.equal(await page.locator("img").count(), 0);
  await page.selectOption("#colouring", "shape");
  await page.setInputFiles("#file", path("text.h5"));
  await state(page, "failed");
  assert.equal(await page.locator("b:not(.names b)").count(), 0);
  const planted = await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "globalThis.planted = true";
    document.body.append(script);
    return globalThis.planted ?? "refused";
  });
  assert.equal(planted, "refused");
  await done();
});

test("a phone has the picture, the controls below, and the panel on demand", async () => {
  const { page, errors, done } = await visit("mixed.html", { width: 390, height: 800, dark: true, phone: true });
  await state(page, "open");
  assert.equal(await page.isVisible("#panel"), false);
  await page.tap("#panel-toggle");
  assert.equal(await page.isVisible("#panel"), true);
  await page.tap("#play");
  await page.waitForFunction(() => globalThis.replay.player.frame > 2);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} pixels wide`);
  for (const id of ["play", "back", "fit", "panel-toggle"]) {
    const { width, height } = await page.locator(`#${id}`).boundingBox();
    assert.ok(width >= 36 && height >= 36, `#${id} is ${width} by ${height}`);
  }
  assert.deepEqual(errors, []);
  await done();
});

