"""Progress: lines where nobody watches, a bar on a terminal, on standard error alone."""

import io
import re
import sys
from itertools import pairwise

import pytest

from rocksteady.cli.progress import progress


def said(steps: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    monkeypatch.setattr("rocksteady.cli.progress.time.monotonic", lambda: 0.0)
    with progress("computing", steps) as done:
        for number in range(steps):
            done(f"step {number + 1}")
    out, err = capsys.readouterr()
    assert out == ""
    return str(err)


def test_a_line_is_due_after_each_tenth_and_at_the_end(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = said(100, monkeypatch, capsys).splitlines()
    assert len(lines) == 10
    assert lines[0] == "computing: 10 of 100 (10 %), step 10"
    assert lines[-1] == "computing: 100 of 100 (100 %), step 100"


@pytest.mark.parametrize("steps", [1, 2, 3, 7, 9, 11, 23, 101, 999])
def test_the_end_is_said_once_and_percents_rise(
    steps: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = said(steps, monkeypatch, capsys).splitlines()
    assert len(lines) <= 11
    percents = [int(re.findall(r"\((\d+) %\)", line)[0]) for line in lines]
    assert percents == sorted(set(percents))
    assert percents[-1] == 100
    counts = [int(re.findall(r": (\d+) of", line)[0]) for line in lines]
    assert counts[-1] == steps
    assert all(later - sooner >= 0.1 * steps for sooner, later in pairwise(counts[:-1]))


def test_a_line_is_due_when_a_step_takes_long(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    now = 0.0
    monkeypatch.setattr("rocksteady.cli.progress.time.monotonic", lambda: now)
    with progress("drawing", 1000) as done:
        for number in range(1, 6):
            now += 20.0
            done(f"step {number}")
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(", ")[1] for line in lines] == ["step 2", "step 4"]


def test_no_step_no_line(capsys: pytest.CaptureFixture[str]) -> None:
    with progress("computing", 0):
        pass
    assert capsys.readouterr() == ("", "")


class Terminal(io.StringIO):
    """What a terminal looks like to a program."""

    def isatty(self) -> bool:
        return True


def test_on_a_terminal_there_is_a_bar_on_standard_error(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "120")
    with progress("computing", 4) as done:
        for number in range(4):
            done(f"step {number + 1}")
    text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", terminal.getvalue())
    assert "computing" in text
    assert "4/4" in text.replace(" ", "")
    assert capsys.readouterr().out == ""


def test_an_error_passes_through_a_bar_and_through_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted() -> None:
        with progress("computing", 4) as done:
            done("step 1")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    monkeypatch.setattr(sys, "stderr", Terminal())
    with pytest.raises(KeyboardInterrupt):
        interrupted()
