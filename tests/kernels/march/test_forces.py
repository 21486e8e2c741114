"""Forces on the base: the largest ones of a run, and where they are looked for."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady import Block, Linear, Nonlinear, Pulse, Record, simulate
from rocksteady.histories import Trajectory
from rocksteady.kernels.march.forces import FORCES, fill_forces, largest_forces
from rocksteady.model.equations import Model
from rocksteady.model.linear_tables import mass_centres
from tests.every import every
from tests.records import synthetic

Floats = NDArray[np.float64]

BLOCKS = {
    "rectangle": Block.rectangle(width=0.5, height=1.5),
    "unlike sides": Block.asymmetric(left=0.2, right=0.35, height=1.5),
    "wall": Block.rectangle(width=0.5, height=1.5).against_wall(0.6),
    "frame": Block.frame(columns=2, cap_mass_ratio=1.5, width=0.5, height=1.5),
}
GROUND = Record(
    acceleration_m_s2=synthetic(np.random.default_rng(3), 150, 0.02, 5.0), dt_s=0.02, name="ground"
)


def largest(run: Trajectory, rows: Floats | None = None) -> Floats:
    """Return the largest forces of a run that ends at rest."""
    assert isinstance(run.block, Block)
    found = np.zeros(FORCES)
    kept = run._rows if rows is None else rows
    largest_forces(run._tables, kept, 0.0, mass_centres(run.block), found)
    return found


def dense(run: Trajectory, looks: int) -> Floats:
    """Return the largest forces of so many times of each flight, up to overturning."""
    assert isinstance(run.block, Block)
    ends = run.flights.pt + run.flights.duration
    ends = np.minimum(ends, math.inf if run.overturn_time_pt is None else run.overturn_time_pt)
    row = np.flatnonzero((run.flights.side != 0) & (ends > run.flights.pt))
    since = (ends - run.flights.pt)[row, np.newaxis] * np.linspace(0.0, 1.0, looks)
    forces = np.empty((FORCES, since.size))
    index = np.repeat(row, looks)
    fill_forces(run._tables, run._rows, index, since.ravel(), mass_centres(run.block), forces)
    most: Floats = forces.max(axis=1)
    return most


@every("model", [Linear(), Nonlinear()])
@every("name", BLOCKS)
def test_at_no_time_of_a_run_is_a_force_larger(name: str, model: Model) -> None:
    """Under a pulse flights are long, and its base stops in a step; under a record short."""
    block = BLOCKS[name]
    pulse = Pulse.from_si(block, shape="one-cosine", acceleration_m_s2=4.5, frequency_hz=1.5)
    for motion, looks in ((GROUND, 5), (pulse, 40)):
        run = simulate(block, motion, model=model)
        assert run._forces is not None
        found, most = np.array(run._forces), dense(run, looks)
        assert (most <= found * (1.0 + 1e-9)).all()
        np.testing.assert_allclose(found, most, rtol=2e-3)


def test_a_force_within_a_sample_is_found_finely() -> None:
    kink = Record(acceleration_m_s2=np.array([0.0, 6.0, 6.001, 0.0, 0.0]), dt_s=0.015)
    run = simulate(BLOCKS["rectangle"], kink)
    assert run._forces is not None
    np.testing.assert_allclose(np.array(run._forces), dense(run, 201), rtol=1e-6)


def test_without_a_flight_there_is_no_force() -> None:
    run = simulate(BLOCKS["rectangle"], GROUND.scaled(1e-3))
    assert np.isnan(largest(run)).all()
    assert np.isnan(largest(run, run._rows[:0])).all()
    assert run.forces_per_weight is None
