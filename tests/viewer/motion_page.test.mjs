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
