"""The lower bounds: as `pyproject.toml` has them, and none above what the checks run with."""

import re
import tomllib
from pathlib import Path

import pytest

from tests.every import every
from tools.floor import HELD, canonical, floor, lines

ROOT = Path(__file__).parents[2]
PROJECT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
CONSTRAINTS = (ROOT / "constraints.txt").read_text(encoding="utf-8")
EXAMPLE = """
[build-system]
requires = ["hatchling >= 1.27"]

[project]
dependencies = ["numpy >= 2.0", "SciPy >= 1.13"]

[project.optional-dependencies]
dev = ["pytest >= 8.3", "pytest_xdist >= 3.6.1"]
bench = ["pytest >= 8.3"]
"""


def release(version: str) -> tuple[int, ...]:
    return tuple(map(int, re.findall(r"\d+", version)))


def test_each_dependency_is_held_at_its_bound_and_the_rest_at_or_below_its_pin() -> None:
    pins = "# numpy==9\nnumpy==2.4.6\nclick==8.5.1\npyparsing==3.3.3\nPytest-XDist==3.8.0\n"
    assert lines(EXAMPLE, pins) == [
        "hatchling==1.27",
        "numpy==2.0",
        "scipy==1.13",
        "pytest==8.3",
        "pytest-xdist==3.6.1",
        "click<=8.5.1",
        f"pyparsing<={HELD['pyparsing']}",
    ]


@every(
    "requirement",
    ["numpy", "numpy == 2.0", "numpy < 3", "numpy >= 2.0; python_version < '3.12'"],
)
def test_a_requirement_that_is_no_lower_bound_is_refused(requirement: str) -> None:
    with pytest.raises(SystemExit, match=re.escape(f"'{requirement}' is no lower bound")):
        lines(EXAMPLE.replace("numpy >= 2.0", requirement), "")


def test_an_upper_bound_and_a_system_without_the_package_change_no_floor() -> None:
    bounded = EXAMPLE.replace("numpy >= 2.0", "numpy >= 2.0, < 3; sys_platform != 'darwin'")
    assert lines(bounded, "") == lines(EXAMPLE, "")


def test_two_bounds_of_one_package_are_refused() -> None:
    with pytest.raises(SystemExit, match=r"pytest has two bounds, 8\.3 and 8\.4"):
        lines(EXAMPLE.replace('bench = ["pytest >= 8.3"]', 'bench = ["pytest >= 8.4"]'), "")


def test_every_direct_dependency_is_pinned_at_or_above_its_bound() -> None:
    pins = dict(re.findall(r"^([^#=\s]+)==(\S+)$", CONSTRAINTS, re.MULTILINE))
    pinned = {canonical(name): version for name, version in pins.items()}
    bounds = floor(tomllib.loads(PROJECT))
    assert [name for name in bounds if name not in pinned] == []
    assert [name for name in bounds if release(pinned[name]) < release(bounds[name])] == []
    assert set(HELD) <= set(pinned) - set(bounds)
