"""Chaos proved: where it is known, nowhere else, and its sequences are runs of the march."""

import math

import mpmath as mp
import numpy as np
import pytest

import rocksteady as rs
from rocksteady.certify.proofs._hilltops import hilltop_phases
from rocksteady.certify.proofs.chaos import certify_chaos
from tests.every import every


def test_the_horseshoe_of_the_packages_example() -> None:
    certificate = certify_chaos(2, 2, "0.8")
    assert certificate.proved
    assert certificate.content["least_half_periods"] == 3
    assert len(certificate.content["phases"]) == 2
    assert certificate.content["claim"] == {"entropy_per_period": "0.8392"}
    assert "not claimed" in certificate.summary()
    assert len(certificate.to_json()) < 700


@every("case", [(0.6, 2, 0.8, 5), (1, 2, 0.95, 5), (1, 1, 0.5, 1)])
def test_other_places_have_one(case: tuple[float, float, float, int]) -> None:
    certificate = certify_chaos(*case[:3])
    assert certificate.content["least_half_periods"] == case[3]


def test_chaos_holds_over_a_box_of_parameters() -> None:
    certificate = certify_chaos((0.59, 0.61), (1.98, 2.02), 0.8)
    assert certificate.proved
    assert "A = 0.59 to 0.61, W = 1.98 to 2.02" in certificate.claim
    assert certificate.content["least_half_periods"] == 5


def test_below_the_heteroclinic_amplitude_there_is_no_proof() -> None:
    certificate = certify_chaos(0.45, 2, 0.8)
    assert certificate.verdict == "undecided"
    assert "A_het" in certificate.reason


def test_periodic_sequences_are_motions_of_the_march() -> None:
    """Phases of random words by Newton's method in 30 digits; each flight by the kernels."""
    random = np.random.default_rng(3)
    centres = hilltop_phases(2.0, 2.0, 0.8)
    block = rs.DimensionlessBlock(restitution=0.8)
    for _ in range(12):
        count = int(random.integers(2, 6))
        symbols = random.integers(0, 2, count)
        orders = [int(n) for n in random.choice([3, 5, 7], count)]
        phases = solved([centres[k] for k in symbols], orders)
        for k, order in enumerate(orders):
            assert abs(phases[k] - centres[symbols[k]]) < 0.15
            after = phases[(k + 1) % count]
            duration = (after - phases[k] + order * math.pi) / 2.0
            motion = rs.Harmonic(amplitude=2.0, frequency_ratio=2.0, phase=phases[k])
            speed = speed_of(phases[k], after, duration)
            start = rs.State(angle=0.0, velocity=speed)
            run = rs.simulate(block, motion, start=start, cycles=(order + 1) / 2)
            assert abs(run.flights.duration[0] - duration) < 1e-7 * math.exp(duration)


def speed_of(x: float, y: float, t: float) -> float:
    """w of (E3)."""
    beta = 0.4
    w = (1 - beta * math.sin(x)) / math.tanh(t) - (1 + beta * math.sin(y)) / math.sinh(t)
    return w - beta * 2.0 * math.cos(x)


def solved(start: list[float], orders: list[int]) -> list[float]:
    """Impact phases of a closed chain, by Newton's method with differences."""
    beta, count = mp.mpf("0.4"), len(start)

    def residuals(*x: mp.mpf) -> list[mp.mpf]:
        found = []
        for k in range(count):
            p, q, s = x[k - 1], x[k], x[(k + 1) % count]
            t0, t1 = (q - p + orders[k - 1] * mp.pi) / 2, (s - q + orders[k] * mp.pi) / 2
            landing = (1 + beta * mp.sin(q)) * mp.coth(t0) - (1 - beta * mp.sin(p)) / mp.sinh(t0)
            leaving = (1 - beta * mp.sin(q)) * mp.coth(t1) - (1 + beta * mp.sin(s)) / mp.sinh(t1)
            slope = 2 * beta * mp.cos(q)
            found.append(mp.mpf("0.8") * (landing - slope) - (leaving - slope))
        return found

    with mp.workdps(30):
        return [float(x) for x in mp.findroot(residuals, start)]


@pytest.mark.slow
@every("amplitude", [2.6, 2.698, 2.8])
def test_chaos_of_the_rocking_itself(amplitude: float) -> None:
    certificate = certify_chaos(amplitude, 2, 0.8, kind="homoclinic")
    assert certificate.proved, certificate.reason
    assert float(certificate.content["claim"]["entropy_per_period"]) > 0.18
    assert len(certificate.to_json()) <= 3000


def test_a_stable_symmetric_motion_is_no_saddle() -> None:
    certificate = certify_chaos(2, 2, 0.8, kind="homoclinic")
    assert certificate.verdict == "undecided"
    assert "may be stable" in certificate.reason
