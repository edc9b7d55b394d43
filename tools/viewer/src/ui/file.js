// SPDX-License-Identifier: MIT
// Where recordings come from: the page itself, the file picker, or dropped on it.
import { byId } from "./dom.js";

/** The bytes of base64. @param {string} text */
function decode(text) {
  const made = /** @type {any} */ (Uint8Array);
  if (made.fromBase64) return made.fromBase64(text);
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

/** What an element of the page holds as base64; its text is let go. @param {string} id */
function take(id) {
  const holder = byId(id), text = holder.textContent.trim();
  holder.textContent = "";
  return decode(text);
}

/** The recording that the page holds. */
export const embedded = () => new Blob([take("recording")]);

/** Where the reader's code, which the page holds compressed, can be started from. */
export async function readerUrl() {
  const stream = new Blob([take("reader")]).stream().pipeThrough(new DecompressionStream("gzip"));
  return URL.createObjectURL(new Blob([await new Response(stream).blob()], { type: "text/javascript" }));
}

/** @param {(file: File) => void} open */
export function bindFiles(open) {
  const input = byId("file"), cover = byId("drop");
  byId("open").addEventListener("click", () => input.click());
  input.addEventListener("change", () => { if (input.files.length) open(input.files[0]); input.value = ""; });
  let inside = 0;
  addEventListener("dragenter", e => { e.preventDefault(); cover.hidden = ++inside === 0; });
  addEventListener("dragleave", () => { cover.hidden = --inside <= 0; });
  addEventListener("dragover", e => e.preventDefault());
  addEventListener("drop", e => {
    e.preventDefault();
    inside = 0;
    cover.hidden = true;
    const file = e.dataTransfer?.files[0];
    if (file) open(file);
  });
}
