"""Words of basins, from small windows."""

from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    compute_basins,
)
from rocksteady.basins import Basins
from tests.descriptions import as_json, fits
from tests.every import every

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)
MOTION = Harmonic(amplitude=0.5, frequency_ratio=2.0)
WINDOW: dict[str, Any] = {
    "angles": [-0.9, -0.3, 0.3, 0.9],
    "velocities": [-0.4, 0.0, 0.4],
}


def basins_of(block: Block | DimensionlessBlock, **more: Any) -> Basins:
    return compute_basins(block, MOTION, **{**WINDOW, "max_cycles": 200, **more})


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_the_fractions_count_every_state_once(block: Block | DimensionlessBlock) -> None:
    found = basins_of(block)
    values = as_json(found.to_dict())
    labels = found.label.ravel().tolist()
    for fraction in values["fractions"]:
        assert fraction["states"] == labels.count(fraction["label"])
        assert fraction["share"] == pytest.approx(fraction["states"] / 12)
        assert fraction["low"] <= fraction["share"] <= fraction["high"]
        assert (fraction["orbit"] is None) == (fraction["period"] is None)
    assert sum(fraction["states"] for fraction in values["fractions"]) == 12
    assert values["angles"] == {"start": -0.9, "stop": 0.9, "count": 4}
    assert values["velocities"] == {"start": -0.4, "stop": 0.4, "count": 3}
    assert (values["confidence"], values["seed"], values["erosion"]) == (None, None, None)
    assert ("block" in values) == ("negative_restitution" in values) == (block is LEANING)


@every("block", [BARE, LEANING])
@every("seed", [None, 3])
def test_the_summary_has_a_row_a_basin(block: Block | DimensionlessBlock, seed: int | None) -> None:
    found = basins_of(block, seed=seed)
    text = found.summary(more=True)
    assert fits(text)
    assert "12 of u from" in text
    assert "linear" in repr(found)
    assert ("°" in text) == (block is LEANING)
    for fraction in found.to_dict()["fractions"]:
        (row,) = (line for line in text.splitlines() if line.startswith(f"{fraction['name']} "))
        assert f"{100.0 * fraction['share']:.2f} %" in row
        interval = f"{100.0 * fraction['low']:.2f} to {100.0 * fraction['high']:.2f} %"
        assert (interval in row) == (seed is not None)


def test_only_drawn_states_have_a_confidence() -> None:
    values = basins_of(BARE, seed=3).to_dict()
    assert (values["confidence"], values["seed"]) == (0.9, 3)


def test_the_share_of_undecided_states_is_zero_where_there_are_none() -> None:
    assert basins_of(BARE).undecided == 0.0
    lossless = DimensionlessBlock(restitution=1.0)
    weak = Harmonic(amplitude=0.1, frequency_ratio=2.0)
    found = compute_basins(lossless, weak, **{**WINDOW, "angles": [-0.9, 0.1]}, max_cycles=200)
    left = {one.label for one in found.attractors if one.kind.value == "undecided"}
    assert found.undecided == np.isin(found.label, list(left)).mean()
    assert 0.0 < found.undecided < 1.0
    assert "Without loss (restitution 1) motions do not settle." in found.summary(more=True)
    assert "undecided" not in basins_of(BARE).summary(more=True)


def test_what_does_not_settle_is_explained() -> None:
    chaos = Harmonic(amplitude=6.0, frequency_ratio=6.0)
    block = DimensionlessBlock(restitution=0.25)
    text = compute_basins(block, chaos, **WINDOW, max_cycles=400).summary(more=True)
    assert fits(text)
    assert "not settled within 400 periods" in text.replace("\n", " ")


@every(
    ("frequency", "names"),
    [(4.2, ["rocks"]), (1.9, ["falls", "rocks a", "rocks b"])],
)
def test_a_letter_distinguishes_mirror_images_alone(frequency: float, names: list[str]) -> None:
    motion, near = Harmonic(amplitude=2.0, frequency_ratio=frequency), [-0.05, 0.0, 0.05]
    answer = compute_basins(BARE, motion, angles=near, velocities=near).describe()
    assert [name for name, text in answer.screen if " %" in str(text)] == names
