"""Descriptions of basins and of erosion, from small windows."""

import re
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Nonlinear,
    Rest,
    Status,
    compute_basins,
    compute_erosion,
    simulate,
)
from rocksteady.basins import Basins, Erosion
from rocksteady.dynamics.basins.erosion import MEASURES
from rocksteady.errors import ModelError
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


def erosion_of(block: Block | DimensionlessBlock, **more: Any) -> Erosion:
    return compute_erosion(block, MOTION, [0.0, 0.5, 1.0], **{**WINDOW, "cycles": 20, **more})


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


def test_there_is_a_row_a_state_with_the_name_of_its_attractor() -> None:
    found = basins_of(BARE)
    rows = list(found.to_dataframe().itertuples(index=False, name=None))
    assert len(rows) == 12
    names = {one.label: one.name for one in found.attractors}
    assert all(name == names[label] for _, _, label, name in rows)
    assert {angle for angle, *_ in rows} == set(WINDOW["angles"])


def test_an_attractor_and_a_cell_are_starts() -> None:
    block = DimensionlessBlock(restitution=0.95)
    found = compute_basins(block, MOTION, **WINDOW)
    kinds = set()
    for attractor in found.attractors:
        kinds.add(attractor.kind.value)
        if attractor.orbit is not None:
            period = attractor.orbit.period
            run = simulate(block, found.motion, start=attractor.start, cycles=3 * period)
            back = run([0.0, *(np.arange(1, 3) * period * np.pi)])  # 2 pi/Omega is pi
            np.testing.assert_allclose(back.angle, back.angle[0], atol=1e-8)
            np.testing.assert_allclose(
                run.peak, max(attractor.orbit.highest, -attractor.orbit.lowest), rtol=1e-6
            )
        elif attractor.kind.value == "rest":
            assert attractor.start == Rest()
        else:
            with pytest.raises(ModelError, match="only an orbit and the rest"):
                _ = attractor.start
    assert {"overturned", "symmetric"} <= kinds
    falls = next(one.label for one in found.attractors if one.kind.value == "overturned")
    for row, column in np.ndindex(found.label.shape):
        run = simulate(block, found.motion, start=found.state(row, column), cycles=200)
        assert (run.status is Status.OVERTURNED) == (found.label[row, column] == falls)


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


@every(
    ("frequency", "names"),
    [(4.2, ["symmetric"]), (1.9, ["falls", "unsymmetric a", "unsymmetric b"])],
)
def test_a_letter_distinguishes_mirror_images_alone(frequency: float, names: list[str]) -> None:
    motion, near = Harmonic(amplitude=2.0, frequency_ratio=frequency), [-0.05, 0.0, 0.05]
    answer = compute_basins(BARE, motion, angles=near, velocities=near).describe().answer
    assert answer is not None
    assert [name for name, text in answer.facts if " %" in str(text)] == names


def test_the_answer_states_what_is_left_at_the_last_amplitude() -> None:
    window = np.linspace(-1.2, 1.2, 13)
    motion = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    given: dict[str, Any] = {"angles": window, "velocities": window, "cycles": 20}
    found = compute_erosion(BARE, motion, [0.3, 0.6, 1.0], **given)
    answer = found.describe().answer
    assert answer is not None
    words = dict(answer.facts)["left at A = 1"]
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
