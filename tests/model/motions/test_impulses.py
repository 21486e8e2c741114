"""Impulses: what they lower to, SI, and what is refused."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import Block
from rocksteady.dynamics.history.base_motion import course_from_rest
from rocksteady.errors import InputError
from rocksteady.model.linear_tables import segment_table
from rocksteady.motions import Impulses, Segment
from tests.every import every

BLOCK = Block.from_p(alpha=0.2, p=3.0, restitution=0.8)


def test_impulses_are_jumps_of_velocity_between_still_segments() -> None:
    motion = Impulses(velocities=(0.5, -0.25), times=(1.0, 3.0))
    assert motion.segments() == (
        Segment(duration=1.0),
        Segment(duration=2.0, jump=0.5),
        Segment(duration=math.inf, jump=-0.25),
    )
    assert Impulses(velocities=(0.5,)).segments() == (Segment(duration=math.inf, jump=0.5),)


def test_impulses_in_si() -> None:
    motion = Impulses.from_si(BLOCK, velocities_m_s=(0.3, -0.2), times_s=(0.5, 1.5))
    unit = 0.2 * 9.80665 / 3.0  # alpha g/p
    assert motion.velocities == pytest.approx((0.3 / unit, -0.2 / unit), rel=1e-15)
    assert motion.times == (1.5, 4.5)
    place = course_from_rest(segment_table(motion), np.array([1.5, 4.5, 5.5]))[1]
    np.testing.assert_allclose(place * unit / 3.0, [0.0, 0.3, 0.3 + 0.1 / 3.0], atol=1e-15)


@every(
    ("given", "name"),
    [
        ({"velocities": ()}, "times"),
        ({"velocities": (), "times": ()}, "times"),
        ({"velocities": 1.0}, "velocities"),
        ({"velocities": (1.0, 2.0)}, "times"),
        ({"velocities": (math.nan,)}, "velocities"),
        ({"velocities": (1.0,), "times": (-1.0,)}, "times"),
        ({"velocities": (1.0, 1.0), "times": (1.0, 1.0)}, "times"),
        ({"velocities": (1.0, 1.0), "times": (2.0, 1.0)}, "times"),
    ],
)
def test_bad_impulses_are_refused(given: dict[str, Any], name: str) -> None:
    with pytest.raises(InputError, match=f"^{name} = "):
        Impulses(**given)
