"""Levels of an ensemble: those given, and what has none."""

import math

import numpy as np
import pytest

from rocksteady import Block, run_ensemble
from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import Levels

BLOCK = Block.from_p(alpha=0.2, p=2.0)


def test_an_ensemble_needs_the_values_of_its_levels() -> None:
    assert Levels("pga_g", np.array([0.2, 0.4])).values == (0.2, 0.4)
    assert Levels("pga_g").levels is None
    with pytest.raises(InputError, match="levels has no values: an ensemble runs at levels"):
        run_ensemble(BLOCK, make_synthetic_suite(1), levels=Levels("pga_g"))


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
    assert len(Levels("pga_g", [0.001 * k for k in range(1, 1001)]).values) == 1000
    with pytest.raises(InputError, match=r"has 1,001 values: an ensemble takes 1000 at most"):
        Levels("pga_g", [0.001 * k for k in range(1, 1002)])
