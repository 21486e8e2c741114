"""`rocksteady overturn`: all amplitudes at which a pulse overturns a block, by frequency."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import typer

from rocksteady.cli.console.refusals import FlagError, both, flags_of, missing, refuse, require
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import (
    BlockFlags,
    PulseFlags,
    ShakingFlags,
    equations_for,
)
from rocksteady.cli.flags.ensemble import Suite, SuiteFlags
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import axis, number
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.segments import Harmonic, Still
from rocksteady.results.description import line
from rocksteady.results.numbers import quantity

if TYPE_CHECKING:
    from rocksteady.model.motions.record import Record
    from rocksteady.results.description import Description
    from rocksteady.seismic.spectra.overturning_scales import OverturningScales

HELP = (
    "Find every strength at which a pulse or a record fells a block.\n\n"
    "The amplitudes at which a pulse overturns a block at rest, over the pulse's frequency.\n\n"
    "The overturning amplitudes are not one interval: a block may fall after an impact, stand "
    "under a stronger pulse and fall without an impact under a still stronger one. Each window "
    "has its number of impacts; its ends are found to rounding. Where sides differ, the reversed "
    "motion is searched too, and the answer names the direction that governs. With --record or "
    "--records the factor of a record is searched; with --kick the least sudden change of the base "
    "velocity, of either sign, that overturns the block under the motion as given. Exit code 3 "
    "where an amplitude is undecided."
)
MAIN = "width_m height_m restitution record pulse accel_g freq_hz amplitude frequency_ratio plot"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady overturn --pulse one-sine -W 0.5:8:200 -A 12 -r 0.9 --plot spectrum.png\n\n"
    "rocksteady overturn --pulse one-cosine -W log:0.3:8:200 -r 0.9 --csv windows.csv\n\n"
    "rocksteady overturn --pulse one-sine --width-m 0.5 --height-m 2 --accel-g 2 "
    "--freq-hz 1:4:13\n\n"
    "rocksteady overturn --block zhang-makris-2001 --pulse one-sine -W 2:8:25\n\n"
    "rocksteady overturn --pulse ricker -W 3 -r 0.9 --json\n\n"
    "rocksteady overturn --kick --start 0.5,0 --width-m 0.6 --height-m 1.8"
)


class Search(NamedTuple):
    """A search and its figure; `find` takes the `Execution` alone.

    In errors `flags` stand in place of arguments.
    """

    find: Callable[..., Any]
    words: str
    cells: int
    figure: Callable[..., Any]
    flags: Mapping[str, str]
    suite: Suite | None = None


@grouped
def overturn(
    context: typer.Context,
    pulse: PulseFlags,
    block: BlockFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    recorded: RecordFlags,
    suite: SuiteFlags,
    reading: ReadingFlags,
    amplitude: str | None = options.motion_flag(
        "--amplitude -A RANGE",
        "Largest acceleration over alpha g up to which windows are searched, or low:high; "
        "default 1:20. Below 1 no block lifts.",
    ),
    frequency_ratio: str | None = options.motion_flag(
        "--frequency-ratio -W W",
        "Omega = omega/p with omega = 2 pi over the pulse's period: a number or an axis, "
        "start:stop:count or log:start:stop:count.",
    ),
    accel_g: str | None = options.motion_flag(
        "--accel-g RANGE", "The same in g; needs a block, instead of -A."
    ),
    freq_hz: str | None = options.motion_flag(
        "--freq-hz F", "One over the pulse's period in Hz; needs a block, instead of -W."
    ),
    phase: float | None = options.motion_flag(
        "--phase RAD", "nu of --pulse mavroeidis-papageorgiou \\[rad], default 0."
    ),
    resolution: float | None = options.motion_flag(
        "--resolution PART",
        "Largest step of the first amplitudes that are tried, as a part of them, default "
        "0.002, of a record 0.0005. In doubtful places it becomes much smaller by itself.",
    ),
    scales: str | None = options.motion_flag(
        "--scales LOW:HIGH",
        "Set the limits of the factor of --record or --records; default 0.1:10.",
    ),
    kick: bool = options.motion_flag(
        "--kick",
        "Find the least sudden change of the base velocity that overturns the block, from "
        "--start, on a still base or added to --record at --at-s.",
        default=False,
    ),
    start: str = options.start(),
    at_s: str | None = options.motion_flag(
        "--at-s T",
        "Set the time of the --kick \\[s]: a number or an axis, start:stop:count; default 0.",
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady overturn`; `HELP` is what its users read."""
    sweep.check(output, [*recorded.files, *(suite.files if suite.records else [])])
    conflicting: dict[str, object] = {
        "--pulse": pulse.pulse,
        "-A": amplitude,
        "-W": frequency_ratio,
        "--accel-g": accel_g,
    }
    conflicting |= {"--freq-hz": freq_hz, "--phase": phase}
    of_kicks = {"--start": None if start == "rest" else start, "--at-s": at_s}
    require(
        "overturn",
        {
            "block": block.given,
            "motion": kick or pulse.given or recorded.record or suite.records,
        },
        "--width-m 0.6 --height-m 2 --pulse one-sine --freq-hz 1",
        "--width-m 0.6 --height-m 2 --record example:near-fault",
    )
    if kick:
        _refuse("--kick", {**conflicting, "--scales": scales, "--resolution": resolution})
        search = _of_kicks(recorded, suite, reading, block, output, start, at_s, model)
    elif recorded.record or suite.records:
        _refuse("a search without --kick", of_kicks)
        level = {"--scale": recorded.scale, "--pga-g": recorded.pga_g}
        _refuse("--record", conflicting | level)
        search = _of_scales(recorded, suite, reading, block, scales, resolution, model)
    else:
        _refuse("a search without --kick", of_kicks)
        _refuse("a search without --record", {"--scales": scales})
        recorded.given(reading, pulse=pulse.given, on_floor=pulse.given)
        body = block.described()
        equations = equations_for(model, body)
        # The flags of the frequency are those of every shaking; its size is a range here.
        size = ShakingFlags(amplitude="1", frequency_ratio=frequency_ratio, freq_hz=freq_hz)
        ratios = sorted(set(size.of(body)[1]))
        unit = Harmonic(amplitude=1.0, frequency_ratio=ratios[0])
        shape = pulse.of(unit, phase=phase, reverse=recorded.reverse)
        floor = reading.of(body)
        from rocksteady.dynamics.overturning.windows import find_overturning_windows, lowest_of

        how: dict[str, Any] = {"model": equations, "floor": floor}
        within = _range(body, amplitude, accel_g, partial(lowest_of, body, shape, ratios, **how))
        if len(ratios) < 2:
            refuse(
                {"--plot": output.plot},
                "a spectrum is drawn over two frequencies or more",
                "give -W as an axis, as 0.5:8:200, or leave --plot out",
            )
        from rocksteady.show.figures.single import overturning_figure

        how |= {"within": within, "resolution": resolution}
        search = Search(
            find=partial(find_overturning_windows, body, shape, ratios, **how),
            words="searching frequencies",
            cells=len(ratios),
            figure=overturning_figure,
            flags={"within": "--amplitude/-A" if accel_g is None else "--accel-g"},
        )
    run = sweep.run(force=output.force)
    with (
        flags_of(search.flags, InputError),
        sweep.running(context, run, search.words, search.cells) as (shown, meter),
    ):
        result = search.find(run=shown)
    description = result.describe()
    typed = {**conflicting, **of_kicks, "--scales": scales, "--resolution": resolution}
    typed = {**typed, "--model": model, "--pulse": None}
    flags = [f"{name} {quoted(value)}" for name, value in typed.items() if value is not None]
    more = options.follow_up(
        "overturn" + " --kick" * kick, pulse, recorded, suite, reading, *flags, block, "--more"
    )
    if not kick and recorded.record and len(recorded.record) == 1:
        description = with_standing(result, description)
    output.write_csv(result.to_dataframe)
    sweep.write_netcdf(result.to_dataset)
    output.write_plot(lambda page: search.figure(result, description.headline, page))
    output.leave(
        "overturn",
        description,
        after={"seconds": meter.seconds, "store": run.place and str(run.place.path)},
        decided=not result.undecided.any(),
        wrap=True,
        follow_up=more,
        suite=search.suite,
    )


def with_standing(scales: "OverturningScales", description: "Description") -> "Description":
    """Return a description with the largest scale of a record at which no neighbour falls."""
    if not scales.governing[0] > 0.0:
        return description
    stands = line("stands at", partial(standing, scales))
    return replace(description, facts=[*description.facts[:2], stands, *description.facts[2:]])


def standing(scales: "OverturningScales") -> str:
    """Return the largest scale at which no neighbour falls either way, in words."""
    from rocksteady.dynamics.history.neighbours import check_neighbours
    from rocksteady.dynamics.history.simulate import simulate

    block, motion = scales.block, scales.motions[0]
    base = motion if isinstance(motion, BaseMotion) else BaseMotion(motion)
    scale = float(scales.governing[0])
    if scales.opposite_governs[0]:
        base = base.reversed()
    case = simulate(block, base.scaled(scale), model=scales.model)
    part = check_neighbours(case).stands_at
    if part is None:
        return ""
    pga = quantity(part * scale * float(scales.pga_g[0]), "g")
    return f"{part * scale:.2f} x ({pga}), where no neighbour falls"


def _refuse(what: str, idle: Mapping[str, object]) -> None:
    """Refuse flags that have no meaning beside another.

    Raises
    ------
    FlagError
        If one of them is given.
    """
    refuse(idle, f"it has no meaning for {what}")


def _of_scales(
    recorded: RecordFlags,
    suite: SuiteFlags,
    reading: ReadingFlags,
    block: BlockFlags,
    scales: str | None,
    resolution: float | None,
    model: str | None,
) -> Search:
    """Return the search of the scales of records."""
    from rocksteady.seismic.spectra.overturning_scales import find_overturning_scales
    from rocksteady.show.figures.single import fatal_figure

    body, motions, read = _motions(recorded, suite, reading, block)
    how: dict[str, Any] = {"model": equations_for(model, body)}
    how["within"] = None if scales is None else _two_ends("--scales", scales)
    return Search(
        find=partial(find_overturning_scales, body, motions, resolution=resolution, **how),
        words="searching records",
        cells=len(motions),
        figure=fatal_figure,
        flags={"within": "--scales"},
        suite=read,
    )


def _of_kicks(
    recorded: RecordFlags,
    suite: SuiteFlags,
    reading: ReadingFlags,
    block: BlockFlags,
    output: OutputFlags,
    start: str,
    at_s: str | None,
    model: str | None,
) -> Search:
    """Return the search of the kicks."""
    from rocksteady.cli.flags.start import state_from
    from rocksteady.dynamics.history.start import Rest
    from rocksteady.dynamics.overturning.kicks import find_fatal_kicks
    from rocksteady.show.figures.single import fatal_figure

    if suite.records:
        raise FlagError(
            "--records", suite.records[0], "a kick is added to one motion", "give --record FILE"
        )
    motion: BaseMotion | Still = Still()
    body: Block | DimensionlessBlock
    if recorded.given(reading):
        horizontal = recorded.recording(reading)
        vertical = recorded.vertical_recording(reading, horizontal)
        up = None if vertical is None else recorded.scaled(vertical.record)
        motion, body = BaseMotion(horizontal.record, up), recorded.block(block)
    else:
        body = block.described()
    times = [0.0] if at_s is None else axis("--at-s", at_s)
    if not all(0.0 <= time <= 1e4 for time in times):
        raise FlagError("--at-s", at_s, "moments lie in [0, 1e4] s", "give one of the record")
    rate = 1.0
    if isinstance(body, Block):
        rate = body.p
    elif at_s is not None:
        raise FlagError("--at-s", at_s, "seconds need a block with a p", "describe a block")
    if len(times) < 2:
        refuse(
            {"--plot": output.plot},
            "kicks are drawn over two moments or more",
            "give --at-s as an axis, as 0:20:81, or leave --plot out",
        )
    return Search(
        find=partial(
            find_fatal_kicks,
            body,
            start=Rest() if start == "rest" else state_from(start, None),
            motion=motion,
            times_pt=[time * rate for time in times],
            model=equations_for(model, body),
        ),
        words="searching kicks",
        cells=2 * len(times),
        figure=fatal_figure,
        flags={"times_pt": "--at-s"},
    )


def _motions(
    recorded: RecordFlags, suite: SuiteFlags, reading: ReadingFlags, block: BlockFlags
) -> "tuple[Block, list[Record | BaseMotion], Suite | None]":
    """Return the block, the motions of --record or --records, and the suite of the latter."""
    motions: list[Record | BaseMotion]
    read = None
    if suite.records:
        _refuse("--records", {"--record": recorded.record, "--vertical": recorded.vertical})
        body = block.described()
        if not isinstance(body, Block):
            raise missing("--width-m", valid="a record needs a block", hint="describe a block")
        read = suite.suite(reading)
        motions = read.motions
    else:
        _refuse("--record", {"--pair": suite.pair, "--include": suite.include})
        recorded.given(reading)
        body = recorded.block(block)
        recordings = recorded.recordings(reading)
        if recorded.vertical is not None and len(recordings) > 1:
            raise FlagError(
                "--vertical", recorded.vertical, "it belongs to one --record", "give one record"
            )
        motions = [recording.record for recording in recordings]
        vertical = recorded.vertical_recording(reading, recordings[0])
        if vertical is not None:
            motions = [BaseMotion(recordings[0].record, vertical.record)]
    motions = [motion.reversed() for motion in motions] if recorded.reverse else motions
    return body, motions, read


def _range(
    body: Block | DimensionlessBlock,
    amplitude: str | None,
    accel_g: str | None,
    lowest: Callable[[], float],
) -> tuple[float, float] | None:
    """Return the range of amplitudes that the flags name; None where they name none.

    Raises
    ------
    InputError, ModelError
        If both are given, a block is missing, or the text is no range.
    """
    if amplitude is not None and accel_g is not None:
        raise both("--amplitude/-A", "--accel-g", valid="at most one of the two is the range")
    if accel_g is None:
        return None if amplitude is None else _ends("--amplitude/-A", amplitude, lowest)
    if isinstance(body, DimensionlessBlock):
        raise FlagError(
            "--accel-g",
            accel_g,
            "g needs a block with a slenderness",
            "describe a block, or give -A",
        )
    unit = in_g(body.uplift_acceleration)
    low, high = _ends("--accel-g", accel_g, lambda: lowest() * unit)
    return low / unit, min(high / unit, LARGEST)


def _two_ends(flag: str, text: str) -> tuple[float, float]:
    """Return the ends of ``low:high``."""
    ends = [number(flag, part) for part in text.split(":")]
    if len(ends) != 2 or not 0.0 < ends[0] < ends[1]:
        raise InputError(flag, text, "it must be a range above 0", "write low:high, as 0.1:10")
    return ends[0], ends[1]


def _ends(flag: str, text: str, lowest: Callable[[], float]) -> tuple[float, float]:
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
    low, high = ends if len(ends) == 2 else (min(lowest(), ends[0]), ends[0])
    if not 0.0 <= low < high:
        first = lowest()
        raise InputError(
            flag,
            text,
            "the range must ascend from 0 or above",
            f"write it as {first:.4g}:{12 * first:.4g}",
        )
    return low, high
