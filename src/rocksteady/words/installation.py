"""Words of the check of an installation: what runs the kernels, and which differ."""

from rocksteady.installation.check import Installation
from rocksteady.results.description import Description, Fact, Table, line
from rocksteady.results.numbers import plural
from rocksteady.results.result import describes

FOLLOW_UP = "rocksteady simulate --width-m 0.6 --height-m 2 --start 0.6,0"
"""First command to run on a sound installation."""
RUNNERS = {"library": "library, compiled ahead of time", "python": "plain Python, not compiled"}


@describes(Installation)
def describe_installation(installed: Installation) -> Description:
    """Return what runs the kernels, and the kernels that differ."""
    wrong = [check for check in installed.checks if not check.equal]
    verdict = "all equal, bit for bit"
    if wrong:
        verdict = (
            f"{installed.differing:,} values of {plural(len(wrong), 'kernel')} differ; the other "
            f"{plural(len(installed.checks) - len(wrong), 'kernel')} equal"
        )
    library = None if installed.library is None else str(installed.library)
    runs_on = f"Python {installed.versions['python']}, NumPy {installed.versions['numpy']}"
    level = f"CPU level {installed.cpu_level or 'unknown'}"
    repeated = (
        f"{plural(installed.calls, 'recorded call')} of "
        f"{plural(len(installed.checks), 'kernel')}, {installed.values:,} values"
    )
    facts = (
        Fact("equal", installed.equal),
        Fact("", None, "rocksteady", str(installed.versions["rocksteady"])),
        Fact("versions", installed.versions, "runs on", runs_on),
        Fact("system", installed.system, "system", f"{installed.system}, {level}"),
        Fact("cpu_level", installed.cpu_level),
        Fact("kernels", installed.kernels, "kernels", RUNNERS[installed.kernels]),
        Fact("sources", installed.sources, "sources"),
        Fact("target", installed.target, "target" if library else ""),
        Fact("library", library, "library" if library else ""),
        Fact("gpu", installed.gpu, "GPU", installed.gpu or f"none: {installed.no_gpu}"),
        Fact("no_gpu", installed.no_gpu),
        Fact("calls", installed.calls),
        Fact("values", installed.values, "repeated", repeated),
        Fact("differing", installed.differing),
    )
    rows = [
        {
            "kernel": check.name,
            "equal": check.equal,
            "calls": check.calls,
            "values": check.values,
            "differing": check.differing,
            "first_difference": check.first_difference,
        }
        for check in installed.checks
    ]
    notes = tuple(
        f"{check.name}: {check.differing:,} of {check.values:,} values differ; the first in\n"
        f"  {check.first_difference}"
        for check in wrong
    )
    return Description(
        verdict,
        [*_screen(installed, runs_on), *facts],
        (Table("checks", rows),),
        notes,
        _sentence(installed, len(wrong)),
        follow_up="rocksteady doctor --more" if wrong else FOLLOW_UP,
    )


def _sentence(installed: Installation, wrong: int) -> str:
    """Return whether every value is the recorded one."""
    sentence = (
        f"All {installed.values:,} recorded values agree bit for bit: this installation is sound."
    )
    if wrong:
        sentence = (
            f"{installed.differing:,} of {installed.values:,} recorded values differ, in "
            f"{plural(wrong, 'kernel')}: this installation is faulty."
        )
    if not installed.checks:
        sentence = "No answer yet: no recorded call was repeated."
    return sentence


def _screen(installed: Installation, runs_on: str) -> list[Fact]:
    """Return what computes here, and what differs."""
    return [
        line("runs on", f"{runs_on}, {installed.cpu_level or installed.system}"),
        line("kernels", RUNNERS[installed.kernels]),
        line("GPU", installed.gpu or f"none: {installed.no_gpu}"),
        line("differing", ", ".join(each.name for each in installed.checks if not each.equal)),
    ]
