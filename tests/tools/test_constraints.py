"""The pins: every Python and system that is supported can install them."""

import subprocess
import sys
import tomllib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import PackageNotFoundError, distribution
from itertools import product
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
PYTHONS = ("3.11.0", "3.12.0", "3.13.0", "3.14.0")
SYSTEMS = {"linux": "linux", "macos": "darwin", "windows": "win32"}
"""Name of each system for uv, and `sys.platform` there."""


def pins() -> Iterator[Requirement]:
    for line in (ROOT / "constraints.txt").read_text("utf-8").splitlines():
        if not line.startswith("#"):
            yield Requirement(line)


def declared() -> Iterator[Requirement]:
    """What pyproject.toml asks for, extras included."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    lists = [project["build-system"]["requires"], project["project"]["dependencies"]]
    for each in (*lists, *project["project"]["optional-dependencies"].values()):
        yield from map(Requirement, each)


def applies(pin: Requirement, python: str, system: str) -> bool:
    environment = {
        "python_version": python.rpartition(".")[0],
        "python_full_version": python,
        "sys_platform": SYSTEMS[system],
        "implementation_name": "cpython",
        "platform_python_implementation": "CPython",
    }
    return pin.marker is None or pin.marker.evaluate(environment)


def test_every_installed_pin_admits_every_python() -> None:
    refusing, read = [], 0
    for pin in pins():
        try:
            found = distribution(pin.name)
        except PackageNotFoundError:
            continue
        if not pin.specifier.contains(found.version):
            continue  # the pin of another Python
        read += 1
        (asked,) = found.metadata.get_all("Requires-Python") or [""]
        allowed = Requirement(f"python{asked}").specifier
        refusing += [
            f"{pin} refuses Python {python}"
            for python, system in product(PYTHONS, SYSTEMS)
            if applies(pin, python, system) and not allowed.contains(python)
        ]
    assert refusing == []
    assert read > 100


def test_one_version_of_each_package_is_pinned_everywhere() -> None:
    for python, system in product(PYTHONS, SYSTEMS):
        names = [canonicalize_name(pin.name) for pin in pins() if applies(pin, python, system)]
        assert len(names) == len(set(names))


def test_every_declared_dependency_is_pinned_within_its_bounds() -> None:
    versions: dict[str, list[str]] = {}
    for pin in pins():
        versions.setdefault(canonicalize_name(pin.name), []).append(str(pin.specifier)[2:])
    for asked in declared():
        pinned = versions[canonicalize_name(asked.name)]
        assert all(map(asked.specifier.contains, pinned)), asked
        assert any(each.operator in {">=", "~="} for each in asked.specifier), asked


@pytest.mark.slow
def test_every_pin_has_a_wheel_for_every_python_and_system() -> None:
    """uv reads Requires-Python and the wheels of each pin, also of those of other systems."""

    def refusal(case: tuple[str, str]) -> str:
        python, system = case
        command = ["pip", "compile", "--quiet", "--no-deps", "--only-binary", ":all:"]
        command += ["--python-version", python, "--python-platform", system, "constraints.txt"]
        command = [sys.executable, "-m", "uv", *command]
        ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        return f"{case}: {ran.stderr}" if ran.returncode else ""

    with ThreadPoolExecutor(4) as pool:
        refusals = list(filter(None, pool.map(refusal, product(PYTHONS, SYSTEMS))))
    if any("Failed to fetch" in each for each in refusals):
        pytest.skip("no package index is reached: connect to the network")
    assert refusals == []
