#!/usr/bin/python3
"""Draws what `throng bench stability --json ROWS` found: plot/stability.py ROWS FOLDER

Writes to FOLDER a page per scene, stability_SCENE.svg and .png: a strip for each factor, a heat map for each two.
A cell's colour is its verdict; in it stand, where they are more than rounding, the energy gained (E), the deepest overlap
in radii (o), the speed at the end (v) and of boxes how far they are off (m). Needs matplotlib (Debian: python3-matplotlib).
"""
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "throng"
import matplotlib.pyplot as plt

COLOURS = {"stable": "#8fcf9f", "drifting": "#f2d479", "exploded": "#e07b6a"}
FIGURES = (("energy", "E", 0.01), ("overlap", "o", 0.01), ("speed", "v", 0.01), ("moved", "m", 0.01))


def figures(error):
    """The two that say most, each against what is hardly worth a word."""
    told = [(abs(error[key]) / least, f"{sign} {error[key]:.1g}") for key, sign, least in FIGURES
            if error.get(key) is not None and abs(error[key]) >= least]
    return "\n".join(text for _, text in sorted(told, reverse=True)[:2])


def value_text(factor, value):
    if factor.startswith("dt"):
        return f"1/{round(1 / value)}"
    return f"{value:g}"


def draw_cells(axes, rows):
    """A cell for each row: columns by x, from the bottom up by y."""
    xs = sorted({row["error"]["x_value"] for row in rows})
    ys = sorted({row["error"].get("y_value", 0) for row in rows})
    for row in rows:
        error = row["error"]
        x, y = xs.index(error["x_value"]), ys.index(error.get("y_value", 0))
        axes.add_patch(plt.Rectangle((x, y), 1, 1, facecolor=COLOURS[error["verdict"]], edgecolor="white", linewidth=1.5))
        axes.text(x + 0.5, y + 0.5, figures(error), ha="center", va="center", fontsize=6.5, color="#333333")
    error = rows[0]["error"]
    axes.set_xlim(0, len(xs)), axes.set_ylim(0, len(ys))
    axes.set_xticks([i + 0.5 for i in range(len(xs))], [value_text(error["x"], value) for value in xs], fontsize=8)
    axes.set_xlabel(error["x"], fontsize=9)
    if "y" in error:
        axes.set_yticks([i + 0.5 for i in range(len(ys))], [value_text(error["y"], value) for value in ys], fontsize=8)
        axes.set_ylabel(error["y"], fontsize=9)
    else:
        axes.set_yticks([])
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)


def draw(scene, cases, file):
    strips = [rows for rows in cases.values() if "y" not in rows[0]["error"]]
    maps = [rows for rows in cases.values() if "y" in rows[0]["error"]]
    heights = [1.0] * ((len(strips) + 1) // 2) + [4.6] * ((len(maps) + 1) // 2)
    figure = plt.figure(figsize=(11, 1.0 + 1.15 * sum(0.75 * h + 0.25 for h in heights)))
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights, hspace=0.75 / (sum(heights) / len(heights)), wspace=0.16,
                               left=0.07, right=0.985, top=0.93, bottom=0.06)
    for part, first in ((strips, 0), (maps, (len(strips) + 1) // 2)):
        for i, rows in enumerate(part):
            draw_cells(figure.add_subplot(grid[first + i // 2, i % 2]), rows)
    figure.suptitle(f"{scene} under stress", fontsize=12, x=0.07, ha="left", y=0.985)
    marks = [plt.Rectangle((0, 0), 1, 1, facecolor=colour) for colour in COLOURS.values()]
    figure.legend(marks, COLOURS, loc="upper right", ncols=3, fontsize=9, frameon=False, bbox_to_anchor=(0.99, 0.995))
    figure.savefig(file + ".svg", metadata={"Date": None})
    figure.savefig(file + ".png", dpi=110)
    plt.close(figure)


def main(file, folder):
    with open(file) as source:
        rows = [row for row in json.load(source) if row["bench"] == "stability"]
    os.makedirs(folder, exist_ok=True)
    for scene in dict.fromkeys(row["error"]["scene"] for row in rows):
        cases = {}
        for row in rows:
            if row["error"]["scene"] == scene:
                cases.setdefault(row["case"], []).append(row)
        draw(scene, cases, os.path.join(folder, f"stability_{scene}"))
        print(os.path.join(folder, f"stability_{scene}.png"))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
