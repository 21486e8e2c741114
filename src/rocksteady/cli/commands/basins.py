"""`rocksteady basins`: basins of attraction, and erosion of the safe basin with amplitude."""

from typing import Annotated, Any

import typer

from rocksteady.cli.console.outputs import (
    INCOMPLETE,
    announce_compilation,
    print_json,
    write_csv,
    write_figure,
)
from rocksteady.cli.console.progress import sweeping
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.parsing import axis, single
from rocksteady.cli.present.basins_text import case_of, print_erosion, print_fractions
from rocksteady.cli.present.basins_values import (
    basins_values,
    erosion_values,
    state_rows,
    undecided,
)
from rocksteady.cli.present.shared import case_text
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.motions.segments import Harmonic

HELP = (
    "Where the block goes from each state of a window: basins of attraction and their shares.\n\n"
    "With an axis of amplitudes (-A 0:1:21) it computes instead how the safe basin, the states "
    "from which the block does not overturn, erodes as the amplitude grows. Exit code 3 where "
    "more than 1 state in 1000 is undecided."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady basins -A 0.5 -W 2 -r 0.95 --plot basins.png\n\n"
    "rocksteady basins -A 1.5 -W 4 -r 0.9 --angles=-1:1:400 --velocities=-1.2:1.2:400 --json\n\n"
    "rocksteady basins -A 0:1.6:33 -W 2 -r 0.9 --plot erosion.png\n\n"
    "rocksteady basins --alpha-rad 0.3 --radius-m 1 -r 0.9 -A 1.5 -W 4 --model nonlinear "
    "--angles=-1.4:1.4:60 --velocities=-1.6:1.6:60"
)

WINDOW = "Window"
FEW = 1e-3
"""Share of undecided states that is no failure: a window may meet states that balance for ever."""

PhaseFlag = Annotated[
    float,
    typer.Option(
        "--phase",
        metavar="RAD",
        help="Phase of the shaking at which the states are taken \\[rad].",
        rich_help_panel=WINDOW,
    ),
]
AnglesFlag = Annotated[
    str | None,
    typer.Option(
        "--angles",
        metavar="AXIS",
        help="u = theta/alpha, start:stop:count; by default 200 up to 1 + A/sqrt(1 + W^2) on "
        "either side, beyond which a block falls at once; of an axis of amplitudes up to 1.5.",
        rich_help_panel=WINDOW,
    ),
]
VelocitiesFlag = Annotated[
    str | None,
    typer.Option(
        "--velocities",
        metavar="AXIS",
        help="du/d(pt), start:stop:count; by default 200 up to the same bound.",
        rich_help_panel=WINDOW,
    ),
]
CyclesFlag = Annotated[
    int | None,
    typer.Option(
        "--cycles",
        metavar="N",
        help="Periods of the shaking for which a state is followed, default 500; with an axis of "
        "amplitudes those that a safe state stands, default 100.",
        rich_help_panel=options.START,
    ),
]
SeedFlag = Annotated[
    int | None,
    typer.Option(
        "--seed",
        metavar="N",
        help="Draw a state in each cell of the window, instead of its middle.",
        rich_help_panel=WINDOW,
    ),
]


@grouped
def basins(
    shaking: ShakingFlags,
    block: BlockFlags,
    output: OutputFlags,
    phase: PhaseFlag = 0.0,
    angles: AnglesFlag = None,
    velocities: VelocitiesFlag = None,
    seed: SeedFlag = None,
    cycles: CyclesFlag = None,
    model: options.Model = "linear",
) -> None:
    """Run `rocksteady basins`; `HELP` is what its users read."""
    output.check()
    body = block.described()
    equations = equations_for(model, body)
    amplitudes, ratios = shaking.of(body)
    ratio = single("frequency_ratio", ratios)
    if seed is not None and len(amplitudes) > 1:
        raise FlagError(
            "seed",
            seed,
            "safe basins are computed at the points of a grid",
            "leave it out, or give one amplitude",
        )
    first = Harmonic(amplitude=amplitudes[0], frequency_ratio=ratio, phase=phase)
    chosen: dict[str, Any] = {
        name: axis(name, text)
        for name, text in (("angles", angles), ("velocities", velocities))
        if text is not None
    }
    chosen["model"] = equations
    if cycles is not None:
        chosen["cycles"] = cycles

    if len(amplitudes) > 1:
        in_lanes = equations.name == "linear" and body.symmetric
        announce_compilation("driver.lane_fates" if in_lanes else "harmonic.fates_of_sides")
        _erosion(body, first, amplitudes, chosen, output)
    else:
        announce_compilation("attractors.settle_cells")
        _basins(body, first, {**chosen, "seed": seed}, output)


def _basins(
    body: Block | DimensionlessBlock,
    shaking: Harmonic,
    chosen: dict[str, Any],
    output: OutputFlags,
) -> None:
    """Compute the basins at one amplitude, and leave behind what was asked for."""
    from rocksteady.dynamics.basins.basins import compute_basins as computed
    from rocksteady.dynamics.basins.window import POINTS
    from rocksteady.sweep.run import Run

    states = len(chosen.get("angles", range(POINTS))) * len(chosen.get("velocities", range(POINTS)))
    with sweeping("following states", states) as meter:
        found = computed(body, shaking, **chosen, run=Run(progress=meter))
    values = basins_values(found, body)
    if output.csv is not None:
        write_csv(output.csv, ("angle", "velocity", "label", "attractor"), state_rows(found))
    if output.plot is not None:
        from rocksteady.show.figures.single import basins_figure

        title = f"Basins at phase {found.shaking.phase:.4g} rad: {case_text(values)}"
        write_figure(output.plot, basins_figure(found, title, output.page))
    if output.as_json:
        print_json("basins", values)
    else:
        print_fractions(values)
    if undecided(values) > FEW:
        raise typer.Exit(INCOMPLETE)


def _erosion(
    body: Block | DimensionlessBlock,
    shaking: Harmonic,
    amplitudes: list[float],
    chosen: dict[str, Any],
    output: OutputFlags,
) -> None:
    """Compute the erosion over an axis of amplitudes, and leave behind what was asked for."""
    from rocksteady.dynamics.basins.erosion import MEASURES, compute_erosion
    from rocksteady.dynamics.basins.window import POINTS
    from rocksteady.sweep.run import Run

    window = len(chosen.get("angles", range(POINTS))) * len(chosen.get("velocities", range(POINTS)))
    states = window * (len(amplitudes) + (amplitudes[0] != 0.0))
    with sweeping("following states", states) as meter:
        found = compute_erosion(
            body,
            shaking.frequency_ratio,
            amplitudes,
            phase=shaking.phase,
            **chosen,
            run=Run(progress=meter),
        )
    drops = {measure: found.drop(measure) for measure in MEASURES}
    values = erosion_values(found, drops, body)
    if output.csv is not None:
        rows = values["erosion"]
        write_csv(output.csv, list(rows[0]), [list(row.values()) for row in rows])
    if output.plot is not None:
        from rocksteady.show.figures.single import erosion_figure

        title = f"Erosion of the safe basin at phase {found.phase:.4g} rad: {case_of(values)}"
        there = [drop for drop in drops.values() if drop is not None]
        write_figure(output.plot, erosion_figure(found, there, title, output.page))
    if output.as_json:
        print_json("basins", values)
    else:
        print_erosion(values)
