// SPDX-License-Identifier: MIT
// What part of the plane is seen, and how large.

const MARGIN = 38;  // pixels above and below what is fitted, for the legend and the scale

export class Camera {
  x = 0; y = 0;          // m, at the middle
  scale = 1;             // pixels of the page a metre
  width = 1; height = 1; // pixels of the page
  fitted = true;         // nobody has moved it yet

  /** Shows all of left, bottom, right, top. @param {number[]} extent */
  fit([left, bottom, right, top]) {
    this.x = (left + right) / 2;
    this.y = (bottom + top) / 2;
    this.scale = Math.min(this.width / (right - left), Math.max(0.5 * this.height, this.height - 2 * MARGIN) / (top - bottom));
    this.fitted = true;
  }

  /** The place under the pixel px, py stays there. @param {number} factor @param {number} [px] @param {number} [py] */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.world(px, py);
    this.scale *= factor;
    this.x = x - (px - this.width / 2) / this.scale;
    this.y = y + (py - this.height / 2) / this.scale;
    this.fitted = false;
  }

  /** By pixels. @param {number} dx @param {number} dy */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.fitted = false;
  }

  /** The pixel over a place. @param {number} x @param {number} y */
  pixel(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  /** The place under a pixel. @param {number} px @param {number} py */
  world(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }
}

/** A length that is easily read, 1, 2 or 5 times a power of ten, at most `limit`. @param {number} limit */
export function roundBelow(limit) {
  const power = 10 ** Math.floor(Math.log10(limit)), digit = [5, 2, 1].find(d => d * power <= limit * (1 + 1e-12)) ?? 1;
  return Number((digit * power).toPrecision(1));
}
