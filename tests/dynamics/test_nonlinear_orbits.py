"""What motions of the nonlinear model settle to, one by one and over grids."""

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    ModelError,
    State,
    Status,
    Steady,
    attractor,
    attractor_map,
    fate_map,
    simulate,
)
from rocksteady.dynamics.return_map import ReturnMap


def test_an_attractor_is_where_a_long_run_ends() -> None:
    block = Block.from_p(alpha=0.3, p=1.0, restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    found = attractor(block, shaking, model="nonlinear")
    assert found.orbit is not None
    assert (found.orbit.model, found.orbit.symmetric, found.orbit.impacts) == ("nonlinear", True, 2)
    assert found.orbit.residual < 1e-12
    run = simulate(block, shaking, cycles=100, model="nonlinear")
    last = np.abs(run(np.linspace(run.end_s - 1.6, run.end_s, 20_001)).angle).max()
    assert found.orbit.highest == pytest.approx(last, abs=1e-8)
    assert np.prod(found.orbit.multipliers).real == pytest.approx(0.8**4, rel=1e-12)
    drawn = found.orbit.trajectory()
    assert drawn.model == "nonlinear"
    assert drawn.peak == pytest.approx(found.orbit.highest, rel=1e-13)


def test_slender_blocks_settle_as_in_the_linear_model() -> None:
    block = Block.from_p(alpha=1e-6, p=1.0, restitution=0.8)
    for ratio, side in ((1.9, -1), (4.0, 1)):
        shaking = Harmonic(amplitude=2.0, frequency_ratio=ratio)
        full = attractor(block, shaking, start=Steady(), side=side, model="nonlinear")
        plain = attractor(block, shaking, start=Steady(), side=side)
        assert full.kind is plain.kind
        assert full.peaks == pytest.approx(plain.peaks, rel=1e-9)


def test_cells_of_maps_are_single_answers() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    start = State(angle=0.0, velocity=0.3)
    axes = {"alpha": [0.1, 0.3, 0.6], "amplitude": [0.8, 2.0, 5.0]}
    block = Block.from_radius(alpha=0.2, radius=1.0, restitution=0.8)
    settled = attractor_map(block, shaking, axes=axes, start=start, model="nonlinear")
    fates = fate_map(block, shaking, axes=axes, start=start, cycles=30, model="nonlinear")
    assert settled.attrs["model"] == "nonlinear"
    for i, alpha in enumerate(axes["alpha"]):
        for j, amplitude in enumerate(axes["amplitude"]):
            body = Block.from_radius(alpha=alpha, radius=1.0, restitution=0.8)
            base = Harmonic(amplitude=amplitude, frequency_ratio=3.0)
            single = attractor(body, base, start=start, model="nonlinear")
            meanings = settled.kind.attrs["flag_meanings"].split()
            assert meanings[int(settled.kind[i, j])] == single.kind.value
            if single.orbit is not None:
                assert float(settled.highest[i, j]) == single.orbit.highest
            run = simulate(body, base, start=start, cycles=30, model="nonlinear")
            assert Status(int(fates.fate[i, j])) is run.status


def test_a_block_without_slenderness_is_refused() -> None:
    bare = DimensionlessBlock(restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    with pytest.raises(ModelError, match="slenderness"):
        ReturnMap(bare, shaking, model="nonlinear")
    with pytest.raises(ModelError, match="slenderness"):
        attractor(bare, shaking, model="nonlinear")
    with pytest.raises(ModelError, match="slenderness"):
        fate_map(bare, shaking, axes={"amplitude": [1.0, 2.0]}, model="nonlinear")
