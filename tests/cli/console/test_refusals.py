"""Flags that are refused before a command sees them: given twice, without a value, empty paths."""

from pathlib import Path

import pytest

from rocksteady.cli.console.refusals import FlagError, both, missing
from rocksteady.errors import ModelError
from tests.cli.program import refused, rocksteady
from tests.every import every

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
    "record a.AT2": "record",
    "facade wall.toml --records": "--records",
}
"""Command lines up to a path, and what the path is called in errors."""


@every(("command", "flag"), EMPTY.items())
def test_an_empty_path_does_not_mean_this_folder(
    command: str, flag: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    line = refused(command, "")
    assert line.startswith(
        f"rocksteady: {flag} = '' is not accepted: it is empty, which would mean"
    )
    assert list(tmp_path.iterdir()) == []


@every(("command", "flag"), EMPTY.items())
@every("name", ["a" * 300 + ".png", "é" * 128, "a" * 256 + "/a.png"])
def test_a_name_that_no_system_takes_is_refused_by_its_flag(
    command: str, flag: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    line = refused(command, name)
    assert line.startswith(f"rocksteady: {flag} = ")
    assert line.endswith("is not accepted: names in a path have at most 255 bytes; shorten it")
    assert list(tmp_path.iterdir()) == []


def test_no_value_of_a_flag_is_dropped_or_taken_for_another(tmp_path: Path) -> None:
    line = refused("attractor -A 2 -W 4 -r 0.8 --start steady -n 1 -n 3")
    assert "--order/-n is given more than once ('1', '3')" in line
    assert "('2', '3')" in refused("steady -A2 --amplitude=3 -W 4 -r 0.8")
    assert rocksteady("steady -A 2 -A 3 --help").code == 0
    assert rocksteady("steady -A 2 -W 4 -r 0.8 --json --json").json
    assert "--csv is given without a value" in refused("steady -A 2 -W 4 -r 0.8 --csv --json")
    assert rocksteady(f"steady -A 2 -W 4 -r 0.8 --csv={tmp_path}/--json").code == 0


def test_a_refusal_names_a_flag_with_its_value_or_a_finding() -> None:
    one = FlagError("--phase", 1.5, "it has none", "leave it out")
    assert str(one) == "--phase = 1.5 is not accepted: it has none; leave it out"
    assert isinstance(one, ModelError)
    other = FlagError(finding="neither is given", valid="one is needed", hint="give one")
    assert str(other) == "neither is given: one is needed; give one"


def test_flags_that_are_missing_or_too_many_are_named() -> None:
    assert str(missing("-A", valid="it is needed", hint="add it")) == (
        "-A is not given: it is needed; add it"
    )
    assert str(both("-A", "--accel-g", valid="one is enough")) == (
        "-A and --accel-g are both given: one is enough; leave one out"
    )


def test_a_negative_value_is_no_flag_and_a_flag_no_value() -> None:
    line = refused("simulate -A 2 -W 4 -r 0.8 --start --cycles 5")
    assert "--start is given without a value: --cycles after it is a flag" in line
    assert rocksteady("simulate -A 2 -W 4 -r 0.8 --phase -1 --cycles 5 --json").code == 0
