"""The fate on a still base in closed form: it is what a march over the still base finds."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import Block
from rocksteady.kernels.batch._still_base import (
    fate_on_still_base,
    gained_by_landing,
    over_the_top,
    speed_of_lying,
)
from rocksteady.kernels.core.tables import (
    ALPHA,
    DURATION,
    LEAN,
    NONLINEAR_SEGMENT_COLUMNS,
    OVERTURNED,
    RATE,
    ROW_COLUMNS,
    SEGMENT_COLUMNS,
    March,
)
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.model.equations import Linear, Model, Nonlinear
from tests.every import every
from tests.strategies import sample_size

Floats = NDArray[np.float64]

BLOCKS = {
    "slender": Block.from_p(alpha=0.05, p=2.0, restitution=0.95),
    "stocky": Block.from_p(alpha=0.7, p=2.0, restitution=0.9),
    "lossless": Block.from_p(alpha=0.3, p=2.0, restitution=1.0),
    "leaning": Block.from_alphas(positive=0.15, negative=0.35, p=2.0, restitution=(0.95, 0.9)),
    "leaning back": Block.from_alphas(positive=0.5, negative=0.2, p=2.0, restitution=1.0),
}
MODELS = (Linear(), Nonlinear())


def still(model: Model) -> Floats:
    """The table of a base that stands still for ever."""
    columns = SEGMENT_COLUMNS if isinstance(model, Linear) else NONLINEAR_SEGMENT_COLUMNS
    table = np.zeros((1, columns))
    table[0, DURATION] = math.inf
    return table


@every("model", MODELS)
@every("name", BLOCKS)
def test_it_is_what_a_march_finds(name: str, model: Model) -> None:
    sides = model.sides(BLOCKS[name])
    rng = np.random.default_rng(11)
    fates = set()
    for _ in range(sample_size(400, 12)):
        side, row = (1, 0) if rng.random() < 0.5 else (-1, 1)
        angle = float(rng.uniform(0.0, 1.9))
        velocity = float(rng.normal(0.0, 1.2))
        if angle == 0.0 or math.isclose(abs(velocity), abs(over_the_top(sides, row, angle))):
            continue
        fate = fate_on_still_base(sides, side, angle, velocity)
        lean, rate = sides[row, LEAN], sides[row, RATE]
        start = March(side, side * angle * lean, side * velocity * lean * rate, 0, 0, 0.0, 0, 0)
        rows, peaks = np.zeros((0, ROW_COLUMNS)), np.zeros(0)
        # Without loss a block that stands rocks on for ever.
        code, end = march(
            Tables(still(model), sides), start, Until(0, 200.0, math.inf, 10**5), Kept(rows, peaks)
        )
        assert (fate.margin > 0.0) == (code == OVERTURNED), (side, angle, velocity)
        if code == OVERTURNED:
            assert (fate.side, fate.impacts) == (end.side, end.impacts)
        fates.add((code, fate.impacts))
    assert len(fates) >= sample_size(3, 1)


@pytest.mark.parametrize("row", [0, 1])
def test_energy_is_what_the_formulas_say(row: int) -> None:
    sides = Nonlinear().sides(BLOCKS["leaning"])
    alpha = float(sides[row, ALPHA])

    def potential(angle: float) -> float:
        return (math.cos(alpha * (1.0 - angle)) - 1.0) / alpha**2

    for angle in (0.0, 0.3, 1.0, 1.7):
        # On the separatrix, where v + b = 0, the energy is that of the upright position.
        top = over_the_top(sides, row, angle)
        assert 0.5 * top * top + potential(angle) == pytest.approx(0.0, abs=1e-14)
        gained = 2.0 * (potential(angle) - potential(0.0))
        assert gained_by_landing(sides, row, angle) == pytest.approx(gained, abs=1e-12)
        lying = speed_of_lying(sides, row, angle, 0.8)
        fallen = 0.64 + 2.0 * (potential(angle) - potential(0.5 * math.pi / alpha))
        assert lying == pytest.approx(math.sqrt(max(fallen, 0.0)), rel=1e-12)


def test_a_slender_block_has_the_linear_fate() -> None:
    block = Block.from_p(alpha=1e-4, p=2.0, restitution=0.9)
    tables = [model.sides(block) for model in (Linear(), Nonlinear())]
    for angle, velocity in ((0.4, 0.3), (0.4, -1.2), (1.3, -0.2), (0.0, 0.9)):
        one, other = (fate_on_still_base(sides, 1, angle, velocity) for sides in tables)
        assert one.margin == pytest.approx(other.margin, abs=1e-7)
        assert one[1:] == other[1:]


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS)
def test_the_margin_is_continuous_over_the_state(model: Model) -> None:
    sides = model.sides(BLOCKS["leaning"])
    grid = np.linspace(-2.5, 2.5, 20_001)
    for angle in (0.0, 0.5, 1.2):
        margin = [fate_on_still_base(sides, 1, angle, v).margin for v in grid.tolist()]
        assert np.abs(np.diff(margin)).max() < 0.05  # a root where the block lands at rest
