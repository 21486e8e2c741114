"""Steps with no impact and with one, against the roots of their polynomials."""

import numpy as np

from rocksteady.kernels.nonlinear_lanes._ends import find_places
from rocksteady.kernels.nonlinear_lanes._layout import (
    ANGLE,
    CHANGES,
    LANES,
    PLACE,
    POINTS,
    SIZE,
    TOP,
)
from rocksteady.kernels.nonlinear_lanes._signs import count_changes
from tests.kernels.nonlinear_lanes.flights import field, in_flight, one_step, polynomials
from tests.strategies import sample_size

Floats = np.ndarray


def roots_inside(terms: Floats, floor: bool) -> Floats:
    """Return the real roots of a polynomial in (0, 1], but for that of a start from the floor."""
    roots = np.roots(terms[::-1][:-1] if floor else terms[::-1])
    real = roots[np.abs(roots.imag) < 1e-9].real
    return np.sort(real[(real > 0.0) & (real <= 1.0)])


def test_signs_count_the_roots_of_a_step() -> None:
    kinds = {0: 0, 1: 0}
    for seed in range(sample_size(40, 3)):
        lanes = in_flight(np.random.default_rng(seed))
        one_step(lanes)
        changes = field(lanes, CHANGES).copy()
        find_places(lanes)
        for k, (count, terms) in enumerate(zip(changes, polynomials(lanes).T, strict=True)):
            roots = roots_inside(terms, bool(field(lanes, ANGLE)[k] == 0.0))
            if count in kinds:
                kinds[int(count)] += 1
                assert len(roots) == count
            if count == 1:
                # `LOW` holds the place too; here the last one that was looked at.
                assert abs(field(lanes, PLACE)[k] - roots[0]) < 1e-8
    assert min(kinds.values()) > sample_size(200, 10)


def test_the_guess_is_the_root_of_a_straight_line() -> None:
    """The control points of a line lie on it, wherever among them the sign changes."""
    expected = np.linspace(0.02, 0.98, 2 * LANES)
    for roots in (expected[::2], expected[1::2]):
        lanes = np.zeros(SIZE)
        field(lanes, ANGLE)[:] = 1.0
        field(lanes, POINTS)[:] = 1.0
        field(lanes, POINTS + LANES)[:] = -1.0 / (TOP * roots)
        count_changes(lanes)
        assert (field(lanes, CHANGES) == 1.0).all()
        np.testing.assert_allclose(field(lanes, PLACE), roots, rtol=1e-12)
