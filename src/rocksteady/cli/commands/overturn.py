"""`rocksteady overturn`: all amplitudes at which a pulse overturns a block, by frequency."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Annotated

import typer

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import (
    INCOMPLETE,
    announce_compilation,
    print_json,
    write_csv,
    write_figure,
    write_netcdf,
)
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import FlagError, both, missing
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import (
    BlockFlags,
    PulseFlags,
    ShakingFlags,
    equations_for,
)
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import number
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.motions.segments import Harmonic, Still
from rocksteady.results.rendering import print_description

HELP = (
    "The amplitudes at which a pulse overturns a block at rest, over the pulse's frequency.\n\n"
    "What overturns a block is no interval: it may fall after an impact, stand under a stronger "
    "pulse and fall without an impact under a still stronger one. Each window has its number of "
    "impacts; its ends are found to rounding, in the linear model or (--model nonlinear) with the "
    "full equations. Exit code 3 where an amplitude is undecided."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady overturn --pulse one-sine -W 0.5:8:200 -A 12 -r 0.9 --plot spectrum.png\n\n"
    "rocksteady overturn --pulse one-cosine -W log:0.3:8:200 -r 0.9 --csv windows.csv\n\n"
    "rocksteady overturn --pulse one-sine --width-m 0.5 --height-m 2 --accel-g 2 "
    "--freq-hz 1:4:13\n\n"
    "rocksteady overturn --block zhang-makris-2001 --pulse one-sine -W 2:8:25 --model nonlinear\n\n"
    "rocksteady overturn --pulse ricker -W 3 -r 0.9 --json"
)

RangeA = Annotated[
    str | None,
    typer.Option(
        "--amplitude",
        "-A",
        metavar="RANGE",
        help="Largest acceleration over alpha g up to which windows are searched, or low:high; "
        "default 1:20. Below 1 no block lifts.",
        rich_help_panel=options.MOTION,
    ),
]
RangeG = Annotated[
    str | None,
    typer.Option(
        "--accel-g",
        metavar="RANGE",
        help="The same in g; needs a block, instead of -A.",
        rich_help_panel=options.MOTION,
    ),
]
RatioAxis = Annotated[
    str | None,
    typer.Option(
        "--frequency-ratio",
        "-W",
        metavar="W",
        help="Omega = omega/p with omega = 2 pi over the pulse's period: a number or an axis, "
        "start:stop:count or log:start:stop:count.",
        rich_help_panel=options.MOTION,
    ),
]
HertzAxis = Annotated[
    str | None,
    typer.Option(
        "--freq-hz",
        metavar="F",
        help="One over the pulse's period in Hz; needs a block, instead of -W.",
        rich_help_panel=options.MOTION,
    ),
]
PhaseFlag = Annotated[
    float | None,
    typer.Option(
        "--phase",
        metavar="RAD",
        help="nu of --pulse mavroeidis-papageorgiou \\[rad], default 0.",
        rich_help_panel=options.MOTION,
    ),
]
Reverse = Annotated[
    bool,
    typer.Option(
        "--reverse",
        help="Change the sign of the pulse: it lifts the block about the other edge first.",
        rich_help_panel=options.MOTION,
    ),
]
Resolution = Annotated[
    float | None,
    typer.Option(
        "--resolution",
        metavar="PART",
        help="Largest step of the first amplitudes that are tried, as a part of them, default "
        "0.002. In doubtful places it becomes much smaller by itself.",
        rich_help_panel=options.MOTION,
    ),
]


@grouped
def overturn(
    context: typer.Context,
    pulse: PulseFlags,
    block: BlockFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    amplitude: RangeA = None,
    frequency_ratio: RatioAxis = None,
    accel_g: RangeG = None,
    freq_hz: HertzAxis = None,
    phase: PhaseFlag = None,
    reverse: Reverse = False,
    resolution: Resolution = None,
    model: options.Model = None,
) -> None:
    """Run `rocksteady overturn`; `HELP` is what its users read."""
    sweep.check(output)
    body = block.described()
    equations = equations_for(model, body, Still())
    if not pulse.given:
        raise missing(
            "--pulse",
            valid="a spectrum needs a pulse",
            hint="add --pulse one-sine; rocksteady overturn --help names them",
        )
    # The flags of the frequency are those of every shaking; its size is a range here.
    size = ShakingFlags(amplitude="1", frequency_ratio=frequency_ratio, freq_hz=freq_hz)
    ratios = sorted(set(size.of(body)[1]))
    unit = Harmonic(amplitude=1.0, frequency_ratio=ratios[0])
    shape = pulse.of(unit, phase=phase, reverse=reverse)
    within = _range(body, amplitude, accel_g)
    if output.plot is not None and len(ratios) < 2:
        raise FlagError(
            "--plot",
            output.plot,
            "a spectrum is drawn over two frequencies or more",
            "give -W as an axis, as 0.5:8:200, or leave --plot out",
        )
    run = sweep.run(force=output.force)

    announce_compilation("pulses.pulse_fates")
    from rocksteady.dynamics.overturning.windows import RESOLUTION, find_overturning_windows

    with (
        _as_typed(accel_g),
        sweep.resumable(context.find_root().obj),
        sweeping("searching frequencies", len(ratios)) as meter,
    ):
        found = find_overturning_windows(
            body,
            shape,
            ratios,
            within=within,
            resolution=RESOLUTION if resolution is None else resolution,
            model=equations,
            run=replace(run, progress=meter),
        )
    description = found.describe()
    if output.csv is not None:
        frame = found.to_dataframe()
        write_csv(output.csv, list(frame), frame.itertuples(index=False, name=None))
    if sweep.netcdf is not None:
        write_netcdf(sweep.netcdf, found.to_dataset())
    if output.plot is not None:
        from rocksteady.show.figures.single import overturning_figure

        write_figure(output.plot, overturning_figure(found, description.headline, output.page))
    if output.as_json:
        store = run.place and str(run.place.path)
        print_json("overturn", {**description.to_dict(), "seconds": meter.seconds, "store": store})
    else:
        print_description(description, terminal.console(wrap=True))
    if found.undecided.any():
        raise typer.Exit(INCOMPLETE)


@contextmanager
def _as_typed(accel_g: str | None) -> Iterator[None]:
    """Name in errors about the range of amplitudes the flag that gave it."""
    try:
        yield
    except InputError as error:
        if error.name != "within":
            raise
        flag = "--amplitude/-A" if accel_g is None else "--accel-g"
        raise InputError(flag, error.value, error.valid, error.hint) from error


def _range(
    body: Block | DimensionlessBlock, amplitude: str | None, accel_g: str | None
) -> tuple[float, float] | None:
    """Return the range of amplitudes that the flags name; None where they name none.

    Raises
    ------
    InputError, ModelError
        If both are given, a block is missing, or the text is no range.
    """
    if amplitude is not None and accel_g is not None:
        raise both("--amplitude/-A", "--accel-g", valid="at most one of the two is the range")
    # Of an asymmetric block the other side may lift sooner.
    lowest = min(ratio for _, ratio, _ in body.dimensionless().sides)
    if accel_g is None:
        return None if amplitude is None else _ends("--amplitude/-A", amplitude, lowest)
    if isinstance(body, DimensionlessBlock):
        raise FlagError(
            "--accel-g",
            accel_g,
            "g needs a block with a slenderness",
            "describe a block, or give -A",
        )
    unit = body.uplift_acceleration / body.gravity
    low, high = _ends("--accel-g", accel_g, lowest * unit)
    return low / unit, min(high / unit, LARGEST)


def _ends(flag: str, text: str, lowest: float) -> tuple[float, float]:
    """Return the ends of ``high`` or ``low:high``."""
    parts = text.split(":")
    if len(parts) > 2:
        raise InputError(
            flag,
            text,
            "it must be a number or a range",
            "write the largest as 12, or low:high as 1:12; all in between is searched",
        )
    ends = [number(flag, part) for part in parts]
    low, high = ends if len(ends) == 2 else (min(lowest, ends[0]), ends[0])
    if not 0.0 <= low < high:
        raise InputError(
            flag,
            text,
            "the range must ascend from 0 or above",
            f"write it as {lowest:.4g}:{12 * lowest:.4g}",
        )
    return low, high
