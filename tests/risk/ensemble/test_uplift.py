"""The first uplift: its time by a search in fine steps, its scale by the runs themselves."""

import math

import numpy as np
import pytest
import xarray

from rocksteady import (
    BaseMotion,
    Block,
    Linear,
    Nonlinear,
    Record,
    floor_motion,
    run_ensemble,
)
from rocksteady.risk import Levels, RestitutionBand
from rocksteady.risk.ensemble.uplift import Lines, driving, uplift_times
from rocksteady.seismic.spectra.batch import GroundShaking
from tests.every import every

ACROSS = Record(acceleration_m_s2=np.array([0.0, 3.0, -2.0, 4.0, -6.0, 1.0]), dt_s=0.5)
UP = Record(acceleration_m_s2=np.array([1.0, -4.0, 5.0, -7.0, 2.0]), dt_s=0.7)
FREE = Block.asymmetric(left=0.2, right=0.3, height=1.6, gravity=9.0)
BLOCKS = (Block.rectangle(width=0.4, height=1.6), FREE, FREE.against_wall(0.5))
BOTH = ("as recorded", "reversed")


def searched(
    block: Block, factor: float, sign: float, up: Record | None, *, linear: bool = False
) -> float:
    """Return the first instant at which the moment about an edge lifts; nan where none does."""
    t = np.linspace(0.0, 3.0, 30_001)

    def course(record: Record | None) -> np.ndarray:
        if record is None:
            return np.zeros(len(t))
        samples = record.acceleration_m_s2
        return np.interp(t, record.dt_s * np.arange(len(samples)), samples, right=0.0)

    a, lift = factor * sign * course(ACROSS), factor * course(up)
    lifted = np.zeros(len(t), dtype=bool)
    sides = [(1.0, block.positive)] + ([] if block.one_sided else [(-1.0, block.negative)])
    for way, side in sides:
        slope = side.alpha if linear else math.tan(side.alpha)
        lifted |= way * a > (block.gravity + lift) * slope
    return float(t[lifted][0]) if lifted.any() else math.nan


@every("linear", [False, True])
@every("up", [None, UP])
def test_it_is_the_first_instant_at_which_the_moment_lifts(up: Record | None, linear: bool) -> None:
    factors = (0.3, 0.6, 0.9, 1.3, 3.0)
    scale = np.tile(factors, (3, 1, 1))
    lifts = ("without",) if up is None else ("without", "with")
    found = uplift_times(
        BLOCKS,
        [GroundShaking(record=ACROSS, vertical=up)],
        scale,
        BOTH,
        lifts,
        linear=linear,
    )
    assert found.shape == (3, 1, 2, len(lifts), 5)
    for place, block in enumerate(BLOCKS):
        for i, sign in enumerate((1.0, -1.0)):
            for j, lift in enumerate(lifts):
                shaken = up if lift == "with" else None
                for k, factor in enumerate(factors):
                    # The threshold of the linear model is one of small angles, lifting too.
                    expected = searched(block, factor, sign, shaken, linear=linear)
                    assert found[place, 0, i, j, k] == pytest.approx(
                        expected, abs=2e-4, nan_ok=True
                    )
    assert np.isnan(found).any()
    assert np.isfinite(found).any()


def test_grounds_and_scales_keep_their_places() -> None:
    grounds = [GroundShaking(record=ACROSS), GroundShaking(record=ACROSS.scaled(0.5))]
    scale = np.array([[[0.8, 1.6], [1.6, 3.2]]])
    found = uplift_times([BLOCKS[0]], grounds, scale, BOTH, ("without",), linear=False)
    assert found[0, 0] == pytest.approx(found[0, 1])
    # Of a symmetric block the other sign is the mirror image.
    assert (found[0, 0, 0] == found[0, 0, 1]).all()
    assert found[0, 0, 0, 0, 1] < found[0, 0, 0, 0, 0]


def test_a_level_that_is_only_touched_does_not_lift() -> None:
    lines = driving(ACROSS, 1.0)
    assert lines.first.tolist() == [0.0, 3.0, -2.0, 4.0, -6.0]
    assert lines.last.tolist() == [3.0, -2.0, 4.0, -6.0, 1.0]
    levels = np.array([-1.0, 0.0, 1.5, 3.0, 3.5, 4.0, 4.1])
    found = lines.first_above(levels)
    assert found == pytest.approx(
        [0.0, 0.0, 0.25, 1.0 + 0.5 * 5.0 / 6.0, 1.0 + 0.5 * 5.5 / 6.0, math.nan, math.nan],
        nan_ok=True,
    )
    step = Lines(np.array([0.0, 1.0]), np.ones(2), np.array([0.0, 5.0]), np.array([0.0, 5.0]))
    assert step.first_above(np.array([1.0, 5.0])) == pytest.approx([1.0, math.nan], nan_ok=True)


def test_lines_of_two_components_meet_at_the_samples_of_both() -> None:
    lines = driving(ACROSS, -1.0, 0.25, UP)
    ends = lines.start_s + lines.length_s
    known = sorted({*(0.5 * np.arange(6)), *np.round(0.7 * np.arange(5), 12)})
    assert np.round([*lines.start_s, ends[-1]], 12).tolist() == pytest.approx(known)
    for start, length, first, last in zip(*lines, strict=True):
        middle = start + 0.5 * length
        across = np.interp(middle, 0.5 * np.arange(6), ACROSS.acceleration_m_s2, right=0.0)
        up = np.interp(middle, 0.7 * np.arange(5), UP.acceleration_m_s2, right=0.0)
        assert 0.5 * (first + last) == pytest.approx(-across - 0.25 * up)


MOTIONS = (ACROSS, floor_motion(ACROSS, frequencies_hz=2.0, shapes=1.4), BaseMotion(ACROSS, UP))
"""Of the ground, of a floor, and with a vertical component."""


@every("model", [Linear(), Nonlinear()])
def test_a_run_lifts_above_its_scale_of_uplift_and_not_up_to_it(model: Linear | Nonlinear) -> None:
    motions = MOTIONS if model == Nonlinear() else MOTIONS[:2]
    band = RestitutionBand(draws=1)

    def runs(scales: list[float]) -> xarray.Dataset:
        levels = Levels("scale", scales, beside=())
        return run_ensemble(BLOCKS, motions, levels=levels, restitution=band, model=model)

    at = runs([1.0])["uplift_scale"].values
    assert np.isfinite(at).all()
    near = np.unique(np.outer(np.unique(at), [1.0 - 1e-7, 1.0 + 1e-7]))
    lifted = runs(near.tolist())["peak_angle"].isel(draw=0).values > 0.0
    np.testing.assert_array_equal(lifted, near > at[..., np.newaxis])
