// SPDX-License-Identifier: MIT
// The page of `throng motion` in Chromium: it shows the motion, asks nobody, and strangers' words are only text.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { browser, path, throng } from "./helper.mjs";

const MOTION = `motion = 1
name = "</script><script>window.broken = 1</script><b>&"
durations = [2.0, 2.0]
[shapes]
ball = { disc = { radius = 0.5 } }
rod = { segment = [[0, 0], [1, 0]], radius = 0.1 }
[[obstacles]]
name = "<img src=x onerror='window.broken = 1'>"
shape = "ball"
at = [6, 0]
[[bodies]]
name = "ball"
shape = "ball"
waypoints = [[0, 0], [2, 0], [6, 0]]
[[robots]]
name = "arm"
base = [1, 3, 1.5707963267948966]
links = [{ shape = "rod" }, { joint = "prismatic", at = [1, 0], shape = "rod" }]
waypoints = [[0, 0], [-1.5707963267948966, 0.5], [0, 0]]
`;

let chromium;
before(async () => { chromium = await browser(); });
after(() => chromium?.close());

test("the page shows the motion at any time, and nothing else happens", async () => {
  writeFileSync(path("m.toml"), MOTION);
  assert.equal(throng("motion", path("m.toml"), "--html", path("m.html")).status, 0);
  const context = await chromium.newContext(), page = await context.newPage(), requests = [], errors = [];
  page.on("request", request => requests.push(request.url()));
  page.on("pageerror", error => errors.push(error.message));
  page.on("console", message => errors.push(message.text()));
  await page.goto(`file://${path("m.html")}`);
  assert.equal(await page.textContent("#name"), "</script><script>window.broken = 1</script><b>&");
  assert.match(await page.textContent("#verdict"), /^hit: ball – <img src=x .* at 0.75 of segment 1, 3.5 s$/);
  assert.match(await page.textContent("#clock"), /^segment 1, 0.7500, 3.500 s$/);  // it begins at the contact
  assert.equal(await page.evaluate("window.broken"), undefined);

  // Half of the first segment: the ball has gone 1 m, the arm is turned by 45 degrees and out by a quarter.
  await page.evaluate("show(0.5)");
  assert.equal(await page.locator("#now path").count(), 3);
  const frames = await page.evaluate("given.movers.map(mover => place(mover, 0.5).at(-1))");
  const origin = await page.evaluate("given.movers[1].base");
  const ball = await page.evaluate("place(given.movers[0], 0).at(-1)");
  assert.ok(Math.abs(frames[0][0] - ball[0] - 1) < 1e-12);
  const along = 1.25 / Math.SQRT2;
  assert.ok(Math.abs(frames[1][0] - origin[0] - along) < 1e-12 && Math.abs(frames[1][1] - origin[1] - along) < 1e-12);
  assert.ok(Math.abs(frames[1][2] - Math.PI / 4) < 1e-12);

  await page.click("#jumps button");
  assert.match(await page.textContent("#clock"), /^segment 1, 0.7500/);
  await page.click("#play");
  await page.waitForFunction(() => playing === 0 && time === 2, null, { timeout: 20000 });  // two segments of 2 s
  assert.deepEqual(requests.filter(url => !/^file:/.test(url)), []);
  assert.deepEqual(errors, []);
  await context.close();
});

/** A page of its own, opened; errors of it are kept. */
async function visit(name, text, size = { width: 1100, height: 750 }) {
  writeFileSync(path(`${name}.toml`), text);
  assert.equal(throng("motion", path(`${name}.toml`), "--html", path(`${name}.html`)).status, 0);
  const context = await chromium.newContext({ viewport: size }), page = await context.newPage(), errors = [];
  page.on("pageerror", error => errors.push(error.message));
  await page.goto(`file://${path(`${name}.html`)}`);
  return { page, errors, done: () => context.close() };
}

test("it zooms at the pointer, is dragged, and obeys keys", async () => {
  const { page, errors, done } = await visit("keys", MOTION), box = await page.locator("#stage").boundingBox();
  const seen = () => page.evaluate(() => ({ ...view }));
  const place = (x, y) => page.evaluate(([x, y]) => under(x, y), [x, y]);
  const all = await seen(), at = [Math.round(box.x + 0.3 * box.width), Math.round(box.y + 0.6 * box.height)], before = await place(...at);
  await page.mouse.move(...at);
  await page.mouse.wheel(0, -400);
  await page.waitForFunction(w => view.w < 0.5 * w, all.w);
  for (const [k, value] of (await place(...at)).entries()) assert.ok(Math.abs(value - before[k]) < 1e-6 * all.w);
  await page.mouse.down();
  await page.mouse.move(at[0] + 90, at[1] - 40, { steps: 3 });
  await page.mouse.up();
  for (const [k, value] of (await place(at[0] + 90, at[1] - 40)).entries()) assert.ok(Math.abs(value - before[k]) < 1e-6 * all.w);
  await page.keyboard.press("0");
  assert.deepEqual(await seen(), all);
  await page.keyboard.press("+");
  assert.ok(Math.abs((await seen()).w * 1.25 / all.w - 1) < 1e-12);
  await page.keyboard.press("d");
  assert.ok((await seen()).x > all.x + 0.1 * all.w);

  const now = () => page.evaluate(() => time);
  await page.keyboard.press("Home");
  assert.equal(await now(), 0);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Shift+ArrowRight");
  assert.ok(Math.abs(await now() - 0.11) < 1e-12);
  await page.keyboard.press("PageDown");
  assert.equal(await now(), 1);
  await page.keyboard.press("PageDown");
  assert.equal(await now(), 2);
  await page.keyboard.press("n");
  assert.ok(Math.abs(await now() - 1.75) < 1e-9);
  await page.keyboard.press("PageUp");
  assert.equal(await now(), 1);
  await page.focus("#scrub");
  await page.keyboard.press(" ");
  await page.waitForFunction(() => playing !== 0 && time > 1.01);
  await page.keyboard.press(" ");
  assert.equal(await page.evaluate(() => playing), 0);
  await page.keyboard.press("?");
  assert.equal(await page.locator("#key-list dt").count(), await page.evaluate(() => keys.length));
  await page.keyboard.press("Escape");
  assert.deepEqual(errors, []);
  await done();
});

test("a mark keeps its size on the screen", async () => {
  const { page, done } = await visit("mark", MOTION), width = async () => (await page.locator("#contacts .mark").boundingBox()).width, before = await width();
  await page.evaluate(() => zoom(8, contacts[0].point[0], -contacts[0].point[1]));
  assert.ok(Math.abs(await width() / before - 1) < 0.2, `${before}, then ${await width()}`);
  await done();
});

const LONG = 400;
const ZIGZAG = `motion = 1
[shapes]
ball = { disc = { radius = 0.1 } }
post = { disc = { radius = 0.2 } }
[[obstacles]]
name = "post"
shape = "post"
at = [5, 4]
[[bodies]]
name = "ball"
shape = "ball"
waypoints = [${Array.from({ length: LONG + 1 }, (_, i) => `[${i / 40}, ${i % 2}, 0]`).join(", ")}]
`;

test("the timeline of a long path has few lines, and shows a segment of it in full", async () => {
  const { page, errors, done } = await visit("long", ZIGZAG);
  assert.equal(await page.evaluate(() => segments), LONG);
  const borders = () => page.evaluate(() => [...document.querySelector("#lanes svg").querySelectorAll(".border")].map(line => Number(line.getAttribute("x1"))));
  const width = await page.evaluate(() => rows[0].row.clientWidth), lines = await borders();
  assert.ok(lines.length > 10 && lines.length < width / 5, `${lines.length} borders in ${width} pixels`);
  assert.equal(await page.locator("#lanes .tick").count(), 0);  // 400 of them would be a bar
  const axis = await page.locator("#lanes .axis i").allTextContents();
  assert.ok(axis.length >= 4 && axis.length < 16 && axis[0] === "0", `${axis}`);
  const proven = await page.evaluate(() => [...document.querySelectorAll("#lanes .proven")].map(r => [Number(r.getAttribute("x")), Number(r.getAttribute("x")) + Number(r.getAttribute("width"))]));
  assert.ok(proven.length < width && proven[0][0] === 0 && proven.at(-1)[1] >= LONG, `${proven.length} strips`);
  for (let i = 1; i < proven.length; ++i) assert.ok(proven[i][0] <= proven[i - 1][1] + LONG / width, "all of it is proven free");

  await page.evaluate(() => show(123.4));
  await page.keyboard.press("z");
  assert.deepEqual(await page.evaluate(() => span), [123, 124]);
  assert.ok(await page.locator("#lanes svg").first().locator(".tick").count() >= 1);
  await page.keyboard.press("PageDown");
  await page.keyboard.press("ArrowRight");
  assert.deepEqual(await page.evaluate(() => span), [124, 125]);
  await page.keyboard.press("z");
  assert.deepEqual(await page.evaluate(() => span), [0, LONG]);
  const box = await page.locator("#lanes svg").first().boundingBox();
  await page.mouse.move(box.x + box.width / 4, box.y + 5);
  await page.mouse.wheel(0, -800);
  await page.waitForFunction(n => span[1] - span[0] < n / 2, LONG);
  const [from, to] = await page.evaluate(() => span);
  assert.ok(Math.abs(from + (to - from) / 4 - LONG / 4) < 0.01 * LONG, `${from} to ${to}`);
  assert.deepEqual(errors, []);
  await done();
});
