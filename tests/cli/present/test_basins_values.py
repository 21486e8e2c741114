"""Values of basins and erosion, from small windows."""

from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Basins,
    Block,
    DimensionlessBlock,
    Erosion,
    Harmonic,
    compute_basins,
    compute_erosion,
)
from rocksteady.cli.present.basins_values import (
    basins_values,
    erosion_values,
    state_rows,
    undecided,
)
from rocksteady.dynamics.basins.erosion import MEASURES
from rocksteady.model.equations import Nonlinear
from tests.cli.present.printed import as_json

LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)
SHAKING = Harmonic(amplitude=0.5, frequency_ratio=2.0)
WINDOW: dict[str, Any] = {
    "angles": [-0.9, -0.3, 0.3, 0.9],
    "velocities": [-0.4, 0.0, 0.4],
    "cycles": 200,
}


def basins_of(block: Block | DimensionlessBlock, **more: Any) -> Basins:
    return compute_basins(block, SHAKING, **{**WINDOW, **more})


def erosion_of(block: Block | DimensionlessBlock, **more: Any) -> Erosion:
    return compute_erosion(block, 2.0, [0.0, 0.5, 1.0], **{**WINDOW, "cycles": 20, **more})


def values_of(found: Erosion, block: Block | DimensionlessBlock) -> dict[str, Any]:
    return as_json(erosion_values(found, {one: found.drop(one) for one in MEASURES}, block))


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_the_fractions_count_every_state_once(block: Block | DimensionlessBlock) -> None:
    found = basins_of(block)
    values = as_json(basins_values(found, block))
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


def test_only_drawn_states_have_a_confidence() -> None:
    values = basins_values(basins_of(BARE, seed=3), BARE)
    assert (values["confidence"], values["seed"]) == (0.95, 3)


def test_the_share_of_undecided_states_is_zero_where_there_are_none() -> None:
    settled = basins_values(basins_of(BARE), BARE)
    assert undecided(settled) == 0.0
    lossless = DimensionlessBlock(restitution=1.0)
    weak = Harmonic(amplitude=0.1, frequency_ratio=2.0)
    found = compute_basins(lossless, weak, **{**WINDOW, "angles": [-0.9, 0.1]})
    values = basins_values(found, lossless)
    left = {one.label for one in found.attractors if one.kind.value == "undecided"}
    assert undecided(values) == np.isin(found.label, list(left)).mean()
    assert 0.0 < undecided(values) < 1.0


def test_there_is_a_row_a_state_with_the_name_of_its_attractor() -> None:
    found = basins_of(BARE)
    rows = list(state_rows(found))
    assert len(rows) == 12
    names = {one.label: one.name for one in found.attractors}
    assert all(name == names[int(label)] for _, _, label, name in rows)  # type: ignore[call-overload]
    assert {angle for angle, *_ in rows} == set(WINDOW["angles"])


@pytest.mark.parametrize("block", [BARE, LEANING])
def test_there_is_a_row_an_amplitude(block: Block | DimensionlessBlock) -> None:
    found = erosion_of(block)
    values = values_of(found, block)
    assert values["fractions"] is None
    assert [row["amplitude"] for row in values["erosion"]] == [0.0, 0.5, 1.0]
    assert [row["safe_share"] for row in values["erosion"]] == found.safe_share.tolist()
    # There are many amplitudes, and so no one of them is that of the shaking.
    assert "amplitude" not in values
    assert "accel_g" not in values
    assert values["drop"].keys() == set(MEASURES)
    assert values["still"] == {"safe_share": found.still_share, "radius": found.still_radius}
    if isinstance(block, Block):
        shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
        accel = shaking.acceleration_m_s2(block) / block.gravity
        assert values["erosion"][-1]["accel_g"] == pytest.approx(accel)
        tangency = values["heteroclinic_amplitude"]
        assert values["heteroclinic_accel_g"] == pytest.approx(tangency * accel)
    else:
        assert "heteroclinic_accel_g" not in values


def test_the_nonlinear_model_has_no_tangency_in_closed_form() -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    values = values_of(erosion_of(block, model=Nonlinear()), block)
    assert values["model"] == "nonlinear"
    assert values["heteroclinic_amplitude"] is None
    assert values["heteroclinic_accel_g"] is None
