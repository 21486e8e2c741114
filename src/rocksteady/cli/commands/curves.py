"""`rocksteady curves`: bifurcation curves in the plane of two parameters."""

import sys

from rocksteady.cli.console.progress import progress
from rocksteady.cli.console.refusals import require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.range import plane_of

curve_flag = options.Panel("Curves")
MOST_IMPACTS, MOST_BRANCHES, MOST_CURVES = 6, 20, 40
"""Defaults of --max-impacts, --max-branches and --max-curves."""

HELP = (
    "Follow bifurcations over two parameters.\n\n"
    "Bifurcation curves in the plane of two parameters, with their points of codimension "
    "two.\n\n"
    "Exactly two of -A, -W and -r are axes start:stop:count; the third is a number. At count "
    "values of each axis branches of periodic motions are followed across the plane, from the "
    "symmetric motions of order -n in closed form (by the full equations, those to which they "
    "lead; for a block whose sides differ, motions with two impacts that a search finds); every "
    "bifurcation on them is then followed in both parameters, and so are the curves that meet "
    "at a point of codimension two. Exit code 3 where --max-curves or --max-branches ended the "
    "work."
)
MAIN = (
    "amplitude frequency_ratio restitution order max_period max_impacts max_curves model plot csv"
)
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady curves -W 4.2:6:2 -A 2.5:4.5:2 -r 0.87 -n 3 --plot curves.png\n\n"
    "rocksteady curves -W 1:4:3 -A 0.2:5:3 -r 0.8 --max-impacts 4 --csv curves.csv\n\n"
    "rocksteady curves -r 0.6:0.95:2 -A 1:5:2 -W 5 -n 3 --max-impacts 2 --json\n\n"
    "rocksteady curves -W 4.2:6:2 -A 2.5:4.5:2 -r 0.87 -n 3 --alpha-rad 0.3 --radius-m 1 --json"
)


@grouped
def curves(
    shaking: ShakingFlags,
    block: BlockFlags,
    output: OutputFlags,
    order: list[int] | None = options.motion_flag(
        "--order -n N",
        "Set the half periods of the shaking in one half cycle of the symmetric motions to "
        "start from, odd; default 1; may be repeated.",
    ),
    max_period: int | None = curve_flag(
        "--max-period N",
        "Set the longest period of the motions whose bifurcations are followed, in periods of "
        "the shaking; default twice the largest order -n.",
    ),
    max_impacts: int = curve_flag(
        "--max-impacts N",
        "Set the most impacts in a period of the motions whose bifurcations are followed.",
        default=MOST_IMPACTS,
    ),
    max_branches: int = curve_flag(
        "--max-branches N",
        "Largest number of branches on each line across the plane.",
        default=MOST_BRANCHES,
    ),
    max_curves: int = curve_flag(
        "--max-curves N", "Largest number of curves.", default=MOST_CURVES
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady curves`; `HELP` is what its users read."""
    output.check()
    require(
        "curves",
        {"block": block.given, "motion": shaking.given},
        "--width-m 0.6 --height-m 2 --accel-g 0.3:1:3 --freq-hz 0.7:2:3",
        "-r 0.8 -A 1:3:3 -W 1.5:4:3",
    )
    plane = plane_of(shaking, block)
    if plane.body.one_sided:
        raise block.refuse_sides(
            valid="bifurcation curves are followed of blocks that rock on both sides",
            hint="draw a map of what it settles to with `rocksteady map`",
        )
    equations = equations_for(model, plane.body)
    from rocksteady.dynamics.continuation.curves.bifurcation_curves import CurveOptions

    search = CurveOptions(
        orders=tuple(order or (1,)),
        lines=plane.lines,
        max_period=max_period,
        max_impacts=max_impacts,
        max_branches=max_branches,
        max_curves=max_curves,
    )
    from rocksteady.dynamics.continuation.curves.search_plane import find_bifurcation_curves
    from rocksteady.show.figures.single import curves_figure

    with progress("following", 1, lines=False) as done:
        curves_found = find_bifurcation_curves(
            plane.body,
            plane.motion,
            plane.parameters,
            within=plane.within,
            search=search,
            model=equations,
        )
        done("curves")
    if not curves_found.complete:
        print(
            f"stopped at {max_curves} curves, or at {max_branches} branches of a line: there may "
            "be more; raise --max-curves or --max-branches, or lower --max-impacts",
            file=sys.stderr,
        )
    output.write_csv(curves_found.to_dataframe)
    output.write_plot(lambda page: curves_figure(curves_found, page=page))
    asked = [
        *(f"-n {each}" for each in order or ()),
        "" if max_period is None else f"--max-period {max_period}",
        f"--max-impacts {max_impacts}" if max_impacts != MOST_IMPACTS else "",
        f"--max-branches {max_branches}" if max_branches != MOST_BRANCHES else "",
        f"--max-curves {max_curves}" if max_curves != MOST_CURVES else "",
        f"--model {model}" if model else "",
    ]
    further = options.follow_up("curves", shaking, block, *asked, "--plot curves.png")
    output.leave(
        "curves",
        curves_found.describe(),
        decided=curves_found.complete,
        follow_up="" if output.plot else further,
    )
