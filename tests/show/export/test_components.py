"""Components from fragilities: units of the block, gates, states that have no lognormal."""

import dataclasses
import importlib
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure
from scipy import stats

from rocksteady import Block, Record, compute_fragility, compute_risk, plots
from rocksteady.errors import InputError
from rocksteady.export import LossComponent, LossState, write_openquake, write_pelicun
from rocksteady.measures import Measure
from rocksteady.results.numbers import number
from rocksteady.risk import (
    DamageState,
    FitOptions,
    Fragility,
    FragilityCurve,
    HazardCurve,
    Levels,
    RestitutionBand,
    StateFragility,
    fit_curve,
    fit_two_stages,
)
from rocksteady.show.export.components import state_name
from tests.every import every
from tests.show.export.test_openquake import read as read_nrml

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
    gravity: float = 9.80665,
) -> Fragility:
    measure = Measure(name, period)
    labels = (measure.label, measure.unit)
    fall = fit_two_stages(LEVELS, LIFTED, fell, [40] * 5, family=family, measure=labels)
    lift = fit_curve(LEVELS, LIFTED, [40] * 5, family=family, measure=labels)
    return Fragility(
        ensemble=xarray.Dataset(
            coords={
                "block": range(1, blocks + 1),
                "alpha": ("block", [ALPHA] * blocks),
                "p": ("block", [P] * blocks),
                "gravity": ("block", [gravity] * blocks),
                "vertical": [vertical],
            },
            attrs={
                "model": "nonlinear",
                "gate_g": math.nan if vertical == "with" else gravity / 9.80665 * math.tan(ALPHA),
            },
        ),
        measure=measure,
        states=(
            StateFragility(state=DamageState("uplift"), plain=lift),
            StateFragility(
                state=DamageState("overturned"),
                plain=fall.plain,
                two_stage=fall,
                given_uplift=measure.given_uplift,
            ),
        ),
        ranking=(),
        fitting=FitOptions(bands=None),
        warnings=(),
        records=20,
        runs=200,
        scale_factor_max=1.0,
        seconds=0.0,
    )


@every(
    ("name", "measure", "factor"),
    [
        ("pga_g", "pga_g", 1.0),
        ("pgv_m_s", "pgv_m_s", 1.0),
        ("pga_per_uplift", "pga_g", 3.5 / 9.80665 * math.tan(ALPHA)),
        ("p_pgv_per_uplift", "pgv_m_s", 3.5 * math.tan(ALPHA) / P),
    ],
)
def test_ratios_become_accelerations_and_velocities_of_the_block_in_its_gravity(
    name: str, measure: str, factor: float
) -> None:
    found = fragility(name, gravity=3.5)
    made = LossComponent.from_fragility(found, "RS.vase")
    assert made.measure == measure
    state = made.states[-1]
    assert state.name == "overturned"
    at = np.array([0.15, 0.3, 0.9])
    np.testing.assert_allclose(
        state.probability(factor * at), found.state("overturned").curve.probability(at), rtol=1e-12
    )


def test_the_gate_is_the_uplift_limit_without_vertical_motion_alone() -> None:
    assert LossComponent.from_fragility(fragility(), "A").no_damage == math.tan(ALPHA)
    assert LossComponent.from_fragility(fragility(vertical="with"), "A").no_damage is None
    assert LossComponent.from_fragility(fragility("pgv_m_s"), "A").no_damage is None


def test_what_never_happens_has_no_curve_in_any_file() -> None:
    never = fragility(fell=np.zeros(5, dtype=int))
    kept = LossComponent.from_fragility(never, "A")
    assert [state.name for state in kept.states] == ["uplift"]
    assert any("status never" in sentence for sentence in kept.left_out)
    alone = dataclasses.replace(never, states=never.states[1:])
    with pytest.raises(InputError, match="fragility has no curve to write"):
        LossComponent.from_fragility(alone, "A")


def test_over_pgv_curves_are_of_the_runs_that_lift_and_uplift_is_left_out() -> None:
    found = fragility("pgv_m_s")
    made = LossComponent.from_fragility(found, "A")
    (state,), given = made.states, found.state("overturned").curve
    assert isinstance(given, FragilityCurve)
    assert given.trials == LIFTED.sum()
    assert (state.median, state.beta) == (given.median, given.beta)
    assert "given PGA > g tan alpha" in state.note
    assert made.left_out == ("uplift is left out. The other curves are of the runs that lift.",)


def test_a_curve_that_misses_its_shares_says_so_first_in_every_file(tmp_path: Path) -> None:
    at, fell = np.geomspace(0.1, 3.0, 6), np.array([0, 30, 0, 40, 20, 40])
    curve = fit_curve(at, fell, [40] * 6, measure=("PGA", "g"))
    assert curve.misfit > 0.2
    words = f"up to {number(100.0 * curve.misfit, 2)} points from the counted shares"
    state = StateFragility(state=DamageState("overturned"), plain=curve)
    found = dataclasses.replace(fragility(), states=(state,))
    made = LossComponent.from_fragility(found, "A")
    assert words in made.states[0].note.split(".")[0]
    _, companion = write_pelicun(tmp_path / "a.csv", [made])
    assert words in companion.read_text(encoding="ascii")
    assert words in write_openquake(tmp_path / "a.xml", [made]).read_text(encoding="utf-8")
    assert words in curve.describe().headline
    for plot in (plots.fragility, plots.fragility_states):
        axes = plot(found, Figure().add_subplot())
        entries = axes.get_legend_handles_labels()[1]
        assert any(f"poor fit ({curve.misfit:.2f})" in entry for entry in entries)
    good = fit_curve([0.2, 0.4, 0.8, 1.6], [2, 9, 27, 39], [40] * 4)
    assert "poor fit" not in good.summary()


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
        levels=Levels("pgv_m_s", np.geomspace(0.1, 3.0, 8).tolist(), beside=()),
        restitution=RestitutionBand(draws=2),
        fitting=FitOptions(bands=None),
    )


class Multilinear:
    """A `multilinear_CDF` as pelicun 3.10 takes it: its rules, its units to six digits."""

    def __init__(self, text: str, unit: float) -> None:
        ordinates, abscissae = (np.array(part.split(","), dtype=float) for part in text.split("|"))
        self.x = np.array([float(f"{value:g}") for value in unit * ordinates])
        self.y = np.array([float(f"{value:g}") for value in abscissae])
        assert (self.y[0], self.y[-1]) == (0.0, 1.0)
        for values in (self.x, self.y):
            assert (np.diff(values) > 0.0).all()
            assert not np.isclose(np.diff(values), 0.0).any()
        self.unit = unit

    def __call__(self, at: np.ndarray) -> np.ndarray:
        return np.asarray(np.interp(self.unit * at, self.x, self.y, left=0.0, right=1.0))


def as_pelicun_reads(file: Path, identifier: str, state: int) -> Any:
    row = load_tabular(file).loc[identifier]
    unit = {"g": 9.80665, "mps": 1.0}[row["Demand", "Unit"]]
    family, first = row[f"LS{state}", "Family"], row[f"LS{state}", "Theta_0"]
    if family == "multilinear_CDF":
        return Multilinear(first, unit)
    assert family == "lognormal"
    return stats.lognorm(float(row[f"LS{state}", "Theta_1"]), scale=float(first)).cdf


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*no_silent_downcasting.*", "ignore:.*copy_on_write.*")
def test_every_curve_comes_back_from_every_file_as_its_reader_takes_it(tmp_path: Path) -> None:
    """Within .01 of the report's, below uplift too, and with the same annual rate within 1 %."""
    found = real()
    gated = fragility()
    gate = math.tan(ALPHA)
    stages = fit_two_stages(LEVELS, gate, [0, 0, 3, 33, 39], [40] * 5, measure=("PGA", "g"))
    fall = StateFragility(state=DamageState("overturned"), plain=stages.plain, two_stage=stages)
    gated = dataclasses.replace(gated, states=(gated.states[0], fall))
    logistic = fragility(family="logistic")
    for name, each in (("real", found), ("gated", gated), ("logistic", logistic)):
        made = LossComponent.from_fragility(each, "RS.cabinet")
        table = write_pelicun(tmp_path / f"{name}.csv", [made])[0]
        functions = read_nrml(write_openquake(tmp_path / f"{name}.xml", [made]))[2]["RS.cabinet"]
        unit = 100.0 if made.measure == "pgv_m_s" else 1.0
        for number_, state in enumerate(made.states, 1):
            curve = each.state(state.name).curve
            median = float(curve.median)
            at = median * np.array([0.5, 0.8, 1.01, 1.4, 2.5])
            theirs = as_pelicun_reads(table, "RS.cabinet", number_)
            quake = np.array([functions(state_name(state.name), unit * x) for x in at])
            expected = curve.probability(at)
            assert np.abs(theirs(at) - expected).max() < 0.01, (name, state.name)
            assert np.abs(quake - expected).max() < 0.01, (name, state.name)
            hazard = HazardCurve(
                measure=made.measure,
                levels=np.array([0.01 * median, 30.0 * median]),
                rates=np.array([1.0, 1e-7]),
            )
            report = compute_risk(curve, hazard).annual_rate
            x = np.geomspace(0.01 * median, 30.0 * median, 20001)
            shares = (
                (x, theirs(np.sqrt(x[1:] * x[:-1]))),
                (x[::20], [functions(state_name(state.name), unit * level)
                           for level in np.sqrt(x[20::20] * x[:-20:20])]),
            )  # fmt: skip
            for steps, middles in shares:
                rates = hazard.rate(steps)
                rate = float(-np.diff(rates) @ np.array(middles)) + float(rates[-1])
                assert rate == pytest.approx(report, rel=0.01), (name, state.name)
    below = np.array([0.3, 0.9, 0.999]) * gate
    falls = as_pelicun_reads(tmp_path / "gated.csv", "RS.cabinet", 2)
    assert falls(below).max() < 1e-6
    assert stages.probability(below).tolist() == [0.0, 0.0, 0.0]
    function = read_nrml(tmp_path / "gated.xml")[2]["RS.cabinet"]
    assert [function("overturned", float(level)) for level in below] == [0.0, 0.0, 0.0]


@every(
    ("given", "line"),
    [
        ({"name": " "}, "a state has a name"),
        ({"name": 3}, "it must be a text"),
        ({"name": "x", "median": 0.4}, "a median and a beta, or a curve"),
        ({"name": "x"}, "a median and a beta, or a curve"),
        ({"name": "x", "median": 0.4, "beta": 0.5, "curve": np.sqrt}, "a median and a beta, or"),
        ({"name": "x", "median": -1.0, "beta": 0.5}, "above 0"),
        ({"name": "x", "median": 0.4, "beta": 0.0}, "above 0"),
    ],
)
def test_a_state_that_is_none_is_refused(given: dict[str, Any], line: str) -> None:
    with pytest.raises(InputError, match=line):
        LossState(**given)


@every(
    ("given", "line"),
    [
        ({"measure": "sa_g"}, "period_s"),
        ({"measure": "pga_g", "period_s": 1.0}, "period_s"),
        ({"measure": "pgd_m"}, "measure"),
        ({"measure": 5}, "measure"),
        ({"measure": "sa_g:x"}, "its period must be a number"),
        ({"measure": "sa_g:0.7", "period_s": 1.0}, "measure"),
        ({"measure": "pga_g", "no_damage": -0.1}, "no_damage"),
        ({"measure": "pga_g", "states": ()}, "states"),
    ],
)
def test_a_component_that_is_none_is_refused(given: dict[str, Any], line: str) -> None:
    states = (LossState(name="x", median=0.4, beta=0.5),)
    with pytest.raises(InputError, match=line):
        LossComponent(**{"identifier": "A", "states": states, **given})


def test_a_state_that_points_cannot_hold_is_left_out_and_the_others_are_kept() -> None:
    """It rises so slowly that it is not 1 at 1e4 g, where a file of points has to end."""
    slow = fragility("pga_g", fell=np.array([0, 0, 10, 11, 12]))
    component = LossComponent.from_fragility(slow, "A")
    assert [state.name for state in component.states] == ["uplift"]
    assert any("overturned is left out" in line for line in component.left_out)


def test_a_measure_as_text_has_its_period() -> None:
    states = (LossState(name="x", median=0.4, beta=0.5),)
    component = LossComponent(identifier="A", measure="sa_g:0.7", states=states)
    assert (component.measure, component.period_s) == ("sa_g", 0.7)


def test_two_names_that_would_be_one_in_a_file_are_refused() -> None:
    states = tuple(LossState(name=name, median=0.4, beta=0.5) for name in ("a > 1", "a < 1"))
    with pytest.raises(InputError, match="differ in letters and digits"):
        LossComponent(identifier="A", measure="pga_g", states=states)
