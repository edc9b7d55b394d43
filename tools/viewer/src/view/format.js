// SPDX-License-Identifier: MIT
// Numbers as people read them.

/** @param {number} value @param {number} [digits] */
export function short(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(digits - 1).replace("e+", "e").replace("-", "−").replace("e-", "e−");
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

/** @param {number} metres */
export function length(metres, digits = 3) {
  const size = Math.abs(metres);
  if (size === 0) return "0 m";
  if (size >= 1000) return `${short(metres / 1000, digits)} km`;
  if (size >= 1) return `${short(metres, digits)} m`;
  if (size >= 0.01) return `${short(metres * 100, digits)} cm`;
  if (size >= 1e-5) return `${short(metres * 1000, digits)} mm`;
  return `${short(metres * 1e6, digits)} µm`;
}

const PREFIXES = ["n", "µ", "m", "", "k", "M", "G", "T"];

/** With the prefix that keeps numbers short: 84.2 kJ. @param {number} value @param {string} unit */
export function si(value, unit) {
  const size = Math.abs(value), thousands = size > 0 ? Math.floor(Math.log10(size) / 3 + 1e-9) : 0;
  if (!Number.isFinite(value) || thousands < -3 || thousands > 4) return `${short(value)} ${unit}`;
  return `${short(value / 1000 ** thousands)} ${PREFIXES[thousands + 3]}${unit}`;
}

/** With as many decimals as `step` has. @param {number} value @param {number} step */
export function toStep(value, step) {
  const decimals = Math.min(9, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
  return value.toFixed(decimals).replace("-", "−");
}

/** With thin spaces between thousands. @param {number} value */
export const count = value => String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, " ");
