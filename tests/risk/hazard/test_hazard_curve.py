"""Hazard curves: interpolation, bounds, and what is no curve."""

import dataclasses
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady.errors import InputError
from rocksteady.risk import HazardCurve
from tests.every import every

LEVELS = [0.05, 0.1, 0.4, 1.2]
RATES = [0.1, 0.02, 0.001, 0.00001]


def curve(**changed: Any) -> HazardCurve:
    given: dict[str, Any] = {"measure": "pga_g", "levels": LEVELS, "rates": RATES}
    return HazardCurve(**{**given, **changed})


def test_the_points_lie_on_the_curve() -> None:
    assert curve().rate(LEVELS) == pytest.approx(RATES, rel=1e-12)


@given(
    st.floats(0.2, 6.0),
    st.floats(1e-8, 10.0),
    st.lists(st.floats(0.01, 5.0), min_size=2),
    st.data(),
)
def test_a_power_law_is_itself_between_its_points(
    k: float, rate: float, levels: list[float], data: st.DataObject
) -> None:
    at = np.unique(np.round(levels, 3))
    if at.size < 2:
        at = np.array([0.1, 0.2])
    power = curve(levels=at, rates=rate * at**-k)
    x = data.draw(st.floats(float(at[0]), float(at[-1])))
    assert power.rate(x) == pytest.approx(rate * x**-k, rel=1e-9)
    assert power.slopes == pytest.approx(np.full(at.size - 1, k), rel=1e-6)


@every("level", [0.049, 1.21, 0.0, -1.0, np.nan, np.inf])
def test_beyond_its_ends_a_curve_is_unknown(level: float) -> None:
    with pytest.raises(InputError, match=r"reaches from 0\.05 to 1\.2 g"):
        curve().rate(level)


@every(
    ("changed", "line"),
    [
        ({"levels": [0.1, 0.1, 0.2, 0.3]}, "it follows 0.1, and levels must rise"),
        ({"levels": [0.1, 0.3, 0.2, 0.4]}, "levels = 0.2 is not valid"),
        ({"rates": [0.1, 0.2, 0.01, 0.001]}, "rates of exceedance, which never rise"),
        ({"rates": [0.1, 0.2, 0.01, 0.001]}, "0.2 is not valid: it is more than the rate 0.1 of"),
        ({"rates": [0.1, 0.02, 0.03, 0.001]}, "rates = 0.03 is not valid"),
        ({"rates": [0.1, 0.02, 0.01, 0.0]}, "leave out levels and rates of 0"),
        ({"rates": [0.1, 0.02]}, "give as many rates as levels"),
        ({"levels": [0.1], "rates": [0.1]}, "a row of two or more"),
        ({"measure": "pga"}, "one of pga_g, pgv_m_s, sa_g:PERIOD, sa_avg_g:PERIOD"),
        ({"measure": "sa_g"}, 'write a period in seconds, as "sa_g:1.0"'),
        ({"measure": "sa_g:9e-7"}, "measure = 'sa_g:9e-7' is not valid"),
        ({"measure": "sa_g:-1"}, "measure = 'sa_g:-1' is not valid"),
        ({"measure": "p_pgv_per_uplift"}, "measure = 'p_pgv_per_uplift' is not valid"),
        ({"weight": 1.5}, "weight = 1.5 is not valid"),
        ({"site": (0.0, 91.0)}, "give longitude and latitude in degrees"),
    ],
)
def test_what_is_no_curve_is_refused_in_a_line(changed: dict[str, Any], line: str) -> None:
    with pytest.raises(InputError) as refusal:
        curve(**changed)
    assert line in str(refusal.value)


def test_a_curve_cannot_be_changed_and_describes_itself() -> None:
    branch = dataclasses.replace(
        curve(measure="sa_g:1"), name="b1", weight=0.3, site=(13.1, 42.3), remarks=("One is gone.",)
    )
    with pytest.raises(ValueError, match="read-only"):
        branch.levels[0] = 1.0
    told = branch.to_dict()
    assert (told["measure"], told["weight"], told["site"]) == ("sa_g:1.0", 0.3, [13.1, 42.3])
    assert [point["level"] for point in told["points"]] == LEVELS
    assert "Sa(1 s)" in branch.summary()
    assert "One is gone." in branch.summary()


def test_levels_rates_and_sites_may_reach_their_bounds() -> None:
    wide = curve(levels=[1e-100, 1e100], rates=[1e100, 1e-100])
    assert wide.slopes == pytest.approx([1.0])
    for site in ((-360.0, -90.0), (360.0, 90.0)):
        assert curve(site=site).site == site
    for site in ((-360.1, 0.0), (360.1, 0.0), (0.0, -90.1), (0.0, 90.1)):
        with pytest.raises(InputError, match="site"):
            curve(site=site)
    for changed in ({"levels": [0.9e-100, 1.0]}, {"levels": [1.0, 1.1e100]}):
        with pytest.raises(InputError, match=r"must lie in \[1e-100, 1e\+100\]"):
            curve(**changed, rates=[0.1, 0.01])
    assert curve(rates=[0.1, 0.02, 0.02, 0.001]).slopes[1] == 0.0
