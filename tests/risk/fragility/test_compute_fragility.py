"""Counted shares of damage states: run by run, nested, with friction, in any order of records."""

import functools
import math
from itertools import pairwise, product
from typing import Any

import numpy as np
import pytest
import xarray
from scipy.optimize import minimize
from scipy.stats import norm

from rocksteady import (
    BaseMotion,
    Block,
    Linear,
    Status,
    compute_fragility,
    read_record,
    run_ensemble,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.measures import Measure
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import (
    DamageState,
    Fragility,
    Levels,
    RestitutionBand,
    count_fragility,
    fit_curve,
)
from rocksteady.risk.screens.friction import needed_friction
from tests.every import every
from tests.records import ABSENT, FOLDER
from tests.risk.counted.recorded import G, the_floor

SUITE = make_synthetic_suite(12, seed=6)
BLOCK = Block.rectangle(width=0.4, height=1.6)
OTHER = Block.asymmetric(left=0.25, right=0.4, height=2.4)
LEVELS = (0.2, 0.3, 0.5, 0.7, 1.0, 1.6)
PGA = Levels("pga_g", LEVELS, beside=())
ONE, TWO = RestitutionBand(draws=1), RestitutionBand(draws=2)
RULES: dict[str, Any] = {
    "uplift": lambda peak, fell: peak > 0.0 or fell,
    "theta/alpha > 0.25": lambda peak, fell: peak > 0.25 or fell,
    "theta/alpha > 0.5": lambda peak, fell: peak > 0.5 or fell,
    "theta/alpha > 1": lambda peak, fell: peak > 1.0 or fell,
    "overturned": lambda peak, fell: fell,  # noqa: ARG005
}


@functools.cache
def ensemble() -> xarray.Dataset:
    return run_ensemble([BLOCK, OTHER], SUITE, levels=PGA, restitution=TWO)


@functools.cache
def fragility() -> Fragility:
    return count_fragility(ensemble())


def shares_of(found: Fragility) -> np.ndarray:
    """Return counted shares, shape (states, levels)."""
    return np.array([each.curve.shares for each in found.states])


def test_shares_are_the_counts_of_the_runs_one_by_one() -> None:
    runs = ensemble()
    assert [each.state.name for each in fragility().states] == list(RULES)
    for (name, rule), (place, level) in product(RULES.items(), enumerate(LEVELS)):
        here = runs.sel(level=level)
        reached = [
            rule(peak, status == Status.OVERTURNED)
            for peak, status in zip(
                here["peak_angle"].values.ravel().tolist(),
                here["status"].values.ravel().tolist(),
                strict=True,
            )
        ]
        count = fragility().state(name).curve.counts[place]
        assert (count.falls, count.runs) == (sum(reached), len(reached))
        assert count.share == pytest.approx(sum(reached) / len(reached))
    assert fragility().records == len(SUITE)
    assert fragility().runs == runs["status"].size
    assert fragility().measure == Measure("pga_g")


def test_states_are_nested_at_every_level_and_so_are_their_curves() -> None:
    aside = Block.asymmetric(left=0.25, right=0.3, height=2.4)
    pairs = [BaseMotion(a, b.scaled(0.4)) for a, b in zip(SUITE, reversed(SUITE), strict=True)]
    led = [the_floor().motion(each) for each in SUITE]
    at = np.geomspace(0.05, 5.0, 300)
    for block, motions in ((BLOCK, [*SUITE]), (aside, pairs), (BLOCK, led)):
        found = compute_fragility(block, motions, levels=Levels("pga_g"), restitution=TWO)
        for milder, graver in pairwise(found.states):
            for one, other in zip(milder.curve.counts, graver.curve.counts, strict=True):
                assert (one.fell >= other.fell).all()
            assert (milder.curve.steps >= graver.curve.steps - 1e-12).all()
            assert (milder.share(at) >= graver.share(at) - 1e-12).all()
        assert found.states[-1].curve.shares[-1] > 0.5


def test_uplift_is_the_step_of_all_thresholds_and_never_a_fit() -> None:
    state = fragility().state("uplift")
    slopes = sorted(math.tan(side.alpha) for side in (BLOCK.positive, BLOCK.negative,
                                                      OTHER.positive, OTHER.negative))  # fmt: skip
    at = state.curve.lifts_at
    assert len(at) == 2 * len(SUITE) * 2  # blocks, records, signs
    assert (at >= slopes[0] * (1.0 - 1e-12)).all()
    assert at[0] == pytest.approx(slopes[0], rel=1e-9)
    np.testing.assert_allclose(state.share(np.array(LEVELS)), state.curve.shares, atol=1e-15)
    for place in range(1, len(at)):
        if at[place] > at[place - 1] * (1.0 + 1e-9):
            middle = 0.5 * (at[place - 1] + at[place])
            assert state.share(middle) == pytest.approx(place / len(at))


@every("measure", ["pgv_m_s", "p_pgv_per_uplift", "pga_per_uplift", "scale"])
def test_thresholds_are_in_the_measure_of_the_levels(measure: str) -> None:
    levels = Levels(measure, [0.3, 0.6, 1.2, 2.4])
    found = compute_fragility(OTHER, SUITE, levels=levels, restitution=ONE)
    assert (found.measure is None) == (measure == "scale")
    assert found.key == levels.key
    state = found.state("uplift")
    np.testing.assert_allclose(state.share(state.curve.levels), state.curve.shares, atol=1e-15)
    ones = levels.at_scale_one([*SUITE], [OTHER])[0]
    tops = [each.acceleration_m_s2.max() / G for each in SUITE]
    lows = [-each.acceleration_m_s2.min() / G for each in SUITE]
    slopes = (math.tan(OTHER.positive.alpha), math.tan(OTHER.negative.alpha))
    expected = [
        one * min(slopes[0] / one_way, slopes[1] / other_way)
        for one, high, low in zip(ones, tops, lows, strict=True)
        for one_way, other_way in ((high, low), (low, high))
    ]
    np.testing.assert_allclose(state.curve.lifts_at, sorted(expected), rtol=1e-9)


def test_the_order_of_records_blocks_and_levels_is_of_no_account() -> None:
    random = np.random.default_rng(4)
    turned = run_ensemble(
        [OTHER, BLOCK],
        [SUITE[k] for k in random.permutation(len(SUITE))],
        levels=Levels("pga_g", LEVELS, beside=()),
        restitution=TWO,
    )
    upside = turned.isel(level=slice(None, None, -1))
    for other in (count_fragility(turned), count_fragility(upside)):
        np.testing.assert_array_equal(shares_of(other), shares_of(fragility()))
        for one, two in zip(fragility().states, other.states, strict=True):
            assert [each.band for each in one.curve.counts] == [
                each.band for each in two.curve.counts
            ]
            np.testing.assert_allclose(one.curve.lifts_at, two.curve.lifts_at, rtol=1e-12)


def test_the_lognormal_has_the_largest_likelihood_of_the_single_runs() -> None:
    runs = ensemble()
    fell = (runs["status"] == Status.OVERTURNED).transpose(..., "level").values
    fell = fell.reshape(-1, len(LEVELS))
    at = np.broadcast_to(LEVELS, fell.shape)

    def surprise(parameters: np.ndarray) -> float:
        z = (np.log(at) - parameters[0]) / math.exp(parameters[1])
        return -float(np.where(fell, norm.logcdf(z), norm.logsf(z)).sum())

    best = minimize(surprise, [0.0, -1.0], method="Nelder-Mead", options={"xatol": 1e-9})
    lognormal = fragility().state("overturned").lognormal
    assert lognormal.median == pytest.approx(math.exp(best.x[0]), rel=1e-5)
    assert lognormal.beta == pytest.approx(math.exp(best.x[1]), rel=1e-5)
    curve = norm.cdf(np.log(np.array(LEVELS) / lognormal.median) / lognormal.beta)
    assert lognormal.misfit == pytest.approx(np.abs(curve - fell.mean(axis=0)).max())


def test_no_answer_changes_where_a_lognormal_would() -> None:
    """The share at a level is its count, however badly a curve would fit."""
    odd = ensemble().copy(deep=True)
    status = odd["status"].transpose(..., "level").values
    status[..., 2] = Status.OVERTURNED
    status[..., 3] = Status.AT_REST
    odd["status"].values[:] = status
    odd["peak_angle"].values[:] = 0.9
    state = count_fragility(odd).state("overturned")
    assert state.curve.shares[2:4].tolist() == [1.0, 0.0]
    assert not state.curve.is_monotone
    assert state.share(LEVELS[2]) == state.share(LEVELS[3]) > 0.4
    assert not state.is_lognormal


@pytest.mark.parametrize("model", [None, Linear()])
def test_an_ensemble_of_either_model_is_counted(model: Linear | None) -> None:
    runs = run_ensemble(BLOCK, SUITE[:4], levels=PGA, restitution=ONE, model=model)
    found = count_fragility(runs)
    assert type(found.model).__name__ == ("Linear" if model else "Nonlinear")
    uplift = found.state("uplift")
    np.testing.assert_allclose(uplift.share(np.array(LEVELS)), uplift.curve.shares, atol=1e-15)


def test_a_state_of_ones_own() -> None:
    found = count_fragility(ensemble(), states=[DamageState("contents", 0.1), 0.3])
    assert [each.state.name for each in found.states] == ["contents", "theta/alpha > 0.3"]
    with pytest.raises(InputError, match="the damage states are contents"):
        found.state("overturned")
    with pytest.raises(InputError, match="each once"):
        compute_fragility(BLOCK, SUITE, states=["uplift", "uplift"])


def test_what_is_no_ensemble_is_refused() -> None:
    with pytest.raises(InputError, match="is no ensemble: it must come from run_ensemble"):
        count_fragility(ensemble().assign_attrs(kind="map"))


# ------------------------------------------------------------------------- runs without an answer


def lost(count: int, level: int) -> xarray.Dataset:
    """Return 240 runs a level, of which some at a level have no answer."""
    band = RestitutionBand(draws=5)
    runs = run_ensemble([BLOCK, OTHER], SUITE, levels=PGA, restitution=band).copy(deep=True)
    turned = runs["status"].transpose(..., "level")
    status = turned.values.copy()
    flat = status[..., level].ravel()
    flat[:count] = Status.LOST_CONTACT
    status[..., level] = flat.reshape(status[..., level].shape)
    runs["status"] = (turned.dims, status)
    return runs


def test_levels_end_before_one_at_which_over_a_hundredth_of_the_runs_has_no_answer() -> None:
    kept = count_fragility(lost(2, 3))
    assert kept.states[0].curve.levels.tolist() == list(LEVELS)
    assert [each.without for each in kept.states[-1].curve.counts] == [0, 0, 0, 2, 0, 0]
    found = count_fragility(lost(3, 3))
    assert found.states[0].curve.levels.tolist() == list(LEVELS[:3])
    assert found.ensemble.sizes["level"] == 3
    assert any("The levels end at 0.5: above it more than 1%" in each for each in found.warnings)
    assert found.runs == 3 * 240
    with pytest.raises(InputError, match="of its runs without an answer at its lowest level"):
        count_fragility(lost(3, 0))


# ------------------------------------------------------------------------------------- friction


def test_the_friction_that_is_needed_is_that_of_the_strongest_record_where_half_fall() -> None:
    """At the first level at which half fall, or at the last one where no level has a half."""
    found = compute_fragility([BLOCK, OTHER], SUITE, levels=PGA, restitution=ONE)
    steps = found.state("overturned").curve.steps
    level = next(each for each, share in zip(LEVELS, steps, strict=True) if share >= 0.5)
    assert LEVELS[0] < level < LEVELS[-1]
    needs = [needed_friction(block, level).largest for block in (BLOCK, OTHER)]
    assert found.friction is None
    assert found.friction_needed == pytest.approx(max(needs), rel=1e-12)
    velocity = Levels("pgv_m_s", [0.1, 0.15], beside=())
    found = compute_fragility(BLOCK, SUITE, levels=velocity, restitution=ONE)
    assert found.states[-1].half is None
    factors = [0.15 / one for one in velocity.at_scale_one([*SUITE], [BLOCK])[0]]
    peaks = [f * each.peak_acceleration_m_s2 / G for f, each in zip(factors, SUITE, strict=True)]
    assert found.friction_needed == pytest.approx(
        needed_friction(BLOCK, max(peaks)).largest, rel=1e-9
    )


def test_with_a_friction_the_levels_end_where_it_would_slide() -> None:
    for levels in (PGA, Levels("pga_g", beside=())):
        free = compute_fragility(BLOCK, SUITE, levels=levels, restitution=ONE)
        held = compute_fragility(BLOCK, SUITE, levels=levels, restitution=ONE, friction=0.4)
        given = free.states[0].curve.levels
        rocking = [needed_friction(BLOCK, level).largest <= 0.4 for level in given]
        assert 0 < sum(rocking) < len(given)
        kept = held.states[0].curve.levels
        assert kept.tolist() == given[rocking].tolist()
        np.testing.assert_array_equal(shares_of(held), shares_of(free)[:, rocking])
        assert held.friction == 0.4
        assert (held.friction_needed or 1.0) <= 0.4
        assert any("slides under the strongest record" in each for each in held.warnings)
    high = compute_fragility(BLOCK, SUITE, levels=PGA, restitution=ONE, friction=3.0)
    np.testing.assert_array_equal(
        shares_of(high), shares_of(compute_fragility(BLOCK, SUITE, levels=PGA, restitution=ONE))
    )
    for levels, friction in ((PGA, 0.2), (Levels("pga_g", [0.95, 1.6], beside=()), 0.4)):
        with pytest.raises(ModelError, match="slides"):  # no level is left
            compute_fragility(BLOCK, SUITE, levels=levels, friction=friction)


# ------------------------------------------------------------------------------ published curve


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
        restitution=ONE,
    )
    at = (runs["im_p_pgv_per_uplift"] * runs["scale"]).broadcast_like(runs["status"])
    reached = at.transpose(*runs["status"].dims).values
    lifted = runs["peak_angle"].values > 0.0
    fell = runs["status"].values == Status.OVERTURNED
    given_uplift = fit_curve(reached[lifted], fell[lifted].astype(int))
    assert given_uplift.median == pytest.approx(0.672, abs=5e-4)
    assert given_uplift.beta == pytest.approx(0.462, abs=5e-4)
    for low, high, share in (
        (0.2, 0.3, 0.000), (0.3, 0.4, 0.078), (0.4, 0.5, 0.156), (0.5, 0.7, 0.424),
        (0.7, 1.0, 0.679), (1.0, 1.5, 0.897), (1.5, 2.0, 0.969),
    ):  # fmt: skip
        here = lifted & (reached >= low) & (reached < high)
        assert fell[here].mean() == pytest.approx(share, abs=5e-4)
    found = count_fragility(runs)
    assert found.measure is None
    assert found.state("overturned").curve.counts[0].runs == 12 * len(files)
