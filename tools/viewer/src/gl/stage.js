// SPDX-License-Identifier: MIT
// The picture: what lies behind, the bodies, what is drawn over them.
import { AreaPainter } from "./areas.js";
import { BodyPainter } from "./bodies.js";
import { LinePainter } from "./lines.js";
import { WIDTH } from "./shaders.js";
import { TrailPainter } from "./trails.js";

/**
 * @typedef {{x: number, y: number, scale: number, width: number, height: number, ratio: number,
 *   domain: {size: number[], middle: number[]}}} View
 *   the camera in device pixels; of a periodic domain its size (0 of others) and its middle from the camera (m)
 */

export class Stage {
  /** Throws where the browser has no WebGL2. @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, stencil: true, powerPreference: "high-performance", preserveDrawingBuffer: false });
    if (!gl) throw new Error("this browser has no WebGL2, which the picture needs");
    this.gl = gl;
    this.canvas = canvas;
    this.areas = new AreaPainter(gl);
    this.under = new LinePainter(gl);
    this.over = new LinePainter(gl);
    this.links = new LinePainter(gl);
    this.colours = this.#texture();
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** @param {import("../view/mesh.js").Mesh} mesh @param {number} bodies @param {number} radius  m, of a typical body */
  open(mesh, bodies, radius) {
    this.bodies = new BodyPainter(this.gl, mesh, radius);
    this.trails = new TrailPainter(this.gl, bodies);
    this.rows = Math.max(1, Math.ceil(bodies / WIDTH));
    this.states = this.#texture();
    this.stateTexels = new Float32Array(4 * WIDTH * this.rows);
    this.gl.texStorage2D(this.gl.TEXTURE_2D, 1, this.gl.RGBA32F, WIDTH, this.rows);
  }

  #texture() {
    const { gl } = this, texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  }

  /** @param {Uint8Array} bytes  256 times RGBA */
  setColours(bytes) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }

  /** Hands stateTexels to the graphics card. */
  loadStates() {
    const { gl } = this;
    if (!this.stateTexels || !this.rows || !this.states) return;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.states);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, this.rows, gl.RGBA, gl.FLOAT, this.stateTexels);
  }

  /** @param {number[]} colour RGB */
  clear([r, g, b]) {
    const { gl, canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(r / 255, g / 255, b / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  }

  /** @param {View} view @param {{turns: boolean, trail: {first: number, frames: number[], longest: number} | null, links: boolean}} what */
  draw(view, { turns, trail, links }) {
    const { gl } = this;
    this.areas.draw(view);
    this.under.draw(view);
    this.#clip(view, () => {
      gl.activeTexture(gl.TEXTURE1);
      gl.bindTexture(gl.TEXTURE_2D, this.colours);
      if (trail && this.trails) this.trails.draw(view, trail.first, trail.frames, trail.longest);
      if (this.bodies) this.bodies.draw(view, turns);
      if (links) this.links.draw(view);
    });
    this.over.draw(view);
  }

  /** What is outside a periodic domain is an image of what is inside. @param {View} view @param {() => void} call */
  #clip({ domain: { size, middle }, scale, width, height }, call) {
    if (!(size[0] > 0)) return call();
    const { gl } = this, left = width / 2 + (middle[0] - size[0] / 2) * scale, bottom = height / 2 + (middle[1] - size[1] / 2) * scale;
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(Math.round(left), Math.round(bottom), Math.round(size[0] * scale), Math.round(size[1] * scale));
    call();
    gl.disable(gl.SCISSOR_TEST);
  }
}
