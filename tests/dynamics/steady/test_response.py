"""Response curves in frequency ratios and in hertz."""

import math
from typing import Any, Literal

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, compute_response_curve
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import steady_states
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)


def test_a_curve_is_the_peak_of_the_admissible_solutions() -> None:
    w = np.linspace(1.0, 16.0, 151)
    branches: tuple[Literal[1], Literal[2]] = (1, 2)
    for branch in branches:
        curve = compute_response_curve(BARE, 2.0, frequency_ratio=w, order=3, branch=branch)
        states = steady_states(2.0, w, 0.8, order=3)
        assert states.peak is not None
        assert states.admissible is not None
        admissible = states.admissible[branch - 1]
        assert 0 < admissible.sum() < len(w)
        np.testing.assert_array_equal(np.isnan(curve.peak), ~admissible)
        np.testing.assert_array_equal(curve.peak[admissible], states.peak[branch - 1][admissible])
        np.testing.assert_array_equal(curve.stable, states.stable[branch - 1])
        assert curve.branch == branch
        assert curve.frequency_hz is None


@every("p", [1.0, 2.14, 2.0 * math.pi, 9.0])
def test_a_curve_in_hertz_is_that_in_frequency_ratios(p: float) -> None:  # eqs 26, 27
    block = Block.from_p(alpha=0.2, p=p, restitution=0.8)
    hertz = np.linspace(0.5, 16.0, 32)
    curve = compute_response_curve(block, 3.0, frequency_hz=hertz)
    ratios = 2.0 * math.pi * hertz / p
    np.testing.assert_allclose(curve.frequency_ratio, ratios, rtol=1e-15)
    assert curve.frequency_hz is not None
    np.testing.assert_allclose(curve.frequency_hz, hertz, rtol=1e-15)
    same = compute_response_curve(block, 3.0, frequency_ratio=curve.frequency_ratio)
    np.testing.assert_array_equal(curve.peak, same.peak)
    linear = compute_response_curve(block, 3.0, frequency_hz=hertz, model="linear")
    bare = compute_response_curve(BARE, 3.0, frequency_ratio=curve.frequency_ratio)
    np.testing.assert_array_equal(linear.peak, bare.peak)
    assert (curve.model.name, linear.model.name, bare.model.name) == (
        "nonlinear",
        "linear",
        "linear",
    )
    assert np.isfinite(curve.peak).any()


def test_peaks_fall_with_frequency_as_in_figure_5a() -> None:
    for amplitude in range(1, 7):
        curve = compute_response_curve(BARE, amplitude, frequency_ratio=np.linspace(4.0, 16.0, 49))
        assert (np.diff(curve.peak) < 0.0).all()


def test_one_frequency_is_a_curve_of_one() -> None:
    assert compute_response_curve(BARE, 3.0, frequency_ratio=4.0).peak.shape == (1,)


@every(
    ("arguments", "kind", "name"),
    [
        ({}, ModelError, "frequency_ratio, frequency_hz"),
        ({"frequency_ratio": 1.0, "frequency_hz": 1.0}, ModelError, "frequency_ratio, freq"),
        ({"frequency_hz": 1.0}, ModelError, "frequency_hz"),
        ({"frequency_ratio": 0.0}, InputError, "frequency_ratio"),
        ({"frequency_ratio": [1.0, math.nan]}, InputError, "frequency_ratio"),
        ({"frequency_ratio": []}, InputError, "frequency_ratio"),
        ({"frequency_ratio": [[1.0, 2.0]]}, InputError, "frequency_ratio"),
        ({"frequency_ratio": 1.0, "order": 2}, InputError, "order"),
        ({"frequency_ratio": 1.0, "branch": 3}, InputError, "branch"),
        ({"frequency_ratio": 1.0, "branch": 0}, InputError, "branch"),
    ],
)
def test_bad_arguments_are_refused(
    arguments: dict[str, Any], kind: type[Exception], name: str
) -> None:
    with pytest.raises(kind, match=f"^{name}"):
        compute_response_curve(BARE, 3.0, **arguments)


@every("value", [0.0, -1.0, math.nan])
def test_a_bad_frequency_in_hertz_is_refused(value: float) -> None:
    block = Block.from_p(alpha=0.2, p=3.0)
    with pytest.raises(InputError, match=r"^frequency_hz = "):
        compute_response_curve(block, 3.0, frequency_hz=[1.0, value])


def test_text_is_refused_as_a_frequency() -> None:
    text: Any = "4"
    with pytest.raises(InputError, match=r"^frequency_ratio = "):
        compute_response_curve(BARE, 3.0, frequency_ratio=text)
