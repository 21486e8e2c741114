"""Balanced rocks: survival over an unsure alpha, verdicts, weights."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from rocksteady import Block, compute_fragility, compute_risk
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.risk import HazardCurve, Levels, RestitutionBand, check_hazard_branches
from tests.every import every

K, MEDIAN, BETA = 2.2, 0.4, 0.5


def branch(size: float, **known: Any) -> HazardCurve:
    levels = np.geomspace(1e-7, 1e6, 6)
    return HazardCurve(measure="pgv_m_s", levels=levels, rates=size * levels**-K, **known)


def test_a_sure_alpha_rejects_at_the_confidence_of_age_and_rate() -> None:
    curves = [branch(1e-5), branch(1e-4), branch(1e-3)]
    found = check_hazard_branches((MEDIAN, BETA), curves, 2000.0, alpha_cv=0.0)
    rates = [compute_risk((MEDIAN, BETA), curve).annual_rate for curve in curves]
    assert found.annual_rates == pytest.approx(rates, rel=1e-12)
    assert found.confidence == pytest.approx(1.0 - np.exp(-2000.0 * np.array(rates)), rel=1e-9)
    assert found.rejected.tolist() == [False, False, True]


@every("cv", [0.05, 0.2])
@every("age", [300.0, 10_000.0])
def test_survival_is_averaged_over_alpha(cv: float, age: float) -> None:
    """Under a power law the rate goes with alpha^-k: one integral, by adaptive quadrature."""
    rate = 1e-4 * MEDIAN**-K * math.exp(0.5 * (K * BETA) ** 2)
    sigma = math.sqrt(math.log1p(cv**2))
    mean, _ = quad(
        lambda z: norm.pdf(z) * math.exp(-age * rate * math.exp(-K * sigma * z)),
        -12.0,
        12.0,
        epsabs=1e-14,
        limit=500,
    )
    found = check_hazard_branches((MEDIAN, BETA), [branch(1e-4)], age, alpha_cv=cv)
    assert found.survival == pytest.approx([mean], rel=1e-9, abs=1e-12)
    assert found.annual_rates == pytest.approx([rate * math.exp(0.5 * (K * sigma) ** 2)], rel=1e-9)
    # Survival is convex in the rate: an unsure alpha makes it likelier than at the mean rate.
    assert found.survival[0] > math.exp(-age * found.annual_rates[0])


def test_counted_shares_give_the_rates_and_the_survival() -> None:
    """A surer alpha leaves the rate of the counts; a wider one moves them by a factor of levels."""
    fragility = compute_fragility(
        Block.rectangle(width=0.4, height=1.6),
        make_synthetic_suite(12),
        levels=Levels("pgv_m_s"),
        restitution=RestitutionBand(draws=1),
    )
    curve = branch(1e-4)
    risk = compute_risk(fragility, curve)
    sure = check_hazard_branches(fragility, [curve], 500.0, alpha_cv=0.0)
    assert sure.annual_rates == pytest.approx([risk.annual_rate], rel=1e-12)
    assert sure.survival == pytest.approx([math.exp(-500.0 * risk.annual_rate)], rel=1e-12)
    sigma = math.sqrt(math.log1p(0.2**2))
    unsure = check_hazard_branches(fragility, [curve], 500.0, alpha_cv=0.2)
    expected = risk.annual_rate * math.exp(0.5 * (K * sigma) ** 2)  # rates go with alpha^-k
    assert unsure.annual_rates == pytest.approx([expected], rel=1e-3)


def test_weights_follow_bayes() -> None:
    curves = [branch(2e-5, weight=0.2, name="a"), branch(1e-4, weight=0.8, name="b")]
    found = check_hazard_branches((MEDIAN, BETA), curves, 1000.0)
    assert found.prior.tolist() == [0.2, 0.8]
    joint = found.prior * found.survival
    assert found.posterior == pytest.approx(joint / joint.sum(), rel=1e-12)
    assert found.posterior[0] > 0.2
    equal = [dataclasses.replace(curve, weight=None) for curve in curves]
    assert check_hazard_branches((MEDIAN, BETA), equal, 1000.0).prior.tolist() == [0.5, 0.5]


def test_a_short_life_tells_nothing_and_an_endless_one_leaves_no_branch() -> None:
    curves = [branch(1e-5, weight=0.5), branch(1e-4, weight=0.5)]
    young = check_hazard_branches((MEDIAN, BETA), curves, 1e-6)
    assert young.posterior == pytest.approx([0.5, 0.5], abs=1e-8)
    assert not young.rejected.any()
    old = check_hazard_branches((MEDIAN, BETA), curves, 1e9)
    assert old.rejected.all()
    assert old.survival == pytest.approx([0.0, 0.0], abs=1e-12)
    assert old.to_dict()["rejected_weight"] == 1.0


def test_a_fragility_of_the_block_meets_the_hazard_of_the_ground() -> None:
    block = Block.rectangle(width=0.32, height=1.8)
    of_block = check_hazard_branches(
        (0.757, BETA), [branch(1e-4)], 1000.0, measure="p_pgv_per_uplift", block=block
    )
    factor = block.positive.p / (9.80665 * 0.32 / 1.8)
    of_ground = check_hazard_branches((0.757 / factor, BETA), [branch(1e-4)], 1000.0)
    assert of_block.survival == pytest.approx(of_ground.survival, rel=1e-9)


@every(
    ("changed", "line"),
    [
        ({"branches": []}, "there must be one or more"),
        ({"age_years": 0.0}, "age_years = 0.0 is not valid"),
        ({"alpha_cv": -0.1}, "alpha_cv = -0.1 is not valid"),
        ({"level": 1.0}, "level = 1.0 is not valid"),
        ({"branches": [branch(1e-4), branch(1e-4, weight=0.5)]}, "all have one, or none"),
        (
            {"branches": [branch(1e-4), dataclasses.replace(branch(1e-4), measure="pga_g")]},
            "they must be of one measure",
        ),
        (
            {"branches": [branch(1e-4, site=(1.0, 2.0)), branch(1e-4, site=(1.0, 3.0))]},
            "the object stands at one site",
        ),
        ({"measure": "pga_g"}, "fit the fragility over pgv_m_s"),
    ],
)
def test_what_cannot_be_tested_is_refused(changed: dict[str, Any], line: str) -> None:
    given: dict[str, Any] = {
        "fragility": (MEDIAN, BETA), "branches": [branch(1e-4)], "age_years": 1000.0,
    }  # fmt: skip
    with pytest.raises(InputError) as refusal:
        check_hazard_branches(**{**given, **changed})
    assert line in str(refusal.value)


def test_an_age_is_required() -> None:
    with pytest.raises(InputError, match="age_years"):
        check_hazard_branches((MEDIAN, BETA), [branch(1e-4)])  # type: ignore[call-arg]
