"""What stands side by side: against single calls, published motions, and itself."""

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Execution, Harmonic, find_orbits
from rocksteady.studies.atlas.analysis.coexistence import (
    MOST,
    OrbitClass,
    coexistence,
    starts,
)
from rocksteady.studies.atlas.analysis.plane import Plane
from tests.every import every
from tests.studies.atlas.small import plane, small

BLOCK = DimensionlessBlock(restitution=0.8)


@every("period", [1, 3, 12])
@every("impacts", [None, 0, 2, 18, 12_345])
@every("unsymmetric", [False, True])
def test_a_code_stands_for_its_class(period: int, impacts: int | None, unsymmetric: bool) -> None:
    kind = OrbitClass(period, impacts, unsymmetric)
    assert kind.code > 0
    assert OrbitClass.of(kind.code) == kind


def test_classes_have_names() -> None:
    assert OrbitClass(3, 6, unsymmetric=True).text == "3x6-unsymmetric"
    assert OrbitClass(1, None, unsymmetric=False).text == "1xrests"
    assert (
        OrbitClass(1, 2, unsymmetric=False).words == "a symmetric motion of 1 period and 2 impacts"
    )


@pytest.mark.slow
def test_every_orbit_that_the_search_calls_stable_is_one() -> None:
    compared, places = 0, 3
    found, rng = small().found, np.random.default_rng(4)
    rows, columns = np.nonzero(found.orbits >= 2)
    for place in rng.choice(len(rows), 6, replace=False)[:places]:
        row, column = int(rows[place]), int(columns[place])
        shaking = Harmonic(
            amplitude=float(plane().amplitudes[row]), frequency_ratio=float(plane().ratios[column])
        )
        kinds = [OrbitClass.of(code) for code in found.codes[:, row, column].tolist() if code]
        for kind in kinds:
            if kind.period not in (1, 3, 5) or kind.impacts != 2:
                continue
            compared += 1
            several = find_orbits(BLOCK, shaking, max_period=kind.period, max_impacts=2, seeds=48)
            assert any(
                orbit.stable and orbit.period == kind.period and orbit.symmetric != kind.unsymmetric
                for orbit in several
            )
    assert compared >= places


@pytest.mark.slow
def test_counts_are_those_of_the_parts() -> None:
    found = small().found
    np.testing.assert_array_equal(
        found.motions, found.rest.astype(int) + found.aperiodic + found.orbits
    )
    assert found.codes.shape == (MOST, *found.motions.shape)
    np.testing.assert_array_equal((found.codes > 0).sum(axis=0), found.orbits)
    counted = sum(found.classes.values())
    assert counted <= (found.codes > 0).sum()


def test_rest_lasts_below_uplift_and_only_there() -> None:
    found = small().found
    below = np.broadcast_to((plane().amplitudes < 1.0)[:, np.newaxis], found.rest.shape)
    np.testing.assert_array_equal(found.rest, below)


def test_mirror_images_count_once() -> None:
    # At A = 2.4, Omega = 2 there are two unsymmetric harmonic motions, mirror images, and no other.
    small_plane = Plane(
        restitution=0.8, amplitude=[2.3, 2.4, 2.5], frequency_ratio=[1.99, 2.0, 2.01]
    )
    found = coexistence(small_plane)
    assert found.text_at(1, 1).split()[0] == "1x2-unsymmetric"
    assert found.text_at(1, 1).count("1x2") == 1


@pytest.mark.slow
def test_the_answer_does_not_depend_on_the_workers() -> None:
    few = Plane(restitution=0.8, amplitude=[1.0, 3.0, 5.0], frequency_ratio=[3.0, 6.0, 9.0])
    one, other = (
        coexistence(few, run=Execution(workers=1)),
        coexistence(few, run=Execution(workers=3)),
    )
    np.testing.assert_array_equal(one.codes, other.codes)
    np.testing.assert_array_equal(one.motions, other.motions)


def test_starts_are_states_that_a_block_can_have() -> None:
    amplitude, ratio = np.array([0.2, 3.0, 8.0]), np.array([0.3, 4.0, 12.0])
    for velocity, phase in starts(amplitude, ratio, 0.8):
        assert velocity.shape == phase.shape == amplitude.shape
        assert np.isfinite(velocity).all()
        assert (velocity >= 0.0).all()  # mirror images count once
        assert np.isfinite(phase).all()


def test_progress_is_told_in_cells() -> None:
    said: list[int] = []
    few = Plane(restitution=0.8, amplitude=[1.0, 3.0, 5.0], frequency_ratio=[3.0, 6.0, 9.0])
    coexistence(few, run=Execution(progress=said.append))
    assert said[0] == 0
    assert sum(said) == 9
