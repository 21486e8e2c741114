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


def test_the_density_between_its_nodes_and_the_region(found: BackAnalysis) -> None:
    """In logarithms of both it is bilinear: at a node itself, half way the mean of four."""
    values, ratios = found.first_values, found.ratios
    for k in (0, 3, len(values) - 1):
        for j in (0, 5, len(ratios) - 1):
            at = found.density_at(float(values[k]), float(values[k] * ratios[j]))
            assert at == pytest.approx(found.density[k, j], rel=1e-6, abs=1e-9)
            inside = found.contains(float(values[k]), float(values[k] * ratios[j]))
            assert inside == (at >= found.threshold)
    first = math.sqrt(values[2] * values[3])
    middle = found.density_at(first, first * math.sqrt(ratios[4] * ratios[5]))
    assert middle == pytest.approx(found.density[2:4, 4:6].mean(), rel=1e-6)
    assert found.limits == (values[0], values[-1])
    hint = "stay inside, or analyse other limits: rs.calibration.ScanOptions"
    for wrong in (0.99 * values[0], 1.01 * values[-1]):
        with pytest.raises(InputError, match=f"^first = .*{hint}"):
            found.density_at(wrong, 1.0)
    for share in (0.99 * ratios[0], 1.01 * ratios[-1]):
        with pytest.raises(InputError, match=r"^second = "):
            found.contains(float(values[1]), float(values[1] * share))
    rows = found.grid_rows()
    assert len(rows) == found.density.size
    across, up, density, region = rows[len(ratios) + 1]
    assert across == values[1]
    assert up == pytest.approx(values[1] * ratios[1])
    assert (density, region) == (found.density[1, 1], bool(found.density[1, 1] >= found.threshold))


def test_records_in_the_order_of_their_weights(found: BackAnalysis) -> None:
    rows = found.record_rows()
    weights = [row["weight"] for row in rows]
    assert weights == sorted(weights, reverse=True)
    assert sum(weights) == pytest.approx(1.0)
    for row in rows:
        place = found.records.index(row["record"])
        peak = found.first_values[found.weights[place].argmax()]
        assert row["scale"] * found.values_at_one[place, 0] == pytest.approx(peak)
        for k, measure in enumerate(found.measures):
            assert row[measure.key] == pytest.approx(row["scale"] * found.values_at_one[place, k])


def test_results_of_every_kind_in_words(found: BackAnalysis) -> None:
    lows, highs = np.array([0.1, 0.2]), np.array([0.4, 0.8])
    nothing = np.full(2, np.nan)
    some = {"lows": lows, "highs": highs, "medians": np.array([0.2, 0.5])}
    pga, pgv = found.measures[0].label, found.measures[1].label
    for fields, sentence in (
        ({"bound": "interval"}, f"{pga} 0.1 to 0.4 g, {pgv} 0.2 to 0.8 m/s"),
        ({"bound": "lower bound"}, f"{pga} at least 0.1 g, {pgv} at least 0.2 m/s"),
        ({"bound": "upper bound"}, f"{pga} likely below 0.4 g, {pgv} likely below 0.8 m/s"),
        (
            {"bound": "lower bound", "lows": nothing},
            f"{pga} without a bound, {pgv} without a bound",
        ),
        ({"bound": "upper bound", "highs": nothing}, f"{pga} without a bound, {pgv} without a bou"),
    ):
        made = replace(found, **{**some, "held_out_surveys": 0, "confidence": 0.9, **fields})  # type: ignore[arg-type]
        text = " ".join(made.summary(more=True).split())
        assert sentence in text, text
        assert f"3 of 5 fell: {sentence}" in made.summary()
        assert "(90 %)." in made.summary()
        assert made.inner_threshold == 0.5 or fields["bound"] == "interval"
        assert "not checked by records that are left out" in text
        values = made.to_dict()
        assert (values["objects"], values["fell"], values["bound"]) == (5, 3, fields["bound"])
        assert values["confidence"] == 0.9
        row = values["measures"][0]
        for key, end in (("low", made.lows), ("high", made.highs), ("median", made.medians)):
            assert row[key] == (None if np.isnan(end[0]) else end[0])
    checked = replace(found, held_out_surveys=40, share=0.93, confidence=0.9, bound="interval")
    words = "0.9 of 40 simulated surveys under records that are left out, at a posterior "
    assert f"{words}probability of 0.93" in " ".join(checked.summary(more=True).split())
    assert "90 % of 40 simulated surveys" in checked.summary()
    lines = found.summary(more=True).splitlines()
    (heading,) = (line for line in lines if "best scale" in line)
    assert heading.split()[:4] == ["record", "weight", "best", "scale"]
    row_of = next(line for line in lines if line.strip().startswith("ground "))
    assert row_of.index("ground") == heading.index("record")
    assert found.record_weights.sum() == pytest.approx(1.0)
    low, high = found.to_dict()["limits"]
    assert (low, high) == found.limits
