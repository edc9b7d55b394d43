#!/usr/bin/python3
"""Draws what `throng bench accuracy --json ROWS` found: plot/accuracy.py ROWS FOLDER

Writes to FOLDER a plot per scene, run time against error, as .svg and .png, and index.html, which puts them together.
Needs matplotlib (Debian: python3-matplotlib).
"""
import base64
import html
import json
import os
import re
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "throng"
import matplotlib.pyplot as plt

LOOKS = {"native": ("#1f5fa8", "o"), "event_driven": ("#2a9d6f", "D"), "spring": ("#8e5bb5", "P"),
         "box2d": ("#d1603d", "s"), "chipmunk": ("#c99a1e", "^")}
USELESS = 1.0  # of a body's size, or all there is: larger errors are neither drawn nor compared
ROUNDING = 1e-9  # errors below are drawn at the left edge: what is left is double precision's rounding


def played(rows):
    return [row for row in rows if row["error"]["error"] is not None]


def by_engine(rows):
    engines = {}
    for row in played(rows):
        engines.setdefault(row["engine"], []).append(row)
    return engines


def off(row):
    """The error, no better than rounding."""
    return max(row["error"]["error"], ROUNDING)


def front(rows):
    """Those that no other is both faster and more exact than, the fastest first."""
    best = []
    for row in sorted(rows, key=lambda row: (row["ms_min"], off(row))):
        if not best or off(row) < off(best[-1]):
            best.append(row)
    return best


def number(value):
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


def advantage(rows):
    """How many times as fast native is at the errors on the peers' front; None where it doesn't get to one."""
    peers = front([row for row in played(rows) if row["error"].get("peer") and row["error"]["error"] < USELESS])
    return [row["ms_min"] / row["error"]["native_ms"] if row["error"].get("native_ms") else None for row in peers]


def setting(row):
    dt = f"dt {1000 * row['error']['dt']:.3g} ms"
    return dt + (", " + row["error"]["setting"] if row["error"]["setting"] else "")


def verdict(rows):
    """What the plot says, in a sentence or two."""
    said = []
    factors = advantage(rows)
    reached = [factor for factor in factors if factor]
    if reached:
        least, most = number(min(reached)), number(max(reached))
        span = f"{least} times" if least == most else f"{least} to {most} times"
        said.append(f"At the errors that the best peers reach, native is {span} as fast.")
        if min(reached) < 1:
            said.append("Below 1 a peer is ahead.")
    if len(reached) < len(factors):
        said.append("The best peer's smallest errors are beyond native's settings here.")
    exact = [name for name, points in by_engine(rows).items()
             if max(row["error"]["error"] for row in points) < ROUNDING]
    if exact:
        said.append(f"{' and '.join(exact)}: no error but rounding, at any dt.")
    lost = [name for name, points in by_engine(rows).items()
            if min(row["error"]["error"] for row in points) > USELESS]
    if lost:
        said.append(f"{' and '.join(lost)}: off by more than {number(USELESS)} at every setting, so not drawn.")
    notes = {row["engine"]: row["error"]["note"] for row in rows if row["error"].get("note")}
    said += [f"{name} can't play it{' at all settings' if name in by_engine(rows) else ''}: {note}."
             for name, note in notes.items()]
    return " ".join(said)


def draw(name, rows, file):
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    rows = [row for row in rows if row["error"]["error"] is None or row["error"]["error"] <= USELESS] or rows
    errors = [row["error"]["error"] for row in played(rows)]
    shown = [error for error in errors if error > ROUNDING]
    edge = (0.1 if len(shown) < len(errors) else 1.0) * min(shown, default=1e-8)
    for engine, points in by_engine(rows).items():
        colour, marker = LOOKS.get(engine, ("#555555", "v"))
        place = lambda row: max(row["error"]["error"], edge) if row["error"]["error"] > ROUNDING else edge
        axes.plot([place(row) for row in points], [row["ms_min"] for row in points], marker, color=colour, alpha=0.25,
                  markersize=4, markeredgewidth=0)
        best = front(points)
        own = engine in ("native", "event_driven", "spring")
        axes.plot([place(row) for row in best], [row["ms_min"] for row in best], marker + "-", color=colour, label=engine,
                  markersize=5, linewidth=2.2 if own else 1.2)
        if engine == "native" and len(best) > 1:
            for row, side, offset in ((best[0], "right", (-6, -10)), (best[-1], "left", (7, 2))):
                axes.annotate(setting(row), (place(row), row["ms_min"]), textcoords="offset points", xytext=offset, ha=side,
                              fontsize=6.5, color=colour)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(y=0.08)
    axes.set_xlim(0.6 * edge, 1.5 * min(max(errors + [2 * edge]), USELESS))
    if any(error <= ROUNDING for error in errors):
        axes.axvspan(0.6 * edge, 1.7 * edge, color="#2a9d6f", alpha=0.08, linewidth=0)
        axes.annotate("rounding", (edge, 0.95), xycoords=("data", "axes fraction"), ha="center", fontsize=7, color="#2a6d4f")
    axes.set_title(name, loc="left", fontsize=11)
    axes.set_title("lower left wins", loc="right", fontsize=8, color="#777777")
    axes.set_xlabel(rows[0]["error"]["what"])
    axes.set_ylabel("ms per simulated second, one thread")
    axes.grid(which="major", alpha=0.3)
    axes.legend(fontsize=8)
    for kind, extra in (("svg", {"metadata": {"Date": None}}), ("png", {})):
        figure.savefig(f"{file}.{kind}", dpi=120, bbox_inches="tight", **extra)
    plt.close(figure)
    print(file + ".svg")


def cell(text):
    return f"<td>{html.escape(text)}</td>"


def overview(cases):
    """A row a scene: what the same error costs, and the smallest error of each engine."""
    engines = list(dict.fromkeys(engine for rows in cases.values() for engine in by_engine(rows)))
    lines = ["<tr><th>scene</th><th>native, times as fast as the best peer at its errors</th>" +
             "".join(f"<th>{html.escape(engine)}: least error</th>" for engine in engines) + "</tr>"]
    for name, rows in cases.items():
        reached = [factor for factor in advantage(rows) if factor]
        text = f"{number(min(reached))} to {number(max(reached))}" if reached else "-"
        least = {engine: min(row["error"]["error"] for row in points) for engine, points in by_engine(rows).items()}
        lines.append(f'<tr><td><a href="#{slug(name)}">{html.escape(name)}</a></td>' + cell(text) +
                     "".join(cell(f"{least[engine]:.1e}" if engine in least else "-") for engine in engines) + "</tr>")
    return "<table>" + "".join(lines) + "</table>"


def orders(cases):
    """A row a smooth scene: how errors fall with dt."""
    smooth = {name: rows for name, rows in cases.items() if any("order" in row["error"] for row in rows)}
    engines = list(dict.fromkeys(row["engine"] for rows in smooth.values() for row in played(rows)))
    lines = ["<tr><th>scene</th>" + "".join(f"<th>{html.escape(engine)}</th>" for engine in engines) + "</tr>"]
    for name, rows in smooth.items():
        text = {}
        for row in played(rows):
            order = row["error"]["order"]
            text.setdefault(row["engine"], "exact" if row["error"].get("exact") else f"{order:.2f}" if order else "-")
        lines.append("<tr>" + cell(name) + "".join(cell(text.get(engine, "-")) for engine in engines) + "</tr>")
    return "<table>" + "".join(lines) + "</table>" if smooth else ""


def slug(name):
    return re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")


PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>throng: run time against error</title>
<style>
body {{ font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #222 }}
img {{ max-width: 100%; height: auto }} section {{ margin: 2.5rem 0 }} h2 {{ margin-bottom: .2rem }}
table {{ border-collapse: collapse; font-size: .85rem }} th, td {{ border-bottom: 1px solid #ddd; padding: .25rem .6rem; text-align: left }}
th {{ vertical-align: bottom; font-weight: 600 }}
</style>
<h1>Run time against error</h1>
<p>Each scene is played by each engine that can, at several settings, on one thread; a point is one setting: how far it is
off what is exact, and what a simulated second of it takes (the least of several runs, all settings in turn). The line
joins the settings of an engine that none of its others beats; the lower left wins.</p>
{overview}
<h2>Order of convergence</h2>
<p>error = c dt<sup>order</sup>, fitted to each engine's first line of settings. An engine is called exact where no dt makes
its error more than rounding.</p>
{orders}
{scenes}
</html>
"""


def section(name, rows, folder):
    with open(os.path.join(folder, slug(name) + ".svg"), "rb") as file:
        picture = base64.b64encode(file.read()).decode()
    return (f'<section id="{slug(name)}"><h2>{html.escape(name)}</h2><p>{html.escape(rows[0]["check"])} '
            f'{html.escape(verdict(rows))}</p><img alt="{html.escape(name)}: run time against error" '
            f'src="data:image/svg+xml;base64,{picture}"></section>')


def main():
    if len(sys.argv) != 3 or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    with open(sys.argv[1]) as file:
        rows = json.load(file)
    folder = sys.argv[2]
    os.makedirs(folder, exist_ok=True)
    cases = {}
    for row in rows:
        cases.setdefault(row["case"], []).append(row)
    for name, of_case in cases.items():
        draw(name, of_case, os.path.join(folder, slug(name)))
    page = os.path.join(folder, "index.html")
    with open(page, "w") as file:
        file.write(PAGE.format(overview=overview(cases), orders=orders(cases),
                               scenes="".join(section(name, of_case, folder) for name, of_case in cases.items())))
    print(page)


if __name__ == "__main__":
    main()
