#!/usr/bin/python3
"""Draws what `throng bench validation --json ROWS` found: plot/validation.py ROWS FOLDER

Writes bottleneck, fundamental_diagram, counterflow, exit and verdicts to FOLDER, each as .svg and .png, as far as the
rows hold them. Needs matplotlib (Debian: python3-matplotlib).
"""
import json
import math
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def series(rows, case):
    """The numbers behind a case, by model: those that have any."""
    found = {row["engine"]: row["error"]["series"] for row in rows if row["case"].startswith(case)
             and row["error"].get("series")}
    return {model: values for model, values in found.items() if model != "constant_velocity"}


def save(figure, folder, name):
    for kind in ("svg", "png"):
        figure.savefig(os.path.join(folder, f"{name}.{kind}"), dpi=120, bbox_inches="tight")
    plt.close(figure)
    print(os.path.join(folder, name + ".svg"))


def chart(x, y):
    figure, axes = plt.subplots(figsize=(6, 4))
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.3)
    return figure, axes


def bottleneck(rows, folder):
    models = series(rows, "Seyfried 2009: flow through")
    if not models:
        return
    figure, axes = chart("width of the bottleneck, m", "flow, 1/s")
    for model, values in models.items():
        axes.plot(values["width"][:len(values["flow"])], values["flow"], "o-", label=model)
    measured = next(iter(models.values()))
    axes.errorbar(measured["width"], measured["seyfried_2009"], yerr=0.5, fmt="ks", capsize=4,
                  label="Seyfried 2009, and 0.5 /s")
    axes.legend()
    save(figure, folder, "bottleneck")


def fundamental_diagram(rows, folder):
    models = series(rows, "Weidmann")
    if not models:
        return
    figure, axes = chart("density, 1/m²", "speed, m/s")
    for model, values in models.items():
        axes.plot(values["density"], values["speed"], "o-", label=model)
    densities = [0.05 * i for i in range(2, 108)]
    axes.plot(densities, [1.34 * (1 - math.exp(-1.913 * (1 / d - 1 / 5.4))) for d in densities], "k", label="Weidmann")
    axes.legend()
    save(figure, folder, "fundamental_diagram")


def counterflow(rows, folder):
    models = series(rows, "IMO 8")
    if not models:
        return
    figure, axes = chart("people against 100", "last of the 100 in the other room, s")
    for model, values in models.items():
        axes.plot([0, 10, 50, 100][:len(values["last"])], values["last"], "o-", label=model)
    axes.legend()
    save(figure, folder, "counterflow")


def exit_of_room(rows, folder):
    models = series(rows, "IMO 4")
    if not models:
        return
    figure, axes = chart("time, s", "people who left through 1 m")
    for model, values in models.items():
        times = values["times"][0]
        axes.plot(times, range(1, len(times) + 1), label=model)
    longest = max(values["times"][0][-1] for values in models.values())
    axes.plot([0, min(longest, 100 / 1.33)], [0, 1.33 * min(longest, 100 / 1.33)], "k--", label="IMO: 1.33 /s at most")
    axes.legend()
    save(figure, folder, "exit")


def verdicts(rows, folder):
    """A field a case and model: passed, failed, failed by nature, asked for as a number alone."""
    colours = {"pass": "#4c9f70", "fail": "#d1603d", "nature": "#e0b45c", "documented": "#9aa5b1"}
    cases = list(dict.fromkeys(row["case"] for row in rows))
    models = list(dict.fromkeys(row["engine"] for row in rows))
    figure, axes = plt.subplots(figsize=(1.5 * len(models) + 4, 0.32 * len(cases) + 1.5))
    for row in rows:
        error, y = row["error"], cases.index(row["case"])
        kind = "nature" if error.get("by_nature") else error["verdict"]
        x = models.index(row["engine"])
        axes.add_patch(plt.Rectangle((x, y), 0.96, 0.92, color=colours[kind]))
        value = "-" if error["value"] is None else f"{error['value']:.3g} {error['unit']}"
        axes.text(x + 0.48, y + 0.46, value, ha="center", va="center", fontsize=7)
    axes.set_xlim(0, len(models))
    axes.set_ylim(len(cases), 0)
    axes.set_xticks([x + 0.48 for x in range(len(models))], [m.replace(" ", "\n") for m in models], fontsize=7)
    axes.set_yticks([y + 0.46 for y in range(len(cases))], cases, fontsize=7)
    axes.legend([plt.Rectangle((0, 0), 1, 1, color=c) for c in colours.values()],
                ["passes", "fails", "fails by its nature", "documented"], loc="upper left", bbox_to_anchor=(1, 1), fontsize=7)
    save(figure, folder, "verdicts")


def main():
    if len(sys.argv) != 3 or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    with open(sys.argv[1]) as file:
        rows = json.load(file)
    os.makedirs(sys.argv[2], exist_ok=True)
    for draw in (bottleneck, fundamental_diagram, counterflow, exit_of_room, verdicts):
        draw(rows, sys.argv[2])


if __name__ == "__main__":
    main()
