// SPDX-License-Identifier: MIT
// What the page takes from the scenario's text: as throng prints it, and as strangers might.
import assert from "node:assert/strict";
import { test } from "node:test";
import { fans } from "../../tools/viewer/src/gl/areas.js";
import { areasOf, gravityOf, groupsOf, sections } from "../../tools/viewer/src/reader/scenario.js";
import { h5, open, random, record } from "./helper.mjs";

const SCENE = `throng = 1
name = "areas"
time = { dt = 0.01, until = 0.1 }
walkable = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))"
[areas]
start = "POLYGON ((0 0, 2 0, 2 5, 0 5, 0 0), (0.5 1, 1 1, 1 2, 0.5 1))"
exit = [[9, 2], [10, 2], [10, 3]]
"a \\"b\\" [[c]] = d" = "MULTIPOLYGON (((0 0, 1 0, 1e0 1, 0 0)), ((5 1, 6 1, 6 2, 5 1)))"
[shapes]
ball = { disc = { radius = 0.1 } }
brick = { polygon = [[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]] }
[[bodies]]
shape = "ball"
at = [1, 1]
[[bodies]]
shape = "brick"
place = { lattice = { origin = [3, 1], spacing = [0.5, 0.5], size = [4, 3] } }
[[bodies]]
shape = "ball"
count = 7
place = { random = { within = [[6, 1], [9, 4]] } }
`;

test("areas and groups are read from what throng prints", async () => {
  record("areas", SCENE);
  const { areas, groups, gravity, bodies } = open(await h5(), "areas.h5").description;
  assert.deepEqual(Object.fromEntries(areas.map(({ name, rings }) => [name, rings.map(ring => [...ring])])), {
    start: [[0, 0, 2, 0, 2, 5, 0, 5], [0.5, 1, 1, 1, 1, 2]],
    exit: [[9, 2, 10, 2, 10, 3]],
    'a "b" [[c]] = d': [[0, 0, 1, 0, 1, 1], [5, 1, 6, 1, 6, 2]],
  });
  assert.deepEqual(groups, [{ name: "ball 1", first: 1, count: 1 }, { name: "brick", first: 2, count: 12 }, { name: "ball 2", first: 14, count: 7 }]);
  assert.equal(bodies.count, 20);
  for (const { first, count, name } of groups)
    for (let id = first; id < first + count; ++id) assert.equal(bodies.shape[id - 1], name.startsWith("ball") ? 0 : 1);
  assert.deepEqual(gravity, [0, 0]);
});

const PRINTED = `throng = 1
gravity = [0.0, -9.81]

[[agents]]
count = 20
goal = "exit"

[[agents]]
goal = "far"

[areas]
exit = [[0, 0], [1, 0], [1, 1]]
other = [[0, 0], [1, 0], [1, 1]]

[[bodies]]
shape = "ball"
`;

test("goals are where agents go, who come after the bodies", () => {
  const all = sections(PRINTED);
  assert.deepEqual(areasOf(all).map(({ name, use }) => [name, use]), [["exit", "goal"], ["other", "none"]]);
  assert.deepEqual(groupsOf(all, 22), [{ name: "ball", first: 1, count: 1 }, { name: "to exit", first: 2, count: 20 }, { name: "to far", first: 22, count: 1 }]);
  assert.deepEqual(gravityOf(all), [0, -9.81]);
});

test("gravity is that of the head of the scenario, or none", () => {
  assert.deepEqual(gravityOf(sections("throng = 1\n[shapes]\ngravity = [1, 2]\n")), [0, 0]);
  assert.equal(gravityOf(sections("something else")), null);
  assert.equal(gravityOf(sections("throng = 1\ngravity = [1, \"2\"]")), null);
});

test("what the text doesn't say is not guessed", () => {
  assert.deepEqual(groupsOf(sections(PRINTED), 23), []);
  assert.deepEqual(groupsOf(sections('[[bodies]]\nplace = { file = "a" }\n[[bodies]]\nplace = { file = "b" }'), 5), []);
  assert.deepEqual(groupsOf(sections('[[bodies]]\nplace = { file = "a" }\n[[bodies]]\n'), 5).map(({ count }) => count), [4, 1]);
  assert.deepEqual(groupsOf(sections('[[bodies]]\ncount = 9\n[[bodies]]\nplace = { file = "b" }'), 5), []);
  for (const value of ["[[0, 0], [1]]", "[[0, 0], [1, 1]]", '"POLYGON ((0 0, 1 x, 1 1))"', '"POLYGON EMPTY"', "[[0, 0], [1, 0], [1, 1e999]]", "{ a = 1 }", "7", '"unfinished'])
    assert.deepEqual(areasOf(sections(`[areas]\nexit = ${value}`)), [], value);
  assert.deepEqual(areasOf(sections('[areas]\n"broken\nexit = [[0, 0], [1, 0], [1, 1]]')).length, 1);
});

test("a long text takes no longer than its length says", () => {
  const start = performance.now();
  sections(`${"[".repeat(2e5)}\n"${"\\".repeat(2e5)}\n${" ".repeat(2e5)}x\n${"a".repeat(2e5)}`);
  areasOf(sections(`[areas]\nexit = "${"(".repeat(2e5)}${"1 ".repeat(2e5)}"`));
  assert.ok(performance.now() - start < 2000);
});

test("a place is in an area where an odd number of fans covers it", () => {
  const next = random(3), rings = [[0, 0, 4, 0, 4, 4, 2, 1, 0, 4], [0.5, 0.5, 1, 0.5, 1, 1, 0.5, 1]], triangles = fans(rings, [1, 1]);
  assert.equal(triangles.length, 6 * (3 + 2));
  const side = (ax, ay, bx, by, x, y) => (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0;
  const inRing = (p, x, y) => {
    let inside = false;
    for (let i = 0, j = p.length - 2; i < p.length; j = i, i += 2)
      if ((p[i + 1] > y) !== (p[j + 1] > y) && x < (p[j] - p[i]) * (y - p[i + 1]) / (p[j + 1] - p[i + 1]) + p[i]) inside = !inside;
    return inside;
  };
  let inside = 0;
  for (let k = 0; k < 2000; ++k) {
    const x = 5 * next() - 0.5, y = 5 * next() - 0.5;
    let covered = 0;
    for (let t = 0; t < triangles.length; t += 6) {
      const [ax, ay, bx, by, cx, cy] = triangles.slice(t, t + 6).map(value => value + 1), turns = [side(ax, ay, bx, by, x, y), side(bx, by, cx, cy, x, y), side(cx, cy, ax, ay, x, y)];
      covered += turns.every(Boolean) || !turns.some(Boolean);
    }
    assert.equal(covered % 2 === 1, inRing(rings[0], x, y) !== inRing(rings[1], x, y), `${x}, ${y}`);
    inside += covered % 2;
  }
  assert.ok(inside > 400 && inside < 1200, `${inside}`);
});
