"""`rocksteady assess`: from an object to an answer."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import print_json, write_csv
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags import options
from rocksteady.cli.flags.block_and_shaking import BlockFlags
from rocksteady.cli.flags.demand import DEMAND, PeakFlags, RowFlags, probability, sized_block
from rocksteady.cli.flags.groups import grouped
from rocksteady.results.rendering import print_description

if TYPE_CHECKING:
    from rocksteady.risk.assess.two_numbers import QuickAssessment

HELP = (
    "Will it fall? From a block, a peak acceleration and a peak velocity to a probability and one "
    "sentence, by a closed form fitted to published runs.\n\n"
    "With --friction it answers whether the block rocks at all: where it slides there is no "
    "probability of falling by rocking."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady assess --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4\n\n"
    "rocksteady assess --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4 --friction 0.4 "
    "--check --target 0.1 --json"
)
NEGATIVE = 1
"""Exit code with --check where the object may fall more often than the target, or slides."""
ObjectFile = Annotated[
    Path | None,
    typer.Argument(metavar="FILE", help="An object file or a table of objects: not read yet."),
]
CheckFlag = Annotated[
    bool,
    typer.Option(
        "--check",
        help="Leave with exit code 1 where the probability is above --target, or the block slides.",
        rich_help_panel=options.OUTPUT,
    ),
]
TargetFlag = Annotated[
    float,
    typer.Option(
        "--target",
        metavar="P",
        help="Set the largest probability of falling that --check accepts.",
        rich_help_panel=DEMAND,
    ),
]


@grouped
def assess(
    block: BlockFlags,
    peaks: PeakFlags,
    output: RowFlags,
    file: ObjectFile = None,
    check: CheckFlag = False,
    target: TargetFlag = 0.1,
) -> None:
    """Run `rocksteady assess`; `HELP` is what its users read."""
    if file is not None:
        raise FlagError(
            finding=f"in place of --width-m and --height-m {str(file)!r} is given",
            valid="object files and tables of objects are not read yet",
            hint="describe the block, as --width-m 0.32 --height-m 1.8 --pga-g 0.35 --pgv-m-s 0.4",
        )
    output.check([])
    most = probability("--target", target)
    found = quick_answer(block, peaks)
    description = found.describe()
    if output.csv is not None:
        facts = {fact.key: fact.value for fact in description.facts if fact.key}
        row = {key: each for key, each in facts.items() if not isinstance(each, list | dict)}
        write_csv(output.csv, list(row), [list(row.values())])
    if output.as_json:
        print_json("assess", description.to_dict())
    else:
        print_description(description, terminal.console())
    if check and (found.probability is None or found.probability > most):
        raise typer.Exit(NEGATIVE)


def quick_answer(block: BlockFlags, peaks: PeakFlags) -> "QuickAssessment":
    """Return the answer from two numbers.

    Raises
    ------
    InputError, FlagError
        If the block or a peak is missing or not valid.
    """
    body = sized_block(block)
    pga_g, pgv_m_s = peaks.both_peaks()
    from rocksteady.risk.assess.two_numbers import assess_two_numbers

    return assess_two_numbers(body, pga_g, pgv_m_s, peaks.friction)
