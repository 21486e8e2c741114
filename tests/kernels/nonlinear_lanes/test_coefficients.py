"""Coefficients of all lanes, against those of one flight and against packed instructions."""

from typing import Any

import numpy as np
import pytest

from rocksteady.kernels.nonlinear._expansion import expand as expand_one
from rocksteady.kernels.nonlinear.drive import Drive, Instant
from rocksteady.kernels.nonlinear.series import ANGLE as Y
from rocksteady.kernels.nonlinear.series import WORK_ROWS
from rocksteady.kernels.nonlinear_lanes._coefficients import expand
from rocksteady.kernels.nonlinear_lanes._ends import finish
from rocksteady.kernels.nonlinear_lanes._layout import (
    ALPHA,
    AMPLITUDE,
    ANGLE,
    FREQUENCY,
    LANES,
    PHASE,
    SIZE,
    SPEED,
    SPEEDS,
    TERMS,
)
from tests.kernels.nonlinear_lanes.flights import PART, field, in_flight
from tests.strategies import PLAIN
from tools.aot.dispatch import dispatcher


def test_each_lane_has_the_coefficients_of_its_flight() -> None:
    lanes = in_flight(np.random.default_rng(1))
    expand(lanes)
    speeds = lanes[SPEEDS : SPEEDS + (TERMS - 1) * LANES].reshape(TERMS - 1, LANES)
    for k in range(LANES):
        alpha, amplitude, frequency, phase, angle, speed = (
            float(field(lanes, name)[k])
            for name in (ALPHA, AMPLITUDE, FREQUENCY, PHASE, ANGLE, SPEED)
        )
        drive = Drive(alpha, 0.0, 0.0, amplitude, frequency, 0.0, 0.0)
        work = np.zeros((WORK_ROWS, TERMS))
        at = Instant(0.0, angle, speed, np.sin(phase), np.cos(phase), False)
        expand_one(drive, at, 1e3, PART, work)
        own = speeds[:, k] / np.arange(1, TERMS)
        # Cancellation leaves an error in the scale of what the terms are made of.
        scale = np.max(np.abs(work[Y, 1:]) ** (1.0 / np.arange(1, TERMS)))
        np.testing.assert_allclose(
            own / scale ** np.arange(1, TERMS),
            work[Y, 1:] / scale ** np.arange(1, TERMS),
            rtol=1e-9,
            atol=1e-14,
        )


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="about machine code")
@pytest.mark.parametrize(("kernel", "rest"), [(expand, ()), (finish, (10,))])
def test_the_loops_become_vector_instructions(kernel: Any, rest: tuple[int, ...]) -> None:
    made = dispatcher(kernel)
    made(np.zeros(SIZE), *rest)
    machine = next(iter(made.inspect_asm().values()))
    assert any(packed in machine for packed in ("mulpd", ".2d"))
