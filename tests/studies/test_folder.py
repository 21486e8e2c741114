"""What a study runs on, in its own words."""

import platform
from dataclasses import replace
from importlib.metadata import version

import pytest

import rocksteady as rs
from rocksteady.installation import check_installation
from rocksteady.studies import folder


def environment_with(runs: str, monkeypatch: pytest.MonkeyPatch, target: str | None = None) -> str:
    here = replace(check_installation(repeat_calls=False), kernels=runs, target=target)
    monkeypatch.setattr(rs.installation, "check_installation", lambda **_: here)
    return folder.environment()


def test_a_study_says_what_it_runs_on(monkeypatch: pytest.MonkeyPatch) -> None:
    said = environment_with("jit", monkeypatch).split(", ")
    assert said == [
        f"Python {platform.python_version()}",
        f"numpy {version('numpy')}",
        f"numba {version('numba')}",
        f"matplotlib {version('matplotlib')}",
        f"{platform.system()} on {platform.machine()}",
    ]


def test_a_study_that_runs_without_numba_names_none(monkeypatch: pytest.MonkeyPatch) -> None:
    said = environment_with("library", monkeypatch, "linux-aarch64")
    assert "kernels compiled for linux-aarch64" in said
    assert "numba" not in said
    assert "kernels not compiled" in environment_with("python", monkeypatch)
