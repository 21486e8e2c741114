"""A scalar in place of a table, and a table in place of a scalar, is refused and never dropped."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.errors import RocksteadyError
from rocksteady.risk import Building, DescribedObject
from tests.every import every

FLOORS = [rs.motions.Floor(frequencies_hz=2.0, shapes=1.0)]
SIZES = {"width_m": 0.1, "height_m": 0.5}
NUMBERS = [0.3, np.float64(0.3), np.float32(0.3), np.int64(1), np.array(0.3), np.array([0.3]), True]
TEXTS = ["x", "", b"x", np.str_("x")]
NO_TABLE = [*NUMBERS, *TEXTS, [1.0], [("pga_g", 0.3)], {1.0}, object()]
NO_NUMBER = [{}, {"a": 1}, [0.3], b"x", True, None, np.array([0.3]), np.array(True), object()]
NO_NAME = [5, np.float64(0.3), True, "", "  ", b"x", None, ["x"], {"x": 1}, np.array("")]


def described(**keys: Any) -> DescribedObject:
    """Return an object with some tables or keys."""
    return DescribedObject(values={"name": "vase", "geometry": SIZES, **keys})


Call = Callable[[Any], object]
TABLES: list[Call] = [
    lambda given: DescribedObject(values=given),
    lambda given: described(geometry=given),
    lambda given: described(demand=given),
    lambda given: described(assessment=given),
    lambda given: described(content=given),
    lambda given: DescribedObject(values=described().values, extra=given),
    lambda given: Building(name="house", floors=FLOORS, rooms=given),
    lambda given: Building.of_first_mode("house", storeys=2, period_s=0.3, rooms=given),
    lambda given: rs.calibration.Prior(defaults=given),
    lambda given: rs.calibration.Prior(sources=given),
    lambda given: rs.sweeps.Output(name="kind", dtype=np.int8, flags=given),
    lambda given: rs.sweeps.Output(name="kind", attrs=given),
]
"""Calls that take a table."""
VALUES: list[Call] = [
    lambda given: described(geometry={**SIZES, "width_m": given}),
    lambda given: described(demand={"vertical_g": given}),
    lambda given: Building(name="house", floors=FLOORS, rooms={"hall": given}),
    lambda given: rs.calibration.Prior(defaults={"base": given}),
    lambda given: rs.calibration.Prior(sources={"prior.toml": given}),
    lambda given: DescribedObject(values=described().values, extra={"note": given}),
    lambda given: rs.sweeps.Output(name="kind", attrs={"valid_min": given}),
]
"""Calls that take a table of numbers or texts, and neither tables nor lists in it."""
NAMES: list[Call] = [
    lambda given: Building(name=given, floors=FLOORS),
    lambda given: Building.of_first_mode(given, storeys=2, period_s=0.3),
    lambda given: described(name=given),
    lambda given: DescribedObject(values=described().values, source=given),
    lambda given: rs.calibration.ObjectPrior(name=given, width_m=0.1, height_m=0.5),
    lambda given: rs.codes.Facade(name=given, thickness_m=0.4, height_m=4.0),
    lambda given: rs.codes.Tie(name=given, force_kn=2.0, z_m=3.0),
    lambda given: rs.export.LossState(name=given, median=0.4, beta=0.5),
    lambda given: rs.histories.Release(peaks_rad=[0.2, 0.16], name=given),
]
"""Calls that take a name."""
REFUSED = [
    *((call, given) for call in TABLES for given in NO_TABLE),
    *((call, given) for call in VALUES for given in NO_NUMBER),
    *((call, given) for call in NAMES for given in NO_NAME),
]


@every(("call", "given"), REFUSED)
def test_what_is_no_table_no_number_and_no_name_is_refused(call: Call, given: Any) -> None:
    with pytest.raises(RocksteadyError) as caught:
        call(given)
    assert "\n" not in str(caught.value)
    assert caught.value.hint


@every("number", [0.3, np.float64(0.3), np.float32(0.3), np.array(0.3)])
def test_numbers_of_numpy_in_a_table_are_numbers(number: Any) -> None:
    """An object is what it is with floats; a range of such numbers too."""
    plain = described(demand={"pga_g": float(number)}, friction={"low": 0.2, "high": 0.3})
    other = described(demand={"pga_g": number}, friction={"low": np.float64(0.2), "high": 0.3})
    assert other.given == plain.given
    assert type(other.pga_g) is float
