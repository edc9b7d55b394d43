// SPDX-License-Identifier: MIT

/** The place of the last of these, which ascend, that is at most `most`; -1 where none is. O(log n). @param {ArrayLike<number>} ascending @param {number} most */
export function lastUpTo(ascending, most) {
  let low = 0, high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ascending[middle] <= most) low = middle + 1; else high = middle;
  }
  return low - 1;
}
