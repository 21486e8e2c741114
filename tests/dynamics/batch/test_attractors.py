"""Attractors of arrays of motions: each as `find_attractor` finds it alone.

One by one that is so to the last bit; in lanes, those of symmetric blocks, to rounding on the way.
"""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import DimensionlessBlock, Harmonic, find_attractor, simulate
from rocksteady.dynamics.batch.attractors import (
    KIND_FLAGS,
    Attractors,
    batch_size,
    outputs_of_orbits,
    settled_cells,
    starting,
)
from rocksteady.dynamics.batch.initial_states import at_phases
from rocksteady.dynamics.orbits.attractor import KINDS
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.batch.attractors import OUTCOME
from rocksteady.kernels.core.queue import LEFT_OVER
from rocksteady.kernels.core.tuples import States
from rocksteady.kernels.machine_code.device import Form, on_device
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.orbits import find_attractors
from tests.dynamics.batch.cells import Cells, random_cells

CYCLES = 200
COUNT = 60
models = pytest.mark.parametrize("model", [Linear(), Nonlinear()])


def beginnings_of(cells: Cells) -> States:
    return at_phases(cells.angle, cells.velocity, cells.phase)


def settled(cells: Cells) -> Attractors:
    shaken = cells.amplitude, cells.frequency_ratio, cells.sides
    return settled_cells(*shaken, beginnings_of(cells), CYCLES, ())


@models
def test_each_cell_is_the_attractor_of_its_motion_alone(model: Model) -> None:
    cells = random_cells(5, model, COUNT)
    found = settled(cells)
    for at, (block, shaking, start) in enumerate(
        zip(cells.blocks, cells.shakings, cells.starts, strict=True)
    ):
        alone = find_attractor(block, shaking, start=start, max_cycles=CYCLES, model=model)
        assert KINDS[found.kind[at]] == alone.kind
        assert found.after[at] == alone.after
        # Without an orbit, and of one that rests, the motion was followed alone.
        orbit = alone.orbit
        error = 1e-9 if block.symmetric and orbit is not None and not orbit.rest_phases else 0.0
        np.testing.assert_allclose(found.lyapunov[at], alone.lyapunov, rtol=0.0, atol=error)
        if orbit is None:
            assert (found.period[at], found.impacts[at], found.side[at]) == (0, 0, 0)
            extremum = 0.0 if alone.kind == "rest" else math.nan
            np.testing.assert_array_equal([found.highest[at], found.lowest[at]], extremum)
            continue
        assert (found.period[at], found.passages[at]) == (orbit.period, len(orbit.states))
        assert found.rests[at] == orbit.rest_phases
        assert found.impacts[at] == (-1 if orbit.rest_phases else len(orbit.states))
        first = orbit.states[0]
        assert found.side[at] == first.side
        turned = math.remainder(found.phase[at] - first.phase, 2.0 * math.pi)
        assert turned == pytest.approx(0.0, abs=1e-15 + error)
        np.testing.assert_allclose(
            [found.highest[at], found.lowest[at], found.speed[at]],
            [orbit.highest, orbit.lowest, first.speed],
            rtol=0.0,
            atol=error,
        )
    kinds = {KINDS[code].value for code in found.kind}
    assert {"symmetric", "unsymmetric", "rest", "overturned"} <= kinds
    assert {0, 1} <= set((found.rests > 0).tolist())


class Without:
    """A device without room for any cell."""

    def __init__(self) -> None:
        self.ran: list[str] = []

    def run(self, form: Form, arguments: tuple[Any, ...]) -> None:
        self.ran.append(form.queued.__name__)
        arguments[-1].whole[:, OUTCOME] = LEFT_OVER


@models
def test_what_a_device_leaves_over_is_followed_on_the_host(model: Model) -> None:
    cells, device = random_cells(7, model, 20), Without()
    with on_device(device):
        found = settled(cells)
    wanted = settled(cells)
    of = "queued_" if model == Linear() else "queued_nonlinear_"
    assert device.ran == [f"{of}lane_attractors", f"{of}settle_cells"]
    np.testing.assert_array_equal(found.kind, wanted.kind)
    np.testing.assert_array_equal(found.after, wanted.after)
    np.testing.assert_allclose(found.highest, wanted.highest, rtol=1e-9)


@models
def test_mirrored_motions_settle_to_the_mirror_image(model: Model) -> None:
    cells = random_cells(6, model, COUNT)
    one = settled(cells)
    begin = beginnings_of(cells)
    # Half a period later the base moves the other way.
    turned = begin._replace(
        side=-begin.side,
        angle=-begin.angle,
        velocity=-begin.velocity,
        half_cycles=begin.half_cycles + 1,
    )
    sides = np.ascontiguousarray(cells.sides[:, ::-1])
    # Exchanged columns keep their units: the slenderness and p of what was the positive side.
    other = settled_cells(cells.amplitude, cells.frequency_ratio, sides, turned, CYCLES, ())
    for name in ("kind", "period", "passages", "rests", "after", "lyapunov"):
        np.testing.assert_array_equal(getattr(other, name), getattr(one, name), err_msg=name)
    np.testing.assert_array_equal(other.highest, -one.lowest)
    np.testing.assert_array_equal(other.lowest, -one.highest)
    np.testing.assert_array_equal(other.speed, one.speed)


@models
def test_one_block_for_all_cells_is_the_same_block_in_each(model: Model) -> None:
    cells = random_cells(7, model, COUNT)
    sides = cells.sides[1]
    shaken, begin = (cells.amplitude, cells.frequency_ratio), beginnings_of(cells)
    one = settled_cells(*shaken, sides, begin, CYCLES, ())
    each = settled_cells(*shaken, np.tile(sides, (COUNT, 1, 1)), begin, CYCLES, ())
    for output in outputs_of_orbits():
        np.testing.assert_array_equal(getattr(one, output.name), getattr(each, output.name))


def test_what_a_grid_stores_holds_every_number() -> None:
    found = settled(random_cells(5, Linear(), COUNT))
    for output in outputs_of_orbits():
        values = getattr(found, output.name)
        assert values.shape == (COUNT,)
        np.testing.assert_array_equal(values.astype(output.dtype), values)
    assert "infinitely many" in next(
        output.long_name for output in outputs_of_orbits() if output.name == "impacts"
    )


def test_a_motion_leans_to_its_angle_or_goes_where_its_velocity_does() -> None:
    angle = np.array([0.2, -0.2, 0.0, 0.0, 0.0, -0.0])
    velocity = np.array([-1.0, 1.0, 0.3, -0.3, 0.0, -0.0])
    begin = starting(angle, velocity, 3, 0.5)
    assert begin.side.tolist() == [1, -1, 1, -1, 0, 0]
    assert begin.half_cycles.tolist() == [3] * 6
    assert begin.phase.tolist() == [0.5] * 6


def test_the_codes_of_the_kinds_are_kept_for_ever() -> None:
    # Stored maps hold them.
    assert KIND_FLAGS == {
        0: "symmetric",
        1: "unsymmetric",
        2: "rest",
        3: "overturned",
        4: "aperiodic",
        5: "undecided",
        -1: "no-start",
    }


def test_the_longer_motions_are_followed_the_fewer_make_a_piece() -> None:
    assert [batch_size(cycles) for cycles in (1, 500, 2000, 20_000, 1_000_000)] == [
        4096,
        4096,
        2048,
        204,
        4,
    ]


def test_a_start_is_that_of_a_motion_with_an_orbit_and_no_other() -> None:
    found = find_attractors([2.0, 0.5, 2.5], 4.0, 0.8)
    assert found.labels.tolist() == ["symmetric", "rest", "symmetric"]
    for index in (0, 2):  # the last one too
        start = found.start(index)
        assert (start.side, start.phase, start.speed) == (
            found.side[index],
            found.phase[index],
            found.speed[index],
        )
        run = simulate(
            DimensionlessBlock(restitution=0.8),
            Harmonic(amplitude=[2.0, 0.5, 2.5][index], frequency_ratio=4.0),
            start=start,
            cycles=1,
        )
        again = np.abs(run.impacts.velocity_after)
        assert np.any(np.isclose(again, start.speed, rtol=1e-9)), "the orbit is closed"
    with pytest.raises(ModelError, match="that motion has no orbit: it is rest; choose one whose"):
        found.start(1)
    for index in (3, -1):
        with pytest.raises(InputError, match="index"):
            found.start(index)
    with pytest.raises(ModelError, match="that motion has no orbit; choose one"):
        find_attractors([], [], []).start(0)
