"""The curves of the plane of frequency and amplitude."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.dynamics.steady.regions import REGIONS
from rocksteady.errors import InputError
from rocksteady.formulas import (
    heteroclinic_amplitude,
    melnikov_amplitude,
    steady_states,
    symmetry_breaking_amplitude,
    symmetry_breaking_frequencies,
)
from rocksteady.orbits import compute_region_boundaries, compute_region_map
from tests.dynamics.formulae import printed_boundaries
from tests.every import every
from tests.strategies import logarithmic

orders = st.sampled_from([1, 3, 5])
TABLE = [
    (0.5, 1, 4.0, 0.70825, 0.79129, 1.58816),
    (0.8, 3, 6.0, 1.61999, 1.76805, 4.04406),
    (0.95, 1, 10.0, 0.06281, 0.06286, 1.57358),
    (0.5, 3, 8.0, 3.50833, 6.06806, 4.29984),
]


@every(("r", "n", "w", "existence", "kind", "sign"), TABLE)
def test_tw2_boundaries(
    r: float, n: int, w: float, existence: float, kind: float, sign: float
) -> None:
    curves = compute_region_boundaries(w, r, order=n)
    assert curves.existence == pytest.approx(existence, abs=5.1e-6)
    assert curves.kind == pytest.approx(kind, abs=5.1e-6)
    assert curves.sign == pytest.approx(sign, abs=5.1e-6)


@every(("r", "n", "w", "existence", "kind", "sign"), TABLE)
def test_tw2_regions_between_the_boundaries(
    r: float, n: int, w: float, existence: float, kind: float, sign: float
) -> None:
    middle = 5 if sign < kind else 1
    placed = [
        (0.5 * existence, 4),
        (existence - 2e-5, 4),
        (existence + 2e-5, 3),
        (min(kind, sign) - 2e-5, 3),
        (min(kind, sign) + 2e-5, middle),
        (max(kind, sign) - 2e-5, middle),
        (max(kind, sign) + 2e-5, 2),
        (100.0, 2),
    ]
    amplitudes, regions = zip(*placed, strict=True)
    assert steady_states(amplitudes, w, r, order=n).region.tolist() == list(regions)


def test_every_region_occurs_in_figure_4a() -> None:
    found = steady_states(
        np.linspace(0.0, 12.0, 61)[:, np.newaxis], np.linspace(0.5, 14.0, 28), 0.5, order=3
    ).region
    assert set(np.unique(found).tolist()) == {1, 2, 3, 4, 5}


def test_the_words_of_a_region_are_those_of_its_solutions() -> None:
    states = steady_states(
        np.linspace(0.0, 12.0, 61)[:, np.newaxis], np.linspace(0.5, 14.0, 28), 0.5, order=3
    )
    assert set(REGIONS) == {1, 2, 3, 4, 5}
    for region, words in REGIONS.items():
        here = states.region == region
        if region == 4:
            assert words == "no symmetric solution"
            assert np.isnan(states.phase[:, here]).all()
            continue
        in_phase = states.in_phase[:, here].sum(axis=0)
        assert (in_phase == (2 if "two in-phase" in words else 1)).all()
        negative = (states.phase[:, here] < 0.0).sum(axis=0)
        assert (negative == (1 if "negative phase" in words else 0)).all()


@given(logarithmic(0.1, 100.0), st.floats(0.05, 0.999), orders)
def test_boundaries_are_the_printed_formulae(w: float, r: float, n: int) -> None:
    curves = compute_region_boundaries(w, r, order=n)
    assert (curves.existence, curves.sign, curves.kind) == pytest.approx(
        printed_boundaries(w, r, n), rel=1e-13
    )


@given(logarithmic(0.1, 100.0), st.floats(0.05, 0.999), orders)
def test_e8_region_3_never_disappears(w: float, r: float, n: int) -> None:
    curves = compute_region_boundaries(w, r, order=n)
    p = (1.0 - r) / (1.0 + r) * math.tanh(n * math.pi / (2.0 * w)) * w
    assert curves.existence / curves.kind == pytest.approx(1.0 / math.sqrt(1.0 + p * p))
    assert curves.existence < curves.kind


@every(("w", "amplitude"), [(1.0, 0.105118), (2.0, 0.261712), (5.0, 1.323365)])
def test_b1_heteroclinic_amplitude(w: float, amplitude: float) -> None:
    assert heteroclinic_amplitude(w, 0.9) == pytest.approx(amplitude, abs=5.1e-7)


def test_the_heteroclinic_curve_is_the_existence_curve_of_long_half_cycles() -> None:
    w = np.geomspace(0.1, 20.0, 15)
    long = compute_region_boundaries(w, 0.8, order=999).existence
    np.testing.assert_allclose(heteroclinic_amplitude(w, 0.8), long, rtol=1e-14)


@given(logarithmic(0.1, 5.0))
def test_melnikovs_estimate_is_the_first_order_of_the_heteroclinic_amplitude(w: float) -> None:
    for loss in (1e-4, 1e-6):
        exact = heteroclinic_amplitude(w, 1.0 - loss)
        assert melnikov_amplitude(w, 1.0 - loss) == pytest.approx(
            float(exact), rel=2.0 * loss * (1 + w * w)
        )
    assert melnikov_amplitude(2.0, 0.9) == pytest.approx(0.25)


@every(
    ("order", "amplitude", "expected"),
    [
        (1, 1.0, 1.448324),
        (1, 2.0, 1.948378),
        (1, 3.0, 2.345723),
        (1, 4.0, 2.690687),
        (1, 6.0, 3.291248),
        (3, 1.0, 2.957132),
        (3, 2.0, 4.249471),
        (3, 3.0, 5.237990),
        (3, 4.0, 6.143263),
        (3, 6.0, 7.959945),
    ],
)
def test_tw6_symmetry_breaking(order: int, amplitude: float, expected: float) -> None:
    found = symmetry_breaking_frequencies(amplitude, 0.8, order=order)
    assert np.abs(found - expected).min() < 5.1e-7
    for ratio in found:
        assert symmetry_breaking_amplitude(ratio, 0.8, order=order) == pytest.approx(amplitude)
        states = steady_states(amplitude, ratio, 0.8, order=order)
        assert states.half_cycle_multipliers[0, 0] == pytest.approx(-1.0, abs=1e-9)


def test_symmetry_breaking_frequencies_ascend_and_none_is_left_out() -> None:
    for amplitude in (0.5, 2.0, 5.0):
        found = symmetry_breaking_frequencies(amplitude, 0.8, order=3)
        assert (np.diff(found) > 0.0).all()
        w = np.geomspace(0.011, 900.0, 20_000)
        above = symmetry_breaking_amplitude(w, 0.8, order=3) > amplitude
        known = ~np.isnan(symmetry_breaking_amplitude(w, 0.8, order=3))
        changes = int((np.diff(above.astype(int))[known[1:] & known[:-1]] != 0).sum())
        assert len(found) == changes


@given(logarithmic(0.5, 30.0), st.floats(0.3, 0.98), orders)
def test_branch_1_is_stable_just_below_symmetry_breaking_and_not_above(
    w: float, r: float, n: int
) -> None:
    amplitude = float(symmetry_breaking_amplitude(w, r, order=n))
    if math.isnan(amplitude):
        return
    limit = -(1.0 + r * r)
    below, at, above = steady_states(
        [amplitude * (1.0 - 1e-4), amplitude, amplitude * (1.0 + 1e-4)], w, r, order=n
    ).trace[0]
    if math.isnan(below):  # the curve is that close to the existence boundary
        return
    assert at == pytest.approx(limit, rel=1e-8)
    assert below > limit > above


@every(
    ("function", "arguments"),
    [
        (compute_region_boundaries, (0.0, 0.8)),
        (compute_region_boundaries, (4.0, 1.2)),
        (heteroclinic_amplitude, (math.nan, 0.8)),
        (heteroclinic_amplitude, (1.0, 0.0)),
        (melnikov_amplitude, (-1.0, 0.8)),
        (symmetry_breaking_amplitude, (4.0, "0.8")),
        (symmetry_breaking_frequencies, (0.0, 0.8)),
        (symmetry_breaking_frequencies, (2.0, 1.5)),
    ],
)
def test_bad_arguments_are_refused(function: Any, arguments: tuple[Any, ...]) -> None:
    with pytest.raises(InputError):
        function(*arguments)


@every("function", [compute_region_boundaries, symmetry_breaking_amplitude, compute_region_map])
def test_an_even_order_is_refused_with_the_reason(function: Any) -> None:
    with pytest.raises(InputError, match="odd number of half periods"):
        function(4.0, 0.8, order=2)
    with pytest.raises(InputError, match="odd number of half periods"):
        symmetry_breaking_frequencies(2.0, 0.8, order=2)


def test_a_region_map_holds_every_curve() -> None:
    w = np.linspace(1.0, 10.0, 19)
    curves = compute_region_map(w, 0.8, order=3)
    assert (curves.restitution, curves.order) == (0.8, 3)
    parts = compute_region_boundaries(w, 0.8, order=3)
    np.testing.assert_array_equal(curves.frequency_ratio, w)
    np.testing.assert_array_equal(curves.existence, parts.existence)
    np.testing.assert_array_equal(curves.sign, parts.sign)
    np.testing.assert_array_equal(curves.kind, parts.kind)
    np.testing.assert_array_equal(curves.heteroclinic, heteroclinic_amplitude(w, 0.8))
    np.testing.assert_array_equal(
        curves.symmetry_breaking, symmetry_breaking_amplitude(w, 0.8, order=3)
    )


@every("function", [compute_region_boundaries, compute_region_map])
def test_curves_at_no_frequency_describe_themselves(function: Any) -> None:
    curves = function([], 0.8)
    assert "Ω none" in repr(curves)
    assert curves.to_dict()["existence"] == []
