// SPDX-License-Identifier: MIT
// The curves of the panel, drawn as they come; a pointer on them sets the time.
import { axis, charts, merge, ticks, valueAt } from "../view/curves.js";
import { toStep } from "../view/format.js";
import { byId, element } from "./dom.js";

/** @typedef {import("../view/curves.js").Chart} Chart */

const LEFT = 2, RIGHT = 2, TOP = 6, BOTTOM = 15;  // pixels around a chart

export class Charts {
  #points = /** @type {import("../reader/scan.js").Point[]} */ ([]);
  #rows = /** @type {{chart: Chart, canvas: any, values: HTMLElement[]}[]} */ ([]);
  #time = 0;
  #due = false;

  /** @param {import("../reader/recording.js").Description} description @param {number} slow @param {(time: number) => void} seek */
  constructor(description, slow, seek) {
    this.description = description;
    this.slow = slow;
    this.section = byId("curves");
    this.section.replaceChildren(element("h2", "Curves"));
    this.#rows = charts(description, slow, 0).map(chart => this.#row(chart, seek));
    new ResizeObserver(() => this.#drawSoon()).observe(this.section);
  }

  /** @param {Chart} chart @param {(time: number) => void} seek */
  #row(chart, seek) {
    const box = element("div", "", "chart"), names = element("div", "", "names"), canvas = document.createElement("canvas");
    names.append(element("b", chart.title));
    const values = chart.curves.map(curve => {
      const label = element("span");
      label.style.color = curve.colour;
      names.append(label);
      return label;
    });
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${chart.title} over time`);
    box.append(names, canvas);
    this.section.append(box);
    const set = (/** @type {PointerEvent} */ e) => seek(this.first + (this.last - this.first) * (e.offsetX - LEFT) / Math.max(1, canvas.clientWidth - LEFT - RIGHT));
    canvas.addEventListener("pointerdown", e => { canvas.setPointerCapture(e.pointerId); set(e); });
    canvas.addEventListener("pointermove", e => { if (canvas.hasPointerCapture(e.pointerId)) set(e); });
    return { chart, canvas, values };
  }

  get first() { return this.description.times[0]; }
  get last() { return this.description.times[this.description.times.length - 1]; }

  /** @param {import("../reader/scan.js").Point[]} points */
  add(points) {
    this.#points = merge(this.#points, points);
    const lowest = this.#points.reduce((least, p) => Math.min(least, p.potential), Infinity);
    const all = charts(this.description, this.slow, Number.isFinite(lowest) ? lowest : 0);
    this.#rows.forEach((row, i) => { row.chart = all[i]; });
    this.#drawSoon();
  }

  /** @param {number} time */
  show(time) {
    if (time === this.#time) return;
    this.#time = time;
    this.#drawSoon();
  }

  #drawSoon() {
    if (this.#due) return;
    this.#due = true;
    setTimeout(() => { this.#due = false; this.draw(); }, 60);
  }

  draw() {
    if (this.section.clientHeight === 0 || this.section.offsetParent === null) return;
    for (const row of this.#rows) this.#draw(row);
  }

  /** @param {{chart: Chart, canvas: any, values: HTMLElement[]}} row */
  #draw({ chart, canvas, values }) {
    const ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight, context = canvas.getContext("2d");
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    context.scale(ratio, ratio);
    const { at, lines } = axis(chart, this.#points);
    const style = getComputedStyle(document.documentElement), css = (/** @type {string} */ name) => style.getPropertyValue(name.replace(/var\(|\)/g, "")).trim();
    const x = (/** @type {number} */ time) => LEFT + (width - LEFT - RIGHT) * (time - this.first) / (this.last - this.first || 1);
    const y = (/** @type {number} */ value) => height - BOTTOM - (height - TOP - BOTTOM) * at(value);
    this.#axes(context, { width, height, lines, x, y, css, unit: chart.unit });
    chart.curves.forEach((curve, i) => {
      this.#line(context, curve, x, y, css(curve.colour));
      values[i].textContent = `${curve.name} ${chart.unit(valueAt(this.#points, this.#time, curve.value))}`;
    });
    context.strokeStyle = css("--ink");
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x(this.#time), TOP - 4);
    context.lineTo(x(this.#time), height - BOTTOM);
    context.stroke();
  }

  /** @param {CanvasRenderingContext2D} context @param {{width: number, height: number, lines: number[], x: (t: number) => number, y: (v: number) => number, css: (n: string) => string, unit: (v: number) => string}} frame */
  #axes(context, { width, height, lines, x, y, css, unit }) {
    context.font = "10.5px system-ui, sans-serif";
    context.strokeStyle = css("--line");
    context.fillStyle = css("--faint");
    context.lineWidth = 1;
    context.beginPath();
    for (const value of [...lines, -1]) { context.moveTo(LEFT, this.#level(y, value, height)); context.lineTo(width - RIGHT, this.#level(y, value, height)); }
    context.stroke();
    context.textAlign = "left";
    for (const value of lines) if (y(value) > TOP + 8) context.fillText(unit(value), LEFT + 1, y(value) - 2.5);
    const times = ticks(this.first, this.last, 5), step = times.length > 1 ? times[1] - times[0] : 1;
    for (const time of times) {
      context.textAlign = x(time) < 20 ? "left" : x(time) > width - 20 ? "right" : "center";
      context.fillText(`${toStep(time, step)}${time === times[times.length - 1] ? " s" : ""}`, x(time), height - 3);
    }
  }

  /** The pixel of a line, sharp; below 0: the foot. @param {(v: number) => number} y @param {number} value @param {number} height */
  #level(y, value, height) { return Math.round(value < 0 ? height - BOTTOM : y(value)) + 0.5; }

  /** @param {CanvasRenderingContext2D} context @param {import("../view/curves.js").Curve} curve @param {(t: number) => number} x @param {(v: number) => number} y @param {string} colour */
  #line(context, { value }, x, y, colour) {
    context.strokeStyle = colour;
    context.lineWidth = 1.6;
    context.lineJoin = "round";
    context.beginPath();
    let started = false;
    for (const point of this.#points) {
      const v = value(point);
      if (!Number.isFinite(v)) continue;
      if (started) context.lineTo(x(point.time), y(v)); else context.moveTo(x(point.time), y(v));
      started = true;
    }
    context.stroke();
  }
}
