"""Time histories under records: against segments, an integrator, and what a trajectory tells."""

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Record,
    State,
    Status,
    Steady,
    plots,
    simulate,
)
from rocksteady.errors import ModelError
from rocksteady.model.equations import Linear
from tests.dynamics.integrator import integrate
from tests.model.test_linear_tables import as_pieces
from tests.records import el_centro, synthetic

Floats = NDArray[np.float64]

BLOCK = Block.rectangle(width=0.4, height=1.6)


def record(peak: float = 4.0, seed: int = 8) -> Record:
    values = synthetic(np.random.default_rng(seed), 500, 0.02, peak)
    return Record(acceleration_m_s2=values, dt_s=0.02, name="noise")


def test_a_record_and_its_segments_give_one_trajectory() -> None:
    shaking = record()
    run, other = (
        simulate(BLOCK, shaking, model=Linear()),
        simulate(BLOCK, as_pieces(shaking, BLOCK), model=Linear()),
    )
    assert len(run.impacts) > 10
    assert run.motion is shaking
    np.testing.assert_array_equal(run.rows, other.rows)
    assert (run.peak, run.end_time_pt, run.rest_time_pt) == (
        other.peak,
        other.end_time_pt,
        other.rest_time_pt,
    )


def test_impacts_and_angles_are_those_of_an_adaptive_integrator() -> None:
    values = synthetic(np.random.default_rng(3), 60, 0.02, 5.0)
    shaking = Record(acceleration_m_s2=values, dt_s=0.02)
    alpha, angle, velocity = BLOCK.alpha, 0.3, -0.4
    run = simulate(BLOCK, shaking, start=State(angle=angle, velocity=velocity), model=Linear())
    times = 0.02 * np.arange(60)
    truth = integrate(
        lambda t: float(np.interp(t, times, values)) / BLOCK.uplift_acceleration * alpha,
        1.18,
        alpha=alpha,
        p=BLOCK.p,
        restitution=BLOCK.restitution,
        angle=alpha * angle,
        velocity=alpha * BLOCK.p * velocity,
        longest_step=0.002,
    )
    assert len(truth.impacts) > 1
    found = run.impacts.pt[: len(truth.impacts)] / BLOCK.p
    np.testing.assert_allclose(found, truth.impacts, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(
        run.at_time(truth.times).angle, truth.angles / alpha, rtol=0.0, atol=1e-5
    )


def test_the_base_moves_as_recorded_and_then_stands_still() -> None:
    shaking = record()
    run = simulate(BLOCK, shaking, model=Linear())
    times = 0.02 * np.arange(500)
    inside = times[times * BLOCK.p <= run.end_time_pt][:-1]
    middle = inside + 0.005
    for at in (inside, middle):
        expected = np.interp(at, times, shaking.acceleration_m_s2) / BLOCK.uplift_acceleration
        found = run.base_acceleration(at * BLOCK.p)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-10)
    assert run.base_acceleration(10.1 * BLOCK.p) == 0.0
    # Simpson's rule is exact for the cubes of a line integrated twice.
    velocity = np.concatenate(
        [
            [0.0],
            np.cumsum(
                np.diff(times)
                * (shaking.acceleration_m_s2[:-1] + shaking.acceleration_m_s2[1:])
                / 2.0
            ),
        ]
    )
    a = shaking.acceleration_m_s2
    place = np.concatenate(
        [[0.0], np.cumsum(0.02 * velocity[:-1] + 0.02**2 * (2.0 * a[:-1] + a[1:]) / 6.0)]
    )
    unit = BLOCK.uplift_acceleration / BLOCK.p**2
    np.testing.assert_allclose(
        unit * run.base_displacement(times * BLOCK.p), place, rtol=0.0, atol=1e-11
    )


def test_a_reversed_record_mirrors_and_a_scaled_one_overturns() -> None:
    shaking = record()
    run = simulate(BLOCK, shaking, model=Linear())
    mirror = simulate(BLOCK, shaking.reversed(), model=Linear())
    assert run.status is Status.AT_REST
    np.testing.assert_array_equal(run.impacts.pt, mirror.impacts.pt)
    np.testing.assert_array_equal(run.impacts.side, -mirror.impacts.side)
    fallen = simulate(BLOCK, shaking.scaled(8.0), model=Linear())
    assert fallen.status is Status.OVERTURNED
    assert fallen.overturn_time_s is not None
    assert fallen.peak >= 1.0


def test_a_record_below_uplift_leaves_the_block_at_rest() -> None:
    run = simulate(BLOCK, record(peak=0.999 * BLOCK.uplift_acceleration), model=Linear())
    assert (run.status, run.peak, run.rest_time_pt, len(run.impacts)) == (
        Status.AT_REST,
        0.0,
        0.0,
        0,
    )


def test_el_centro_rocks_a_block() -> None:
    values, step = el_centro()
    run = simulate(
        BLOCK, Record(acceleration_m_s2=values, dt_s=step, name="El Centro"), model=Linear()
    )
    assert run.status is Status.AT_REST
    assert len(run.impacts) > 10
    assert 0.01 < run.peak < 1.0
    fine = run(run.times(400))
    assert run.peak >= np.abs(fine.angle).max() >= run.peak - 1e-3


def test_plots_of_a_run_under_a_record() -> None:
    from matplotlib.figure import Figure

    run = simulate(BLOCK, record(), model=Linear())
    assert plots.trajectory(run, Figure().add_subplot()).lines
    assert plots.base(run, Figure().add_subplot()).lines


def test_a_record_asks_for_a_block_and_no_steady_start() -> None:
    with pytest.raises(ModelError, match="give a Block"):
        simulate(DimensionlessBlock(restitution=0.8), record())
    with pytest.raises(ModelError, match="needs harmonic shaking"):
        simulate(BLOCK, record(), start=Steady(), model=Linear())
    with pytest.raises(ModelError, match="harmonic"):
        simulate(BLOCK, record(), model=Linear()).at_tau(0.0)
    assert simulate(BLOCK, Harmonic(amplitude=2.0, frequency_ratio=3.0), cycles=1).peak > 0.0
