"""Print constraints that hold every dependency at its lower bound in `pyproject.toml`.

What the dependencies need themselves is held at or below the versions of `constraints.txt`, so that
the floor stays the same until one of the two files changes. Run by `make test-floor`.
"""

import re
import sys
import tomllib
from pathlib import Path
from typing import Any

HELD = {"pyparsing": "3.2.5"}
"""Of what the dependencies need, releases before those that deprecate what a floor calls: the
warning is an error in the tests, and users never see it. pyparsing 3.3: Matplotlib 3.10.0."""
ROOT = Path(__file__).parents[1]
BOUND = re.compile(
    r"([A-Za-z0-9._-]+) >= ([0-9][0-9.]*)(?:, < [0-9][0-9.]*)?(?:; sys_platform != '[a-z0-9]+')?"
)


def floor(project: dict[str, Any]) -> dict[str, str]:
    """Return the lowest allowed version of each direct dependency, extras included.

    Parameters
    ----------
    project
        `pyproject.toml` as read by `tomllib`.

    Raises
    ------
    SystemExit
        If a requirement has no lower bound, or two of one package differ.
    """
    lists = [
        project["build-system"]["requires"],
        project["project"]["dependencies"],
        *project["project"]["optional-dependencies"].values(),
    ]
    lowest: dict[str, str] = {}
    for requirement in (requirement for some in lists for requirement in some):
        bound = BOUND.fullmatch(requirement)
        if bound is None:
            sys.exit(f"pyproject.toml: '{requirement}' is no lower bound such as 'numpy >= 2.0'")
        name, version = canonical(bound[1]), bound[2]
        if lowest.setdefault(name, version) != version:
            sys.exit(f"pyproject.toml: {name} has two bounds, {lowest[name]} and {version}")
    return lowest


def canonical(name: str) -> str:
    """Return the name of a package as the index spells it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def lines(project: str, constraints: str) -> list[str]:
    """Return the constraints, given the texts of `pyproject.toml` and `constraints.txt`."""
    lowest = floor(tomllib.loads(project))
    pins = re.findall(r"^([^#=\s]+)==(\S+)$", constraints, re.MULTILINE)
    return [f"{name}=={version}" for name, version in lowest.items()] + [
        f"{name}<={HELD.get(name, version)}"
        for name, version in pins
        if canonical(name) not in lowest
    ]


if __name__ == "__main__":
    texts = (
        (ROOT / name).read_text(encoding="utf-8") for name in ("pyproject.toml", "constraints.txt")
    )
    print("\n".join(lines(*texts)))
