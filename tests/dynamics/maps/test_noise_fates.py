"""Fates under a motion with noise: each is a time history, and shares are counts of them."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    BaseMotion,
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Linear,
    Nonlinear,
    Pulse,
    Record,
    State,
    Still,
    Store,
    compute_noise_fates,
    motions,
    simulate,
)
from rocksteady.errors import InputError, ModelError, OutputError
from rocksteady.motions import BandNoise, Impulses, Segment, add_noise
from tests.every import every

BARE = DimensionlessBlock(restitution=0.9)
BLOCK = Block.rectangle(width=0.8, height=3.0, restitution=0.9)
NOISE = BandNoise(rms=1.0, band=(0.5, 6.0), duration=12.0, seed=3)
PULSE = Pulse(shape="one-sine", amplitude=4.0, frequency_ratio=4.0)
T = 0.05 * np.arange(80)
RECORD = Record(acceleration_m_s2=3.0 * np.sin(5.0 * T) * np.exp(-0.3 * T), dt_s=0.05)
UP = Record(acceleration_m_s2=2.0 * np.sin(17.0 * T), dt_s=0.05)
LEVELS = [0.0, 0.4, 1.0]


@pytest.mark.slow
@every(
    ("block", "motion", "model"),
    [
        (BARE, PULSE, Linear()),
        (BARE, Harmonic(amplitude=1.2, frequency_ratio=3.0), Linear()),
        (BARE, Impulses(velocities=(0.6, -0.3), times=(0.0, 2.0)), Linear()),
        (BLOCK, RECORD, Linear()),
        (BLOCK, BaseMotion(RECORD, UP), Nonlinear()),
    ],
)
def test_every_run_is_that_of_simulate(block: Any, motion: Any, model: Any) -> None:
    start = State(angle=0.1, velocity=-0.1)
    found = compute_noise_fates(
        block,
        motion,
        NOISE,
        axes={"level": LEVELS, "scale": [0.0, 1.0, 1.3]},
        draws=3,
        start=start,
        model=model,
    )
    for i, j in np.ndindex(found.overturned.shape):
        scale, level = float(found.scale[i]), float(found.level[j])
        scaled: Any = Still()
        if scale:
            base = isinstance(motion, BaseMotion)
            scaled = motion.scaled(scale) if base else motions.scale(motion, scale)
        for draw in range(found.draws):
            noise = NOISE.realisation(draw, rms=level * NOISE.rms)
            whole = add_noise(scaled, noise, block=block if block is BLOCK else None)
            run = simulate(block, whole, start=start, model=model)
            assert found.fate[i, j, draw] == run.status
            assert found.impacts[i, j, draw] == len(run.impacts)
            assert found.peak[i, j, draw] == pytest.approx(run.peak, rel=1e-13)


def test_level_0_is_the_motion_alone_in_every_draw() -> None:
    for scale, falls in ((4.0, True), (5.0, False)):
        motion = Pulse(shape="one-sine", amplitude=scale, frequency_ratio=4.0)
        found = compute_noise_fates(BARE, motion, NOISE, axes={"level": [0.0]}, draws=5)
        alone = simulate(BARE, motion)
        assert (found.fate == alone.status).all()
        assert (found.impacts == len(alone.impacts)).all()
        assert found.share.tolist() == [[float(falls)]]
        low, high = found.interval()
        assert low[0, 0] == high[0, 0] == found.share[0, 0]


def test_more_draws_other_levels_and_a_store_keep_the_runs(tmp_path: Path) -> None:
    given: Any = {"axes": {"level": LEVELS}}
    few = compute_noise_fates(BARE, PULSE, NOISE, **given, draws=20)
    many = compute_noise_fates(
        BARE, PULSE, NOISE, **given, draws=40, run=Execution(executor="serial")
    )
    assert np.array_equal(many.fate[:, :, :20], few.fate)
    one = compute_noise_fates(BARE, PULSE, NOISE, axes={"level": [0.4]}, draws=20)
    assert np.array_equal(one.peak[:, 0], few.peak[:, 1])
    place = tmp_path / "noise.zarr"
    stored = compute_noise_fates(BARE, PULSE, NOISE, **given, draws=20, run=Execution(store=place))
    assert stored.to_dataset().equals(few.to_dataset())


def test_a_motion_of_any_class_and_a_record_are_kept_in_a_store(tmp_path: Path) -> None:
    class Own:
        def segments(self) -> tuple[Segment, ...]:
            return PULSE.segments()

    one = compute_noise_fates(BARE, Own(), NOISE, axes={"level": LEVELS}, draws=3)
    other = compute_noise_fates(BARE, PULSE, NOISE, axes={"level": LEVELS}, draws=3)
    assert np.array_equal(one.peak, other.peak)
    kept = Store(tmp_path / "kept.zarr")
    given: Any = {"axes": {"scale": [0.5, 1.0]}, "draws": 3}
    stored = compute_noise_fates(
        BLOCK, BaseMotion(RECORD, UP), NOISE, **given, run=Execution(store=kept)
    )
    again = compute_noise_fates(BLOCK, BaseMotion(RECORD, UP), NOISE, **given)
    assert np.array_equal(stored.fate, again.fate)
    stronger = BaseMotion(RECORD.scaled(2.0), UP)
    with pytest.raises(OutputError, match="holds"):
        compute_noise_fates(
            BLOCK,
            stronger,
            NOISE,
            **given,
            run=Execution(store=Store(tmp_path / "kept.zarr", resume=True)),
        )


def test_shares_are_counts_with_wilsons_interval() -> None:
    found = compute_noise_fates(BARE, PULSE, NOISE, axes={"level": LEVELS}, draws=40)
    share = found.share[0, 1]
    assert 0.0 < share < 1.0
    low, high = found.interval(0.9)
    z = 1.6448536269514722
    middle = (share + z * z / 80.0) / (1.0 + z * z / 40.0)
    half = z / (1.0 + z * z / 40.0) * math.sqrt(share * (1.0 - share) / 40.0 + (z / 80.0) ** 2)
    assert (low[0, 1], high[0, 1]) == pytest.approx((middle - half, middle + half), rel=1e-9)
    rows = found.to_dict()["shares"]
    assert [row["overturned"] for row in rows] == found.overturned[0].tolist()
    data = found.to_dataset()
    assert data.fate.dims == ("scale", "level", "draw")
    assert data.rms.values.tolist() == LEVELS
    assert "Overturning under a one-sine pulse" in repr(found)
    assert "90 % interval" in found.summary()


def test_bad_input_is_refused() -> None:
    for axes in ({}, {"rms": [1.0]}, {"level": [-1.0]}, {"level": [0.1, 0.1]}, [0.1]):
        with pytest.raises(InputError):
            compute_noise_fates(BARE, PULSE, NOISE, axes=axes)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="draws"):
        compute_noise_fates(BARE, PULSE, NOISE, axes={"level": [0.1]}, draws=0)
    with pytest.raises(ModelError, match="sizes"):
        compute_noise_fates(BARE, RECORD, NOISE, axes={"level": [0.1]})
    wall = DimensionlessBlock(restitution=0.5, one_sided=True)
    start = State(angle=-0.1, velocity=0.0)
    with pytest.raises(ModelError, match="wall"):
        compute_noise_fates(wall, PULSE, NOISE, axes={"level": [0.1]}, start=start)


def test_a_level_is_a_factor_of_the_rms_of_the_noise() -> None:
    noise = BandNoise(rms=0.4, band=(0.5, 6.0), duration=8.0, seed=3)
    found = compute_noise_fates(BARE, PULSE, noise, axes={"level": [0.5, 2.0]}, draws=2)
    assert found.rms.tolist() == pytest.approx([0.2, 0.8], rel=1e-15)
    assert [row["rms"] for row in found.to_dict()["shares"]] == found.rms.tolist()
