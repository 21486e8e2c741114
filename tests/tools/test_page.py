"""The check of the page's types: what it runs, and what it says where it cannot."""

import stat
import sys
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
    monkeypatch.setattr(program, "bundler", list)
    return tmp_path


def left_out(folder: Path) -> str:
    """Return what the check says that it could not run."""
    assert main() == 0
    return (folder / "not-run" / "types").read_text("utf-8")


def test_without_tsc_and_bun_the_check_is_left_out_and_says_so(folder: Path) -> None:
    said = "the page's types (there is neither tsc nor bun: npm install -g typescript)\n"
    assert left_out(folder) == said


def test_without_tsc_bun_runs_it(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(folder, "5.9.3", 2)
    bun = folder / "bun"
    bun.write_text(f'#!/bin/sh\necho "$1 $2 $3 $4"> {folder}/run\nshift 4\n{folder}/as-tsc "$@"\n')
    (folder / "tsc").rename(folder / "as-tsc")
    bun.chmod(bun.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setattr(program, "bundler", lambda: [str(bun)])
    assert main() == 2
    assert (folder / "run").read_text().split() == ["x", "--package", program.TYPESCRIPT, "tsc"]
    assert (folder / "asked").read_text().split() == ["--project", str(PROJECT)]


def test_a_bun_that_cannot_download_tsc_is_named(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(program, "bundler", lambda: [sys.executable, "-c", "raise SystemExit(1)"])
    assert "bun cannot download typescript@5.9.3" in left_out(folder)


def test_a_tsc_that_cannot_read_the_modules_is_named(folder: Path) -> None:
    pretend(folder, "4.8.4")
    assert "Version 4.8.4 of tsc is older than 5.5" in left_out(folder)
    assert not (folder / "asked").exists()


@pytest.mark.parametrize("status", [0, 2])
def test_its_verdict_is_that_of_tsc(folder: Path, status: int) -> None:
    pretend(folder, "5.10.1", status)
    assert main() == status
    assert (folder / "asked").read_text().split() == ["--project", str(PROJECT)]
