"""Equations of motion: which hold where none are given, and what is refused."""

import math

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Piecewise,
    Pulse,
    Record,
    State,
    Still,
    compute_rocking_spectrum,
    find_attractor,
    find_orbits,
    find_overturning_windows,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import overturning_impulse
from rocksteady.model.equations import Model, chosen_model
from rocksteady.motions import Impulses, Segment
from rocksteady.orbits import ReturnMap
from tests.every import every

BLOCK = Block.from_p(alpha=0.3, p=2.0, restitution=0.8)
BARE = DimensionlessBlock(restitution=0.8)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=4.0)
RECORD = Record(acceleration_m_s2=5.0 * np.sin(0.25 * np.arange(60)), dt_s=0.05)
ENDING = [
    Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0),
    Impulses(velocities=(0.5,), times=(0.0,)),
    Piecewise(pieces=(Segment(duration=1.0, constant=1.5),)),
    Still(),
    RECORD,
]


@every("motion", ENDING)
def test_the_full_equations_are_the_default_of_a_block(motion: object) -> None:
    start = State(angle=0.4, velocity=0.0)
    run = simulate(BLOCK, motion, start=start)  # type: ignore[arg-type]
    given = simulate(BLOCK, motion, start=start, model=Nonlinear())  # type: ignore[arg-type]
    slender = simulate(BLOCK, motion, start=start, model=Linear())  # type: ignore[arg-type]
    assert (run.model, slender.model) == (Nonlinear(), Linear())
    assert run(0.5).angle == given(0.5).angle != slender(0.5).angle
    if not isinstance(motion, Record):
        assert simulate(BARE, motion, start=start)(0.5).angle == slender(0.5).angle  # type: ignore[arg-type]


@every(("block", "model"), [(BLOCK, Nonlinear()), (BARE, Linear())])
def test_orbits_and_what_a_motion_settles_to_choose_by_the_block(
    block: Block | DimensionlessBlock, model: Model
) -> None:
    orbits = find_orbits(block, SHAKING, max_period=1, seeds=3)
    assert {orbit.model for orbit in orbits} == {model}
    assert find_attractor(block, SHAKING).model == ReturnMap(block, SHAKING).model == model


def test_windows_spectra_and_impulses_choose_by_the_block() -> None:
    reach = {"within": (3.0, 4.0), "resolution": 0.1}
    for block, model in ((BLOCK, Nonlinear()), (BARE, Linear())):
        found = find_overturning_windows(block, "half-sine", [3.0], **reach)  # type: ignore[arg-type]
        assert found.model == model
        assert found.to_dataset().attrs["model"] == model.name
    data = compute_rocking_spectrum(RECORD, alpha=0.2, periods_s=3.0)
    assert data.attrs["model"] == "nonlinear"
    assert overturning_impulse(BLOCK) == overturning_impulse(BLOCK, model=Nonlinear())
    assert overturning_impulse(BLOCK) > overturning_impulse(BLOCK, model=Linear())
    with pytest.raises(InputError, match="it must be a Linear or a Nonlinear"):
        find_attractor(BLOCK, SHAKING, model=Nonlinear)  # type: ignore[arg-type]
    with pytest.raises(ModelError, match="needs the block's slenderness"):
        chosen_model(Nonlinear(), BARE)


@every("tolerance", [0.0, 1e-14, 0.1, float("nan"), "fine"])
def test_a_tolerance_has_limits(tolerance: float) -> None:
    with pytest.raises(InputError, match="tolerance"):
        Nonlinear(tolerance=tolerance)


def test_the_error_of_the_full_equations_lies_between_1e_13_and_1e_3() -> None:
    assert Nonlinear().tolerance == 1e-10
    for tolerance in (1e-13, 1e-10, 1e-3):
        given = Nonlinear(tolerance=tolerance)
        assert chosen_model(given, BLOCK) is given
        assert given.name == "nonlinear"
    for tolerance in (math.nextafter(1e-13, 0.0), math.nextafter(1e-3, 1.0), 0.0, 1.0, math.nan):
        with pytest.raises(InputError, match=r"^tolerance = .*\[1e-13, 0.001\]"):
            Nonlinear(tolerance=tolerance)
