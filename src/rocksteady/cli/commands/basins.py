"""`rocksteady basins`: basins of attraction, and erosion of the safe basin with amplitude."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from rocksteady.cli.console import terminal
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
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.rendering import print_description

if TYPE_CHECKING:
    from rocksteady.dynamics.basins.basins import Basins
    from rocksteady.dynamics.basins.erosion import Erosion

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
        "either side, beyond which a block falls at once; of an axis of amplitudes up to 1.5.  "
        "With --one-sided from 0 on.",
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
    motion = Harmonic(amplitude=amplitudes[0], frequency_ratio=ratio, phase=phase)
    chosen: dict[str, Any] = {
        name: axis(name, text)
        for name, text in (("angles", angles), ("velocities", velocities))
        if text is not None
    }
    chosen["model"] = equations
    eroding = len(amplitudes) > 1
    if cycles is not None:
        chosen["cycles" if eroding else "max_cycles"] = cycles
    kernel = "driver.lane_fates" if body.symmetric else "harmonic.fates_of_sides"
    if equations.name == "nonlinear":
        kernel = "loop.nonlinear_lane_fates"
    announce_compilation(kernel if eroding else "attractors.settle_cells")
    from rocksteady.dynamics.basins.basins import compute_basins
    from rocksteady.dynamics.basins.erosion import compute_erosion
    from rocksteady.dynamics.basins.window import POINTS
    from rocksteady.sweep.run import Run

    states = len(chosen.get("angles", range(POINTS))) * len(chosen.get("velocities", range(POINTS)))
    if eroding:
        states *= len(amplitudes) + (amplitudes[0] != 0.0)
    with sweeping("following states", states) as meter:
        run = Run(progress=meter)
        if eroding:
            _leave_erosion(compute_erosion(body, motion, amplitudes, **chosen, run=run), output)
        else:
            _leave_basins(compute_basins(body, motion, **chosen, seed=seed, run=run), output)


def _leave_basins(found: "Basins", output: OutputFlags) -> None:
    """Leave behind what was asked for of basins."""
    description = found.describe()
    if output.csv is not None:
        frame = found.to_dataframe()
        write_csv(output.csv, list(frame), frame.itertuples(index=False, name=None))
    if output.plot is not None:
        from rocksteady.show.figures.single import basins_figure

        write_figure(output.plot, basins_figure(found, description.headline, output.page))
    if output.as_json:
        print_json("basins", description.to_dict())
    else:
        print_description(description, terminal.console(wrap=True))
    if found.undecided > FEW:
        raise typer.Exit(INCOMPLETE)


def _leave_erosion(found: "Erosion", output: OutputFlags) -> None:
    """Leave behind what was asked for of an erosion."""
    description = found.describe()
    if output.csv is not None:
        table = description.tables[0]
        write_csv(output.csv, table.header, table.records())
    if output.plot is not None:
        from rocksteady.show.figures.single import erosion_figure

        drops = [drop for drop in found.drops.values() if drop is not None]
        write_figure(output.plot, erosion_figure(found, drops, description.headline, output.page))
    if output.as_json:
        print_json("basins", description.to_dict())
    else:
        print_description(description, terminal.console(wrap=True))
