// SPDX-License-Identifier: MIT
// Fills areas, whatever their outlines: what an odd number of fans covers is inside (even-odd, by the stencil).
import { AREA } from "./shaders.js";
import { layout, program } from "./program.js";

/** @typedef {{rings: ArrayLike<number>[], colour: number[]}} Filled  colour: RGB 0 to 255, alpha 0 to 1 */

/** A triangle from the first point to each edge. @param {ArrayLike<number>[]} rings @param {number[]} anchor @returns {number[]} */
export function fans(rings, [x, y]) {
  const out = [];
  for (const p of rings)
    for (let i = 4; i < p.length; i += 2) out.push(p[0] - x, p[1] - y, p[i - 2] - x, p[i - 1] - y, p[i] - x, p[i + 1] - y);
  return out;
}

export class AreaPainter {
  #areas = /** @type {{first: number, count: number, colour: number[]}[]} */ ([]);
  #anchor = [0, 0];

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    this.fill = program(gl, AREA[0], AREA[1]);
    this.buffer = /** @type {WebGLBuffer} */ (gl.createBuffer());
    this.array = layout(gl, this.buffer, [{ size: 2 }], false);
  }

  /** @param {number[]} anchor  m, near what is seen @param {Filled[]} areas */
  load(anchor, areas) {
    const { gl } = this, points = /** @type {number[]} */ ([]);
    this.#anchor = anchor;
    this.#areas = areas.map(({ rings, colour }) => {
      const fan = fans(rings, anchor), first = points.length / 2;
      for (const value of fan) points.push(value);
      return { first, count: fan.length / 2, colour };
    });
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(points), gl.STATIC_DRAW);
  }

  /** Twice over the fans: the first time marks what is inside, the second paints it and takes the marks away. @param {import("./stage.js").View} view */
  draw(view) {
    const { gl, fill } = this;
    if (this.#areas.length === 0) return;
    fill.use();
    fill.set("pixels", view.width, view.height);
    fill.set("scale", view.scale);
    fill.set("anchor", this.#anchor[0] - view.x, this.#anchor[1] - view.y);
    gl.bindVertexArray(this.array);
    gl.enable(gl.STENCIL_TEST);
    for (const { first, count, colour: [r, g, b, alpha] } of this.#areas) {
      gl.colorMask(false, false, false, false);
      gl.stencilFunc(gl.ALWAYS, 0, 1);
      gl.stencilOp(gl.KEEP, gl.KEEP, gl.INVERT);
      gl.drawArrays(gl.TRIANGLES, first, count);
      gl.colorMask(true, true, true, true);
      gl.stencilFunc(gl.NOTEQUAL, 0, 1);
      gl.stencilOp(gl.KEEP, gl.KEEP, gl.ZERO);
      fill.set("paint", alpha * r / 255, alpha * g / 255, alpha * b / 255, alpha);
      gl.drawArrays(gl.TRIANGLES, first, count);
    }
    gl.disable(gl.STENCIL_TEST);
  }
}
