// SPDX-License-Identifier: MIT
// Drag, wheel, pinch and tap on the picture.

const TAP = 6;  // pixels that a finger may slip

/**
 * @param {HTMLCanvasElement} canvas
 * @param {{pan: (dx: number, dy: number) => void, zoom: (factor: number, x: number, y: number) => void, tap: (x: number, y: number) => void}} hands
 */
export function bindPointer(canvas, { pan, zoom, tap }) {
  const held = /** @type {Map<number, {x: number, y: number}>} */ (new Map());
  let moved = 0;
  const spread = () => { const [a, b] = [...held.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  const middle = () => { const all = [...held.values()]; return [all.reduce((s, p) => s + p.x, 0) / all.length, all.reduce((s, p) => s + p.y, 0) / all.length]; };

  canvas.addEventListener("pointerdown", e => {
    canvas.setPointerCapture(e.pointerId);
    if (held.size === 0) moved = 0; else moved = Infinity;
    held.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
  });
  canvas.addEventListener("pointermove", e => {
    const before = held.get(e.pointerId);
    if (!before) return;
    const [x, y] = middle(), apart = held.size === 2 ? spread() : 0;
    held.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
    const [nx, ny] = middle();
    moved += Math.hypot(e.offsetX - before.x, e.offsetY - before.y);
    if (moved <= TAP) return;
    pan(nx - x, ny - y);
    if (apart > 0) zoom(spread() / apart, nx, ny);
  });
  canvas.addEventListener("pointerup", e => {
    if (held.delete(e.pointerId) && moved <= TAP) tap(e.offsetX, e.offsetY);
  });
  canvas.addEventListener("pointercancel", e => held.delete(e.pointerId));
  canvas.addEventListener("wheel", e => {
    e.preventDefault();
    const pixels = e.deltaY * (e.deltaMode === 1 ? 16 : 1);
    zoom(Math.exp(-Math.max(-300, Math.min(300, pixels)) / 400), e.offsetX, e.offsetY);
  }, { passive: false });
}
