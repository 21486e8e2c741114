"""Fragility of an ensemble: counts by hand, likelihood by hand, gates, pooling, warnings."""

import functools
import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import statsmodels.api as sm
import xarray
from matplotlib.figure import Figure
from scipy.optimize import minimize
from scipy.stats import norm

from rocksteady import Block, Record, Status, compute_fragility, plots, read_record, run_ensemble
from rocksteady.errors import InputError
from rocksteady.measures import Measure
from rocksteady.results.numbers import number, number_or_none
from rocksteady.risk import (
    DamageState,
    FitOptions,
    Fragility,
    FragilityCurve,
    Levels,
    RestitutionBand,
    Ways,
    fit_curve,
    fit_fragility,
)
from rocksteady.risk.fragility._labels_of_runs import kept_measures
from tests.records import ABSENT, FOLDER
from tests.seismic.grounds import ground

BLOCK = Block.rectangle(width=0.4, height=1.6)
OTHER = Block.asymmetric(left=0.25, right=0.4, height=2.4)
LEVELS = (0.3, 0.5, 0.7, 0.9, 1.2, 1.6)
PLAIN = FitOptions(bands=None)
SUITE = tuple(
    Record(
        acceleration_m_s2=ground(seed).acceleration_m_s2,
        dt_s=0.02 * (1.5 + 0.25 * (seed % 6)),
        name=f"ground {seed}",
    )
    for seed in range(12)
)


@functools.cache
def ensemble() -> xarray.Dataset:
    return run_ensemble(
        [BLOCK, OTHER],
        SUITE,
        levels=Levels("p_pgv_per_uplift", LEVELS),
        restitution=RestitutionBand(draws=2),
    )


@functools.cache
def fragility() -> Fragility:
    return fit_fragility(ensemble(), fitting=PLAIN)


def changed(**values: np.ndarray) -> xarray.Dataset:
    found = ensemble().copy(deep=True)
    for name, array in values.items():
        found[name].values[:] = array
    return found


@pytest.mark.slow
def test_points_are_the_counts_of_the_runs() -> None:
    runs = ensemble()
    rules = {
        "uplift": runs.peak_angle > 0.0,
        "theta/alpha > 0.5": (runs.peak_angle > 0.5) | (runs.status == Status.OVERTURNED),
        "overturned": runs.status == Status.OVERTURNED,
    }
    for name, labels in rules.items():
        points = fragility().state(name).points
        assert [point[0] for point in points] == list(LEVELS)
        for level, trials, lifted, failures in points:
            here = labels.sel(level=level)
            assert (trials, failures) == (here.size, int(here.sum()))
            assert lifted == int((runs.peak_angle.sel(level=level) > 0.0).sum())
    # Each state includes the graver ones, level by level.
    columns = [[point[3] for point in each.points] for each in fragility().states]
    for milder, graver in pairwise(columns):
        assert all(one >= other for one, other in zip(milder, graver, strict=True))
    assert sum(columns[-1]) > 20


def test_the_plain_curve_has_the_largest_likelihood_of_the_single_runs() -> None:
    fell = (ensemble().status == Status.OVERTURNED).transpose(..., "level").values.reshape(-1, 6)
    at = np.broadcast_to(LEVELS, fell.shape)

    def surprise(parameters: np.ndarray) -> float:
        z = (np.log(at) - parameters[0]) / math.exp(parameters[1])
        return -float(np.where(fell, norm.logcdf(z), norm.logsf(z)).sum())

    best = minimize(surprise, [0.0, -1.0], method="Nelder-Mead", options={"xatol": 1e-9})
    plain = fragility().state("overturned").plain
    assert plain.median == pytest.approx(math.exp(best.x[0]), rel=1e-5)
    assert plain.beta == pytest.approx(math.exp(best.x[1]), rel=1e-5)
    assert plain.log_likelihood == pytest.approx(-best.fun, rel=1e-9)


def test_the_second_stage_sees_the_runs_that_lift_alone() -> None:
    state = fragility().state("overturned")
    assert state.two_stage is not None
    assert state.curve is state.two_stage.given_uplift  # over a velocity
    lifted = (ensemble().peak_angle > 0.0).values
    assert state.two_stage.given_uplift.trials == int(lifted.sum()) < lifted.size
    assert state.two_stage.uplift.failures == int(lifted.sum())
    assert fragility().state("uplift").two_stage is None
    at = np.array(LEVELS)
    product = state.two_stage.uplift.probability(at) * state.two_stage.given_uplift.probability(at)
    np.testing.assert_allclose(state.two_stage.probability(at), product, rtol=1e-14)


def test_the_gain_is_the_likelihood_of_the_failures_in_two_stages_above_that_of_one() -> None:
    state = fragility().state("theta/alpha > 0.25")
    labels = ensemble().peak_angle > 0.25
    fell = (labels | (ensemble().status == Status.OVERTURNED)).transpose(..., "level").values
    assert state.two_stage is not None
    chance = np.broadcast_to(state.two_stage.probability(LEVELS), fell.shape)
    alone = np.broadcast_to(state.plain.probability(LEVELS), fell.shape)
    two, one = (float(np.log(np.where(fell, p, 1.0 - p)).sum()) for p in (chance, alone))
    assert state.gain == pytest.approx(two - one, rel=1e-9)
    assert fragility().state("uplift").gain is None


@pytest.mark.slow
def test_a_measure_has_one_curve_in_all_answers() -> None:
    kept = [measure for measure in kept_measures(ensemble()) if measure.scales]
    used = set()
    for measure in kept:
        at_one = ensemble()[f"im_{measure.key}"].isel(block=0).values
        levels = np.geomspace(0.5, 8.0, 6) * float(np.median(at_one))
        found = compute_fragility(
            BLOCK,
            SUITE[:6],
            levels=Levels(measure, levels, beside=kept),
            restitution=RestitutionBand(draws=1),
            fitting=PLAIN,
        )
        values = found.to_dict()
        apart = ": one curve, as two stages"
        sentences = [text for text in found.describe().notes if apart in text]
        named = [name for text in sentences for name in text.split(apart)[0].split(", ")]
        (alone,) = (row for row in values["ranking"] if row["measure"] == measure.key)
        state, plain = found.states[-1], values["fits"][-1]
        for state in found.states:
            name, curve = state.state.name, state.curve
            rows = [row for row in values["fits"] if row["damage_state"] == name]
            assert [row["used"] for row in rows] == [True] + [False] * (len(rows) - 1)
            assert rows[0]["median"] == number_or_none(curve.median)
            plain = next(row for row in rows if row["stage"] == "plain")
            assert (plain["stage"] == rows[0]["stage"]) is (curve is state.plain)
            # Over a velocity the curve is that of the runs that lift; otherwise the product is
            # drawn, exported and printed where the gate is exact or it is the likelier one alone.
            stages = state.two_stage
            given = measure.given_uplift and name != "uplift" and stages is not None
            exact = stages is not None and stages.gate is not None
            gains = exact or (state.gain is not None and state.gain > 1e-6)
            assert (stages is not None and curve is stages.given_uplift) is given
            assert (curve is stages) is (gains and not given)
            single = stages is not None and not gains and not given
            assert (name in named) is single
            used.add(type(curve))
            if not single and state is not found.states[-1]:
                continue
            drawn = plots.fragility(found, Figure().add_subplot(), state=name).get_lines()
            thick = max(drawn, key=lambda line: float(line.get_linewidth()))
            x, y = np.asarray(thick.get_data(), dtype=np.float64)
            np.testing.assert_allclose(y, curve.probability(x), atol=1e-12)
        if state.two_stage is None or state.curve is state.plain:
            assert f"{number(alone['median'])}" in found.describe().headline
        for key in ("median", "beta", "stage", "status"):
            assert alone[key] == plain[key], (measure, key)
    assert len(used) == 2


def test_over_pgv_a_curve_is_of_the_runs_whose_pga_lifts() -> None:
    """By hand, of runs of a suite whose records differ in PGV/PGA; points and words agree."""
    levels = Levels(levels=[0.15, 0.3, 0.6, 0.9, 1.4, 2.0])
    assert levels.key == "pgv_m_s"
    runs = run_ensemble(BLOCK, SUITE, levels=levels, restitution=RestitutionBand(draws=1))
    found = fit_fragility(runs, fitting=PLAIN)
    lifts = ((runs.im_pga_g * runs.scale) > math.tan(BLOCK.alpha)).broadcast_like(runs.status)
    lifts = lifts.transpose(*runs.status.dims).values
    fell = (runs.status == Status.OVERTURNED).values
    at = np.broadcast_to(runs.level.values, fell.shape)
    assert runs.status.dims[-1] == "level"
    expected = fit_curve(at[lifts], fell[lifts].astype(int))
    state = found.state("overturned")
    assert 0 < lifts.sum() < lifts.size
    assert state.curve.median == pytest.approx(expected.median, rel=1e-9)
    assert isinstance(state.curve, FragilityCurve)
    assert state.curve.beta == pytest.approx(expected.beta, rel=1e-9)
    row = next(row for row in found.to_dict()["points"] if row["damage_state"] == "overturned"
               and row["level"] == 1.4)  # fmt: skip
    here = lifts & (at == 1.4)
    assert row["share"] == pytest.approx(fell[here].mean())
    assert "given PGA > g tan alpha" in found.describe().headline
    axes = plots.fragility(found, Figure().add_subplot())
    assert axes.get_xlabel() == "PGV [m/s], given PGA > g tan α"
    assert found.state("uplift").plain.trials == found.runs == lifts.size // 2
    assert ("poor fit" in found.describe().headline) is (state.curve.misfit > 0.1)
    poor = fit_curve(np.geomspace(0.1, 3.0, 6), [0, 30, 0, 40, 20, 40], [40] * 6)
    worse = replace(found, states=(replace(state, plain=poor, two_stage=None),))
    words = f"poor fit: up to {number(100.0 * poor.misfit, 2)} points from the counted shares"
    assert worse.describe().headline.endswith(words)


def test_behind_a_gate_two_stages_gain() -> None:
    # None lifts at three levels; at the next half of the runs fall, and then a few more.
    status = np.full(ensemble().status.shape, int(Status.AT_REST), dtype=np.int8)
    order = np.arange(status[..., 0].size).reshape(status.shape[:-1]) % 10
    for level, tenths in ((3, 5), (4, 6), (5, 7)):
        status[..., level] = np.where(order < tenths, Status.OVERTURNED, Status.AT_REST)
    peaks = np.zeros(status.shape)
    peaks[..., 3:] = 0.5
    found = fit_fragility(changed(status=status, peak_angle=peaks), fitting=PLAIN)
    state = found.state("overturned")
    assert state.gain is not None
    assert state.gain > 10.0
    assert state.curve.misfit < 0.5 * state.plain.misfit


def test_a_step_at_one_level_is_not_refuted_by_that_level() -> None:
    gate = math.tan(BLOCK.alpha)
    found = compute_fragility(
        BLOCK,
        SUITE,
        levels=Levels("pga_g", [0.8 * gate, 1.2 * gate, 2.4 * gate], beside=()),
        restitution=RestitutionBand(draws=2),
        fitting=FitOptions(states=[0.05], bands=None),
    )
    (state,) = found.states
    assert state.plain.status == "separated"
    assert state.plain.step == (1.2 * gate, 1.2 * gate)
    assert state.plain.median == 1.2 * gate
    assert state.gain is not None
    assert math.isfinite(state.gain)


def test_records_are_the_groups_however_many_blocks_are_pooled() -> None:
    assert fragility().records == fragility().state("overturned").plain.records == len(SUITE)
    one = fit_fragility(ensemble().isel(block=[0]), fitting=PLAIN)
    assert one.state("overturned").plain.records == len(SUITE)
    assert one.state("overturned").plain.trials * 2 == fragility().states[-1].plain.trials


def test_mirror_images_do_not_move_a_curve() -> None:
    levels, band = Levels(levels=LEVELS, beside=()), RestitutionBand(draws=1)
    both, one = (
        compute_fragility(
            BLOCK, SUITE, levels=levels, restitution=band, ways=Ways(reverse=reverse), fitting=PLAIN
        )
        for reverse in ("both", False)
    )
    assert both.runs == one.runs == len(SUITE) * len(LEVELS)
    for name in ("uplift", "overturned"):
        assert both.state(name).plain.trials == both.runs
        assert both.state(name).plain.median == pytest.approx(one.state(name).plain.median)
        assert both.state(name).plain.beta == pytest.approx(one.state(name).plain.beta, nan_ok=True)


def test_uplift_over_pga_is_a_step_at_g_tan_alpha() -> None:
    gate = math.tan(BLOCK.alpha)
    levels = [0.5 * gate, 0.8 * gate, 1.8 * gate, 2.0 * gate]
    found = compute_fragility(
        BLOCK,
        SUITE,
        levels=Levels("pga_g", levels, beside=()),
        restitution=RestitutionBand(draws=1),
        fitting=PLAIN,
    )
    curve = found.state("uplift").plain
    assert curve.status == "separated"
    assert curve.median == pytest.approx(gate, rel=1e-12)
    assert curve.step == (curve.median, curve.median)
    assert curve.failures * 2 == curve.trials
    second = found.state("theta/alpha > 0.25").two_stage
    assert second is not None
    assert second.uplift.status == "separated"
    assert second.probability([levels[1]]).tolist() == [0.0]


def test_labels_are_neither_sorted_nor_made_monotone() -> None:
    # Fewer falls at the highest level than at the one before.
    status = ensemble().status.values.copy()
    status[..., -1] = np.where(np.arange(status.size // 6).reshape(status.shape[:-1]) % 3, 1, 2)
    status[..., -2] = Status.OVERTURNED
    found = fit_fragility(changed(status=status), fitting=PLAIN)
    points = found.state("overturned").points
    assert points[-2][3] == points[-2][1]
    assert points[-1][3] == points[-1][1] // 3


def test_runs_without_an_answer_are_left_out_and_counted() -> None:
    status = ensemble().status.values.copy()
    status.ravel()[:3] = (Status.LOST_CONTACT, Status.UNDECIDED, Status.LOST_CONTACT)
    found = fit_fragility(changed(status=status), fitting=PLAIN)
    assert found.states[-1].plain.trials == status.size - 3
    assert "3 runs without an answer are left out of the fits" in found.warnings
    status.ravel()[: status.size // 50] = Status.UNDECIDED
    with pytest.raises(InputError, match="without an answer"):
        fit_fragility(changed(status=status))


def test_measures_are_ranked_by_the_likelihood_of_the_same_runs() -> None:
    ranking = fragility().ranking
    assert [each.aic for each in ranking] == sorted(each.aic for each in ranking)
    singles = {each.measure[0].key: each for each in ranking if len(each.measure) == 1}
    assert {"pga_g", "pgv_m_s", "p_pgv_per_uplift", "sa_g", "sa_avg_g"} <= set(singles)
    runs = ensemble()
    reached = (runs.im_pga_g * runs.scale).broadcast_like(runs.status)
    curve = fit_curve(
        reached.transpose(*runs.status.dims).values.ravel(),
        (runs.status == Status.OVERTURNED).values.ravel().astype(int),
    )
    assert singles["pga_g"].median == pytest.approx(curve.median, rel=1e-7)
    assert singles["pga_g"].log_likelihood == pytest.approx(curve.log_likelihood, rel=1e-9)
    assert singles["p_pgv_per_uplift"].beta == pytest.approx(
        fragility().states[-1].plain.beta, rel=1e-7
    )


def test_a_pair_is_as_likely_as_its_better_half_at_least() -> None:
    singles = {
        e.measure[0].key: e.log_likelihood for e in fragility().ranking if len(e.measure) == 1
    }
    pairs = [each for each in fragility().ranking if len(each.measure) == 2]
    named = {tuple(measure.key for measure in each.measure) for each in pairs}
    assert ("pga_g", "pgv_m_s") in named
    assert ("p_pgv_per_uplift", "pgv_per_pga_s") in named
    assert ("sa_avg_g", "significant_5_75_s") in named
    assert len(pairs) == 5 * 2 + 1
    for each in pairs:
        halves = [singles.get(measure.key, -math.inf) for measure in each.measure]
        assert each.log_likelihood >= max(halves) - 1e-6
    # PGA and PGV/PGA hold what PGA and PGV do.
    of = {tuple(m.key for m in each.measure): each.log_likelihood for each in pairs}
    assert of["pga_g", "pgv_m_s"] == pytest.approx(of["pga_g", "pgv_per_pga_s"], rel=1e-6)
    # One record has one PGV/PGA: no pair.
    single = fit_fragility(ensemble().isel(record=[0]), fitting=PLAIN)
    assert not any(
        measure.key == "pgv_per_pga_s" for each in single.ranking for measure in each.measure
    )


def test_curves_of_plain_factors_are_over_the_default_measure() -> None:
    found = compute_fragility(
        BLOCK,
        SUITE,
        levels=Levels("scale", [0.5, 1.0, 2.0, 4.0]),
        restitution=RestitutionBand(draws=1),
        fitting=PLAIN,
    )
    assert found.measure == Measure("pgv_m_s")
    assert found.scale_factor_max == 4.0
    reached = found.ensemble.im_pgv_m_s * found.ensemble.scale
    plain = found.states[-1].plain
    assert plain.sampled == pytest.approx((float(reached.min()), float(reached.max())))
    lifted = int((found.ensemble.peak_angle > 0.0).sum())
    assert sum(point[1] for point in found.states[-1].points) == lifted // 2  # of one direction
    assert sum(point[1] for point in found.states[0].points) == found.runs


def test_a_measure_that_is_not_beside_the_runs_is_named() -> None:
    runs = run_ensemble(
        BLOCK,
        SUITE[:2],
        levels=Levels("pga_g", [0.3, 0.6], beside=()),
        restitution=RestitutionBand(draws=1),
    )
    with pytest.raises(InputError, match="no such measure beside it; it has pga_g"):
        fit_fragility(runs, fitting=FitOptions(measures=[Measure("pgv_m_s")], bands=None))
    with pytest.raises(InputError, match="is no ensemble"):
        fit_fragility(runs.drop_attrs())


def test_the_description_has_a_row_for_every_curve() -> None:
    values = fragility().to_dict()
    stages = [(row["damage_state"], row["stage"]) for row in values["fits"]]
    assert stages[0] == ("uplift", "plain")
    assert stages[-4:] == [
        ("overturned", stage) for stage in ("given-uplift", "two-stage", "uplift", "plain")
    ]
    row = values["fits"][-1]
    assert row["median"] == fragility().states[-1].plain.median
    assert row["measure"] == values["measure"] == "p_pgv_per_uplift"
    assert values["records"] == 12
    assert values["runs"] == 12 * 6 * 2 * (1 + 2)
    assert len(values["points"]) == 5 * 6
    text = fragility().summary(more=True)
    assert "overturned" in text
    assert sum("12 records" in warning for warning in fragility().warnings) == 1


def test_a_state_of_ones_own() -> None:
    found = fit_fragility(
        ensemble(), fitting=FitOptions(states=[DamageState("contents", 0.1), 0.3], bands=None)
    )
    assert [each.state.name for each in found.states] == ["contents", "theta/alpha > 0.3"]
    with pytest.raises(InputError, match="the damage states are contents"):
        found.state("overturned")


@pytest.mark.slow
def test_the_suite_gives_the_published_curve() -> None:
    """Median .672 and beta .462 of 3,360 runs, and the shares by bins of the measure."""
    files = sorted((FOLDER / "suite_at2").glob("*.AT2"))
    if not files:
        pytest.skip(ABSENT)
    blocks = [Block.from_p(alpha=a, p=p) for a in (0.1, 0.2, 0.3) for p in (1.0, 1.5, 2.0, 3.0)]
    runs = run_ensemble(
        blocks,
        [read_record(file) for file in files],
        levels=Levels("scale", [1.0, 2.0, 4.0, 8.0, 16.0]),
        restitution=RestitutionBand(draws=1),
    )
    found = fit_fragility(runs, fitting=PLAIN)
    assert found.ranking[0].measure[0] == Measure("p_pgv_per_uplift")
    reached = (runs.im_p_pgv_per_uplift * runs.scale).broadcast_like(runs.status)
    reached = reached.transpose(*runs.status.dims).values
    lifted, fell = runs.peak_angle.values > 0.0, runs.status.values == Status.OVERTURNED
    given_uplift = fit_curve(reached[lifted], fell[lifted].astype(int))
    assert given_uplift.median == pytest.approx(0.672, abs=5e-4)
    assert given_uplift.beta == pytest.approx(0.462, abs=5e-4)
    for low, high, share in (
        (0.2, 0.3, 0.000),
        (0.3, 0.4, 0.078),
        (0.4, 0.5, 0.156),
        (0.5, 0.7, 0.424),
        (0.7, 1.0, 0.679),
        (1.0, 1.5, 0.897),
        (1.5, 2.0, 0.969),
    ):
        here = lifted & (reached >= low) & (reached < high)
        assert fell[here].mean() == pytest.approx(share, abs=5e-4), (low, high)


def fits_by_peaks(ensemble: xarray.Dataset, *names: str) -> Any:
    """Return the fit of statsmodels to the runs that lift."""
    runs = ensemble.stack(run=("block", "record", "direction", "vertical", "draw", "level"))
    lifted = runs.isel(run=runs.peak_angle.values > 0.0)
    peaks = np.stack([lifted[f"im_{name}"] * lifted["scale"] for name in names])
    fell = (lifted.status == Status.OVERTURNED).values
    probit = sm.families.Binomial(sm.families.links.Probit())
    return sm.GLM(fell, sm.add_constant(np.log(peaks.T)), family=probit).fit(tol=1e-13)


def test_the_surface_is_a_fit_to_the_single_runs_that_lift() -> None:
    oracle, surface = fits_by_peaks(ensemble(), "pga_g", "pgv_m_s"), fragility().surface
    assert surface is not None
    assert (surface.names, surface.trials) == (("PGA", "PGV"), oracle.nobs)
    assert surface.coefficients == pytest.approx(oracle.params, rel=1e-6)
    share = fragility().by_both_peaks(0.4, 0.5)
    assert share == pytest.approx(oracle.predict([1.0, math.log(0.4), math.log(0.5)])[0])
    assert fragility().by_both_peaks(None, 0.5) is None
    assert fragility().by_both_peaks(0.4, None) is None


def test_what_both_peaks_explain_stands_beside_what_one_of_them_does() -> None:
    levels, draws = Levels("scale", [0.5, 1.0, 2.0, 4.0]), RestitutionBand(draws=1)
    found = compute_fragility(BLOCK, SUITE, levels=levels, restitution=draws, fitting=PLAIN)
    for each, measures in (
        (fragility(), [["pga_g", "pgv_m_s"]]),
        (found, [["pga_g", "pgv_m_s"], ["pgv_m_s"]]),
    ):
        fits = [fits_by_peaks(each.ensemble, *names) for names in measures]
        explained = [100.0 * (1.0 - fit.deviance / fit.null_deviance) for fit in fits]
        words = "explain {:.2g} % of the deviance" + ", PGV alone {:.2g} %" * (len(fits) > 1)
        assert each.surface_words == words.format(*explained)


def test_without_two_independent_peaks_or_a_fall_there_is_no_surface() -> None:
    rests = {"peak_angle": np.array(0.0), "status": np.array(int(Status.AT_REST))}
    still = fit_fragility(changed(**rests), fitting=PLAIN)
    assert (still.surface, still.surface_words, still.by_both_peaks(1.0, 1.0)) == (None, "", None)
    lifting = FitOptions(bands=None, states=["uplift"])
    assert fit_fragility(ensemble(), fitting=lifting).surface is None
    alike = fit_fragility(ensemble().isel(record=[0], block=[0]), fitting=PLAIN)
    assert alike.surface is None
    without = fit_fragility(ensemble().drop_vars("im_pga_g"), fitting=PLAIN)
    assert without.surface is None
