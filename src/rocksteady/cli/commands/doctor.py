"""`rocksteady doctor`: what runs the kernels here, and whether it computes the right bits."""

import os
import re
from importlib.metadata import distributions, requires
from pathlib import Path
from typing import TYPE_CHECKING

from rocksteady.cli.console.outputs import NEGATIVE, announce_file
from rocksteady.cli.flags import options
from rocksteady.cli.flags.groups import ScreenFlags, check_ending, grouped
from rocksteady.show.export.files import check_writable, save_text

if TYPE_CHECKING:
    from rocksteady.installation.check import Installation

HELP = (
    "Check that this installation computes the right bits.\n\n"
    "Check this installation: repeat recorded calls of every kernel, and compare all bits.\n\n"
    "Prints what runs the kernels (a library compiled ahead of time, or plain Python), for which "
    "processor, the versions, the GPU of --executor gpu or why there is none, and for each "
    "kernel that differs how many values do. The results are the same to the last bit on every "
    "processor and system.\n\n"
    "--report writes what a report of a fault needs into a file, and sends it to no one."
)
EXAMPLES = (
    "Examples:\n\nrocksteady doctor\n\nrocksteady doctor --check --json\n\n"
    "rocksteady doctor --report report.md"
)
VARIABLE = "ROCKSTEADY_"
"""Begin of the environment variables that change what runs."""


@grouped
def doctor(
    check: bool = options.output_flag(
        "--check", "Leave with exit code 1 where a value differs.", default=False
    ),
    report: Path | None = options.output_flag(
        "--report FILE", "Save a report for an issue, with the home folder as ~: .md or .txt."
    ),
    force: bool = options.force(),
    *,
    output: ScreenFlags,
) -> int:
    """Run `rocksteady doctor`; `HELP` is what its users read."""
    check_ending("--report", report, ".md", ".txt")
    if report is not None:
        check_writable("--report", report, force=force)
    from rocksteady.installation.check import check_installation

    installation = check_installation()
    output.leave("doctor", installation.describe())
    if report is not None:
        save_text("--report", report, report_text(installation))
        announce_file(report)
    return NEGATIVE if check and not installation.equal else 0


def report_text(installation: "Installation") -> str:
    """Return the report of an installation: all facts, dependencies, variables; in Markdown.

    The home folder is written as ``~``.
    """
    needed = [each for each in requires("rocksteady") or () if "extra ==" not in each]
    names = sorted({_name(each) for each in needed})
    installed = {_name(each.metadata["Name"]): each.version for each in distributions()}
    versions = [f"{name:16} {installed[name]}" for name in names if name in installed]
    variables = [f"{name}={os.environ[name]}" for name in sorted(os.environ) if VARIABLE in name]
    parts = [installation.summary(more=True).rstrip(), *versions, *variables]
    text = "\n".join(parts).replace(str(Path.home()), "~")
    return f"```text\n{text}\n```\n"


def _name(requirement: str) -> str:
    """Return the name of the package that a requirement begins with."""
    return re.split(r"[^\w.-]", requirement, maxsplit=1)[0].lower().replace("_", "-")
