"""Lengths of steps: as long as the rule of one flight allows, but for a few per cent."""

import numpy as np

from rocksteady.kernels.nonlinear_lanes._coefficients import expand
from rocksteady.kernels.nonlinear_lanes._layout import LANES, SPEEDS, STEP, TERMS
from rocksteady.kernels.nonlinear_lanes._steps import LONGEST, high_exp2, low_log2
from tests.every import every
from tests.kernels.nonlinear_lanes.flights import PART, field, in_flight, one_step, polynomials


def test_the_last_two_terms_are_as_small_as_asked_for() -> None:
    used = 0
    for seed in range(5):
        lanes = in_flight(np.random.default_rng(seed))
        one_step(lanes)
        terms = np.abs(polynomials(lanes))
        share = np.max(terms[-2:], axis=0) / np.max(terms[:4], axis=0)
        assert (share <= PART * (1.0 + 1e-9)).all()
        free = field(lanes, STEP) < LONGEST
        # 8 per cent of the step are a factor of 6 in the last term.
        assert (share[free] >= PART / 6.0).all()
        used += int(np.count_nonzero(free))
    assert used > LANES


def test_a_step_is_the_power_that_scales_the_terms() -> None:
    lanes = in_flight(np.random.default_rng(9))
    one_step(lanes)
    step, terms = field(lanes, STEP).copy(), polynomials(lanes).copy()
    assert terms.shape[0] == TERMS
    lanes = in_flight(np.random.default_rng(9))
    expand(lanes)
    for i in range(1, TERMS):
        speed = lanes[SPEEDS + (i - 1) * LANES : SPEEDS + i * LANES]
        np.testing.assert_allclose(terms[i], speed * step**i / i, rtol=1e-13)


@every("x", [1e-300, 1e-15, 0.3, 1.0, 1.7, 2.0, 3e5, 1e280])
def test_logarithms_and_powers_err_to_one_side(x: float) -> None:
    assert np.log2(x) - 0.0861 <= low_log2(-x) <= np.log2(x) + 1e-9
    y = min(max(np.log2(x), -500.0), 500.0)
    assert 2.0**y * (1.0 - 1e-9) <= high_exp2(y) <= 2.0**y * 1.0615
