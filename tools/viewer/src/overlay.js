// SPDX-License-Identifier: MIT
// What is drawn under and over the bodies: areas, queues, measured lines, domain and walls; contacts; the picked body, its sensing radius and whom it senses.
import { Lines } from "./gl/lines.js";
import { styleColour } from "./ui/dom.js";

const FAR = 300;  // views between camera and anchor from which places are kept anew

export class Overlay {
  paper = [255, 255, 255];
  showAreas = true;
  #anchor = [NaN, NaN];

  /** @param {import("./reader/recording.js").Description} description @param {import("./gl/stage.js").Stage} stage @param {number} radius  m, of a typical body */
  constructor(description, stage, radius) {
    this.description = description;
    this.stage = stage;
    this.radius = radius;
    this.restyle();
  }

  /** Takes the colours of the page's style. */
  restyle() {
    this.paper = styleColour("--paper");
    this.colours = { wall: styleColour("--wall"), domain: styleColour("--domain"), link: styleColour("--link"), pick: styleColour("--pick"),
                     none: styleColour("--area"), goal: styleColour("--goal"), wait: styleColour("--stay"), count: styleColour("--count") };
    this.#anchor = [NaN, NaN];
  }

  /**
   * @param {import("./gl/stage.js").View} view
   * @param {{states: Float32Array, contacts: import("./physics/contacts.js").Contacts | undefined, at: number[] | null, picked: number,
   *   velocity: ArrayLike<number> | undefined, sensing: number, sensed: ReturnType<typeof import("./physics/neighbours.js").neighbours>}} what
   */
  prepare(view, what) {
    const reach = FAR * view.width / view.scale;
    if (!(Math.hypot(view.x - this.#anchor[0], view.y - this.#anchor[1]) < reach)) this.#still(view);
    this.#links(view, what);
    this.#picked(view, what);
  }

  /** Areas show, or not. @param {boolean} on */
  setAreas(on) {
    this.showAreas = on;
    this.#anchor = [NaN, NaN];
  }

  /** Areas, queues, measured lines, domain and walls. @param {import("./gl/stage.js").View} view */
  #still(view) {
    this.#anchor = [view.x, view.y];
    const lines = new Lines(this.#anchor), { domain, walls } = this.description, colours = this.colours;
    if (!colours) return;
    const { areas, queues, measuredLines } = this.showAreas ? this.description : { areas: [], queues: [], measuredLines: [] };
    this.stage.areas.load(this.#anchor, areas.map(({ rings, use }) => ({ rings, colour: [...colours[use], use === "none" ? 0.1 : 0.16] })));
    for (const { rings, use } of areas) for (const points of rings) lines.path(points, true, 1.5, colours[use], 4);
    for (const { line } of queues) {
      lines.path(line, false, 2, colours.wait, 4);
      lines.ring(line[0], line[1], 4 * view.ratio / view.scale, 2.5, colours.wait);
    }
    for (const { line } of measuredLines) this.#counted(lines, line, view.ratio / view.scale);
    const [left, bottom] = domain.min, [right, top] = domain.max;
    if (domain.kind !== "unbounded") lines.path([left, bottom, right, bottom, right, top, left, top], true, 2, colours.domain, domain.kind === "periodic" ? 6 : 0);
    for (const { points, closed } of walls) lines.path(points, closed, 2.5, colours.wall);
    this.stage.under.load(lines);
  }

  /** A measured line, and from its middle an arrow to where it counts forward. @param {Lines} lines @param {number[]} line @param {number} pixel  m */
  #counted(lines, [ax, ay, bx, by], pixel) {
    const colour = this.colours?.count ?? [0, 0, 0], far = Math.hypot(bx - ax, by - ay), ux = (bx - ax) / far, uy = (by - ay) / far;
    const x = (ax + bx) / 2, y = (ay + by) / 2, tipX = x + 18 * pixel * uy, tipY = y - 18 * pixel * ux;
    lines.path([ax, ay, bx, by], false, 2, colour, 4);
    lines.add(x, y, tipX, tipY, 2, colour);
    for (const side of [1, -1]) lines.add(tipX, tipY, tipX + 6 * pixel * (side * ux - uy), tipY + 6 * pixel * (side * uy + ux), 2, colour);
  }

  /** The bodies in touch, centre to centre, the wider the deeper. @param {import("./gl/stage.js").View} view @param {{states: Float32Array, contacts: import("./physics/contacts.js").Contacts | undefined}} what */
  #links(view, { states, contacts }) {
    const lines = new Lines([view.x, view.y]), { domain } = this.description, deep = 0.03 * this.radius;
    const width = domain.max[0] - domain.min[0], height = domain.max[1] - domain.min[1], periodic = domain.kind === "periodic", colour = this.colours?.link ?? [0, 0, 0];
    for (let i = 0; contacts && i < contacts.depths.length; ++i) {
      const a = 4 * contacts.pairs[2 * i], b = 4 * contacts.pairs[2 * i + 1];
      if (b < 0) continue;
      let dx = states[b] - states[a], dy = states[b + 1] - states[a + 1];
      if (periodic) { dx -= width * Math.round(dx / width); dy -= height * Math.round(dy / height); }
      const x = view.x + states[a], y = view.y + states[a + 1];
      lines.add(x, y, x + dx, y + dy, 1 + 2.5 * Math.min(1, Math.max(0, contacts.depths[i]) / deep), [...colour, 0.85]);
    }
    this.stage.links.load(lines);
  }

  /** @param {import("./gl/stage.js").View} view @param {{at: number[] | null, picked: number, velocity: ArrayLike<number> | undefined, sensing: number, sensed: {dx: number, dy: number, row: number}[]}} what */
  #picked(view, { at, picked, velocity, sensing, sensed }) {
    const lines = new Lines([view.x, view.y]), colour = this.colours?.pick ?? [0, 0, 0], { radius } = this.description.bodies;
    if (at) {
      const [x, y] = at;
      lines.ring(x, y, sensing, 1.5, colour, 1);
      for (const { dx, dy, row } of sensed) {
        lines.add(x, y, x + dx, y + dy, 1, [...colour, 0.35]);
        lines.ring(x + dx, y + dy, radius[row], 1.2, [...colour, 0.7]);
        if (lines.count > 60000) break;
      }
      lines.ring(x, y, Math.max(radius[picked], 5 * view.ratio / view.scale), 3.5, colour);
      if (velocity) this.#arrow(lines, view, x, y, velocity[2 * picked], velocity[2 * picked + 1], colour);
    }
    this.stage.over.load(lines);
  }

  /** The velocity: where the body would be in a quarter of a second. @param {Lines} lines @param {import("./gl/stage.js").View} view @param {number} x @param {number} y @param {number} vx @param {number} vy @param {number[]} colour */
  #arrow(lines, view, x, y, vx, vy, colour) {
    const dx = 0.25 * vx, dy = 0.25 * vy, far = Math.hypot(dx, dy), head = Math.min(9 * view.ratio / view.scale, 0.4 * far);
    if (far * view.scale < 6 * view.ratio) return;
    lines.add(x, y, x + dx, y + dy, 2.5, colour);
    for (const turn of [2.6, -2.6]) {
      const c = Math.cos(turn) * head / far, s = Math.sin(turn) * head / far;
      lines.add(x + dx, y + dy, x + dx + c * dx - s * dy, y + dy + s * dx + c * dy, 2.5, colour);
    }
  }
}
