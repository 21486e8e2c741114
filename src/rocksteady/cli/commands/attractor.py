"""`rocksteady attractor`: long-term motion of a block under harmonic shaking."""

from typing import TYPE_CHECKING

from rocksteady.cli.console.refusals import require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import HARMONIC, BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.range import SeriesFlags
from rocksteady.cli.flags.record_files import FloorFlags
from rocksteady.cli.flags.start import StartFlags

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from rocksteady.dynamics.orbits.attractor import Attractor
    from rocksteady.show.style.page import Page

HELP = (
    "Find what a motion settles to.\n\n"
    "Attractor of a motion under harmonic shaking: rest, a fall, a periodic motion, or none.\n\n"
    "A periodic motion is recognised by its returns, polished by Newton's method and believed "
    "only if it is stable by its exact multipliers. Exit code 3 where nothing could be decided."
)
MAIN = "amplitude frequency_ratio restitution width_m height_m accel_g freq_hz start cycles plot"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady attractor -A 2 -W 1.9 -r 0.8 --start steady --side - --plot attractor.png\n\n"
    "rocksteady attractor --block tso-wong-1989 -A 2 -W 4.2 --start steady -n 3 --csv orbit.csv\n\n"
    "rocksteady attractor -A 6 -W 6 -r 0.25 --json"
)

SHOWN_PERIODS = 30
"""Last forcing periods of a motion without an orbit that a time history shows."""


@grouped
def attractor(
    shaking: ShakingFlags,
    series: SeriesFlags,
    floor: FloorFlags,
    block: BlockFlags,
    output: OutputFlags,
    start: StartFlags,
    cycles: int = options.start_flag(
        "--cycles N",
        "Periods of the shaking after which a motion counts as aperiodic or undecided.",
        default=2000,
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady attractor`; `HELP` is what its users read."""
    output.check()
    require("attractor", {"block": block.given, "motion": shaking.given}, *HARMONIC)
    body = block.described()
    equations = equations_for(model, body)
    motion = floor.on_floor(series.of(shaking.at(body, phase=start.first_phase)), body)
    start.check(shaken=True)

    from rocksteady.dynamics.orbits.attractor import find_attractor
    from rocksteady.outcomes import AttractorKind

    with start.as_typed():
        attractor = find_attractor(
            body,
            motion,
            start=start.of(motion.frequency_ratio),
            max_cycles=cycles,
            model=equations,
        )
    output.write_csv(attractor.to_dataframe)
    output.write_plot(lambda page: figure_of(attractor, page))
    typed = f"--model {model}" if model else ""
    further = options.follow_up("basins", shaking, series, floor, block, typed)
    if attractor.reason.endswith("follow more cycles"):
        longer = f"{typed} --cycles {10 * cycles}".strip()
        further = options.follow_up("attractor", shaking, series, floor, block, start, longer)
    output.leave(
        "attractor",
        attractor.describe(),
        after={**start.values(attractor.motion.phase), "cycles": cycles},
        decided=attractor.kind is not AttractorKind.UNDECIDED,
        follow_up=further,
    )


def figure_of(attractor: "Attractor", page: "Page") -> "Figure":
    """Return the figure of an attractor."""
    from rocksteady.show.figures.single import cloud_figure, orbit_figure, simulation_figure

    title, run = attractor.describe().headline, attractor.trajectory()
    if attractor.orbit is not None:
        return orbit_figure(attractor.orbit, run, title, page)
    if attractor.peaks is not None or attractor.kind == "overturned":
        return simulation_figure(run, title, page)
    part = attractor.trajectory(last=SHOWN_PERIODS)
    return cloud_figure(run, part, since=0.5 * run.end_time_pt, title=title, page=page)
