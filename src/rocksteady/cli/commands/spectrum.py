"""`rocksteady spectrum`: rocking spectra of recorded ground motions."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from rocksteady.cli.console.outputs import (
    INCOMPLETE,
    announce_compilation,
    print_json,
    write_cells,
    write_figure,
    write_netcdf,
)
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import FlagError, both, missing
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import named_model, refuse_of_linear
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import axis, restitution_from
from rocksteady.cli.flags.record_files import ReadingFlags, RecordFlags
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.cli.present.spectrum_values import print_spectrum, spectrum_values, title_of
from rocksteady.errors import InputError
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record

if TYPE_CHECKING:
    from rocksteady.model.blocks.sides import Restitution

HELP = (
    "Rocking spectra: the largest rotation and angular velocity of homogeneous rectangular blocks "
    "on recorded ground, over their size 2 pi/p and their slenderness.\n\n"
    "Each block is at rest when the record begins, and is followed to rest or proven overturning "
    "by the full equations, or with --model linear in closed form. Of several records come median, "
    "16 and 84 % as well, and the share that overturns. Exit code 3 where a block is undecided."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady spectrum --record RSN77_PUL164.AT2 --alpha-deg 10:25:4 --periods-s 0.5:10:400 "
    "--plot spectrum.png\n\n"
    "rocksteady spectrum --record RSN77_PUL164.AT2 --alpha-rad 0.05:0.45:100 --periods-s "
    "0.5:10:200 --model nonlinear --plot map.png\n\n"
    "rocksteady spectrum --record one.AT2 --record two.AT2 --alpha-rad 0.2 --p-rad-s 2 --json"
)
DEFAULT_PERIODS = "0.5:10:100"
MOST_PANELS = 6

AlphaRad = Annotated[
    str | None,
    typer.Option(
        "--alpha-rad",
        metavar="AXIS",
        help="Slenderness \\[rad]: a number or an axis, start:stop:count or log:start:stop:count.",
        rich_help_panel=options.BLOCK,
    ),
]
AlphaDeg = Annotated[
    str | None,
    typer.Option(
        "--alpha-deg",
        metavar="AXIS",
        help="The same in degrees, instead of --alpha-rad.",
        rich_help_panel=options.BLOCK,
    ),
]
PeriodsS = Annotated[
    str | None,
    typer.Option(
        "--periods-s",
        metavar="AXIS",
        help=f"Size of the block as 2 pi/p \\[s]: a number or an axis; default {DEFAULT_PERIODS}.",
        rich_help_panel=options.BLOCK,
    ),
]
PRadS = Annotated[
    str | None,
    typer.Option(
        "--p-rad-s",
        metavar="AXIS",
        help="Size of the block as p = sqrt(3 g/(4 R)) \\[rad/s], instead of --periods-s.",
        rich_help_panel=options.BLOCK,
    ),
]
RestitutionFlag = Annotated[
    str | None,
    typer.Option(
        "--restitution",
        "-r",
        metavar="R",
        help="Ratio of angular velocities after and before an impact, in (0, 1], or 'housner' "
        "(default) for that of each slenderness.",
        rich_help_panel=options.BLOCK,
    ),
]


@grouped
def spectrum(
    context: typer.Context,
    recorded: RecordFlags,
    reading: ReadingFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    alpha_rad: AlphaRad = None,
    alpha_deg: AlphaDeg = None,
    periods_s: PeriodsS = None,
    p_rad_s: PRadS = None,
    restitution: RestitutionFlag = None,
    model: options.Model = None,
    gravity_m_s2: options.GravityMS2 = None,
    tolerance: options.Tolerance = None,
) -> None:
    """Run `rocksteady spectrum`; `HELP` is what its users read."""
    sweep.check(output)
    if not recorded.given(reading):
        raise missing(
            "--record",
            valid="a rocking spectrum needs a ground motion",
            hint="add --record FILE, several times for a suite",
        )
    equations = named_model("nonlinear" if model is None else model, tolerance)
    files = recorded.record or []
    output.refuse_read(recorded.files, netcdf=sweep.netcdf)
    if recorded.vertical is not None and len(files) > 1:
        raise FlagError(
            "--vertical",
            recorded.vertical,
            f"it belongs to one record, and there are {len(files)}",
            "give one --record, or a list of each to compute_rocking_spectrum in Python",
        )
    refuse_of_linear(model, "--vertical", recorded.vertical)
    slenderness = _slenderness(alpha_rad, alpha_deg)
    sizes = _sizes(periods_s, p_rad_s)
    count = len(next(iter(sizes.values())))
    if output.plot is not None:
        _check_drawable(len(files), len(slenderness), count)
    ratio = _restitution(restitution)
    run = sweep.run(force=output.force)
    across = recorded.recordings(reading)
    lifting = recorded.vertical_recording(reading, across[0])
    records: list[Record | BaseMotion] = [one.record for one in across]
    if lifting is not None:
        records = [BaseMotion(across[0].record, lifting.record)]

    announce_compilation("records.record_fates")
    from rocksteady.model.blocks.block import STANDARD_GRAVITY
    from rocksteady.seismic.spectra.rocking import compute_rocking_spectrum
    from rocksteady.seismic.spectra.suite import summarise_spectra

    with (
        sweep.resumable(context.find_root().obj),
        sweeping("following blocks", len(records) * len(slenderness) * count) as meter,
    ):
        found = compute_rocking_spectrum(
            records,
            alpha=slenderness,
            **sizes,
            restitution=ratio,
            model=equations,
            scale=1.0 if recorded.scale is None else recorded.scale,
            reverse=recorded.reverse,
            gravity=STANDARD_GRAVITY if gravity_m_s2 is None else gravity_m_s2,
            run=replace(run, progress=meter),
        )
    found = found.load()
    summary = summarise_spectra(found) if len(records) > 1 else None
    values = spectrum_values(found, summary, files)
    values |= {"seconds": meter.seconds, "store": run.place and str(run.place.path)}
    if lifting is not None:
        values["vertical_processing"] = list(lifting.processing)
    if output.csv is not None:
        write_cells(output.csv, found)
    if sweep.netcdf is not None:
        write_netcdf(sweep.netcdf, found)
    if output.plot is not None:
        from rocksteady.show.figures.spectra import spectrum_figure, suite_figure

        title = title_of(values)
        write_figure(
            output.plot,
            spectrum_figure(found, title, output.page)
            if summary is None
            else suite_figure(summary, title, output.page),
        )
    if output.as_json:
        print_json("spectrum", values)
    else:
        print_spectrum(values, found, summary, degrees=alpha_deg is not None)
    if values["counts"]["undecided"]:
        raise typer.Exit(INCOMPLETE)


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


def _sizes(periods_s: str | None, p_rad_s: str | None) -> dict[str, list[float]]:
    """Return the sizes of the blocks under the argument's name that they are given as.

    Raises
    ------
    InputError, ModelError
        If both are given, or one is no axis.
    """
    if p_rad_s is None:
        text = DEFAULT_PERIODS if periods_s is None else periods_s
        return {"periods_s": axis("--periods-s", text)}
    if periods_s is not None:
        raise both("--periods-s", "--p-rad-s", valid="one of the two is the size")
    return {"p": axis("--p-rad-s", p_rad_s)}


def _restitution(text: str | None) -> "Restitution":
    """Return the one restitution of all impacts.

    Raises
    ------
    InputError
        If it is no number, or two.
    """
    found = restitution_from(text, default="housner")
    if isinstance(found, tuple):
        raise InputError(
            "restitution",
            text,
            "both sides of a rectangle are alike",
            "give one number, or 'housner'",
        )
    return found


def _check_drawable(records: int, slendernesses: int, sizes: int) -> None:
    """Refuse, before anything is computed, a spectrum of which there is no picture.

    Raises
    ------
    ModelError
        If there is a single size, or a suite with too many slendernesses.
    """
    if sizes < 2:
        raise FlagError(
            finding="--plot with one value of --periods-s or --p-rad-s",
            valid="a spectrum is drawn over two sizes or more",
            hint="give --periods-s as an axis, or leave --plot out",
        )
    if records > 1 and slendernesses > MOST_PANELS:
        raise FlagError(
            finding=f"--plot with {slendernesses} values of --alpha-rad or --alpha-deg",
            valid=f"of a suite at most {MOST_PANELS} are drawn",
            hint="give fewer, or leave --plot out",
        )
