// SPDX-License-Identifier: MIT
// Which past frames the trails take, and when.
import { LAYERS, LONGEST } from "./gl/trails.js";

const FAR = 300;  // views between camera and anchor from which places are kept anew

/** The frames that a trail of `stride` frames a sample shows at a frame, oldest first. @param {number} frame @param {number} stride */
export function samples(frame, stride) {
  const last = Math.floor(frame / stride), first = Math.max(0, last - LAYERS + 1);
  return { first, frames: Array.from({ length: last - first + 1 }, (_, k) => (first + k) * stride) };
}

export class Trails {
  seconds = 0;  // 0: none
  #anchor = [NaN, NaN];

  /** @param {import("./reader/recording.js").Description} description @param {import("./gl/trails.js").TrailPainter} painter */
  constructor(description, painter) {
    this.description = description;
    this.painter = painter;
  }

  /** Frames from sample to sample. */
  get stride() {
    const { times } = this.description, mean = times.length > 1 ? (times[times.length - 1] - times[0]) / (times.length - 1) : 1;
    return Math.max(1, Math.round(this.seconds / (LAYERS - 1) / mean));
  }

  /** Frames still to be loaded, newest first. @param {number} frame @param {import("./view/frames.js").Frames} held @returns {number[]} */
  wanted(frame, held) {
    if (this.seconds === 0) return [];
    const { first, frames } = samples(frame, this.stride);
    return frames.filter((i, k) => !this.painter.holds(first + k, i) && !held.has(i)).reverse();
  }

  /** @param {number} frame @param {import("./view/frames.js").Frames} held @param {import("./gl/stage.js").View} view */
  prepare(frame, held, view) {
    if (this.seconds === 0) return null;
    if (!(Math.hypot(view.x - this.#anchor[0], view.y - this.#anchor[1]) < FAR * view.width / view.scale)) this.painter.moveAnchor(this.#anchor = [view.x, view.y]);
    const { first, frames } = samples(frame, this.stride), { domain } = this.description;
    frames.forEach((i, k) => {
      const position = this.painter.holds(first + k, i) ? undefined : held.get(i)?.values.position;
      if (position) this.painter.keep(first + k, i, position);
    });
    const longest = domain.kind === "periodic" ? 0.5 * Math.min(domain.max[0] - domain.min[0], domain.max[1] - domain.min[1]) : LONGEST;
    return { first, frames, longest };
  }
}
