"""Answers of a fragility: what is no answer, what limits one, and what each number is called."""

import math
from dataclasses import replace
from typing import Any

import pytest
import xarray

from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.model.equations import Linear, Nonlinear
from rocksteady.results.answer import Answer
from rocksteady.risk import (
    BandOptions,
    DamageState,
    FitOptions,
    Fragility,
    FragilityCurve,
    StateFragility,
    fit_curve,
    fit_two_stages,
)
from rocksteady.risk.fits.two_stages import LEAST_GAIN, TwoStageCurve
from rocksteady.risk.fragility.efficiency import Efficiency
from rocksteady.risk.fragility.fragility import _columns, _short, _shown_row, _tried, _verb
from tests.every import every

AT, TRIALS = [0.2, 0.4, 0.8, 1.6], [40] * 4


def curve(failures: list[int] | None = None, **keys: Any) -> FragilityCurve:
    made = fit_curve(AT, failures or [2, 9, 27, 39], TRIALS, measure=("PGV", "m/s"))
    return replace(made, **keys)


def stages(**keys: Any) -> TwoStageCurve:
    made = fit_two_stages(AT, [10, 30, 40, 40], [0, 9, 27, 39], TRIALS, measure=("PGA", "g"))
    return replace(made, **keys)


def ensemble_of(model: str) -> xarray.Dataset:
    """Return what a description asks of an ensemble on the ground: no run of it."""
    return xarray.Dataset(attrs={"model": model, "gate_g": 0.25})


def state(name: str = "overturned", plain: FragilityCurve | None = None, **keys: Any) -> Any:
    return StateFragility(state=DamageState(name), plain=plain or curve(), **keys)


def fragility(*states: StateFragility, measure: str = "pgv_m_s", **keys: Any) -> Fragility:
    values: dict[str, Any] = {
        "ensemble": ensemble_of("nonlinear"),
        "measure": Measure(measure),
        "states": states or (state(),),
        "ranking": (),
        "fitting": FitOptions(bands=None),
        "warnings": (),
        "records": 22,
        "runs": 1600,
        "scale_factor_max": 10.0,
        "seconds": 0.0,
    }
    return Fragility(**{**values, **keys})


def told(found: Fragility) -> tuple[str, dict[str, str]]:
    answer: Answer = found._answer()
    return answer.sentence, dict(answer.stated)


def test_a_good_curve_of_many_records_needs_no_remark() -> None:
    sentence, facts = told(fragility(state(plain=curve(misfit=0.1))))
    assert sentence == "Half of them fall at 0.591 m/s of PGV, beta 0.582."
    assert facts == {"fit": "within 10 points of the counts; 1,600 runs, 22 records"}
    assert fragility()._headline() == (
        "Fragility in PGV: half fall at 0.591 m/s, beta 0.582; 22 records, 1,600 runs"
    )


@every(
    ("misfit", "answered", "words"),
    [
        (0.1, True, "within 10 points"),
        (0.101, True, "poor: up to 10 points off"),
        (0.15, True, "poor: up to 15 points off"),
        (0.151, False, "poor: up to 15 points off"),
    ],
)
def test_a_curve_that_misses_the_shares_is_poor_and_then_no_answer(
    misfit: float, answered: bool, words: str
) -> None:
    sentence, facts = told(fragility(state(plain=curve(misfit=misfit))))
    assert facts["fit"].startswith(words)
    assert sentence.startswith("Half of them" if answered else "No answer yet: the curve misses")
    assert ("provisional" in facts) is not answered
    if not answered:
        assert facts["provisional"] == "Half of them fall at 0.591 m/s of PGV, beta 0.582"


def test_few_records_and_large_factors_are_said_from_their_limits_on() -> None:
    for records, few in ((22, False), (21, True)):
        _, facts = told(fragility(records=records))
        assert ("(curves need 22)" in facts["fit"]) is few
    for factor, large in ((10.0, False), (10.1, True)):
        _, facts = told(fragility(scale_factor_max=factor))
        assert ("scaled" in facts) is large
    _, facts = told(fragility(scale_factor_max=10.1))
    assert facts["scaled"] == "records by up to 10.1 x: check these"


def test_without_a_median_there_is_no_answer() -> None:
    never = curve([0, 0, 0, 0])
    sentence, facts = told(fragility(state(plain=never)))
    assert sentence == (
        "No answer yet where half of them fall: no failure in 160 trials, PGV up to 1.6 m/s."
    )
    assert facts["fit"].startswith("within 0 points") or "points" not in facts["fit"]
    assert ": no level at which half fall; " in fragility(state(plain=never))._headline()
    step = curve([0, 0, 40, 40])
    sentence, _ = told(fragility(state(plain=step)))
    assert sentence.endswith(" m/s of PGV (a step: no level between 0.4 and 0.8).")
    at_one = fragility(state(plain=replace(step, step=(0.4, 0.4), median=0.4)))
    assert told(at_one)[0] == "Half of them fall at 0.4 m/s of PGV, a step."
    assert "beta" not in sentence


def test_other_states_come_first_and_those_without_a_median_not_at_all() -> None:
    lifted = state("uplift", curve(median=0.21))
    tilted = StateFragility(
        state=DamageState("theta/alpha > 0.5", 0.5), plain=curve(median=0.4), given_uplift=True
    )
    never = StateFragility(state=DamageState("half", 0.5), plain=curve([0, 0, 0, 0]))
    shown = fragility(never, lifted, tilted, state(given_uplift=True, two_stage=stages()))
    sentence, facts = told(shown)
    assert sentence.startswith("If lifted, half fall at ")
    assert list(facts)[:2] == ["lift", "> 0.5 alpha"]
    assert facts["lift"] == "half at 0.21 m/s of PGV"
    assert facts["> 0.5 alpha"] == "if lifted, half at 0.4 m/s of PGV"
    assert told(fragility())[0].startswith("Half of them fall at ")


def test_in_two_stages_the_beta_is_given_uplift() -> None:
    two = state(two_stage=stages(gain=3.0))
    sentence, _ = told(fragility(two, measure="pga_g"))
    beta = two.curve.given_uplift.beta
    assert sentence.endswith(f"beta {beta:.3g} given uplift.")
    assert f"beta {beta:.3g} given uplift;" in fragility(two, measure="pga_g")._headline()
    row = _shown_row(two)
    assert (row["stages"], row["gain"]) == ("2", 3.0)
    assert row["beta"] == f"{beta:.3g}"
    one = _shown_row(state(plain=curve([0, 0, 40, 40])))
    assert one["stages"] == "1, separated"
    assert (one["beta"], one["gain"]) == ("—", None)
    banded = _shown_row(state(plain=curve(median_band=(0.5, 0.7), beta_band=(0.4, 0.8))))
    assert banded["median"] == "0.591 (0.5-0.7)"
    assert banded["beta"] == "0.582 (0.4-0.8)"
    over = _shown_row(state(given_uplift=True, two_stage=stages()))
    assert over["stages"] == "1, given uplift"


def test_an_interval_stands_with_its_confidence() -> None:
    banded = state(plain=curve(median_band=(0.5, 0.7)))
    wide = FitOptions(bands=BandOptions(confidence=0.95))
    sentence, _ = told(fragility(banded, fitting=wide))
    assert "0.591 m/s of PGV (95 %: 0.5 to 0.7), beta" in sentence
    ratio = fragility(state(), measure="p_pgv_per_uplift")
    assert "at p PGV/(g tan alpha) 0.591, beta" in told(ratio)[0]


def test_two_stages_are_used_where_they_gain_more_than_rounding_does() -> None:
    for gain, used in ((LEAST_GAIN, False), (math.nextafter(LEAST_GAIN, 1.0), True), (-1.0, False)):
        two = stages(gain=gain)
        assert two.best is (two if used else two.plain)
        assert two.over(True) is two.given_uplift
    known = stages(gain=-1.0, gate=0.1)
    assert known.best is known


@every(
    ("made", "verb", "short"),
    [
        (DamageState("uplift"), "lift", "uplift"),
        (DamageState("overturned"), "fall", "overturned"),
        (DamageState("theta/alpha > 0.25", 0.25), "tilt > 0.25 alpha", "> 0.25 alpha"),
        (DamageState("half", 0.5), "tilt > 0.5 alpha", "half"),
    ],
)
def test_a_state_has_its_words(made: DamageState, verb: str, short: str) -> None:
    assert (_verb(made), _short(made)) == (verb, short)


def test_shares_of_a_curve_of_runs_that_lift_are_of_these() -> None:
    assert _tried(state(), 40, 30) == 40
    assert _tried(state(given_uplift=True), 40, 30) == 30
    assert _tried(state(given_uplift=True), 40, None) == 40
    points = ((0.4, 40, 30, 9), (0.2, 40, 0, 0), (0.8, 40, None, 27))
    made = fragility(state(given_uplift=True, points=points))
    assert [row["share"] for row in made._points()] == [0.3, None, 27 / 40]
    assert made._points()[0]["probability"] == pytest.approx(curve().probability(0.4))


def test_the_ranking_has_single_measures_and_the_best_pair() -> None:
    rows = [
        Efficiency(
            measure=tuple(map(Measure, names)), state="overturned", status="fitted",
            median=math.nan if len(names) > 1 else 0.4, beta=0.5, log_likelihood=-80.0, aic=164.0,
        )
        for names in (["pga_g", "pgv_m_s"], ["pgv_m_s"], ["pga_g", "pgv_per_pga_s"], ["pga_g"])
    ]  # fmt: skip
    made = fragility(ranking=tuple(rows))
    assert [row["measure"] for row in made._best()] == ["pga_g and pgv_m_s", "pgv_m_s", "pga_g"]
    assert made._ranking()[0]["log_likelihood_per_run"] == -0.5  # of 160 trials
    assert made._ranking()[0]["median"] is None
    assert [row["median"] for row in made._ranking()[1::2]] == [0.4, 0.4]


def test_states_and_equations_are_those_of_the_runs() -> None:
    made = fragility(state("uplift"), state())
    assert made.state("uplift").state.name == "uplift"
    with pytest.raises(InputError, match="the damage states are uplift, overturned"):
        made.state("fallen")
    assert isinstance(made.model, Nonlinear)
    linear = fragility(ensemble=ensemble_of("linear"))
    assert isinstance(linear.model, Linear)


def test_columns_of_damage_states_name_the_unit_and_have_words_on_the_left() -> None:
    for unit, median in (("g", "median [g]"), ("m/s", "median [m/s]"), ("", "median")):
        result = [(column.heading, column.left) for column in _columns(unit)]
        assert result == [
            *(("damage state", True), (median, True), ("beta", True)),
            *(("misfit", False), ("gain", False), ("stages", True)),
        ]
