"""A bifurcation diagram as text, in 80 columns."""

from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.flags.range import SYMBOLS, Range
from rocksteady.cli.present.shared import plural

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

MOST_RUNS = 8
"""Runs of a sweep that are listed."""
SHORT = {"restitution": "delta"}
"""Headings shorter than the texts' words."""
ENDS = {
    "symmetry-breaking": "breaking",
    "period-doubling": "doubling",
    "grazing": "graze",
    "end-of-range": "range end",
}
"""The ends of branches, shorter."""
UNITS = {"amplitude": ("accel_g", "g"), "frequency_ratio": ("freq_hz", "Hz")}
"""What stands beside a parameter for a block with a size."""


def print_diagram(values: dict[str, Any], span: Range) -> None:
    """Print the bifurcations, the branches, what the sweeps met, and the cascade."""
    console = terminal.console()
    points, branches = values["points"], values["branches"]
    longest, most = values["max_period"], values["max_impacts"]
    console.print(
        f"{span.text}\n{len(branches)} {'branch' if len(branches) == 1 else 'branches'} "
        f"up to {plural(longest, 'period')} and {plural(most, 'impact')}, "
        f"{plural(len(points), 'bifurcation')}"
    )
    if points:
        console.print(_bifurcations(points, span))
    if branches:
        console.print(_branches(branches, span))
    for each in values["sweeps"]:
        _print_sweep(console, each, span)
    if "cascade" in values:
        _print_cascade(console, values["cascade"], span)
    console.print(
        "Angles are in units of alpha. Of mirror images one is followed. Branches that\n"
        "hang together with none of the starts are missed: --search starts from more.",
        style="dim",
    )


def _table(*headings: str, left: tuple[str, ...]) -> "Table":
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0))
    for heading in headings:
        justify = "left" if heading.strip() in left else "right"
        table.add_column(heading, justify=justify, no_wrap=True)  # type: ignore[arg-type]
    return table


def _symbol(span: Range) -> str:
    return SHORT.get(span.parameter, SYMBOLS[span.parameter])


def _bifurcations(points: list[dict[str, Any]], span: Range) -> "Table":
    key, unit = UNITS.get(span.parameter, ("", ""))
    has_size = bool(key) and key in points[0]
    # The unit takes the place of the kind, which the branches' table tells too.
    fourth = unit if has_size else "kind"
    headings = ("branch", "bifurcation", _symbol(span), fourth, "period", "impacts")
    table = _table(*headings, "highest", "lowest", left=("bifurcation", "kind"))
    for point in points:
        kind = "symmetric" if point["symmetric"] else "unsymmetric"
        table.add_row(
            str(point["branch"]),
            point["type"].replace("-", " "),
            f"{point[span.parameter]:.8f}",
            f"{point[key]:.6g}" if has_size else kind,
            str(point["period"]),
            str(point["impacts"]),
            *(f"{peak:.4f}" for peak in point["peaks"]),
        )
    return table


def _branches(branches: list[dict[str, Any]], span: Range) -> "Table":
    headings = ("branch", "period", "impacts", "kind", "from", "to", f"stable in {_symbol(span)}")
    table = _table(*headings, left=("kind", "from", "to", headings[-1]))
    for branch in branches:
        kinds = [branch[end]["type"] for end in ("begin", "end")]
        ranges = [_range(low, high) for low, high in branch["stable_ranges"]]
        more = f" +{len(ranges) - 1}" if len(ranges) > 1 else ""
        table.add_row(
            str(branch["branch"]),
            str(branch["period"]),
            str(branch["impacts"]),
            "symmetric" if branch["symmetric"] else "unsymmetric",
            *(ENDS.get(kind, kind) for kind in kinds),
            ranges[0] + more if ranges else "—",
        )
    return table


def _range(low: float, high: float) -> str:
    """Return a range; of one too narrow for five digits its lower end and its width."""
    first, last = f"{low:.5g}", f"{high:.5g}"
    return f"{low:.7g} + {high - low:.0e}" if first == last else f"{first} to {last}"


def _print_sweep(console: "Console", each: dict[str, Any], span: Range) -> None:
    start = "from rest" if each["start"] == "rest" else f"from {each['start']}"
    console.print(f"{'upward' if each['direction'] == 'up' else 'downward'} sweep {start}")
    table = _table(_symbol(span), "to", "values", "settles to", left=("settles to",))
    runs = sorted(each["runs"], key=lambda run: -run["values"])[:MOST_RUNS]
    for run in each["runs"]:
        if run not in runs:
            continue
        period = run["period"]
        table.add_row(
            f"{run['from']:.6g}",
            f"{run['to']:.6g}",
            str(run["values"]),
            run["kind"] + (f", period {period}" if period and period > 1 else ""),
        )
    console.print(table)
    hidden = len(each["runs"]) - len(runs)
    if hidden > 0:
        console.print(f"and {plural(hidden, 'shorter run')}; --json has them", style="dim")


def _print_cascade(console: "Console", cascade: dict[str, Any] | None, span: Range) -> None:
    if cascade is None:
        console.print("no cascade: no branch comes to a period doubling in this range")
        return
    count = len(cascade["values"])
    console.print(f"cascade of {plural(count, 'period doubling')}")
    table = _table("period", _symbol(span), "distance", "ratio", left=())
    distances = [*cascade["distances"], None]
    ratios = [None, *cascade["ratios"], None][:count]
    for period, value, distance, ratio in zip(
        cascade["periods"], cascade["values"], distances, ratios, strict=True
    ):
        table.add_row(
            f"{period} -> {2 * period}",
            f"{value:.12f}",
            "" if distance is None else f"{abs(distance):.3e}",
            "" if ratio is None else f"{ratio:.4f}",
        )
    console.print(table)
    if cascade["ratios"]:
        console.print(
            f"limit {cascade['limit']:.12f}, if the distances go on shrinking by the last ratio;\n"
            "the ratios tend to Feigenbaum's 4.6692"
        )
    else:
        console.print("fewer than three doublings have no ratio")
