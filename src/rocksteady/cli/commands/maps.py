"""`rocksteady map`: attractor or fate of a block in every cell of a grid."""

from dataclasses import replace
from typing import TYPE_CHECKING

import typer

from rocksteady.cli.console.progress import Meter
from rocksteady.cli.console.refusals import needs, refuse, require
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.map_axes import FREQUENCY, RESIZED, MapCase, MapStartFlags, map_case
from rocksteady.cli.flags.range import SeriesFlags
from rocksteady.cli.flags.record_files import FloorFlags
from rocksteady.cli.flags.sweep import SweepFlags, sweep_flag
from rocksteady.errors import InputError

if TYPE_CHECKING:
    from rocksteady.show.plots.map_quantities import Colouring

HELP = (
    "Find the outcome in every cell of a grid.\n\n"
    "Attractor or fate of the block in every cell of a grid.\n\n"
    "Any flags of shaking, block and start may be axes, start:stop:count: two make a map, one a "
    "bifurcation diagram. With --fate each motion is followed for --cycles periods only, to see "
    "whether the block falls. With --out (extra stores) the cells are kept on disk as they are "
    "finished, and --resume continues after whatever ended the run. Exit code 3 where more than "
    "1 cell in 1000 is undecided."
)
MAIN = "amplitude frequency_ratio restitution width_m height_m start fate cycles out plot"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady map -A 0.1:6:150 -W 0.2:8:200 -r 0.8 --plot map.png\n\n"
    "rocksteady map -A 0.1:6:150 -W 0.2:8:200 -r 0.8 --plot periods.png --by period\n\n"
    "rocksteady map -A 0.1:6:150 -W 0.2:8:200 -r 0.8 --out map.zarr --resume\n\n"
    "rocksteady map -A 1:6:1000 -W 1:12:1000 -r 0.8 --start 0,0.3 --fate --plot fates.png\n\n"
    "rocksteady map --width-m 0.3:0.9:50 --height-m 1:3:50 --accel-g 0.4 --freq-hz 2 --json\n\n"
    "rocksteady map -A 2 -W 1.5:4:500 -r 0.8 --plot diagram.png"
)


@grouped
def maps(
    context: typer.Context,
    shaking: ShakingFlags,
    series: SeriesFlags,
    floor: FloorFlags,
    block: BlockFlags,
    start: MapStartFlags,
    sweep: SweepFlags,
    output: OutputFlags,
    fate: bool = options.start_flag(
        "--fate",
        "Compute whether the block still rocks, rests or has fallen after --cycles periods, "
        "instead of its attractor.",
        default=False,
    ),
    cycles: int | None = options.start_flag(
        "--cycles N",
        "Periods of the shaking after which a motion counts as aperiodic or undecided, 2000 "
        "by default; with --fate the largest number of them, 200 by default.",
    ),
    refine: int | None = sweep_flag(
        "--refine N",
        "Compute every Nth cell along each axis (8 is usual), and of the others only those "
        "near a border of kinds: three to five times as fast, and 1 or 2 cells in 1000 differ. "
        "Not with --out.",
    ),
    by: str | None = options.output_flag(
        "--by NAME",
        "Colour the cells of --plot by class (default), period, lyapunov (exponent per "
        "forcing period) or peak (of the angle over alpha); with --fate by class alone.",
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady map`; `HELP` is what its users read."""
    sweep.check(output)
    require(
        "map",
        {"block": block.given, "motion": shaking.given},
        "--width-m 0.6 --height-m 2 --accel-g 0.3:1:20 --freq-hz 0.5:3:20",
        "-r 0.8 -A 1:6:20 -W 1:12:20",
    )
    case = map_case(shaking, block, start)
    equations = equations_for(model, case.body)
    motion = floor.of(case.body)
    if series.given:
        moving = [name for name in case.axes if name in RESIZED | FREQUENCY.keys()]
        along = moving[0] if moving else "amplitude"
        motion = floor.along(along, series.of(case.motion), case.body)
    colouring = _colouring(by, output, fates=fate)
    if output.plot is not None:
        _check_drawable(case)
    if sweep.out is not None:
        hint = "leave --out or --refine out"
        refuse({"--refine": refine}, "a store holds every cell of its grid", hint)
    run = sweep.run(force=output.force)

    from rocksteady.dynamics.maps.attractor_map import ATTRACTORS
    from rocksteady.dynamics.maps.fate_map import FATES
    from rocksteady.dynamics.maps.grid_map import map_of
    from rocksteady.sweep.cases.labelled import as_dataset
    from rocksteady.words.maps import FEW, describe_map

    with (
        sweep.running(context, run, "following motions", case.cells) as (shown, meter),
        start.as_typed(),
    ):
        cells = map_of(
            FATES if fate else ATTRACTORS,
            case.body,
            motion,
            axes={**case.axes, **case.fixed},
            start=case.start.of(case.motion.frequency_ratio),
            cycles=cycles,
            refine=refine,
            model=equations,
            run=shown,
        )
    description = describe_map(cells)
    values = {"computed": meter.computed, **description.to_dict(), **case.values}
    values |= {"store": run.place and str(run.place.path), "seconds": meter.seconds}
    output.write_cells(lambda: as_dataset(cells))
    sweep.write_netcdf(lambda: as_dataset(cells))
    if output.plot is not None:
        from rocksteady.show.figures.maps import map_figure

        title = description.headline
        output.write_plot(lambda page: map_figure(as_dataset(cells), title, page, colouring))
    chosen = [
        "--fate" if fate else "",
        "" if cycles is None else f"--cycles {cycles}",
        f"--model {model}" if model else "",
        "" if refine is None else f"--refine {refine}",
        "" if sweep.out is None else f"--out {quoted(sweep.out)} --resume",
    ]
    further = options.follow_up(
        "map", shaking, series, floor, block, start, *chosen, "--plot map.png"
    )
    output.leave(
        "map",
        replace(description, notes=[*description.notes, _speed(meter)]),
        values=values,
        decided=values["counts"].get("undecided", 0) <= FEW * values["cells"],
        wrap=True,
        follow_up="" if output.plot or not _drawable(case) else further,
    )


def _speed(meter: Meter) -> str:
    """Return how many cells were computed, and how fast."""
    computed = meter.computed
    rate = computed / meter.seconds if meter.seconds else 0.0
    return f"{computed:,} cells computed in {meter.seconds:.2f} s, {rate:,.0f} a second"


def _colouring(by: str | None, output: OutputFlags, *, fates: bool) -> "Colouring":
    """Return what colours the cells of a picture.

    Raises
    ------
    InputError
        If there is no such quantity, or no picture.
    """
    if by is None:
        return "class"
    needs("--by", by, "--plot", "map.png", beside=output.plot)
    from rocksteady.show.plots.map_quantities import checked_colouring

    return checked_colouring(by, fates=fates)


def _drawable(case: MapCase) -> bool:
    """Return whether there is a picture of a map."""
    try:
        _check_drawable(case)
    except InputError:
        return False
    return True


def _check_drawable(case: MapCase) -> None:
    """Refuse, before anything is computed, a map of which there is no picture."""
    from rocksteady.show.figures.maps import panels_axis

    try:
        panels_axis({name: len(values) for name, values in case.axes.items()})
    except InputError as error:
        raise InputError(
            "--plot", error.value, error.valid, "leave --plot out, or give fewer axes and values"
        ) from None
