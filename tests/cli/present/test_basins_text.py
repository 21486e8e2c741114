"""Tables of basins and erosion on a terminal."""

from typing import Any

import pytest
from rocksteady.cli.present.basins_text import case_of, print_erosion, print_fractions
from rocksteady.cli.present.basins_values import basins_values, erosion_values

from rocksteady import Block, DimensionlessBlock, Harmonic, compute_basins, compute_erosion
from rocksteady.dynamics.basins.erosion import MEASURES
from rocksteady.model.equations import Nonlinear
from tests.cli.present.printed import fits, printed

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)
WINDOW: dict[str, Any] = {"angles": [-0.9, -0.3, 0.3, 0.9], "velocities": [-0.4, 0.0, 0.4]}


def fractions_of(block: Block | DimensionlessBlock, **more: Any) -> dict[str, Any]:
    shaking = Harmonic(amplitude=0.5, frequency_ratio=2.0)
    return basins_values(compute_basins(block, shaking, **WINDOW, max_cycles=200, **more), block)


def erosion_of(block: Block | DimensionlessBlock, **more: Any) -> dict[str, Any]:
    found = compute_erosion(block, 2.0, [0.0, 0.5, 3.0], **WINDOW, cycles=20, **more)
    return erosion_values(found, {one: found.drop(one) for one in MEASURES}, block)


@pytest.mark.parametrize("block", [BARE, LEANING])
@pytest.mark.parametrize("seed", [None, 3])
def test_there_is_a_row_a_basin(block: Block | DimensionlessBlock, seed: int | None) -> None:
    values = fractions_of(block, seed=seed)
    text = printed(print_fractions, values)
    assert fits(text)
    assert text.count("12 states at phase 0 rad") == 1
    for fraction in values["fractions"]:
        (row,) = (line for line in text.splitlines() if line.startswith(f"{fraction['name']} "))
        assert f"{100.0 * fraction['share']:.2f} %" in row
        interval = f"{100.0 * fraction['low']:.2f} to {100.0 * fraction['high']:.2f} %"
        assert (interval in row) == (seed is not None)


def test_what_does_not_settle_is_explained() -> None:
    values = fractions_of(DimensionlessBlock(restitution=1.0))
    values["fractions"][0] |= {"kind": "undecided", "share": 0.25}
    lossless = printed(print_fractions, values)
    assert "Without loss (restitution 1) motions do not settle." in lossless
    values = fractions_of(BARE)
    assert "undecided" not in printed(print_fractions, values)
    values["fractions"][0] |= {"kind": "undecided", "share": 0.25}
    values["fractions"][1] |= {"kind": "aperiodic"}
    text = printed(print_fractions, values)
    assert fits(text)
    assert "take more --cycles to follow" in text
    assert "not settled within 200 periods" in text


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_there_is_a_row_an_amplitude(block: Block | DimensionlessBlock) -> None:
    values = erosion_of(block)
    text = printed(print_erosion, values)
    assert fits(text)
    assert ("accel [g]" in text) == (block is LEANING)
    assert f"tangency at A = {values['heteroclinic_amplitude']:.6g}" in text
    rows = [line.split() for line in text.splitlines()[3:6]]
    assert [float(row[0]) for row in rows] == [0.0, 0.5, 3.0]
    assert [float(row[-1]) for row in rows] == pytest.approx(
        [row["global_integrity"] for row in values["erosion"]], abs=5e-5
    )


def test_a_drop_is_told_or_denied() -> None:
    values = erosion_of(BARE)
    drop = {"level": 0.5, "low": 0.5, "high": 3.0, "above": 0.9, "below": 0.1}
    values["drop"] = {"integrity_factor": drop, "global_integrity": None}
    text = printed(print_erosion, values)
    assert "integrity factor falls below 0.5 between A = 0.5000 and 3.0000" in text
    assert "global integrity does not fall below 0.5" in text


def test_the_nonlinear_model_has_no_tangency() -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    text = printed(print_erosion, erosion_of(block, model=Nonlinear()))
    assert fits(text)
    assert "no closed form in the nonlinear model" in text


def test_a_case_of_many_amplitudes_names_none() -> None:
    assert case_of({"frequency_ratio": 2.0, "restitution": 0.8}) == "Ω = 2, restitution 0.8"
