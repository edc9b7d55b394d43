// SPDX-License-Identifier: MIT
// The colours as those see them who lack one kind of cone: simulated after Machado, Oliveira and Fernandes 2009, severity 1.
import assert from "node:assert/strict";
import { test } from "node:test";
import { groupColour, KINEMATIC, ramp, STATIC, table } from "../../tools/viewer/src/view/palette.js";

const EYES = {
  all: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  "no red": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  "no green": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  "no blue": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};

const times = (matrix, v) => matrix.map(row => row.reduce((sum, m, k) => sum + m * v[k], 0));
const linear = value => value <= 10.31475 ? value / 3294.6 : ((value / 255 + 0.055) / 1.055) ** 2.4;
const TO_XYZ = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
const cube = t => t > 216 / 24389 ? Math.cbrt(t) : (24389 / 27 * t + 16) / 116;

/** CIE L*a*b* of a colour as such eyes see it. @param {number[]} rgb  0 to 255 @param {number[][]} eyes */
function lab(rgb, eyes) {
  const seen = times(eyes, rgb.map(linear)).map(value => Math.min(1, Math.max(0, value))), [x, y, z] = times(TO_XYZ, seen);
  const [fx, fy, fz] = [cube(x / 0.9505), cube(y), cube(z / 1.089)];
  return [116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)];
}
const apart = (a, b) => Math.hypot(...a.map((value, k) => value - b[k]));

test("white is light and black is not, to all eyes", () => {
  for (const eyes of Object.values(EYES)) {
    assert.ok(Math.abs(lab([255, 255, 255], eyes)[0] - 100) < 0.1 && lab([0, 0, 0], eyes)[0] === 0);
  }
});

for (const [who, eyes] of Object.entries(EYES)) {
  test(`seven groups are told apart by eyes with ${who}`, () => {
    const colours = Array.from({ length: 7 }, (_, i) => lab(groupColour(i), eyes));
    let least = Infinity;
    for (let i = 0; i < 7; ++i) for (let k = 0; k < i; ++k) least = Math.min(least, apart(colours[i], colours[k]));
    assert.ok(least > 15, `${least}`);
  });

  for (const dark of [false, true])
    test(`more is lighter, evenly, to eyes with ${who}, ${dark ? "in the dark" : "by day"}`, () => {
      const steps = Array.from({ length: 11 }, (_, i) => lab(ramp(i / 10, dark), eyes)[0]).map((value, i, all) => i ? value - all[i - 1] : 0).slice(1);
      assert.ok(steps.every(step => step > 2), `${steps}`);
    });

  test(`what doesn't move freely looks like no group to eyes with ${who}`, () => {
    for (const dark of [false, true])
      for (const place of [STATIC, KINEMATIC]) {
        const grey = lab([...table(dark).subarray(4 * place, 4 * place + 3)], eyes), near = Math.min(...Array.from({ length: 7 }, (_, i) => apart(grey, lab(groupColour(i), eyes))));
        assert.ok(near > 10, `${near}`);
      }
  });
}
