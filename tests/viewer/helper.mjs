// SPDX-License-Identifier: MIT
// What the viewer's tests share: the program, scenes, recordings in a folder that goes with the test, a browser.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";
import { HEAD, modeFor, Recording } from "../../tools/viewer/src/reader/recording.js";

export const program = process.env.THRONG_PROGRAM ?? new URL("../../build/release/throng", import.meta.url).pathname;
export const folder = mkdtempSync(join(tmpdir(), "throng-viewer-"));
after(() => rmSync(folder, { recursive: true, force: true }));

/** @param {string} name */
export const path = name => join(folder, name);

/** Stars, bricks, discs and composites fall on a peg and a wall. */
export const MIXED = `throng = 1
name = "mixed"
description = "a bit of everything"
gravity = [0.0, -9.81]
time = { dt = 0.01, until = 1.0, substeps = 4 }
domain = { box = [[0, 0], [8, 12]] }
record = { fields = ["position", "angle", "velocity", "spin"] }
[materials.default]
density = 2.0
restitution = 0.1
[materials.rubber]
restitution = 0.6
[shapes]
ball = { disc = { radius = { uniform = [0.15, 0.25] } } }
brick = { polygon = [[0, 0], [0.5, 0], [0.5, 0.3], [0, 0.3]] }
star = { polygon = [[0, 0.31], [-0.0764, 0.105], [-0.295, 0.0958], [-0.1236, -0.04], [-0.182, -0.25], [0, -0.13], [0.182, -0.25], [0.1236, -0.04], [0.295, 0.0958], [0.0764, 0.105]] }
dumbbell = { discs = [[-0.2, 0, 0.14], [0.2, 0, 0.1]] }
[[bodies]]
shape = "ball"
at = [4, 1.5]
kind = "static"
[[bodies]]
shape = "ball"
count = 60
place = { random = { within = [[0, 0.1], [8, 9]], gap = 0.01 } }
[[bodies]]
shape = "brick"
count = 40
place = { random = { within = [[0, 0.1], [8, 9]], gap = 0.01 } }
material = "rubber"
[[bodies]]
shape = "star"
count = 30
place = { random = { within = [[0, 0.1], [8, 9]], gap = 0.01 } }
[[bodies]]
shape = "dumbbell"
count = 20
place = { random = { within = [[0, 0.1], [8, 9]], gap = 0.01 } }
[[walls]]
polyline = [[0, 3], [2, 2], [3, 2]]
`;

/** Discs and bricks pass through one another in a periodic square. */
export const GAS = `throng = 1
name = "gas"
time = { dt = 0.005, until = 0.5, substeps = 2 }
domain = { periodic = [[-2, -2], [2, 2]] }
contact = { model = "none" }
[shapes]
ball = { disc = { radius = 0.1 } }
brick = { polygon = [[0, 0], [0.4, 0], [0.4, 0.2], [0, 0.2]] }
[[bodies]]
shape = "ball"
count = 150
place = { random = { within = [[-2, -2], [2, 2]], gap = 0.001 } }
velocity = { maxwell = 1.0 }
[[bodies]]
shape = "brick"
count = 30
place = { random = { within = [[-2, -2], [2, 2]], gap = 0.001 } }
velocity = { maxwell = 1.0 }
`;

/** Runs a scene; its recording stands in the test's folder as NAME.h5. @returns {any} the summary */
export function record(name, scene, options = []) {
  writeFileSync(path(`${name}.toml`), scene);
  return JSON.parse(execFileSync(program, ["run", path(`${name}.toml`), "-o", path(`${name}.h5`), "--force", "--progress", "none", ...options], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
}

/** @param {string[]} options */
export const throng = (...options) => spawnSync(program, options, { encoding: "utf8", maxBuffer: 1e9 });

/** Edits NAME.h5 by h5py: `f` is the file. */
export function alter(name, python) {
  execFileSync("/usr/bin/python3", ["-c", `import h5py, numpy as np\nf = h5py.File(${JSON.stringify(path(name))}, "r+", libver="latest")\n${python}\nf.close()`]);
}

/** h5wasm as Node runs it; it opens files of the disk. */
export async function h5() {
  const { default: made } = await import("../../tools/viewer/node_modules/h5wasm/dist/node/hdf5_hl.js");
  (await made.ready).activate_throwing_error_handler();
  return made;
}

/** A recording of the test's folder, opened as the page does. */
export function open(library, name) {
  const bytes = readFileSync(path(name));
  return new Recording(library, path(name), modeFor(bytes.subarray(0, HEAD)), bytes.length);
}

/** Debian's Chromium without a window, drawing by the processor. */
export function browser() {
  const { chromium } = createRequire(new URL("../../tools/viewer/package.json", import.meta.url))("playwright-core");
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"] });
}

/** Numbers in [0, 1) that are the same in every run (mulberry32). @param {number} seed */
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
