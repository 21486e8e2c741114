"""The whole assessment: its numbers against runs made another way, its refusals, its words."""

import dataclasses
import json
import math
import re
from itertools import product
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocksteady.dynamics.history.simulate import simulate
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.tops import top_displacement
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.outcomes import Status
from rocksteady.results.numbers import chance, length
from rocksteady.risk.assess import _probability, _remedies
from rocksteady.risk.assess._counts import THE_DEMAND
from rocksteady.risk.assess._probability import onset_of, probability_of
from rocksteady.risk.assess._remedies import Search, _friction_cap, cheapest, find_remedies
from rocksteady.risk.assess._sensitivity import tornado, vary
from rocksteady.risk.assess.assessment import Assessment, _curve_over, assess_object
from rocksteady.risk.assess.described.objects import (
    EXAMPLE,
    DescribedObject,
    parameter_words,
    read_object,
)
from rocksteady.risk.ensemble.contact_levels import levels_in_contact
from rocksteady.risk.ensemble.levels import Levels
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fragility.fit_fragility import compute_fragility
from rocksteady.risk.fragility.fitting import FitOptions
from rocksteady.risk.hazard.failure_risk import compute_risk
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.screens.friction import first_motion
from rocksteady.seismic.measures.scalar import Measure, compute_measure
from rocksteady.seismic.spectra.many import simulate_many
from rocksteady.show.assessment._assessment_tables import answer_rows
from rocksteady.sweep.run import Execution
from tests.risk.assess.levels import level_of

SUITE = make_synthetic_suite(12)
PGV = 0.45
FEW = {"damage_states": ["overturned"], "draws": 2, "levels": 6, "replicates": 0}


def described(assessment: dict[str, Any] | None = None, **keys: Any) -> DescribedObject:
    values: dict[str, Any] = {
        "name": "statue",
        "friction": 0.5,
        "geometry": {"width_m": 0.34, "height_m": 1.8, "mass_kg": 200.0},
        "demand": {"pga_g": 0.4, "pgv_m_s": PGV},
        "assessment": {**FEW, **(assessment or {})},
    }
    return DescribedObject(values={**values, **keys})


def fallen(block: Block, pgv_m_s: float, ratios: tuple[float, ...] = ()) -> int:
    """Count falls by another route: record by record, each scaled by its own factor."""
    count = 0
    for ratio in ratios or (block.restitution,):
        body = block.with_restitution(ratio)
        for record in SUITE:
            factor = pgv_m_s / compute_measure(record, Measure("pgv_m_s"))
            found = simulate_many(body, record, scales=factor)
            count += int(found["status"] == Status.OVERTURNED)
    return count


@pytest.fixture(scope="module", name="found")
def _found() -> Assessment:
    hazard = HazardCurve(
        measure="pgv_m_s",
        levels=np.array([0.01, 1.0, 10.0]),
        rates=np.array([1.0, 1e-3, 1e-4]),
    )
    return assess_object(described({"replicates": 200}), SUITE, hazard=hazard)


def test_the_probability_is_that_of_the_fragility_at_the_demand(found: Assessment) -> None:
    assert found.fragility is not None
    assert found.curve is not None
    assert found.fragility.measure == Measure("pgv_m_s")
    assert found.curve is found.fragility.states[-1].two_stage.given_uplift  # type: ignore[union-attr]
    expected = float(found.curve.probability(np.array([PGV]))[0])
    assert found.by_curve == pytest.approx(expected, rel=1e-9)
    counted = found.cases[0].counted
    assert counted > expected + 0.1
    assert (found.probability, found.basis) == (counted, "count")
    band = found.probability_band
    assert band is not None
    assert band == found.cases[0].band
    assert band[0] < counted < band[1]
    parts = (found.described, onset_of(found.described), found.fragility, found.level)
    for share, value, basis in (
        (expected - 0.2, found.by_curve, "curve"),
        (expected + 0.09, found.by_curve, "curve"),
        (expected + 0.11, expected + 0.11, "count"),
        (1.0, 1.0, "count"),
    ):
        answer = probability_of(*parts, share, band)
        assert (answer.value, answer.by_curve, answer.basis) == (value, found.by_curve, basis)
        assert (answer.band == band) == (basis == "count")
    low, high = probability_of(*parts, expected, band).band or (math.nan, math.nan)
    assert low <= expected <= high
    assert found.fragility.records == len(SUITE)
    assert found.verdict == "above target"
    assert found.colour == "red"


def test_the_motion_of_the_top_is_that_of_the_runs_nearest_to_the_demand(
    found: Assessment,
) -> None:
    assert found.fragility is not None
    runs, block = found.fragility.ensemble, found.facts.block
    level = found.level.of(found.fragility.measure, block)
    nearest = runs.isel(level=int(np.abs(np.log(runs["level"].values / level)).argmin()))
    stands = nearest["status"].values != Status.OVERTURNED
    tops = [
        top_displacement(block, nearest["peak_angle"].values[stands] * side.alpha)
        for side in (block.positive, block.negative)
    ]
    top = found.qualification["top_displacement_m"]
    assert top == pytest.approx(np.quantile(np.max(tops, axis=0), 0.84))
    assert found.to_dict()["qualification"] == found.qualification
    gap = found.qualification["clearance_m"]
    words = f"at most {length(top or 0.0)}, clearance {length(gap or 0.0)}, its edge at "
    assert any(words in row["words"] for row in answer_rows(found))


def test_the_force_on_the_base_is_that_of_the_runs_that_rock_and_stand(
    found: Assessment,
) -> None:
    assert found.fragility is not None
    runs, block = found.fragility.ensemble, found.facts.block
    level = found.level.of(found.fragility.measure, block)
    nearest = runs.isel(level=int(np.abs(np.log(runs["level"].values / level)).argmin()))
    forces = []
    for motion, scale in zip(found.motions, nearest["scale"].values[0].tolist(), strict=True):
        run = simulate(block, motion.scaled(scale))
        if run.status != Status.OVERTURNED and run.forces_per_weight is not None:
            forces.append(run.forces_per_weight)
    mass = 120.0
    heavy = dataclasses.replace(found, facts=dataclasses.replace(found.facts, mass_kg=mass))
    expected = np.quantile(forces, 0.84, axis=0) * mass * block.gravity / 1000.0
    assert heavy.base_force_kn == pytest.approx(expected.tolist())
    assert any("kN across" in row["words"] for row in answer_rows(heavy))
    light = dataclasses.replace(found.facts, mass_kg=None)
    assert dataclasses.replace(found, facts=light).base_force_kn is None


def test_the_plot_is_that_of_the_fragility_with_the_demand(found: Assessment) -> None:
    assert found.fragility is not None
    (*lines, demand), expected = (
        [line.get_xydata() for line in each.plot(Figure().add_subplot()).lines]
        for each in (found, found.fragility)
    )
    assert len(lines) > 0
    for one, other in zip(lines, expected, strict=True):
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(demand[:, 0], PGV)


def test_the_cases_count_what_runs_of_their_own_do(found: Assessment) -> None:
    """Each record by itself, scaled by its own factor, for the restitutions of the band."""
    block = found.facts.block
    e = block.restitution
    ends = (e, min(0.98, math.sqrt(e)))
    base = found.cases[0]
    assert (base.fell, base.trials) == (fallen(block, PGV, ends), 2 * len(SUITE))
    low, high = (case for case in found.cases if case.parameter == "restitution")
    assert low.fell == fallen(block, PGV, ends[:1])
    assert high.fell == fallen(block, PGV, ends[1:])
    assert low.fell + high.fell == base.fell
    assert 0 < base.fell < base.trials


def test_a_case_is_the_object_with_that_changed(found: Assessment) -> None:
    worn = next(case for case in found.cases if case.parameter == "base width")
    k = math.hypot(0.34, 1.8) / math.sqrt(12.0)
    body = Block.asymmetric(left=0.1615, right=0.1615, height=1.8, gyration=k)
    e = body.restitution
    assert worn.fell == fallen(body, PGV, (e, min(0.98, math.sqrt(e))))
    assert {case.parameter for case in found.cases[1:]} == {
        "mass centre", "base width", "restitution",
    }  # fmt: skip


def test_bars_of_the_tornado_hold_their_cases_and_the_widest_is_first(found: Assessment) -> None:
    assert found.basis == "count"
    assert found.case_probabilities[0] == found.probability  # bars stand about the answer
    bars = tornado(found.cases, found.basis)
    widths = [bar["high"] - bar["low"] for bar in bars]
    assert widths == sorted(widths, reverse=True)
    assert widths[0] > 0.0
    names = [parameter_words(bar["parameter"]) for bar in bars]
    assert not any("_" in name or "." in name for name in names)  # words, as people read them
    assert found.bars == [
        (name, bar["low"], bar["high"]) for name, bar in zip(names, bars, strict=True)
    ]
    for case in found.cases[1:]:
        bar = next(bar for bar in bars if bar["parameter"] == case.parameter)
        assert bar["low"] <= case.counted <= bar["high"]
        assert bar["low"] <= found.cases[0].counted <= bar["high"]
    by_curve = tornado(found.cases, "curve")
    assert {bar["base"] for bar in by_curve} == {found.cases[0].fitted}
    unknown = dataclasses.replace(found.cases[1], parameter="last", counted=math.nan)
    assert tornado([*found.cases, unknown], "count")[-1]["parameter"] == "last"


def test_remedies_are_confirmed_by_their_own_runs(found: Assessment) -> None:
    width = next(each for each in found.remedies if each.name == "width")
    assert width.value is not None
    assert width.value > 0.34
    assert width.confirmed
    assert width.probability <= 0.1
    k = math.hypot(0.34, 1.8) / math.sqrt(12.0)
    half = 0.17 * (1.0 + (width.change or 0.0))
    body = Block.asymmetric(left=half, right=half, height=1.8, gyration=k)
    e = body.restitution
    assert width.fell == fallen(body, PGV, (e, min(0.98, math.sqrt(e))))
    ballast = next(each for each in found.remedies if each.name == "ballast")
    assert ballast.change is not None
    assert ballast.value == pytest.approx(200.0 * ballast.change)
    centre = (0.9 + 0.05 * ballast.change) / (1.0 + ballast.change)
    assert f"{1000.0 * centre:.3g} mm" in ballast.words
    changes = [each.change for each in found.remedies if each.change is not None]
    assert changes == sorted(changes)
    least = cheapest(found.remedies)
    assert least is found.remedies[0]
    assert found.remedies[0].words in found.sentence


@pytest.mark.slow
def test_a_remedy_meets_the_target_by_the_method_of_the_objects_own_probability() -> None:
    wide = described(
        {"target_probability": 0.11},
        geometry={"width_m": 0.5, "height_m": 1.8},
        demand={"pgv_m_s": 0.5},
    )
    found = assess_object(wide, SUITE)
    base, probability = found.cases[0].probability, found.probability or 0.0
    assert base < 0.11 < probability
    width = next(each for each in found.remedies if each.name == "width")
    assert width.change is not None
    # The widened object, assessed as itself: by runs at all levels, on the same motions.
    fitting = FitOptions(states=["overturned"], bands=None, measures=())
    falls = []
    for change in (width.change, 0.0):
        wider = wide.block_of(wide.body.wider(1.0 + change))
        fragility = compute_fragility(
            wider,
            SUITE,
            levels=levels_in_contact(
                Levels("pgv_m_s"), [wider], SUITE, count=wide.given.assessment.levels
            ),
            restitution=RestitutionBand(draws=wide.given.assessment.draws),
            fitting=fitting,
        )
        curve = fragility.state("overturned").curve
        falls.append(float(curve.probability(np.array([0.5]))[0]))
    assert falls == pytest.approx([width.probability, probability], rel=1e-9)
    assert width.probability <= 0.11 < probability


def test_the_friction_cap_is_the_slope_of_the_block_with_a_higher_mass_centre(
    found: Assessment,
) -> None:
    cap = next(each for each in found.remedies if each.name == "friction cap")
    assert cap.value == pytest.approx(0.17 / (1.1 * 0.9))
    assert cap.change == pytest.approx(1.0 - 0.17 / (1.1 * 0.9) / 0.5)


def test_a_changed_object_whose_runs_give_no_curve_is_counted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def lost(*_: object, **__: object) -> None:
        raise InputError("ensemble", 0.016, "too many runs lose contact", "take lower levels")

    monkeypatch.setattr(_probability, "fit_fragility", lost)
    statue = described()
    search = Search(statue, SUITE, level_of(statue, SUITE), 0.1, None)
    case = search.case(statue.block)
    assert (case.basis, case.probability) == ("count", case.fell / case.trials)
    assert 0 < case.fell < case.trials
    # The curve through the runs about the demand, from which a change is guessed, is near it.
    curve = search.curve_of(search.runs(statue.block), statue.block)
    assert search.fitted(statue.block, curve) == pytest.approx(case.counted, abs=0.1)


def test_a_target_out_of_reach_has_no_width_and_one_reached_needs_none(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    vase = described(
        geometry={"width_m": 0.05, "height_m": 0.5}, demand={"pgv_m_s": 5.0}, friction=0.6
    )
    search = Search(vase, SUITE, level_of(vase, SUITE), 0.01, None)
    width, ballast = (
        next(each for each in find_remedies(search) if each.name == name)
        for name in ("width", "ballast")
    )
    assert (width.change, ballast.change) == (None, None)
    assert "not even" in width.words
    assert "not even" in ballast.words
    for remedy, body in ((width, vase.body.wider(3.0)), (ballast, vase.body.with_share(10, 0.05))):
        case = search.case(vase.block_of(body))  # of the largest change tried
        assert (remedy.probability, remedy.basis) == (case.probability, case.basis)
        assert remedy.probability > 0.01
        assert not remedy.confirmed
        assert remedy.result == remedy.words
    for pgv, words in ((0.4, "within the target as it is"), (0.05, "no run lifts")):
        if pgv == 0.05:  # as where no curve can be fitted
            monkeypatch.setattr(_remedies, "fitted_probability", lambda *_, **__: math.nan)
        chest = described(geometry={"width_m": 0.9, "height_m": 1.8}, demand={"pgv_m_s": pgv})
        done = find_remedies(Search(chest, SUITE, level_of(chest, SUITE), 0.1, None))
        width = next(each for each in done if each.name == "width")
        assert width.change is None
        assert words in width.words
        assert math.isnan(width.probability) == (width.to_dict()["probability"] is None)
        assert math.isnan(width.probability) == ("no run lifts" in width.words)


def test_the_risk_is_that_of_the_fragility_over_the_velocity(found: Assessment) -> None:
    (risk,) = found.risks
    assert found.curve is not None
    other = compute_risk(found.curve, risk.hazard)
    assert risk.annual_rate == pytest.approx(other.annual_rate, rel=1e-9)
    assert 0.0 < risk.annual_rate < 1.0
    (row,) = found.to_dict()["risks"]
    assert row["annual_rate"] == risk.annual_rate
    assert row["share_outside"] == risk.share_outside
    # A rate of a hazard curve that ends too early is not stated without that.
    assert risk.describe().notes
    assert set(risk.describe().notes) <= set(found.describe().notes)


def test_everything_is_plain_json_and_every_caveat_is_printed(found: Assessment) -> None:
    text = json.dumps(found.to_dict(), allow_nan=False)
    assert len(text) > 1000
    notes = " ".join(found.describe().notes)
    for words in ("rigid body", "no prediction", "stronger", "Vertical", "Restitution in tests",
                  "slide", "not averaged", "anchorage"):  # fmt: skip
        assert words in notes, words
    assert found.summary(more=True).count("About ") == 1


def test_the_first_line_has_the_number_that_the_verdict_follows(found: Assessment) -> None:
    """By the curve, or by the runs at the demand where far more of these fall."""
    value, first = found.by_curve, found.cases[0]
    assert value is not None
    for fell in range(first.trials + 1):
        counted = fell / first.trials
        case = dataclasses.replace(first, fell=fell, counted=counted)
        above = counted > value + 0.1
        changed = dataclasses.replace(
            found,
            cases=(case, *found.cases[1:]),
            probability=counted if above else value,
            basis="count" if above else "curve",
        )
        answer = changed.describe().answer
        assert answer is not None
        runs = f"{fell or 'None'} of its {first.trials} runs"
        assert answer.sentence.startswith(runs if above else f"{100.0 * value:.0f} % of such")
        facts = dict(answer.stated)
        assert ("these runs decide" in facts["counted"]) == above
        assert (f"{100.0 * value:.0f} % by the curve" in facts["counted"]) == above
        assert len(answer.stated) <= 5


@pytest.mark.slow
def test_no_number_depends_on_the_workers(found: Assessment) -> None:
    again = assess_object(described({"replicates": 200}), SUITE, run=Execution(executor="serial"))
    first, second = found.to_dict(), again.to_dict()
    for key in ("probability", "cases", "tornado", "remedies", "median", "probability_band"):
        assert first[key] == second[key], key


@pytest.mark.parametrize(("friction", "verdict"), [(0.1, "slides"), (0.2, "slides")])
def test_where_friction_governs_there_is_no_probability(friction: float, verdict: str) -> None:
    """Below tan alpha it slides; between that and Shenton's need it slides and rocks."""
    found = assess_object(described(friction=friction), SUITE)
    assert found.verdict == verdict
    assert (found.probability, found.fragility, found.colour) == (None, None, "grey")
    with pytest.raises(InputError, match="assessment has no curve: the object slides"):
        found.plot()
    assert (found.cases, found.remedies) == ((), ())
    assert "rocking is no answer" in found.sentence
    assert "friction of 0.2" in found.reason
    assert found.screens.rows


def test_the_lowest_friction_of_a_range_counts() -> None:
    found = assess_object(described(friction={"low": 0.1, "high": 0.9}), SUITE)
    assert found.verdict == "slides"
    assert "the lowest given is 0.1" in found.reason


def test_an_acceleration_that_does_not_lift_is_an_answer() -> None:
    found = assess_object(described(demand={"pga_g": 0.18, "pgv_m_s": PGV}), SUITE)
    assert (found.verdict, found.colour, found.probability) == ("stands", "green", 0.0)
    assert found.remedies == ()
    assert found.fragility is not None
    assert "does not lift it" in found.sentence


def test_a_target_that_is_met_needs_no_remedy() -> None:
    found = assess_object(described({"target_probability": 0.9}), SUITE)
    assert found.verdict == "below target"
    assert found.remedies == ()
    assert "within the target of 90 %" in found.sentence
    assert found.colour in ("amber", "green")


@pytest.mark.usefixtures("no_remedies")
def test_without_a_demand_the_motions_as_they_are_give_it() -> None:
    found = assess_object(described(demand={}), SUITE)
    median = np.median([compute_measure(each, Measure("pgv_m_s")) for each in SUITE])
    assert f"{median:.3g} m/s, the median of the motions" in found.demand


def test_a_step_is_no_answer_between_its_levels_and_the_runs_at_the_demand_are() -> None:
    """Four levels in three octaves: none falls at one, all at the next, and the demand between."""
    suite = SUITE[:4]
    found = assess_object(
        described({"levels": 4, "draws": 1, "target_probability": 0.9}, demand={"pgv_m_s": 0.4}),
        suite,
    )
    curve = found.curve
    assert isinstance(curve, FragilityCurve)
    assert curve.status == "separated"
    assert found.probability == found.cases[0].counted
    base = found.cases[0]
    assert found.probability_band == base.band
    verb = "falls" if base.fell == 1 else "fall"
    assert found.sentence.startswith(
        f"{base.fell or 'None'} of its {base.trials} runs that lift {verb} at"
    )
    assert any("No curve of falling can be fitted" in note for note in found.describe().notes)


def test_vertical_motion_is_a_case_of_its_own() -> None:
    pairs = [
        BaseMotion(each, Record(acceleration_m_s2=0.6 * each.acceleration_m_s2[::-1],
                                dt_s=each.dt_s))
        for each in SUITE[:6]
    ]  # fmt: skip
    cases = vary(described({"draws": 1}), pairs, level_of(described(), pairs))
    assert [case.parameter for case in cases][-1] == "vertical motion"
    assert cases[-1].trials == len(pairs)


def test_risk_is_of_the_curve_that_is_shown(found: Assessment) -> None:
    fragility = found.fragility
    assert fragility is not None
    assert found.curve is fragility.state("overturned").curve
    block = found.facts.block
    again = _curve_over(fragility.measure, fragility.ensemble, [*SUITE], block)
    assert again.median == pytest.approx(found.curve.median, rel=1e-9)


def test_what_is_doubtful_stands_on_the_answer(found: Assessment) -> None:
    """The share counted at the demand, the misfit of the curve, and an unusual pair of peaks."""
    pgv = np.array([compute_measure(each, Measure("pgv_m_s")) for each in SUITE])
    pga = np.array([compute_measure(each, Measure("pga_g")) for each in SUITE])
    below = float(np.mean(pgv * 0.4 / pga < PGV))
    assert found.pgv_percentile == pytest.approx(100.0 * below)
    assert f"percentile {100.0 * below:.0f} of the motions" in found.summary(more=True).replace(
        "\n", " "
    )
    (word,) = {each["words"] for each in answer_rows(found) if each["name"] == "Demand"}
    (note,) = {each["note"] for each in answer_rows(found) if each["name"] == "Demand"}
    assert word == found.demand
    assert f"percentile {100.0 * below:.0f}" in note
    assert found.fragility is not None
    assert found.curve is not None
    state = found.fragility.states[-1]
    poor = dataclasses.replace(state.plain, misfit=0.26)
    states = (dataclasses.replace(state, plain=poor, two_stage=None),)
    probability = found.probability or 0.0
    for counted, misfit, sentences in (
        (probability + 0.09, False, 0),
        (probability + 0.11, False, 1),
        (probability - 0.11, True, 2),
    ):
        case = dataclasses.replace(found.cases[0], counted=counted)
        fragility = (
            dataclasses.replace(found.fragility, states=states) if misfit else found.fragility
        )
        changed = dataclasses.replace(
            found, cases=(case, *found.cases[1:]), fragility=fragility, by_curve=probability
        )
        usual = int(not misfit and found.curve.misfit > 0.1)
        assert len(changed.doubts) == sentences + usual
        assert changed.to_dict()["doubts"] == list(changed.doubts)
        for text in changed.doubts:
            assert text in " ".join(changed.summary(more=True).split())
            assert any(row["words"] == text for row in answer_rows(changed))
    # A pair of peaks unlike those of the motions: the fit over both is the neighbour.
    assert found.fragility.surface is not None
    both = found.by_both_peaks or math.nan
    assert both == pytest.approx(float(found.fragility.surface.probability([0.4, PGV])))
    (row,) = (each for each in answer_rows(found) if each["name"] == "By PGA and PGV")
    assert row["words"] == chance(both)
    assert "explain" in row["note"]
    far = dataclasses.replace(found, probability=abs(both - 0.2), by_curve=None)
    assert any("By PGA and PGV together" in text for text in far.doubts)
    assert far.to_dict()["by_both_peaks"] == both
    # A demand that does not lift it is certain.
    assert dataclasses.replace(found, probability=0.0).doubts == ()


def test_a_measure_needs_its_demand() -> None:
    with pytest.raises(ModelError, match=r"\[demand\] pga_g is missing: the intensity measure"):
        assess_object(described({"intensity_measure": "pga_g"}, demand={"pgv_m_s": 0.4}), SUITE)
    short = {"spectrum": {"period_s": [0.1, 0.3], "sa_g": [1.0, 0.9], "damping": 0.05}}
    with pytest.raises(ModelError, match=r"does not reach .* s, .* goes from 0\.1 to 0\.3 s"):
        assess_object(described({"intensity_measure": "sa_g"}, demand=short), SUITE)
    with pytest.raises(InputError, match="motions"):
        assess_object(described(), [])


def test_an_answer_names_the_peaks_that_its_runs_have() -> None:
    sentences = []
    for measure in ("pga_g", "pgv_m_s"):
        found = assess_object(described({"intensity_measure": measure}), SUITE[:3])
        answer = found.describe().answer
        assert answer is not None
        sentences.append(answer.sentence)
    assert " at 0.4 g" in sentences[0]
    assert "m/s" not in sentences[0]
    assert f" at 0.4 g and {PGV:g} m/s" in sentences[1]


@pytest.mark.slow
def test_no_run_that_falls_is_a_count(found: Assessment) -> None:
    case = dataclasses.replace(found.cases[0], fell=0, counted=0.0)
    changed = dataclasses.replace(
        found, cases=(case,), basis="count", probability=0.0, by_curve=None
    )
    assert f"None of its {case.trials} runs" in changed.summary()
    assert not re.search(r"\b0 %", changed.summary().splitlines()[0])


@pytest.mark.usefixtures("no_remedies")
def test_a_probability_outside_the_levels_of_the_runs_is_called_extrapolated() -> None:
    strong = assess_object(described(demand={"pga_g": 0.4, "pgv_m_s": 9.0}), SUITE[:6])
    usual = assess_object(described(), SUITE[:6])
    assert strong.doubts[0].endswith("the probability there is that of the curve alone.")
    assert not any("outside the levels" in text for text in usual.doubts)
    for each, named in ((strong, True), (usual, False)):
        first = each.summary().splitlines()[0]
        assert chance(each.probability) in first
        for words in (first, each.sentence, each.method):
            assert ("extrapolated beyond the runs" in words) is named, words


def test_the_demand_is_the_middle_of_the_levels_of_a_case() -> None:
    from rocksteady.risk.assess._sensitivity import levels_about

    level = level_of(described(), SUITE)
    assert levels_about(level)[THE_DEMAND] == pytest.approx(PGV)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["width", "ballast"])
def test_a_remedy_is_the_least_change_to_one_part_in_a_hundred(name: str) -> None:
    """Less of it by up to 1 % was run, and is above the target."""
    suite = make_synthetic_suite(24)
    bust = read_object(EXAMPLE)
    search = Search(bust, suite, level_of(bust, suite), 0.1, None)
    remedy = next(each for each in find_remedies(search) if each.name == name)
    assert remedy.change is not None
    assert 0.03 < remedy.probability <= 0.1

    def block_of(change: float) -> Block:
        body = bust.body
        return bust.block_of(
            body.wider(1.0 + change) if name == "width" else body.with_share(change, 0.05)
        )

    own = block_of(remedy.change)
    assert search.case(own).probability == remedy.probability
    # What was run just short of it: alpha grows with either change.
    short = block_of((1.0 + remedy.change) / 1.0101 - 1.0).alpha
    tried = [block for block in search.made if short <= block.alpha < own.alpha]
    assert max(search.case(block).probability for block in tried) > 0.1


def test_the_friction_cap_holds_for_the_worst_end_of_every_range() -> None:
    """With its mass centre as high as the file allows, 1.3 m, it slides before it lifts."""
    statue = described(
        geometry={
            "width_m": 0.34,
            "height_m": 1.8,
            "offset_m": 0.03,
            "mass_centre_height_m": {"low": 0.7, "high": 1.3},
        }
    )
    cap = _friction_cap(statue)
    assert cap.value == pytest.approx((0.17 - 0.03) / 1.3)
    worst = Block.asymmetric(left=0.2, right=0.14, height=2.6, gyration=0.5)
    for pga in (0.2, 0.5, 2.0, 10.0):
        assert first_motion(worst, pga, 0.999 * (cap.value or 0.0)) == "slides"
    # It lifts, and its impacts need more friction than uplift.
    assert first_motion(worst, 0.11, 1.05 * (cap.value or 0.0)) == "slides and rocks"
    assert first_motion(worst, 0.11, 0.5) == "rocks"
    # A range of something else does not stand for the higher mass centre: both count together.
    narrow = described(geometry={"width_m": {"low": 0.3, "high": 0.34}, "height_m": 1.8})
    assert _friction_cap(narrow).value == pytest.approx(0.15 / (1.1 * 0.9))


def test_an_object_against_a_wall_falls_as_runs_of_its_own_with_both_signs_do() -> None:
    """Counts by another route: record by record, as recorded and reversed."""
    wall, free = described(against_wall=True, restitution=0.4), described(restitution=0.4)
    assert wall.block == free.block.against_wall(0.4)
    (base, *cases) = vary(wall, SUITE, level_of(wall, SUITE))
    count = 0
    for record, reverse in product(SUITE, (False, True)):
        factor = PGV / compute_measure(record, Measure("pgv_m_s"))
        found = simulate_many(wall.block, record, scales=factor, reverse=reverse)
        count += int(found["status"] == Status.OVERTURNED)
    assert (base.fell, base.trials) == (count, 2 * len(SUITE))
    assert count > 0
    assert {case.parameter for case in cases} == {"mass centre", "base width"}
    answer = assess_object(wall, SUITE)
    assert answer.probability is not None
    assert "against a wall" in " ".join(answer.facts.warnings)
    assert answer.facts.describe().to_dict()["restitution"] == 0.4
    assert all(remedy.confirmed for remedy in answer.remedies if remedy.change is not None)


def test_a_range_at_the_wall_may_begin_at_0_and_is_the_walls_in_the_tornado() -> None:
    wall = described(against_wall=True, restitution={"low": 0.0, "high": 0.5})
    assert wall.block.restitution == 0.0
    cases = vary(wall, SUITE, level_of(wall, SUITE))
    ends = [case.change for case in cases if case.parameter == "restitution"]
    assert ends == ["0.000 alone", "0.500 alone"]
    with pytest.raises(InputError, match=r"restitution .*\(0, 1\]"):
        described(restitution={"low": 0.0, "high": 0.5})
    with pytest.raises(InputError, match=r"against_wall.*true or false"):
        described(against_wall="yes")


def test_a_remedy_may_make_it_too_stocky_for_a_wall_to_turn_it_back() -> None:
    wall = described(against_wall=True)
    body = wall.body.wider(5.0)
    assert wall.block_of(body).restitution == 0.0
    assert wall.block_of(wall.body.wider(1.1)).restitution > 0.0


@pytest.mark.slow
def test_a_stocky_object_has_an_answer_though_no_wider_one_rocks() -> None:
    """Three times its width has no restitution by Housner: the assessment ended in an error."""
    geometry = {"width_m": 0.4, "height_m": 1.0}
    options = {"draws": 1, "replicates": 0}
    chest = DescribedObject(
        values={
            "name": "chest",
            "geometry": geometry,
            "demand": {"pga_g": 0.5, "pgv_m_s": 0.9},
            "assessment": options,
        }
    )
    found = assess_object(chest, make_synthetic_suite(4))
    assert found.verdict == "above target"
    (width,) = (each for each in found.remedies if each.name == "width")
    assert width.value is None or width.value < 1.0


def test_a_curve_that_is_nearly_flat_has_infinite_quantiles_and_an_answer() -> None:
    values: dict[str, Any] = {
        "name": "post",
        "geometry": {"width_m": {"low": 0.18, "high": 0.22}, "height_m": 2.4},
        "demand": {"pga_g": 0.3, "pgv_m_s": 0.2},
        "assessment": {"draws": 3, "levels": 6, "replicates": 0, "target_probability": 0.3},
    }
    found = assess_object(DescribedObject(values=values), make_synthetic_suite(2, seed=2))
    assert found.verdict in ("below target", "above target")


def test_an_object_whose_nominal_size_stays_is_told_so() -> None:
    values: dict[str, Any] = {
        "name": "shelf",
        "geometry": {"width_m": {"low": 0.27, "high": 0.33}, "height_m": 1.2},
        "demand": {"pga_g": 0.24, "pgv_m_s": 0.5},
        "assessment": {"draws": 1, "levels": 6, "replicates": 0},
    }
    found = assess_object(DescribedObject(values=values), make_synthetic_suite(4))
    assert found.cases[0].basis == "statics"
    assert found.verdict == "above target"
    (width,) = (each for each in found.remedies if each.name == "width")
    assert "an end of its ranges alone" in width.words
    assert (width.probability, width.trials) == (0.0, None)


def test_tables_of_an_assessment_have_words_on_the_left(found: Assessment) -> None:
    sides = {
        column.heading: column.left for table in found.describe().tables for column in table.columns
    }
    for heading in ("formula", "verdict", "hazard", "what is varied alone", "over"):
        assert sides.pop(heading), heading
    for heading in (
        *("value", "annual rate [1/yr]", "years", "probability in them", "HCLPF"),
        *("lowest probability", "highest"),
    ):
        assert not sides.pop(heading), heading
    values = found.to_dict()
    for row, record in zip(values["inputs"], SUITE, strict=True):
        assert (row["name"], row["dt_s"], row["vertical"]) == (record.name, record.dt_s, False)
        assert row["samples"] == len(record.acceleration_m_s2)
        peak = np.abs(record.acceleration_m_s2).max() / 9.80665
        assert row["pga_g"] == pytest.approx(peak)
    (risk,) = values["risks"]
    assert risk["years"] == 50.0
    assert risk["probability"] == pytest.approx(-math.expm1(-50.0 * risk["annual_rate"]))
