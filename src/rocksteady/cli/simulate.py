"""`rocksteady simulate`: one time history."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer

from rocksteady.cli import flags
from rocksteady.cli.groups import AnimationFlags, OutputFlags, grouped
from rocksteady.cli.nouns import BlockFlags, PulseFlags, ShakingFlags
from rocksteady.cli.outputs import (
    INCOMPLETE,
    announce_compilation,
    print_json,
    write_csv,
    write_figure,
    write_film,
)
from rocksteady.cli.starts import StartFlags, refuse_without_shaking
from rocksteady.cli.values import block_values, case_text, restitution_values, shaking_values
from rocksteady.errors import InputError, ModelError, Status
from rocksteady.model.block import Block, DimensionlessBlock
from rocksteady.model.motions import Harmonic, Motion, Still
from rocksteady.model.pulses import Pulse
from rocksteady.model.validation import whole_number

if TYPE_CHECKING:
    from rocksteady.dynamics.nonlinear import ModelName
    from rocksteady.dynamics.trajectory import Trajectory
    from rocksteady.show.animation import Film

HELP = (
    "One time history: every flight in closed form (of the full equations with --model nonlinear: "
    "to within a tolerance), every impact, overturning proved.\n\n"
    "Without shaking (-A and -W, or --accel-g and --freq-hz) a block that is let go rocks freely "
    "until it rests or overturns. After a pulse (--pulse) too it is followed until then."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady simulate -A 2 -W 1.9 -r 0.8 --start steady --cycles 40 --plot run.png\n\n"
    "rocksteady simulate --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 1 --csv run.csv\n\n"
    "rocksteady simulate --block zhang-makris-2001 --pulse one-sine --accel-g 2 --freq-hz 1.7\n\n"
    "rocksteady simulate --block zhang-makris-2001 --start 0.6,w=0 --json\n\n"
    "rocksteady simulate --width-m 0.4 --height-m 0.8 -A 2 -W 4 --model nonlinear\n\n"
    "rocksteady simulate --block tso-wong-1989 -A 4 -W 1.5 --animate fall.gif"
)

CyclesFlag = Annotated[
    float | None,
    typer.Option(
        "--cycles",
        metavar="N",
        help="Periods of the shaking to follow, default 50.",
        rich_help_panel=flags.START,
    ),
]
SamplesFlag = Annotated[
    int,
    typer.Option(
        "--samples",
        metavar="N",
        help="Rows of --csv per period of the shaking (per pt = 1 without shaking and around a "
        "pulse); impacts are always rows.",
        rich_help_panel=flags.OUTPUT,
    ),
]
ToleranceFlag = Annotated[
    float | None,
    typer.Option(
        "--tolerance",
        metavar="X",
        help="Error that the nonlinear motion may have, as a part of it; default 1e-10.",
        rich_help_panel=flags.START,
    ),
]


@grouped
def simulate(
    shaking: ShakingFlags,
    pulse: PulseFlags,
    block: BlockFlags,
    output: OutputFlags,
    film: AnimationFlags,
    start: StartFlags,
    cycles: CyclesFlag = None,
    samples: SamplesFlag = 100,
    model: flags.Model = "linear",
    tolerance: ToleranceFlag = None,
) -> None:
    """Run `rocksteady simulate`; `HELP` is what its users read."""
    output.check()
    film.check(output)
    body = block.described()
    motion: Motion = Still()
    if pulse.given:
        motion = pulse.of(shaking.at(body), phase=start.phase)
        refuse_cycles_of_pulse(cycles)
    elif shaking.given:
        motion = shaking.at(body, phase=start.first_phase)
    start.check(shaken=not isinstance(motion, Still))
    if isinstance(motion, Still):
        refuse_without_shaking("--cycles", cycles)
    whole_number("per_unit", samples, at_least=1, hint="give rows per period")
    refuse_of_linear(model, "--tolerance", tolerance)

    announce_compilation()
    from rocksteady.dynamics.simulate import simulate as run

    begin = start.of(motion.frequency_ratio if isinstance(motion, Harmonic) else None)
    with start.as_typed():
        trajectory = run(
            body,
            motion,
            start=begin,
            cycles=50.0 if cycles is None else cycles,
            side=start.sign,
            model=cast("ModelName", model),
            tolerance=1e-10 if tolerance is None else tolerance,
        )
    values = trajectory_values(trajectory, body)
    # Made before any file is written: a run that is too long to be shown is refused here.
    moving = None if film.animate is None else film_of_run(trajectory, film)
    if output.csv is not None:
        write_csv(output.csv, csv_header(trajectory), csv_rows(trajectory, samples))
    if output.plot is not None:
        from rocksteady.show.figures import simulation_figure

        title = f"Rocking block: {case_text(values)}"
        if trajectory.model == "nonlinear":
            title += ", nonlinear"
        write_figure(output.plot, simulation_figure(trajectory, title))
    if moving is not None and film.animate is not None:
        write_film(film.animate, moving)
    if output.as_json:
        print_json("simulate", values)
    else:
        print_summary(values, trajectory)
    if trajectory.status is Status.UNDECIDED:
        raise typer.Exit(INCOMPLETE)


def refuse_of_linear(model: str, name: str, value: object) -> None:
    """Refuse what only the nonlinear model has.

    Raises
    ------
    ModelError
        If it is given with the linear model.
    """
    if model == "linear" and value is not None:
        raise ModelError(
            name=name,
            value=value,
            valid="only the nonlinear model has it",
            hint="leave it out, or take --model nonlinear",
        )


def refuse_cycles_of_pulse(cycles: float | None) -> None:
    """Refuse a number of cycles for a motion that ends.

    Raises
    ------
    ModelError
        If there is one.
    """
    if cycles is not None:
        raise ModelError(
            name="--cycles",
            value=cycles,
            valid="a pulse ends, and the block is followed to rest or overturning",
            hint="leave it out",
        )


def film_of_run(trajectory: "Trajectory", flags_of_film: AnimationFlags) -> "Film":
    """Return the film of a whole run.

    Raises
    ------
    InputError
        If it would have too many frames, or too few to show each period.
    """
    from rocksteady.show.animation import film_of

    try:
        return film_of(trajectory, speed=flags_of_film.speed)
    except InputError as error:
        if error.name != "span":
            raise
        # The command has no part of a run to offer, but the run can be made shorter.
        shaken = isinstance(trajectory.motion, Harmonic)
        raise InputError(
            name="--animate",
            value=flags_of_film.animate,
            valid=error.valid,
            hint="follow fewer periods with --cycles" if shaken else "give a --speed",
        ) from error


def trajectory_values(trajectory: "Trajectory", body: Block | DimensionlessBlock) -> dict[str, Any]:
    """Return what the contract promises, in plain values."""
    motion, block = trajectory.motion, trajectory.block
    values: dict[str, Any] = {
        "model": trajectory.model,
        "status": trajectory.status.label,
        "peak": trajectory.peak,
        "impacts": len(trajectory.impacts),
        "flights": len(trajectory.rows),
        **restitution_values(body),
    }
    if not body.symmetric:
        values["side_peaks"] = list(trajectory.side_peaks)
    if isinstance(motion, Harmonic):
        values |= shaking_values(body, motion)
        values["phase"] = motion.phase
    elif isinstance(motion, Pulse):
        values |= {"pulse": motion.shape} | shaking_values(body, motion)
        values["duration_pt"] = motion.duration
        if isinstance(body, Block):
            values["duration_s"] = motion.duration / body.p
    elif isinstance(body, Block):
        values["block"] = block_values(body)
    if block is None:
        values["overturn_time_tau"] = trajectory.overturn_tau
        values["overturn_time_pt"] = trajectory.overturn_s
        values["rest_time_pt"] = trajectory.rest_s
    else:
        values["overturn_time_s"] = trajectory.overturn_time_s
        values["rest_time_s"] = None if trajectory.rest_s is None else trajectory.rest_s / block.p
        sides = zip(trajectory.side_peaks, (block.positive, block.negative), strict=True)
        # The larger angle may be the smaller part of its alpha.
        values["peak_rad"] = max(peak * side.alpha for peak, side in sides)
    return values


def print_summary(values: dict[str, Any], trajectory: "Trajectory") -> None:
    """Print how it ended, what that means, and the figures that people ask for first."""
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, soft_wrap=True)
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_row("status", f"[bold]{values['status']}[/bold]")
    peak = f"{values['peak']:.10g} alpha"
    if "side_peaks" in values:  # each in its own alpha
        left, right = values["side_peaks"]
        table.add_row("peak, left edge", f"{left:.10g} alpha")
        table.add_row("peak, right edge", f"{right:.10g} alpha")
        peak = f"{values['peak']:.10g} alpha of its side"
    if "peak_rad" in values and "side_peaks" not in values:
        peak += f" = {values['peak_rad']:.6g} rad"
    if trajectory.overturn_s is not None:
        peak += ", up to overturning"
    table.add_row("peak", peak)
    table.add_row("impacts", str(values["impacts"]))
    if trajectory.overturn_s is not None:
        table.add_row("overturns at", time_text(trajectory, trajectory.overturn_s))
    if trajectory.rest_s is not None:
        table.add_row("at rest from", time_text(trajectory, trajectory.rest_s))
    console.print(table)
    console.print(trajectory.status.advice, style="dim")


def time_text(trajectory: "Trajectory", s: float) -> str:
    """Return a pivot time in every unit that the run has."""
    parts = [f"pt = {s:.8g}"]
    if isinstance(trajectory.motion, Harmonic):
        tau = s * trajectory.motion.frequency_ratio
        parts.append(f"tau = {tau:.8g} ({tau / (2.0 * math.pi):.4f} periods)")
    if trajectory.block is not None:
        parts.append(f"{s / trajectory.block.p:.8g} s")
    return ", ".join(parts)


def csv_header(trajectory: "Trajectory") -> list[str]:
    """Return the columns of the time history."""
    header = ["pivot_time"]
    if isinstance(trajectory.motion, Harmonic):
        header.append("tau")
    header += ["angle_per_alpha", "velocity_per_pivot_time", "acceleration_per_pivot_time2"]
    header += ["base_acceleration_per_alpha_g", "energy"]
    if trajectory.block is not None:
        header += ["time_s", "angle_rad", "base_acceleration_m_s2"]
    return header


def csv_rows(trajectory: "Trajectory", samples: int) -> Iterator[list[float]]:
    """Yield the time history row by row, the motion just after each impact included."""
    motion = trajectory(trajectory.times(samples))
    columns = [motion.s]
    if motion.tau is not None:
        columns.append(motion.tau)
    columns += [motion.angle, motion.velocity, motion.acceleration]
    columns += [motion.base_acceleration, motion.energy]
    if trajectory.block is not None and motion.t_s is not None:
        block = trajectory.block
        columns += [motion.t_s, motion.angle * block.alpha]
        columns.append(motion.base_acceleration * block.uplift_acceleration)
    for row in zip(*columns, strict=True):
        yield [float(value) for value in row]
