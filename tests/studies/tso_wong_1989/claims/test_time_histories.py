"""Statements on Figs 8 to 13: each verdict turns with its evidence, and the numbers are right."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rocksteady.studies.tso_wong_1989.claims import _time_histories as time_histories
from rocksteady.studies.tso_wong_1989.claims._time_histories import fate_finding, stable_finding
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence
from rocksteady.studies.tso_wong_1989.figures.fates import Kind
from rocksteady.studies.tso_wong_1989.figures.histories import History
from tests.dynamics.formulae import printed, printed_trace
from tests.every import every
from tests.studies.tso_wong_1989.whole import (
    STABLE,
    evidence,
    finding,
    found,
    higher,
    values,
    with_histories,
)

pytestmark = pytest.mark.usefixtures("computed")

Tamper = Callable[[pytest.MonkeyPatch], Evidence]


def on_one_side(name: str, side: int) -> History:
    """A history whose fates on both sides are those of one."""
    true = evidence().histories[name]
    other = History(case=true.case)
    fates = true.fates_over_kicks[side]
    other.__dict__["fates_over_kicks"] = {1: fates, -1: fates}
    other.__dict__["fates"] = {1: true.fates[side], -1: true.fates[side]}
    return other


FALSE: dict[str, Tamper] = {
    "fig-8a": lambda _: with_histories(figure_8a="12d"),
    "fig-8b": lambda _: with_histories(figure_8b="13c"),
    "fig-8c": lambda _: with_histories(figure_8c="13c"),
    "fig-9a": lambda _: with_histories(figure_9a="12d"),
    "fig-9b": lambda _: with_histories(figure_9b="8c"),
    "fig-9c": lambda _: with_histories(figure_9c=on_one_side("9c", 1)),
    "fig-10": lambda _: with_histories(figure_10="11a"),
    "E3": lambda _: with_histories(figure_11a="11b"),
    "fig-11b": lambda _: with_histories(figure_11b="11a"),
    "fig-12a": lambda _: with_histories(figure_12a="12b"),
    "fig-12b": lambda _: with_histories(figure_12b="12d"),
    "fig-12c": lambda _: with_histories(figure_12c="12b"),
    "fig-12d": lambda _: with_histories(figure_12d="12b"),
    "fig-13a": lambda _: with_histories(figure_13a="13b"),
    "fig-13b": lambda _: with_histories(figure_13b="13c"),
    "fig-13c": lambda _: with_histories(figure_13c="13b"),
    "fig-13d": lambda _: with_histories(figure_13d="12d"),
}
"""Evidence on which the verdict on a statement must be the other one."""


@every("name", FALSE)
def test_a_verdict_turns_with_its_evidence(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    true = finding(name)
    false = found(name, FALSE[name](monkeypatch))
    assert bool(false.holds) is not bool(true.holds)
    assert false.detail != true.detail


@every("name", ["fig-8a", "fig-8b", "fig-8c", "fig-9a", "fig-9c"])
def test_the_paper_would_be_right_on_one_side(name: str) -> None:
    figure = name.removeprefix("fig-")
    holds = {
        side: found(name, with_histories(**{f"figure_{figure}": on_one_side(figure, side)})).holds
        for side in (1, -1)
    }
    assert holds[-1] is False
    assert holds[1] is (name in {"fig-8a", "fig-8c", "fig-9c"})


def test_a_stable_motion_has_no_fate_that_it_is_left_for() -> None:
    stable = evidence().histories["10"]
    for kind in Kind:
        assert not fate_finding(stable, kind).holds


def test_one_run_of_all_that_ends_otherwise_is_enough_for_a_correction() -> None:
    true = evidence().histories["12d"]
    assert fate_finding(true, Kind.OVERTURNED).holds
    runs = {side: list(fates) for side, fates in true.fates_over_kicks.items()}
    runs[-1][17] = replace(runs[-1][17], kind=Kind.REST, overturned_after=math.nan)
    other = History(case=true.case)
    other.__dict__["fates_over_kicks"] = runs
    assert not fate_finding(other, Kind.OVERTURNED).holds


# ------------------------------------------------------------------------------------------ E3


def test_e3_figure_11a_is_unstable_and_its_attractor_is_unsymmetric() -> None:
    solution = printed(4.0, 6.0, 0.8, 3, 1)
    trace = printed_trace(4.0, 6.0, 0.8, 3, solution.sine, solution.velocity)
    multiplier = 0.5 * trace - math.sqrt(0.25 * trace**2 - 0.64)
    assert multiplier == pytest.approx(-1.182, abs=5.1e-4)
    came = values("E3")
    assert came["multiplier"] == pytest.approx([multiplier, 0.0], abs=1e-8)
    peaks = sorted((abs(float(str(came["highest"]))), abs(float(str(came["lowest"])))))
    assert peaks == pytest.approx([0.27242, 0.39815], abs=1.1e-5)
    assert came["peak"] == pytest.approx(0.33694, abs=5.1e-6)


def test_stability_is_not_taken_from_a_run_alone() -> None:
    # Within the window of the paper the run of Fig 11a stays next to the unstable orbit.
    history = evidence().histories["11a"]
    states_ = history.states
    assert states_.peak is not None
    for run in history.runs.values():
        periods = run.times(60)
        early = np.abs(run(periods[periods < 0.5 * run.end_time_pt]).angle).max()
        assert early == pytest.approx(float(states_.peak[0]), abs=5e-3)
    assert not stable_finding(history).holds
    for name in STABLE:
        assert stable_finding(evidence().histories[name]).holds


def test_a_run_that_seems_to_stay_does_not_make_an_unstable_motion_stable(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    history = evidence().histories["11a"]
    assert history.states.peak is not None
    stayed = higher(evidence().histories["11b"].fates[1], float(history.states.peak[0]))
    monkeypatch.setattr(time_histories, "settle", lambda *_, **__: stayed)
    assert not stable_finding(history).holds
