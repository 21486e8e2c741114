"""The check of the page's types: what it runs, and what it says where it cannot."""

import stat
from pathlib import Path

import pytest

from tools.page import __main__ as program
from tools.page.__main__ import PROJECT, main


def pretend(folder: Path, version: str, status: int = 0) -> None:
    """Write a tsc that answers its version, and otherwise keeps its arguments."""
    tsc = folder / "tsc"
    tsc.write_text(
        f'#!/bin/sh\nif [ "$1" = --version ]; then echo "Version {version}"; exit 0; fi\n'
        f'echo "$@" > {folder}/asked\nexit {status}\n'
    )
    tsc.chmod(tsc.stat().st_mode | stat.S_IXUSR)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("TSC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(program, "NOT_RUN", tmp_path / "not-run" / "types")
    return tmp_path


def left_out(folder: Path) -> str:
    """Return what the check says that it could not run."""
    assert main() == 0
    return (folder / "not-run" / "types").read_text("utf-8")


def test_without_tsc_the_check_is_left_out_and_says_so(folder: Path) -> None:
    said = "the page's types (there is no tsc: npm install -g typescript)\n"
    assert left_out(folder) == said


def test_a_tsc_that_cannot_read_the_modules_is_named(folder: Path) -> None:
    pretend(folder, "4.8.4")
    assert "Version 4.8.4 of tsc is older than 5.5" in left_out(folder)
    assert not (folder / "asked").exists()


@pytest.mark.parametrize("status", [0, 2])
def test_its_verdict_is_that_of_tsc(folder: Path, status: int) -> None:
    pretend(folder, "5.10.1", status)
    assert main() == status
    assert (folder / "asked").read_text().split() == ["--project", str(PROJECT)]
