"""One test: what acts, the default group, and what does not go together."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady.errors import InputError, ModelError, RocksteadyError
from rocksteady.model.motions.record import Record
from rocksteady.risk.observations.shaking_test import ShakingTest
from tests.every import every

RECORD = Record(acceleration_m_s2=np.array([0.0, 3.0, -1.0, -2.0, 0.0]), dt_s=0.02, name="run 7")
SLOW = Record(acceleration_m_s2=RECORD.acceleration_m_s2, dt_s=0.04, name="run 8")
WHOLE: dict[str, Any] = {"name": "t", "record": RECORD, "object": "column", "fell": False}


def test_the_motion_is_the_record_times_the_gain_with_its_sign() -> None:
    turned = ShakingTest(**WHOLE, gain=0.5, reversed=True)
    np.testing.assert_array_equal(turned.motion.acceleration_m_s2, -0.5 * RECORD.acceleration_m_s2)
    plain = ShakingTest(**WHOLE)
    assert plain.motion is RECORD


def test_tests_of_a_record_stay_together_unless_they_have_another_group() -> None:
    assert ShakingTest(**WHOLE).group == "run 7"
    assert ShakingTest(**WHOLE, group="day 1").group == "day 1"
    unnamed = Record(acceleration_m_s2=RECORD.acceleration_m_s2, dt_s=0.02)
    with pytest.raises(InputError, match="give the record a name, or the test a group"):
        ShakingTest(**{**WHOLE, "record": unnamed})
    assert ShakingTest(**{**WHOLE, "record": unnamed}, group="g").group == "g"


@every(
    ("given", "kind", "line"),
    [
        ({"name": " "}, InputError, "name = ' ' is not valid"),
        ({"object": ""}, InputError, "object = '' is not valid"),
        ({"session": ""}, InputError, "session = '' is not valid"),
        ({"gain": 0.0}, InputError, "gain = 0.0 is not valid"),
        ({"gain": -1.0}, InputError, "reversed changes the sign"),
        ({"gain": math.nan}, InputError, "gain = nan"),
        ({"gain": 1e7}, InputError, "gain = 10000000.0"),
        ({"gain": 5e-324}, InputError, "gain = 5e-324"),
        ({"peak_rad": 0.1, "sigma_rad": 1e-300}, InputError, "sigma_rad = 1e-300"),
        ({"sigma_ln": -0.1}, InputError, "sigma_ln = -0.1"),
        ({"peak_rad": 0.1}, ModelError, "sigma_rad is missing beside peak_rad"),
        ({"sigma_rad": 0.1}, ModelError, "peak_rad is missing beside sigma_rad"),
        ({"peak_rad": 0.1, "sigma_rad": 0.0}, InputError, "sigma_rad = 0.0"),
        ({"peak_rad": 2.0, "sigma_rad": 0.1}, InputError, "1 degree is 0.01745"),
        ({"fell": True, "peak_rad": 0.1, "sigma_rad": 0.01}, ModelError, "is that it fell"),
        ({"fell": None, "peak_rad": 0.1, "sigma_rad": 0.01}, ModelError, "is unknown"),
        ({"fell": 1}, InputError, "fell = 1 is not valid"),
        ({"record": "run 7"}, InputError, "it must be a Record"),
        ({"transverse": SLOW}, InputError, "the record has an interval of 0.02 s; resample one"),
    ],
)
def test_what_is_wrong_is_refused_in_one_line(
    given: dict[str, Any], kind: type[RocksteadyError], line: str
) -> None:
    with pytest.raises(kind) as refusal:
        ShakingTest(**{**WHOLE, **given})
    assert line in str(refusal.value)


def test_a_peak_is_below_a_right_angle() -> None:
    assert ShakingTest(**WHOLE, sigma_rad=0.01, peak_rad=1.57).peak_rad == 1.57
    for wrong in (0.5 * math.pi, -0.1):
        with pytest.raises(InputError, match="peak_rad"):
            ShakingTest(**WHOLE, sigma_rad=0.01, peak_rad=wrong)
