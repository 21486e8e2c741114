"""Statements on stability: each verdict turns with its evidence, and the numbers are right."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rocksteady.formulas import steady_states
from rocksteady.orbits import SteadyStates
from rocksteady.studies.tso_wong_1989.claims import _stability as stability
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence
from rocksteady.studies.tso_wong_1989.figures.fates import Fate, Kind
from rocksteady.studies.tso_wong_1989.figures.histories import History
from tests.dynamics.formulae import printed, printed_trace
from tests.dynamics.integrator import integrate
from tests.every import every
from tests.studies.tso_wong_1989.whole import (
    UNSTABLE,
    evidence,
    finding,
    found,
    higher,
    sampled,
    states,
    values,
    with_histories,
)

pytestmark = pytest.mark.usefixtures("computed")

Tamper = Callable[[pytest.MonkeyPatch], Evidence]


def settled_elsewhere(_: object) -> Evidence:
    """Fig 9b's runs settled to a motion with another peak."""
    true = evidence().histories["9b"]
    other = History(case=true.case)
    other.__dict__["fates"] = {
        side: higher(fate, 1.01 * fate.highest) for side, fate in true.fates.items()
    }
    return with_histories(figure_9b=other)


def without(*names: str) -> Evidence:
    kept = {name: h for name, h in evidence().histories.items() if name not in names}
    return replace(evidence(), histories=kept)


def one_fate_each(_: object) -> Evidence:
    """Only motions with the same fate from everywhere."""
    true = evidence().histories
    return replace(
        evidence(),
        histories={"8a": true["12d"], "9b": true["9b"], "12d": true["12d"], "13c": true["13c"]},
    )


def two_peaks_down_to_the_end(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    def higher(amplitude: Any, *more: Any, **options: Any) -> SteadyStates:
        return steady_states(np.asarray(amplitude) + 0.8, *more, **options)

    monkeypatch.setattr(stability, "steady_states", higher)
    return evidence()


FALSE: dict[str, Tamper] = {
    "E2": lambda _: sampled(trace=np.full_like(states().trace, 3.0)),
    "branch-2-unstable": lambda _: sampled(trace=0.2 * states().trace),
    "round-off": lambda _: without("11a", "12b", "12c", "12d", "13b", "13c"),
    "E6": one_fate_each,
    "settled-out-of-phase": settled_elsewhere,
    "three-periods": lambda _: with_histories(figure_9c="8c"),
    "second-peak": two_peaks_down_to_the_end,
    "stability-by-run": lambda _: with_histories(figure_11a="11b"),
    "kicked-and-back": lambda _: with_histories(figure_10="11a"),
}
"""Evidence on which the verdict on a statement must be the other one."""


@every("name", FALSE)
def test_a_verdict_turns_with_its_evidence(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    true = finding(name)
    false = found(name, FALSE[name](monkeypatch))
    assert bool(false.holds) is not bool(true.holds)
    assert false.detail != true.detail


# ------------------------------------------------------------------------------------------ E2


@pytest.mark.parametrize(
    ("point", "trace"), [((0.75, 4.0, 0.5, 1), 0.767), ((1.7, 6.0, 0.8, 3), 0.813)]
)
def test_e2_in_phase_motions_near_the_fold_are_stable(
    point: tuple[float, float, float, int], trace: float
) -> None:
    a, w, r, n = point
    solution = printed(a, w, r, n, 1)
    assert 0.0 < solution.phase < 0.5 * math.pi
    by_formula = printed_trace(a, w, r, n, solution.sine, solution.velocity)
    assert by_formula == pytest.approx(trace, abs=5.1e-4)
    assert abs(by_formula) < 1.0 + r * r
    came = values("E2")
    traces, stays = came["trace"], came["stays"]
    assert any(found_ == pytest.approx(by_formula, abs=1e-9) for found_ in traces)
    assert stays == [True, True]


def test_e2_an_integrator_returns_to_an_in_phase_motion() -> None:
    a, w, r = 0.75, 4.0, 0.5
    solution = printed(a, w, r, 1, 1)
    phase = solution.phase + 0.01
    run = integrate(
        lambda s: a * math.sin(w * s + phase),
        40.0 * 2.0 * math.pi / w,
        alpha=1.0,
        p=1.0,
        restitution=r,
        angle=0.0,
        velocity=1.01 * w * solution.velocity,
        longest_step=0.1,
    )
    offset = abs(run.after[3] / (w * solution.velocity) + 1.0)
    assert offset > 1e-4
    assert np.abs(run.after[-4:]) == pytest.approx(w * solution.velocity, rel=1e-6)
    # and it hits the floor while the base pushes towards it: in phase by the paper's definition
    assert (
        math.cos(w * run.impacts[-1] + phase - round(w * run.impacts[-1] / math.pi) * math.pi) > 0
    )


def test_e2_counts_every_in_phase_solution() -> None:
    s = states()
    came = values("E2")
    in_phase = np.abs(s.phase) < 0.5 * math.pi
    inside = np.abs(s.trace) < 1.0 + s.restitution**2
    assert came["in_phase"] == int(in_phase.sum())
    assert came["stable_in_phase"] == int((in_phase & inside & s.admissible).sum())
    assert (s.region[(in_phase & s.stable).any(axis=0)] != 2).all()
    # none of them is the in-phase one beside an out-of-phase one
    assert not (in_phase & s.stable)[1].any()


# ------------------------------------------------------------------------------------------ E6


def test_e6_sorts_every_unstable_motion_by_what_its_fate_depends_on() -> None:
    came = values("E6")
    lists = {name: list(found_) for name, found_ in came.items() if name != "most_changes"}
    together = [figure for found_ in lists.values() for figure in found_]
    assert sorted(together) == sorted(UNSTABLE)
    for name in UNSTABLE:
        fates = evidence().histories[name].fates_over_kicks
        plus, minus = ({outcome(fate) for fate in fates[side]} for side in (1, -1))
        if name in lists["distance"]:
            assert len(plus) > 1 or len(minus) > 1
        else:
            assert len(plus) == len(minus) == 1
            assert (name in lists["side"]) == (plus != minus)
        leanings = [{fate.bias for fate in fates[side]} for side in (1, -1)]
        if name in lists["mirror_images"]:
            assert leanings[0] == {-bias for bias in leanings[1]} != {0}
        if name in lists["always_the_same"]:
            assert leanings == [{0}, {0}]
    # what the reference results name depends on the side
    dependent = {*lists["side"], *lists["distance"], *lists["mirror_images"]}
    assert {"8a", "8b", "8c", "9a", "9c", "12c"} <= dependent


def outcome(fate: Fate) -> tuple[Kind, int]:
    return fate.kind, fate.period


def test_e6_bands_of_overturning_and_of_safe_motion_alternate() -> None:
    for name in ("12c", "13d"):
        fates = evidence().histories[name].fates_over_kicks
        for side in (1, -1):
            falls = [fate.kind is Kind.OVERTURNED for fate in fates[side]]
            changes = int(np.abs(np.diff(np.array(falls, dtype=int))).sum())
            assert changes >= 3, (name, side)


# ---------------------------------------------------------------------------------- other numbers


def test_branch_2_multipliers_are_the_reference_ones() -> None:
    drawn = values("branch-2-unstable")["figures"]
    reference = {"8a": 25.658, "8b": 10.2467, "8c": 7.2251, "9a": 19.557, "9b": 12.419}
    for name, value in {**reference, "9c": 6.8005}.items():
        assert drawn[name] == pytest.approx(value, rel=5e-5)


def test_the_second_peak_appears_where_two_extrema_of_the_half_cycle_part() -> None:
    appears = values("second-peak")["appears_at"]
    for amplitude, count in ((appears - 0.01, 1), (appears + 0.01, 3), (4.0, 3), (2.0, 1)):
        solution = printed(amplitude, 6.0, 0.8, 3, 1)
        s = np.linspace(0.0, 3.0 * math.pi / 6.0, 200_001)
        beta = amplitude / 37.0
        speed = (
            6.0 * (solution.velocity + beta * solution.cosine) * np.cosh(s)
            + (beta * solution.sine - 1.0) * np.sinh(s)
            - 6.0 * beta * np.cos(6.0 * s + solution.phase)
        )
        changes = int((np.diff(np.sign(speed)) != 0).sum())
        assert changes == count
