"""`rocksteady doctor`: what runs the kernels here, and whether it computes the right bits."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from rocksteady.cli.console import terminal
from rocksteady.cli.console.outputs import announce_compilation, print_json
from rocksteady.cli.flags import options
from rocksteady.cli.present.shared import plural

if TYPE_CHECKING:
    from rocksteady.installation.check import Installation

HELP = (
    "Check this installation: repeat recorded calls of every kernel, and compare all bits.\n\n"
    "Prints what runs the kernels (a library compiled ahead of time, or numba), for which "
    "processor, the versions, and for each kernel that differs how many values do. The results "
    "are the same to the last bit on every processor and system."
)
EXAMPLES = "Examples:\n\nrocksteady doctor\n\nrocksteady doctor --check --json"
DIFFERENT = 1
"""Exit code with --check where a value differs."""
RUNNERS = {
    "library": "library, compiled ahead of time",
    "jit": "compiled by numba on this machine",
    "python": "plain Python, not compiled",
}

CheckFlag = Annotated[
    bool,
    typer.Option(
        "--check",
        help="Leave with exit code 1 where a value differs.",
        rich_help_panel=options.OUTPUT,
    ),
]


def doctor(check: CheckFlag = False, as_json: options.Json = False) -> int:
    """Run `rocksteady doctor`; `HELP` is what its users read."""
    announce_compilation("attractors.settle_cells")
    from rocksteady.installation.check import check_installation

    found = check_installation()
    if as_json:
        print_json("doctor", values(found))
    else:
        print_found(found)
    return DIFFERENT if check and not found.equal else 0


def values(found: "Installation") -> dict[str, Any]:
    """Return what --json prints."""
    return {
        "equal": found.equal,
        "system": found.system,
        "cpu_level": found.cpu_level,
        "kernels": found.kernels,
        "library": None if found.library is None else str(found.library),
        "target": found.target,
        "cache": None if found.cache is None else str(found.cache),
        "sources": found.sources,
        "versions": found.versions,
        "calls": found.calls,
        "values": found.values,
        "differing": found.differing,
        "checks": [
            {
                "kernel": check.name,
                "equal": check.equal,
                "calls": check.calls,
                "values": check.values,
                "differing": check.differing,
                "first_difference": check.first_difference,
            }
            for check in found.checks
        ],
    }


def print_found(found: "Installation") -> None:
    """Print what runs the kernels, and the kernels that differ."""
    console = terminal.console()
    numba = found.versions["numba"]
    rows = [
        ("rocksteady", f"{found.versions['rocksteady']}"),
        (
            "runs on",
            f"Python {found.versions['python']}, NumPy {found.versions['numpy']}, "
            + (f"numba {numba}" if numba else "no numba"),
        ),
        ("system", f"{found.system}, CPU level {found.cpu_level or 'unknown'}"),
        ("kernels", RUNNERS[found.kernels]),
        ("sources", found.sources),
    ]
    if found.library is not None:
        rows += [("target", str(found.target)), ("library", str(found.library))]
    if found.cache is not None:
        rows.append(("cache", str(found.cache)))
    for name, text in rows:
        console.print(f"{name:<11} {text}")
    wrong = [check for check in found.checks if not check.equal]
    console.print(
        f"\nrepeated {plural(found.calls, 'recorded call')} of "
        f"{plural(len(found.checks), 'kernel')}, {found.values:,} values:"
    )
    if not wrong:
        console.print("all equal, bit for bit", style="bold")
        return
    console.print(
        f"{found.differing:,} values of {plural(len(wrong), 'kernel')} differ; "
        f"the other {plural(len(found.checks) - len(wrong), 'kernel')} equal",
        style="bold",
    )
    for check in wrong:
        console.print(
            f"\n{check.name}: {check.differing:,} of {check.values:,} values differ; the first in\n"
            f"  {check.first_difference}"
        )
