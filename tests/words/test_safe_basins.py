"""Words of erosion, from small windows."""

import re
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Nonlinear,
    compute_erosion,
)
from rocksteady.basins import Erosion
from rocksteady.dynamics.basins.erosion import MEASURES
from tests.descriptions import as_json, fits
from tests.outputs import lines_of

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)
MOTION = Harmonic(amplitude=0.5, frequency_ratio=2.0)
WINDOW: dict[str, Any] = {
    "angles": [-0.9, -0.3, 0.3, 0.9],
    "velocities": [-0.4, 0.0, 0.4],
}


def erosion_of(block: Block | DimensionlessBlock, **more: Any) -> Erosion:
    return compute_erosion(block, MOTION, [0.0, 0.5, 1.0], **{**WINDOW, "cycles": 20, **more})


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_there_is_a_row_an_amplitude(block: Block | DimensionlessBlock) -> None:
    found = erosion_of(block, model="linear")  # of the other no amplitude is heteroclinic
    values = as_json(found.to_dict())
    assert values["fractions"] is None
    assert [row["amplitude"] for row in values["erosion"]] == [0.0, 0.5, 1.0]
    assert [row["safe_share"] for row in values["erosion"]] == found.safe_share.tolist()
    # There are many amplitudes, and so no one of them is that of the motion.
    assert "amplitude" not in values
    assert "accel_g" not in values
    assert values["drop"].keys() == set(MEASURES)
    assert values["still"] == {"safe_share": found.still_share, "radius": found.still_radius}
    text = found.summary(more=True)
    assert fits(text)
    assert ("accel [g]" in text) == (block is LEANING)
    at = next(k for k, line in enumerate(text.splitlines()) if line.startswith("amplitude A"))
    rows = [line.split() for line in text.splitlines()[at + 1 : at + 4]]
    assert [float(row[0]) for row in rows] == [0.0, 0.5, 1.0]
    assert [float(row[-1]) for row in rows] == pytest.approx(
        [row["global_integrity"] for row in values["erosion"]], abs=5e-5
    )
    if isinstance(block, Block):
        motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
        accel = motion.acceleration_m_s2(block) / block.gravity
        assert values["erosion"][-1]["accel_g"] == pytest.approx(accel)
        tangency = values["heteroclinic_amplitude"]
        assert values["heteroclinic_accel_g"] == pytest.approx(tangency * accel)
    else:
        assert "heteroclinic_accel_g" not in values


def test_the_drops_are_those_of_the_method() -> None:
    window = np.linspace(-1.2, 1.2, 13)
    found = compute_erosion(BARE, MOTION, [0.2, 3.0], angles=window, velocities=window, cycles=20)
    assert "drops" not in vars(found), "a line does not compute basins"
    assert repr(found).startswith("<Erosion: Erosion of the safe basin at phase 0 rad")
    assert "drops" not in vars(found)
    assert found.drops == {measure: found.drop(measure) for measure in MEASURES}
    text = found.summary(more=True)
    for measure, drop in found.drops.items():
        (line,) = (x for x in text.splitlines() if x.startswith(measure.replace("_", " ") + "  "))
        if drop is None:
            assert "does not fall below 0.5 up to A = 3" in line
        else:
            assert f"falls below 0.5 between A = {drop.low:.4f} and {drop.high:.4f}" in line
            assert drop.describe().to_dict()["low"] == drop.low
    assert any(drop is not None for drop in found.drops.values())


def test_the_answer_states_what_is_left_at_the_last_amplitude() -> None:
    window = np.linspace(-1.2, 1.2, 13)
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    given: dict[str, Any] = {"angles": window, "velocities": window, "cycles": 20}
    found = compute_erosion(BARE, motion, [0.3, 0.6, 1.0], **given)
    answer = found.describe()
    words = lines_of(answer)["left at A = 1"]
    assert isinstance(words, str)
    said = re.fullmatch(r"([\d.]+) % of the area, ([\d.]+) % of the radius", words)
    assert said is not None
    left = [100.0 * float(each[-1]) for each in (found.global_integrity, found.integrity_factor)]
    assert [float(each) for each in said.groups()] == pytest.approx(left, abs=0.5)


def test_the_nonlinear_model_has_no_tangency_in_closed_form() -> None:
    found = erosion_of(Block.rectangle(width=0.4, height=1.2), model=Nonlinear())
    values = found.to_dict()
    assert values["model"] == "nonlinear"
    assert values["heteroclinic_amplitude"] is None
    assert values["heteroclinic_accel_g"] is None
    assert "no closed form in the nonlinear model" in found.summary(more=True)
