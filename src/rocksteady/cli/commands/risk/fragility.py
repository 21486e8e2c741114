"""`rocksteady fragility`: from records and a block to fragility curves."""

from dataclasses import replace
from typing import TYPE_CHECKING

import typer

from rocksteady.cli.console.outputs import again
from rocksteady.cli.console.refusals import both, flags_of, needs, refuse, require
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.demand import DesignFlags
from rocksteady.cli.flags.ensemble import EnsembleFlags, Suite, SuiteFlags, ensemble_flag
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.options import Panel, block_flag
from rocksteady.cli.flags.record_files import ReadingFlags
from rocksteady.cli.flags.sweep import SweepFlags
from rocksteady.model.blocks.block import Block
from rocksteady.results.stated import facts_stated

if TYPE_CHECKING:
    from rocksteady.risk.ensemble.levels import Levels

HELP = (
    "Count how often a block falls, level by level.\n\n"
    "Fragility: the share of the runs in which a block lifts, tilts beyond a part of alpha, or "
    "overturns, over the intensity of the ground motion.\n\n"
    "Every record is scaled to every level and run for a band of restitutions by the full "
    "equations, in both directions where they differ; every share is a count, with its 90 % "
    "interval. Median and beta are a summary of the counts. With --spectrum records are placed on "
    "a design spectrum first: levels are multiples of it. --out keeps the runs and --resume "
    "continues them. Fewer than 11 records give no answer: exit code 3."
)
MAIN = "width_m height_m restitution records measure levels friction out plot example"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady fragility --width-m 0.32 --height-m 1.8 --example --plot fragility.png\n\n"
    "rocksteady fragility --width-m 0.6 --height-m 1.8 --records suite --measure pga_g "
    "--levels 0.2:2:10 --restitution 0.85:0.95 --draws 5 --json\n\n"
    "rocksteady fragility --alpha-rad 0.2 --p-rad-s 2 --records suite --measure sa_avg_g:1.5 "
    "--states uplift,0.5,overturned --friction 0.5 --csv runs.csv\n\n"
    "Your folder of records: suite."
)
STORED = ("--out", "--chunk", "--netcdf")
"""Flags of what is written once."""
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
    designs: DesignFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    friction: float | None = block_flag(
        "--friction MU",
        "Set the coefficient of friction between block and base: levels end where it slides; "
        "without, its need is shown.",
    ),
    states: str = curve_flag(
        "--states LIST",
        "Set the damage states: uplift, overturned, or a theta/alpha that is exceeded.",
        default="uplift,0.25,0.5,1,overturned",
    ),
    example: bool = ensemble_flag(
        "--example",
        f"Run {EXAMPLE_MOTIONS} synthetic motions in place of --records; default block: a cabinet "
        f"of {EXAMPLE_SIZE[0]} x {EXAMPLE_SIZE[1]} m.",
        default=False,
    ),
) -> None:
    """Run `rocksteady fragility`; `HELP` is what its users read."""
    from rocksteady.model.checks.bounds import FRICTION
    from rocksteady.risk.counted.suite import Suite as Motions
    from rocksteady.risk.counted.verdict import LEAST
    from rocksteady.risk.fragility.compute_fragility import damage_states, plan_fragility
    from rocksteady.words.placing import doubt_on_spectrum, spectrum_line, spectrum_remark

    sweep.check(output)
    needs("--damping", designs.damping, "--spectrum", "FILE", beside=designs.spectrum)
    require(
        "fragility",
        {"block": block.given or example, "suite of motions": recorded.records or example},
        "--example",
        "--width-m 0.6 --height-m 2 --example",
    )
    width, height = EXAMPLE_SIZE
    default = Block.rectangle(width=width, height=height) if example else None
    body, band = ensemble.block_and_band(block, default)
    levels = _levels(ensemble, designs)
    with flags_of(dict.fromkeys(("peak", "name", "states"), "--states")):
        asked = damage_states([part.strip() for part in states.split(",")])
    if friction is not None:
        FRICTION("--friction", friction)
    run = sweep.run(force=output.force)
    ground = reading if designs.spectrum is None else reading.on_ground
    suite = _suite(recorded, ground, example=example)
    sweep.check(output, [*suite.read, *designs.file])
    placed = None
    if (design := designs.design(None)) is not None:
        placed = Motions(motions=suite.motions).at(design, floor=reading.floor)
        suite = replace(suite, motions=[*placed.motions])
    placing = None if placed is None else placed.placing
    planned = plan_fragility(
        body,
        suite.motions,
        levels=levels,
        restitution=band,
        ways=ensemble.ways,
        friction=friction,
    )
    with sweep.running(context, run, "running blocks", planned.cells) as (shown, _):
        result = planned.count(asked, mass_kg=ensemble.mass_kg, run=shown)
    description = result.describe()
    names = result.ensemble["record"].values
    files = {id(motion): file for motion, file in zip(suite.motions, suite.files, strict=False)}
    after = {
        "block": body.describe().to_dict(),
        "synthetic": example,
        "spectrum": placing and placing.values,
        "files": [
            {"name": str(name), "file": str(files[id(motion)])}
            for name, motion in zip(names, planned.motions, strict=True)
            if id(motion) in files
        ],
        "store": run.place and str(run.place.path),
    }
    headline = description.headline + (" On synthetic motions, no earthquake's." if example else "")
    output.write_cells(lambda: result.ensemble)
    sweep.write_netcdf(lambda: result.ensemble)
    if output.plot is not None:
        from rocksteady.show.figures.risk import fragility_figure

        output.write_plot(lambda page: fragility_figure(result, headline, page))
    kept = f", kept in {after['store']}" if after["store"] else ""
    remarks = [] if placing is None else [placing.spectrum.remark, spectrum_remark(placing)]
    notes = [
        *description.notes,
        *filter(None, remarks),
        f"{result.runs:,} runs in {result.seconds:.1f} s{kept}",
    ]
    facts = [*description.facts]
    if placing is not None:
        facts = [*facts_stated([spectrum_line(placing, doubt_on_spectrum(placing))]), *facts]
    output.leave(
        "fragility",
        replace(description, headline=headline, facts=facts, notes=notes),
        after=after,
        suite=suite,
        decided=result.records >= LEAST,
        follow_up="" if output.plot else again(context, "--plot fragility.png", but=STORED),
    )


def _levels(ensemble: EnsembleFlags, designs: DesignFlags) -> "Levels":
    """Return the levels; of motions on a spectrum those of the PGA, which all share.

    Raises
    ------
    InputError, FlagError
        As for `EnsembleFlags.levels_asked`, and if they are of another measure.
    """
    if designs.spectrum is None or ensemble.scale is not None:
        return ensemble.levels_asked()
    if ensemble.measure not in (None, "pga_g"):
        raise both("--spectrum", "--measure", valid="motions on a spectrum share their PGA alone")
    return replace(ensemble, measure="pga_g").levels_asked()


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
