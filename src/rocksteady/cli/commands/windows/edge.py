"""`rocksteady edge`: what parts two basins, and the least fatal kick."""

from typing import TYPE_CHECKING

from rocksteady.cli.console.refusals import both, refuse, require
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import HARMONIC, BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.flags.record_files import FloorFlags
from rocksteady.cli.flags.start import StartFlags, state_from
from rocksteady.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

    from rocksteady.dynamics.edges.edge_state import EdgeState
    from rocksteady.dynamics.edges.manifold import Manifold

HELP = (
    "Find the least kick that makes it fall.\n\n"
    "The edge of two basins: the unstable motion on it, and the least fatal kick from a "
    "state.\n\n"
    "A motion is kept on the edge by bisection and polished by Newton's method. Without --other "
    "the edge is sought among kicks of both signs, sudden changes of the base velocity. With "
    "--manifolds the curves along which motions approach the edge motion and leave it are "
    "computed too; the first separate the basins. Exit code 3 where the motion on the edge does "
    "not repeat."
)
MAIN = "amplitude frequency_ratio restitution width_m height_m start other manifolds plot csv"
"""Parameters that the short help shows."""
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady edge -A 0.2 -W 2 -r 0.9 --manifolds --plot edge.png\n\n"
    "rocksteady edge -A 2 -W 1.9 -r 0.8 --start steady --side - --direction - --json\n\n"
    "rocksteady edge -A 0.5 -W 2 -r 0.9 --other 0.2,0.3 --manifolds --csv manifolds.csv\n\n"
    "rocksteady edge --width-m 0.6 --height-m 2 --accel-g 0.4 --freq-hz 2"
)
edge_flag = options.Panel("Edge")


@grouped
def edge(
    shaking: ShakingFlags,
    floor: FloorFlags,
    block: BlockFlags,
    output: OutputFlags,
    start: StartFlags,
    other: str | None = edge_flag(
        "--other STATE",
        "Give a second state, U,V or U,tau=DU, whose outcome differs from that of --start; "
        "default: a state after a kick.",
    ),
    direction: str | None = edge_flag(
        "--direction [+|-]", "Search kicks of one sign alone; not with --other. Default both."
    ),
    manifolds: bool = edge_flag(
        "--manifolds",
        "Compute the stable and the unstable manifold of the motion on the edge, at the phase "
        "of the start.",
        default=False,
    ),
    length: float | None = edge_flag(
        "--length X",
        "Set the length of each branch of --manifolds, in half widths of the window; default 10.",
    ),
    cycles: int = options.start_flag(
        "--cycles N",
        "Set the periods of the shaking after which a motion is taken to stand.",
        default=500,
    ),
    model: str | None = options.model(),
) -> None:
    """Run `rocksteady edge`; `HELP` is what its users read."""
    output.check()
    if direction not in (None, "+", "-"):
        raise InputError("--direction", direction, "it must be + or -", "give + or -")
    if other is not None and direction is not None:
        raise both("--other", "--direction", valid="a second state takes the place of the kick")
    if not manifolds:
        hint = "add --manifolds, or leave it out"
        refuse({"--length": length}, "it is the length of the branches of manifolds", hint)
    require("edge", {"block": block.given, "motion": shaking.given}, *HARMONIC)
    body = block.described()
    equations = equations_for(model, body)
    motion = floor.on_floor(shaking.at(body, phase=start.first_phase), body)
    start.check(shaken=True)

    from rocksteady.dynamics.edges.growing import LENGTH, compute_manifold
    from rocksteady.dynamics.edges.tracking import find_edge_state
    from rocksteady.show.figures.single import edge_figure

    with start.as_typed():
        edge_state = find_edge_state(
            body,
            motion,
            start=start.of(motion.frequency_ratio),
            other=None if other is None else state_from(other, motion.frequency_ratio, "other"),
            kick=None if direction is None else int(f"{direction}1"),
            max_cycles=cycles,
            model=equations,
        )
    curves: list[Manifold] = []
    if manifolds and edge_state.saddle is not None:
        long = LENGTH if length is None else length
        curves = [
            compute_manifold(edge_state.saddle, kind, phase=edge_state.motion.phase, length=long)
            for kind in ("stable", "unstable")
        ]
    description = edge_state.describe()
    output.write_csv(lambda: _points(edge_state, curves))
    output.write_plot(lambda page: edge_figure(edge_state, curves, description.headline, page))
    chosen = [
        f"--other={other}" if other else "",
        f"--direction {direction}" if direction else "",
        f"--model {model}" if model else "",
    ]
    further = options.follow_up("edge", shaking, floor, block, start, *chosen)
    further = "" if output.plot else f"{further} --manifolds --plot edge.png"
    output.leave(
        "edge",
        description,
        after={
            **start.values(edge_state.motion.phase),
            "cycles": cycles,
            "direction": None if other else direction or "both",
            **({"manifolds": [curve.to_dict() for curve in curves]} if manifolds else {}),
        },
        also=[curve.describe() for curve in curves],
        decided=edge_state.saddle is not None,
        follow_up=further,
    )


def _points(edge_state: "EdgeState", curves: "list[Manifold]") -> "pd.DataFrame":
    """Return the points of the manifolds, or without these the tracked states."""
    import pandas as pd

    if not curves:
        return edge_state.to_dataframe()
    return pd.concat([curve.to_dataframe().assign(kind=curve.kind) for curve in curves])
