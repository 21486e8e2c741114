"""Single measures: against those measured together, spectra, scaling and blocks."""

import math

import numpy as np
import pytest

from rocksteady import Block, compute_measures
from rocksteady.errors import InputError
from rocksteady.measures import (
    Measure,
    compute_average_acceleration,
    compute_measure,
    compute_response_spectrum,
)
from rocksteady.seismic.measures.scalar import MEASURES
from tests.every import every
from tests.seismic.grounds import ground

G = 9.80665
RECORD = ground(4)
BLOCK = Block.asymmetric(left=0.25, right=0.4, height=2.4, gravity=3.7)


def test_each_is_what_is_measured_together() -> None:
    whole = compute_measures(RECORD, BLOCK)
    for name in MEASURES:
        if not name.startswith("sa_"):
            assert compute_measure(RECORD, name, BLOCK) == getattr(whole, name), name


def test_spectral_measures_are_those_of_the_oscillators() -> None:
    spectrum = compute_response_spectrum(RECORD, [0.5])
    found = compute_measure(RECORD, Measure("sa_g", 0.5))
    assert found == pytest.approx(spectrum.pseudo_acceleration_m_s2[0] / G, rel=1e-15)
    mean = np.exp(
        np.mean(
            [
                math.log(compute_measure(RECORD, Measure("sa_g", 0.5 * factor)))
                for factor in np.linspace(0.2, 3.0, 10)
            ]
        )
    )
    assert compute_measure(RECORD, Measure("sa_avg_g", 0.5)) == pytest.approx(mean, rel=1e-12)
    # By default of the side that lifts first.
    side = min(BLOCK.positive, BLOCK.negative, key=lambda one: one.alpha)
    period = 2.0 * math.pi / side.p
    default = compute_measure(RECORD, "sa_avg_g", BLOCK)
    assert default == compute_average_acceleration(RECORD, period) / G


@every("name", MEASURES)
def test_scaling_changes_what_scales_in_proportion_and_nothing_else(name: str) -> None:
    one, double = (compute_measure(RECORD.scaled(f), name, BLOCK) for f in (1.0, 2.0))
    assert double / one == pytest.approx(2.0 if Measure(name).scales else 1.0, rel=1e-12)
    assert compute_measure(RECORD.reversed(), name, BLOCK) == pytest.approx(one, rel=1e-12)


def test_a_measure_that_does_not_exist_or_has_no_block_is_refused() -> None:
    with pytest.raises(InputError, match="the measures are"):
        Measure("pgd_m")
    with pytest.raises(InputError, match="has no period"):
        Measure("pga_g", 0.5)
    with pytest.raises(InputError, match="period_s"):
        Measure("sa_g", 0.0)
    for name in ("sa_g", "sa_avg_g", "p_pgv_per_uplift", "pga_per_uplift"):
        with pytest.raises(InputError, match="give the block"):
            compute_measure(RECORD, name)


def test_label_and_key_say_the_period() -> None:
    assert str(Measure("sa_avg_g")) == "Sa_avg(2 pi/p) [g]"
    assert str(Measure("p_pgv_per_uplift")) == "p PGV/(g tan alpha)"
    assert Measure("sa_g", 0.25).key == "sa_g_0.25s"
