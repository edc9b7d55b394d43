"""What the rows of `throng bench accuracy --json` say: who is ahead, at which errors, and by how much."""

USELESS = 1.0  # of a body's size, or all there is: larger errors aren't told apart nor compared
ROUNDING = 1e-9  # nor are smaller errors: what is left is double precision's rounding


def played(rows):
    return [row for row in rows if row["error"]["error"] is not None]


def by_engine(rows):
    engines = {}
    for row in played(rows):
        engines.setdefault(row["engine"], []).append(row)
    return engines


def rounded(row):
    return row["error"]["error"] <= ROUNDING


def useless(row):
    return row["error"]["error"] > USELESS


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
    """To two digits."""
    return f"{float(f'{value:.2g}'):.0f}" if value >= 10 else f"{value:#.2g}"


def span(values):
    least, most = number(min(values)), number(max(values))
    return least if least == most else f"{least} to {most}"


def setting(row):
    if row["error"]["dt"] is None:
        return row["error"]["setting"] or row["engine"]
    dt = f"dt {1000 * row['error']['dt']:.3g} ms"
    return dt + (", " + row["error"]["setting"] if row["error"]["setting"] else "")


def native_ms(rows, error):
    """Of native's fastest setting with at most that error; None where it has none."""
    return min((row["ms_min"] for row in by_engine(rows).get("native", []) if off(row) <= error), default=None)


def advantage(rows):
    """How many times as fast native is at the errors on the peers' front; None where it doesn't get to one."""
    peers = front([row for row in played(rows) if row["error"].get("peer") and not useless(row)])
    native = [native_ms(rows, off(row)) for row in peers]
    return [row["ms_min"] / ms if ms else None for row, ms in zip(peers, native)]


def comparison(rows):
    """How many times as fast native is at the best peers' errors, or why there is no such number."""
    factors = advantage(rows)
    reached = [factor for factor in factors if factor]
    if reached:
        return span(reached)
    if factors:
        return "native is never as exact"
    peers = any(row["error"].get("peer") for row in played(rows))
    return f"no peer is off by less than {USELESS:g}" if peers else "no peer can play it"


def least_error(rows, engine):
    errors = [row["error"]["error"] for row in by_engine(rows).get(engine, [])]
    if errors:
        return number(min(errors))
    return "can't play it" if any(row["engine"] == engine for row in rows) else "not run"


def verdict(rows):
    """What the plot says, in a sentence or two."""
    said = []
    factors, engines = advantage(rows), by_engine(rows)
    reached = [factor for factor in factors if factor]
    if reached:
        said.append(f"At the errors that the best peers reach, native is {span(reached)} times as fast.")
        if min(reached) < 1:
            said.append("Below 1 a peer is ahead.")
    if len(reached) < len(factors):
        said.append("The best peer's smallest errors are beyond native's settings here.")
    exact = [name for name, points in engines.items() if all(map(rounded, points))]
    if exact:
        said.append(f"{' and '.join(exact)}: no error but rounding, at any dt.")
    lost = [name for name, points in engines.items() if all(map(useless, points))]
    if lost:
        said.append(f"{' and '.join(lost)}: off by more than {USELESS:g} at every setting.")
    notes = {row["engine"]: row["error"]["note"] for row in rows if row["error"].get("note")}
    said += [f"{name} can't play it{' at all settings' if name in engines else ''}: {note}."
             for name, note in notes.items()]
    return " ".join(said)
