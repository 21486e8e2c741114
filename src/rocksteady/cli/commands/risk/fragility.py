"""`rocksteady fragility`: from records and a block to fragility curves."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import typer

from rocksteady.cli.console.outputs import again
from rocksteady.cli.console.refusals import flags_of, refuse, require
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.ensemble import EnsembleFlags, Suite, SuiteFlags, ensemble_flag
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.options import Panel
from rocksteady.cli.flags.record_files import ReadingFlags
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.base_motion import BaseMotion

if TYPE_CHECKING:
    from rocksteady.risk.fragility.fitting import FitOptions

HELP = (
    "Compute the fragility of a block from a suite of records.\n\n"
    "Fragility: the probability that a block lifts, tilts beyond a part of alpha, or overturns, "
    "over the intensity of the ground motion.\n\n"
    "Every record is scaled to every level, run as it is and reversed, for a band of "
    "restitutions, by the full equations; curves are fitted by maximum likelihood, with bands "
    "by a bootstrap of records. Where blocks stand without lifting the curves have two stages, "
    "uplift and failure given uplift. --out keeps the runs and --resume continues them."
)
MAIN = "width_m height_m restitution records measure levels states out plot example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady fragility --width-m 0.32 --height-m 1.8 --example --plot fragility.png\n\n"
    "rocksteady fragility --width-m 0.6 --height-m 1.8 --records suite --measure pga_g "
    "--levels 0.2:2:10 --restitution 0.85:0.95 --draws 5 --json\n\n"
    "rocksteady fragility --alpha-rad 0.2 --p-rad-s 2 --records suite --measure sa_avg_g:1.5 "
    "--states uplift,0.5,overturned --csv runs.csv\n\n"
    "Your folder of records: suite."
)
curve_flag = Panel("Curves")
EXAMPLE_MOTIONS = 24
EXAMPLE_SIZE = (0.32, 1.8)
"""Width and height of the cabinet of --example [m]."""


@grouped
def fragility(
    context: typer.Context,
    block: BlockFlags,
    recorded: SuiteFlags,
    reading: ReadingFlags,
    ensemble: EnsembleFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    states: str = curve_flag(
        "--states LIST",
        "Set the damage states: uplift, overturned, or a theta/alpha that is exceeded.",
        default="uplift,0.25,0.5,1,overturned",
    ),
    family: str = curve_flag(
        "--family NAME", "Set the curve: lognormal or logistic.", default="lognormal"
    ),
    confidence: float = curve_flag(
        "--confidence P", "Set the confidence of the bands.", default=0.9
    ),
    replicates: int = curve_flag(
        "--replicates N",
        "Set the number of suites that the bands are drawn from; 0 for no bands.",
        default=1000,
    ),
    example: bool = ensemble_flag(
        "--example",
        f"Run {EXAMPLE_MOTIONS} synthetic motions in place of --records; default block: a cabinet "
        f"of {EXAMPLE_SIZE[0]} x {EXAMPLE_SIZE[1]} m.",
        default=False,
    ),
) -> None:
    """Run `rocksteady fragility`; `HELP` is what its users read."""
    sweep.check(output)
    require(
        "fragility",
        {"block": block.given or example, "suite of motions": recorded.records or example},
        "--example",
        "--width-m 0.6 --height-m 2 --example",
    )
    width, height = EXAMPLE_SIZE
    default = Block.rectangle(width=width, height=height) if example else None
    body, band = ensemble.block_and_band(block, default)
    levels = ensemble.levels_asked()
    fitting = _fitting(states, family, confidence, replicates, ensemble.seed)
    run = sweep.run(force=output.force)
    suite = _suite(recorded, reading, example=example)
    sweep.check(output, suite.read)

    from rocksteady.risk.fragility.fit_fragility import compute_fragility

    lifts = sum(
        isinstance(motion, BaseMotion) and motion.vertical is not None for motion in suite.motions
    )
    ways = (len(suite.motions) + lifts) * (1 if body.symmetric or ensemble.no_reverse else 2)
    cells = ways * len(levels.levels_for([body])) * band.draws
    with sweep.running(context, run, "running blocks", cells) as (shown, _):
        fragility_found = compute_fragility(
            body,
            suite.motions,
            levels=levels,
            restitution=band,
            ways=ensemble.ways,
            mass_kg=ensemble.mass_kg,
            fitting=fitting,
            run=shown,
        )
    description = fragility_found.describe()
    after = {
        "block": body.describe().to_dict(),
        "synthetic": example,
        "files": [
            {"name": str(name), "file": str(file)}
            for name, file in zip(
                fragility_found.ensemble["record"].values, suite.files, strict=False
            )
        ],
        "store": run.place and str(run.place.path),
    }
    headline = description.headline + (" of synthetic motions, no earthquake's" if example else "")
    output.write_cells(lambda: fragility_found.ensemble)
    sweep.write_netcdf(lambda: fragility_found.ensemble)
    if output.plot is not None:
        from rocksteady.show.figures.risk import fragility_figure

        output.write_plot(lambda page: fragility_figure(fragility_found, None, headline, page))
    kept = f", kept in {after['store']}" if after["store"] else ""
    notes = [
        *description.notes,
        f"{fragility_found.runs:,} runs and all fits in {fragility_found.seconds:.1f} s{kept}",
    ]
    output.leave(
        "fragility",
        replace(description, headline=headline, notes=notes),
        after=after,
        suite=suite,
        follow_up="" if output.plot else again(context, "--plot fragility.png", but=("--out",)),
    )


def _suite(recorded: SuiteFlags, reading: ReadingFlags, *, example: bool) -> Suite:
    """Return the ground motions: those of the files, or synthetic ones.

    Raises
    ------
    InputError, FlagError
        If no file can be read, or files are given with --example.
    """
    if not example:
        return recorded.suite(reading)
    valid = "--example has synthetic motions and reads no file"
    refuse({**reading.given, **recorded.given}, valid, "leave one out")
    return Suite.synthetic(EXAMPLE_MOTIONS)


def _fitting(
    states: str, family: str, confidence: float, replicates: int, seed: int
) -> "FitOptions":
    """Return the options of the fits, whose errors name the flags.

    Raises
    ------
    FlagError
        If one is not valid.
    """
    from rocksteady.risk.fits.bands import BandOptions
    from rocksteady.risk.fragility.fitting import FitOptions

    flags = {name: f"--{name}" for name in ("confidence", "replicates", "seed", "family")}
    with flags_of({"peak": "--states", "name": "--states", "states": "--states", **flags}):
        bands = BandOptions(confidence=confidence, replicates=replicates, seed=seed)
        named: Any = family
        parts = [part.strip() for part in states.split(",")]
        return FitOptions(states=parts, family=named, bands=bands)
