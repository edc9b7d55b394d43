// SPDX-License-Identifier: MIT
// The clock of the replay, in the recording's time, and the frames that it will need.

/** The frame at or before a time. @param {ArrayLike<number>} times @param {number} time */
export function frameAt(times, time) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle; else high = middle - 1;
  }
  return low;
}

const AHEAD = 12;      // frames that are loaded before they are shown
const TICK = 1 / 60;   // s

export class Player {
  playing = false;
  loop = false;
  speed = 1;  // seconds of the recording a second

  /** @param {Float64Array} times  one at least */
  constructor(times) {
    this.times = times;
    this.time = times[0];
  }

  get first() { return this.times[0]; }
  get last() { return this.times[this.times.length - 1]; }
  get frame() { return frameAt(this.times, this.time); }

  /** @param {boolean} on */
  play(on) {
    this.playing = on;
    if (on && this.time >= this.last) this.time = this.first;
  }

  /** @param {number} time */
  seek(time) { this.time = Math.min(this.last, Math.max(this.first, time)); }

  /** To a frame, standing. @param {number} frame */
  stand(frame) {
    this.playing = false;
    this.time = this.times[Math.min(this.times.length - 1, Math.max(0, frame))];
  }

  /** Time goes on by `seconds` of the clock on the wall. @param {number} seconds */
  advance(seconds) {
    if (!this.playing) return;
    this.seek(this.time + seconds * this.speed);
    if (this.time < this.last) return;
    if (this.loop) this.time = this.first; else this.playing = false;
  }

  /** Frames that go by from tick to tick of the screen. @returns {number} */
  stride() {
    const { times } = this, mean = times.length > 1 ? (this.last - this.first) / (times.length - 1) : 1;
    return mean > 0 ? this.speed * TICK / mean : 1;
  }

  /** The two frames between which the time is, and how far it is from the first to the second, 0 to 1. Where frames fly past, one and 0. */
  between() {
    const { times, time } = this, a = frameAt(times, time), b = Math.min(a + 1, times.length - 1);
    if (a === b || time === times[a] || (this.playing && this.stride() >= 1)) return { a, b: a, t: 0 };
    return { a, b, t: (time - times[a]) / (times[b] - times[a]) };
  }

  /** What is shown now, then what will be. @returns {number[]} */
  wanted() {
    const { a, b } = this.between(), frames = a === b ? [a] : [a, b], last = this.times.length - 1;
    if (!this.playing) return [...frames, ...[a + 1, a - 1].filter(i => i >= 0 && i <= last && i !== b)];
    const stride = Math.max(1, this.stride());
    for (let k = 1; k <= AHEAD; ++k) {
      const next = stride > 1 ? frameAt(this.times, this.time + k * TICK * this.speed) : a + k;
      if (next <= last && !frames.includes(next)) frames.push(next);
    }
    return frames;
  }
}

/** Round speeds that show a run of `seconds` in sensible time. @param {number} seconds  of the recording */
export function speeds(seconds) {
  const choices = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
  const natural = seconds > 120 ? seconds / 60 : seconds < 0.5 && seconds > 0 ? seconds / 5 : 1;
  const scale = natural === 1 ? 1 : 10 ** Math.round(Math.log10(natural));
  return { choices: choices.map(c => Number((c * scale).toPrecision(3))), start: Number(scale.toPrecision(3)) };
}
