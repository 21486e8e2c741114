"""Components from fragilities: units of the block, gates, states that have no lognormal."""

import dataclasses
import importlib
import math
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
import xarray

from rocksteady import (
    Block,
    DamageState,
    Fitting,
    Fragility,
    InputError,
    Intensity,
    LossComponent,
    LossState,
    Record,
    RestitutionBand,
    StateFragility,
    Stripes,
    compute_fragility,
    fit_curve,
    fit_two_stages,
    write_openquake,
    write_pelicun,
)
from rocksteady.show.export.components import state_name

load_tabular = importlib.import_module("dlml._tabular").load_tabular
ALPHA, P = 0.27, 2.1
LEVELS = np.array([0.1, 0.2, 0.4, 0.8, 1.6])
LIFTED = np.array([0, 0, 40, 40, 40])
FELL = np.array([0, 0, 9, 27, 39])


def fragility(
    name: str = "pga_g",
    *,
    period: float | None = None,
    vertical: str = "without",
    blocks: int = 1,
    fell: Any = FELL,
    family: Any = "lognormal",
) -> Fragility:
    measure = Intensity(name, period)
    labels = (measure.label, measure.unit)
    fall = fit_two_stages(LEVELS, LIFTED, fell, [40] * 5, family=family, measure=labels)
    lift = fit_curve(LEVELS, LIFTED, [40] * 5, family=family, measure=labels)
    return Fragility(
        ensemble=xarray.Dataset(
            coords={
                "block": range(1, blocks + 1),
                "alpha": ("block", [ALPHA] * blocks),
                "p": ("block", [P] * blocks),
                "vertical": [vertical],
            }
        ),
        measure=measure,
        states=(
            StateFragility(state=DamageState("uplift"), plain=lift),
            StateFragility(state=DamageState("overturned"), plain=fall.plain, two_stage=fall),
        ),
        ranking=(),
        fitting=Fitting(bands=None),
        warnings=(),
        records=20,
        runs=200,
        scale_factor_max=1.0,
        seconds=0.0,
    )


@pytest.mark.parametrize(
    ("name", "measure", "factor"),
    [
        ("pga_g", "pga_g", 1.0),
        ("pgv_m_s", "pgv_m_s", 1.0),
        ("pga_per_uplift", "pga_g", math.tan(ALPHA)),
        ("p_pgv_per_uplift", "pgv_m_s", 9.80665 * math.tan(ALPHA) / P),
    ],
)
def test_ratios_become_accelerations_and_velocities_of_the_block(
    name: str, measure: str, factor: float
) -> None:
    found = fragility(name)
    made = LossComponent.from_fragility(found, "RS.vase")
    assert made.measure == measure
    (state,) = made.states
    plain = found.state("overturned").plain
    assert state.name == "overturned"
    assert state.median == pytest.approx(factor * plain.median, rel=1e-14)
    assert state.beta == plain.beta
    at = np.array([0.15, 0.3, 0.9])
    np.testing.assert_allclose(
        state.probability(factor * at), found.state("overturned").curve.probability(at), rtol=1e-12
    )


def test_the_gate_is_the_uplift_limit_without_vertical_motion_alone() -> None:
    assert LossComponent.from_fragility(fragility(), "A").no_damage == math.tan(ALPHA)
    assert LossComponent.from_fragility(fragility(vertical="with"), "A").no_damage is None
    assert LossComponent.from_fragility(fragility("pgv_m_s"), "A").no_damage is None


def test_a_state_without_a_lognormal_is_left_out_with_its_reason() -> None:
    made = LossComponent.from_fragility(fragility(), "A")
    (sentence,) = made.left_out
    assert sentence.startswith("uplift is left out. There is no lognormal of all runs")
    assert "separated" in sentence
    assert sentence in made.notes
    kept = LossComponent.from_fragility(fragility(), "A", steps=True)
    assert [state.name for state in kept.states] == ["uplift", "overturned"]
    assert kept.states[0].median is None
    assert kept.states[0].probability([0.2, 0.4]).tolist() == [0.0, 1.0]


def test_what_never_happens_has_no_curve_in_any_file() -> None:
    never = fragility(fell=np.zeros(5, dtype=int))
    with pytest.raises(InputError, match="fragility has no curve to write"):
        LossComponent.from_fragility(never, "A")
    kept = LossComponent.from_fragility(never, "A", steps=True)
    assert [state.name for state in kept.states] == ["uplift"]
    assert any("status never" in sentence for sentence in kept.left_out)


def test_a_logistic_curve_is_no_lognormal() -> None:
    made = LossComponent.from_fragility(fragility(family="logistic"), "A", steps=True)
    assert made.states[1].median is None
    assert "family logistic" in made.states[1].note


def test_the_lognormal_given_uplift_is_named() -> None:
    found = fragility()
    made = LossComponent.from_fragility(found, "A", given_uplift=True)
    stages = found.state("overturned").two_stage
    assert stages is not None
    assert made.states[0].median == stages.given_uplift.median
    assert "of the runs that lift, given uplift" in made.states[0].note
    plain = LossComponent.from_fragility(found, "A").states[0].note
    assert f"largest distance from the stripes {found.states[1].plain.misfit:.3f}" in plain
    assert f"of the curve in two stages {stages.misfit:.3f}." in plain


def test_a_lognormal_of_the_excess_over_the_gate_is_not_written_as_one_of_pga() -> None:
    found = fragility()
    gate, labels = math.tan(ALPHA), ("PGA", "g")
    fell = np.array([0, 0, 3, 33, 39])
    stages = fit_two_stages(LEVELS, gate, fell, [40] * 5, measure=labels)
    assert stages.offset == gate
    state = StateFragility(state=DamageState("overturned"), plain=stages.plain, two_stage=stages)
    gated = dataclasses.replace(found, states=(state,))
    (made,) = LossComponent.from_fragility(gated, "A", given_uplift=True).states
    assert (made.median, made.beta) == (stages.plain.median, stages.plain.beta)
    assert "given uplift the lognormal is in PGA - 0.277 g, which loss tools do not" in made.note
    np.testing.assert_array_equal(made.probability(LEVELS), stages.probability(LEVELS))


def test_a_period_is_that_of_the_measure_or_of_the_block() -> None:
    assert LossComponent.from_fragility(fragility("sa_g", period=0.5), "A").period_s == 0.5
    own = LossComponent.from_fragility(fragility("sa_g"), "A").period_s
    assert own == pytest.approx(2.0 * math.pi / P)


def test_what_loss_tools_have_no_name_for_and_several_blocks_are_refused() -> None:
    with pytest.raises(InputError, match="loss tools accept PGA, PGV"):
        LossComponent.from_fragility(fragility("sa_avg_g"), "A")
    with pytest.raises(InputError, match="fragility is of 2 blocks"):
        LossComponent.from_fragility(fragility(blocks=2), "A")


@cache
def real() -> Fragility:
    rng = np.random.default_rng(4)
    suite = [
        Record(
            acceleration_m_s2=np.convolve(rng.normal(size=400), np.ones(9), "same")
            * np.hanning(400),
            dt_s=0.02,
            name=f"noise {k}",
        )
        for k in range(12)
    ]
    return compute_fragility(
        Block.rectangle(width=0.3, height=1.2),
        suite,
        stripes=Stripes("pgv_m_s", np.geomspace(0.1, 3.0, 8).tolist(), beside=()),
        restitution=RestitutionBand(draws=2),
        fitting=Fitting(bands=None),
    )


@pytest.mark.filterwarnings("ignore:.*no_silent_downcasting.*", "ignore:.*copy_on_write.*")
def test_a_computed_fragility_comes_back_from_both_files(tmp_path: Path) -> None:
    found = real()
    made = LossComponent.from_fragility(found, "RS.cabinet", floor=True)
    assert len(made.states) >= 3
    table = load_tabular(write_pelicun(tmp_path / "fragility.csv", [made])[0]).loc["RS.cabinet"]
    root = ET.parse(write_openquake(tmp_path / "fragility.xml", [made])).getroot()
    rows = list(root.iter("{http://openquake.org/xmlns/nrml/0.5}params"))
    for number, (state, row) in enumerate(zip(made.states, rows, strict=True)):
        plain = found.state(state.name).plain
        assert float(table[f"LS{number + 1}", "Theta_0"]) == pytest.approx(plain.median, rel=4e-15)
        assert float(table[f"LS{number + 1}", "Theta_1"]) == pytest.approx(plain.beta, rel=4e-15)
        assert row.get("ls") == state_name(state.name)
        mean, deviation = float(row.get("mean", "")), float(row.get("stddev", ""))
        assert math.sqrt(math.log1p((deviation / mean) ** 2)) == pytest.approx(plain.beta)
        assert mean**2 / math.hypot(mean, deviation) == pytest.approx(100.0 * plain.median)


@pytest.mark.parametrize(
    ("given", "line"),
    [
        ({"name": " "}, "a state has a name"),
        ({"name": 3}, "it must be a text"),
        ({"name": "x", "median": 0.4}, "a median and a beta, or a curve"),
        ({"name": "x"}, "a median and a beta, or a curve"),
        ({"name": "x", "median": -1.0, "beta": 0.5}, "above 0"),
        ({"name": "x", "median": 0.4, "beta": 0.0}, "above 0"),
    ],
)
def test_a_state_that_is_none_is_refused(given: dict[str, Any], line: str) -> None:
    with pytest.raises(InputError, match=line):
        LossState(**given)


@pytest.mark.parametrize(
    ("given", "line"),
    [
        ({"measure": "sa_g"}, "period_s"),
        ({"measure": "pga_g", "period_s": 1.0}, "period_s"),
        ({"measure": "pgd_m"}, "measure"),
        ({"measure": "pga_g", "no_damage": -0.1}, "no_damage"),
        ({"measure": "pga_g", "states": ()}, "states"),
    ],
)
def test_a_component_that_is_none_is_refused(given: dict[str, Any], line: str) -> None:
    states = (LossState(name="x", median=0.4, beta=0.5),)
    with pytest.raises(InputError, match=line):
        LossComponent(**{"identifier": "A", "states": states, **given})


def test_two_names_that_would_be_one_in_a_file_are_refused() -> None:
    states = tuple(LossState(name=name, median=0.4, beta=0.5) for name in ("a > 1", "a < 1"))
    with pytest.raises(InputError, match="differ in letters and digits"):
        LossComponent(identifier="A", measure="pga_g", states=states)
