"""Orbits as chains: made of orbits, turned, mirrored, doubled and halved."""

from dataclasses import replace

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_orbits
from rocksteady.dynamics.continuation.chains.chain import Chain
from rocksteady.dynamics.continuation.from_orbit import chain_of
from rocksteady.errors import ModelError
from rocksteady.formulas import steady_states
from rocksteady.orbits import Orbit
from tests.dynamics.continuation.branches import setting, symmetric_start


@pytest.fixture(scope="module")
def many() -> list[Orbit]:
    points = [(1.0, 2.0, 0.8), (2.0, 1.9, 0.8), (4.0, 6.0, 0.8), (2.0, 1.78, 0.8)]
    found = [each for point in points for each in find_orbits(*setting(point), seeds=24)]
    return [each for each in found if each.admissible and not each.rest_phases]


def turned(chain: Chain, begin: int) -> Chain:
    """Return the chain begun at another impact: after an odd number of them the mirror image."""
    turns = np.concatenate([chain.turns[begin:], chain.turns[:begin] + chain.half_cycles])
    phases = np.concatenate([chain.phases[begin:], chain.phases[:begin]])
    return replace(chain, turns=turns + begin % 2, phases=phases)


def shifted(chain: Chain, amount: float) -> Chain:
    return chain.moved(chain.phases + amount, chain.parameters)


def test_the_chain_of_an_orbit_closes_with_its_data(many: list[Orbit]) -> None:
    assert len(many) > 15
    for orbit in many:
        chain = chain_of(orbit)
        size = max(1.0, orbit.largest_multiplier)
        assert np.abs(chain.errors).max() < 1e-11 * size
        assert (chain.period, chain.symmetric) == (orbit.period, orbit.symmetric)
        assert chain.impacts == len(orbit.states) // (2 if orbit.symmetric else 1)
        assert chain.half_cycles == orbit.period * (1 if orbit.symmetric else 2)
        assert chain.admissible
        assert chain.shortest > 0.0
        assert chain.clearance > 0.0
        first, second = orbit.multipliers
        assert chain.multipliers[0] == pytest.approx(first, rel=1e-6, abs=1e-9)
        assert np.prod(chain.multipliers) == pytest.approx(first * second, rel=1e-9)
        assert max(chain.peaks) == pytest.approx(orbit.highest, abs=1e-10 * size)
        assert min(chain.peaks) == pytest.approx(orbit.lowest, abs=1e-10 * size)
        sections = chain.sections
        assert len(sections) == len(orbit.states)
        speeds = sorted(section.speed for section in sections)
        assert speeds == pytest.approx(sorted(s.speed for s in orbit.states), abs=1e-10 * size)
        assert [section.side for section in sections] == [1, -1] * (len(sections) // 2)


def test_mirror_images_are_one_orbit_only_if_one_says_so(many: list[Orbit]) -> None:
    for orbit in many:
        chain, image = chain_of(orbit), chain_of(orbit.mirrored)
        size = 1e-9 * max(1.0, orbit.largest_multiplier)
        assert chain.repeats(image, size, mirrors=True)
        assert chain.repeats(image, size) is orbit.symmetric


def test_an_orbit_begun_elsewhere_is_the_same(many: list[Orbit]) -> None:
    for orbit in many:
        chain = chain_of(orbit)
        for begin in range(0, chain.impacts, 1 if chain.symmetric else 2):
            other = turned(chain, begin)
            assert chain.repeats(other, 1e-9)
            assert other.repeats(chain, 1e-9)
        later = replace(chain, turns=chain.turns + 2)
        assert chain.repeats(later, 1e-9)
        # Half a period later the block is on the other side.
        assert not chain.repeats(replace(chain, turns=chain.turns + 1), 1e-9)
        assert not chain.repeats(shifted(chain, 1e-3), 1e-4, mirrors=True)


def test_orbits_at_one_point_are_told_apart() -> None:
    found = [o for o in find_orbits(*setting((4.0, 6.0, 0.8)), seeds=24) if o.admissible]
    chains = [chain_of(each) for each in found if not each.rest_phases]
    for i, one in enumerate(chains):
        for other in chains[:i]:
            assert not one.repeats(other, 1e-4, mirrors=True)


def test_doubled_and_halved_undo_each_other(many: list[Orbit]) -> None:
    for orbit in many:
        chain = chain_of(orbit)
        twice = chain.doubled()
        assert np.abs(twice.errors).max() < 1e-11 * max(1.0, orbit.largest_multiplier)
        half = twice.halved()
        assert half is not None
        assert half.distance(chain) < 1e-12
        assert half.half_cycles == chain.half_cycles
        assert twice.primitive(1e-9).distance(chain) < 1e-12
        assert chain.primitive(1e-9) is chain
        squares = chain.multipliers if chain.symmetric else chain.multipliers**2
        found, exact = twice.multipliers[0], squares[0]
        assert found.real == pytest.approx(exact.real, rel=1e-6, abs=1e-9)
        assert abs(found.imag) == pytest.approx(abs(exact.imag), rel=1e-6, abs=1e-9)


def test_what_cannot_be_half_of_something_is_not_halved() -> None:
    chain = chain_of(symmetric_start(2.0, 2.0, 0.8))
    assert chain.halved() is None  # one impact
    twice = chain.doubled()
    assert replace(twice, half_cycles=4).halved() is None  # an odd chain has odd half cycles
    thrice = chain._repeated(3)
    assert thrice.halved() is None
    assert thrice.primitive(1e-9).distance(chain) < 1e-12


def test_half_of_a_chain_that_leans_is_the_mean_of_its_halves() -> None:
    twice = chain_of(symmetric_start(2.0, 2.0, 0.8)).doubled()
    leaning = twice.moved(twice.phases + np.array([0.1, -0.1]), twice.parameters)
    half = leaning.halved()
    assert half is not None
    assert half.doubled().distance(twice) < 1e-12
    assert half.doubled().distance(leaning) == pytest.approx(0.1)
    assert leaning.primitive(0.05) is leaning


def test_determinants_vanish_at_the_closed_forms() -> None:
    # TW5: the trace of half a cycle is 1 + restitution^2 at a fold, and less that where it breaks.
    for frequency in (1.5, 2.0, 4.0):
        states = steady_states(2.0, frequency, 0.8)
        chain = chain_of(symmetric_start(2.0, frequency, 0.8))
        trace, loss = float(states.trace[0]), 0.8**2
        for closing in (1.0, -1.0):
            band = np.abs(chain.table[:, [4, 5, 6]]).sum()
            expected = abs(closing**2 - closing * trace + loss)
            ratio = abs(chain.determinant(closing)) * band / expected
            assert ratio == pytest.approx(abs(chain.table[0, 6]), rel=1e-9)


def test_the_null_direction_is_what_the_matrix_forgets() -> None:
    chain = chain_of(symmetric_start(2.0, 2.0, 0.8)).doubled()
    direction = chain.null_direction(-1.0)
    assert np.linalg.norm(direction) == pytest.approx(1.0)
    values = np.linalg.svd(chain.matrix(-1.0))[1]
    assert np.linalg.norm(chain.matrix(-1.0) @ direction) == pytest.approx(values[-1])


def test_an_orbit_that_comes_to_rest_is_no_chain() -> None:
    found = find_orbits(
        DimensionlessBlock(restitution=0.5), Harmonic(amplitude=1.1, frequency_ratio=2.0), seeds=4
    )
    (rest,) = (each for each in found if each.rest_phases)
    with pytest.raises(ModelError, match="comes to rest") as raised:
        chain_of(rest)
    assert "\n" not in str(raised.value)


def test_a_chain_without_flights_is_told() -> None:
    chain = chain_of(symmetric_start(2.0, 2.0, 0.8)).doubled()
    merged = replace(chain, turns=np.zeros(2, dtype=np.int64), phases=np.full(2, 1.0))
    assert merged.shortest == 0.0
    assert not merged.admissible
    assert merged.peaks[0] == 0.0
    assert np.isnan(merged.multipliers).all()
