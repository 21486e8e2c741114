"""`rocksteady basins`: basins of attraction, their shares over a parameter, and erosion."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import typer

from rocksteady.cli.commands.windows._finite_window import leave_fates, shaken_by
from rocksteady.cli.console.refusals import FlagError, refuse, require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import (
    HARMONIC,
    BlockFlags,
    PulseFlags,
    ShakingFlags,
    equations_for,
)
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import axis
from rocksteady.cli.flags.range import SeriesFlags, refuse_flat
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.cli.flags.window import WindowFlags
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import line

if TYPE_CHECKING:
    from rocksteady.dynamics.basins.basins import Basins
    from rocksteady.dynamics.basins.erosion import Erosion
    from rocksteady.dynamics.basins.over.shares import BasinShares
    from rocksteady.model.blocks.dimensionless import DimensionlessBlock

HELP = (
    "Find which starts end where.\n\n"
    "Attractor or fate of each state of a window: basins of attraction and their shares.\n\n"
    "With an axis of frequencies, restitutions or phases (-W 1.5:3:31) it computes the shares "
    "over it, with labels that stay with their orbits. With an axis of amplitudes (-A 0:1:21) "
    "it computes how the safe basin, the states from which the block does not overturn, erodes "
    "as the amplitude grows; --shares gives the shares there too. Under a recorded motion "
    "(--record) or a pulse (--pulse) it computes which states come to rest and which overturn, "
    "to which side, and at what peak. Exit code 3 where more than 1 state in 1000 is undecided."
)
MAIN = "amplitude frequency_ratio restitution width_m height_m record pulse angles velocities plot"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady basins -A 0.5 -W 2 -r 0.95 --plot basins.png\n\n"
    "rocksteady basins -A 1.5 -W 4 -r 0.9 --angles=-1:1:400 --velocities=-1.2:1.2:400 --json\n\n"
    "rocksteady basins -A 0.5 -W 2 -r 0.95 --entropy 18 --exponent\n\n"
    "rocksteady basins -A 0.5 -W 1.5:3:31 -r 0.95 --seed 1 --plot shares.png\n\n"
    "rocksteady basins -A 0:1.6:33 -W 2 -r 0.9 --plot erosion.png\n\n"
    "rocksteady basins --width-m 0.8 --height-m 3 --record example:firm-ground --scale 0.5 --plot "
    "fates.png\n\n"
    "rocksteady basins --alpha-rad 0.3 --radius-m 1 -r 0.9 -A 1.5 -W 4 "
    "--angles=-1.4:1.4:60 --velocities=-1.6:1.6:60"
)

measure_flag = options.Panel("Measures")
PROBES: tuple[Literal["states", "boxes"], ...] = ("states", "boxes")
"""By what --exponent counts."""


@grouped
def basins(
    context: typer.Context,
    shaking: ShakingFlags,
    series: SeriesFlags,
    pulse: PulseFlags,
    recorded: RecordFlags,
    reading: ReadingFlags,
    block: BlockFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    window: WindowFlags,
    cycles: int | None = options.start_flag(
        "--cycles N",
        "Periods of the shaking for which a state is followed, default 500; for an erosion "
        "the periods without overturning that make a state safe, default 100.",
    ),
    shares: bool = measure_flag(
        "--shares",
        "Compute the shares of the basins, not the erosion, over an axis of amplitudes.",
        default=False,
    ),
    entropy: int | None = measure_flag(
        "--entropy CELLS",
        "Compute the basin entropy and the boundary basin entropy, with boxes of this many "
        "states a side, as 18, which must divide the counts of --angles and --velocities.",
    ),
    exponent: bool = measure_flag(
        "--exponent",
        "Compute the uncertainty exponent and the dimension of the boundary, by states and by "
        "boxes; 40 states or more along each axis.",
        default=False,
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady basins`; `HELP` is what its users read."""
    sweep.check(output, recorded.files)
    on_floor = pulse.given or shaking.given
    of_record = recorded.given(reading, pulse=pulse.given, on_floor=on_floor)
    require("basins", {"block": block.given, "motion": of_record or on_floor}, *HARMONIC)
    if of_record or pulse.given:
        refuse(
            {
                "--seed": window.seed,
                "--cycles": cycles,
                "--shares": shares,
                "--entropy": entropy,
                "--exponent": exponent,
                "--harmonic": series.harmonic,
            },
            "it applies to harmonic shaking alone, which does not end",
            "leave it out, or leave out --record and --pulse",
        )
        asked = (shaking, pulse, recorded, reading, block)
        shaken = shaken_by(*asked, window.phase, model)
        leave_fates(context, *shaken, window, model, sweep, output, *asked)
        return
    refuse(
        {"--at-pt": window.time_pt, "--at-s": window.time_s},
        "it is a time since the start of a record or a pulse",
        "give --phase for harmonic shaking, or add --record or --pulse",
    )
    body, scale, moving = _case(shaking, block, window.phase)
    motion = reading.along(None if moving is None else moving[0], series.of(scale), body)
    equations = equations_for(model, body)
    eroding = moving is not None and moving[0] == "amplitude" and not shares
    _refuse(moving, window.seed, entropy, eroding=eroding, shares=shares, exponent=exponent)
    chosen: dict[str, Any] = window.axes
    if cycles is not None:
        chosen["cycles" if eroding else "max_cycles"] = cycles
    from rocksteady.dynamics.basins.basins import Basins, compute_basins
    from rocksteady.dynamics.basins.erosion import Erosion, compute_erosion
    from rocksteady.dynamics.basins.measures.entropy import box_sides
    from rocksteady.dynamics.basins.measures.uncertainty import probe_sizes
    from rocksteady.dynamics.basins.over import shares as over
    from rocksteady.dynamics.basins.window import CELLS, POINTS

    cells = (POINTS, POINTS) if eroding else CELLS
    names = zip(("velocities", "angles"), reversed(cells), strict=True)
    shape = tuple(len(chosen.get(name, range(count))) for name, count in names)
    if entropy is not None:
        box_sides(entropy, shape)
    for by in PROBES if exponent else ():
        probe_sizes(None, shape, by)
    maps = 1 if moving is None else len(moving[1]) + (eroding and moving[1][0] != 0.0)
    run = sweep.run(force=output.force)
    with sweep.running(context, run, "following states", maps * math.prod(shape)) as (shown, _):
        how: dict[str, Any] = {"model": equations, "run": shown}
        result: Basins | over.BasinShares | Erosion
        if moving is None:
            result = compute_basins(body, motion, **chosen, seed=window.seed, **how)
        elif eroding:
            result = compute_erosion(body, motion, moving[1], **chosen, **how)
        else:
            sampling = over.SamplingOptions(**chosen, seed=window.seed)
            result = over.compute_basin_shares(body, motion, *moving, sampling=sampling, **how)
    drawn = _drawn(
        output, shaking, series, reading, block, window, *_given(model, cycles, shares=shares)
    )
    if isinstance(result, Basins):
        _leave_basins(result, output, sweep, entropy, drawn, exponent=exponent)
    elif isinstance(result, Erosion):
        _leave_erosion(result, output, sweep, drawn)
    else:
        _leave_shares(result, output, sweep, entropy, drawn)


def _drawn(output: OutputFlags, *asked: object) -> str:
    """Return the same command with a picture; none where there is one."""
    return "" if output.plot else options.follow_up("basins", *asked, "--plot basins.png")


def _given(model: str | None, cycles: int | None, *, shares: bool) -> list[str]:
    """Return the flags of the command that stand in no group."""
    return [
        f"--model {model}" if model else "",
        f"--cycles {cycles}" if cycles else "",
        "--shares" if shares else "",
    ]


def _case(
    shaking: ShakingFlags, block: BlockFlags, phase: str
) -> "tuple[Block | DimensionlessBlock, Harmonic, tuple[str, list[float]] | None]":
    """Return block, shaking and the parameter that is an axis with its values, if there is one.

    Raises
    ------
    InputError, ModelError
        If a value is missing, given twice or outside its range, or two of them are axes.
    """
    restitutions = block.restitutions
    if restitutions:
        block = replace(block, restitution=repr(restitutions[0]))
    body = block.described()
    amplitudes, ratios = shaking.of(body)
    phases = axis("--phase", phase)
    axes = {
        "amplitude": amplitudes,
        "frequency_ratio": ratios,
        "restitution": restitutions,
        "phase": phases,
    }
    moving = [(name, values) for name, values in axes.items() if len(values) > 1]
    if len(moving) > 1:
        raise FlagError(
            finding=f"{len(moving)} of -A, -W, -r and --phase are axes",
            valid="at most one of them is an axis",
            hint="give the others as numbers",
        )
    for name, values in moving:
        refuse_flat(name, values, "1.6:2.4:41")
    motion = Harmonic(amplitude=amplitudes[0], frequency_ratio=ratios[0], phase=phases[0])
    return body, motion, moving[0] if moving else None


def _refuse(
    moving: tuple[str, list[float]] | None,
    seed: int | None,
    entropy: int | None,
    *,
    eroding: bool,
    shares: bool,
    exponent: bool,
) -> None:
    """Refuse flags that have no meaning beside others.

    Raises
    ------
    FlagError
        If there are such.
    """
    if shares and moving is None:
        raise FlagError(
            finding="--shares is given, and none of -A, -W, -r and --phase is an axis",
            valid="shares are computed over an axis",
            hint="give one as start:stop:count, as -A 0.5:1.5:21, or leave it out",
        )
    if eroding:
        grid, hint = "safe basins are computed at the points of a grid", "give one amplitude"
        refuse({"--seed": seed}, grid, f"leave it out, or {hint} or --shares")
        refuse({"--entropy": entropy}, "an erosion has none", f"add --shares, or {hint}")
    if moving is not None and exponent:
        raise FlagError(
            finding="--exponent is given with an axis",
            valid="it is computed for one window",
            hint="give numbers for -A, -W, -r and --phase",
        )


def _leave_basins(
    result: "Basins",
    output: OutputFlags,
    sweep: SweepFlags,
    entropy: int | None,
    further: str,
    *,
    exponent: bool,
) -> None:
    """Write the output of basins that the flags request."""
    from rocksteady.show.figures.single import basins_figure
    from rocksteady.words.windows import FEW

    description = result.describe()
    entropies = [] if entropy is None else [result.entropy(entropy)]
    exponents = [result.uncertainty_exponent(by=by) for by in PROBES] if exponent else []
    measured = [
        f"dimension {2.0 - each.exponent:.2f} by {each.by}"
        for each in exponents
        if not math.isnan(each.exponent)
    ]
    measured += [f"basin entropy {each.entropy:.3f}" for each in entropies]
    if measured:
        facts = [fact for fact in description.facts if fact.label != "boundary"]
        facts.insert(0, line("boundary", ", ".join(measured)))
        description = replace(description, facts=facts)
    sweep.write_netcdf(result.to_dataset)
    output.write_csv(result.to_dataframe)
    output.write_plot(lambda page: basins_figure(result, description.headline, page))
    output.leave(
        "basins",
        description,
        after={
            "entropy": entropies[0].to_dict() if entropies else None,
            "exponents": [each.to_dict() for each in exponents] or None,
        },
        also=[each.describe() for each in (*entropies, *exponents)],
        decided=result.undecided <= FEW,
        wrap=True,
        follow_up=further,
    )


def _leave_shares(
    shares: "BasinShares",
    output: OutputFlags,
    sweep: SweepFlags,
    entropy: int | None,
    further: str,
) -> None:
    """Write the output of shares over a parameter that the flags request."""
    from rocksteady.show.figures.single import shares_figure
    from rocksteady.words.windows import FEW

    description = shares.describe()
    sweep.write_netcdf(shares.to_dataset)
    entropies = [] if entropy is None else [shares.entropies(entropy).describe()]
    if entropy is not None:
        low, *_, high = sorted(each.entropy for each in shares.entropies(entropy).entropies)
        fact = line("basin entropy", f"{low:.3f} to {high:.3f}")
        description = replace(description, facts=[fact, *description.facts])
    output.write_csv(lambda: description.tables[0])
    output.write_plot(lambda page: shares_figure(shares, description.headline, page))
    output.leave(
        "basins",
        description,
        after={"entropies": entropies[0].to_dict()["entropies"] if entropies else None},
        also=entropies,
        decided=shares.undecided <= FEW,
        wrap=True,
        follow_up=further,
    )


def _leave_erosion(
    erosion: "Erosion", output: OutputFlags, sweep: SweepFlags, further: str
) -> None:
    """Write the output of an erosion that the flags request."""
    from rocksteady.show.figures.single import erosion_figure

    description = erosion.describe()
    drops = [drop for drop in erosion.drops.values() if drop is not None]
    sweep.write_netcdf(erosion.to_dataset)
    output.write_csv(lambda: description.tables[0])
    output.write_plot(lambda page: erosion_figure(erosion, drops, description.headline, page))
    output.leave("basins", description, wrap=True, follow_up=further)
