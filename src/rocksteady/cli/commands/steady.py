"""`rocksteady steady`: symmetric steady states, at a point or along axes."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rocksteady.cli.console.progress import progress
from rocksteady.cli.console.refusals import refuse, require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import (
    HARMONIC,
    BlockFlags,
    ShakingFlags,
    equations_for,
)
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.record_files import FloorFlags
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.equations import Model
from rocksteady.model.facts import amplitude_text, frequency_text
from rocksteady.sweep.cases.spacing import in_equal_ratios

if TYPE_CHECKING:
    from rocksteady.dynamics.steady.states import SteadyStates
    from rocksteady.show.style.page import Page

HELP = (
    "Find the symmetric steady motions.\n\n"
    "Symmetric steady states under harmonic shaking, both branches: in closed form for slender "
    "blocks (Tso and Wong 1989, eqs 12 to 25); for a block of known slenderness those of the full "
    "equations to which the closed form leads, with the closed form beside.\n\n"
    "At a point: for each solution phase, velocity, peak, admissibility, multipliers of a period "
    "and stability, and of the closed form the region and its boundaries. -n may be repeated. -A "
    "and -W may also be axes start:stop:count, both ends included (log: before it for logarithmic "
    "spacing); --plot then draws response curves."
)
MAIN = "amplitude frequency_ratio restitution width_m height_m accel_g freq_hz order plot csv"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady steady -A 2 -W 4 -r 0.8\n\n"
    "rocksteady steady -A 1:6:6 -W 0.5:16:400 -r 0.8 --plot response.png\n\n"
    "rocksteady steady --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 2 --json"
)


A_MINUTE = 30_000
"""Points whose full equations take about a minute."""


@grouped
def steady(
    shaking: ShakingFlags,
    floor: FloorFlags,
    block: BlockFlags,
    output: OutputFlags,
    order: list[int] | None = options.orders(),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady steady`; `HELP` is what its users read."""
    output.check()
    require("steady", {"block": block.given, "motion": shaking.given}, *HARMONIC)
    body = block.described()
    if not body.symmetric:  # refused before the kernels are loaded
        raise block.refuse_sides(
            valid="the steady states are symmetric motions, and it has none",
            hint="ask for its periodic motions with `rocksteady orbits`",
        )
    named = model or ("nonlinear" if isinstance(body, Block) else "linear")
    equations = equations_for(named, body)
    amplitudes, ratios = shaking.of(body)
    for parameter, values in (("amplitude", amplitudes), ("frequency_ratio", ratios)):
        if len(values) > 1:
            refuse(
                {"--floor-hz": floor.floor_hz},
                f"{options.FLAG_OF_ARGUMENT[parameter]} is an axis, and axes of steady states "
                "are those of the shaking at the block",
                "draw what it settles to with rocksteady map, or give one amplitude and frequency",
            )
    if len(amplitudes) == len(ratios) == 1:
        amplitudes = [floor.on_floor(shaking.at(body), body).amplitude]
    if len(set(order or (1,))) > 1 and len(ratios) == 1:
        refuse(
            {"--plot": output.plot},
            "a point is drawn for one order, and there are several",
            "give -n once, or -W as an axis start:stop:count",
        )
    if len(amplitudes) > 1 and len(ratios) == 1:
        refuse(
            {"--plot": output.plot},
            "response curves are drawn over frequency ratios, and there is one",
            "give -W as an axis start:stop:count, or take --csv",
        )
    import numpy as np

    from rocksteady.dynamics.steady.states import states_of

    orders = tuple(dict.fromkeys(order or (1,)))
    plane = np.array(amplitudes)[:, np.newaxis], np.array(ratios)
    each = orders[0] if len(orders) == 1 else np.array(orders)[:, np.newaxis, np.newaxis]
    points = len(amplitudes) * len(ratios) * len(orders)
    if points > A_MINUTE and equations.name == "nonlinear":
        with progress(f"solving {points:,} points (--model linear: at once)", 1) as done:
            states = states_of(body, *plane, each, equations)
            done("points")
    else:
        states = states_of(body, *plane, each, equations)
    same = f"--model {model}" if model else ""
    output.write_csv(states.to_dataframe)
    description = states.describe()
    if states.region.size == 1:
        output.write_plot(lambda page: point_figure(states, page))
        further = options.follow_up("attractor", shaking, floor, block, *_start_of(states), same)
    else:
        output.write_plot(
            lambda page: curves_figure(body, amplitudes, ratios, orders, equations, page)
        )
        moving = len(ratios) + len(amplitudes) > 2
        further = options.follow_up("map" if moving else "attractor", shaking, block, same)
        if len(ratios) > 1 and output.plot is None:
            repeated = [f"-n {each}" for each in orders if order]
            further = options.follow_up(
                "steady", shaking, block, *repeated, same, "--plot steady.png"
            )
    output.leave("steady", description, follow_up=further)


def _start_of(states: "SteadyStates") -> list[str]:
    """Return the flags that start on a motion of an order above 1, if there is one."""
    point = states.to_dict()
    branches = [each["branch"] for each in point["solutions"] if each["admissible"]]
    if point["order"] == 1 or not branches:
        return []
    return ["--start steady" + (":2" if branches[0] == 2 else ""), f"-n {point['order']}"]


def point_figure(states: "SteadyStates", page: "Page") -> Any:
    """Return the figure of the solutions at a point and of the map around it."""
    import numpy as np

    from rocksteady.dynamics.steady.regions import compute_region_map
    from rocksteady.dynamics.steady.states import orbit_of
    from rocksteady.show.figures.single import steady_figure
    from rocksteady.words.steady import worth

    point = states.to_dict()
    a, w = point["amplitude"], point["frequency_ratio"]
    r, n = point["restitution"], point["order"]
    orbits = [
        (f"branch {s['branch']}: {s['kind']}, {worth(s)}", orbit_of(states, s["branch"]))
        for s in point["solutions"]
    ]
    ratios = np.linspace(0.1, 14.0, 700)
    if not 0.3 <= w <= 10.0:  # a logarithmic axis, wide enough for the point
        low, high = max(0.01, min(0.1, w / 10.0)), min(1e4, max(14.0, 3.0 * w))
        ratios = np.array(in_equal_ratios(low, high, 700))
    curves = compute_region_map(ratios, r, order=n)
    body = states.block or DimensionlessBlock(restitution=r)
    shaking = f"{amplitude_text(body, a)}, {frequency_text(body, w)}"
    title = f"Symmetric steady states: {shaking}, restitution {r:g}, n = {n}"
    full = states.closed_form is not None
    title += ", full equations; regions of the linear ones" if full else ""
    return steady_figure(orbits, curves, point=(w, a), block=states.block, title=title, page=page)


def curves_figure(
    body: Block | DimensionlessBlock,
    amplitudes: list[float],
    ratios: list[float],
    orders: Sequence[int],
    model: Model,
    page: "Page",
) -> Any:
    """Return the figure of response curves, one for each order and amplitude."""
    from rocksteady.dynamics.steady.response import compute_response_curve
    from rocksteady.show.figures.single import response_figure

    curves = [
        compute_response_curve(body, a, frequency_ratio=ratios, order=order, model=model)
        for order in orders
        for a in amplitudes
    ]
    listed = ", ".join(map(str, orders))
    title = f"Symmetric steady states: restitution {body.restitution:g}, n = {listed}, branch 1"
    if isinstance(body, Block):
        title += ", full equations" if model.name == "nonlinear" else ", linear model"
    return response_figure(curves, hertz=isinstance(body, Block), title=title, page=page)
