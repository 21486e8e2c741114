"""Small calls of the kernels that devices run, and a device in memory that runs them in turn."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.kernels.batch.attractors import REAL_COLUMNS, WHOLE_COLUMNS, settle_cells
from rocksteady.kernels.batch.records import record_fates
from rocksteady.kernels.core.queue import queue_of
from rocksteady.kernels.core.tables import (
    ALPHA,
    LEAN,
    LEFT_OUT,
    NONLINEAR_SIDE_COLUMNS,
    RATE,
    RESTITUTION,
    SIDE_COLUMNS,
)
from rocksteady.kernels.core.tuples import (
    Blocks,
    Cells,
    Fates,
    Outcomes,
    PeakFates,
    Starts,
    States,
    SymmetricCells,
)
from rocksteady.kernels.devices import FORMS
from rocksteady.kernels.lanes.driver import lane_fates
from rocksteady.kernels.lanes.settling import lane_attractors
from rocksteady.kernels.machine_code.device import Form, cells_in
from rocksteady.kernels.machine_code.width import side_by_side
from rocksteady.kernels.nonlinear_lanes.loop import nonlinear_lane_fates
from rocksteady.kernels.nonlinear_lanes.settling import nonlinear_lane_attractors
from tests.kernels.tables import sampled
from tests.records import synthetic

MOST = 10_000
CYCLES = 4
CELLS = 7
FORCED = (
    np.array([0.8, 1.05, 2.0, 2.5, 3.0, 6.0, 1.5]),
    np.array([2.0, 2.0, 4.0, 3.0, 6.0, 2.0, 0.7]),
)
START = (
    np.array([0.0, 0.0, 0.0, 0.3, -0.2, 0.0, 0.0]),
    np.array([0.0, 0.0, 0.3, 0.1, 0.0, -0.3, 0.0]),
    np.array([0.0, 0.5, 1.0, -2.0, 4.0, 0.1, 3.0]),
)


def sides(*, nonlinear: bool) -> NDArray[np.float64]:
    blocks = np.ones((CELLS, 2, NONLINEAR_SIDE_COLUMNS if nonlinear else SIDE_COLUMNS))
    blocks[:, :, RESTITUTION] = np.linspace(0.6, 0.9, CELLS)[:, np.newaxis]
    blocks[3, 1, LEAN] = 1.2
    if nonlinear:
        blocks[:, :, ALPHA] = 0.3
        blocks[3, 1, ALPHA] = 0.36
        blocks[:, :, LEFT_OUT] = 1e-12
    return blocks


def ends() -> Fates:
    return Fates(np.zeros(CELLS, np.int64), np.zeros(CELLS, np.int64), np.zeros((CELLS, 3)))


def of_lanes(*, nonlinear: bool) -> tuple[Any, ...]:
    return Cells(*FORCED, sides(nonlinear=nonlinear)), Starts(*START), CYCLES, True, MOST, ends()


def settling(cells: Cells | SymmetricCells, cycles: int) -> tuple[Any, ...]:
    angle, velocity, phase = START
    half = np.floor(phase / np.pi).astype(np.int64)
    side = np.sign(np.where(angle != 0.0, angle, velocity)).astype(np.int64)
    states = States(side, angle, velocity, half, phase - half * np.pi)
    whole = np.zeros((CELLS, WHOLE_COLUMNS), np.int64)
    return cells, states, cycles, Outcomes(whole, np.zeros((CELLS, REAL_COLUMNS)))


def of_settle(*, nonlinear: bool) -> tuple[Any, ...]:
    return settling(Cells(*FORCED, sides(nonlinear=nonlinear)), 8 if nonlinear else 40)


def of_lane_attractors() -> tuple[Any, ...]:
    return settling(SymmetricCells(*FORCED, np.linspace(0.6, 0.9, CELLS)), 40)


def of_nonlinear_lane_attractors() -> tuple[Any, ...]:
    return settling(Cells(*FORCED, sides(nonlinear=True)), 8)


def of_records(*, nonlinear: bool) -> tuple[Any, ...]:
    blocks = sides(nonlinear=nonlinear)
    blocks[:, :, LEAN] *= np.array([3.5, 20.0, 1.5, 1.0, 2.5, 3.0, 4.0])[:, np.newaxis]
    blocks[:, :, RATE] = 4.0
    # This one passes its slenderness so slowly that it might come back within a sample.
    blocks[3, :, RESTITUTION] = (0.75, 0.94) if nonlinear else (0.95, 0.68)
    blocks[3, :, LEAN] = (1.61, 1.24) if nonlinear else (1.88, 1.97)
    blocks[3, :, RATE] = 4.2 if nonlinear else 5.9
    if nonlinear:
        blocks[3, :, ALPHA] = blocks[3, :, LEAN] / 9.81
    table = sampled(synthetic(np.random.default_rng(9), 150, 0.02, 6.0), 0.02)
    if nonlinear:
        table = np.hstack([table, np.zeros((len(table), 3))])
    status, impacts = np.zeros((2, CELLS), np.int64)
    fates = PeakFates(status, impacts, np.zeros((CELLS, 2)))
    return table, Blocks(blocks, np.full(CELLS, 20.0)), MOST, fates


CASES: dict[str, tuple[Any, Callable[[], tuple[Any, ...]]]] = {
    "lane_fates": (lane_fates, lambda: of_lanes(nonlinear=False)),
    "nonlinear_lane_fates": (nonlinear_lane_fates, lambda: of_lanes(nonlinear=True)),
    "lane_attractors": (lane_attractors, of_lane_attractors),
    "nonlinear_lane_attractors": (nonlinear_lane_attractors, of_nonlinear_lane_attractors),
    "settle_cells": (settle_cells, lambda: of_settle(nonlinear=False)),
    "nonlinear_settle_cells": (settle_cells, lambda: of_settle(nonlinear=True)),
    "record_fates": (record_fates, lambda: of_records(nonlinear=False)),
    "nonlinear_record_fates": (record_fates, lambda: of_records(nonlinear=True)),
}
"""By the name of a form: its host kernel, and what makes the arguments of a call."""


class Workers:
    """A device in memory: so many workers, one after the other, each with a part of the cells.

    Parameters
    ----------
    workers
        How many; a queue that threads share is another thing, and takes atomic additions.
    """

    def __init__(self, workers: int = 1) -> None:
        self.workers = workers
        self.ran: list[str] = []

    def run(self, form: Form, arguments: tuple[Any, ...]) -> None:
        """Run a form over cells, in descending order of their expected length."""
        (name,) = (name for name, each in FORMS.items() if each.queued is form.queued)
        self.ran.append(name)
        cells = cells_in(arguments)
        length = np.zeros(cells) if form.length is None else form.length(*arguments)
        order = np.argsort(-length, kind="stable")
        shared = () if form.shared is None else form.shared(*arguments)
        for worker in range(self.workers):
            part = order[worker :: self.workers]
            queue = queue_of(len(part))
            queue[2:] = part
            form.queued(queue, *room_of(form), *shared, *arguments)
            assert queue[0] >= len(part)


def room_of(form: Form) -> tuple[NDArray[np.float64], ...]:
    """Return the room of one worker, which on the host follows many cells side by side."""
    shapes = form.room
    lanes = {"lane_attractors": 48, "nonlinear_lane_attractors": 32}
    for name, most in lanes.items():
        if form is FORMS[name]:
            shapes = ((side_by_side(most), *shapes[0][1:]), *shapes[1:])
    return tuple(np.full((1, *shape), np.nan) for shape in shapes)


def bits(arguments: tuple[Any, ...]) -> list[bytes]:
    """Return the results of a call, as bytes."""
    return [np.asarray(array).tobytes() for array in arguments[-1]]
