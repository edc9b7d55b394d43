// SPDX-License-Identifier: MIT
// Elements of the page. What comes from a file is only ever set as text.

/** @param {string} id @returns {any} */
export const byId = id => {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no #${id} in the page`);
  return found;
};

/** @param {string} tag @param {string} [text] @param {string} [className] */
export function element(tag, text = "", className = "") {
  const made = document.createElement(tag);
  if (text) made.textContent = text;
  if (className) made.className = className;
  return made;
}

/** A colour of the page's style, as RGB. @param {string} name @returns {[number, number, number]} */
export function styleColour(name) {
  const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return /** @type {[number, number, number]} */ ([1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16)));
}

export const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;

/** Pairs of a term and what it says. @param {HTMLElement} list @param {[string, string][]} pairs */
export function fillList(list, pairs) {
  list.replaceChildren(...pairs.flatMap(([term, text]) => [element("dt", term), element("dd", text)]));
}

/** @param {HTMLSelectElement} select @param {{value: string, text: string}[]} options @param {string} chosen */
export function fillSelect(select, options, chosen) {
  select.replaceChildren(...options.map(({ value, text }) => new Option(text, value, false, value === chosen)));
}
