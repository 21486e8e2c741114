"""Steady states over arrays: shapes, bad arguments, datasets."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.errors import InputError
from rocksteady.formulas import steady_states
from tests.dynamics.points import checked, orders
from tests.every import every
from tests.strategies import logarithmic

# ----------------------------------------------------------------- shapes and bad arguments


def test_arrays_broadcast_and_each_element_is_the_scalar_call() -> None:
    a = np.array([0.1, 0.75, 2.0, 6.0])[:, np.newaxis, np.newaxis]
    w, n = np.array([2.0, 4.0, 9.0])[:, np.newaxis], np.array([1, 3])
    grid = steady_states(a, w, 0.8, order=n)
    assert grid.region.shape == grid.order.shape == grid.amplitude.shape == (4, 3, 2)
    assert grid.phase.shape == checked(grid.peak).shape == grid.stable.shape == (2, 4, 3, 2)
    assert grid.multipliers.shape == (2, 4, 3, 2, 2)
    for index in np.ndindex(4, 3, 2):
        i, j, k = index
        one = steady_states(a[i, 0, 0], w[j, 0], 0.8, order=int(n[k]))
        assert one.region.shape == ()
        assert one.phase.shape == (2,)
        assert one.multipliers.shape == (2, 2)
        assert grid.region[index] == one.region
        for name in ("phase", "velocity", "trace", "peak", "extrema", "admissible", "stable"):
            np.testing.assert_array_equal(
                getattr(grid, name)[(slice(None), *index)], getattr(one, name)
            )
        np.testing.assert_array_equal(grid.multipliers[(slice(None), *index)], one.multipliers)


def test_arrays_of_any_memory_order_and_of_integers_give_the_same() -> None:
    a = np.array([[1, 2, 3], [4, 5, 6]])
    plain = steady_states(a.astype(float), 4.0, 0.8)
    for same in (a, np.asfortranarray(a), a.T.copy().T, a.tolist(), a.astype(np.int8)):
        np.testing.assert_array_equal(steady_states(same, 4, 0.8).phase, plain.phase)


def test_empty_arrays_give_empty_results() -> None:
    states = steady_states(np.zeros((0, 3)), 4.0, 0.8)
    assert states.phase.shape == (2, 0, 3)
    assert states.stable.shape == (2, 0, 3)
    assert states.multipliers.shape == (2, 0, 3, 2)
    assert steady_states([], [], []).region.shape == (0,)


def test_results_do_not_share_memory_with_the_arguments() -> None:
    a = np.array([1.0, 2.0])
    states = steady_states(a, 4.0, 0.8)
    phase = states.phase.copy()
    a[:] = 0.0
    np.testing.assert_array_equal(states.amplitude, [1.0, 2.0])
    np.testing.assert_array_equal(states.phase, phase)


@pytest.mark.parametrize("restitution", [0.8, 1.0])
def test_nothing_exists_without_shaking(restitution: float) -> None:
    states = steady_states(0.0, 4.0, restitution)
    assert states.region == 4
    assert np.isnan(states.phase).all()


def test_without_shapes_the_rest_is_the_same_and_stability_is_refused() -> None:
    whole, bare = steady_states(2.0, 4.0, 0.8), steady_states(2.0, 4.0, 0.8, with_shapes=False)
    np.testing.assert_array_equal(whole.phase, bare.phase)
    np.testing.assert_array_equal(whole.multipliers, bare.multipliers)
    assert [bare.peak, bare.extrema, bare.admissible] == [None, None, None]
    with pytest.raises(AttributeError, match="with_shapes=True"):
        _ = bare.stable


@every(
    ("name", "value", "reason"),
    [
        ("amplitude", -1.0, "0, 1e"),
        ("amplitude", math.nan, "0, 1e"),
        ("amplitude", math.inf, "0, 1e"),
        ("amplitude", "2", "real number"),
        ("amplitude", True, "real number"),
        ("amplitude", 1j, "real number"),
        ("amplitude", None, "real number"),
        ("frequency_ratio", 0.0, "lie in"),
        ("frequency_ratio", -4.0, "lie in"),
        ("frequency_ratio", math.nan, "lie in"),
        ("frequency_ratio", math.inf, "lie in"),
        ("frequency_ratio", 1e200, "lie in"),
        ("restitution", 0.0, r"\(0, 1\]"),
        ("restitution", 1.2, r"\(0, 1\]"),
        ("restitution", -0.5, r"\(0, 1\]"),
        ("restitution", math.nan, r"\(0, 1\]"),
        ("order", 2, "odd number of half periods"),
        ("order", 0, "1 or above"),
        ("order", -1, "1 or above"),
        ("order", 1.0, "whole number"),
        ("order", True, "whole number"),
        ("order", "1", "whole number"),
        ("order", 10**30 + 1, "at most"),
        ("order", 10**18 + 1, "at most"),
    ],
)
@every("in_array", [False, True])
def test_a_bad_argument_is_refused_with_the_reason(
    name: str, value: Any, reason: str, in_array: bool
) -> None:
    good: dict[str, Any] = {"amplitude": 2, "frequency_ratio": 4, "restitution": 1, "order": 1}
    # An array of an integer and a bool is one of integers before anyone can look at it.
    good[name] = [good[name], value] if in_array and value is not True else value
    with pytest.raises(InputError, match=rf"^{name} = .*{reason}"):
        steady_states(**good)


def test_shapes_that_do_not_broadcast_are_refused_with_the_shapes() -> None:
    with pytest.raises(InputError, match=r"\(2,\), \(3,\)"):
        steady_states([1.0, 2.0], [1.0, 2.0, 3.0], 0.8)


@given(
    logarithmic(1e-50, 1e49),
    logarithmic(0.01, 1e4),
    st.floats(0.0, 1.0, exclude_min=True),
    orders,
)
def test_no_nan_is_silent_whatever_the_magnitudes(a: float, w: float, r: float, n: int) -> None:
    states = steady_states(a, w, r, order=n)
    assert np.isfinite([states.existence, states.sign, states.kind]).all()
    missing = np.isnan([states.phase, states.velocity_tau, checked(states.peak)])
    assert missing.all() if states.region == 4 else not missing.any()
    # A trace is left out where an impact has no speed, and nowhere else.
    slow = np.abs(states.velocity) <= 2e-9 * r
    assert (np.isnan(states.trace) <= (missing[0] | slow)).all()


# ------------------------------------------------------------------------------ as a dataset


def test_the_dataset_names_its_dimensions_units_and_classes() -> None:
    states = steady_states(np.array([1.0, 2.0])[:, np.newaxis], [2.0, 4.0, 8.0], 0.8)
    data = states.to_dataset()
    assert dict(data.sizes) == {"branch": 2, "grid_0": 2, "grid_1": 3}
    assert data["branch"].values.tolist() == [1, 2]
    assert all("units" in data[name].attrs for name in data.data_vars)
    assert data["phase"].attrs["units"] == "rad"
    assert data["region"].attrs["flag_values"] == [1, 2, 3, 4, 5]
    assert len(data["region"].attrs["flag_meanings"].split()) == 5
    assert data["phase"].dims == ("branch", "grid_0", "grid_1")
    assert data["existence_amplitude"].dims == ("grid_0", "grid_1")
    for name in ("phase", "velocity", "peak", "stable", "admissible", "region"):
        np.testing.assert_array_equal(data[name].values, getattr(states, name))
    assert float(data["velocity"].sel(branch=1)[1, 1]) == states.velocity[0, 1, 1]


def test_a_dataset_without_shapes_leaves_out_what_was_not_computed() -> None:
    data = steady_states(2.0, 4.0, 0.8, with_shapes=False).to_dataset()
    assert "phase" in data
    assert not {"peak", "admissible", "stable"} & set(data.data_vars)
