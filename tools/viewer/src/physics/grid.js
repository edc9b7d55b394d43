// SPDX-License-Identifier: MIT
// Which boxes meet: a hashed grid, each box in every cell that it touches.

const SAMPLE = 1000;

/** From the 1st to the 99th percentile of a sample: strays must not make the cells large. @param {Float64Array} boxes @param {number} axis */
function spread(boxes, axis) {
  const n = boxes.length / 4, step = Math.max(1, Math.floor(n / SAMPLE)), values = [];
  for (let i = 0; i < n; i += step) values.push(boxes[4 * i + axis]);
  values.sort((a, b) => a - b);
  const cut = Math.floor(values.length / 100);
  return [values[cut], values[values.length - 1 - cut]];
}

/** The mean of the longer sides of a sample. @param {Float64Array} boxes */
function meanSize(boxes) {
  const n = boxes.length / 4, step = Math.max(1, Math.floor(n / SAMPLE));
  let sum = 0, count = 0;
  for (let i = 0; i < n; i += step, ++count) sum += Math.max(boxes[4 * i + 2] - boxes[4 * i], boxes[4 * i + 3] - boxes[4 * i + 1]);
  return sum / count;
}

/**
 * Calls meet(a, b), a < b, once for every pair of boxes that touch, of which the first is below `first`. Boxes are min x, min y,
 * max x, max y. O(n k), k = mean number of boxes in a cell.
 * @param {Float64Array} boxes @param {number} first @param {(a: number, b: number) => void} meet
 */
export function eachMeeting(boxes, first, meet) {
  const n = boxes.length / 4;
  if (n < 2) return;
  const [left, right] = spread(boxes, 0), [bottom, top] = spread(boxes, 1);
  const extent = Math.max(right - left, top - bottom), size = Math.max(1.2 * meanSize(boxes), extent / 2000) || 1;
  const columns = Math.floor((right - left) / size) + 1, rows = Math.floor((top - bottom) / size) + 1;
  const column = (/** @type {number} */ x) => Math.min(columns - 1, Math.max(0, Math.floor((x - left) / size)));
  const row = (/** @type {number} */ y) => Math.min(rows - 1, Math.max(0, Math.floor((y - bottom) / size)));

  const cells = new Int32Array(4 * n), start = new Int32Array(columns * rows + 1);
  for (let i = 0; i < n; ++i) {
    const c = 4 * i;
    cells[c] = column(boxes[c]); cells[c + 1] = row(boxes[c + 1]); cells[c + 2] = column(boxes[c + 2]); cells[c + 3] = row(boxes[c + 3]);
    for (let y = cells[c + 1]; y <= cells[c + 3]; ++y)
      for (let x = cells[c]; x <= cells[c + 2]; ++x) ++start[y * columns + x + 1];
  }
  for (let i = 1; i < start.length; ++i) start[i] += start[i - 1];
  const items = new Int32Array(start[start.length - 1]), fill = start.slice(0, -1);
  for (let i = 0; i < n; ++i)
    for (let y = cells[4 * i + 1]; y <= cells[4 * i + 3]; ++y)
      for (let x = cells[4 * i]; x <= cells[4 * i + 2]; ++x) items[fill[y * columns + x]++] = i;

  for (let y = 0; y < rows; ++y)
    for (let x = 0; x < columns; ++x) {
      const cell = y * columns + x;
      for (let k = start[cell]; k < start[cell + 1]; ++k) {
        const a = items[k];
        if (a >= first) break;  // items ascend
        for (let m = k + 1; m < start[cell + 1]; ++m) {
          const b = items[m], p = 4 * a, q = 4 * b;
          if (boxes[p] > boxes[q + 2] || boxes[q] > boxes[p + 2] || boxes[p + 1] > boxes[q + 3] || boxes[q + 1] > boxes[p + 3]) continue;
          if (Math.max(cells[p], cells[q]) === x && Math.max(cells[p + 1], cells[q + 1]) === y) meet(a, b);  // only here
        }
      }
    }
}
