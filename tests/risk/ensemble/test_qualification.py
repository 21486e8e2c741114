"""What equipment is qualified by: of the runs that rock and stand."""

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray

from rocksteady import Block
from rocksteady.formulas import Outline
from rocksteady.outcomes import Status
from rocksteady.risk.ensemble.qualification import OUTPUTS, most_of_rocking, qualification_of
from rocksteady.words.ensembles import rocking_words
from tests.risk.ensemble.test_runs import BLOCKS


def runs(peaks: list[float], status: list[Status]) -> xarray.Dataset:
    given = np.array([peaks])
    codes = np.array([[int(each) for each in status]])
    found = qualification_of(BLOCKS[:1], given, given, codes)
    arrays = {**found, "peak_angle": given, "status": codes}
    return xarray.Dataset({name: (("block", "run"), each) for name, each in arrays.items()})


def test_tops_and_gaps_are_those_of_the_outline_on_the_worse_side() -> None:
    """By hand: corners 1.8 m up that turn about edges 0.5 m apart."""
    body = Block.asymmetric(left=0.2, right=0.3, height=1.8, mass_centre_height=0.6)
    body = replace(body, outline=Outline(height=1.8, left_overhang=0.1, right_overhang=0.4))
    peaks = np.array([[0.3]])
    found = qualification_of([body], peaks, peaks, np.array([[int(Status.AT_REST)]]))
    angles = [0.3 * math.atan2(0.2, 0.6), 0.3 * math.atan2(0.3, 0.6)]
    gaps = [
        1.8 * math.sin(angle) - beyond * (1.0 - math.cos(angle))
        for angle, beyond in zip(angles, (0.1, 0.4), strict=True)
    ]
    tops = [
        1.8 * math.sin(angle) + (0.5 + beyond) * (1.0 - math.cos(angle))
        for angle, beyond in zip(angles, (0.4, 0.1), strict=True)
    ]
    assert found["clearance_m"].item() == pytest.approx(max(gaps), rel=1e-12)
    assert found["top_displacement_m"].item() == pytest.approx(max(tops), rel=1e-12)


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
