"""Orbits that floating point states at random places, each held against its proof."""

from collections import Counter

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.certify.orbit import certify_orbit


def disagreements(count: int, seed: int) -> tuple[Counter[str], list[str]]:
    """Verdicts on the orbits at random amplitudes, ratios and restitutions, and what differs."""
    random, verdicts = np.random.default_rng(seed), Counter[str]()
    differing = []
    for _ in range(count):
        amplitude, ratio = random.uniform(0.3, 6.0), random.uniform(1.0, 8.0)
        block = rs.DimensionlessBlock(restitution=random.uniform(0.5, 0.95))
        motion = rs.Harmonic(amplitude=amplitude, frequency_ratio=ratio)
        for orbit in rs.find_orbits(block, motion, max_period=3, seeds=2):
            if orbit.rest_phases:
                continue
            certificate = certify_orbit(orbit)
            verdicts[certificate.verdict] += 1
            if not certificate.proved:
                if certificate.verdict != "refuted" or orbit.admissible:
                    differing.append(f"{certificate.claim}: {certificate.reason}")
            elif not orbit.admissible:
                differing.append(f"{certificate.claim}: stated to pass through the floor")
            elif (certificate.content["claim"]["stability"] == "stable") != orbit.stable:
                differing.append(f"{certificate.claim}: stated the other way")
    return verdicts, differing


def test_orbits_of_a_few_random_states_are_proved_as_they_are_stated() -> None:
    verdicts, differing = disagreements(10, 1)
    assert verdicts["proved"] >= 10
    assert differing == []


@pytest.mark.slow
def test_orbits_of_a_thousand_random_states_are_proved_as_they_are_stated() -> None:
    verdicts, differing = disagreements(1000, 3)
    assert verdicts["proved"] >= 2000
    assert differing == []
