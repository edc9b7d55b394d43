// SPDX-License-Identifier: MIT
// The names of areas, each in the upper left corner of its own, of queues at their heads, and of measured lines at the end that is farther to the upper left.
import { byId, element } from "./dom.js";

const MOST = 100, LEAST = 24;  // labels; pixels of an area that has one

export class Labels {
  #labels = /** @type {{label: HTMLElement, left: number, top: number, right: number}[]} */ ([]);

  /** @param {import("../reader/scenario.js").Area[]} areas @param {import("../reader/scene.js").Queue[]} queues @param {import("../reader/scene.js").MeasuredLine[]} measuredLines */
  constructor(areas, queues, measuredLines) {
    const ofAreas = areas.slice(0, MOST).map(({ name, rings, use }) => {
      const points = rings.flatMap(ring => Array.from(ring)), most = (/** @type {number} */ axis, /** @type {number} */ sign) => points.reduce((best, value, i) => i % 2 === axis ? Math.max(best, sign * value) : best, -Infinity);
      return { label: element("span", name, use), left: -most(0, -1), top: most(1, 1), right: most(0, 1) };
    });
    const ofQueues = queues.slice(0, MOST).map(({ name, line }) => ({ label: element("span", name, "wait"), left: line[0], top: line[1], right: Infinity }));
    const ofLines = measuredLines.slice(0, MOST).map(({ name, line: [ax, ay, bx, by] }) => {
      const [left, top] = by - bx > ay - ax ? [bx, by] : [ax, ay];
      return { label: element("span", name, "count"), left, top, right: Infinity };
    });
    this.#labels = [...ofAreas, ...ofQueues, ...ofLines];
    byId("areas").replaceChildren(...this.#labels.map(({ label }) => label));
  }

  /** @param {import("../view/camera.js").Camera} camera @param {boolean} on */
  show(camera, on) {
    for (const { label, left, top, right } of this.#labels) {
      const [x, y] = camera.pixel(left, top);
      label.hidden = !on || (right - left) * camera.scale < LEAST;
      label.style.transform = `translate(${x + 5}px, ${y + 3}px)`;
    }
  }
}
