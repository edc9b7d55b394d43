"""Draws one scene of `throng bench accuracy`: run time against error, a point a setting."""
import math

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "throng"
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from accuracy_rows import USELESS, by_engine, front, played, rounded, setting, useless

LOOKS = {"native": ("#1f5fa8", "o"), "native auto": ("#7fb2e5", "*"), "event_driven": ("#2a9d6f", "D"), "spring": ("#8e5bb5", "P"),
         "box2d": ("#d1603d", "s"), "chipmunk": ("#c99a1e", "^")}
BAND = 0.15  # width of a band beyond a break, of the axis between the breaks


def room(values, margin=0.08):
    """Ends of a logarithmic axis with room around the values, five-fold at least."""
    least, most = min(values), max(values)
    widen = max(most / least, 5) ** margin * max(1, math.sqrt(5 * least / most))
    return least / widen, most * widen


def ticks(least, most):
    """Round numbers on a logarithmic axis and how they are written: in full where all of them are short."""
    steps = (1,) if most / least > 300 else (1, 2, 5)
    powers = range(math.floor(math.log10(least)), math.ceil(math.log10(most)) + 1)
    found = [(step, power) for power in powers for step in steps if least <= step * 10.0 ** power <= most * (1 + 1e-9)]
    short = all(-4 <= power < 5 for _, power in found)
    factor = {1: "", 2: r"2\cdot", 5: r"5\cdot"}
    return {step * 10.0 ** power: f"{step * 10.0 ** power:g}" if short or power == 0 else f"${factor[step]}10^{{{power}}}$"
            for step, power in found}


class Errors:
    """Where errors stand: on a logarithmic axis, or beyond a break in it where they are rounding or useless."""

    def __init__(self, rows):
        told = [row["error"]["error"] for row in rows if not rounded(row) and not useless(row)]
        self.least, self.most = room(told or [0.1 * USELESS, USELESS])
        if any(map(useless, rows)):
            self.least, self.most = min(self.least, USELESS / 5), USELESS
        self.band = (self.most / self.least) ** BAND
        self.bands = [(self.least / self.band, self.least, "rounding")] if any(map(rounded, rows)) else []
        self.bands += [(self.most, self.most * self.band, f"above {USELESS:g}")] if any(map(useless, rows)) else []

    def place(self, row):
        middle = math.sqrt(self.band)
        return self.least / middle if rounded(row) else self.most * middle if useless(row) else row["error"]["error"]

    def draw(self, axes):
        left, right = zip((self.least, self.most), *[band[:2] for band in self.bands])
        axes.set_xlim(min(left), max(right))
        marks = ticks(self.least, self.most)
        axes.set_xticks(list(marks), list(marks.values()))
        for low, high, name in self.bands:
            axes.axvspan(low, high, color="#777777", alpha=0.1, linewidth=0)
            at = axes.get_xaxis_transform()
            axes.annotate(name, (math.sqrt(low * high), 1), xycoords=at, textcoords="offset points", xytext=(0, 4),
                          ha="center", fontsize=8, style="italic")
            for edge in (0, 1):
                axes.text(self.least if name == "rounding" else self.most, edge, "//", transform=at, ha="center", va="center",
                          fontsize=8, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3})


def looks(engine, **more):
    colour, marker = LOOKS.get(engine, ("#555555", "v"))
    own = engine in ("native", "event_driven", "spring")
    return {"color": colour, "marker": marker, "linewidth": 2.2 if own else 1.2, "markersize": 5, **more}


def draw_engine(axes, errors, engine, points):
    """Full where none of the engine's settings is better, faint elsewhere; hollow where the error is useless."""
    best = front(points)
    for row in points:
        full = row in best
        axes.plot(errors.place(row), row["ms_min"], **looks(engine, markersize=5 if full else 4, alpha=1 if full else 0.25,
                                                            markerfacecolor="none" if useless(row) else None))
    line = [row for row in best if not rounded(row) and not useless(row)]
    axes.plot([errors.place(row) for row in line], [row["ms_min"] for row in line], **looks(engine, marker=""))
    if engine == "native" and len(line) > 1:
        for row, side, offset in ((line[0], "right", (-6, -10)), (line[-1], "left", (7, 2))):
            axes.annotate(setting(row), (errors.place(row), row["ms_min"]), textcoords="offset points", xytext=offset, ha=side,
                          fontsize=6.5, color=looks(engine)["color"])


def legend(axes, engines):
    """Below the axes, where it covers nothing."""
    handles = []
    for engine, points in engines.items():
        lost = all(map(useless, points))
        handles.append(Line2D([], [], label=engine + (f": all errors above {USELESS:g}" if lost else ""),
                              **looks(engine, markerfacecolor="none" if lost else None, linestyle="" if lost else "-")))
    axes.legend(handles=handles, ncol=len(handles), loc="upper center", bbox_to_anchor=(0.5, -0.14), frameon=False, fontsize=8,
                columnspacing=1.5)
    if any(len(front(points)) < len(points) for points in engines.values()):
        axes.annotate("faint: another setting of the engine is no slower and no less exact", (0.5, -0.23), ha="center",
                      xycoords="axes fraction", va="top", fontsize=8, color="#777777")


def draw(name, rows, file):
    """Writes file.svg and file.png."""
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    axes.set_xscale("log")
    axes.set_yscale("log")
    errors, engines = Errors(played(rows)), by_engine(rows)
    for engine, points in engines.items():
        draw_engine(axes, errors, engine, points)
    errors.draw(axes)
    low, high = room([row["ms_min"] for row in played(rows)] or [1])
    axes.set_ylim(low, high)
    marks = ticks(low, high)
    axes.set_yticks(list(marks), list(marks.values()))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())
    axes.set_title(name, loc="left", fontsize=11, pad=18)
    axes.set_title("lower left wins", loc="right", fontsize=8, color="#777777", pad=18)
    axes.set_xlabel(rows[0]["error"]["what"])
    asked = all(row["error"]["dt"] is None for row in rows)
    axes.set_ylabel("ms per thousand questions" if asked else "ms per simulated second, one thread")
    axes.grid(which="major", alpha=0.3)
    legend(axes, engines)
    for kind, extra in (("svg", {"metadata": {"Date": None}}), ("png", {})):
        figure.savefig(f"{file}.{kind}", dpi=120, bbox_inches="tight", **extra)
    plt.close(figure)
    print(file + ".svg")
