"""`rocksteady simulate`: one time history."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rocksteady.cli import flags
from rocksteady.cli.groups import (
    AnimationFlags,
    BlockFlags,
    OutputFlags,
    ShakingFlags,
    grouped,
)
from rocksteady.cli.inputs import single, start_from
from rocksteady.cli.outputs import (
    announce_compilation,
    print_json,
    write_csv,
    write_figure,
    write_film,
)
from rocksteady.errors import InputError, ModelError, Status
from rocksteady.model.motions import Harmonic, Motion, Still
from rocksteady.model.validation import whole_number

if TYPE_CHECKING:
    from rocksteady.dynamics.trajectory import Trajectory
    from rocksteady.show.animation import Film

START = "Start and length"
INCOMPLETE = 3
STEADY = ("steady", "steady:1", "steady:2")

HELP = (
    "One time history: every flight in closed form, every impact, overturning proved.\n\n"
    "Without shaking (-A and -W, or --accel-g and --freq-hz) a block that is let go rocks freely "
    "until it rests or overturns."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady simulate -A 2 -W 1.9 -r 0.8 --start steady --cycles 40 --plot run.png\n\n"
    "rocksteady simulate --width-m 0.4 --height-m 2 --accel-g 0.4 --freq-hz 1 --csv run.csv\n\n"
    "rocksteady simulate --block zhang-makris-2001 --start 0.6,w=0 --json\n\n"
    "rocksteady simulate --block tso-wong-1989 -A 4 -W 1.5 --animate fall.gif"
)

StartFlag = Annotated[
    str,
    typer.Option(
        "--start",
        metavar="START",
        help="rest; steady or steady:2 (on branch 1 or 2 of order -n); U,DU (u and du/dtau); or "
        "U,w=V (V = du/d(pt)).",
        rich_help_panel=START,
    ),
]
SideFlag = Annotated[
    str,
    typer.Option(
        "--side",
        metavar="+|-",
        help="Side of its unstable direction on which an unstable state is left.",
        rich_help_panel=START,
    ),
]
KickFlag = Annotated[
    float | None,
    typer.Option(
        "--kick",
        metavar="K",
        help="How far from an unstable steady state the block is set off, default 1e-6: length of "
        "(phase \\[rad], velocity over the orbit's).",
        rich_help_panel=START,
    ),
]
PhaseFlag = Annotated[
    float | None,
    typer.Option(
        "--phase",
        metavar="RAD",
        help="Phase of the shaking at the start \\[rad], default 0; not with --start steady.",
        rich_help_panel=START,
    ),
]
CyclesFlag = Annotated[
    float | None,
    typer.Option(
        "--cycles",
        metavar="N",
        help="Periods of the shaking to follow, default 50.",
        rich_help_panel=START,
    ),
]
SamplesFlag = Annotated[
    int,
    typer.Option(
        "--samples",
        metavar="N",
        help="Rows of --csv per period of the shaking (per pt = 1 without shaking); impacts are "
        "always rows.",
        rich_help_panel=flags.OUTPUT,
    ),
]


@grouped
def simulate(
    shaking: ShakingFlags,
    block: BlockFlags,
    output: OutputFlags,
    film: AnimationFlags,
    start: StartFlag = "rest",
    order: flags.Order = 1,
    phase: PhaseFlag = None,
    side: SideFlag = "+",
    kick: KickFlag = None,
    cycles: CyclesFlag = None,
    samples: SamplesFlag = 100,
) -> None:
    """Run `rocksteady simulate`; `HELP` is what its users read."""
    output.check()
    film.check(output)
    body = block.described()
    if side not in ("+", "-"):
        raise InputError(name="side", value=side, valid="it must be + or -", hint="give + or -")
    motion: Motion = Still()
    ratio = None
    if shaking.given:
        amplitudes, ratios = shaking.of(body)
        ratio = single("frequency_ratio", ratios)
        motion = Harmonic(
            amplitude=single("amplitude", amplitudes),
            frequency_ratio=ratio,
            phase=0.0 if phase is None else phase,
        )
    check_start(start, shaken=ratio is not None, phase=phase, cycles=cycles)
    whole_number("per_unit", samples, at_least=1, hint="give rows per period")

    announce_compilation()
    from rocksteady.dynamics.simulate import simulate as run

    begin = start_from(start, order=order, kick=kick, frequency_ratio=ratio)
    try:
        trajectory = run(
            body,
            motion,
            start=begin,
            cycles=50.0 if cycles is None else cycles,
            side=1 if side == "+" else -1,
        )
    except ModelError as error:
        if error.name != "start":
            raise
        # What was typed, in place of the object that it has become.
        raise ModelError(name="start", value=start, valid=error.valid, hint=error.hint) from error
    values = trajectory_values(trajectory)
    # Made before any file is written: a run that is too long to be shown is refused here.
    moving = None if film.animate is None else film_of_run(trajectory, film)
    if output.csv is not None:
        write_csv(output.csv, csv_header(trajectory), csv_rows(trajectory, samples))
    if output.plot is not None:
        from rocksteady.show.figures import simulation_figure

        write_figure(output.plot, simulation_figure(trajectory, figure_title(values)))
    if moving is not None and film.animate is not None:
        write_film(film.animate, moving)
    if output.as_json:
        print_json("simulate", values)
    else:
        print_summary(values, trajectory)
    if trajectory.status is Status.UNDECIDED:
        raise typer.Exit(INCOMPLETE)


def check_start(start: str, *, shaken: bool, phase: float | None, cycles: float | None) -> None:
    """Refuse flags that contradict each other.

    Raises
    ------
    ModelError
        If they do.
    """
    if start in STEADY and phase is not None:
        raise ModelError(
            name="--phase",
            value=phase,
            valid="a steady state decides its phase",
            hint="leave --phase or --start steady out",
        )
    if shaken:
        return
    if start in STEADY:
        raise ModelError(
            name="--start",
            value=start,
            valid="a steady state needs shaking",
            hint="give shaking with -A and -W, or another start as 0.5,w=0",
        )
    if start == "rest":
        raise ModelError(
            name="--start",
            value=start,
            valid="on a still base a block at rest stays there",
            hint="give shaking with -A and -W, or let the block go: --start 0.5,w=0",
        )
    for flag, value in (("--phase", phase), ("--cycles", cycles)):
        if value is not None:
            raise ModelError(
                name=flag,
                value=value,
                valid="without shaking it has no meaning",
                hint="leave it out, or give shaking with -A and -W",
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


def trajectory_values(trajectory: "Trajectory") -> dict[str, Any]:
    """Return what the contract promises, in plain values."""
    motion, block = trajectory.motion, trajectory.block
    restitution = float(trajectory.sides[0, 0])
    values: dict[str, Any] = {
        "status": trajectory.status.label,
        "peak": trajectory.peak,
        "impacts": len(trajectory.impacts),
        "flights": len(trajectory.rows),
        "restitution": restitution,
    }
    if isinstance(motion, Harmonic):
        values["amplitude"] = motion.amplitude
        values["frequency_ratio"] = motion.frequency_ratio
        values["phase"] = motion.phase
    if block is None:
        values["overturn_time_tau"] = trajectory.overturn_tau
        values["overturn_time_pt"] = trajectory.overturn_s
        values["rest_time_pt"] = trajectory.rest_s
    else:
        values["overturn_time_s"] = trajectory.overturn_time_s
        values["rest_time_s"] = None if trajectory.rest_s is None else trajectory.rest_s / block.p
        values["peak_rad"] = trajectory.peak * block.alpha
        values["block"] = {
            "alpha_rad": block.alpha,
            "radius_m": block.radius,
            "p_rad_s": block.p,
            "restitution": block.restitution,
        }
        if isinstance(motion, Harmonic):
            values["accel_g"] = motion.acceleration_m_s2(block) / block.gravity
            values["freq_hz"] = motion.frequency_hz(block)
    return values


def figure_title(values: dict[str, Any]) -> str:
    """Return one line that says what is drawn."""
    parts = []
    if "amplitude" in values:
        parts.append(f"A = {values['amplitude']:g}, Ω = {values['frequency_ratio']:g}")
    else:
        parts.append("free rocking")
    parts.append(f"restitution {values['restitution']:.4g}")
    if "block" in values:
        block = values["block"]
        parts.append(f"α = {block['alpha_rad']:.4g} rad, p = {block['p_rad_s']:.4g} rad/s")
    return "Rocking block: " + ", ".join(parts)


def print_summary(values: dict[str, Any], trajectory: "Trajectory") -> None:
    """Print how it ended, what that means, and the figures that people ask for first."""
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, soft_wrap=True)
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_row("status", f"[bold]{values['status']}[/bold]")
    peak = f"{values['peak']:.10g} alpha"
    if "peak_rad" in values:
        peak += f" = {values['peak_rad']:.6g} rad"
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
