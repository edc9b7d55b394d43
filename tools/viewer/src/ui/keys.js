// SPDX-License-Identifier: MIT
// The keyboard: every key with what it does, for the handler and for the help.
import { byId, element } from "./dom.js";

/** @typedef {{keys: string[], shown: string, says: string, does: (event: KeyboardEvent) => void}} Key */

/** @param {EventTarget | null} target */
const takesText = target => target instanceof HTMLElement && (target.matches("select, textarea") || target.matches("input:not([type=checkbox]):not(#scrub)"));

/** @param {Key[]} all */
export function bindKeys(all) {
  addEventListener("keydown", event => {
    const dialog = byId("keys");
    if (event.ctrlKey || event.altKey || event.metaKey || dialog.open) return;
    if (event.key === "Escape" && takesText(event.target)) { /** @type {HTMLElement} */ (event.target).blur(); return; }
    const presses = event.target instanceof HTMLElement && event.target.matches("button, label, [type=checkbox]") && (event.key === " " || event.key === "Enter");
    if (takesText(event.target) || presses) return;
    const key = all.find(({ keys }) => keys.includes(event.key.length === 1 ? event.key.toLowerCase() : event.key));
    if (!key) return;
    event.preventDefault();
    key.does(event);
  });
  const list = byId("key-list");
  for (const { shown, says } of all) {
    const term = element("dt");
    term.append(element("kbd", shown));
    list.append(term, element("dd", says));
  }
}
