"""`rocksteady paper`: every figure and statement of Tso and Wong (1989), recomputed."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import announce_compilation, print_json
from rocksteady.cli.console.progress import progress
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import grouped
from rocksteady.cli.flags.sweep import resumable_study

if TYPE_CHECKING:
    from rocksteady.studies.tso_wong_1989.study import Study

HELP = (
    "Compute every figure and statement of Tso and Wong (1989).\n\n"
    "Every figure of Tso and Wong (1989) and every statement that can be checked, computed.\n\n"
    "Writes figures as PNG, SVG and PDF with their data as CSV, claims.json with a verdict on "
    "each statement, and report.html, which shows it all in one file. Takes about half a "
    "minute; finished figures are kept in the folder, and --resume continues after whatever "
    "ended the run."
)
EXAMPLES = (
    "Examples:\n\n"
    "rocksteady paper --out tso-wong-1989\n\n"
    "rocksteady paper --only 12b --only 12c --out figures"
)


@grouped
def paper(
    context: typer.Context,
    out: Path = options.out_folder(),
    only: list[str] | None = options.output_flag(
        "--only FIGURE", "Only this figure, as 12b, without statements and report; may be repeated."
    ),
    force: bool = options.force(),
    resume: bool = options.resume_study(),
    as_json: bool = options.as_json(),
) -> None:
    """Run `rocksteady paper`; `HELP` is what its users read."""
    from rocksteady.studies.tso_wong_1989.study import check_folder, parts_of, reproduce, steps
    from rocksteady.sweep.cases.queue import usable_cores

    figures = only or []
    check_folder(out, figures, force=force or resume)
    parts = parts_of(figures, out, resume=resume, force=force)
    announce_compilation("attractors.settle_cells")
    with resumable_study(parts, context):
        with progress("computing", steps(figures)) as done:
            study = reproduce(only=figures, done=done)
        with progress("drawing", study.steps) as done:
            files = study.save(
                out, force=force or resume, parts=parts, done=done, processes=usable_cores()
            )
    parts.remove()
    if as_json:
        names = [file.name for file in files]
        print_json("paper", {**study.values(), "out": str(out), "files": names})
    else:
        print_summary(study, out, files)


def print_summary(study: "Study", out: Path, files: list[Path]) -> None:
    """Print what came out and where to look."""
    from rich.table import Table

    from rocksteady.studies.tso_wong_1989.claims.findings import corrected

    console = terminal.console()
    if study.claims:
        counts = ", ".join(
            f"{count} {verdict.replace('-', ' ')}" for verdict, count in study.counts().items()
        )
        console.print(f"{len(study.claims)} statements: {counts}")
        table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
        table.add_column(no_wrap=True)
        table.add_column()
        for claim in corrected(study.claims):
            table.add_row(claim.id, claim.statement)
        console.print("not as the paper says:", style="sentence")
        terminal.console(wrap=True).print(table)
    console.print(f"{len(files)} files in {out}")
    for file in files:
        if file.name == "report.html":
            console.print(f"open {file}")
