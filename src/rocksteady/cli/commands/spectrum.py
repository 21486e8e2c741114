"""`rocksteady spectrum`: rocking spectra of recorded ground motions."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

import typer

from rocksteady.cli.console.refusals import FlagError, both, missing, require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import named_model, refuse_of_linear
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import axis, restitution_from, values_of
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.housner_forms import Impacts, form_text
from rocksteady.model.checks.bounds import P
from rocksteady.model.motions.base_motion import BaseMotion

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from rocksteady.model.blocks.housner_forms import Restitution
    from rocksteady.model.motions.record import Record
    from rocksteady.records.core.recording import Recording
    from rocksteady.show.style.page import Page
    from rocksteady.sweep.cases.cells import Labelled

HELP = (
    "Find which sizes and slendernesses fall in a record.\n\n"
    "Rocking spectra: the largest rotation and angular velocity of homogeneous rectangular "
    "blocks on recorded ground, over their size 2 pi/p and their slenderness.\n\n"
    "Each block is at rest when the record begins, and is followed to rest or proven "
    "overturning by the full equations, or with --model linear in closed form. For several "
    "records the median, the 16 and 84 % quantiles and the share that overturns are added. With "
    "--one-sided the blocks stand against a wall; --reverse then gives another motion. Exit "
    "code 3 where a block is undecided."
)
MAIN = "record scale alpha_deg periods_s width_m height_m restitution plot csv out"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady spectrum --record example:near-fault --alpha-deg 10:25:4 --periods-s 0.5:10:400 "
    "--plot spectrum.png\n\n"
    "rocksteady spectrum --record example:near-fault --alpha-rad 0.05:0.45:100 --periods-s "
    "0.5:10:200 --plot map.png\n\n"
    "rocksteady spectrum --record example:near-fault --record example:soft-soil --alpha-rad 0.2 "
    "--p-rad-s 2 --json\n\n"
    "rocksteady spectrum --record example:near-fault --width-m 0.5 --height-m 1:3:5 --scale 0.2:1:5"
    "\n\nrocksteady spectrum --record example:near-fault --alpha-rad 0.1 --periods-s 2:10:80 "
    "--one-sided"
)
DEFAULT_PERIODS = "0.5:10:100"
MOST_PANELS = 6


@grouped
def spectrum(
    context: typer.Context,
    recorded: RecordFlags,
    reading: ReadingFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    alpha_rad: str | None = options.block_flag(
        "--alpha-rad AXIS",
        "Set the slenderness \\[rad]: a number or an axis, start:stop:count or log:start:...",
    ),
    alpha_deg: str | None = options.block_flag(
        "--alpha-deg AXIS", "Set the slenderness in degrees, instead of --alpha-rad."
    ),
    periods_s: str | None = options.block_flag(
        "--periods-s AXIS",
        f"Set the size of the block as 2 pi/p \\[s], an axis or values with commas; default "
        f"{DEFAULT_PERIODS}.",
    ),
    p_rad_s: str | None = options.block_flag(
        "--p-rad-s AXIS",
        "Set the size of the block as p = sqrt(3 g/(4 R)) \\[rad/s], instead of --periods-s.",
    ),
    width_m: str | None = options.block_flag(
        "--width-m AXIS",
        "Set the full width \\[m], with --height-m, instead of slenderness and period: a "
        "number or an axis.",
    ),
    height_m: str | None = options.block_flag(
        "--height-m AXIS", "Set the full height \\[m]: a number or an axis, each with every width."
    ),
    restitution: str | None = options.block_flag(
        "--restitution -r R",
        "Set the ratio of angular velocities after and before an impact, in (0, 1], 'housner' "
        "(default) for that of each slenderness, or 'housner*0.965' for a factor of it.",
    ),
    one_sided: bool | None = options.one_sided(),
    model: str | None = options.model(),
    gravity_m_s2: float | None = options.gravity_m_s2(),
    tolerance: float | None = options.tolerance(),
) -> None:
    """Run `rocksteady spectrum`; `HELP` is what its users read."""
    sweep.check(output, recorded.files)
    refuse_records(
        recorded, reading, model, (alpha_rad, alpha_deg, periods_s, p_rad_s, width_m, height_m)
    )
    equations = named_model("nonlinear" if model is None else model, tolerance)
    ratio = _restitution(restitution)
    gravity = STANDARD_GRAVITY if gravity_m_s2 is None else gravity_m_s2
    blocks: list[Block] = []
    slenderness: list[float] = []
    periods: list[float] = []
    if width_m is not None or height_m is not None:
        others = (alpha_rad, alpha_deg, periods_s, p_rad_s)
        blocks = [
            _with_impacts(block, ratio, one_sided=bool(one_sided))
            for block in _rectangles(width_m, height_m, others, gravity)
        ]
    else:
        slenderness = _slenderness(alpha_rad, alpha_deg)
        periods = _periods(periods_s, p_rad_s)
    if output.plot is not None:
        _check_drawable(recorded, len(slenderness), len(periods))
    run = sweep.run(force=output.force)
    motions, lifting = motions_of(recorded, reading)

    from rocksteady.seismic.spectra.many import cells_of_many
    from rocksteady.seismic.spectra.rocking import spectrum_cells
    from rocksteady.words.spectra import describe_spectrum

    count = len(blocks) or len(slenderness) * len(periods)
    motions_run = len(motions) * count * len(recorded.scales)
    with sweep.running(context, run, "following blocks", motions_run) as (shown, meter):
        scales = recorded.scales[0] if len(recorded.scales) == 1 else recorded.scales
        common: dict[str, Any] = {"model": equations, "scales": scales, "run": shown}
        if blocks:
            cells: Labelled = cells_of_many(blocks, motions, **common)
        else:
            sizes: dict[str, Any] = {"alpha": slenderness, "periods_s": periods}
            sizes |= {"restitution": ("wall", ratio) if one_sided else ratio, "gravity": gravity}
            cells = spectrum_cells(motions, **sizes, **common)
    cells = cells.load()
    cells.attrs["direction"] = "reversed" if recorded.reverse else "as recorded"
    described = describe_spectrum(cells)
    factor = Impacts.of(ratio).factor
    names = zip(cells["record"].values.tolist(), recorded.record or [], strict=True)
    values = {
        **described.to_dict(),
        "restitution": ratio if factor is None else form_text(factor),
        **({"one_sided": True} if one_sided else {}),
        "gravity_m_s2": gravity,
        "records": [{"name": name, "file": str(file)} for name, file in names],
        "pga_g": recorded.pga_g,
        "seconds": meter.seconds,
        "store": run.place and str(run.place.path),
        **({} if lifting is None else {"vertical_processing": list(lifting.processing)}),
    }
    write_files(cells, described.headline, output, sweep)
    kept = f", kept in {values['store']}" if values["store"] else ""
    note = f"{values['cells']:,} motions in {meter.seconds:.2f} s{kept}"
    answer = replace(described, notes=[*described.notes, note])
    typed = {
        "--alpha-rad": alpha_rad,
        "--alpha-deg": alpha_deg,
        "--periods-s": periods_s,
        "--p-rad-s": p_rad_s,
        "--width-m": width_m,
        "--height-m": height_m,
        "-r": restitution,
        "--model": model,
        "--gravity-m-s2": gravity_m_s2,
        "--tolerance": tolerance,
    }
    flags = [f"{flag} {value}" for flag, value in typed.items() if value is not None]
    flags += ["--one-sided"] if one_sided else []
    more = options.follow_up("spectrum", recorded, reading, *flags, "--more")
    decided = not values["counts"]["undecided"]
    output.leave("spectrum", answer, values=values, decided=decided, follow_up=more)


def refuse_records(
    recorded: RecordFlags, reading: ReadingFlags, model: str | None, sizes: Sequence[str | None]
) -> None:
    """Refuse a spectrum without blocks or records, and records that do not go together.

    Raises
    ------
    ModelError
        If there is none, a vertical one beside several, or one in the linear model.
    """
    require(
        "spectrum",
        {"block": any(sizes), "motion": recorded.given(reading)},
        "--width-m 0.6 --height-m 2 --record example:near-fault",
        "--alpha-deg 10:25:4 --record example:near-fault",
    )
    count = len(recorded.record or [])
    if recorded.vertical is not None and count > 1:
        raise FlagError(
            "--vertical",
            recorded.vertical,
            f"it belongs to one record, and there are {count}",
            "give one --record, or a list of BaseMotion to compute_rocking_spectrum in Python",
        )
    refuse_of_linear(model, "--vertical", recorded.vertical)


def motions_of(
    recorded: RecordFlags, reading: ReadingFlags
) -> "tuple[list[Record | BaseMotion], Recording | None]":
    """Return the ground motions without --scale, and the vertical channel where there is one."""
    across = [recorded.at_pga(each) for each in recorded.recordings(reading)]
    lifting = recorded.vertical_recording(reading, across[0])
    records = [each.record.reversed() if recorded.reverse else each.record for each in across]
    if lifting is None:
        return [*records], None
    return [BaseMotion(records[0], lifting.record)], lifting


def write_files(cells: "Labelled", title: str, output: OutputFlags, sweep: SweepFlags) -> None:
    """Write the files that the flags name."""
    from rocksteady.sweep.cases.labelled import as_dataset

    def figure(page: "Page") -> "Figure":
        from rocksteady.seismic.spectra.suite import compute_suite_spectrum
        from rocksteady.show.figures.spectra import spectrum_figure, suite_figure

        dataset = as_dataset(cells)
        if dataset.sizes["record"] > 1:
            return suite_figure(compute_suite_spectrum(dataset), title, page)
        return spectrum_figure(dataset, title, page)

    output.write_cells(lambda: as_dataset(cells))
    sweep.write_netcdf(lambda: as_dataset(cells))
    output.write_plot(figure)


def _rectangles(
    width_m: str | None,
    height_m: str | None,
    others: Sequence[str | None],
    gravity: float,
) -> list[Block]:
    """Return blocks of --width-m and --height-m without loss, every width with every height.

    Raises
    ------
    InputError, ModelError
        If one is missing, no axis or not positive, or a slenderness or a size is given too.
    """
    if width_m is None or height_m is None:
        raise missing(
            "--width-m" if width_m is None else "--height-m",
            valid="a size is a width and a height",
            hint="give both, each a number or an axis",
        )
    if any(value is not None for value in others):
        raise both(
            "--width-m",
            "a slenderness or a period",
            valid="blocks are given by their sizes, or by slenderness and period",
        )
    return [
        Block.rectangle(width=width, height=height, restitution=1.0, gravity=gravity)
        for width in axis("--width-m", width_m)
        for height in axis("--height-m", height_m)
    ]


def _with_impacts(block: Block, ratio: "Restitution", *, one_sided: bool) -> Block:
    """Return a block with the restitution of its impacts, or against a wall with that of it."""
    return block.against_wall(ratio) if one_sided else block.with_restitution(ratio)


def _slenderness(alpha_rad: str | None, alpha_deg: str | None) -> list[float]:
    """Return the slendernesses [rad].

    Raises
    ------
    InputError, ModelError
        If none or both are given, or one is no axis.
    """
    if alpha_rad is not None and alpha_deg is not None:
        raise both("--alpha-rad", "--alpha-deg", valid="one of the two is the slenderness")
    if alpha_deg is not None:
        return [math.radians(value) for value in axis("--alpha-deg", alpha_deg)]
    if alpha_rad is None:
        raise missing(
            "--alpha-rad",
            valid="a spectrum is of a slenderness, or of several",
            hint="add --alpha-rad 0.2, or --alpha-deg 10:25:4",
        )
    return axis("--alpha-rad", alpha_rad)


def _periods(periods_s: str | None, p_rad_s: str | None) -> list[float]:
    """Return the sizes of the blocks as periods 2 pi/p [s].

    Raises
    ------
    InputError, ModelError
        If both are given, or one is no axis or not positive.
    """
    if p_rad_s is None:
        return values_of("--periods-s", DEFAULT_PERIODS if periods_s is None else periods_s)
    if periods_s is not None:
        raise both("--periods-s", "--p-rad-s", valid="one of the two is the size")
    return [2.0 * math.pi / P("p", value) for value in axis("--p-rad-s", p_rad_s)]


def _restitution(text: str | None) -> "Restitution":
    """Return the one restitution of all impacts.

    Raises
    ------
    InputError
        If it is no number, or two.
    """
    restitution = restitution_from(text, default="housner")
    if Impacts.of(restitution).pair is not None:
        raise InputError(
            "restitution",
            text,
            "both sides of a rectangle are alike",
            "give one number, 'housner' or 'housner*0.965'",
        )
    return cast("Restitution", restitution)


def _check_drawable(recorded: RecordFlags, slendernesses: int, sizes: int) -> None:
    """Refuse, before anything is computed, a spectrum of which there is no picture.

    Raises
    ------
    ModelError
        If there is a single size, several scales, or a suite with too many slendernesses.
    """
    if slendernesses == 0 or len(recorded.scales) > 1:
        what = "several values of --scale" if slendernesses else "--width-m and --height-m"
        raise FlagError(
            finding=f"--plot with {what}",
            valid="a spectrum is drawn over --periods-s at one scale",
            hint="give --alpha-deg and --periods-s, or take --csv",
        )
    if sizes < 2:
        raise FlagError(
            finding="--plot with one value of --periods-s or --p-rad-s",
            valid="a spectrum is drawn over two sizes or more",
            hint="give --periods-s as an axis, or leave --plot out",
        )
    if len(recorded.record or []) > 1 and slendernesses > MOST_PANELS:
        raise FlagError(
            finding=f"--plot with {slendernesses} values of --alpha-rad or --alpha-deg",
            valid=f"of a suite at most {MOST_PANELS} are drawn",
            hint="give fewer, or leave --plot out",
        )
