"""Basins and erosion of the nonlinear model: single states, energy, symmetry, slender blocks."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    State,
    Status,
    compute_basins,
    compute_erosion,
    find_attractor,
    simulate,
)
from rocksteady.basins import Basins
from rocksteady.errors import ModelError
from rocksteady.model.equations import Linear, Nonlinear
from tests.dynamics.kicks import apart
from tests.every import every

Floats = NDArray[np.float64]

ASYMMETRY = Block.asymmetric(left=0.3, right=0.5, height=1.6, restitution=(0.8, 0.9))
STOCKY = Block.from_radius(alpha=0.5, radius=1.0, restitution=0.8)


def window(half_width: float, count: int) -> Floats:
    from_middle = np.arange(count, dtype=np.float64) - 0.5 * (count - 1)
    middles: Floats = from_middle * (2.0 * half_width / count)
    return middles


def driven(frequency_ratio: float) -> Harmonic:
    return Harmonic(amplitude=1.0, frequency_ratio=frequency_ratio)


def at(block: Block, a: float, w: float, count: int = 12, **more: int) -> Basins:
    return compute_basins(
        block,
        Harmonic(amplitude=a, frequency_ratio=w, phase=0.4),
        angles=window(1.2, count),
        velocities=window(1.2, count),
        model=Nonlinear(),
        **more,  # type: ignore[arg-type]
    )


@pytest.mark.slow
@every(
    ("block", "a", "w"),
    [
        (STOCKY, 2.0, 4.0),
        (STOCKY.with_restitution(0.9), 0.5, 2.0),
        (STOCKY, 2.0, 1.9),
        (ASYMMETRY, 2.0, 4.0),
    ],
)
@every("seed", [None, 5])
def test_each_state_goes_where_it_goes_alone(
    block: Block, a: float, w: float, seed: int | None
) -> None:
    found = at(block, a, w, max_cycles=300, **({} if seed is None else {"seed": seed}))
    assert found.model == Nonlinear()
    assert len(found.attractors) >= 2
    for row, column in np.ndindex(found.label.shape):
        state = State(
            angle=float(found.start_angle[row, column]),
            velocity=float(found.start_velocity[row, column]),
        )
        alone = find_attractor(block, found.motion, start=state, max_cycles=300, model=Nonlinear())
        here = found.attractors[found.label[row, column]]
        assert here.kind is alone.kind
        assert (here.orbit is None) == (alone.orbit is None)
        if here.orbit is not None and alone.orbit is not None:
            assert here.orbit.model == Nonlinear()
            assert here.period == alone.period
            assert min(apart(alone.orbit.states[0], one) for one in here.orbit.states) < 1e-6


def test_states_on_an_attractor_at_the_phase_stay_there() -> None:
    found = at(STOCKY, 2.0, 4.0, max_cycles=300)
    for one, points in zip(found.attractors, found.stroboscopic, strict=True):
        if one.orbit is None:
            continue
        for angle, velocity in points:
            start = State(angle=angle, velocity=velocity)
            back = simulate(
                STOCKY, found.motion, start=start, cycles=one.orbit.period, model=Nonlinear()
            )
            end = back(back.end_time_pt)
            assert (end.angle, end.velocity) == pytest.approx((angle, velocity), abs=1e-9)


def test_half_a_period_later_the_basins_are_turned_round() -> None:
    one = at(STOCKY, 2.0, 1.9)
    other = compute_basins(
        STOCKY,
        Harmonic(amplitude=2.0, frequency_ratio=1.9, phase=0.4 + math.pi),
        angles=one.angle,
        velocities=one.velocity,
        model=Nonlinear(),
    )
    turned = other.label[::-1, ::-1]
    kinds = [np.array([x.kind.value for x in each.attractors]) for each in (one, other)]
    np.testing.assert_array_equal(kinds[0][one.label], kinds[1][turned])


def test_slender_blocks_have_the_basins_of_the_linear_model() -> None:
    slender = Block.from_radius(alpha=1e-7, radius=1.0, restitution=0.8)
    full = at(slender, 2.0, 4.0, count=20)
    plain = compute_basins(
        slender, full.motion, angles=full.angle, velocities=full.velocity, model=Linear()
    )
    np.testing.assert_array_equal(full.label, plain.label)
    assert [x.name for x in full.attractors] == [x.name for x in plain.attractors]


def test_a_dataset_says_of_which_model_it_is() -> None:
    full, unlike = at(STOCKY, 2.0, 4.0).to_dataset(), at(ASYMMETRY, 2.0, 4.0).to_dataset()
    assert (full.attrs["model"], full.attrs["alpha"]) == ("nonlinear", 0.5)
    assert unlike.attrs["alpha"] == ASYMMETRY.positive.alpha
    bare = STOCKY.dimensionless()
    plain = compute_basins(
        bare, Harmonic(amplitude=2.0, frequency_ratio=4.0), angles=[0, 1], velocities=[0, 1]
    ).to_dataset()
    assert plain.attrs["model"] == "linear"


# ----------------------------------------------------------------------------------- erosion


@pytest.mark.parametrize("block", [STOCKY, ASYMMETRY])
def test_each_state_is_as_safe_as_it_is_alone(block: Block) -> None:
    axis = window(1.3, 10)
    found = compute_erosion(
        block,
        Harmonic(amplitude=1.0, frequency_ratio=2.0, phase=1.0),
        [0.3, 0.8],
        cycles=20,
        angles=axis,
        velocities=axis,
        model=Nonlinear(),
    )
    for which, amplitude in enumerate(found.amplitude.tolist()):
        shaking = Harmonic(amplitude=amplitude, frequency_ratio=2.0, phase=found.motion.phase)
        for row, velocity in enumerate(found.velocity.tolist()):
            for column, angle in enumerate(found.angle.tolist()):
                state = State(angle=angle, velocity=velocity)
                run = simulate(block, shaking, start=state, cycles=20, model=Nonlinear())
                assert found.safe[which, row, column] == (run.status is not Status.OVERTURNED)
    assert 0.1 < found.safe.mean() < 0.9


@pytest.mark.parametrize("block", [STOCKY, ASYMMETRY])
def test_the_safe_basin_of_a_still_base_is_one_of_energy(block: Block) -> None:
    # Over the balance neither on its own side nor, with what impacts leave, on the other or back.
    axis = window(1.6, 41)
    found = compute_erosion(
        block, driven(3.0), [0.0], angles=axis, velocities=axis, model=Nonlinear()
    )
    assert found.global_integrity[0] == found.integrity_factor[0] == 1.0
    sides = {1: block.positive, -1: block.negative}
    unit = block.positive.alpha * block.positive.p
    for row, column in np.ndindex(found.safe[0].shape):
        theta = found.angle[column] * block.positive.alpha
        rate = found.velocity[row] * unit
        side = 1 if (theta or rate) > 0.0 else -1
        own, other = sides[side], sides[-side]
        tilt = float(own.alpha - side * theta)
        speed, barrier = side * float(rate), own.p * 2.0 * abs(math.sin(0.5 * tilt))
        safe = speed < barrier if tilt > 0.0 else speed < -barrier
        if safe and (theta or rate):
            landing = speed**2 + 2.0 * own.p**2 * (math.cos(tilt) - math.cos(own.alpha))
            # After the first impact to the other side, and after the second back to its own.
            left = own.restitution * math.sqrt(landing)
            safe = left < other.p * 2.0 * math.sin(0.5 * other.alpha)
            left *= other.restitution
            safe = safe and left < own.p * 2.0 * math.sin(0.5 * own.alpha)
        assert bool(found.safe[0, row, column]) == safe


def test_slender_blocks_erode_as_in_the_linear_model() -> None:
    slender = Block.from_radius(alpha=1e-7, radius=1.0, restitution=0.9)
    axis = window(1.47, 24)  # on which no state would balance
    full, plain = (
        compute_erosion(slender, driven(2.0), [0.3, 0.8], angles=axis, velocities=axis, model=model)
        for model in (Nonlinear(), Linear())
    )
    np.testing.assert_array_equal(full.safe, plain.safe)
    one, other = full.drop(tolerance=0.02), plain.drop(tolerance=0.02)
    assert one is not None
    assert one == other


def test_what_is_closed_in_the_linear_model_alone_is_left_out() -> None:
    axis = window(1.5, 16)
    found = compute_erosion(
        STOCKY, driven(2.0), [0.3, 0.8], angles=axis, velocities=axis, cycles=10, model=Nonlinear()
    )
    assert found.heteroclinic is None
    data = found.to_dataset()
    assert "heteroclinic_amplitude" not in data.attrs
    assert (data.attrs["model"], data.attrs["alpha"]) == ("nonlinear", 0.5)
    assert "no closed form in the nonlinear model" in found.summary(more=True)


def test_a_block_without_slenderness_is_refused() -> None:
    bare = DimensionlessBlock(restitution=0.8)
    with pytest.raises(ModelError, match="slenderness"):
        compute_basins(bare, Harmonic(amplitude=2.0, frequency_ratio=4.0), model=Nonlinear())
    with pytest.raises(ModelError, match="slenderness"):
        compute_erosion(bare, driven(2.0), [0.5], model=Nonlinear())
