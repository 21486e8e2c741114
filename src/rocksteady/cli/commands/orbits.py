"""`rocksteady orbits`: stable and unstable periodic motions at one amplitude and frequency."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import announce_compilation, print_json, write_csv, write_figure
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags, equations_for
from rocksteady.cli.flags.groups import OutputFlags, grouped
from rocksteady.cli.present.shared import (
    case_text,
    multipliers_text,
    orbit_values,
    plural,
    shaking_values,
    worth,
)
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.outcomes import INFINITELY_MANY

if TYPE_CHECKING:
    from rocksteady.dynamics.orbits.orbit import Orbit

SEARCH = "Search"

HELP = (
    "The periodic motions under harmonic shaking, stable and unstable, with their multipliers.\n\n"
    "Symmetric ones with two impacts come in closed form, those that pass through the floor "
    "included, or with --model nonlinear as the motions to which the closed forms lead; the others "
    "are found by Newton's method from a grid of states, which is no proof that there are no more. "
    "Of two mirror images one is listed."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady orbits -A 2 -W 1.9 -r 0.8 --plot orbits.png\n\n"
    "rocksteady orbits --block tso-wong-1989 -A 2 -W 4 --max-period 5 --csv orbits.csv\n\n"
    "rocksteady orbits -A 2 -W 1.78 -r 0.8 --max-period 2 --json\n\n"
    "rocksteady orbits --alpha-rad 0.3 --radius-m 1 -A 2 -W 4 --model nonlinear --seeds 48"
)

CSV_HEADER = (
    "number",
    "period",
    "impacts_per_period",
    "rest_phases",
    "kind",
    "branch",
    "admissible",
    "stable",
    "neutral",
    "highest",
    "lowest",
    "multiplier_1_re",
    "multiplier_1_im",
    "multiplier_2_re",
    "multiplier_2_im",
    "residual",
    "side",
    "phase_rad",
    "speed_per_pivot_time",
)

MaxPeriodFlag = Annotated[
    int,
    typer.Option(
        "--max-period",
        metavar="N",
        help="Longest motions, in periods of the shaking.",
        rich_help_panel=SEARCH,
    ),
]
MaxImpactsFlag = Annotated[
    int,
    typer.Option(
        "--max-impacts",
        metavar="N",
        help="Most impacts in a period of the motion.",
        rich_help_panel=SEARCH,
    ),
]
SeedsFlag = Annotated[
    int,
    typer.Option(
        "--seeds",
        metavar="N",
        help="The search starts from N x N states; more find more, and take longer.",
        rich_help_panel=SEARCH,
    ),
]


@grouped
def orbits(
    shaking: ShakingFlags,
    block: BlockFlags,
    output: OutputFlags,
    max_period: MaxPeriodFlag = 3,
    max_impacts: MaxImpactsFlag = 6,
    seeds: SeedsFlag = 96,
    model: options.Model = "linear",
) -> None:
    """Run `rocksteady orbits`; `HELP` is what its users read."""
    output.check()
    body = block.described()
    equations = equations_for(model, body)
    motion = shaking.at(body)

    announce_compilation("periodic.search")
    from rocksteady.dynamics.orbits.search import find_orbits as search

    found = search(
        body,
        motion,
        max_period=max_period,
        max_impacts=max_impacts,
        seeds=seeds,
        model=equations,
    )
    values = {
        "orbits": [listed_values(orbit, body) for orbit in found],
        "max_period": max_period,
        "max_impacts": max_impacts,
        "seeds": seeds,
        "model": model,
        **shaking_values(body, motion),
    }
    if output.csv is not None:
        header = [*CSV_HEADER, *(("highest_rad", "lowest_rad") if isinstance(body, Block) else ())]
        write_csv(output.csv, header, csv_rows(values["orbits"]))
    if output.plot is not None:
        from rocksteady.show.figures.single import orbits_figure

        title = f"Periodic motions: {case_text(values)}"
        write_figure(output.plot, orbits_figure(found, title, output.page))
    if output.as_json:
        print_json("orbits", values)
    else:
        print_table(values)


def listed_values(orbit: "Orbit", body: Block | DimensionlessBlock) -> dict[str, Any]:
    """Return an orbit as an attractor has it, and whether it is a motion and stable."""
    # What passes through the floor has multipliers, and no stability.
    stable, neutral = (orbit.stable, orbit.neutral) if orbit.admissible else (None, None)
    return {
        **orbit_values(orbit, body),
        "branch": orbit.branch,
        "admissible": orbit.admissible,
        "stable": stable,
        "neutral": neutral,
    }


def csv_rows(listed: Sequence[dict[str, Any]]) -> list[list[object]]:
    """Return one row an orbit; cells of what it has not are empty, infinitely many impacts -1."""
    rows: list[list[object]] = []
    for number, orbit in enumerate(listed, start=1):
        first, second = orbit["multipliers"]
        begin = orbit["states"][0]
        names = ("period", "impacts_per_period", "rest_phases", "kind", "branch")
        counts = {} if orbit["impacts_per_period"] else {"impacts_per_period": INFINITELY_MANY}
        verdicts = ("admissible", "stable", "neutral")
        rows.append(
            [
                number,
                *(counts.get(name, orbit[name]) for name in (*names, *verdicts)),
                *(orbit["peaks"] or ("", "")),
                *(first.real, first.imag, second.real, second.imag),
                orbit["residual"],
                *(begin["side"], begin["phase"], begin["speed"]),
                *_radians(orbit),
            ]
        )
    return rows


def _radians(orbit: dict[str, Any]) -> Sequence[object]:
    """Return the peaks of a block with a size in radians; nothing without one."""
    if "peaks_rad" not in orbit:
        return ()
    return orbit["peaks_rad"] or ("", "")


def print_table(values: dict[str, Any]) -> None:
    """Print one row an orbit, in 80 characters."""
    from rich.table import Table

    console = terminal.console()
    listed = values["orbits"]
    motions = plural(sum(orbit["admissible"] for orbit in listed), "periodic motion")
    periods, impacts = values["max_period"], values["max_impacts"]
    console.print(
        f"{case_text(values)}\n{motions} up to {plural(periods, 'period')} and "
        f"{plural(impacts, 'impact')}, {sum(orbit['stable'] is True for orbit in listed)} stable"
    )
    if listed:
        table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0))
        for heading in ("#", "period", "impacts", "kind", "", "highest", "lowest", " multipliers"):
            right = heading in ("#", "period", "impacts", "highest", "lowest")
            table.add_column(heading, justify="right" if right else "left", no_wrap=True)
        for number, orbit in enumerate(listed, start=1):
            table.add_row(
                str(number),
                *table_cells(orbit),
                style=None if orbit["admissible"] else "dim",
            )
        console.print(table)
    # A block whose sides differ has no mirror images.
    asymmetric = "negative_restitution" in values or "negative" in values.get("block", {})
    images = "." if asymmetric else ";\nof two mirror images one is listed."
    console.print(
        f"Angles are in units of alpha. A search from {values['seeds']} x {values['seeds']} states "
        f"may miss motions{images}",
        style="dim",
    )


def table_cells(orbit: dict[str, Any]) -> list[str]:
    """Return the cells of an orbit's row."""
    impacts, branch = orbit["impacts_per_period"], orbit["branch"]
    peaks = ["—", "—"] if orbit["peaks"] is None else [f"{peak:.4f}" for peak in orbit["peaks"]]
    pair = multipliers_text(orbit["multipliers"], 3)
    for sign in ("-", "+"):  # 1e-06 is 1e-6, and 1e+06 is 1e6
        pair = pair.replace(f"e{sign}0", f"e{sign}")
    return [
        str(orbit["period"]),
        "inf" if impacts is None else str(impacts),
        orbit["kind"] if branch is None else f"{orbit['kind']} {branch}",
        worth(**{name: bool(orbit[name]) for name in ("admissible", "neutral", "stable")}),
        *peaks,
        " " + pair.replace("e+", "e"),
    ]
