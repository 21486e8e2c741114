"""Closed forms of overturning without an impact: published numbers, quadrature, time histories."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from rocksteady import Block, DimensionlessBlock, Pulse, Status, simulate
from rocksteady.dynamics.overturning.thresholds import THRESHOLDS
from rocksteady.errors import InputError
from rocksteady.formulas import overturning_amplitude, overturning_impulse
from rocksteady.model.equations import Linear
from rocksteady.motions import Impulses
from tests.every import every
from tests.model.motions.formulae_of_pulses import FORMULAE


def lasting(duration: float) -> float:
    """The frequency ratio of half a period that lasts so long."""
    return math.pi / duration


@every(
    ("shape", "ratio", "printed", "digits"),
    [
        *(("rectangle", lasting(d), a, 7) for a, d in ((1.2, 1.7917595), (2.0, 0.6931472))),  # H4
        *(  # H7
            ("half-sine", w, a, 6)
            for w, a in enumerate((1.322397, 1.800724, 2.293872, 2.790798, 3.289147, 3.788155), 1)
        ),
        ("half-sine", lasting(1.0), 2.36409069, 8),  # G1
        ("versed-sine", lasting(1.0), 2.84992425, 8),
        ("triangle", lasting(1.0), 2.97259, 5),
        ("rectangle", lasting(1.0), 1.58197671, 8),
        ("half-sine", lasting(2.0), 1.59204939, 8),
        ("versed-sine", lasting(2.0), 1.83885220, 8),
        ("triangle", lasting(2.0), 1.96032, 5),
        *(  # Z1
            ("one-sine", w, a, 6)
            for w, a in enumerate((2.349903, 3.631150, 5.238964, 7.168129, 9.416966), 2)
        ),
    ],
)
def test_published_thresholds(shape: str, ratio: float, printed: float, digits: int) -> None:
    assert float(overturning_amplitude(shape, ratio)) == pytest.approx(
        printed, abs=0.51 * 10.0**-digits
    )


@every("shape", THRESHOLDS)
@every("w", [0.4, 1.0, 3.0, 9.0])
def test_at_the_threshold_the_integral_of_g1_is_1(shape: str, w: float) -> None:
    periods, formula = FORMULAE[shape]
    end = 2.0 * math.pi * periods / w
    a = float(overturning_amplitude(shape, w))

    def base(s: float) -> float:
        return float(formula(np.asarray(s), a, w))

    lift = 0.0
    if base(0.0) < 1.0:
        crest = {"versed-sine": 0.5, "triangle": 0.5, "half-sine": 0.5, "one-sine": 0.25}[shape]
        lift = float(brentq(lambda s: base(s) - 1.0, 0.0, crest * end, xtol=1e-15))
    total = quad(
        lambda s: base(s) * math.exp(lift - s),
        lift,
        min(end, lift + 60.0) * (1.0 - 1e-15),
        points=[0.5 * end] if lift < 0.5 * end < lift + 60.0 else None,
        epsabs=1e-13,
        limit=500,
    )[0]
    assert total == pytest.approx(1.0, abs=1e-10)


@every("shape", THRESHOLDS)
@every("w", [0.3, 2.0, 7.0, 40.0])
def test_a_block_falls_without_an_impact_from_there_on(shape: str, w: float) -> None:
    a = float(overturning_amplitude(shape, w))
    block = DimensionlessBlock(restitution=0.9)
    above, below = (
        simulate(block, Pulse(shape=shape, amplitude=size, frequency_ratio=w))
        for size in (a * (1.0 + 1e-9), a * (1.0 - 1e-9))
    )
    assert above.status is Status.OVERTURNED
    assert len(above.impacts) == 0
    assert len(below.impacts) > 0


@every("shape", THRESHOLDS)
def test_a_pulse_without_end_overturns_at_uplift_and_a_sudden_one_by_its_impulse(
    shape: str,
) -> None:
    if shape in ("rectangle", "triangle", "versed-sine", "decaying-ramp"):
        assert overturning_amplitude(shape, 0.01) == pytest.approx(1.0, abs=0.01)
    if shape not in ("one-sine", "one-cosine"):  # whose impulse is 0
        area = {"rectangle": 1.0, "half-sine": 2.0 / math.pi}.get(shape, 0.5)
        a = float(overturning_amplitude(shape, 5000.0))
        assert a * area * math.pi / 5000.0 == pytest.approx(1.0, rel=1e-3)


def test_the_shape_of_the_ratios_is_kept() -> None:
    grid = np.array([[1.0, 2.0], [3.0, 4.0]])
    found = overturning_amplitude("half-sine", grid)
    assert found.shape == grid.shape
    assert found[1, 0] == overturning_amplitude("half-sine", 3.0)
    assert overturning_amplitude("one-sine", 2).shape == ()


def test_what_has_no_closed_form_is_refused() -> None:
    with pytest.raises(InputError, match="no closed form"):
        overturning_amplitude("ricker", 1.0)
    for ratio in (0.0, -1.0, math.nan, 1e5):
        with pytest.raises(InputError, match="frequency_ratio"):
            overturning_amplitude("half-sine", [1.0, ratio])
    with pytest.raises(InputError, match="real number"):
        overturning_amplitude("half-sine", "2")


def test_i1_the_toppling_impulse() -> None:
    block = Block.rectangle(width=0.4, height=1.6, gravity=9.80665)
    assert 100.0 * overturning_impulse(block) == pytest.approx(82.7110, abs=5.1e-5)
    r, alpha = block.radius, block.alpha
    long_form = math.sqrt(8.0 * block.gravity * r / 3.0 * (1.0 - math.cos(alpha))) / math.cos(alpha)
    assert overturning_impulse(block) == pytest.approx(long_form, rel=1e-13)


def test_the_impulse_of_the_linear_model_is_that_which_simulate_finds() -> None:
    block = Block.rectangle(width=0.5, height=2.0)
    size = overturning_impulse(block, model=Linear())
    for factor, status in ((1.0 - 1e-9, Status.AT_REST), (1.0 + 1e-9, Status.OVERTURNED)):
        kick = Impulses.from_si(block, velocities_m_s=(factor * size,))
        assert simulate(block, kick, model=Linear()).status is status
    slender = Block.from_p(alpha=1e-4, p=2.0)
    assert overturning_impulse(slender) == pytest.approx(
        overturning_impulse(slender, model=Linear()), rel=1e-7
    )


def test_an_impulse_in_m_s_needs_a_block_with_sizes() -> None:
    with pytest.raises(InputError, match="sizes"):
        overturning_impulse(DimensionlessBlock(restitution=0.9))  # type: ignore[arg-type]
