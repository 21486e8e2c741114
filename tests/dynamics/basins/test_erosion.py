"""Erosion: measures by hand, a still base in closed form, and the heteroclinic curve."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    DimensionlessBlock,
    Execution,
    Harmonic,
    State,
    Status,
    Store,
    compute_erosion,
    simulate,
)
from rocksteady.basins import Erosion
from rocksteady.dynamics.basins._safe import measured
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import heteroclinic_amplitude
from rocksteady.motions import FourierSeries
from tests.every import every

Floats = NDArray[np.float64]


def eroded(restitution: float, frequency: float, amplitudes: Any, **more: Any) -> Erosion:
    motion = Harmonic(amplitude=1.0, frequency_ratio=frequency, phase=more.pop("phase", 0.0))
    return compute_erosion(DimensionlessBlock(restitution=restitution), motion, amplitudes, **more)


def coarse(count: int, half_width: float = 1.5) -> dict[str, Any]:
    middles = (np.arange(count, dtype=np.float64) - 0.5 * (count - 1)) * (2 * half_width / count)
    return {"angles": middles, "velocities": middles}


def test_each_state_is_as_safe_as_it_is_alone() -> None:
    found = eroded(0.8, 2.0, [0.7, 1.2], phase=1.0, cycles=30, **coarse(12))
    block = DimensionlessBlock(restitution=0.8)
    for which, amplitude in enumerate(found.amplitude.tolist()):
        shaking = Harmonic(amplitude=amplitude, frequency_ratio=2.0, phase=found.motion.phase)
        for row, velocity in enumerate(found.velocity.tolist()):
            for column, angle in enumerate(found.angle.tolist()):
                state = State(angle=angle, velocity=velocity)
                run = simulate(block, shaking, start=state, cycles=30)
                assert found.safe[which, row, column] == (run.status is not Status.OVERTURNED)
    assert 0.1 < found.safe.mean() < 0.9


def test_integrity_is_1_at_most_where_shaking_moves_more_safe_states_into_the_window() -> None:
    above = 0
    for restitution, ratio, phase in ((0.8, 0.5, 2.0), (0.9, 4.0, 1.0), (0.95, 8.0, 4.0)):
        found = eroded(restitution, ratio, np.linspace(0.02, 0.3, 6), phase=phase, **coarse(30))
        area = found.safe_share / found.still_share
        radius = found.radius / found.still_radius
        above += int((area > 1.0).sum() + (radius > 1.0).sum())
        np.testing.assert_array_equal(found.global_integrity, np.minimum(area, 1.0))
        np.testing.assert_array_equal(found.integrity_factor, np.minimum(radius, 1.0))
    assert above > 0


@every("restitution", [0.5, 0.8, 0.95])
def test_the_safe_basin_of_a_still_base_is_known(restitution: float) -> None:
    found = eroded(restitution, 3.0, [0.0, 0.1])
    u, v = np.meshgrid(found.angle, found.velocity)
    side = np.sign(u)
    y, w = side * u, side * v
    landing = np.sqrt(np.maximum(w**2 - (y - 1.0) ** 2 + 1.0, 0.0))
    safe = (y + w < 1.0) & (restitution * landing < 1.0)
    assert np.array_equal(found.safe[0], safe)
    assert found.still_share == safe.mean()
    # Between the two lines |u + v| = 1 there is a circle of radius 1/sqrt(2) around the origin;
    # where an impact takes much, a larger one lies outside of them.
    cell = (u[0, 1] - u[0, 0]) * math.sqrt(2.0)
    assert found.still_radius > math.sqrt(0.5) - cell
    if restitution > 0.7:
        assert found.still_radius == pytest.approx(math.sqrt(0.5), abs=cell)
    assert found.global_integrity[0] == found.integrity_factor[0] == 1.0


def test_measures_by_brute_force() -> None:
    rng = np.random.default_rng(4)
    angles, velocities = np.linspace(-1.0, 1.0, 21), np.linspace(-0.6, 0.6, 17)
    for _ in range(5):
        safe = rng.random((17, 21)) < 0.97
        share, radius = measured(safe, angles, velocities)
        assert share == safe.mean()
        # Unsafe are also the points that would come next beyond the edges.
        wide = np.linspace(-1.1, 1.1, 23), np.linspace(-0.675, 0.675, 19)
        padded = np.zeros((19, 23), dtype=bool)
        padded[1:-1, 1:-1] = safe
        u, v = np.meshgrid(*wide)
        bad = np.array([u[~padded], v[~padded]])
        nearest = [
            np.hypot(bad[0] - x, bad[1] - y).min()
            for x, y in zip(u[padded], v[padded], strict=True)
        ]
        assert radius == pytest.approx(max(nearest), rel=1e-12)


@pytest.mark.slow
@every(("restitution", "frequency"), [(0.9, 2.0), (0.8, 2.0), (0.9, 4.0)])
def test_the_core_is_whole_up_to_the_heteroclinic_curve_and_erodes_beyond(
    restitution: float, frequency: float
) -> None:
    # Lenci and Rega (2005): below the curve no tongue of the overturning basin enters the core.
    curve = float(heteroclinic_amplitude(frequency, restitution))
    found = eroded(restitution, frequency, curve * np.array([0.5, 0.95, 1.5, 3.0]))
    assert found.heteroclinic == curve
    assert (found.integrity_factor[:2] > 0.985).all()
    assert found.integrity_factor[2] < 0.985
    assert found.integrity_factor[3] < 0.75
    drop = found.drop(level=0.9)
    assert drop is not None
    assert curve < drop.low < drop.high


def test_the_drop_under_a_fourier_series_is_that_of_the_series() -> None:
    """It was bisected under the first harmonic alone."""
    block = DimensionlessBlock(restitution=0.9)
    waves = FourierSeries(
        amplitude=1.0, frequency_ratio=2.0, harmonics=((1, 1.0, 0.0), (3, 0.6, 1.0))
    )
    found = compute_erosion(block, waves, np.linspace(0.1, 1.1, 6), cycles=20, **coarse(29))
    for measure in ("integrity_factor", "global_integrity"):
        drop = found.drop(measure, level=0.6, tolerance=1e-2)
        assert drop is not None
        ends = [drop.low, drop.high]
        again = compute_erosion(block, waves, ends, cycles=20, **coarse(29))
        assert again.measure(measure).tolist() == [drop.above, drop.below]


def test_the_drop_is_bracketed() -> None:
    found = eroded(0.9, 2.0, np.linspace(0.1, 1.1, 6), **coarse(60))
    for measure in ("integrity_factor", "global_integrity"):
        drop = found.drop(measure, level=0.6, tolerance=1e-2)
        assert drop is not None
        assert 0.0 < drop.high - drop.low <= 1e-2
        assert drop.above >= 0.6 > drop.below
        again = eroded(0.9, 2.0, [drop.low, drop.high], **coarse(60))
        assert again.measure(measure).tolist() == [drop.above, drop.below]
    assert found.drop(level=0.6, tolerance=10.0) is not None
    assert eroded(0.9, 2.0, [0.1], **coarse(60)).drop() is None


def test_a_window_already_below_the_level_is_bracketed_from_the_still_base() -> None:
    found = eroded(0.9, 2.0, [1.5], **coarse(60))
    drop = found.drop(tolerance=0.05)
    assert drop is not None
    assert 0.26 < drop.low < drop.high < 1.5


def test_executors_agree_and_whole_periods_change_nothing() -> None:
    axes = coarse(40)
    told: list[int] = []
    one = eroded(0.9, 2.0, [0.5, 1.0], phase=0.7, run=Execution(progress=told.append), **axes)
    other = eroded(
        0.9, 2.0, [0.5, 1.0], phase=0.7 - 2.0 * math.pi, run=Execution(executor="serial"), **axes
    )
    assert np.array_equal(one.safe, other.safe)
    assert sum(told) == 3 * 40 * 40  # the still base too
    image = eroded(0.9, 2.0, [0.5, 1.0], phase=0.7 + math.pi, **axes)
    assert np.array_equal(one.safe[:, ::-1, ::-1], image.safe)
    assert np.array_equal(one.radius, image.radius)


@pytest.mark.slow
def test_a_store_holds_the_states_and_a_drop_has_none(tmp_path: Path) -> None:
    path, told = tmp_path / "erosion.zarr", list[int]()
    given: dict[str, Any] = {"restitution": 0.9, "frequency": 2.0, "amplitudes": [0.6, 1.0]}
    found = eroded(**given, run=Execution(store=path))  # of the default window
    again = eroded(**given, run=Execution(store=Store(path, resume=True), progress=told.append))
    assert told == [3 * len(found.angle) * len(found.velocity)]  # nothing is computed again
    memory = eroded(**given)
    for one in (found, again):
        assert np.array_equal(one.safe, memory.safe)
        assert one.to_dataset().identical(memory.to_dataset())
    with pytest.raises(ModelError, match="run has a store: the basins of a drop are not kept"):
        found.drop(run=Execution(store=tmp_path / "other.zarr"))


def test_a_dataset_and_a_table_hold_it() -> None:
    found = eroded(0.9, 2.0, [0.2, 0.6], **coarse(20))
    data = found.to_dataset()
    assert data.safe.dims == ("amplitude", "velocity", "angle")
    assert np.array_equal(data.integrity_factor, found.integrity_factor)
    assert data.attrs["heteroclinic_amplitude"] == found.heteroclinic
    assert found.summary(more=True).count("\n") > 8
    assert "Erosion" in found._repr_html_()


@every(
    ("amplitudes", "more", "valid"),
    [
        ([1.0, 0.5], {}, "must ascend"),
        ([-1.0], {}, "amplitude = -1.0 is not valid"),
        ([], {}, "one or more real numbers"),
        ([1.0], {"frequency": 0.0}, "frequency_ratio"),
        ([1.0], {"angles": [1.0, 2.0, 4.0]}, "evenly spaced"),
        ([1.0], {"cycles": 0}, "whole number"),
        ([1.0], {"phase": math.nan}, "phase"),
    ],
)
def test_bad_arguments_are_refused(amplitudes: Any, more: dict[str, Any], valid: str) -> None:
    arguments = {"restitution": 0.9, "frequency": 2.0, "amplitudes": amplitudes, **more}
    with pytest.raises(InputError, match=valid):
        eroded(**arguments)


def test_a_window_without_a_safe_state_measures_nothing() -> None:
    with pytest.raises(ModelError, match="no state of this window stands"):
        eroded(0.9, 2.0, [0.1], angles=[3.0, 4.0], velocities=[1.0, 2.0])


@every(
    ("arguments", "valid"),
    [
        ({"measure": "area"}, "one of integrity_factor, global_integrity"),
        ({"level": 0.0}, "level"),
        ({"level": 1.5}, "level"),
        ({"tolerance": 0.0}, "tolerance"),
    ],
)
def test_the_arguments_of_a_drop_are_validated(arguments: dict[str, Any], valid: str) -> None:
    with pytest.raises(InputError, match=valid):
        eroded(0.9, 2.0, [0.2], **coarse(6)).drop(**arguments)


@pytest.mark.slow
def test_the_window_holds_the_largest_circle_on_a_still_base() -> None:
    # With little restitution fast blocks survive: their circle reaches beyond 1.5.
    for restitution in (0.35, 0.5, 0.8):
        narrow = eroded(restitution, 2.0, [0.1])
        wide = eroded(restitution, 2.0, [0.1], **coarse(400, half_width=6.0))
        assert narrow.still_radius == pytest.approx(wide.still_radius, abs=0.07)
        assert (narrow.angle.max() > 1.5) == (restitution < 0.6)
