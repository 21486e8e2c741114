"""Statements on Figs 12 and 13: each verdict turns with its evidence, and the numbers are right."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from rocksteady import map_attractors
from rocksteady.formulas import steady_states, symmetry_breaking_frequencies
from rocksteady.studies.tso_wong_1989.claims import _transitions as transitions
from rocksteady.studies.tso_wong_1989.claims._transitions import Descent, descent
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence
from rocksteady.studies.tso_wong_1989.figures.fates import Fate, Kind
from tests.dynamics.formulae import printed, printed_trace
from tests.every import every
from tests.studies.tso_wong_1989.whole import evidence, finding, found, values, with_histories

pytestmark = pytest.mark.usefixtures("computed")

Tamper = Callable[[pytest.MonkeyPatch], Evidence]


@cache
def descended(order: int) -> Descent:
    return descent(order)


def overturned() -> Fate:
    return evidence().histories["12d"].fates[1]


def descents(**changes: Any) -> Tamper:
    def tamper(monkeypatch: pytest.MonkeyPatch) -> Evidence:
        monkeypatch.setattr(
            transitions, "descent", lambda order: replace(descended(order), **changes)
        )
        return evidence()

    return tamper


def overturning_at_the_end(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    return descents(then=overturned())(monkeypatch)


def upwards(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    """A world in which the unsymmetric motions come in the opposite order of frequency."""

    def mirrored(block: Any, *, axes: Any, **options: Any) -> Any:
        other = {**axes, "frequency_ratio": 1.94 + 1.8 - np.array(axes["frequency_ratio"])}
        return map_attractors(block, axes=other, **options)

    monkeypatch.setattr(transitions, "map_attractors", mirrored)
    return evidence()


def another_boundary(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    def shifted(*arguments: Any, **options: Any) -> Any:
        return symmetry_breaking_frequencies(*arguments, **options) + 0.05

    monkeypatch.setattr(transitions, "symmetry_breaking_frequencies", shifted)
    return evidence()


def one_motion_each(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    """A world in which only the harmonic motion is ever stable."""

    def states(*arguments: Any, order: int, **more: Any) -> Any:
        made = steady_states(*arguments, order=order, **more)
        return replace(made, trace=np.full_like(made.trace, 3.0)) if order > 1 else made

    monkeypatch.setattr(transitions, "steady_states", states)
    return evidence()


def a_subharmonic_somewhere(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    def first_of_all(*arguments: Any, **options: Any) -> Any:
        found = map_attractors(*arguments, **options)
        found.kind.values.flat[0], found.period.values.flat[0] = 0, 3
        return found

    monkeypatch.setattr(transitions, "map_attractors", first_of_all)
    return evidence()


FALSE: dict[str, Tamper] = {
    "transitions": lambda _: with_histories(figure_12d="8b"),
    "several-motions": one_motion_each,
    "asymmetry-grows": upwards,
    "no-subharmonic-at-3.6": a_subharmonic_somewhere,
    "symmetry-breaking": another_boundary,
    "beyond-unsymmetric": overturning_at_the_end,
    "narrow-range": descents(gone_from=0.5),
    "peak-to-peak": lambda _: with_histories(figure_12b="13c"),
}
"""Evidence on which the verdict on a statement must be the other one."""


@every("name", FALSE)
def test_a_verdict_turns_with_its_evidence(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    true = finding(name)
    false = found(name, FALSE[name](monkeypatch))
    assert bool(false.holds) is not bool(true.holds)
    assert false.detail != true.detail


# -------------------------------------------------------------------------- symmetry breaking


def test_the_boundary_is_where_the_printed_trace_says_so() -> None:
    came = values("symmetry-breaking")
    for order, reference in ((1, 1.948378), (3, 4.249471)):
        boundary = came[f"n={order}"]
        assert boundary == pytest.approx(reference, abs=5.1e-7)
        traces = []
        for w in (boundary - 1e-6, boundary + 1e-6):
            solution = printed(2.0, w, 0.8, order, 1)
            traces.append(printed_trace(2.0, w, 0.8, order, solution.sine, solution.velocity))
        assert traces[0] < -1.64 < traces[1]


@pytest.mark.parametrize(
    ("order", "boundaries"),
    [
        (1, (1.448324, 1.948378, 2.345723, 2.690687, 3.291248)),
        (3, (2.957132, 4.249471, 5.237990, 6.143263, 7.959945)),
    ],
)
def test_symmetry_breaks_at_the_reference_frequencies(
    order: int, boundaries: tuple[float, ...]
) -> None:
    for amplitude, boundary in zip((1.0, 2.0, 3.0, 4.0, 6.0), boundaries, strict=True):
        found_ = symmetry_breaking_frequencies(amplitude, 0.8, order=order)[-1]
        assert found_ == pytest.approx(boundary, abs=5.1e-7)
        above, below = (
            bool(steady_states(amplitude, boundary + shift, 0.8, order=order).stable[0])
            for shift in (1e-3, -1e-3)
        )
        assert (above, below) == (True, False)


# ------------------------------------------------------------------------------ the way down


def test_the_way_down_passes_the_reference_attractors() -> None:
    one, three = descended(1), descended(3)
    assert one.symmetric_from == pytest.approx(1.948378, abs=5.1e-7)
    assert 1.78 < one.doubled_from < 1.8, "period-doubled at 1.78, not at 1.8"
    assert 1.77 - 1e-9 <= one.gone_from < 1.78, "gone by 1.77"
    assert one.then.kind is Kind.OVERTURNED
    assert three.symmetric_from == pytest.approx(4.249471, abs=5.1e-7)
    assert 4.06 < three.doubled_from < 4.2, "period-doubled at 4.06"
    assert 4.03 < three.gone_from < 4.06, "harmonic by 4.04"
    assert three.then.label == "symmetric harmonic"
    for found_ in (one, three):
        assert found_.gone_from < found_.doubled_from < found_.symmetric_from


def test_the_verdict_on_the_end_needs_both_orders(monkeypatch: pytest.MonkeyPatch) -> None:
    harmonic = descended(3).then
    monkeypatch.setattr(
        transitions,
        "descent",
        lambda order: replace(descended(order), then=harmonic if order == 1 else overturned()),
    )
    assert not found("beyond-unsymmetric", evidence()).holds


def test_the_asymmetry_is_that_of_the_reference_peaks() -> None:
    came = values("asymmetry-grows")
    ratios, offsets = came["frequency_ratio"], came["offset"]
    at = dict(zip(ratios, offsets, strict=True))
    assert at[1.9] == pytest.approx(0.5 * (0.90035 - 0.44427), abs=1e-5)
    assert at[1.8] == pytest.approx(0.5 * (1.0976 - 0.2997), abs=1e-4)
    # near its birth it grows like the square root of the distance: a pitchfork
    boundary = 1.948378
    squares = np.array(offsets[:4]) ** 2 / (boundary - np.array(ratios[:4]))
    assert np.ptp(squares) < 0.2 * squares.mean()


def test_unsymmetric_motions_swing_nearly_as_far_as_the_symmetric_one() -> None:
    relative = values("peak-to-peak")["relative_difference"]
    expected = []
    for order, w, high, low in (
        (1, 1.9, 0.90035, -0.44427),
        (1, 1.8, 1.0976, -0.2997),
        (3, 4.2, 0.53129, -0.44713),
    ):
        peak = steady_states(2.0, w, 0.8, order=order).peak
        assert peak is not None
        expected.append(abs(0.5 * (high - low) / float(peak[0]) - 1.0))
    assert relative == pytest.approx(expected, abs=1e-4)


def test_the_range_of_unsymmetric_motions_is_a_few_percent_of_the_symmetric_one() -> None:
    came = values("narrow-range")
    for order in (1, 3):
        unsymmetric, symmetric = came[f"n={order}"]
        assert 0.005 < unsymmetric / symmetric < 0.05
        assert math.isclose(
            unsymmetric, descended(order).symmetric_from - descended(order).gone_from
        )
