"""Numbers in equal ratios: powers that are known, and the ends as they are given."""

import math

import numpy as np
import pytest

from rocksteady.sweep.cases.spacing import in_equal_ratios


def test_powers_of_two_and_of_ten() -> None:
    assert in_equal_ratios(0.125, 32.0, 9) == pytest.approx(
        [2.0**k for k in range(-3, 6)], rel=1e-15
    )
    assert in_equal_ratios(1e4, 1e-4, 9) == pytest.approx(
        [float(f"1e{k}") for k in range(4, -5, -1)], rel=3e-15
    )


@pytest.mark.parametrize(("start", "stop", "count"), [(0.01, 1000.0, 401), (7.0, 0.3, 2)])
def test_the_ends_are_those_given_and_the_ratios_are_equal(
    start: float, stop: float, count: int
) -> None:
    found = in_equal_ratios(start, stop, count)
    assert (found[0], found[-1], len(found)) == (start, stop, count)
    steps = np.diff([math.log(value) for value in found])
    assert steps == pytest.approx(math.log(stop / start) / (count - 1), rel=1e-12)
