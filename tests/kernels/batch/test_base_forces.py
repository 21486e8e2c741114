"""Forces of many blocks on one record: each is that of a run of its own."""

import numpy as np
import pytest

from rocksteady import BaseMotion, Block, Linear, Nonlinear, Record, Status, simulate
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import mass_centres
from rocksteady.seismic.spectra.batch import GroundShaking, shaken_forces, sides_in_si
from tests.every import every
from tests.records import synthetic
from tests.strategies import sample_size

RECORD, LIFT = (
    Record(acceleration_m_s2=synthetic(np.random.default_rng(seed), 200, 0.02, peak), dt_s=0.05)
    for seed, peak in ((4, 4.0), (5, 2.0))
)


def drawn(rng: np.random.Generator) -> Block:
    """Return a block of one of the kinds that there are."""
    width, height = rng.uniform(0.3, 0.8), rng.uniform(1.0, 2.5)
    gravity = float(rng.choice([9.80665, 3.7]))
    kind = rng.integers(4)
    if kind == 0:
        return Block.rectangle(width=width, height=height, gravity=gravity)
    if kind == 1:
        return Block.rectangle(width=width, height=height, gravity=gravity).against_wall(0.5)
    if kind == 2:
        return Block.asymmetric(left=0.4 * width, right=0.6 * width, height=height, gravity=gravity)
    return Block.frame(columns=3, cap_mass_ratio=0.7, width=width, height=height, gravity=gravity)


@every("model", [Linear(), Nonlinear()])
def test_each_block_has_the_forces_of_its_own_run(model: Model) -> None:
    """Scaled, with vertical motion, none of a fall or without uplift."""
    rng = np.random.default_rng(11)
    count = sample_size(40, 8)
    blocks = [drawn(rng) for _ in range(count)]
    lifted = LIFT if isinstance(model, Nonlinear) else None
    grounds = [GroundShaking(record=RECORD), GroundShaking(record=RECORD, vertical=lifted)]
    ground, scale = rng.integers(0, 2, count), rng.uniform(0.2, 2.0, count)
    found = shaken_forces(
        grounds,
        ground=ground,
        scale=scale,
        sides=np.stack([sides_in_si(block, model) for block in blocks]),
        gravity=np.array([block.gravity for block in blocks]),
        centres=np.stack([mass_centres(block) for block in blocks]),
    )
    seen = set()
    for block, number, factor, forces in zip(blocks, ground, scale, found, strict=True):
        motion = BaseMotion(RECORD, lifted if number else None).scaled(float(factor))
        run = simulate(block, motion, model=model)
        seen.add(run.status)
        if run.status is Status.OVERTURNED or run.forces_per_weight is None:
            assert np.isnan(forces).all()
        else:
            assert forces.tolist() == pytest.approx(run.forces_per_weight, rel=1e-9 * run.growth)
    if count > 20:
        assert {Status.AT_REST, Status.OVERTURNED} <= seen
        assert np.isfinite(found[:, 0]).sum() > 5
