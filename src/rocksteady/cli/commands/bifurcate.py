"""`rocksteady bifurcate`: branches of periodic motions over a parameter, and their bifurcations."""

import sys
from dataclasses import replace

from rocksteady.cli.console.progress import progress
from rocksteady.cli.console.refusals import FlagError, needs, require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.range import Range, SeriesFlags, range_of
from rocksteady.cli.flags.record_files import FloorFlags
from rocksteady.cli.flags.sweep_start import SweepStart
from rocksteady.model.checks.validation import positive, whole_number
from rocksteady.model.motions.segments import Harmonic

branch_flag = options.Panel("Branches")
LONGEST_AXIS = 20_000
"""Values of a sweep; each takes about a millisecond, a motion that does not settle several."""

HELP = (
    "Follow periodic motions over a parameter.\n\n"
    "Periodic motions followed over a parameter, stable and unstable, with their "
    "bifurcations.\n\n"
    "Exactly one of -A, -W and -r is an axis start:stop:count; the others are numbers. Branches "
    "are followed around their folds, and every branch that begins at a bifurcation is followed "
    "too. They start from the symmetric motions of each order -n in closed form (by the full "
    "equations from those to which they lead; for a block whose sides differ, from motions with "
    "two impacts, by a search, as under --harmonic), and from what two sweeps, upwards and "
    "downwards through the values of the axis, settle to. Exit code 3 where --max-branches "
    "ended the work."
)
MAIN = "amplitude frequency_ratio restitution width_m height_m accel_g freq_hz cascade order plot"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady bifurcate -A 2 -W 1.6:2.4:400 -r 0.8 --cascade --plot diagram.png\n\n"
    "rocksteady bifurcate -A 0.1:3:600 -W 2 -r 0.8 --csv branches.csv\n\n"
    "rocksteady bifurcate -A 2 -W 1.6:2.4:400 -r 0.8 --harmonic 1,1,0 --harmonic 2,0.3,0\n\n"
    "rocksteady bifurcate --block tso-wong-1989 -A 2 --freq-hz 3.9:5:400 -n 1 -n 3 --json\n\n"
    "rocksteady bifurcate --alpha-rad 0.25 --radius-m 1 -r 0.85 -A 2 -W 1.4:2.6:200"
)


CYCLES, MOST_IMPACTS, MOST_BRANCHES = 2000, 12, 100
"""Defaults of --cycles, --max-impacts and --max-branches."""
DOUBLINGS = 6
"""Default of --cascade."""


@grouped
def bifurcate(
    shaking: ShakingFlags,
    series: SeriesFlags,
    floor: FloorFlags,
    block: BlockFlags,
    output: OutputFlags,
    start: SweepStart,
    no_sweeps: bool = options.start_flag(
        "--no-sweeps", "Follow branches only, without sweeps.", default=False
    ),
    cycles: int = options.start_flag(
        "--cycles N",
        "Periods of the shaking at each value of a sweep, after which a motion counts as "
        "aperiodic or undecided.",
        default=CYCLES,
    ),
    max_period: int | None = branch_flag(
        "--max-period N",
        "Longest motions that are branched off to, in periods of the shaking; default 4 times "
        "the largest order -n.",
    ),
    max_impacts: int = branch_flag(
        "--max-impacts N",
        "Most impacts in a period of the motions that are branched off to.",
        default=MOST_IMPACTS,
    ),
    max_branches: int = branch_flag(
        "--max-branches N",
        "Number of branches after which no further one begins at a bifurcation.",
        default=MOST_BRANCHES,
    ),
    search: bool = branch_flag(
        "--search",
        "Start also from every motion that rocksteady orbits finds at both ends and in the "
        "middle of the range; they may be many.",
        default=False,
    ),
    cascade: bool = branch_flag(
        "--cascade",
        "Follow a cascade of period doublings, each on the branch of the one before.",
        default=False,
    ),
    doublings: int | None = branch_flag(
        "--doublings N", "Doublings of --cascade, up to 8; default 6."
    ),
    top: float | None = options.output_flag(
        "--top U", "Upper end of the axis of angles of --plot, in units of alpha."
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady bifurcate`; `HELP` is what its users read."""
    output.check()
    require(
        "bifurcate",
        {"block": block.given, "motion": shaking.given},
        "--width-m 0.6 --height-m 2 --accel-g 0.4:1:40 --freq-hz 2",
        "-r 0.8 -A 1:3:40 -W 4",
    )
    span = range_of(shaking, block)
    if span.body.one_sided:
        raise block.refuse_sides(
            valid="branches are followed of blocks that rock on both sides",
            hint="draw a diagram of what it settles to with `rocksteady map`, and one axis",
        )
    equations = equations_for(model, span.body)
    start.check()
    needs("--doublings", doublings, "--cascade", beside=cascade)
    count = DOUBLINGS if doublings is None else doublings
    whole_number("doublings", count, at_least=1, at_most=8, hint="give a whole number")
    whole_number("cycles", cycles, at_least=1, at_most=1_000_000, hint="give a whole number")
    check_top(top, output)
    begins = replace(span.motion, phase=start.first_phase)
    motion = floor.along(span.parameter, series.of(begins), span.body)
    if isinstance(motion, Harmonic):
        span = replace(span, amplitude=motion.amplitude)
    sweeping = check_sweeps(span, start, no_sweeps=no_sweeps)

    from rocksteady.dynamics.continuation.branches import BranchOptions
    from rocksteady.dynamics.continuation.find_bifurcations import find_bifurcations
    from rocksteady.show.figures.single import bifurcation_figure

    asked = BranchOptions(
        orders=start.orders,
        max_period=max_period,
        max_impacts=max_impacts,
        max_branches=max_branches,
        everywhere=search,
        doublings=count if cascade else 0,
        max_cycles=cycles,
    )
    begin = start.chosen(span, equations, series) if sweeping else None
    with progress("following", 1, lines=False) as done:
        diagram = find_bifurcations(
            span.body,
            motion,
            span.parameter,
            within=(span.values[0], span.values[-1]),
            values=span.values if sweeping else 0,
            start=begin,
            search=asked,
            model=equations,
        )
        done("branches")
    if not diagram.complete:
        print(
            f"stopped at {max_branches} branches: more may begin; raise --max-branches, or lower "
            "--max-period or --max-impacts",
            file=sys.stderr,
        )
    output.write_csv(diagram.to_dataframe)
    output.write_plot(lambda page: bifurcation_figure(diagram, top=top, page=page))
    description = diagram.describe()
    values = start.as_given(description.to_dict())
    flags = [
        "--no-sweeps" if no_sweeps else "",
        "--search" if search else "",
        "--cascade" if cascade else "",
        f"--doublings {doublings}" if doublings else "",
        f"--max-period {max_period}" if max_period else "",
        f"--max-impacts {max_impacts}" if max_impacts != MOST_IMPACTS else "",
        f"--max-branches {max_branches}" if max_branches != MOST_BRANCHES else "",
        f"--cycles {cycles}" if cycles != CYCLES else "",
        f"--model {model}" if model else "",
    ]
    further = options.follow_up("bifurcate", shaking, series, floor, block, start, *flags)
    output.leave(
        "bifurcate",
        description,
        values=values,
        decided=diagram.complete,
        follow_up="" if output.plot else f"{further} --plot diagram.png",
    )


def check_top(top: float | None, output: OutputFlags) -> None:
    """Refuse an end of an axis that is none, or that nothing draws.

    Raises
    ------
    InputError
        If it is not positive.
    InputError
        If there is no plot.
    """
    if top is None:
        return
    positive("top", top, hint="give an angle in units of alpha, as 1.5")
    needs("--top", top, "--plot", "diagram.png", beside=output.plot)


def check_sweeps(span: Range, start: SweepStart, *, no_sweeps: bool) -> bool:
    """Return whether there are sweeps, after refusing flags that contradict that.

    Raises
    ------
    InputError
        If a start is given and there are none, or the axis is too long for them.
    """
    if no_sweeps:
        start.refuse("with --no-sweeps")
        return False
    if len(span.values) > LONGEST_AXIS:
        raise FlagError(
            finding=f"{options.FLAG_OF_ARGUMENT[span.parameter]} has {len(span.values)} values",
            valid=f"sweeps go through at most {LONGEST_AXIS}",
            hint="take fewer, or add --no-sweeps",
        )
    return True
