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

from accuracy_plot import draw
from accuracy_rows import by_engine, comparison, least_error, played, verdict


def cell(text):
    return f"<td>{html.escape(text)}</td>"


def overview(cases):
    """A row a scene: what the same error costs, and the smallest error of each engine."""
    engines = list(dict.fromkeys(engine for rows in cases.values() for engine in by_engine(rows)))
    lines = ["<tr><th>scene</th><th>native, times as fast as the best peer at its errors</th>" +
             "".join(f"<th>{html.escape(engine)}: least error</th>" for engine in engines) + "</tr>"]
    for name, rows in cases.items():
        lines.append(f'<tr><td><a href="#{slug(name)}">{html.escape(name)}</a></td>' + cell(comparison(rows)) +
                     "".join(cell(least_error(rows, engine)) for engine in engines) + "</tr>")
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
            fitted = "too few errors" if order is None else f"{order:.2f}"
            text.setdefault(row["engine"], "exact" if row["error"].get("exact") else fitted)
        lines.append("<tr>" + cell(name) + "".join(cell(text.get(engine, "didn't play")) for engine in engines) + "</tr>")
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
joins the settings of an engine that none of its others beats, the others are faint; the lower left wins. Errors at the left
edge are below 1e-9, double precision's rounding; those at the right edge, hollow, are above 1: a run that went astray or fell.</p>
{overview}
<h2>Order of convergence</h2>
<p>error = c dt<sup>order</sup>, fitted to each engine's first line of settings. An engine is called exact where no dt makes
its error more than rounding. Too few errors: less than three between single precision's rounding and 10.</p>
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
