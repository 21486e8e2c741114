"""`rocksteady paper`: every figure and statement of Tso and Wong (1989), recomputed."""

from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING

import typer

from rocksteady.cli.console.progress import progress
from rocksteady.cli.console.shell import quoted
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import ScreenFlags, grouped
from rocksteady.cli.flags.study import resumable_study
from rocksteady.results.description import Column, Description, Table, left_out, line
from rocksteady.results.numbers import plural

if TYPE_CHECKING:
    from rocksteady.studies.tso_wong_1989._study import Study

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

SHOWN = 2
"""Corrected statements of the answer."""


@grouped
def paper(
    context: typer.Context,
    out: Path = options.out_folder(),
    only: list[str] | None = options.output_flag(
        "--only FIGURE", "Only this figure, as 12b, without statements and report; may be repeated."
    ),
    force: bool = options.force(),
    resume: bool = options.resume_study(),
    *,
    output: ScreenFlags,
) -> None:
    """Run `rocksteady paper`; `HELP` is what its users read."""
    from rocksteady.studies.tso_wong_1989._study import check_folder, parts_of, reproduce, steps
    from rocksteady.sweep.cases.queue import usable_cores

    figures = only or []
    check_folder(out, figures, force=force or resume)
    parts = parts_of(figures, out, resume=resume, force=force)
    with resumable_study(parts, context):
        with progress("computing", steps(figures)) as done:
            study = reproduce(only=figures, done=done)
        with progress("drawing", study.steps) as done:
            files = study.save(
                out, force=force or resume, parts=parts, done=done, processes=usable_cores()
            )
    values = {**study.values(), "out": str(out), "files": [file.name for file in files]}
    output.leave("paper", described(study, out, files), values=values)


def described(study: "Study", out: Path, files: list[Path]) -> Description:
    """Return how many statements hold, which are corrected, and where to look."""
    from rocksteady.studies.tso_wong_1989.claims.findings import corrected

    written = f"{len(files)} in {out}"
    if not study.claims:
        sentence = f"Wrote {written.replace(' in', ' files of the figures into')}."
        return Description(sentence, sentence=sentence)
    wrong, counts = corrected(study.claims), study.counts()
    sentence = (
        f"{counts['reproduced']} of {len(study.claims)} statements of Tso and Wong (1989) hold; "
        f"{counts['corrected']} are corrected."
    )
    rest = left_out(max(len(wrong) - SHOWN, 0))
    open_ = plural(counts["not-checkable"], "statement")
    facts = [
        *(
            line("" if row else "corrected", shorten(f"{claim.id}: {claim.statement}", 61))
            for row, claim in enumerate(wrong[:SHOWN])
        ),
        line(rest.label, f"{rest.words}; {open_} cannot be checked"),
        line("files", written),
    ]
    rows = [{"id": claim.id, "statement": claim.statement} for claim in wrong]
    columns = [Column("id", "", left=True), Column("statement", "", left=True)]
    page = quoted(out / "report.html")
    return Description(
        sentence,
        facts,
        tables=[Table("", rows, columns, title="Not as the paper says", most=len(rows))],
        sentence=sentence,
        follow_up=f"python3 -m webbrowser {page}",
    )
