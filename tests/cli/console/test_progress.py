"""Progress: lines where nobody watches, a bar on a terminal, on standard error alone."""

import io
import re
import sys
from itertools import pairwise

import pytest

from rocksteady.cli.console import terminal
from rocksteady.cli.console.progress import Meter, clock_text, progress, sweeping
from tests.every import every


def said(steps: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    monkeypatch.setattr("rocksteady.cli.console.progress.time.monotonic", lambda: 0.0)
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


@every("steps", [1, 2, 3, 7, 9, 11, 23, 101, 999])
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
    monkeypatch.setattr("rocksteady.cli.console.progress.time.monotonic", lambda: now)
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


class Clock:
    """A time that stands still until it is moved."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 100.0
        monkeypatch.setattr("rocksteady.cli.console.progress.time.monotonic", lambda: self.now)


def test_a_meter_counts_what_is_computed_and_how_long_it_takes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    clock = Clock(monkeypatch)
    meter = Meter(1000, lambda _: None)
    assert (meter.rate, meter.text) == (0.0, "")
    clock.now += 7.0  # until the first cell: not counted
    meter(400)
    for _ in range(4):
        clock.now += 2.0
        meter(50)
    assert (meter.there, meter.computed, meter.passed) == (400, 200, 600)
    assert meter.seconds == 8.0
    assert meter.rate == 25.0
    assert meter.text == "25 cells/s, 0:16 left"
    for _ in range(4):
        clock.now += 1.0
        meter(100)
    assert meter.text.endswith("cells/s")


def test_the_rate_is_that_of_the_last_half_minute(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock(monkeypatch)
    meter = Meter(10**9, lambda _: None)
    meter(0)
    for cells in (1000, 10):
        for _ in range(100):
            clock.now += 1.0
            meter(cells)
    assert meter.rate == pytest.approx(10.0)


@every(("cells", "said"), [(9000, False), (20_000, True)])
def test_a_run_of_more_than_a_minute_suggests_once_what_is_faster(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], cells: int, said: bool
) -> None:
    clock = Clock(monkeypatch)
    meter = Meter(cells, lambda _: None)
    terminal.suggest("--model linear")
    meter(0)
    for _ in range(60):  # 150 cells a second: 58 s or 131 s are left when that is known
        clock.now += 1.0
        meter(150)
    assert capsys.readouterr().err == ("rocksteady: --model linear\n" if said else "")
    terminal.suggest("--model linear")
    terminal.drop_notes()
    terminal.say_suggestion()
    assert capsys.readouterr().err == ""


@every(
    ("seconds", "text"),
    [(0.4, "0:00"), (7.0, "0:07"), (61.0, "1:01"), (3599.6, "1:00:00"), (40_000.0, "11:06:40")],
)
def test_times_are_read_as_off_a_clock(seconds: float, text: str) -> None:
    assert clock_text(seconds) == text


def test_a_sweep_says_a_line_each_tenth_with_its_rate(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = Clock(monkeypatch)
    with sweeping("following motions", 2000) as meter:
        meter(1000)
        for _ in range(100):
            clock.now += 0.25
            meter(10)
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "following motions: 1,200 of 2,000 cells (60 %), 40 cells/s, 0:20 left"
    assert lines[-1] == "following motions: 2,000 of 2,000 cells (100 %), 40 cells/s"
    assert len(lines) == 5


def test_a_sweep_that_is_over_at_once_says_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = Clock(monkeypatch)
    with sweeping("following motions", 10) as meter:
        meter(0)
        for _ in range(10):
            clock.now += 0.1
            meter(1)
    assert capsys.readouterr() == ("", "")


def test_a_sweep_says_a_line_when_cells_take_long(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = Clock(monkeypatch)
    with sweeping("following motions", 10_000) as meter:
        meter(0)
        for _ in range(9):
            clock.now += 10.0
            meter(1)
    lines = capsys.readouterr().err.splitlines()
    assert [line.split()[2] for line in lines] == ["3", "6", "9"]


def test_on_a_terminal_a_sweep_shows_its_rate(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "100")
    clock = Clock(monkeypatch)
    with sweeping("following motions", 2000) as meter:
        meter(0)
        clock.now += 2.0
        meter(1000)
        meter(1000)
    text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", terminal.getvalue())
    assert "2,000 of 2,000" in text
    assert "1,000 cells/s" in text


def test_a_sweep_that_is_run_again_has_more_cells_and_no_time_below_none() -> None:
    meter = Meter(100, lambda _: None)
    for cells in (0, 60, 40, 0, 30):
        meter(cells)
    assert (meter.passed, meter.cells) == (130, 200)
