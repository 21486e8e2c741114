"""`rocksteady steady`: symmetric steady states in closed form, at a point or along axes."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import announce_compilation, print_json, write_csv, write_figure
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.present.shared import block_values, multipliers_text, worth
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.sweep.cases.spacing import in_equal_ratios

if TYPE_CHECKING:
    from rocksteady.dynamics.steady.states import SteadyStates
    from rocksteady.show.style.page import Page

HELP = (
    "Symmetric steady states under harmonic shaking, both branches, in closed form.\n\n"
    "At a point: the region, its boundaries, and for each solution phase, velocity, peak, "
    "admissibility, multipliers of the half cycle and stability (Tso and Wong 1989, eqs 12 to 25). "
    "-A and -W may also be axes start:stop:count, both ends included (log: before it for "
    "logarithmic spacing); --plot then draws response curves."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady steady -A 2 -W 4 -r 0.8\n\n"
    "rocksteady steady -A 1:6:6 -W 0.5:16:400 -r 0.8 --plot response.png\n\n"
    "rocksteady steady --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 2 --json"
)

CSV_HEADER = (
    "amplitude",
    "frequency_ratio",
    "restitution",
    "order",
    "region",
    "branch",
    "kind",
    "phase_rad",
    "velocity",
    "velocity_tau",
    "peak",
    "extrema",
    "admissible",
    "stable",
    "half_cycle_trace",
)


@grouped
def steady(
    shaking: ShakingFlags, block: BlockFlags, output: OutputFlags, order: options.Order = 1
) -> None:
    """Run `rocksteady steady`; `HELP` is what its users read."""
    output.check()
    body = block.described()
    if not body.symmetric:  # told before the kernels are loaded
        raise block.refuse_sides(
            valid="the closed forms are those of symmetric motions, and it has none",
            hint="ask for its periodic motions with `rocksteady orbits`",
        )
    amplitudes, ratios = shaking.of(body)
    if output.plot is not None and len(amplitudes) > 1 and len(ratios) == 1:
        raise FlagError(
            "--plot",
            output.plot,
            "response curves are drawn over frequency ratios, and there is one",
            "give -W as an axis start:stop:count, or take --csv",
        )
    announce_compilation("closed_form.fill_steady")
    import numpy as np

    from rocksteady.dynamics.steady.states import find_steady_states

    states = find_steady_states(
        np.array(amplitudes)[:, np.newaxis], np.array(ratios), body.restitution, order=order
    )
    at_point = states.region.size == 1
    points = [point_values(states, index, body) for index in np.ndindex(states.region.shape)]
    if output.csv is not None:
        write_csv(output.csv, CSV_HEADER, csv_rows(states))
    if output.plot is not None:
        if at_point:
            write_figure(output.plot, point_figure(points[0], output.page))
        else:
            write_figure(output.plot, curves_figure(body, amplitudes, ratios, order, output.page))
    if output.as_json:
        print_json("steady", points[0] if at_point else {"points": points})
    elif at_point:
        print_point(points[0])
    else:
        print_curves(states)


def point_values(
    states: "SteadyStates", index: tuple[int, ...], body: Block | DimensionlessBlock
) -> dict[str, Any]:
    """Return what the contract promises for one point, in plain values."""
    from rocksteady.dynamics.steady.regions import REGIONS

    assert states.peak is not None
    assert states.extrema is not None
    assert states.admissible is not None
    region = int(states.region[index])
    values: dict[str, Any] = {
        "amplitude": float(states.amplitude[index]),
        "frequency_ratio": float(states.frequency_ratio[index]),
        "restitution": float(states.restitution[index]),
        "order": int(states.order[index]),
        "region": region,
        "region_meaning": REGIONS[region],
        "boundaries": {
            "existence": float(states.existence[index]),
            "kind": float(states.kind[index]),
            "sign": float(states.sign[index]),
        },
        "solutions": [],
    }
    if isinstance(body, Block):
        ratio = values["frequency_ratio"]
        values["block"] = block_values(body)
        values["accel_g"] = values["amplitude"] * body.uplift_acceleration / body.gravity
        values["freq_hz"] = ratio * body.p / (2.0 * math.pi)
    if region == 4:
        return values
    for which, branch in enumerate((1, 2)):
        at = (which, *index)
        admissible = bool(states.admissible[at])
        solution: dict[str, Any] = {
            "branch": branch,
            "kind": "in-phase" if states.in_phase[at] else "out-of-phase",
            "phase": float(states.phase[at]),
            "velocity": float(states.velocity[at]),
            "velocity_tau": float(states.velocity_tau[at]),
            "peak": float(states.peak[at]),
            "extrema": int(states.extrema[at]),
            "admissible": admissible,
            "half_cycle_trace": float(states.trace[at]),
            "half_cycle_multipliers": [complex(m) for m in states.multipliers[at]],
            "stable": bool(states.stable[at]) if admissible else None,
            "neutral": bool(states.neutral[at]) if admissible else None,
        }
        if isinstance(body, Block):
            solution["peak_rad"] = solution["peak"] * body.alpha
        values["solutions"].append(solution)
    return values


def csv_rows(states: "SteadyStates") -> list[list[object]]:
    """Return one row for each solution, in the order of the points."""
    import numpy as np

    assert states.peak is not None
    assert states.extrema is not None
    assert states.admissible is not None
    rows: list[list[object]] = []
    for index in np.ndindex(states.region.shape):
        shared = [
            float(states.amplitude[index]),
            float(states.frequency_ratio[index]),
            float(states.restitution[index]),
            int(states.order[index]),
            int(states.region[index]),
        ]
        if states.region[index] == 4:
            continue
        for which in (0, 1):
            at = (which, *index)
            rows.append(
                [
                    *shared,
                    which + 1,
                    "in-phase" if states.in_phase[at] else "out-of-phase",
                    float(states.phase[at]),
                    float(states.velocity[at]),
                    float(states.velocity_tau[at]),
                    float(states.peak[at]),
                    int(states.extrema[at]),
                    bool(states.admissible[at]),
                    bool(states.stable[at]) if states.admissible[at] else "",
                    float(states.trace[at]),
                ]
            )
    return rows


def verdict(solution: dict[str, Any]) -> str:
    """Return the verdict on a solution in a word."""
    return worth(**{name: bool(solution[name]) for name in ("admissible", "neutral", "stable")})


def print_point(point: dict[str, Any]) -> None:
    """Print the solutions at a point, one column each, in 80 characters."""
    from rich.table import Table

    console = terminal.console()
    console.print(
        f"A = {point['amplitude']:.8g}, Omega = {point['frequency_ratio']:.8g}, "
        f"restitution {point['restitution']:.8g}, n = {point['order']}"
    )
    if "block" in point:
        block = point["block"]
        console.print(
            f"block: alpha = {block['alpha_rad']:.6g} rad, R = {block['radius_m']:.6g} m, "
            f"p = {block['p_rad_s']:.6g} rad/s\n"
            f"shaking: {point['accel_g']:.6g} g at {point['freq_hz']:.6g} Hz"
        )
    limits = point["boundaries"]
    console.print(
        f"region {point['region']}: {point['region_meaning']}\n"
        f"boundaries in A: existence {limits['existence']:.6f} (eq 23), "
        f"kind {limits['kind']:.6f} (eq 25),\n"
        f"                 sign {limits['sign']:.6f} (eq 24)"
    )
    if not point["solutions"]:
        return
    table = Table(box=None, pad_edge=False, padding=(0, 3, 0, 0))
    table.add_column("", no_wrap=True)
    for solution in point["solutions"]:
        table.add_column(f"branch {solution['branch']}", no_wrap=True)
    rows: list[tuple[str, Callable[[dict[str, Any]], str]]] = [
        ("verdict", verdict),
        ("kind", lambda s: str(s["kind"])),
        ("phase (rad)", lambda s: f"{s['phase']:.12f}"),
        ("velocity du/d(pt)", lambda s: f"{s['velocity']:.12f}"),
        ("velocity du/d(omega t)", lambda s: f"{s['velocity_tau']:.12f}"),
        ("peak u", lambda s: f"{s['peak']:.12f}"),
        ("extrema in the half cycle", lambda s: str(s["extrema"])),
        ("half-cycle multipliers", lambda s: multipliers_text(s["half_cycle_multipliers"])),
    ]
    for label, text in rows:
        table.add_row(label, *(text(solution) for solution in point["solutions"]))
    console.print(table)


def print_curves(states: "SteadyStates") -> None:
    """Print a summary of what was found along the axes."""
    assert states.admissible is not None
    console = terminal.console()
    console.print(
        f"{states.region.size} points, of which {int((states.region != 4).sum())} have solutions"
    )
    for which, branch in enumerate((1, 2)):
        console.print(
            f"branch {branch}: {int(states.admissible[which].sum())} admissible, "
            f"{int(states.stable[which].sum())} stable"
        )
    console.print("add --csv FILE for the numbers, --plot FILE for response curves, or --json")


def point_figure(point: dict[str, Any], page: "Page") -> Any:
    """Return the figure of the solutions at a point and of the map around it."""
    import numpy as np

    from rocksteady.dynamics.steady.regions import compute_region_map
    from rocksteady.dynamics.steady.states import compute_steady_orbit
    from rocksteady.show.figures.single import steady_figure

    a, w = point["amplitude"], point["frequency_ratio"]
    r, n = point["restitution"], point["order"]
    orbits = [
        (
            f"branch {s['branch']}: {s['kind']}, {verdict(s)}",
            compute_steady_orbit(a, w, r, order=n, branch=s["branch"]),
        )
        for s in point["solutions"]
    ]
    ratios = np.linspace(0.1, 14.0, 700)
    if not 0.3 <= w <= 10.0:  # a logarithmic axis, wide enough for the point
        low, high = max(0.01, min(0.1, w / 10.0)), min(1e4, max(14.0, 3.0 * w))
        ratios = np.array(in_equal_ratios(low, high, 700))
    curves = compute_region_map(ratios, r, order=n)
    title = f"Symmetric steady states: A = {a:g}, Ω = {w:g}, restitution {r:g}, n = {n}"
    return steady_figure(orbits, curves, point=(w, a), title=title, page=page)


def curves_figure(
    body: Block | DimensionlessBlock,
    amplitudes: list[float],
    ratios: list[float],
    order: int,
    page: "Page",
) -> Any:
    """Return the figure of response curves, one for each amplitude."""
    from rocksteady.dynamics.steady.response import compute_response_curve
    from rocksteady.show.figures.single import response_figure

    curves = [
        compute_response_curve(body, a, frequency_ratio=ratios, order=order) for a in amplitudes
    ]
    title = f"Symmetric steady states: restitution {body.restitution:g}, n = {order}, branch 1"
    return response_figure(curves, hertz=isinstance(body, Block), title=title, page=page)
