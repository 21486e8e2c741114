"""Maps of a block against a wall: every cell is what one gets at that point alone."""

import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Harmonic,
    Rest,
    State,
    Steady,
    Store,
    find_attractor,
    map_attractors,
    map_fates,
    open_store,
    simulate,
)
from rocksteady.dynamics.batch.attractors import KIND_FLAGS
from rocksteady.dynamics.batch.fates import ENDS
from rocksteady.dynamics.maps._scenario import Scenario
from rocksteady.errors import InputError, ModelError
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.dynamics.maps.drawn import same_as_alone
from tests.every import every

BARE = DimensionlessBlock(restitution=0.5, one_sided=True)
FACADE = Block.rectangle(width=0.3, height=3.0).against_wall()
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=4.0, phase=1.0)
AXES = {
    "amplitude": [0.9, 1.2, 2.0, 3.0],
    "frequency_ratio": [2.0, 4.5, 9.0],
    "restitution": [0.0, 0.3, 0.9, 1.0],
}


def moved(
    block: Block | DimensionlessBlock, cell: dict[str, float]
) -> tuple[Block | DimensionlessBlock, Harmonic]:
    """Return the block and its shaking by their constructors."""
    e = cell.get("restitution", block.restitution)
    if "width" in cell:
        assert isinstance(block, Block)
        block = Block.rectangle(width=cell["width"], height=block.height).against_wall(e)
    elif isinstance(block, Block):
        block = block.against_wall(e)
    else:
        block = DimensionlessBlock(restitution=e, one_sided=True)
    given = {name: cell.get(name, getattr(SHAKING, name)) for name in vars(SHAKING)}
    return block, Harmonic(**given)


@pytest.mark.slow
@every(
    ("block", "model"),
    [(BARE, Linear()), (FACADE, Linear()), (FACADE, Nonlinear())],
)
@every("start", [Rest(), State(angle=0.3, velocity=-0.2)])
def test_every_cell_is_the_fate_and_the_attractor_at_that_point(
    block: Block | DimensionlessBlock, model: Model, start: Rest | State
) -> None:
    fates = map_fates(block, SHAKING, axes=AXES, start=start, cycles=30, model=model)
    kinds = map_attractors(block, SHAKING, axes=AXES, start=start, max_cycles=200, model=model)
    followed = 0
    for values in product(*AXES.values()):
        cell = dict(zip(AXES, values, strict=True))
        body, shaking = moved(block, cell)
        alone = simulate(body, shaking, start=start, cycles=30, model=model)
        settled = find_attractor(body, shaking, start=start, max_cycles=200, model=model)
        if alone.growth < 1e10:
            assert ENDS[int(fates.fate.sel(cell))] is alone.status, cell
        if settled.growth > 1e10:
            continue
        followed += 1
        found = kinds.sel(cell)
        assert KIND_FLAGS[int(found.kind)] == settled.kind.value, cell
        assert int(found.period) == (settled.period or 0)
        orbit = settled.orbit
        impacts = 0 if orbit is None else -1 if orbit.impacts is None else orbit.impacts
        assert int(found.impacts) == impacts
        peaks = (math.nan, math.nan) if settled.peaks is None else settled.peaks
        np.testing.assert_allclose([found.highest, found.lowest], peaks, rtol=0.0, atol=1e-9)
    assert followed > 24
    assert float(kinds.lowest.max()) == 0.0  # of all, whether at rest or on an orbit
    assert {"unsymmetric", "overturned"} <= {KIND_FLAGS[k] for k in kinds.kind.values.ravel()}


def test_sizes_move_and_the_restitution_is_that_of_the_wall_of_each() -> None:
    widths, heights = [0.3, 0.6, 1.2], [2.0, 3.0]
    axes: dict[str, Any] = {"width": widths, "height": heights, "restitution": "housner"}
    ground = {"acceleration_m_s2": 3.0, "frequency_hz": 1.5}
    found = map_attractors(FACADE, axes={**axes, **ground}, max_cycles=200)
    assert found.attrs["restitution"] == "housner"
    assert found.attrs["one_sided"] == 1
    for width, height in product(widths, heights):
        block = Block.rectangle(width=width, height=height).against_wall()
        # Momentum on base, wall and base: (1 - 1.5 sin^2)^2 (1.5 cos^2 - 1).
        alpha = math.atan(width / height)
        ratio = (1.0 - 1.5 * math.sin(alpha) ** 2) ** 2 * (1.5 * math.cos(alpha) ** 2 - 1.0)
        assert block.restitution == pytest.approx(ratio, rel=1e-12)
        motion = Harmonic.from_si(block, acceleration_m_s2=3.0, frequency_hz=1.5)
        cell = found.sel(width=width, height=height)
        same_as_alone(cell, block, motion, start=None, cycles=200)
    given = {**axes, "restitution": ("housner", 0.8), **ground}
    factored = map_attractors(FACADE, axes=given, max_cycles=200)
    block = Block.rectangle(width=0.3, height=2.0).against_wall(("housner", 0.8))
    motion = Harmonic.from_si(block, acceleration_m_s2=3.0, frequency_hz=1.5)
    cell = factored.sel(width=0.3, height=2.0)
    same_as_alone(cell, block, motion, start=None, cycles=200)


@every("model", [Linear(), Nonlinear()])
@every("restitution", [None, 1.0, 0.7])
def test_many_cells_are_to_the_last_bit_the_blocks_of_each(
    model: Model, restitution: float | None
) -> None:
    scenario = Scenario(
        axes=("width", "height"), block=FACADE, motion=SHAKING, housner=restitution, model=model
    )
    rng = np.random.default_rng(2)
    width, height = rng.uniform(0.2, 0.9, 50), rng.uniform(1.5, 4.0, 50)
    cells = scenario.cells({"width": width, "height": height})
    for k in range(50):
        block, _, _ = scenario.at({"width": width[k], "height": height[k]})
        assert block.one_sided
        assert (cells.sides[k] == model.sides(block)).all()


@every("sizes", [{"alpha": [0.1, 0.3]}, {"p": [1.5, 3.0]}, {"radius": [1.0]}])
def test_other_sizes_keep_what_they_keep_of_a_block_with_two_sides(sizes: Any) -> None:
    free = Block.rectangle(width=0.3, height=3.0, restitution=0.5)
    name, values = next(iter(sizes.items()))
    axes = {**sizes, "acceleration_m_s2": 3.0, "frequency_hz": 1.5}
    found = map_attractors(free.against_wall(0.4), axes=axes, max_cycles=200)
    for value in values:
        alpha = value if name == "alpha" else free.alpha
        if name == "p":
            block = Block.from_p(alpha=alpha, p=value)
        else:
            radius = value if name == "radius" else free.radius
            block = Block.from_radius(alpha=alpha, radius=radius)
        body = block.against_wall(0.4)
        motion = Harmonic.from_si(body, acceleration_m_s2=3.0, frequency_hz=1.5)
        same_as_alone(found.sel({name: value}), body, motion, start=None, cycles=200)


def test_a_state_is_an_axis_from_the_wall_on() -> None:
    angles, velocities = [0.05, 0.4, 0.9], [-0.8, 0.0, 0.8]
    axes = {"angle": angles, "velocity": velocities}
    found = map_fates(BARE, SHAKING, axes=axes, cycles=30)
    for u, v in product(angles, velocities):
        run = simulate(BARE, SHAKING, start=State(angle=u, velocity=v), cycles=30)
        assert ENDS[int(found.fate.sel(angle=u, velocity=v))] is run.status
    upright = map_fates(BARE, SHAKING, axes={"velocity": [0.0, 0.5]}, cycles=30)
    assert upright.sizes == {"velocity": 2}


@pytest.mark.slow
@pytest.mark.parametrize("model", [Linear(), Nonlinear()], ids=lambda model: model.name)
def test_executors_workers_and_stores_agree_to_the_bit(model: Model, tmp_path: Path) -> None:
    def mapped(run: Execution | None) -> Any:
        return map_attractors(FACADE, SHAKING, axes=AXES, max_cycles=100, model=model, run=run)

    one = mapped(None)
    assert one.identical(mapped(Execution(executor="serial")))
    assert one.identical(mapped(Execution(executor="threads", workers=2)))

    class EnoughError(Exception):
        pass

    seen = 0

    def stop(cells: int) -> None:
        nonlocal seen
        seen += cells
        if seen > 20:
            raise EnoughError

    path = tmp_path / "map.zarr"
    with pytest.raises(EnoughError):
        mapped(Execution(executor="serial", store=Store(path, chunk=2), progress=stop))
    there = int(open_store(path, partial=True).computed.sum())
    assert 0 < there < one.kind.size
    told: list[int] = []
    found = mapped(Execution(store=Store(path, resume=True), progress=told.append))
    assert told[0] == there
    assert found.load().identical(one)


@every(
    ("axes", "start", "words"),
    [
        ({"angle": [-0.2, 0.5]}, None, "angle -0.2.*positive side alone"),
        ({"angle": [0.0, 0.5], "velocity": [-0.1, 0.1]}, None, "angle 0 and velocity -0.1"),
        ({"velocity": [-0.1, 0.1]}, None, "angle 0 and velocity -0.1"),
        ({"alpha_ratio": [1.0, 1.2]}, None, "positive side alone"),
        ({"negative_restitution": [0.5, 0.6]}, None, "positive side alone"),
        ({"amplitude": [1.0, 2.0]}, Steady(), "find_orbits"),
        ({"amplitude": [1.0, 2.0], "restitution": "housner"}, None, "no slenderness"),
    ],
)
def test_what_does_not_exist_is_refused(axes: Any, start: Any, words: str) -> None:
    for mapped in (map_fates, map_attractors):
        with pytest.raises(ModelError, match=words) as error:
            mapped(BARE, SHAKING, axes=axes, start=start)
        assert "\n" not in str(error.value)


@pytest.mark.parametrize("values", [[-0.1, 0.5], [0.5, 1.1]])
def test_a_wall_keeps_between_nothing_and_all(values: list[float]) -> None:
    with pytest.raises(InputError, match=r"restitution.*\[0, 1\]"):
        map_fates(BARE, SHAKING, axes={"restitution": values})


def test_a_map_says_that_there_is_a_wall() -> None:
    data = map_fates(FACADE, SHAKING, axes={"amplitude": [1.0, 2.0]}, cycles=10)
    text = str(data.rocksteady.summary(more=True))
    assert "against a wall" in text
    assert f"{FACADE.restitution:.4f}"[:5] in text
    assert "negative" not in text
