"""Steps with no impact and with one, against the roots of their polynomials."""

import numpy as np

from rocksteady.kernels.nonlinear_lanes._ends import all_terms_there, find_places
from rocksteady.kernels.nonlinear_lanes._layout import (
    ANGLE,
    CHANGES,
    FLYING,
    HIGH,
    LANDED,
    LANES,
    LOW,
    OPEN,
    PLACE,
    POINTS,
    SIZE,
    SLOPE,
    SLOW,
    STAGE,
    TERMS,
    TOP,
    VALUE,
)
from rocksteady.kernels.nonlinear_lanes._signs import approach, count_changes
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


def test_values_and_slopes_are_those_of_all_terms() -> None:
    rng = np.random.default_rng(11)
    lanes = np.zeros(SIZE)
    polynomials(lanes)[:] = rng.normal(size=(TERMS, LANES))
    places = np.append(np.array([0.0, 1.0]), rng.uniform(0.0, 1.0, LANES - 2))
    field(lanes, PLACE)[:] = places
    all_terms_there(lanes)
    for k, (place, terms) in enumerate(zip(places, polynomials(lanes).T, strict=True)):
        curve = np.polynomial.Polynomial(terms)
        size = np.abs(terms).sum()
        assert abs(field(lanes, VALUE)[k] - curve(place)) < 1e-14 * size
        assert abs(field(lanes, SLOPE)[k] - curve.deriv()(place)) < 1e-13 * TERMS * size
    # Each term alone has its place.
    for n in range(TERMS):
        lanes[:] = 0.0
        polynomials(lanes)[n] = 2.0
        field(lanes, PLACE)[:] = 0.5
        all_terms_there(lanes)
        assert (field(lanes, VALUE) == 2.0 * 0.5**n).all(), n
        assert (field(lanes, SLOPE) == (2.0 * n * 0.5 ** (n - 1) if n else 0.0)).all(), n


def test_the_first_steps_lead_to_the_zero_of_the_first_terms() -> None:
    rng = np.random.default_rng(12)
    lanes = np.zeros(SIZE)
    roots = rng.uniform(0.05, 0.95, LANES)
    for k, root in enumerate(roots):
        # One zero inside, the others far away, of degree 10 with unlike terms.
        others = np.append(rng.uniform(3.0, 6.0, 5), rng.uniform(-6.0, -3.0, 4))
        curve = np.polynomial.Polynomial.fromroots([root, *others])
        polynomials(lanes)[: TOP + 1, k] = curve.coef * np.sign(curve(0.0))
    field(lanes, CHANGES)[:] = np.resize([1.0, 1.0, 0.0], LANES)
    guesses = np.clip(roots + rng.uniform(-0.1, 0.1, LANES), 0.02, 1.0)
    field(lanes, PLACE)[:] = guesses
    approach(lanes)
    for k, root in enumerate(roots):
        if field(lanes, CHANGES)[k] == 1.0:
            assert abs(field(lanes, PLACE)[k] - root) < 1e-9, k
        else:
            assert field(lanes, PLACE)[k] == guesses[k], k


def test_a_step_out_of_its_range_goes_half_of_the_way_to_the_guess() -> None:
    lanes = np.zeros(SIZE)
    # 1 + t falls nowhere: Newton's step leads below 0, and flat ground leads nowhere.
    polynomials(lanes)[0] = 1.0
    polynomials(lanes)[1] = np.resize([1.0, 0.0, -0.5], LANES)
    field(lanes, CHANGES)[:] = 1.0
    field(lanes, PLACE)[:] = 0.4
    approach(lanes)
    assert (field(lanes, PLACE) == 0.4).all()


def test_a_bracket_closes_on_the_zero_and_stops_there() -> None:
    lanes = np.zeros(SIZE)
    roots = np.linspace(0.03, 0.97, LANES)
    for k, root in enumerate(roots):
        polynomials(lanes)[:4, k] = -np.polynomial.Polynomial.fromroots([root, -2.0, -3.0]).coef
    field(lanes, CHANGES)[:] = 1.0
    field(lanes, STAGE)[:] = np.resize([FLYING, LANDED, SLOW, 0.0], LANES)
    field(lanes, PLACE)[:] = 0.5
    find_places(lanes)
    for k, root in enumerate(roots):
        if field(lanes, STAGE)[k] in (FLYING, LANDED):
            assert abs(field(lanes, LOW)[k] - root) < 1e-14, k
            assert field(lanes, OPEN)[k] == 0.0
        else:
            assert (field(lanes, LOW)[k], field(lanes, HIGH)[k]) == (0.0, 1.0), k
