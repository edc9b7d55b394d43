// SPDX-License-Identifier: MIT
// What the colours mean.
import { gradient } from "../view/palette.js";
import { byId, element, isDark } from "./dom.js";

/** @param {string} name @param {import("../view/colouring.js").Legend | null} legend */
export function showLegend(name, legend) {
  const box = byId("legend");
  box.replaceChildren();
  if (!legend) return;
  if ("range" in legend) {
    const row = element("div", "", "range"), bar = element("i");
    bar.style.background = gradient(isDark());
    row.append(element("span", `${name} ${legend.range[0]}`), bar, element("span", legend.range[1]));
    box.append(row);
    return;
  }
  const row = element("div", "", "groups");
  for (const group of legend.groups) {
    const entry = element("span"), dot = element("i");
    dot.style.background = group.css;
    entry.append(dot, group.name);
    row.append(entry);
  }
  if (legend.more > 0) row.append(element("span", `and ${legend.more} more in the same colours`, "more"));
  box.append(row);
}
