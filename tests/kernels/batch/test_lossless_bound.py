"""The bound of a block that bounces without end: a march that goes on stays below it."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block
from rocksteady.kernels.batch._lossless_bound import furthest, largest_margin
from rocksteady.kernels.batch._still_base import fate_on_still_base
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tables import (
    LEAN,
    LIFT,
    LIFT_CEILING,
    NONLINEAR_SEGMENT_COLUMNS,
    RATE,
    ROCKING,
    ROW_COLUMNS,
    UNDECIDED,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.every import every
from tests.kernels.tables import Piece, table
from tests.strategies import sample_size

Floats = NDArray[np.float64]

TURN = 2.0 * math.pi
PULSES = {
    "one-sine": (Piece(duration=TURN, amplitude=1.0, frequency=1.0),),
    "one-cosine": (Piece(duration=TURN, amplitude=1.0, frequency=1.0, phase=0.5 * math.pi),),
    "triangles": (
        Piece(duration=1.0, slope=1.0),
        Piece(duration=2.0, constant=1.0, slope=-1.0),
        Piece(duration=1.0, constant=-1.0, slope=1.0),
    ),
    "step down": (
        Piece(duration=0.5, constant=1.0),
        Piece(duration=1.0, constant=0.7),
        Piece(duration=1.0, constant=-0.8, slope=0.3),
    ),
}


def case(name: str, model: Model, amplitude: float, ratio: float) -> tuple[Floats, Floats]:
    """Segments and sides of a lossless block under a pulse of some size and frequency."""
    segments = table(*PULSES[name])
    if isinstance(model, Nonlinear):
        wide = np.zeros((len(segments), NONLINEAR_SEGMENT_COLUMNS))
        wide[:, :8] = segments[:, :8]
        segments = wide
    block = Block.from_p(alpha=0.3, p=2.0, restitution=1.0)
    sides = model.sides(block).copy()
    uplift = 1.0 if isinstance(model, Linear) else math.tan(0.3) / 0.3
    sides[:, LEAN] /= amplitude * uplift
    sides[:, RATE] /= ratio
    return segments, sides


@pytest.mark.slow
@every("model", [Linear(), Nonlinear()])
@every("name", sample_size([*PULSES], ["one-sine", "step down"]))
@every("ratio", [0.4, 1.0, 5.0])
def test_a_march_that_goes_on_stays_below_the_bound(name: str, model: Model, ratio: float) -> None:
    rows, peaks = np.zeros((0, ROW_COLUMNS)), np.zeros(0)
    proved = 0
    for part in np.geomspace(2e-3, 0.2, sample_size(8, 2)).tolist():
        segments, sides = case(name, model, 1.0 + part, ratio)
        half, phase = segment_start(segments, 0)
        start = March(0, 0.0, 0.0, 0, half, phase, 0, 0)
        last, final = march(
            Tables(segments, sides), start, Until(0, 0.0, 0.0, 10**6), Kept(rows, peaks)
        )
        for flights in (20, 60, 200):
            code, end = march(
                Tables(segments, sides), start, Until(0, 0.0, 0.0, flights), Kept(rows, peaks)
            )
            if code != UNDECIDED:
                break
            bound = largest_margin(segments, sides, end)
            if bound == math.inf:
                continue
            assert -1.0 <= bound < 0.0
            proved += 1
            assert last == ROCKING
            row = 0 if final.side > 0 else 1
            unit = sides[row, LEAN] * sides[row, RATE]
            margin = fate_on_still_base(
                sides,
                final.side,
                final.side * final.angle / sides[row, LEAN],
                final.side * final.velocity / unit,
            ).margin
            assert margin <= bound + 1e-12
    assert proved > 0 or name == "step down" or sample_size(0, 1)


def test_a_block_at_rest_may_lift_off() -> None:
    # With no energy at all the bound is that of the pulse alone, and not 0 for ever.
    for amplitude, stands in ((0.9, True), (1.01, True), (6.0, False)):
        segments, sides = case("one-sine", Linear(), amplitude, 1.0)
        bound = largest_margin(segments, sides, March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0))
        assert (bound < 0.0) is stands
        if amplitude > 1.0 and stands:
            assert bound > -1.0 + 1e-6
    assert furthest(0.0, 0.0, -0.5, 1.0, 0.1) >= 0.5 * 0.5 * 0.1**2


def test_nothing_is_proved_in_flight_of_unlike_sides_or_before_a_jump() -> None:
    segments, sides = case("one-sine", Linear(), 0.9, 1.0)
    assert largest_margin(segments, sides, March(1, 0.1, 0.0, 0, 0, 0.1, 0, 0)) == math.inf
    unlike = sides.copy()
    unlike[1, RATE] *= 1.1
    assert largest_margin(segments, unlike, March(0, 0.0, 0.0, 0, 0, 0.1, 0, 0)) == math.inf
    kicked = table(Piece(duration=1.0), Piece(duration=1.0, jump=0.1))
    assert largest_margin(kicked, sides, March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0)) == math.inf


def test_nothing_is_proved_while_the_base_moves_vertically() -> None:
    segments, sides = case("triangles", Nonlinear(), 1.01, 1.0)
    begin = March(0, 0.0, 0.0, 0, 0, 0.0, 0, 0)
    assert largest_margin(segments, sides, begin) < 0.0
    # A base that falls at half of g takes half the weight: such a block does not stand.
    segments[:, LIFT], segments[:, LIFT_CEILING] = -0.5, 0.5
    assert largest_margin(segments, sides, begin) == math.inf
