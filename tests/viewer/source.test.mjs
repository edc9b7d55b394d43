// SPDX-License-Identifier: MIT
// The page's side of the reader: answers find who asked, and a reader that is stuck is given up.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Source } from "../../tools/viewer/src/reader/source.js";

/** A reader that hears everything and answers what the test says. */
class FakeWorker {
  orders = /** @type {any[]} */ ([]);
  ended = false;
  constructor() { started.push(this); }
  postMessage(order) { this.orders.push(order); }
  terminate() { this.ended = true; }
  says(data) { this.onmessage({ data }); }
}

const SOON = 30;  // ms
let started = [];
beforeEach(() => { started = []; globalThis.Worker = FakeWorker; });

const opened = () => {
  const source = new Source("reader", SOON), opening = source.open("blob");
  started[0].says({ ready: true });
  started[0].says({ description: { name: "d" }, overview: {} });
  return { source, opening, worker: started[0] };
};

test("a frame asked for twice gets what each asked for", async () => {
  const { source, opening, worker } = opened();
  assert.equal((await opening).description.name, "d");
  const little = source.frame(7, ["position"], false), more = source.frame(7, ["position", "velocity"], false);
  const [a, b] = worker.orders.slice(1);
  worker.says({ ticket: a.ticket, values: { position: 1 } });
  worker.says({ ticket: b.ticket, values: { position: 1, velocity: 2 } });
  assert.deepEqual([(await little).values, (await more).values], [{ position: 1 }, { position: 1, velocity: 2 }]);
  source.close();
});

test("a file at which the reader never comes back is told as damaged", async () => {
  const source = new Source("reader", SOON);
  await assert.rejects(source.open("blob"), /seems to be damaged/);
  assert.deepEqual([started[0].ended, started.length], [true, 2]);
  source.close();
});

test("a frame that holds the reader up is given up, and the others come from a new one", async () => {
  const { source, opening } = opened();
  await opening;
  const stuck = source.frame(3, ["position"], false), next = source.frame(4, ["position"], false);
  await assert.rejects(stuck, /damaged, in frame 3/);
  assert.deepEqual([started[0].ended, started[1].orders.map(({ open, frame }) => open ?? frame)], [true, ["blob", 4]]);
  started[1].says({ description: {}, overview: {} });
  started[1].says({ ticket: started[1].orders[1].ticket, values: { position: 4 } });
  assert.deepEqual((await next).values, { position: 4 });
  source.close();
});

test("curves that never come are told, too", async () => {
  const { source, opening } = opened();
  await opening;
  const told = await new Promise(resolve => source.scan("blob", 0, (points, done, error) => resolve({ points, done, error })));
  assert.deepEqual([told.points, told.done, started[1].ended], [[], true, true]);
  assert.match(told.error, /damaged/);
  source.close();
});

test("a reader that says something from time to time is not given up", async () => {
  const { source, opening, worker } = opened();
  await opening;
  const first = source.frame(1, ["position"], false), second = source.frame(2, ["position"], false);
  await new Promise(resolve => setTimeout(resolve, 0.7 * SOON));
  worker.says({ ticket: 1, values: { position: 1 } });
  await first;
  await new Promise(resolve => setTimeout(resolve, 0.7 * SOON));
  worker.says({ ticket: 2, values: { position: 2 } });
  assert.deepEqual((await second).values, { position: 2 });
  assert.equal(started.length, 1);
  source.close();
});

test("who is closed starts nobody, and says nothing, whatever is still asked of it", async () => {
  const { source, opening } = opened(), told = [];
  await opening;
  source.scan("blob", 0, (...points) => told.push(points));
  source.close();
  source.frame(3, ["position"], false);
  started[1].says({ points: [] });
  await new Promise(resolve => setTimeout(resolve, 4 * SOON));
  assert.deepEqual([started.length, started.map(({ ended }) => ended), told], [2, [true, true], []]);
});
