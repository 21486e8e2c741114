"""Fates from rest: against single calls, and the mirror image half a period on."""

import math

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_attractor, map_attractors
from rocksteady.studies.atlas.analysis.from_rest import FATES, PHASES
from tests.studies.atlas.small import plane, small

BLOCK = DimensionlessBlock(restitution=0.8)


def test_fates_are_those_of_single_calls() -> None:
    found, rng = small().rest, np.random.default_rng(7)
    for _ in range(60):
        which, row, column = (int(rng.integers(size)) for size in found.fate.shape)
        shaking = Harmonic(
            amplitude=float(plane().amplitudes[row]),
            frequency_ratio=float(plane().ratios[column]),
            phase=float(found.phases[which]),
        )
        single = find_attractor(BLOCK, shaking, max_cycles=500)
        fate = FATES[int(found.fate[which, row, column])]
        if single.orbit is None:
            assert fate == str(single.kind.value)
        elif single.orbit.period > 1:
            assert fate == "subharmonic"
        elif single.orbit.rest_phases:
            assert fate == "period 1 with rests"
        else:
            shape = "symmetric" if single.orbit.symmetric else "unsymmetric"
            assert fate == f"{shape}, period 1"


def test_half_a_period_later_everything_is_mirrored() -> None:
    amplitude, ratio = plane().amplitudes[::3], plane().ratios[::4]
    phases = np.array([0.0, 0.9, math.pi, 0.9 + math.pi])
    axes = {"phase": phases, "amplitude": amplitude, "frequency_ratio": ratio}
    kind = map_attractors(BLOCK, axes=axes, max_cycles=500).kind.values
    np.testing.assert_array_equal(kind[:2], kind[2:])


def test_below_uplift_a_block_stays_at_rest_and_high_frequencies_do_not_overturn() -> None:
    found = small().rest
    below = plane().amplitudes < 1.0
    assert (found.fate[:, below, :] == FATES.index("rest")).all()
    assert (found.overturned[below] == 0.0).all()
    assert found.overturned[:, -1].max() == 0.0
    assert found.overturned[-1, 0] == 1.0


def test_the_lowest_falls_overturn_and_lie_above_the_heteroclinic_curve() -> None:
    falls = small().rest.falls
    assert [fall.frequency_ratio for fall in falls] == [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0]
    for fall in falls:
        if math.isnan(fall.amplitude):
            continue
        assert fall.amplitude > max(1.0, fall.heteroclinic)
        shaking = Harmonic(
            amplitude=fall.amplitude, frequency_ratio=fall.frequency_ratio, phase=fall.phase
        )
        assert find_attractor(BLOCK, shaking, max_cycles=500).kind == "overturned"


def test_shares_are_of_the_window() -> None:
    found = small().rest
    assert sum(found.share(fate) for fate in FATES) == pytest.approx(1.0)
    assert len(found.phases) == PHASES
