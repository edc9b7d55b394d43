// SPDX-License-Identifier: MIT
// The names of areas, each in the upper left corner of its own.
import { byId, element } from "./dom.js";

const MOST = 100, LEAST = 24;  // labels; pixels of an area that has one

export class Labels {
  #labels = /** @type {{label: HTMLElement, left: number, top: number, right: number}[]} */ ([]);

  /** @param {import("../reader/scenario.js").Area[]} areas */
  constructor(areas) {
    this.#labels = areas.slice(0, MOST).map(({ name, rings, goal }) => {
      const points = rings.flat(), most = (/** @type {number} */ axis, /** @type {number} */ sign) => points.reduce((best, value, i) => i % 2 === axis ? Math.max(best, sign * value) : best, -Infinity);
      return { label: element("span", name, goal ? "goal" : ""), left: -most(0, -1), top: most(1, 1), right: most(0, 1) };
    });
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
