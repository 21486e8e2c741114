"""What equipment is qualified by: of the runs that rock and stand."""

import numpy as np
import pytest
import xarray

from rocksteady.outcomes import Status
from rocksteady.risk.ensemble.qualification import (
    OUTPUTS,
    most_of_rocking,
    qualification_of,
    rocking_words,
)
from tests.risk.ensemble.test_runs import BLOCKS


def runs(peaks: list[float], status: list[Status]) -> xarray.Dataset:
    given = np.array([peaks])
    codes = np.array([[int(each) for each in status]])
    found = qualification_of(BLOCKS[:1], given, given, codes)
    arrays = {**found, "peak_angle": given, "status": codes}
    return xarray.Dataset({name: (("block", "run"), each) for name, each in arrays.items()})


def test_runs_that_do_not_lift_are_none_of_a_demand_that_lifts() -> None:
    rest, falls = Status.AT_REST, Status.OVERTURNED
    rocking = runs([0.2, 0.4, 0.6, 1.3], [rest, rest, rest, falls])
    diluted = runs([0.2, 0.4, 0.6, 1.3, *[0.0] * 20], [rest, rest, rest, falls, *[rest] * 20])
    values = most_of_rocking(rocking)
    assert most_of_rocking(diluted) == values
    tops = rocking["top_displacement_m"].values[0, :3]
    assert values["top_displacement_m"] == pytest.approx(np.quantile(tops, 0.84))
    assert rocking_words(values).endswith("in 84 % of the runs that rock and stand")


@pytest.mark.parametrize("peaks", [[0.0, 0.0], [1.4, 0.0]])
def test_without_a_run_that_rocks_and_stands_there_is_no_value(peaks: list[float]) -> None:
    ends = [Status.OVERTURNED if peak > 1.0 else Status.AT_REST for peak in peaks]
    values = most_of_rocking(runs(peaks, ends))
    assert values == dict.fromkeys(OUTPUTS)
    assert rocking_words(values) == ""
