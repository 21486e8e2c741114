"""The check of the page's types: what it runs, and what it says where it cannot."""

import stat
from pathlib import Path

import pytest

from tools.page.__main__ import PROJECT, main


def pretend(folder: Path, version: str, status: int = 0) -> None:
    """Write a tsc that answers its version, and otherwise keeps its arguments."""
    program = folder / "tsc"
    program.write_text(
        f'#!/bin/sh\nif [ "$1" = --version ]; then echo "Version {version}"; exit 0; fi\n'
        f'echo "$@" > {folder}/asked\nexit {status}\n'
    )
    program.chmod(program.stat().st_mode | stat.S_IXUSR)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("TSC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    return tmp_path


def test_without_tsc_the_check_is_left_out_and_says_so(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert folder.is_dir()
    assert main() == 0
    assert "not checked: there is no tsc" in capsys.readouterr().out


def test_a_tsc_that_cannot_read_the_modules_is_named(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pretend(folder, "4.8.4")
    assert main() == 0
    assert "Version 4.8.4 is older than 5.5" in capsys.readouterr().out
    assert not (folder / "asked").exists()


@pytest.mark.parametrize("status", [0, 2])
def test_its_verdict_is_that_of_tsc(folder: Path, status: int) -> None:
    pretend(folder, "5.10.1", status)
    assert main() == status
    assert (folder / "asked").read_text().split() == ["--project", str(PROJECT)]
