"""`rocksteady attractor`: long-term motion of a block under harmonic shaking."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import (
    INCOMPLETE,
    announce_compilation,
    print_json,
    write_csv,
    write_figure,
)
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.start import StartFlags
from rocksteady.cli.present.shared import (
    angle_text,
    case_text,
    multipliers_text,
    orbit_values,
    periods_text,
    shaking_values,
)
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.segments import Harmonic

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from rocksteady.dynamics.history.start import Start
    from rocksteady.dynamics.history.trajectory import Trajectory
    from rocksteady.dynamics.orbits.attractor import Attractor
    from rocksteady.model.equations import Model
    from rocksteady.show.style.page import Page

HELP = (
    "What a motion under harmonic shaking settles to: rest, a fall, a periodic motion, or none.\n\n"
    "A periodic motion is recognised by its returns, polished by Newton's method and believed only "
    "if its exact multipliers say that it is stable. Exit code 3 where nothing could be decided."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady attractor -A 2 -W 1.9 -r 0.8 --start steady --side - --plot attractor.png\n\n"
    "rocksteady attractor --block tso-wong-1989 -A 2 -W 4.2 --start steady -n 3 --csv orbit.csv\n\n"
    "rocksteady attractor -A 6 -W 6 -r 0.25 --json"
)

ROUNDED = 1e12
"""Growth of small differences from which on a rounding may decide."""
LONGEST_CLOUD = 4000
"""Most forcing periods of a motion without an orbit that pictures and tables follow."""
SHOWN_PERIODS = 30
"""Of these, the last ones that a time history shows."""
MEANING = {
    "symmetric": "Half of the motion is the mirror image of the other half.",
    "unsymmetric": "The block leans to one side; the mirror image is an attractor too.",
    "asymmetric block": "The motion repeats; of a block whose sides differ none is symmetric.",
    "rest": "The block comes to rest, and the shaking does not lift it again.",
    "overturned": "The block falls: it is proved that it cannot come back to its base.",
    "aperiodic": "The motion does not repeat: motions beside it part at the rate of the exponent.",
}

CyclesFlag = Annotated[
    int,
    typer.Option(
        "--cycles",
        metavar="N",
        help="Periods of the shaking after which a motion counts as aperiodic or undecided.",
        rich_help_panel=options.START,
    ),
]


@grouped
def attractor(
    shaking: ShakingFlags,
    block: BlockFlags,
    output: OutputFlags,
    start: StartFlags,
    cycles: CyclesFlag = 2000,
    model: options.Model = "linear",
) -> None:
    """Run `rocksteady attractor`; `HELP` is what its users read."""
    output.check()
    body = block.described()
    equations = equations_for(model, body)
    motion = shaking.at(body, phase=start.first_phase)
    start.check(shaken=True)

    announce_compilation("settle.settle")
    from rocksteady.dynamics.orbits.attractor import find_attractor as settle
    from rocksteady.outcomes import AttractorKind

    begin = start.of(motion.frequency_ratio)
    with start.as_typed():
        found = settle(
            body,
            motion,
            start=begin,
            cycles=cycles,
            model=equations,
        )
    values = attractor_values(found, body, motion)
    values |= {**start.values(found.motion.phase), "cycles": cycles, "model": model}
    run = None
    if found.orbit is None and (output.csv is not None or output.plot is not None):
        run = followed(found, body, motion, begin, equations)
    if output.csv is not None:
        write_csv(output.csv, csv_header(body), csv_rows(found, run, body))
    if output.plot is not None:
        write_figure(output.plot, figure_of(found, run, values, body, output.page))
    if output.as_json:
        print_json("attractor", values)
    else:
        print_summary(values, body)
    if found.kind is AttractorKind.UNDECIDED:
        raise typer.Exit(INCOMPLETE)


def attractor_values(
    found: "Attractor", body: Block | DimensionlessBlock, shaking: Harmonic
) -> dict[str, Any]:
    """Return what the contract promises, in plain values; None for what an attractor has not."""
    values: dict[str, Any] = dict.fromkeys(
        (
            "kind",
            "reason",
            "period",
            "impacts_per_period",
            "rest_phases",
            "peaks",
            "multipliers",
            "lyapunov",
            "residual",
            "states",
        )
    )
    if isinstance(body, Block):
        values |= {"peaks_rad": None, "period_s": None}
    if found.orbit is not None:
        values |= orbit_values(found.orbit, body)
    elif found.peaks is not None:
        values["peaks"] = list(found.peaks)
        if isinstance(body, Block):
            values["peaks_rad"] = [peak * body.alpha for peak in found.peaks]
    values["kind"] = found.kind.value
    values["reason"] = found.reason or None
    values["lyapunov"] = found.lyapunov if math.isfinite(found.lyapunov) else None
    values["settled_after_periods"] = found.after
    values["growth"] = found.growth
    return values | shaking_values(body, shaking)


def followed(
    found: "Attractor",
    body: Block | DimensionlessBlock,
    shaking: Harmonic,
    start: "Start",
    model: "Model",
) -> "Trajectory":
    """Return the run that a motion without an orbit makes."""
    from rocksteady.dynamics.history.simulate import simulate

    cycles = min(found.after + 5, LONGEST_CLOUD)
    block = body.dimensionless() if model.name == "linear" else body
    return simulate(block, shaking, start=start, cycles=cycles, model=model)


def last_periods(run: "Trajectory", body: Block | DimensionlessBlock) -> "Trajectory":
    """Return the end of a run as a run of its own."""
    from rocksteady.dynamics.history.simulate import simulate
    from rocksteady.dynamics.history.start import State

    assert isinstance(run.motion, Harmonic)
    span = SHOWN_PERIODS * 2.0 * math.pi / run.frequency_ratio
    if run.end_time_pt <= span:
        return run
    since = run.end_time_pt - span
    here = run(since)
    turned = math.fmod(run.motion.phase + run.frequency_ratio * since, 2.0 * math.pi)
    return simulate(
        body if run.model.name == "nonlinear" else body.dimensionless(),
        replace(run.motion, phase=turned),
        start=State(angle=float(here.angle), velocity=float(here.velocity)),
        cycles=SHOWN_PERIODS,
        model=run.model,
    )


def figure_of(
    found: "Attractor",
    run: "Trajectory | None",
    values: dict[str, Any],
    body: Block | DimensionlessBlock,
    page: "Page",
) -> "Figure":
    """Return the figure of an attractor."""
    from rocksteady.show.figures.single import cloud_figure, orbit_figure, simulation_figure

    title = f"{found.kind.value.capitalize()}: {case_text(values)}"
    if found.orbit is not None:
        if found.orbit.period > 1:
            title = title.replace(":", f", period {found.orbit.period}:", 1)
        return orbit_figure(found.orbit, found.orbit.trajectory(), title, page)
    assert run is not None
    if found.peaks is not None or found.kind == "overturned":
        return simulation_figure(run, title, page)
    part = last_periods(run, body)
    return cloud_figure(run, part, since=0.5 * run.end_time_pt, title=title, page=page)


def csv_header(body: Block | DimensionlessBlock) -> list[str]:
    """Return the columns of the impacts."""
    header = ["side", "phase_rad", "speed_per_pivot_time"]
    return [*header, "speed_rad_s"] if isinstance(body, Block) else header


def csv_rows(
    found: "Attractor", run: "Trajectory | None", body: Block | DimensionlessBlock
) -> Iterator[list[object]]:
    """Yield the states after the impacts of an orbit, or of the second half of a long run."""
    states: list[tuple[int, float, float]] = []
    if found.orbit is not None:
        states = [(state.side, state.phase, state.speed) for state in found.orbit.states]
    elif run is not None and found.peaks is None and found.kind != "overturned":
        impacts = run.impacts
        late = impacts.pt >= 0.5 * run.end_time_pt
        phase = (impacts.half_cycles[late] % 2) * math.pi + impacts.phase[late]
        after = impacts.velocity_after[late]
        states = [
            (1 if velocity > 0.0 else -1, angle, abs(velocity))
            for angle, velocity in zip(phase.tolist(), after.tolist(), strict=True)
        ]
    for side, phase_rad, speed in states:
        row: list[object] = [side, phase_rad, speed]
        if isinstance(body, Block):
            row.append(speed * body.alpha * body.p)
        yield row


def print_summary(values: dict[str, Any], body: Block | DimensionlessBlock) -> None:
    """Print what it is, what that means, and the figures that people ask for first."""
    from rich.table import Table
    from rich.text import Text

    console = terminal.console()
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_row("kind", Text(values["kind"], style="bold"))
    if values["period"] is not None:
        table.add_row("period", periods_text(values["period"], values.get("period_s")))
        impacts, rests = values["impacts_per_period"], values["rest_phases"]
        table.add_row("impacts", "infinitely many" if impacts is None else f"{impacts} in a period")
        if rests:
            table.add_row("comes to rest", f"{rests} times in a period")
        for label, peak in zip(("highest", "lowest"), values["peaks"], strict=True):
            table.add_row(label, angle_text(peak, body))
        table.add_row("multipliers", multipliers_text(values["multipliers"]))
    if values["lyapunov"] is not None:
        table.add_row("Lyapunov exponent", f"{values['lyapunov']:.6g} per forcing period")
    table.add_row("known after", f"{values['settled_after_periods']} forcing periods")
    console.print(table)
    kind = values["kind"]
    if not body.symmetric and kind == "unsymmetric":
        kind = "asymmetric block"
    console.print(values["reason"] or MEANING[kind], style="dim")
    if values["growth"] > ROUNDED and values["kind"] not in ("aperiodic", "undecided"):
        console.print(
            f"On the way small differences grew {values['growth']:.0e}-fold: where several\n"
            "motions attract, a rounding may have chosen this one.",
            style="dim",
        )
