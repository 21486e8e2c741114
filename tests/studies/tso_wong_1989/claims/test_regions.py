"""Statements on regions: each verdict turns with its evidence, and the numbers are right."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady.formulas import steady_states
from rocksteady.orbits import RegionMap, SteadyStates, compute_region_map
from rocksteady.studies.tso_wong_1989.claims import _regions as regions
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence
from tests.dynamics.formulae import half_cycle, numbers, printed
from tests.every import every
from tests.studies.tso_wong_1989.whole import (
    evidence,
    finding,
    found,
    plane,
    sampled,
    states,
    values,
    with_planes,
    with_sample,
)

pytestmark = pytest.mark.usefixtures("computed")

Tamper = Callable[[pytest.MonkeyPatch], Evidence]


def all_admissible(_: object) -> Evidence:
    s = states()
    return sampled(velocity_tau=np.abs(s.velocity_tau), admissible=~np.isnan(s.phase))


def opposite_signs(_: object) -> Evidence:
    s = states()
    return sampled(phase=np.stack([np.abs(s.phase[0]), -np.abs(s.phase[1])]))


def half_q(_: object) -> Evidence:
    return with_sample(replace(evidence().sample, q=0.5 * evidence().sample.q))


def nothing_in_region_3(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    """A world in which the points between (23) and (25) lie in another region."""

    def higher(amplitude: Any, *more: Any, **options: Any) -> SteadyStates:
        return steady_states(1.5 * amplitude, *more, **options)

    monkeypatch.setattr(regions, "steady_states", higher)
    return evidence()


def growing_region_4(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    def reversed_(ratios: Any, restitution: float, **options: Any) -> RegionMap:
        return compute_region_map(ratios, 1.1 - restitution, **options)

    monkeypatch.setattr(regions, "compute_region_map", reversed_)
    return evidence()


def exchanged_numbers(_: object) -> Evidence:
    """The planes of Fig 4 with the numbers 1 and 2 exchanged, as the paper's sentence has them."""

    def other(name: str) -> Any:
        true = evidence().planes[name]
        shares = true.shares
        # region 5 counts with the region that it becomes
        return SimpleNamespace(
            curves=true.curves,
            shares={**shares, 1: shares[2] + shares[5], 2: shares[1], 5: 0.0},
        )

    return with_planes(figure_4a=other("4a"), figure_4b=other("4b"))


def nothing_at_large_amplitudes(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    def bounded(amplitude: Any, *more: Any, **options: Any) -> SteadyStates:
        found_ = steady_states(amplitude, *more, **options)
        if found_.admissible is None:
            return found_
        return replace(found_, admissible=np.zeros_like(found_.admissible))

    monkeypatch.setattr(regions, "steady_states", bounded)
    return evidence()


FALSE: dict[str, Tamper] = {
    "phase-1": lambda _: sampled(phase=states().phase[::-1]),
    "phase-2": lambda _: sampled(phase=states().phase[::-1]),
    "kinds": lambda _: sampled(phase=states().phase + 0.01),
    "eq-24-25": lambda _: sampled(sign=states().sign * 1.001),
    "four-regions": lambda _: with_planes(figure_4a=plane(0.7, 3)),
    "E1": all_admissible,
    "sign-of-phase": lambda _: sampled(phase=-states().phase),
    "E7": opposite_signs,
    "region-4": half_q,
    "region-3-small": lambda _: with_planes(figure_3a=plane(0.1, 1)),
    "E8": nothing_in_region_3,
    "region-4-shrinks": growing_region_4,
    "E5": exchanged_numbers,
    "E9": nothing_at_large_amplitudes,
}
"""Evidence on which the verdict on a statement must be the other one."""


@every("name", FALSE)
def test_a_verdict_turns_with_its_evidence(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    true = finding(name)
    false = found(name, FALSE[name](monkeypatch))
    assert true.holds == (name not in {"E1", "E5", "E7", "E8", "E9"})
    assert bool(false.holds) is not bool(true.holds)
    assert false.values != true.values


def test_a_fifth_region_for_harmonic_motion_would_be_seen() -> None:
    assert not found("four-regions", with_planes(figure_3a=plane(0.15, 1))).holds
    assert found("four-regions", with_planes(figure_3a=plane(0.3, 1))).holds


def test_region_5_begins_at_the_restitution_said() -> None:
    limits = values("four-regions")["restitution_below"]
    for order, limit in limits.items():
        for restitution, there in ((limit - 1e-3, True), (limit + 1e-3, False)):
            curves = compute_region_map(np.geomspace(1.0, 3000.0, 400), restitution, order=order)
            assert bool((curves.kind > curves.sign).any()) == there


# ------------------------------------------------------------------ numbers behind the corrections


def test_e1_the_in_phase_solutions_of_regions_2_and_5_go_through_the_floor() -> None:
    came = values("E1")
    for name, region in (("region_2", 2), ("region_5", 5)):
        points, downwards, admissible = came[name]
        assert downwards == points == int((states().region == region).sum())
        assert points > 1000
        assert admissible == 0
    # by the formulae as printed, and drawn: the angle is negative as soon as the half cycle begins
    rng = np.random.default_rng(2)
    s = states()
    inside = np.flatnonzero((s.region == 2) | (s.region == 5))
    for index in rng.choice(inside, 200, replace=False):
        a, w, r, n = (
            float(s.amplitude[index]),
            float(s.frequency_ratio[index]),
            float(s.restitution[index]),
            int(s.order[index]),
        )
        solution = printed(a, w, r, n, 2)
        assert solution.velocity < 0.0
        h, beta, _, _ = numbers(a, w, r, n)
        by_phase = 2.0 * r * beta * solution.sine / ((1.0 - r) * h * w)
        assert solution.velocity == pytest.approx(by_phase, rel=1e-6, abs=1e-9)
        _, angle = half_cycle(a, w, n, solution.phase, solution.velocity, 20_001)
        assert angle[1] < 0.0


def test_e5_region_1_grows_and_region_2_gains_what_region_5_had() -> None:
    came = values("E5")
    growth = came["growth"]
    # counted on a grid, without the boundary curves
    w = 0.05 + (np.arange(500) + 0.5) * 13.95 / 500
    a = (np.arange(500) + 0.5) * 6.0 / 500
    few, many = (
        steady_states(a[:, np.newaxis], w, r, order=3, with_shapes=False).region
        for r in (0.5, 0.95)
    )
    for number in (1, 2):
        counted = float((many == number).sum() / (few == number).sum())
        assert growth[number] == pytest.approx(counted, rel=0.02)
    assert growth[1] > 5.0 * growth[2]
    assert not (many == 5).any()
    assert (many[few == 5] == 2).all(), "what region 5 had becomes region 2"
    assert set(np.unique(few[(many == 2) & (few != 2)])) == {5}, "and nothing else does"
    assert set(np.unique(few[(many == 1) & (few != 1)])) == {3, 4}, "region 1 grows downwards"
    assert came["boundary_moves"] == pytest.approx(0.0, abs=1e-15)


def test_e7_both_phases_of_region_3_are_positive_and_those_of_region_5_are_not() -> None:
    came = values("E7")
    positive, opposite, points = came["region_3"]
    assert (positive, opposite) == (points, 0)
    assert points > 1000
    opposite, points = came["region_5"]
    assert opposite == points > 1000
    for point, signs in (((0.75, 4.0, 0.5, 1), {True}), ((5.0, 8.0, 0.5, 3), {True, False})):
        assert {printed(*point, branch).sine > 0.0 for branch in (1, 2)} == signs


def test_e8_the_gap_is_that_of_the_printed_root_at_every_restitution() -> None:
    came = values("E8")
    widths = came["relative_width"]
    w = np.linspace(0.05, 14.0, 1396)
    for restitution, width in widths.items():
        p = (1.0 - restitution) / (1.0 + restitution) * np.tanh(0.5 * np.pi / w) * w
        assert width == pytest.approx(float((1.0 - 1.0 / np.sqrt(1.0 + p * p)).max()), rel=1e-6)
        assert width > 0.0
    assert came["points_inside"] == list(widths)


def test_e9_branch_1_goes_on_at_any_amplitude() -> None:
    came = values("E9")
    counts = came["admissible_upward_stable"]
    points = came["points"]
    assert counts[1][0] == points
    assert counts[3][0] < 0.1 * float(str(points))
    assert counts[1][1] == counts[3][1] == points
    # far beyond the samples: drawn from the printed formulae, harmonic motion stays in the air
    for a in (10.0, 100.0, 1e4):
        solution = printed(a, 4.0, 0.8, 1, 1)
        _, angle = half_cycle(a, 4.0, 1, solution.phase, solution.velocity, 5001)
        assert angle[1:-1].min() > 0.0
    below = steady_states(0.2, 4.0, 0.8)
    assert below.region == 4
