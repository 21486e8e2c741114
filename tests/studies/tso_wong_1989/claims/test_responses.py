"""Statements of the parametric study: each verdict turns with its evidence."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, compute_response_curve
from rocksteady.formulas import steady_states
from rocksteady.orbits import ResponseCurve, compute_region_boundaries
from rocksteady.studies.tso_wong_1989.claims import _responses as responses
from rocksteady.studies.tso_wong_1989.claims._responses import peaks_at
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence
from tests.every import every
from tests.studies.tso_wong_1989.whole import evidence, finding, found, values, with_responses

pytestmark = pytest.mark.usefixtures("computed")

Tamper = Callable[[pytest.MonkeyPatch], Evidence]


def curves(name: str) -> list[ResponseCurve]:
    return list(evidence().responses[name].curves)


def scaled(name: str, number: int, factor: float) -> list[ResponseCurve]:
    """The curves of a figure, one of them by a factor."""
    made = curves(name)
    made[number] = replace(made[number], peak=factor * made[number].peak)
    return made


def bump(name: str) -> list[ResponseCurve]:
    made = curves(name)
    peak = made[2].peak.copy()
    peak[1200] *= 1.01
    made[2] = replace(made[2], peak=peak)
    return made


def ending(name: str, number: int, ratio: float) -> list[ResponseCurve]:
    made = curves(name)
    curve = made[number]
    made[number] = replace(curve, peak=np.where(curve.frequency_ratio < ratio, curve.peak, np.nan))
    return made


def endless(name: str, number: int) -> list[ResponseCurve]:
    made = curves(name)
    peak = made[number].peak
    made[number] = replace(made[number], peak=np.where(np.isnan(peak), 0.1, peak))
    return made


def larger_is_smaller(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    class Other(Block):
        @classmethod
        def from_radius(cls, *, radius: float, **more: Any) -> Block:
            return Block.from_radius(radius=4.0 / radius, **more)

    monkeypatch.setattr(responses, "Block", Other)
    return evidence()


def harmonic_motion_alone(monkeypatch: pytest.MonkeyPatch) -> Evidence:
    """A world without stable subharmonics."""

    def curve(*arguments: Any, order: int, **more: Any) -> ResponseCurve:
        made = compute_response_curve(*arguments, order=order, **more)
        return replace(made, stable=made.stable & (order == 1))

    monkeypatch.setattr(responses, "compute_response_curve", curve)
    return evidence()


def mirrored_curves(name: str) -> list[ResponseCurve]:
    """Curves that are steep at high frequencies instead."""
    return [replace(c, peak=c.peak[::-1], stable=c.stable[::-1]) for c in curves(name)]


def peaks_by(law: Callable[[float, float, float], float]) -> Tamper:
    """A world in which peaks follow another law of amplitude, frequency ratio and restitution."""

    def tamper(monkeypatch: pytest.MonkeyPatch) -> Evidence:
        def states(a: float, w: float, r: float, **_: object) -> Any:
            return SimpleNamespace(peak=np.array([law(a, w, r), 0.0]))

        monkeypatch.setattr(responses, "steady_states", states)
        return evidence()

    return tamper


FALSE: dict[str, Tamper] = {
    "no-resonance": lambda _: with_responses(figure_5b=bump("5b")),
    "less-than-proportional": lambda _: with_responses(figure_5a=scaled("5a", 5, 2.0)),
    "curves-end": lambda _: with_responses(figure_5b=endless("5b", 1)),
    "grows-with-p": lambda _: with_responses(figure_6b=curves("6b")[::-1]),
    "larger-block": harmonic_motion_alone,
    "low-frequency": lambda _: with_responses(figure_5a=mirrored_curves("5a")),
    "insensitive-to-restitution": lambda _: with_responses(figure_7a=scaled("7a", 0, 0.9)),
    "restitution-trend": lambda _: with_responses(figure_7b=scaled("7b", 3, 2.0)),
    "sensitivities": peaks_by(lambda a, w, r: a**1.2 / w * r),
}
"""Evidence on which the verdict on a statement must be the other one."""


@every("name", FALSE)
def test_a_verdict_turns_with_its_evidence(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    true = finding(name)
    false = found(name, FALSE[name](monkeypatch))
    assert bool(false.holds) is not bool(true.holds)
    assert false.detail != true.detail


def test_in_one_motion_the_larger_block_moves_less(monkeypatch: pytest.MonkeyPatch) -> None:
    assert values("larger-block")["largest_ratio"] < 1.0
    other = found("larger-block", larger_is_smaller(monkeypatch))
    ratio = other.values["largest_ratio"]
    assert isinstance(ratio, float)
    assert ratio > 1.0
    assert not other.holds


def test_a_larger_block_may_be_in_a_larger_motion() -> None:
    peaks = []
    for radius, order in ((1.0, 1), (16.0 / 9.0, 3)):
        block = Block.from_radius(alpha=0.2, radius=radius, restitution=0.8)
        hertz = 6.0 * Block.from_radius(alpha=0.2, radius=1.0, restitution=0.8).p / (2.0 * np.pi)
        curve = compute_response_curve(
            block, 3.0, frequency_hz=[hertz], order=order, model="linear"
        )
        assert curve.stable.all()
        peaks.append(float(curve.peak[0]))
    assert peaks == pytest.approx([0.11200, 0.18981], abs=6e-6)  # TW3
    assert values("larger-block")["other_motion"] > 0


def test_a_curve_that_ends_early_would_be_seen() -> None:
    assert not found("curves-end", with_responses(figure_5b=ending("5b", 1, 11.0))).holds


def test_curves_end_where_the_printed_boundary_reaches_their_amplitude() -> None:
    came = values("curves-end")
    for a in (1.0, 2.0):
        end = came[f"A={a:g}"]
        around = compute_region_boundaries([end, end + 0.01], 0.8, order=3).existence
        assert around[0] <= a < around[1]
    assert compute_region_boundaries(16.0, 0.8, order=3).existence < 3.0, (
        "the curve of A = 3 does not end"
    )


def test_sensitivities_are_differences_of_the_closed_form() -> None:
    assert found("sensitivities", evidence()).holds
    came = values("sensitivities")["n=3, Omega=6"]

    def peak(a: float, w: float, r: float) -> float:
        found_ = steady_states(a, w, r, order=3).peak
        assert found_ is not None
        return float(found_[0])

    ratio = 1.001
    here = peak(3.0, 6.0, 0.8)
    for name, there in (
        ("amplitude", peak(3.0 * ratio, 6.0, 0.8)),
        ("frequency_ratio", peak(3.0, 6.0 * ratio, 0.8)),
        ("restitution", peak(3.0, 6.0, 0.8 * ratio)),
    ):
        slope = np.log(there / here) / np.log(ratio)
        assert came[name] == pytest.approx(slope, rel=5e-3)


def test_a_peak_is_read_at_the_nearest_abscissa() -> None:
    figure = evidence().responses["6a"]
    read = peaks_at(figure, 8.003)
    for curve, value in zip(figure.curves, read, strict=True):
        assert curve.frequency_hz is not None
        (at,) = np.flatnonzero(np.isclose(curve.frequency_hz, 8.0))
        assert value == curve.peak[at]
