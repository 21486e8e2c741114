"""`rocksteady orbits`: stable and unstable periodic motions at one amplitude and frequency."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rocksteady.cli.console.refusals import require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import HARMONIC, BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.range import SeriesFlags
from rocksteady.cli.flags.record_files import FloorFlags

if TYPE_CHECKING:
    from rocksteady.dynamics.orbits.orbit import Orbit

search_flag = options.Panel("Search")

HELP = (
    "Find the periodic motions at one amplitude and frequency.\n\n"
    "The periodic motions under harmonic shaking, stable and unstable, with their "
    "multipliers.\n\n"
    "Symmetric ones with two impacts come in closed form, with solutions that pass through the "
    "floor included, or by the full equations as the motions to which the closed forms lead; "
    "the others are found by Newton's method from a grid of states, which is no proof that "
    "there are no more. One of two mirror images is listed."
)
MAIN = (
    "amplitude frequency_ratio restitution width_m height_m accel_g freq_hz "
    "max_period max_impacts plot"
)
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady orbits -A 2 -W 1.9 -r 0.8 --plot orbits.png\n\n"
    "rocksteady orbits --block tso-wong-1989 -A 2 -W 4 --max-period 5 --csv orbits.csv\n\n"
    "rocksteady orbits -A 2 -W 1.78 -r 0.8 --max-period 2 --json\n\n"
    "rocksteady orbits --alpha-rad 0.3 --radius-m 1 -A 2 -W 4 --seeds 48"
)


@grouped
def orbits(
    shaking: ShakingFlags,
    series: SeriesFlags,
    floor: FloorFlags,
    block: BlockFlags,
    output: OutputFlags,
    max_period: int = search_flag(
        "--max-period N", "Longest motions, in periods of the shaking.", default=3
    ),
    max_impacts: int = search_flag(
        "--max-impacts N", "Most impacts in a period of the motion.", default=6
    ),
    seeds: int = search_flag(
        "--seeds N",
        "The search starts from N x N states; more find more, and take longer.",
        default=96,
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady orbits`; `HELP` is what its users read."""
    output.check()
    require("orbits", {"block": block.given, "motion": shaking.given}, *HARMONIC)
    body = block.described()
    equations = equations_for(model, body)
    motion = floor.on_floor(series.of(shaking.at(body)), body)

    from rocksteady.dynamics.orbits.search import find_orbits
    from rocksteady.model.units import framed
    from rocksteady.show.figures.single import orbits_figure
    from rocksteady.words.orbits import describe_orbits

    limits = {"max_period": max_period, "max_impacts": max_impacts, "seeds": seeds}
    listed = find_orbits(body, motion, model=equations, **limits)
    description = describe_orbits(listed, body, motion, equations, **limits)
    (table,) = description.tables
    output.write_csv(lambda: framed(table.rows, body, "number"))
    output.write_plot(lambda page: orbits_figure(listed, description.headline, page))
    chosen = f"--model {model}" if model else ""
    further = options.follow_up(
        "attractor", shaking, series, floor, block, chosen, *_start_of(listed, motion.phase)
    )
    output.leave("orbits", description, follow_up=further)


def _start_of(listed: "Sequence[Orbit]", turned: float) -> list[str]:
    """Return the flags that start on the first stable motion, if there is one without rests.

    Parameters
    ----------
    listed
        The motions.
    turned
        Phase of their shaking where that of the ground, which --phase sets, is 0 [rad].
    """
    states = [orbit.start for orbit in listed if orbit.stable and not orbit.rest_phases]
    return [f"--start=0,{s.side * s.speed:.6g} --phase {s.phase - turned:.6g}" for s in states[:1]]
