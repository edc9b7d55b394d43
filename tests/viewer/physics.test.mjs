// SPDX-License-Identifier: MIT
// What the page computes itself is held against the program: distances, overlaps, energies, neighbours.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { before, describe, test } from "node:test";
import { eachMeeting } from "../../tools/viewer/src/physics/grid.js";
import { ContactFinder } from "../../tools/viewer/src/physics/contacts.js";
import { measure } from "../../tools/viewer/src/physics/measures.js";
import { neighbours } from "../../tools/viewer/src/physics/neighbours.js";
import { separation } from "../../tools/viewer/src/physics/separation.js";
import { GAS, h5, MIXED, open, path, random, record, throng } from "./helper.mjs";

/** Discs on springs, which press as soon as they touch. */
const SOFT = `throng = 1
gravity = [0.0, -9.81]
time = { dt = 0.002, until = 2.0 }
domain = { box = [[0, 0], [4, 8]] }
contact = { model = "spring", stiffness = 1e5 }
[shapes]
ball = { disc = { radius = { uniform = [0.1, 0.15] } } }
[[bodies]]
shape = "ball"
count = 150
place = { random = { within = [[0, 0], [4, 6]], gap = 0.01 } }
`;

const close = (a, b, tolerance) => assert.ok(Math.abs(a - b) <= tolerance * (1 + Math.abs(b)), `${a} is not ${b}`);

/** A convex polygon of n corners about a random place, or a segment, or a point. */
function shape(next) {
  const n = [1, 2, 3, 4, 5, 8][Math.floor(6 * next())], x = 2 * next(), y = 2 * next(), phase = 6 * next(), points = [];
  for (let i = 0; i < n; ++i) {
    const angle = phase + 2 * Math.PI * (i + 0.7 * next()) / n;
    points.push([x + 0.6 * Math.cos(angle), y + 0.6 * Math.sin(angle)]);
  }
  return { points, radius: n === 1 || next() < 0.3 ? 0.05 + 0.3 * next() : 0 };
}

const asked = ({ points, radius }) => points.length === 1 ? { disc: { at: points[0], radius } } : points.length === 2 ? { segment: points, radius } : { polygon: points, radius };

test("a separation is that of the narrowphase", () => {
  const seed = 5, next = random(seed), pairs = [];
  for (let i = 0; i < 600; ++i) pairs.push({ a: shape(next), b: shape(next) });
  writeFileSync(path("pairs.jsonl"), pairs.map(({ a, b }) => JSON.stringify({ a: asked(a), b: asked(b) })).join("\n") + "\n");
  const answers = throng("pairs", path("pairs.jsonl")).stdout.trim().split("\n").map(line => JSON.parse(line).distance);
  let apart = 0;
  pairs.forEach(({ a, b }, i) => {
    const flat = a.points.length < 3 && b.points.length < 3;
    const ours = separation(Float64Array.from(a.points.flat()), a.radius, Float64Array.from(b.points.flat()), b.radius);
    if (flat && answers[i] < 0) return;  // crossing capsules: the page has none
    close(ours, answers[i], 1e-9);
    apart += answers[i] > 0;
  });
  assert.ok(apart > 150 && apart < 450, `${apart} of 600 are apart, seed ${seed}`);
});

test("boxes meet as the definition says, strays and giants among them", () => {
  const next = random(9), n = 400, boxes = new Float64Array(4 * n);
  for (let i = 0; i < n; ++i) {
    const x = i === 7 ? 1e7 : 20 * next(), y = 20 * next(), size = i % 50 === 0 ? 9 : 0.8 * next();
    boxes.set([x, y, x + size, y + size], 4 * i);
  }
  const meets = (p, q) => boxes[p] <= boxes[q + 2] && boxes[q] <= boxes[p + 2] && boxes[p + 1] <= boxes[q + 3] && boxes[q + 1] <= boxes[p + 3];
  const first = 300, expected = [];
  for (let a = 0; a < first; ++a) for (let b = a + 1; b < n; ++b) if (meets(4 * a, 4 * b)) expected.push(`${a} ${b}`);
  const found = [];
  eachMeeting(boxes, first, (a, b) => found.push(`${a} ${b}`));
  assert.ok(expected.length > 500, `${expected.length}`);
  assert.deepEqual(found.sort(), expected.sort());
});

test("boxes that all lie in one place meet once each", () => {
  const found = [];
  eachMeeting(new Float64Array([0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), 3, (a, b) => found.push([a, b]));
  assert.deepEqual(found, [[0, 1], [0, 2], [1, 2]]);
});

test("bodies touch where nothing is between them, not where they are near", () => {
  const bodies = { count: 4, shape: new Float64Array(4), kind: new Float64Array(4), radius: new Float64Array(4).fill(0.5) };
  const finder = new ContactFinder({ bodies, shapes: [{ kind: 0, parts: [] }], walls: [], domain: { kind: "box", min: [-0.5, -1], max: [9, 1] } });
  const { pairs, depths, overlapping } = finder.find({ position: Float64Array.of(0, 0, 1, 0, 1.75, 0, 2.751, 0) });  // touch, overlap, 1 mm apart; on a side
  assert.deepEqual([...pairs], [0, 1, 1, 2, 0, -1]);
  assert.deepEqual([...depths], [0, 0.25, 0]);
  assert.equal(overlapping, 1);
});

test("an agent is in a wall once, however many lines it is of", () => {
  const overlaps = (at, lines, domain = { kind: "unbounded", min: [0, 0], max: [0, 0] }) => {
    const bodies = { count: 1, shape: new Float64Array(1), kind: Float64Array.of(3), radius: Float64Array.of(0.2) };
    const walls = lines.map(points => ({ points: Float64Array.from(points), closed: points.length > 6 }));
    return new ContactFinder({ bodies, shapes: [{ kind: 0, parts: [] }], walls, domain }).find({ position: Float64Array.from(at) }).overlapping;
  };
  assert.equal(overlaps([5, 0.1], [[0, 0, 5, 0], [10, 0, 5, 0], [5, 0, 10, 0]]), 1);  // pieces, one of them twice
  assert.equal(overlaps([0.1, 0.1], [[-5, 0, 0, 0], [0, -5, 0, 0]]), 1);  // a tip
  assert.equal(overlaps([-0.1, -0.1], [[-5, 0, 0, 0], [0, -5, 0, 0]]), 2);  // in the corner
  const floor = [0, 0, 10, 0, 10, 5, 0, 5];
  assert.equal(overlaps([5, 0.15], [floor], { kind: "box", min: [0, 0], max: [10, 5] }), 1);
});

test("soft discs touch in as many pairs as the run counts contacts", async () => {
  const { contacts } = record("soft", SOFT), recording = open(await h5(), "soft.h5"), { description } = recording;
  const { pairs } = new ContactFinder(description).find(recording.frame(description.times.length - 1, ["position"]));
  assert.ok(contacts > 100, `${contacts}`);
  assert.equal(pairs.length / 2, contacts);
});

describe("the last frame of a run", () => {
  const scenes = { mixed: MIXED, gas: GAS }, runs = {};
  before(async () => {
    const library = await h5();
    for (const [name, scene] of Object.entries(scenes)) {
      const summary = record(name, scene), recording = open(library, `${name}.h5`), { description } = recording;
      runs[name] = { summary, description, frame: recording.frame(description.times.length - 1, ["position", "angle", "velocity", "spin"]) };
    }
  });

  for (const name of ["mixed", "gas"]) {
    test(`has the overlaps of the summary of ${name}`, () => {
      const { summary, description, frame } = runs[name], found = new ContactFinder(description).find(frame);
      assert.ok(found.overlapping > 5);
      close(found.largest, summary.max_overlap, 1e-10);
      close(found.mean, summary.mean_overlap, 1e-10);
      assert.ok(found.pairs.length / 2 >= found.overlapping / 3);
      close(found.deepest.reduce((a, b) => Math.max(a, b), 0), summary.max_overlap, 1e-6);
    });
  }

  test("has the energies of the summary", () => {
    const { summary, description, frame } = runs.mixed, found = measure(description, frame, 0.5);
    close(found.kinetic + found.turning, summary.kinetic_energy, 1e-12);
    close(found.potential, summary.potential_energy, 1e-12);
    assert.ok(found.moving > 0 && found.moving < description.bodies.count);
  });

  test("says what was not recorded, and counts no energy for it", () => {
    const { description, frame } = runs.mixed, { kinetic, turning, moving } = measure({ ...description, gravity: null }, { position: frame.position }, 0.5);
    assert.ok([kinetic, turning, moving].every(Number.isNaN));
  });

  for (const name of ["mixed", "gas"]) {
    test(`has the neighbours that throng query finds in ${name}`, () => {
      const { description, frame } = runs[name], id = 17, radius = 0.9;
      const rows = throng("query", path(`${name}.h5`), "--radius", String(radius), "--id", String(id), "--at", String(description.times.at(-1)), "--format", "csv").stdout.trim().split("\n").slice(1).map(line => line.split(",").map(Number));
      const found = neighbours(frame.position, id - 1, radius, description.domain);
      assert.ok(found.length > 3);
      assert.deepEqual(found.map(({ row }) => row + 1).sort((a, b) => a - b), rows.map(([, other]) => other).sort((a, b) => a - b));
      for (const [, other, distance] of rows) close(found.find(({ row }) => row + 1 === other).distance, distance, 1e-9);
    });
  }
});
