"""Statements on the equations: each verdict turns where what it rests on is made wrong."""

import math
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, simulate
from rocksteady.errors import InputError
from rocksteady.formulas import steady_states
from rocksteady.studies.tso_wong_1989.claims import _equations as equations
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, random_sample
from tests.dynamics.formulae import numbers, printed, printed_boundaries, printed_region
from tests.every import every
from tests.studies.tso_wong_1989.whole import evidence, finding, found, sampled, states, values

pytestmark = pytest.mark.usefixtures("computed")

Tamper = Callable[[pytest.MonkeyPatch], Evidence]


def run_with(
    monkeypatch: pytest.MonkeyPatch,
    *,
    amplitude: float = 1.0,
    frequency: float = 1.0,
    restitution: float = 1.0,
) -> Evidence:
    """Let the statements' runs be those of other parameters, by these factors."""

    def other(block: DimensionlessBlock, motion: Harmonic, **more: Any) -> Any:
        changed = replace(
            motion,
            amplitude=motion.amplitude * amplitude,
            frequency_ratio=motion.frequency_ratio * frequency,
        )
        body = DimensionlessBlock(restitution=block.restitution * restitution)
        return simulate(body, changed, **more)

    monkeypatch.setattr(equations, "simulate", other)
    return evidence()


def mirrored_for_all_orders(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    """A world in which every order has a symmetric motion."""

    def run(_block: object, _motion: object, *, cycles: int, **_: object) -> Any:
        return SimpleNamespace(
            end_time_pt=math.inf,
            at_tau=lambda tau: SimpleNamespace(angle=np.sin(np.asarray(tau) / cycles)),
        )

    monkeypatch.setattr(equations, "simulate", run)
    return evidence()


def heavier_is_slower(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    class Other(Block):
        @classmethod
        def general(cls, *, mass: float, **more: Any) -> Any:
            made = Block.general(mass=mass, **more)
            return SimpleNamespace(p=made.p / (1.0 + 1e-9 * mass))

    monkeypatch.setattr(equations, "Block", Other)
    return evidence()


FALSE: dict[str, Tamper] = {
    "uplift": lambda patch: run_with(patch, amplitude=1.01),
    "eq-4-5": lambda patch: run_with(patch, frequency=1.001),
    "eq-9": lambda patch: run_with(patch, restitution=0.999),
    "E4": mirrored_for_all_orders,
    "eq-10-13": lambda _: sampled(phase=states().phase + 1e-6),
    "eq-14-17": lambda _: sampled(phase=states().phase + 1e-6),
    "eq-18-19": lambda _: sampled(velocity_tau=states().velocity_tau * (1.0 + 1e-6)),
    "eq-20-22": lambda _: sampled(phase=states().phase + 1e-5),
    "eq-23": lambda _: sampled(existence=states().existence * 1.001),
    "eq-6-26-27": heavier_is_slower,
}
"""Evidence on which the verdict on a statement must be the other one."""


@pytest.mark.slow
@every("name", FALSE)
def test_a_verdict_turns_with_its_evidence(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    true = finding(name)
    false = found(name, FALSE[name](monkeypatch))
    assert true.holds == (name != "E4")
    assert bool(false.holds) is not bool(true.holds)
    assert false.detail != true.detail or name == "eq-6-26-27"


@pytest.mark.slow
def test_both_ends_of_the_uplift_count(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not found("uplift", run_with(monkeypatch, amplitude=0.99)).holds


# --------------------------------------------------------------------------- E4: odd orders only


@every("order", [1, 2, 3, 4])
def test_only_odd_orders_meet_both_halves_by_the_printed_formulae(order: int) -> None:
    # The second half cycle starts at tau = n pi, where the shaking's phase has grown by n pi.
    a, w, r = 2.0, 4.0, 0.8
    h, beta, p, q = numbers(a, w, r, order)
    solution = printed(a, w, r, order, 1)
    assert p * solution.cosine + solution.sine == pytest.approx(q, abs=1e-14)
    phase = solution.phase + order * math.pi
    # mirrored: u -> -u and a -> -a; the half cycle after the impact solves (20) with -sin, -cos
    residual = p * -math.cos(phase) - math.sin(phase) - q
    assert (abs(residual) < 1e-12) == (order % 2 == 1)
    assert h > 0.0
    assert beta > 0.0


def test_e4_names_the_odd_orders_and_those_that_are_refused() -> None:
    came = values("E4")
    assert came["mirrored"] == [1, 3]
    defects = came["largest_defect"]
    assert max(defects[0], defects[2]) < 1e-12
    assert min(defects[1], defects[3]) > 0.1
    for order in (2, 4):
        with pytest.raises(InputError, match="odd"):
            steady_states(2.0, 4.0, 0.8, order=order)


# --------------------------------------------------------------------------- the random points


def test_the_random_points_are_the_same_each_time_and_cover_the_papers_axes() -> None:
    sample = evidence().sample
    again = random_sample(len(sample.p))
    np.testing.assert_array_equal(sample.states.amplitude, again.states.amplitude)
    np.testing.assert_array_equal(sample.states.phase, again.states.phase)
    s = sample.states
    assert (s.amplitude.min(), s.amplitude.max()) == (
        pytest.approx(0.01, abs=0.01),
        pytest.approx(8.0, abs=0.01),
    )
    assert s.frequency_ratio.max() > 15.9
    assert s.restitution.min() < 0.06
    assert s.restitution.max() > 0.98
    assert set(s.order.tolist()) == {1, 3, 5}
    assert {int(region) for region in np.unique(s.region)} == {1, 2, 3, 4, 5}


def test_the_random_points_hold_the_printed_quantities() -> None:
    sample = evidence().sample
    s = sample.states
    for index in range(0, 100_000, 4999):
        a, w, r, n = (
            float(s.amplitude[index]),
            float(s.frequency_ratio[index]),
            float(s.restitution[index]),
            int(s.order[index]),
        )
        h, beta, p, q = numbers(a, w, r, n)
        found_ = (sample.tanh[index], sample.beta[index], sample.p[index], sample.q[index])
        assert found_ == pytest.approx((h, beta, p, q), rel=1e-13)
        assert sample.exists[index] == (a > printed_boundaries(w, r, n)[0])
        assert int(s.region[index]) == printed_region(a, w, r, n)


def test_few_points_are_drawn_from_the_same_ranges() -> None:
    assert len(random_sample(7).p) == 7
