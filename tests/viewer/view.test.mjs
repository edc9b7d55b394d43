// SPDX-License-Identifier: MIT
// The page's pure parts: camera, clock, frames at hand, colours, curves, words.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ABSENT, blend, bodyAt, faceForward, NOWHERE, placeOf } from "../../tools/viewer/src/view/blend.js";
import { Camera, roundBelow } from "../../tools/viewer/src/view/camera.js";
import { colour, colourings } from "../../tools/viewer/src/view/colouring.js";
import { axis, charts, merge, ticks, valueAt } from "../../tools/viewer/src/view/curves.js";
import { count, length, short, si, toStep } from "../../tools/viewer/src/view/format.js";
import { framing } from "../../tools/viewer/src/view/framing.js";
import { Frames } from "../../tools/viewer/src/view/frames.js";
import { mesh, rounded } from "../../tools/viewer/src/view/mesh.js";
import { GROUP, KINEMATIC, PLAIN, ramp, STATIC, table } from "../../tools/viewer/src/view/palette.js";
import { frameAt, Player, speeds } from "../../tools/viewer/src/view/player.js";
import { niceTop, percentile99, spread } from "../../tools/viewer/src/reader/overview.js";
import { coarseFirst, scanned } from "../../tools/viewer/src/reader/scan.js";
import { samples } from "../../tools/viewer/src/trails.js";

const UNBOUNDED = { kind: "unbounded", min: [0, 0], max: [0, 0] };
const disc = { name: "ball", kind: 0, radius: 0, gyration2: 0, outline: new Float64Array(0), holes: [], parts: [] };
const box = { name: "box", kind: 1, radius: 1, gyration2: 1, outline: Float64Array.of(0, 0, 1, 0, 1, 1, 0, 1), holes: [], parts: [{ points: Float64Array.of(0, 0, 1, 0, 1, 1, 0, 1), radius: 0 }] };
const pair = { name: "pair", kind: 2, radius: 1, gyration2: 1, outline: new Float64Array(0), holes: [], parts: [{ points: Float64Array.of(-1, 0), radius: 0.5 }, { points: Float64Array.of(1, 0), radius: 0.25 }] };

function scene(shapes, rows, kinds = rows.map(() => 0)) {
  const n = rows.length, column = values => Float64Array.from(values);
  return { name: "s", description: "", version: "", domain: UNBOUNDED, gravity: [0, -1], shapes, materials: ["default"], walls: [], walkable: [], areas: [], queues: [], measuredLines: [], groups: [], fields: ["position", "velocity"], times: column([0, 1]), steps: column([0, 1]), complete: true,
           bodies: { count: n, changes: false, id: column(rows.map((_, i) => i + 1)), shape: column(rows), material: new Float64Array(n), kind: column(kinds), radius: new Float64Array(n).fill(0.5), mass: new Float64Array(n).fill(1) } };
}

test("zooming keeps the place under the pointer", () => {
  const camera = Object.assign(new Camera(), { width: 800, height: 600, x: 3, y: -2, scale: 40 });
  const before = camera.world(123, 456);
  camera.zoom(7.5, 123, 456);
  camera.world(123, 456).forEach((value, i) => assert.ok(Math.abs(value - before[i]) < 1e-12));
  assert.equal(camera.fitted, false);
});

test("fitting shows all of an extent, with room for legend and scale", () => {
  const camera = Object.assign(new Camera(), { width: 800, height: 600 });
  camera.fit([0, 0, 10, 100]);
  assert.deepEqual([camera.x, camera.y], [5, 50]);
  assert.ok(camera.world(0, 38)[1] >= 100 - 1e-9 && camera.world(0, 562)[1] <= 1e-9);
});

test("a place and its pixel are one another's", () => {
  const camera = Object.assign(new Camera(), { width: 800, height: 600, x: 3, y: -2, scale: 40 }), [px, py] = camera.pixel(5, 1);
  assert.deepEqual([px, py], [480, 180]);
  assert.deepEqual(camera.world(px, py), [5, 1]);
});

test("dragging moves what is seen with the pointer", () => {
  const camera = Object.assign(new Camera(), { scale: 10 });
  camera.pan(20, 30);
  assert.deepEqual([camera.x, camera.y], [-2, 3]);
});

test("lengths of scales are 1, 2 or 5 times a power of ten", () => {
  assert.deepEqual([0.9, 1, 4.9, 5, 70, 0.0031, 1e-9].map(roundBelow), [0.5, 1, 2, 5, 50, 0.002, 1e-9]);
});

test("the frame at a time is the last that is not after it", () => {
  const times = [0, 0.1, 0.2, 0.4];
  assert.deepEqual([-1, 0, 0.05, 0.1, 0.3, 0.4, 9].map(t => frameAt(times, t)), [0, 0, 0, 1, 2, 3, 3]);
});

test("playing goes on with the clock, ends at the end, and starts anew from there", () => {
  const player = new Player(Float64Array.of(0, 1, 2));
  player.advance(1);
  assert.equal(player.time, 0);
  player.play(true);
  player.speed = 0.5;
  player.advance(1);
  assert.deepEqual(player.between(), { a: 0, b: 1, t: 0.5 });
  player.advance(100);
  assert.deepEqual([player.time, player.playing], [2, false]);
  player.play(true);
  assert.equal(player.time, 0);
  player.loop = true;
  player.advance(100);
  assert.deepEqual([player.time, player.playing], [0, true]);
});

test("stepping stands on a frame, and not beyond the last", () => {
  const player = new Player(Float64Array.of(0, 1, 2));
  player.play(true);
  player.stand(1);
  assert.deepEqual([player.time, player.playing], [1, false]);
  player.stand(Infinity);
  assert.equal(player.time, 2);
  player.stand(-Infinity);
  assert.equal(player.time, 0);
});

test("frames that fly past are shown as they are, and only those that will be seen are wanted", () => {
  const player = new Player(Float64Array.from({ length: 1001 }, (_, i) => i / 1000));
  player.play(true);
  player.time = 0.0105;
  assert.deepEqual(player.between(), { a: 10, b: 10, t: 0 });
  const wanted = player.wanted();
  assert.equal(wanted[0], 10);
  assert.ok(wanted[1] > 20 && wanted.length < 20);
});

test("what stands wants its neighbours", () => {
  const player = new Player(Float64Array.of(0, 1, 2));
  player.seek(1);
  assert.deepEqual(player.wanted(), [1, 2, 0]);
});

test("speeds suit the length of a recording", () => {
  assert.equal(speeds(8).start, 1);
  assert.equal(speeds(3600).start, 100);
  assert.equal(speeds(1e-3).start, 1e-4);
  assert.ok(speeds(8).choices.includes(1) && speeds(3600).choices.includes(100));
});

test("frames come in the order of the wishes, two at a time, and the oldest are forgotten", async () => {
  const orders = [];
  let answer = [];
  const load = frame => { orders.push(frame); return new Promise(resolve => answer.push(() => resolve({ values: { position: new Float64Array(10) } }))); };
  const frames = new Frames(load, () => {}, assert.fail, 5 * 80);
  frames.need(["position"], false);
  const arrive = async () => { const now = answer; answer = []; now.forEach(call => call()); await new Promise(setImmediate); };
  frames.want([3, 4, 5]);
  assert.deepEqual(orders, [3, 4]);
  for (let i = 0; i < 9; ++i) await arrive();
  assert.deepEqual(orders, [3, 4, 5]);
  frames.want([5, 6, 7, 8]);
  for (let i = 0; i < 9; ++i) await arrive();
  assert.deepEqual([3, 4, 5, 6, 7, 8].map(i => frames.has(i)), [false, true, true, true, true, true]);
});

test("wishes beyond the memory are not loaded again and again", async () => {
  let orders = 0;
  const frames = new Frames(() => { ++orders; return Promise.resolve({ values: { position: new Float64Array(10) } }); }, () => {}, assert.fail, 4 * 80);
  frames.want(Array.from({ length: 20 }, (_, i) => i));
  for (let i = 0; i < 200; ++i) await new Promise(setImmediate);
  assert.equal(orders <= 6, true, `${orders} loaded`);
  assert.equal(frames.has(0), true);
});

test("frames that hold too little are asked for again, and late ones are not taken", async () => {
  const orders = [], answers = [];
  const load = (frame, fields) => { orders.push([frame, ...fields]); return new Promise(resolve => answers.push(resolve)); };
  const frames = new Frames(load, () => {}, assert.fail, 1e6);
  frames.need(["position"], false);
  frames.want([1]);
  frames.need(["position", "velocity"], false);
  answers[0]({ values: {} });
  await new Promise(setImmediate);
  assert.equal(frames.has(1), false);
  assert.deepEqual(orders, [[1, "position"], [1, "position", "velocity"]]);
});

test("a frame that can't be read is told once, and others still come", async () => {
  const failures = [];
  const frames = new Frames(frame => frame === 1 ? Promise.reject(new Error("is damaged")) : Promise.resolve({ values: {} }), () => {}, error => failures.push(error.message), 1e6);
  frames.want([1]);
  await new Promise(setImmediate);
  frames.want([2]);
  await new Promise(setImmediate);
  assert.deepEqual([failures, frames.has(2)], [["is damaged"], true]);
});

test("bodies are between their frames", () => {
  const states = new Float32Array(4), a = { position: Float64Array.of(1, 2), angle: Float64Array.of(0) }, b = { position: Float64Array.of(3, 6), angle: Float64Array.of(1) };
  blend(a, b, 0.5, { x: 1, y: 1 }, UNBOUNDED, Float32Array.of(7), states);
  assert.deepEqual([...states], [1, 3, 0.5, 7]);
  assert.deepEqual(placeOf(states, 0, { x: 1, y: 1 }), [2, 4]);
});

test("who leaves stands until the next frame, who comes is there with it", () => {
  const states = new Float32Array(16), a = { position: Float64Array.of(1, 2, NaN, NaN, 5, 5, NaN, NaN), angle: Float64Array.of(1, NaN, NaN, NaN) };
  const b = { position: Float64Array.of(NaN, NaN, 3, 6, 6, 7, NaN, NaN), angle: Float64Array.of(NaN, 2, 3, NaN) };
  blend(a, b, 0.5, { x: 1, y: 1 }, { kind: "periodic", min: [0, 0], max: [10, 10] }, Float32Array.of(7, 7, 7, 7), states);
  assert.deepEqual([...states.subarray(0, 4)], [0, 1, 1, 7]);
  assert.deepEqual([...states.subarray(8, 12)], [4.5, 5, 0, 7]);
  assert.deepEqual([states[7], states[15]], [ABSENT, ABSENT]);
  assert.ok(placeOf(states, 1, { x: 1, y: 1 }).every(Number.isNaN));
  assert.equal(bodyAt(states, Float64Array.of(1, 1, 1, 1), 0, 1, 0), 0);
  assert.equal(bodyAt(states, Float64Array.of(1, 1, 1, 1), 2, 5, 0), -1);
});

test("agents look where they walk, and nowhere where they stand", () => {
  const states = new Float32Array(12).fill(5), velocity = Float64Array.of(0, 1, 0, 1, 0.01, 0.01);
  faceForward(states, Float64Array.of(3, 0, 3), { velocity });
  assert.deepEqual([states[2], states[6], states[10]], [Math.fround(Math.PI / 2), 5, NOWHERE]);
  faceForward(states, Float64Array.of(3, 0, 3), {});
  assert.deepEqual([states[2], states[6], states[10]], [NOWHERE, 5, NOWHERE]);
});

test("bodies far from 0, 0 are as exact as near it", () => {
  const states = new Float32Array(4), frame = { position: Float64Array.of(1e8 + 0.001, 0) };
  blend(frame, frame, 0, { x: 1e8, y: 0 }, UNBOUNDED, Float32Array.of(0), states);
  assert.ok(Math.abs(states[0] - 0.001) < 1e-7);
});

test("over the border of a periodic domain bodies take the short way", () => {
  const states = new Float32Array(4), domain = { kind: "periodic", min: [0, 0], max: [10, 10] };
  blend({ position: Float64Array.of(9, 5) }, { position: Float64Array.of(1, 5) }, 0.75, { x: 0, y: 0 }, domain, Float32Array.of(0), states);
  assert.deepEqual([states[0], states[1]], [0.5, 5]);
});

test("the body under a pointer is the nearest in its own radii", () => {
  const states = Float32Array.of(0, 0, 0, 0, 1, 0, 0, 0), radii = Float64Array.of(2, 0.2);
  assert.equal(bodyAt(states, radii, 0.95, 0, 0), 1);
  assert.equal(bodyAt(states, radii, 0.5, 0, 0), 0);
  assert.equal(bodyAt(states, radii, 5, 0, 0.1), -1);
});

test("colours are those that say something of the recording", () => {
  const keys = (d, top = 1) => colourings(d, { topSpeed: top, starts: { heights: new Float64Array(2), low: 0, high: 0 } }).map(({ key }) => key);
  assert.deepEqual(keys(scene([disc], [0, 0])), ["speed", "id", "overlap", "plain"]);
  assert.deepEqual(keys({ ...scene([disc, box], [0, 1]), fields: ["position"] }), ["shape", "id", "overlap", "plain"]);
});

test("groups are told apart where shapes do not do it", () => {
  const groups = [{ name: "left", first: 1, count: 2 }, { name: "right", first: 3, count: 3 }], none = { topSpeed: 1, starts: { heights: new Float64Array(5), low: 0, high: 0 } };
  const d = { ...scene([disc, box], [0, 1, 0, 1, 1]), groups }, by = colourings(d, none).find(({ key }) => key === "group");
  assert.deepEqual(by.legend.groups.map(({ name }) => name), ["left", "right"]);
  assert.deepEqual([0, 1, 2, 3, 4].map(row => by.place(row, {}) - GROUP), [0, 0, 1, 1, 1]);
  const chosen = { ...d, bodies: { ...scene([disc, box], [0, 1, 1]).bodies, id: Float64Array.of(2, 4, 5) } };
  assert.equal(colourings(chosen, none).some(({ key }) => key === "group"), false);
});

test("agents move by themselves; who is not known to be fast or high has a plain colour", () => {
  const d = scene([disc], [0, 0], [3, 3]), places = new Float32Array(2), all = colourings(d, { topSpeed: 2, starts: { heights: Float64Array.of(0, NaN), low: 0, high: 1 } });
  colour(all[0], d, { values: { velocity: Float64Array.of(2, 0, NaN, NaN) } }, places);
  assert.deepEqual([...places], [239, PLAIN]);
  colour(all.find(({ key }) => key === "start"), d, { values: {} }, places);
  assert.deepEqual([...places], [0, PLAIN]);
});

test("a speed that is not known has no colour of the ramp", () => {
  const d = scene([disc], [0, 0]), places = new Float32Array(2), starts = { heights: new Float64Array(2), low: 0, high: 0 };
  for (const topSpeed of [2, 0]) {
    const [speed] = colourings(d, { topSpeed, starts });
    colour(speed, d, { values: {} }, places);
    assert.deepEqual([...places], [PLAIN, PLAIN]);
    colour(speed, d, { values: { velocity: new Float64Array(4) } }, places);
    assert.deepEqual([...places], [0, 0]);
  }
});

test("what stands still or is driven is grey", () => {
  const d = scene([disc], [0, 0, 0], [0, 1, 2]), places = new Float32Array(3);
  const [speed] = colourings(d, { topSpeed: 2, starts: { heights: new Float64Array(3), low: 0, high: 0 } });
  colour(speed, d, { values: { velocity: Float64Array.of(2, 0, 2, 0, 2, 0) } }, places);
  assert.deepEqual([...places], [239, STATIC, KINEMATIC]);
});

test("the ramp gets lighter all the way, in both themes", () => {
  for (const dark of [false, true]) {
    const light = Array.from({ length: 50 }, (_, i) => ramp(i / 49, dark)).map(([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b);
    light.slice(1).forEach((value, i) => assert.ok(value > light[i] - 0.8));
    assert.equal(table(dark).length, 1024);
  }
});

test("a mesh has every disc, triangle and edge once", () => {
  const made = mesh(scene([disc, box, pair], [0, 1, 2, 0]));
  assert.deepEqual([made.discs, made.composites, made.triangles, made.edges].map(rows => rows.count), [2, 2, 6, 4]);
  assert.deepEqual([made.discs.rows[4], made.discs.values[7]], [3, 0.5]);
  assert.deepEqual([made.composites.rows[0], ...made.composites.values.slice(1, 4)], [2, -1, 0, 0.5]);
});

test("a mesh has the edges of holes", () => {
  const frame = { ...box, holes: [Float64Array.of(0.2, 0.2, 0.2, 0.4, 0.4, 0.2), Float64Array.of(0.6, 0.6, 0.6, 0.8, 0.8, 0.6)] };
  const { edges } = mesh(scene([frame], [0]));
  assert.equal(edges.count, 4 + 3 + 3);
  assert.deepEqual([...edges.values.slice(5 * 7 + 1, 5 * 8)].map(x => Math.round(10 * x)), [8, 6, 6, 6]);
});

test("a rounded part is as far from its edges as its radius", () => {
  const around = rounded({ points: Float64Array.of(0, 0, 2, 0), radius: 0.5 });
  for (let i = 0; i < around.length; i += 2) {
    const x = Math.min(2, Math.max(0, around[i]));
    assert.ok(Math.abs(Math.hypot(around[i] - x, around[i + 1]) - 0.5) < 1e-12);
  }
});

test("the first view is the domain where bodies are spread over it, else the bodies", () => {
  const d = { ...scene([disc], [0]), domain: { kind: "box", min: [0, 0], max: [100, 100] } };
  const at = (...places) => framing(d, { places: Float64Array.from(places), radii: new Float64Array(places.length / 2).fill(1) });
  assert.deepEqual(at(0, 0, 100, 100, 50, 50).map(Math.round), [-2, -2, 102, 102]);
  const [left, bottom, right, top] = at(40, 1, 60, 1);
  assert.ok(left > 38 && left < 39 && right > 61 && right < 62 && bottom < 0 && top > 2 && top < 4);
});

test("the first view of agents is all of their floor, as in pictures", () => {
  const walking = { ...scene([disc], [0], [3]), domain: { kind: "box", min: [-50, -50], max: [50, 50] }, walkable: [Float64Array.of(0, 0, 40, 0, 40, 10, 0, 10)] };
  const shown = { places: Float64Array.of(5, 5), radii: Float64Array.of(1) };
  assert.deepEqual(framing(walking, shown).map(Math.round), [-1, -1, 41, 11]);
  const beside = { ...walking, walls: [{ points: Float64Array.of(-10, 0, -10, 10), closed: false }] };
  assert.deepEqual(framing(beside, shown).map(Math.round), [-11, -1, 41, 11]);
});

test("curves are those that can be computed", () => {
  const titles = d => charts(d, 0.1, 0).map(({ title, curves }) => `${title} ${curves.length}`);
  assert.deepEqual(titles(scene([disc], [0])), ["Energy 3", "Overlap 2", "Counts 2"]);
  assert.deepEqual(titles({ ...scene([disc], [0]), gravity: null, fields: ["position"] }), ["Overlap 2", "Counts 1"]);
  const observed = charts({ ...scene([disc], [0]), observed: ["contacts"] }, 0.1, 0);
  assert.deepEqual(observed.map(({ title }) => title), ["Energy", "Overlap", "Counts"]);
  const still = scene([disc], [0]), some = charts({ ...still, bodies: { ...still.bodies, changes: true }, observed: ["contacts"] }, 0.1, 0);
  assert.deepEqual(some.map(({ title, curves }) => `${title} ${curves.length}`), ["Energy of those here 1", "Overlap 2", "Counts 4"], "whose height changes as they come and go");
  const region = some[2].curves;
  assert.deepEqual(region.map(({ name }) => name).slice(0, 3), ["here", "pairs that touch", "points that press"]);
  assert.equal(new Set(region.map(({ colour }) => colour)).size, 4, "each has a colour of its own");
  assert.deepEqual(observed[2].curves.map(({ name, value }) => [name, value({ contacts: 5, moving: 6, observed: [7] })]), [["pairs that touch", 5], ["points that press", 7], ["faster than 0.1 m/s", 6]]);
});

test("lines of axes are round and few", () => {
  assert.deepEqual(ticks(0, 10), [0, 5, 10]);
  assert.deepEqual(ticks(0, 0.8, 5), [0, 0.2, 0.4, 0.6, 0.8]);
  assert.deepEqual(ticks(3, 3), []);
  assert.deepEqual(axis({ curves: [{ value: p => p.largest }] }, [{ largest: 0 }, { largest: NaN }]).lines, []);
  const points = [1e-5, 1e-4, 1e-2].map((largest, frame) => ({ frame, time: frame, largest }));
  const { at, lines } = axis({ curves: [{ value: p => p.largest }], decades: true }, points);
  assert.deepEqual(lines, [1e-4, 1e-3, 1e-2]);
  assert.equal(at(0), 0);
  assert.ok(at(1e-3) - at(1e-4) - (at(1e-2) - at(1e-3)) < 1e-12);
});

test("points of a curve stand in order, and the nearest that is known is read", () => {
  const points = merge([{ frame: 4, time: 4, v: 1 }], [{ frame: 0, time: 0, v: 2 }, { frame: 3, time: 3, v: NaN }]);
  assert.deepEqual(points.map(p => p.frame), [0, 3, 4]);
  assert.equal(valueAt(points, 2.9, p => p.v), 1);
});

test("frames are scanned coarse first, each once", () => {
  assert.deepEqual(coarseFirst(9), [0, 8, 4, 2, 6, 1, 3, 5, 7]);
  assert.deepEqual(coarseFirst(1000).sort((a, b) => a - b), Array.from({ length: 1000 }, (_, i) => i));
});

test("curves of fields that few frames hold take half their points of those frames", () => {
  const steps = Float64Array.from({ length: 10001 }, (_, i) => 2 * i), of = rates => scanned({ steps, rates });
  assert.deepEqual([of({ position: 2 }).length, of({ position: 2, velocity: 1 }).length], [400, 400]);
  const rows = of({ position: 2, velocity: 7 });
  assert.ok(rows.every((row, k) => k === 0 || row > rows[k - 1]), "each once, in order");
  assert.deepEqual([rows[0], rows[rows.length - 1]], [0, 10000]);
  assert.ok(rows.length <= 400 && rows.filter(row => row % 7 === 0).length >= 200);
});

test("samples are spread from the first row to the last", () => {
  assert.deepEqual(spread(10, 4), [0, 3, 6, 9]);
  assert.deepEqual([spread(3, 8), spread(1, 4), spread(0, 4)], [[0, 1, 2], [0], []]);
  assert.deepEqual([niceTop(0.0123), niceTop(12), niceTop(0), percentile99([])], [0.013, 12, 0, 0]);
});

test("trails take the same frames until time is a sample further", () => {
  assert.deepEqual(samples(7, 3), { first: 0, frames: [0, 3, 6] });
  assert.deepEqual(samples(8, 3), samples(7, 3));
  assert.equal(samples(300, 3).frames.length, 24);
});

test("numbers read well", () => {
  assert.deepEqual([short(-1.23456), short(123456), short(NaN), short(1e-7)], ["−1.23", "1.23e5", "–", "1.00e−7"]);
  assert.deepEqual([length(0.5), length(0.0042), length(1500), length(0)], ["50 cm", "4.2 mm", "1.5 km", "0 m"]);
  assert.deepEqual([si(84213, "J"), si(0.0021, "J"), si(0, "J"), si(1e30, "J")], ["84.2 kJ", "2.1 mJ", "0 J", "1.00e30 J"]);
  assert.deepEqual([toStep(1.23456, 0.01), toStep(-3, 1)], ["1.23", "−3"]);
  assert.equal(count(1234567), "1 234 567");
});
