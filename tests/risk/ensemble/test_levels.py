"""Levels of an ensemble: those given, those that suit the blocks, and what has none."""

import math
from itertools import pairwise

import pytest

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.risk import Levels

G = 9.80665
BLOCK = Block.from_p(alpha=0.2, p=2.0)


def test_default_levels_are_twenty_in_equal_ratios() -> None:
    for measure in ("scale", "p_pgv_per_uplift", "pga_g", "pgv_m_s", "sa_g", "sa_avg_g"):
        levels = Levels(measure).levels_for([BLOCK])
        assert len(levels) == 20
        ratios = [b / a for a, b in pairwise(levels)]
        assert ratios == pytest.approx([ratios[0]] * 19, rel=1e-12)


def test_default_levels_are_of_one_dimensionless_range_for_all_blocks() -> None:
    other = Block.from_p(alpha=0.1, p=4.0)
    ratio = Levels("pgv_m_s").levels_for([other])[0] / Levels("pgv_m_s").levels_for([BLOCK])[0]
    assert ratio == pytest.approx(math.tan(0.1) / math.tan(0.2) / 2.0, rel=1e-12)
    ratio = Levels("pga_g").levels_for([other])[0] / Levels("pga_g").levels_for([BLOCK])[0]
    assert ratio == pytest.approx(math.tan(0.1) / math.tan(0.2), rel=1e-12)
    # A ratio to the uplift has the levels of what it is a ratio of.
    for plain, relative, unit in (
        ("pga_g", "pga_per_uplift", math.tan(0.2)),
        ("pgv_m_s", "p_pgv_per_uplift", G * math.tan(0.2) / 2.0),
    ):
        scaled = [unit * level for level in Levels(relative).levels_for([BLOCK])]
        assert Levels(plain).levels_for([BLOCK]) == pytest.approx(scaled, rel=1e-12)
    # Levels of both reach from the first of one to the last of the other.
    both = Levels("pga_g").levels_for([BLOCK, other])
    assert both[0] == Levels("pga_g").levels_for([other])[0]
    assert both[-1] == Levels("pga_g").levels_for([BLOCK])[-1]


def test_what_scaling_does_not_change_has_no_levels() -> None:
    with pytest.raises(InputError, match="scaling a record does not change it"):
        Levels("significant_5_75_s")
    for levels in ([0.0, 1.0], [1.0, 1.0], [-1.0], [], [math.nan]):
        with pytest.raises(InputError, match="levels"):
            Levels("pga_g", levels)
    with pytest.raises(InputError, match="the measures are pga_g"):
        Levels("pga")


def test_a_measure_with_a_period_keeps_it() -> None:
    levels = Levels(Measure("sa_g", 0.5), [0.3])
    assert levels.key == "sa_g_0.5s"
    assert levels.intensity == Measure("sa_g", 0.5)


def test_no_more_than_a_thousand_levels() -> None:
    assert len(Levels("pga_g", [0.001 * k for k in range(1, 1001)]).levels_for([BLOCK])) == 1000
    with pytest.raises(InputError, match=r"has 1,001 values: an ensemble takes 1000 at most"):
        Levels("pga_g", [0.001 * k for k in range(1, 1002)])
