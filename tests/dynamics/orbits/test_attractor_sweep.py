"""Trails of attractors: hysteresis against branches, and each value by itself."""

import math
from itertools import pairwise

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    Rest,
    State,
    Steady,
    Still,
    find_attractor,
    find_orbits,
)
from rocksteady.branches import follow_branch
from rocksteady.dynamics.orbits.attractor_sweep import SHOWN_FLIGHTS, flight_peaks
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from rocksteady.orbits import AttractorSweep, sweep_attractor
from rocksteady.outcomes import AttractorKind
from tests.dynamics.settling import is_an_orbit_that_attracts
from tests.every import every

BLOCK = DimensionlessBlock(restitution=0.8)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=2.0)


def trail(parameter: str, values: object, **more: object) -> AttractorSweep:
    return sweep_attractor(BLOCK, SHAKING, parameter, values, **more)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def down() -> AttractorSweep:
    return trail("frequency_ratio", np.linspace(2.0, 1.74, 27), start=Steady())


def test_each_value_has_an_attractor_that_attracts(down: AttractorSweep) -> None:
    assert down.parameter == "frequency_ratio"
    assert len(down.attractors) == len(down.peaks) == len(down.kinds) == len(down.periods) == 27
    for value, found in zip(down.values, down.attractors, strict=True):
        assert found.motion.frequency_ratio == value
        assert found.motion.amplitude == 2.0
        if found.orbit is not None:
            is_an_orbit_that_attracts(found)


def test_downwards_it_goes_through_the_paper_s_sequence(down: AttractorSweep) -> None:
    # Symmetric, leaning below 1.948378 (TW6), doubled at 1.78, gone by 1.77 (TW7).
    for value, kind, period in zip(down.values, down.kinds, down.periods, strict=True):
        if value > 1.9484:
            assert (kind, period) == ("symmetric", 1)
        elif value > 1.7893:
            assert (kind, period) == ("unsymmetric", 1)
        elif value > 1.7747:
            assert (kind, period) == ("unsymmetric", 2)
        else:
            assert kind == "overturned"
    assert min(down.values[k] for k in range(27) if down.kinds[k] != "overturned") < 1.781


def test_its_orbits_lie_on_one_branch(down: AttractorSweep) -> None:
    # Carried along it does not jump from one image to the other.
    leaning = [p for p, kind in zip(down.peaks, down.kinds, strict=True) if kind == "unsymmetric"]
    signs = {math.copysign(1.0, peaks.max() + peaks.min()) for peaks in leaning[1:]}
    assert len(signs) == 1
    highest = [np.abs(peaks).max() for peaks in leaning]
    assert all(b > a for a, b in pairwise(highest))


def test_up_and_down_it_shows_the_hysteresis_between_two_folds() -> None:
    # Between 1.62 and more, order 3 lives beside order 1: which one is kept is a matter of history.
    block = DimensionlessBlock(restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=6.0)
    values = np.linspace(2.0, 1.5, 26)
    falling = sweep_attractor(block, shaking, "amplitude", values, start=Steady(order=3))
    fold = 1.6199920091  # eq 23
    for value, period in zip(values, falling.periods, strict=True):
        if value > fold + 1e-3:  # nearer to it the basin is smaller than the steps
            assert period == 3
        else:
            assert period != 3
    rising = sweep_attractor(block, shaking, "amplitude", values[::-1], start=Steady(order=1))
    assert 3 not in rising.periods[:6]
    both = dict(zip(values[::-1].tolist(), rising.periods, strict=True))
    assert any(both[v] != p for v, p in zip(values.tolist(), falling.periods, strict=True))


def test_peaks_are_those_of_the_orbit() -> None:
    found = trail("amplitude", [1.0, 1.02, 1.04], start=Steady())
    for value, peaks in zip(found.values, found.peaks, strict=True):
        exact = np.asarray(steady_states(value, 2.0, 0.8).peak)[0]
        assert sorted(peaks) == pytest.approx([-exact, exact], abs=1e-9)
    orbit = found.attractors[1].orbit
    assert orbit is not None
    (*_, last) = follow_branch(orbit, "amplitude", (1.0, 1.04))
    assert sorted(last.peaks) == pytest.approx(sorted(found.peaks[2]), abs=1e-9)


def test_one_value_is_what_attractor_says() -> None:
    for frequency in (1.85, 3.0, 6.0):
        for start in (Rest(), State(angle=0.3, velocity=0.1)):
            shaking = Harmonic(amplitude=1.5, frequency_ratio=frequency)
            (found,) = sweep_attractor(
                BLOCK, SHAKING, "frequency_ratio", [frequency], start=start
            ).attractors
            alone = find_attractor(
                BLOCK, Harmonic(amplitude=2.0, frequency_ratio=frequency), start=start
            )
            assert found.kind is alone.kind
            assert found.peaks == alone.peaks
            assert shaking.frequency_ratio == frequency


def test_a_mirrored_start_has_a_mirrored_trail() -> None:
    # At the first value the symmetric orbit is unstable, and left to a side that is named.
    values = np.linspace(1.93, 1.8, 6)
    one, other = (trail("frequency_ratio", values, start=Steady(side=side)) for side in (1, -1))
    assert one.kinds == other.kinds
    for mine, theirs, kind in zip(one.peaks, other.peaks, one.kinds, strict=True):
        if kind == "unsymmetric":
            assert sorted(mine) == pytest.approx(sorted(-theirs), abs=1e-7)


def test_after_a_fall_or_a_rest_it_begins_again() -> None:
    found = trail("amplitude", [2.0, 0.5, 2.0, 40.0, 2.0], start=Steady())
    assert found.kinds == ["symmetric", found.kinds[1], "symmetric", "overturned", "symmetric"]
    assert found.peaks[3].size == 0
    assert found.peaks[2] == pytest.approx(found.peaks[0], abs=1e-9)
    quiet = trail("amplitude", [0.0, 0.5])
    assert quiet.kinds == ["rest", "rest"]
    assert all(peaks.size == 0 for peaks in quiet.peaks)
    assert quiet.periods == [None, None]


def test_chaos_goes_on_from_where_it_was_and_shows_many_peaks() -> None:
    block = DimensionlessBlock(restitution=0.5)
    shaking = Harmonic(amplitude=1.7347, frequency_ratio=1.0)
    values = [1.6633, 1.66331]
    found = sweep_attractor(block, shaking, "frequency_ratio", values, max_cycles=3000)
    assert found.attractors[0].kind is AttractorKind.APERIODIC
    first = found.attractors[0].state
    assert first is not None
    assert math.cos(found.attractors[1].motion.phase - first.phase) == pytest.approx(1.0)
    peaks = found.peaks[0]
    assert 100 < len(peaks) <= SHOWN_FLIGHTS
    assert np.isfinite(peaks).all()
    assert (np.sign(peaks[1:]) == -np.sign(peaks[:-1])).mean() > 0.9


def test_of_an_orbit_with_rests_the_first_bounces_stand_for_all() -> None:
    block = DimensionlessBlock(restitution=0.5)
    shaking = Harmonic(amplitude=1.1, frequency_ratio=2.0)
    found = find_attractor(block, shaking)
    assert found.orbit is not None
    assert found.orbit.rest_phases > 0
    peaks = flight_peaks(found)
    assert peaks.max() == pytest.approx(found.orbit.highest)
    assert peaks.min() == pytest.approx(found.orbit.lowest)
    assert find_orbits(block, shaking, seeds=4)


@every(
    ("change", "said"),
    [
        ({"parameter": "phase"}, "parameter = 'phase'"),
        ({"parameter": ["amplitude"]}, "parameter = ['amplitude']"),
        ({"values": []}, "values = []"),
        ({"values": 1.0}, "values = 1.0"),
        ({"values": [[1.0, 2.0]]}, "values = [[1.0, 2.0]]"),
        ({"values": ["a"]}, "values = ['a']"),
        ({"values": [1.0, math.nan]}, "amplitude = nan"),
        ({"values": [1.0, -1.0]}, "amplitude = -1.0"),
        ({"parameter": "frequency_ratio", "values": [0.0]}, "frequency_ratio = 0.0"),
        ({"max_cycles": 0}, "max_cycles = 0"),
        ({"start": 3}, "start = 3"),
        ({"block": None}, "block = None"),
    ],
)
def test_what_is_out_of_range_is_refused(change: dict[str, object], said: str) -> None:
    given: dict[str, object] = {
        "block": BLOCK,
        "shaking": SHAKING,
        "parameter": "amplitude",
        "values": [1.0],
        **change,
    }
    block, shaking, parameter, values = (
        given.pop(name) for name in ("block", "shaking", "parameter", "values")
    )
    with pytest.raises(InputError) as raised:
        sweep_attractor(block, shaking, parameter, values, **given)  # type: ignore[arg-type]
    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


def test_only_periodic_shaking_has_trails() -> None:
    with pytest.raises(ModelError, match="those of periodic shaking"):
        sweep_attractor(BLOCK, Still(), "amplitude", [1.0])  # type: ignore[arg-type]
