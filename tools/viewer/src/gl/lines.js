// SPDX-License-Identifier: MIT
// Draws straight lines of any width: walls, borders, rings, links.
import { LINE } from "./shaders.js";
import { layout, program } from "./program.js";

const WORDS = 7;  // a line: ends, width, dash, RGBA

/** Lines collected on their way to the graphics card. Places are metres from an anchor, so that they stay exact far from 0, 0. */
export class Lines {
  count = 0;
  #data = new ArrayBuffer(4 * WORDS * 256);
  floats = new Float32Array(this.#data);
  bytes = new Uint8Array(this.#data);

  /** @param {number[]} anchor  m */
  constructor(anchor) { this.anchor = anchor; }

  /** @param {number} ax @param {number} ay @param {number} bx @param {number} by @param {number} width  pixels @param {number[]} colour  RGB, 0 to 255, and alpha, 0 to 1 @param {number} [dash]  pixels */
  add(ax, ay, bx, by, width, colour, dash = 0) {
    if (4 * WORDS * (this.count + 1) > this.#data.byteLength) this.#grow();
    const at = WORDS * this.count++, [x, y] = this.anchor;
    this.floats[at] = ax - x; this.floats[at + 1] = ay - y; this.floats[at + 2] = bx - x; this.floats[at + 3] = by - y;
    this.floats[at + 4] = width; this.floats[at + 5] = dash;
    for (let k = 0; k < 3; ++k) this.bytes[4 * (at + 6) + k] = colour[k];
    this.bytes[4 * (at + 6) + 3] = 255 * (colour[3] ?? 1);
  }

  /** @param {number} x @param {number} y @param {number} radius @param {number} width @param {number[]} colour @param {number} [dash] */
  ring(x, y, radius, width, colour, dash = 0) {
    const steps = 96;
    for (let i = 0; i < steps; ++i) {
      const a = 2 * Math.PI * i / steps, b = 2 * Math.PI * (i + 1) / steps;
      if (dash === 0 || i % 2 === 0) this.add(x + radius * Math.cos(a), y + radius * Math.sin(a), x + radius * Math.cos(b), y + radius * Math.sin(b), width, colour);
    }
  }

  /** @param {ArrayLike<number>} points  x, y, x, y @param {boolean} closed @param {number} width @param {number[]} colour @param {number} [dash] */
  path(points, closed, width, colour, dash = 0) {
    for (let i = closed ? 0 : 2; i < points.length; i += 2) {
      const j = i === 0 ? points.length - 2 : i - 2;
      this.add(points[j], points[j + 1], points[i], points[i + 1], width, colour, dash);
    }
  }

  #grow() {
    const larger = new Uint8Array(2 * this.#data.byteLength);
    larger.set(this.bytes);
    this.bytes = larger;
    this.#data = larger.buffer;
    this.floats = new Float32Array(this.#data);
  }
}

export class LinePainter {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    this.line = program(gl, LINE[0], LINE[1]);
    this.buffer = /** @type {WebGLBuffer} */ (gl.createBuffer());
    this.array = layout(gl, this.buffer, [{ size: 4 }, { size: 2 }, { size: 4, bytes: true }], true);
    this.anchor = [0, 0];
    this.count = 0;
  }

  /** Takes the lines over. @param {Lines} lines */
  load(lines) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, lines.floats.subarray(0, WORDS * lines.count), gl.DYNAMIC_DRAW);
    this.anchor = lines.anchor;
    this.count = lines.count;
  }

  /** @param {import("./stage.js").View} view */
  draw(view) {
    if (this.count === 0) return;
    this.line.use();
    this.line.set("pixels", view.width, view.height);
    this.line.set("scale", view.scale);
    this.line.set("ratio", view.ratio);
    this.line.set("anchor", this.anchor[0] - view.x, this.anchor[1] - view.y);
    this.gl.bindVertexArray(this.array);
    this.gl.drawArraysInstanced(this.gl.TRIANGLE_STRIP, 0, 4, this.count);
  }
}
