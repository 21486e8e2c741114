"""`back_analyse` with blocks and records: mirror images, workers, limits and refusals."""

import importlib
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rocksteady import BaseMotion, Block, Execution, Linear, Record, Status, back_analyse, simulate
from rocksteady.calibration import BackAnalysis, ObjectPrior, Prior, ScanOptions, Survey
from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.risk.observations.spread import PriorRange
from tests.seismic.grounds import ground

back_analysis_module = importlib.import_module("rocksteady.risk.back_analysis.back_analyse")
RECORDS = [
    Record(
        acceleration_m_s2=ground(seed).acceleration_m_s2,
        dt_s=0.02 * (1.0 + 0.25 * (seed % 5)),
        name=f"ground {seed}",
    )
    for seed in range(6)
]
OBJECTS = [
    ObjectPrior(name=f"block {k}", width_m=0.15 + 0.04 * k, height_m="0.85:0.95", base="0.9:1.0")
    for k in range(5)
]
SURVEY = Survey(objects=OBJECTS, fell=[True, True, False, True, False])
FEW = ScanOptions(levels=8, draws=2, trials=2)


@pytest.fixture(scope="module")
def found() -> BackAnalysis:
    return back_analyse(SURVEY, RECORDS, scan=FEW)


def test_workers_and_executors_give_the_same_bits(found: BackAnalysis) -> None:
    for run in (Execution(executor="serial"), Execution(workers=3)):
        again = back_analyse(SURVEY, RECORDS, scan=FEW, run=run)
        assert again.weights.tobytes() == found.weights.tobytes()
        assert again.density.tobytes() == found.density.tobytes()
        assert again.threshold == found.threshold
    assert found.runs == 5 * 6 * 8 * 2
    other = back_analyse(SURVEY, RECORDS, scan=replace(FEW, seed=1))
    assert not np.array_equal(other.weights, found.weights)


def test_an_exact_object_falls_where_simulate_says_so() -> None:
    block = Block.rectangle(width=0.2, height=0.9)
    exact = ObjectPrior(
        name="exact",
        width_m=0.2,
        height_m=0.9,
        base=1.0,
        housner_factor=1.0,
        scatter=0.0,
    )
    prior = Prior(
        noise=OutcomeErrors(sigma_ln=PriorRange.exactly(0.0), outliers=PriorRange.exactly(0.0))
    )
    scan = ScanOptions(levels=10, draws=2, temper=1.0, trials=0, limits=(0.2, 2.0))
    survey = Survey(objects=[exact], fell=[True])
    result = back_analyse(survey, RECORDS, prior=prior, scan=scan)
    levels = result.first_values[::3]
    fell = np.array(
        [
            [
                simulate(block, record.scaled(level / one)).status == Status.OVERTURNED
                for level in levels
            ]
            for record, one in zip(RECORDS, result.values_at_one[:, 0], strict=True)
        ]
    )
    assert 0 < fell.sum() < fell.size
    assert np.array_equal(result.weights[:, ::3] > 1e-9, fell)
    assert "not checked by records that are left out" in result.summary(more=True)


def test_records_filed_with_another_factor_or_sign_change_nothing() -> None:
    turned = [record.scaled(-2.0) for record in RECORDS]
    plain = back_analyse(SURVEY, RECORDS, scan=FEW)
    other = back_analyse(SURVEY, turned, scan=FEW)
    assert other.weights == pytest.approx(plain.weights, rel=1e-9, abs=1e-12)
    assert other.medians == pytest.approx(plain.medians, rel=1e-9)
    assert other.values_at_one == pytest.approx(2.0 * plain.values_at_one, rel=1e-9)


def test_all_objects_the_other_way_round_are_the_shaking_with_the_other_sign() -> None:
    leaning = [
        ObjectPrior(name=f"statue {k}", left_m=0.08 + 0.02 * k, right_m=0.2,
                    mass_centre_height_m=0.6)
        for k in range(3)
    ]  # fmt: skip
    fell = [True, False, False]
    fixed = ScanOptions(levels=8, draws=2, temper=0.7, trials=0)
    results = [
        back_analyse(Survey(objects=leaning, fell=fell, reversed=facing), RECORDS, scan=fixed)
        for facing in ([False] * 3, [True] * 3, [False, True, False], None)
    ]
    same, turned, mixed, unknown = (result.weights for result in results)
    # The sign of the shaking is unknown: both ways round are one survey, but mixed ones are not.
    assert turned == pytest.approx(same, rel=1e-9, abs=1e-12)
    assert not np.allclose(mixed, same)
    assert not np.allclose(unknown, same)


def test_other_measures_and_limits(found: BackAnalysis) -> None:
    measures = (Measure("pgv_m_s"), Measure("sa_g", 0.5), "pga_g")
    scan = replace(FEW, limits=(0.05, 3.0))
    other = back_analyse(SURVEY, RECORDS, measures=measures, scan=scan)
    assert other.limits == pytest.approx((0.05, 3.0))
    assert [row["measure"] for row in other.rows()] == ["pgv_m_s", "sa_g_0.5s", "pga_g"]
    assert other.medians[0] == pytest.approx(found.medians[1], rel=0.3)
    assert (other.lows < other.medians).all()
    assert (other.medians < other.highs).all()


def test_defaults_of_a_prior_reach_the_objects(found: BackAnalysis) -> None:
    objects = [ObjectPrior(name=each.name, width_m=each.width_m, height_m=0.9) for each in OBJECTS]
    survey = Survey(objects=objects, fell=SURVEY.fell)
    narrow = back_analyse(survey, RECORDS, prior=Prior(defaults={"base": 0.3}), scan=FEW)
    assert narrow.medians[0] < 0.7 * found.medians[0]


def test_vertical_motion_takes_part(found: BackAnalysis) -> None:
    both = [BaseMotion(record, record.scaled(0.5)) for record in RECORDS]
    lifted = back_analyse(SURVEY, both, scan=FEW)
    assert not np.allclose(lifted.weights, found.weights)
    assert back_analyse(SURVEY, RECORDS, scan=FEW, model=Linear()).medians[0] == pytest.approx(
        found.medians[0], rel=0.5
    )


def test_what_is_not_valid_is_refused_in_one_line() -> None:
    cases: list[tuple[Callable[[], object], str]] = [
        (lambda: back_analyse(SURVEY, RECORDS[:3]), "left out in turn"),
        (lambda: back_analyse(SURVEY, RECORDS, measures=["pga_g"]), "two or more"),
        (lambda: back_analyse(SURVEY, RECORDS, measures=["pga_g", "pga_g"]), "two or more"),
        (lambda: back_analyse(SURVEY, RECORDS, measures=["pga_g", "sa_g"]), "needs a block"),
        (
            lambda: back_analyse(SURVEY, RECORDS, measures=["pga_g", "significant_5_75_s"]),
            "does not grow",
        ),
        (lambda: ScanOptions(limits=(2.0, 1.0)), "below the second"),
        (lambda: ScanOptions(trials=0), "chosen by simulated surveys"),
        (lambda: ScanOptions(temper=0.0), "temper = 0"),
        (lambda: ScanOptions(draws=1), "draws"),
        (lambda: ScanOptions(draws=10_001), "to 10000;"),
        (lambda: ScanOptions(levels=201), "to 200;"),
        (lambda: Survey(objects=OBJECTS, fell=[True]), "there are 5 objects"),
        (lambda: Survey(objects=[*OBJECTS, OBJECTS[0]], fell=[True] * 6), "two objects"),
        (lambda: Survey(objects=[], fell=[]), "a survey has 1"),
    ]
    for call, words in cases:
        with pytest.raises(InputError, match=words) as caught:
            call()
        assert "\n" not in str(caught.value)


def test_what_people_read_has_numbers_and_caveats(found: BackAnalysis) -> None:
    text = found.summary(more=True)
    assert "3 of 5 objects fell: PGA" in text
    assert "bounds no PGA from above" in text
    assert "that is no Bayesian" in " ".join(text.split())
    values = found.to_dict()
    assert values["temper"] in {float(key) for key in values["temper_scores"]}
    assert math.isclose(sum(row["weight"] for row in values["record_weights"]), 1.0)
    assert values["held_out_surveys"] == 12
    rows = found.grid_rows()
    assert len(rows) == found.density.size
    assert sum(row[3] for row in rows) == found.region.sum()


def test_limits_widen_until_the_interval_is_inside(monkeypatch: pytest.MonkeyPatch) -> None:
    """From limits far too narrow to those of the default, or three doublings."""
    narrow = (0.3, 0.5)
    monkeypatch.setattr(back_analysis_module, "_limits", lambda *_: narrow)
    found = back_analyse(SURVEY, RECORDS, scan=replace(FEW, trials=0, temper=1.0))
    low, high = (end / start for end, start in zip(found.limits, narrow, strict=True))
    assert low < 1.0 or high > 1.0
    for factor in (1.0 / low, high):
        assert round(math.log2(factor), 9) in (0.0, 1.0, 2.0, 3.0)
    given = back_analyse(SURVEY, RECORDS, scan=replace(FEW, trials=0, temper=1.0, limits=narrow))
    assert given.limits == pytest.approx(narrow)
