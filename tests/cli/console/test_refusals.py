"""Flags that are refused before a command sees them: paths that lead nowhere or somewhere else."""

from pathlib import Path

import pytest

from tests.cli.program import refused

EMPTY = {
    "paper --out": "--out",
    "study atlas --restitution 0.8 --out": "--out",
    "map -A 0.1:6:4 -W 0.2:8:4 -r 0.8 --out": "--out",
    "map -A 0.1:6:4 -W 0.2:8:4 -r 0.8 --netcdf": "--netcdf",
    "steady -A 1.2 -W 3 -r 0.8 --plot": "--plot",
    "simulate -A 1.2 -W 3 -r 0.8 --csv": "--csv",
    "simulate -A 1.2 -W 3 -r 0.8 --animate": "--animate",
    "simulate --width-m 0.5 --height-m 2 --record": "--record",
    "simulate --width-m 0.5 --height-m 2 --record a.AT2 --vertical": "--vertical",
    "spectrum --alpha-rad 0.2 --record a.AT2 --record": "--record",
    "record a.AT2": "FILE",
}
"""Command lines up to a path, and what the path is called in errors."""


@pytest.mark.parametrize(("command", "flag"), EMPTY.items())
def test_an_empty_path_does_not_mean_this_folder(
    command: str, flag: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert refused(command, "") == f"rocksteady: {flag} is empty: it takes a path; name one"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("command", "flag"), EMPTY.items())
@pytest.mark.parametrize("name", ["a" * 300 + ".png", "é" * 128, "a" * 256 + "/a.png"])
def test_a_name_that_no_system_takes_is_refused_by_its_flag(
    command: str, flag: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    line = refused(command, name)
    assert line.startswith(f"rocksteady: {flag} = ")
    assert line.endswith("is not accepted: names in a path have at most 255 bytes; shorten it")
    assert list(tmp_path.iterdir()) == []
