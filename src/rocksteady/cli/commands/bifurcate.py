"""`rocksteady bifurcate`: branches of periodic motions over a parameter, and their bifurcations."""

import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rocksteady.cli.console.outputs import (
    INCOMPLETE,
    announce_compilation,
    print_json,
    write_csv,
    write_figure,
)
from rocksteady.cli.console.progress import progress
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.range import Range, range_of
from rocksteady.cli.flags.sweep_start import Sweep, SweepStart
from rocksteady.cli.present.diagrams_text import print_diagram
from rocksteady.cli.present.diagrams_values import (
    CSV_HEADER,
    bifurcation_values,
    branch_values,
    cascade_values,
    csv_rows,
    range_values,
    sweep_values,
)
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.validation import odd_order, positive, whole_number

if TYPE_CHECKING:
    from rocksteady.dynamics.continuation.points import Branch

BRANCHES = "Branches"
MOST = 1000
"""Of periods and impacts, as `rocksteady.find_orbits` has it."""
LONGEST_AXIS = 20_000
"""Values of a sweep; each takes about a millisecond, a motion that does not settle several."""

HELP = (
    "Periodic motions followed over a parameter, stable and unstable, with their bifurcations.\n\n"
    "Exactly one of -A, -W and -r is an axis start:stop:count; the others are numbers. Branches "
    "are followed around their folds, and every branch that begins at a bifurcation is followed "
    "too. They start from the symmetric motions of order -n in closed form, and from what two "
    "sweeps, upwards and downwards through the values of the axis, settle to. Exit code 3 where "
    "--max-branches ended the work."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady bifurcate -A 2 -W 1.6:2.4:400 -r 0.8 --cascade --plot diagram.png\n\n"
    "rocksteady bifurcate -A 0.1:3:600 -W 2 -r 0.8 --csv branches.csv\n\n"
    "rocksteady bifurcate --block tso-wong-1989 -A 2 --freq-hz 3.9:5:400 -n 3 --json"
)

MaxPeriodFlag = Annotated[
    int | None,
    typer.Option(
        "--max-period",
        metavar="N",
        help="Longest motions that are branched off to, in periods of the shaking; default 4 times "
        "the order -n.",
        rich_help_panel=BRANCHES,
    ),
]
MaxImpactsFlag = Annotated[
    int,
    typer.Option(
        "--max-impacts",
        metavar="N",
        help="Most impacts in a period of the motions that are branched off to.",
        rich_help_panel=BRANCHES,
    ),
]
MaxBranchesFlag = Annotated[
    int,
    typer.Option(
        "--max-branches",
        metavar="N",
        help="After so many no further branch is begun at a bifurcation.",
        rich_help_panel=BRANCHES,
    ),
]
SearchFlag = Annotated[
    bool,
    typer.Option(
        "--search",
        help="Start also from every motion that rocksteady orbits finds at both ends and in the "
        "middle of the range; they may be many.",
        rich_help_panel=BRANCHES,
    ),
]
CascadeFlag = Annotated[
    bool,
    typer.Option(
        "--cascade",
        help="Follow a cascade of period doublings, each on the branch of the one before.",
        rich_help_panel=BRANCHES,
    ),
]
DoublingsFlag = Annotated[
    int | None,
    typer.Option(
        "--doublings",
        metavar="N",
        help="Doublings of --cascade, up to 8; default 6.",
        rich_help_panel=BRANCHES,
    ),
]
NoSweepsFlag = Annotated[
    bool,
    typer.Option(
        "--no-sweeps", help="Follow branches only, without sweeps.", rich_help_panel=options.START
    ),
]
CyclesFlag = Annotated[
    int,
    typer.Option(
        "--cycles",
        metavar="N",
        help="Periods of the shaking at each value of a sweep, after which a motion counts as "
        "aperiodic or undecided.",
        rich_help_panel=options.START,
    ),
]
TopFlag = Annotated[
    float | None,
    typer.Option(
        "--top",
        metavar="U",
        help="Upper end of the axis of angles of --plot, in units of alpha.",
        rich_help_panel=options.OUTPUT,
    ),
]


DOUBLINGS = 6
"""Default of --cascade."""


@grouped
def bifurcate(
    shaking: ShakingFlags,
    block: BlockFlags,
    output: OutputFlags,
    start: SweepStart,
    no_sweeps: NoSweepsFlag = False,
    cycles: CyclesFlag = 2000,
    max_period: MaxPeriodFlag = None,
    max_impacts: MaxImpactsFlag = 12,
    max_branches: MaxBranchesFlag = 100,
    search: SearchFlag = False,
    cascade: CascadeFlag = False,
    doublings: DoublingsFlag = None,
    top: TopFlag = None,
) -> None:
    """Run `rocksteady bifurcate`; `HELP` is what its users read."""
    output.check()
    span = range_of(shaking, block)
    if not span.body.symmetric:
        raise block.refuse_sides(
            valid="branches are followed of symmetric blocks alone",
            hint="draw a diagram of what it settles to with `rocksteady map`, and one axis",
        )
    start.check(shaken=True)
    hint = "give a whole number"
    order = whole_number(
        "order", odd_order(start.order), at_least=1, at_most=MOST, hint="use 1, 3, 5, ..."
    )
    longest = min(4 * order, MOST) if max_period is None else max_period
    whole_number("max_period", longest, at_least=1, at_most=MOST, hint=hint)
    whole_number("max_impacts", max_impacts, at_least=1, at_most=MOST, hint=hint)
    whole_number("max_branches", max_branches, at_least=1, at_most=10 * MOST, hint=hint)
    if doublings is not None and not cascade:
        raise FlagError(
            "doublings",
            doublings,
            "without --cascade it has no meaning",
            "add --cascade, or leave it out",
        )
    many = DOUBLINGS if doublings is None else doublings
    whole_number("doublings", many, at_least=1, at_most=8, hint=hint)
    whole_number("cycles", cycles, at_least=1, at_most=1_000_000, hint=hint)
    check_top(top, output)
    sweeping = check_sweeps(span, start, no_sweeps=no_sweeps)

    announce_compilation("chains.fill_chain")
    from rocksteady.dynamics.continuation.branches import find_branches
    from rocksteady.dynamics.continuation.cascade import longest_cascade
    from rocksteady.dynamics.continuation.seeds import (
        searched_orbits,
        settled_orbits,
        symmetric_orbits,
    )

    swept: list[Sweep] = []
    with progress("following", 3 if sweeping else 1, lines=False) as done:
        if sweeping:
            for upwards, name in ((True, "upward sweep"), (False, "downward sweep")):
                swept.append(_sweep(span, start, cycles, upwards=upwards))
                done(name)
        trails = [each.trail for each in swept]
        place = (*span.at(span.values[0]), span.parameter, span.within)
        starts = [*symmetric_orbits(*place, order), *settled_orbits(trails, longest, max_impacts)]
        if search:
            starts += searched_orbits(*place, longest, max_impacts)
        branches = find_branches(
            starts,
            span.parameter,
            span.within,
            max_period=longest,
            max_impacts=max_impacts,
            max_branches=max_branches + 1,
        )
        done("branches")
    complete = len(branches) <= max_branches  # one more says that more would have begun
    branches = branches[:max_branches]
    values: dict[str, Any] = {
        **range_values(span),
        "order": order,
        "max_period": longest,
        "max_impacts": max_impacts,
        "max_branches": max_branches,
        "complete": complete,
        "points": bifurcation_values(branches, span),
        "branches": branch_values(branches, span),
        "sweeps": [sweep_values(each) for each in swept],
    }
    if cascade:
        values["cascade"] = cascade_values(longest_cascade(branches, span.within, many))
    if not complete:
        print(
            f"stopped at {max_branches} branches: more may begin; raise --max-branches, or lower "
            "--max-period or --max-impacts",
            file=sys.stderr,
        )
    write_files(branches, swept, span, output, top)
    if output.as_json:
        print_json("bifurcate", values)
    else:
        print_diagram(values, span)
    if not complete:
        raise typer.Exit(INCOMPLETE)


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
    if output.plot is None:
        raise FlagError(
            "top",
            top,
            "without --plot it has no meaning",
            "add --plot diagram.png, or leave it out",
        )


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


def write_files(
    branches: "tuple[Branch, ...]",
    swept: list[Sweep],
    span: Range,
    output: OutputFlags,
    top: float | None,
) -> None:
    """Write what --csv and --plot ask for."""
    if output.csv is not None:
        si = ("accel_g", "freq_hz", "highest_rad", "lowest_rad")
        header = [*CSV_HEADER, *(si if isinstance(span.body, Block) else ())]
        write_csv(output.csv, header, csv_rows(branches, span))
    if output.plot is not None:
        from rocksteady.show.figures.single import bifurcation_figure

        trails = [each.trail for each in swept]
        title = f"Periodic motions: {span.text}"
        figure = bifurcation_figure(
            branches, trails, span.parameter, top=top, title=title, page=output.page
        )
        write_figure(output.plot, figure)


def _sweep(span: Range, start: SweepStart, cycles: int, *, upwards: bool) -> Sweep:
    """Carry a motion along the axis."""
    from rocksteady.dynamics.orbits.attractor_sweep import sweep_attractor

    values = span.values if upwards else span.values[::-1]
    word, begin, phase = start.begin(span, values[0])
    bare, shaking = span.at(values[0])
    trail = sweep_attractor(
        bare,
        replace(shaking, phase=phase),
        span.parameter,
        values,
        start=begin,
        max_cycles=cycles,
    )
    return Sweep(start=word, trail=trail)
