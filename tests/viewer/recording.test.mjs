// SPDX-License-Identifier: MIT
// What the page's reader takes for a recording, and what it refuses with a sentence.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { copyFileSync, existsSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { before, describe, test } from "node:test";
import { ContactFinder } from "../../tools/viewer/src/physics/contacts.js";
import { measure } from "../../tools/viewer/src/physics/measures.js";
import { neighbours } from "../../tools/viewer/src/physics/neighbours.js";
import { OpenFile } from "../../tools/viewer/src/reader/h5.js";
import { overview } from "../../tools/viewer/src/reader/overview.js";
import { scan } from "../../tools/viewer/src/reader/scan.js";
import { charts } from "../../tools/viewer/src/view/curves.js";
import { alter, GAS, h5, MIXED, open, path, program, random, record, throng } from "./helper.mjs";

let library, whole;

before(async () => {
  library = await h5();
  record("whole", MIXED);
  whole = open(library, "whole.h5");
});

const FIELDS = ["position", "angle", "velocity", "spin"];

/** The sentence with which a file is refused, at opening or at a frame; "" where all of it is read. */
function refusal(name) {
  try {
    const recording = open(library, name);
    for (let i = 0; i < recording.description.times.length; ++i) recording.frame(i, FIELDS);
    recording.file.close();
    return "";
  } catch (error) {
    return error.message;
  }
}

/** A copy of the recording, changed by h5py. */
function altered(name, python) {
  copyFileSync(path("whole.h5"), path(name));
  alter(name, python);
  return name;
}

test("a recording is read as it was written", () => {
  const { description } = whole, frame = whole.frame(100, FIELDS);
  assert.deepEqual([description.name, description.description, description.complete], ["mixed", "a bit of everything", true]);
  assert.deepEqual([description.bodies.count, description.times.length, description.fields], [151, 101, FIELDS]);
  assert.deepEqual(description.shapes.map(({ name, kind }) => `${name} ${kind}`), ["ball 0", "brick 1", "dumbbell 2", "star 1"]);
  assert.deepEqual([description.gravity, description.times[100], description.steps[100]], [[0, -9.81], 1, 100]);
  assert.deepEqual([frame.position.length, frame.angle.length], [302, 151]);
  assert.deepEqual([...description.walls[0].points], [0, 3, 2, 2, 3, 2]);
  assert.ok(overview(whole).topSpeed > 1);
});

test("single precision and a few fields are read, too", () => {
  record("single", GAS.replace("[shapes]", "record = { fields = [\"position\"], precision = \"single\", every = 7 }\n[shapes]"));
  const { description } = open(library, "single.h5");
  assert.deepEqual([description.fields, description.domain.kind, description.steps[1]], [["position"], "periodic", 7]);
});

test("quantized positions come back within half a quantum, from any frame", () => {
  record("quantized", MIXED, ["--set", "record.quantize=0.01"]);
  const quantized = open(library, "quantized.h5");
  for (const i of [100, 3, 20, 17, 16, 15, 0, 99]) {
    const { position, angle } = quantized.frame(i, FIELDS), truth = whole.frame(i, FIELDS);
    assert.ok(position.every((x, k) => Math.abs(x - truth.position[k]) <= 0.005 * (1 + 1e-9)), `frame ${i}`);
    assert.deepEqual(angle, truth.angle);
  }
});

test("what packs well may claim more than its file is large", () => {
  record("rest", MIXED.replace(/record = .*/, 'record = { fields = ["position"], quantize = 1.0 }'), ["--until", "10"]);
  assert.ok(151 * 1001 * 8 > 2 * statSync(path("rest.h5")).size);
  assert.equal(open(library, "rest.h5").frame(1000, ["position"]).position.length, 302);
});

test("the frames of a killed run may claim a little more than there is", () => {
  const nothing = { File: class {} };
  assert.deepEqual([new OpenFile(nothing, "", "r", 7).room, new OpenFile(nothing, "", "Sr", 7).room], [7, 64e6 + 7]);
});

test("frames with positions are shown, with what they have of the rest", () => {
  record("rates", MIXED.replace(/record = .*/, 'record = { every = 2, fields = ["position"], also = [{ every = 3, fields = ["velocity"] }] }'));
  const recording = open(library, "rates.h5"), { steps, times } = recording.description;
  assert.deepEqual([steps.length, steps[3], times[50]], [51, 6, 1]);
  assert.deepEqual(recording.frame(3, FIELDS), { position: whole.frame(6, FIELDS).position, velocity: whole.frame(6, FIELDS).velocity });
  assert.deepEqual(recording.frame(4, FIELDS), { position: whole.frame(8, FIELDS).position });
});

test("what has a rate of its own is known until it comes again, from frames without positions, too", () => {
  record("turning", MIXED.replace(/record = .*/, 'record = { every = 2, fields = ["position"], also = [{ every = 3, fields = ["angle"] }] }'));
  const recording = open(library, "turning.h5");
  assert.deepEqual(recording.description.rates, { position: 2, angle: 3 });
  for (const [frame, step] of [[0, 0], [1, 0], [2, 3], [3, 6], [4, 6], [5, 9]]) {
    const { position, angle } = recording.last(frame, FIELDS);
    assert.deepEqual([position, angle], [whole.frame(2 * frame, FIELDS).position, whole.frame(step, FIELDS).angle], `frame ${frame}`);
  }
});

test("speeds and their curves are those of the frames that know them, however few", () => {
  record("slow", MIXED.replace(/record = .*/, 'record = { every = 2, fields = ["position"], also = [{ every = 30, fields = ["velocity"] }], observables = 10 }'), ["--until", "3"]);
  const recording = open(library, "slow.h5"), { description } = recording, { topSpeed } = overview(recording);
  assert.deepEqual([description.frames, description.times.length, description.observed], [151, 151, ["contacts"]]);
  assert.ok(topSpeed > 1, `${topSpeed}`);
  const points = [...scan(recording, new ContactFinder(description), 0.05 * topSpeed)], known = points.filter(({ kinetic }) => Number.isFinite(kinetic));
  assert.deepEqual(known.map(({ frame }) => 2 * frame).sort((a, b) => a - b), Array.from({ length: 11 }, (_, i) => 30 * i));
  assert.ok(points.every(({ kinetic, moving }) => Number.isNaN(kinetic) === Number.isNaN(moving)));
});

test("points that press are the run's own, as observed or as recorded", () => {
  const scene = record_ => MIXED.replace(/record = .*/, `record = { fields = ["position"${record_}`), last = name => {
    const recording = open(library, `${name}.h5`);
    assert.deepEqual(recording.description.observed, ["contacts"]);
    return recording.observed(recording.description.times.length - 1);
  };
  const { contacts } = record("observed", scene(`], observables = 10 }`));
  record("recorded", scene(`, "contacts"] }`));
  record("rarely", scene(`], also = [{ every = 3, fields = ["contacts"] }] }`), ["--until", "1.01"]);
  assert.ok(contacts > 20);
  assert.deepEqual(last("observed"), [contacts]);
  const [pressed] = last("recorded");  // in the step, if not at its end
  assert.ok(pressed >= contacts && pressed < 1.5 * contacts, `${pressed} of ${contacts}`);
  assert.deepEqual(last("rarely"), open(library, "recorded.h5").observed(99), "of the last frame that has them");
  copyFileSync(path("recorded.h5"), path("fewer.h5"));
  alter("fewer.h5", "f['throng/contacts/offset'].resize(50, axis=0)");
  assert.match(refusal("fewer.h5"), /contacts are missing/);
});

test("overlaps of shapes that turn are those of frames that know how they have turned", () => {
  const recording = open(library, "turning.h5"), points = [...scan(recording, new ContactFinder(recording.description), 1)];
  for (const { frame, largest } of points) assert.equal(Number.isFinite(largest), frame % 3 === 0, `frame ${frame}`);
  assert.equal(points.length, 51);
});

test("overlaps of shapes whose angles nobody recorded are not known, those of discs are", () => {
  const largest = (name, ...options) => {
    record(name, MIXED.replace(/record = .*/, 'record = { fields = ["position"] }'), options);
    const recording = open(library, `${name}.h5`);
    return [...scan(recording, new ContactFinder(recording.description), 1)].map(point => point.largest);
  };
  assert.ok(largest("unturned").every(Number.isNaN));
  assert.ok(largest("discs", "--set", 'record.of.shape="ball"').some(depth => depth > 0));
});

test("some bodies are shown by their ids", () => {
  record("some", MIXED, ["--set", "record.of.ids=[3, 90]"]);
  assert.deepEqual([...open(library, "some.h5").description.bodies.id], [3, 90]);
});

describe("of bodies that come and go", () => {
  let region;
  before(() => {
    record("region", MIXED, ["--set", "record.within=[[0, 0], [4, 4]]"]);
    region = open(library, "region.h5");
  });
  const inside = ([x, y]) => x >= 0 && x <= 4 && y >= 0 && y <= 4;
  const rowsIn = i => Array.from({ length: 151 }, (_, row) => row).filter(row => inside(whole.frame(i, FIELDS).position.subarray(2 * row)));

  test("each frame has those that are there, each in its row", () => {
    const sizes = new Set();
    for (const i of [0, 40, 41, 100, 0]) {
      const here = new Set(rowsIn(i)), found = region.frame(i, FIELDS), truth = whole.frame(i, FIELDS);
      for (const [field, width] of [["position", 2], ["angle", 1], ["velocity", 2], ["spin", 1]])
        truth[field].forEach((value, k) => assert.equal(found[field][k], here.has(Math.floor(k / width)) ? value : NaN, `${field} ${k} of frame ${i}`));
      sizes.add(here.size);
    }
    assert.ok(sizes.size >= 3 && Math.max(...sizes) < 151, `${[...sizes]}`);
    assert.equal(region.description.bodies.changes, true);
  });

  test("overlaps and energies are those of who is there", () => {
    const { description } = region, finder = new ContactFinder(description), all = new ContactFinder(whole.description);
    for (const i of [100, 0, 60]) {
      const here = new Set(rowsIn(i)), found = finder.find(region.frame(i, FIELDS)), truth = all.find(whole.frame(i, FIELDS));
      const pairs = ({ pairs, depths }) => Array.from(depths, (depth, k) => [pairs[2 * k], pairs[2 * k + 1], depth]).map(String).sort();
      const between = pairs(truth).filter(pair => { const [a, b] = pair.split(",").map(Number); return here.has(a) && (b < 0 || here.has(b)); });
      assert.deepEqual(pairs(found), between, `frame ${i}`);
      assert.ok(i !== 100 || between.length > 20);
      const some = measure(description, region.frame(i, FIELDS), 0.5);
      assert.equal(some.present, here.size - Number(here.has(0)));  // the peg is static
      const { position, velocity } = whole.frame(i, FIELDS), absent = [...Array(151).keys()].filter(row => !here.has(row));
      for (const row of absent) position[2 * row] = velocity[2 * row] = velocity[2 * row + 1] = NaN;
      assert.equal(some.kinetic, measure(whole.description, { position, velocity }, 0.5).kinetic);
      assert.ok(i === 0 || some.kinetic > 0);
    }
  });

  test("the overview is of places that are", () => {
    const { places, radii, topSpeed, starts } = overview(region);
    assert.ok(places.length === 2 * radii.length && places.every(Number.isFinite) && places.length > 20 && topSpeed > 0);
    assert.ok(starts.low >= 0 && starts.high <= 4 && starts.high > starts.low && starts.heights.some(Number.isNaN));
  });

  test("what has a rate of its own belongs to those who were there then", () => {
    record("regionturning", MIXED.replace(/record = .*/, 'record = { every = 2, fields = ["position"], also = [{ every = 3, fields = ["angle"] }], within = [[0, 0], [4, 4]] }'));
    const turning = open(library, "regionturning.h5");
    let changed = 0;
    for (let i = 0; i <= 50; ++i) {
      const step = 3 * Math.floor(2 * i / 3), then = new Set(rowsIn(step)), truth = whole.frame(step, FIELDS).angle, { angle } = turning.last(i, FIELDS);
      truth.forEach((value, row) => assert.equal(angle[row], then.has(row) ? value : NaN, `row ${row} of frame ${i}`));
      changed += String(rowsIn(step)) !== String(rowsIn(2 * i));
    }
    assert.ok(changed > 3, `${changed}`);
  });

  test("frames without bodies hold no ids", () => {
    record("seldom", MIXED, ["--set", "record.every=4", "--set", "record.observables=6", "--set", "record.within=[[0, 0], [4, 4]]"]);
    const seldom = open(library, "seldom.h5"), { steps } = seldom.description;
    assert.deepEqual([...steps], Array.from({ length: 26 }, (_, i) => 4 * i));
    const changed = steps.filter((step, i) => i > 0 && String(rowsIn(step)) !== String(rowsIn(step - 4))).length;
    assert.ok(changed > 3, `${changed}`);
    steps.forEach((step, i) => assert.deepEqual(seldom.frame(i, FIELDS), region.frame(step, FIELDS), `step ${step}`));
  });

  for (const [what, python] of Object.entries({ "twice": "v[1] = v[0]", "back": "v[[0, 1]] = v[[1, 0]]", "of nobody": "v[1] = 4000000", "after the end": "v[150] = 150" }))
    test(`an id ${what} is damage`, () => {
      const name = `ids ${what}.h5`;
      copyFileSync(path("region.h5"), path(name));
      alter(name, `d = f['particles/trajectory/id/value']; v = d[7]; ${python}; d[7] = v`);
      assert.match(refusal(name), /id\/value of frame 7 is not in order/);
    });

  test("ids of fewer frames than there are, are damage", () => {
    copyFileSync(path("region.h5"), path("ids.h5"));
    alter("ids.h5", "f['particles/trajectory/id/value'].resize(50, axis=0)");
    assert.match(refusal("ids.h5"), /frames are missing/);
  });

  for (const [what, python] of Object.entries({ "of another step": "s[50] = 49", "of a step that is no frame": "s[50] = 1000", "of too few steps": "s = s[:50]" }))
    test(`ids ${what} are damage`, () => {
      const name = `ids ${what}.h5`;
      copyFileSync(path("region.h5"), path(name));
      alter(name, `g = f['particles/trajectory/id']; s = g['step'][:]; ${python}; del g['step']; g['step'] = s`);
      assert.match(refusal(name), /frames are missing/);
    });
});

test("quantized positions of a region are of who is in it", () => {
  record("packedregion", MIXED, ["--set", "record.within=[[0, 0], [4, 4]]", "--set", "record.quantize=0.01"]);
  const packed = open(library, "packedregion.h5"), region = open(library, "region.h5");
  for (const i of [50, 0, 17, 18, 33, 3]) {
    const { position, angle } = packed.frame(i, FIELDS), truth = region.frame(i, FIELDS);
    assert.deepEqual(angle, truth.angle);
    truth.position.forEach((x, k) => assert.ok(Number.isNaN(x) ? Number.isNaN(position[k]) : Math.abs(position[k] - x) <= 0.005 * (1 + 1e-9), `frame ${i}`));
  }
});

describe("of agents", () => {
  const scenario = name => readFileSync(new URL(`../../scenarios/${name}.toml`, import.meta.url), "utf8");
  let summary, agents;
  before(() => {
    summary = record("corridor", scenario("corridor"), ["--every", "10"]);
    agents = open(library, "corridor.h5");
  });

  test("each is where the program's table has it, until it leaves", () => {
    const { description: { bodies, steps, times } } = agents, table = new Map(Array.from(steps, step => [step, []]));
    assert.equal(throng("export", path("corridor.h5"), "--format", "csv", "-o", path("corridor.csv")).status, 0);
    const [head, ...lines] = readFileSync(path("corridor.csv"), "utf8").trim().split("\n");
    assert.match(head, /^step,time,id,x,y,vx,vy/);
    for (const [step, , ...row] of lines.map(line => line.split(",").map(Number))) table.get(step).push(row);
    steps.forEach((step, i) => {
      const expected = { position: new Float64Array(2 * bodies.count).fill(NaN), velocity: new Float64Array(2 * bodies.count).fill(NaN) };
      for (const [id, x, y, vx, vy] of table.get(step)) { expected.position.set([x, y], 2 * (id - 1)); expected.velocity.set([vx, vy], 2 * (id - 1)); }
      assert.deepEqual(agents.frame(i, ["position", "velocity"]), expected, `step ${step}`);
    });
    const here = Array.from(steps, step => table.get(step).length), empty = here.indexOf(0);
    assert.deepEqual([here[0], new Set(here).size > 20], [60, true]);
    assert.ok(times[empty - 1] < summary.last_arrival && summary.last_arrival <= times[empty], `${summary.last_arrival} s`);
    assert.equal(measure(agents.description, agents.frame(200, FIELDS), 0.5).present, here[200]);
  });

  test("the floor, the areas and where they go are known", () => {
    const { bodies, walls, areas, groups } = agents.description;
    assert.ok(bodies.changes && bodies.kind.every(kind => kind === 3));
    assert.deepEqual(walls.map(({ points, closed }) => [points.length / 2, closed]), [[4, true], [4, true]]);
    assert.deepEqual(areas.map(({ name, use }) => [name, use]), [["end", "goal"], ["start", "none"]]);
    assert.deepEqual(groups, [{ name: "to end", first: 1, count: 60 }]);
  });

  test("they have no energies, as in the program's numbers, and no curve of them", () => {
    const { kinetic, turning, potential, moving } = measure(agents.description, agents.frame(100, FIELDS), 0.5);
    assert.deepEqual([kinetic, turning, potential, moving > 20], [0, NaN, 0, true]);
    assert.deepEqual(charts(agents.description, 0.5, 0).map(({ title }) => title), ["Overlap", "Counts"]);
  });

  test("whom a recorded sensor found is known, in frames between from its last look", () => {
    const text = `${scenario("corridor")}\n[[sensors]]\nname = "eyes & ears"\nradius = 1.5\nfov_degrees = 200\nevery = 20\nrecord = true\nof = { ids = [3, 7, 60] }\n`;
    record("senses", text, ["--until", "20", "--every", "10"]);
    const recording = open(library, "senses.h5"), { description } = recording, { domain, steps } = description;
    assert.equal(description.sensors, 1);
    let found = 0, asks = 0;
    for (const id of [3, 60]) {
      for (let i = 0; i < steps.length; i += 1) {
        const now = recording.sensed(i, id), { position } = recording.frame(i - i % 2, ["position"]);
        assert.deepEqual(now, recording.sensed(i - i % 2, id), "the last look");
        if (Number.isNaN(position[2 * (id - 1)])) { assert.equal(now, null, "who has left senses nobody"); continue; }
        assert.deepEqual([now.name, now.radius], ["eyes & ears", 1.5]);
        found += now.ids.length;
        if (i % 40 !== 0) continue;
        const asked = throng("query", path("senses.h5"), "--radius", "1.5", "--id", String(id), "--fov", "200", "--at", String(description.times[i]), "--format", "json");
        const near = JSON.parse(asked.stdout)[0].neighbours.map(({ id: other }) => other).sort((a, b) => a - b);
        assert.deepEqual([...now.ids], near, `${id} at ${description.times[i]} s`);
        assert.ok(near.length <= neighbours(position, id - 1, 1.5, domain).length);
        asks += 1;
      }
    }
    assert.ok(asks > 5, `${asks}`);
    assert.ok(found > 50, `${found}`);
    assert.equal(recording.sensed(0, 4), null, "who hasn't the sensor");
    recording.file.close();
  });

  test("what was measured of them has curves, up to the numbers of the summary", () => {
    const run = record("counterflow", scenario("counterflow"), ["--until", "12", "--every", "10", "--set", "record.observables=20"]);
    const recording = open(library, "counterflow.h5"), { description } = recording;
    assert.deepEqual(description.observed, ["arrived", "measure/middle/count", "measure/middle/density", "measure/middle/speed",
                                            "measure/line/count", "measure/line/flow", "measure/line/speed"]);
    const last = Object.fromEntries(recording.observed(description.times.length - 1).map((value, k) => [description.observed[k], value]));
    const { arrived, measure: { line, middle } } = run;
    assert.deepEqual([last.arrived, last["measure/line/count"], last["measure/line/flow"], last["measure/middle/count"]],
                     [arrived, line.count, line.flow, middle.count]);
    assert.ok(line.count > 20 && recording.observed(0)[1] === 0 && Number.isNaN(recording.observed(0)[2]));
    assert.deepEqual(recording.observed(3), recording.observed(2), "frames in between have the last row");
    const shown = charts(description, 0.5, 0).slice(2), points = [...scan(recording, new ContactFinder(description), 0.5)];
    assert.deepEqual(shown.map(({ title, curves }) => [title, curves.map(({ name }) => name)]),
                     [["Counted", ["arrived", "middle", "line"]], ["Flow", ["line"]], ["Density", ["middle"]], ["Speed", ["middle", "line"]]]);
    const end = points.find(({ frame }) => frame === description.times.length - 1);
    assert.deepEqual(shown[0].curves.map(({ value }) => value(end)), [arrived, middle.count, line.count]);
    recording.file.close();
    copyFileSync(path("counterflow.h5"), path("short.h5"));
    alter("short.h5", "f['observables/measure/line/count/value'].resize(3, 0)");
    assert.match(refusal("short.h5"), /observables are missing/);
  });

  test("densities by Voronoi cells have a chart of their own", () => {
    record("cells", scenario("counterflow"), ["--until", "2", "--every", "10", "--set", "record.observables=20", "--set", "measure.0.voronoi.cutoff=1"]);
    const recording = open(library, "cells.h5"), { description } = recording;
    assert.deepEqual(description.observed.slice(1, 5), ["count", "density", "density_voronoi", "speed"].map(column => `measure/middle/${column}`));
    const shown = charts(description, 0.5, 0).map(({ title, curves }) => [title, curves.map(({ name }) => name)]);
    assert.deepEqual(shown.filter(([title]) => title.startsWith("Density")), [["Density", ["middle"]], ["Density by Voronoi cells", ["middle"]]]);
    recording.file.close();
  });

  test("measures may have any name, and curves have it, too", () => {
    const names = ["N/S 50%41", ".", "plain"];
    const text = `${scenario("corridor")}\n${names.map(name => `[[measure]]\nname = "${name}"\nline = [[5, 0], [5, 5]]\n`).join("")}`;
    record("named", text, ["--until", "1", "--every", "10", "--set", "record.observables=20"]);
    const recording = open(library, "named.h5"), { observed } = recording.description;
    assert.deepEqual(observed.filter(column => column.endsWith("/count")).slice(-3), ["measure/N%2FS 50%2541/count", "measure/%2E/count", "measure/plain/count"]);
    const counted = charts(recording.description, 0.5, 0).find(({ title }) => title === "Counted");
    assert.deepEqual(counted.curves.map(({ name }) => name).slice(-3), names);
    recording.file.close();
  });

  test("the table of areas tells where they wait, and queues; before 1.6 the scenario tells areas", () => {
    const floor = `throng = 1
time = { dt = 0.05, until = 0.1 }
walkable = [[0, 0], [10, 0], [10, 5], [0, 5]]
areas = { start = [[1, 1], [2, 1], [2, 4], [1, 4]], bench = [[4, 3], [6, 3], [6, 5], [4, 5]], exit = [[8, 1], [10, 1], [10, 4], [8, 4]] }
queues = { till = { line = [[6, 1], [4, 1], [4, 2]], service = 1 } }
[[agents]]
at = [3, 2.5]
model = "constant_velocity"
goal = [{ queue = "till" }, { wait = "bench", for = 1 }, "exit"]
[[measure]]
name = "seat"
area = "bench"
[[measure]]
name = "door"
line = [[8, 1], [8, 4]]
`;
    record("floor", floor);
    const { areas, queues, measuredLines } = open(library, "floor.h5").description;
    assert.deepEqual(areas.map(({ name, use, rings }) => [name, use, rings.map(ring => [...ring])]), [
      ["bench", "wait", [[4, 3, 6, 3, 6, 5, 4, 5]]], ["exit", "goal", [[8, 1, 10, 1, 10, 4, 8, 4]]], ["start", "none", [[1, 1, 2, 1, 2, 4, 1, 4]]]]);
    assert.deepEqual(queues.map(({ name, line }) => [name, ...line]), [["till", 6, 1, 4, 1, 4, 2]]);
    assert.deepEqual(measuredLines, [{ name: "door", line: [8, 1, 8, 4] }]);
    copyFileSync(path("floor.h5"), path("old.h5"));
    alter("old.h5", "del f['throng/areas'], f['throng/queues']");
    const old = open(library, "old.h5").description;
    assert.deepEqual(old.areas.map(({ name, use, rings }) => [name, use, rings]), areas.map(({ name, use, rings }) => [name, use === "none" ? use : "goal", rings.map(ring => [...ring])]));
    assert.deepEqual(old.queues, []);
    for (const [python, why] of [["f['throng/areas/use'][1] = 3", /areas\/use holds 3/], ["f['throng/areas/area_offset'][1] = 4", /area_offset does not fit/],
                                 ["f['throng/queues/offset'][1] = 9", /queues\/offset does not fit/], ["f['throng/queues/points'][0] = float('nan')", /points holds NaN/]]) {
      copyFileSync(path("floor.h5"), path("forged.h5"));
      alter("forged.h5", python);
      assert.match(refusal("forged.h5"), why);
    }
  });

  test("they overlap as deep as the program measured", () => {
    record("bottleneck", scenario("bottleneck"), ["--until", "8", "--every", "20", "--set", "record.observables=20"]);
    const recording = open(library, "bottleneck.h5"), finder = new ContactFinder(recording.description);
    const [largest, mean] = ["max", "mean"].map(which => recording.file.get(`observables/${which}_overlap/value`).value);
    assert.ok(largest.filter(depth => depth > 0).length > 2);
    largest.forEach((depth, i) => {
      const found = finder.find(recording.frame(i, FIELDS));
      assert.ok(Math.abs(found.largest - depth) < 1e-12 && Math.abs(found.mean - mean[i]) < 1e-12, `${found.largest} is not ${depth}`);
    });
  });
});

test("the holes of polygons are read, and none from files that know of none", () => {
  const holes = "[[[0.1, 0.1], [0.2, 0.1], [0.1, 0.2]], [[0.3, 0.1], [0.4, 0.1], [0.4, 0.2], [0.3, 0.2]]]";
  record("frame", MIXED.replace("[0.5, 0.3], [0, 0.3]]", `[0.5, 0.3], [0, 0.3]], holes = ${holes}`).replace("until = 1.0", "until = 0.1"));
  const { shapes } = open(library, "frame.h5").description;
  assert.deepEqual(shapes.map(shape => shape.holes.map(hole => hole.length / 2)), [[], [3, 4], [], []]);
  assert.ok(Math.abs(shapes[1].holes[0][0] - shapes[1].outline[0] - 0.1) < 1e-12);
  altered("older.h5", "[f['throng/shapes'].pop(name) for name in ('hole_offset', 'ring_offset', 'rings')]");
  assert.deepEqual(open(library, "older.h5").description.shapes.map(shape => shape.holes), [[], [], [], []]);
});

test("what is no recording is refused by name", () => {
  writeFileSync(path("text.h5"), "no recording at all");
  assert.match(refusal("text.h5"), /is no HDF5 file/);
  writeFileSync(path("empty.h5"), "");
  assert.match(refusal("empty.h5"), /is no HDF5 file/);
  copyFileSync(path("whole.h5"), path("foreign.h5"));
  alter("foreign.h5", "del f['throng']");
  assert.match(refusal("foreign.h5"), /is HDF5 but not a recording of throng/);
  assert.match(refusal(altered("newer.h5", "f['throng'].attrs['version'] = np.array([9, 4], dtype='i4')")), /was written by a newer throng: its form is 9\.4/);
});

const FORGED = {
  "a missing dataset": ["del f['throng/bodies/radius']", /radius is missing/],
  "another type": ["del f['throng/bodies/kind']; f['throng/bodies/kind'] = np.zeros(151)", /another type/],
  "another length": ["del f['throng/bodies/mass']; f['throng/bodies/mass'] = np.ones(7)", /another type or shape/],
  "a shape that is not there": ["f['throng/bodies/shape'][3] = 99", /shape holds 99/],
  "a radius that is no number": ["f['throng/bodies/radius'][0] = np.nan", /radius holds NaN/],
  "offsets that run backwards": ["f['throng/shapes/vertex_offset'][1] = 10**9", /does not fit its points/],
  "holes that run backwards": ["f['throng/shapes/hole_offset'][1] = 5", /hole_offset does not fit its points/],
  "time that goes back": ["f['throng/frames/time'][5] = 0.0", /time of frame 5 is wrong/],
  "a frame that is no number": ["f['particles/trajectory/position/value'][7, 0, 0] = np.inf", /position of frame 7 holds what is no number/],
  "frames that are missing": ["f['particles/trajectory/angle/value'].resize(50, axis=0)", /frames are missing/],
  "no frames": ["f['throng/frames/frame_hash'][:] = 0", /holds no frames/],
  "a place of huge size": ["del f['throng/walls/points']; f.create_dataset('throng/walls/points', (10**12, 2), dtype='f8', chunks=(1024, 2))", /walls\/points claims more than the file can hold/],
  "rows without end": ["f['throng/frames/frame_hash'].resize(2**33, axis=0)", /frame_hash claims more than the file can hold/],
  "frames without end": ["f['particles/trajectory/position/value'].resize(2**40, axis=0)", /position\/value claims more than the file can hold/],
  "bodies out of thin air": ["del f['throng/bodies/radius']; f.create_dataset('throng/bodies/radius', (2**25,), dtype='f8', chunks=(2**20,))", /radius claims more than the file can hold/],
  "a bomb": ["del f['throng/bodies/radius']; f.create_dataset('throng/bodies/radius', (2**20,), dtype='f8', chunks=(2**20,), compression='gzip', fillvalue=1)", /radius has a filter/],
  "chunks of huge size": ["del f['throng/frames/step']; f.create_dataset('throng/frames/step', (101,), dtype='i8', chunks=(2**23,), maxshape=(None,))", /step has chunks that are too large/],
  "long text": ["del f['parameters/resolved']; f['parameters'].create_dataset('resolved', (), dtype='S2000000000')", /resolved claims more than the file can hold/],
  "an external link": ["del f['throng/bodies/radius']; f['throng/bodies/radius'] = h5py.ExternalLink('/etc/passwd', 'x')", /radius is missing/],
  "text of any length": ["del f['throng/shapes/name']; f['throng/shapes/name'] = ['a', 'b', 'c', 'd']", /another type/],
};
Object.entries(FORGED).forEach(([what, [python, reason]], i) =>
  test(`${what} is refused`, () => assert.match(refusal(altered(`forged${i}.h5`, python)), reason)));

test("frames without their hash don't count", () => {
  altered("short.h5", "f['throng/frames/frame_hash'][60:] = 0");
  assert.equal(open(library, "short.h5").description.times.length, 60);
});

test("damaged values are never shown as if they were right", () => {
  const seed = 11, next = random(seed), sound = readFileSync(path("whole.h5")), bits = (recording, i) => FIELDS.map(field => Buffer.from(recording.frame(i, [field])[field].buffer).toString("base64")).join();
  const frames = [0, 30, 50, 70, 100], truth = frames.map(i => bits(whole, i));
  let refused = 0;
  for (let k = 0; k < 150; ++k) {
    const bytes = Buffer.from(sound);
    bytes[12 + Math.floor(next() * (k % 2 ? bytes.length - 12 : 6000))] ^= 1 + Math.floor(255 * next());
    writeFileSync(path(`mutant${k}.h5`), bytes);
    try {
      const recording = open(library, `mutant${k}.h5`);
      frames.forEach((i, at) => assert.equal(bits(recording, i), truth[at], `seed ${seed}, mutant ${k}, frame ${i}`));
      recording.file.close();
    } catch (error) {
      if (error.code === "ERR_ASSERTION") throw error;
      ++refused;
    }
  }
  assert.ok(refused > 20 && refused < 130, `${refused} refused`);
});

test("the file of a killed run opens, up to its last committed frame", async () => {
  writeFileSync(path("long.toml"), MIXED.replace("until = 1.0", "until = 1000.0").replace("name", "sleep = false\nname"));  // else it ends too soon
  const run = spawn(program, ["run", path("long.toml"), "-o", path("long.h5"), "--progress", "none"], { stdio: "ignore" });
  const ended = new Promise(resolve => run.on("exit", resolve));
  for (let waited = 0; !existsSync(path("long.h5.part")); waited += 20) {
    assert.ok(waited < 20000, "the run made no file");
    await new Promise(resolve => setTimeout(resolve, 20));
  }
  await new Promise(resolve => setTimeout(resolve, 2500));  // a run commits each second
  run.kill("SIGKILL");
  await ended;
  const { description } = open(library, "long.h5.part");
  assert.equal(description.complete, false);
  assert.ok(description.times.length > 10);
});
