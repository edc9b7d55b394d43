// SPDX-License-Identifier: MIT
// Draws all bodies: three calls, whatever their shapes.
import { DISC, EDGE, TRIANGLE } from "./shaders.js";
import { layout, program } from "./program.js";

/** @typedef {{array: WebGLVertexArrayObject, count: number}} Batch */

const ROW = { size: 1, whole: true };
const RIM = 1.6;          // pixels of the page
const OUTLINED = 2.5;     // pixels of radius from which bodies have an outline

/** @param {WebGL2RenderingContext} gl @param {import("../view/mesh.js").Rows} rows @param {number} size @param {boolean} instanced @returns {Batch} */
function batch(gl, rows, size, instanced) {
  const buffer = /** @type {WebGLBuffer} */ (gl.createBuffer());
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, rows.data, gl.STATIC_DRAW);
  return { array: layout(gl, buffer, [ROW, { size }], instanced), count: rows.count };
}

export class BodyPainter {
  /** @param {WebGL2RenderingContext} gl @param {import("../view/mesh.js").Mesh} mesh @param {number} radius  m, of a typical body */
  constructor(gl, mesh, radius) {
    this.gl = gl;
    this.radius = radius;
    this.disc = program(gl, DISC[0], DISC[1]);
    this.triangle = program(gl, TRIANGLE[0], TRIANGLE[1]);
    this.edge = program(gl, EDGE[0], EDGE[1]);
    this.discs = batch(gl, mesh.discs, 3, true);
    this.composites = batch(gl, mesh.composites, 3, true);
    this.triangles = batch(gl, mesh.triangles, 2, false);
    this.edges = batch(gl, mesh.edges, 4, true);
  }

  /** Expects the states and the colours in texture units 0 and 1. @param {import("./stage.js").View} view @param {boolean} turns */
  draw(view, turns) {
    const rim = this.radius * view.scale > OUTLINED * view.ratio ? RIM * view.ratio : 0;
    this.#triangles(view);
    if (rim > 0) this.#edges(view, rim);
    if (this.composites.count > 0) {
      if (rim > 0) this.#discs(view, this.composites, { rim: 0, inset: 0, turn: 0, whole: 1 });
      this.#discs(view, this.composites, { rim: 0, inset: rim, turn: 0, whole: 0 });
    }
    if (this.discs.count > 0) this.#discs(view, this.discs, { rim, inset: 0, turn: turns && rim > 0 ? RIM * view.ratio : 0, whole: 0 });
  }

  /** @param {import("./program.js").Program} used @param {import("./stage.js").View} view */
  #common(used, view) {
    used.use();
    used.whole("states", 0);
    used.whole("colours", 1);
    used.set("pixels", view.width, view.height);
    used.set("scale", view.scale);
    used.set("size", ...view.domain.size);
    used.set("middle", ...view.domain.middle);
  }

  /** Calls once for every image that a periodic domain shows. @param {import("./program.js").Program} used @param {import("./stage.js").View} view @param {() => void} call */
  #images(used, view, call) {
    for (const image of view.domain.size[0] > 0 ? [[0, 0], [1, 0], [0, 1], [1, 1]] : [[0, 0]]) {
      used.set("image", ...image);
      call();
    }
  }

  /** @param {import("./stage.js").View} view @param {Batch} batch @param {{rim: number, inset: number, turn: number, whole: number}} look */
  #discs(view, batch, look) {
    this.#common(this.disc, view);
    for (const [name, value] of Object.entries(look)) this.disc.set(name, value);
    this.gl.bindVertexArray(batch.array);
    this.#images(this.disc, view, () => this.gl.drawArraysInstanced(this.gl.TRIANGLE_STRIP, 0, 4, batch.count));
  }

  /** @param {import("./stage.js").View} view */
  #triangles(view) {
    if (this.triangles.count === 0) return;
    this.#common(this.triangle, view);
    this.gl.bindVertexArray(this.triangles.array);
    this.#images(this.triangle, view, () => this.gl.drawArrays(this.gl.TRIANGLES, 0, this.triangles.count));
  }

  /** @param {import("./stage.js").View} view @param {number} rim */
  #edges(view, rim) {
    if (this.edges.count === 0) return;
    this.#common(this.edge, view);
    this.edge.set("rim", Math.min(rim, 0.3 * this.radius * view.scale));
    this.gl.bindVertexArray(this.edges.array);
    this.#images(this.edge, view, () => this.gl.drawArraysInstanced(this.gl.TRIANGLE_STRIP, 0, 4, this.edges.count));
  }
}

