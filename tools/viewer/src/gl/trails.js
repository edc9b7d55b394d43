// SPDX-License-Identifier: MIT
// Draws where bodies came from: their places at some past frames, a layer of a texture each.
import { TRAIL, WIDTH } from "./shaders.js";
import { program } from "./program.js";

export const LAYERS = 24;
/** m: the longest way from sample to sample that is drawn, and a place that is farther from all others. */
export const LONGEST = 1e15, NOWHERE = 1e18;

export class TrailPainter {
  #frames = /** @type {number[]} */ (new Array(LAYERS).fill(-1));  // which frame a layer holds
  anchor = [0, 0];

  /** @param {WebGL2RenderingContext} gl @param {number} bodies */
  constructor(gl, bodies) {
    this.gl = gl;
    this.bodies = bodies;
    this.trail = program(gl, TRAIL[0], TRAIL[1]);
    this.array = gl.createVertexArray();
    this.rows = Math.max(1, Math.ceil(bodies / WIDTH));
    this.places = new Float32Array(2 * WIDTH * this.rows);
    this.texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RG32F, WIDTH, this.rows, LAYERS);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  }

  /** Places are kept from there; what was kept is forgotten. @param {number[]} anchor */
  moveAnchor(anchor) {
    this.anchor = anchor;
    this.#frames.fill(-1);
  }

  /** @param {number} sample @param {number} frame */
  holds(sample, frame) { return this.#frames[sample % LAYERS] === frame; }

  /** Keeps a frame's places. The nth sample has its own layer until LAYERS more have come. @param {number} sample @param {number} frame @param {ArrayLike<number>} position */
  keep(sample, frame, position) {
    const layer = sample % LAYERS, { gl } = this;
    for (let i = 0; i < 2 * this.bodies; i += 2) {
      const there = position[i] === position[i];  // not NaN
      this.places[i] = there ? position[i] - this.anchor[0] : NOWHERE;
      this.places[i + 1] = there ? position[i + 1] - this.anchor[1] : NOWHERE;
    }
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
    gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, layer, WIDTH, this.rows, 1, gl.RG, gl.FLOAT, this.places);
    this.#frames[layer] = frame;
  }

  /**
   * From the oldest of `frames` that is kept to where bodies are now. frames[k] is that of sample first + k.
   * @param {import("./stage.js").View} view @param {number} first @param {number[]} frames @param {number} longest  m, of a segment; what is longer jumped
   */
  draw(view, first, frames, longest) {
    const { gl, trail } = this, last = frames.length - 1;
    trail.use();
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
    trail.whole("states", 0); trail.whole("colours", 1); trail.whole("past", 2);
    trail.set("pixels", view.width, view.height);
    trail.set("scale", view.scale);
    trail.set("width", 1.6 * view.ratio);
    trail.set("anchor", this.anchor[0] - view.x, this.anchor[1] - view.y);
    gl.bindVertexArray(this.array);
    for (let k = 0; k <= last; ++k) {
      const older = (first + k) % LAYERS, newer = k === last ? -1 : (first + k + 1) % LAYERS;
      if (this.#frames[older] !== frames[k] || (newer >= 0 && this.#frames[newer] !== frames[k + 1])) continue;
      trail.whole("older", older);
      trail.whole("newer", newer);
      trail.set("fade", 0.75 * k / frames.length, 0.75 * (k + 1) / frames.length, 0.05, longest);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.bodies);
    }
  }
}
