"""Verdicts on parameters, each from its own limit on; bounds; priors that tests contradict."""

import itertools
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rocksteady.calibration import ObjectPrior, OutcomeErrors, PriorRange
from rocksteady.errors import InputError
from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.risk.calibration import identified
from rocksteady.risk.calibration.identified import CROWD, contradictions, parameters_of
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.space import Space
from tests.every import every

PRIOR = np.linspace(0.0, 1.0, 2001)
BOTH = np.array([1.0, 0.0, np.nan])


@dataclass(frozen=True, kw_only=True, eq=False)
class One(Space):
    """A space of one number, whatever its prior."""

    one: str

    @property
    def names(self) -> tuple[str, ...]:
        return (self.one,)

    def derived(self, values: np.ndarray) -> dict[str, np.ndarray]:  # noqa: ARG002
        return {}


def posterior(values: np.ndarray, name: str = "alpha_rad", weights: Any = None) -> Posterior:
    """Return draws of one number, of equal weights by default, and an error at its prior."""
    count = len(values)
    equal = np.full(count, 1.0 / count) if weights is None else weights
    error = np.tile([0.1, 0.02], (count, 1))
    return Posterior(
        object="vase",
        space=One(block=ObjectPrior(name="vase", alpha_rad=0.3, p_rad_s=3.0), one=name),
        values=values[:, np.newaxis],
        weights=equal,
        prior_weights=equal,
        errors={"sigma_ln": error},
        noise={"sigma_ln": PriorRange.between(0.05, 0.12)},
    )


def rows(
    values: np.ndarray,
    fell: np.ndarray = BOTH,
    name: str = "alpha_rad",
    ends: Any = None,
    **keys: Any,
) -> Any:
    prior = {name: PRIOR, "sigma_ln": np.linspace(0.0, 0.2, 101)}
    return parameters_of(posterior(values, name, **keys), prior, fell, ends or {}, 0.31)


@every(
    ("part", "verdict"),
    zip((0.49, 0.51, 0.69, 0.71), ("IDENTIFIED", "NARROWED", "NARROWED", "RETURNED"), strict=True),
)
def test_a_number_is_identified_below_half_of_its_prior(part: float, verdict: str) -> None:
    values = 0.5 + part * (PRIOR - 0.5)
    found, error = rows(values)
    assert found["sd_ratio"] == pytest.approx(part)
    assert found["verdict"] == getattr(identified, verdict)
    assert (found["prior_low"], found["prior_high"]) == pytest.approx((0.05, 0.95))
    ends = np.array([found["low"], found["median"], found["high"]])
    assert ends == pytest.approx(0.5 + 0.45 * part * np.array([-1.0, 0.0, 1.0]), abs=1e-3)
    assert (found["bound"], found["bound_side"], found["outline"]) == (None, None, 0.31)
    assert rows(values, ends={"alpha_rad": "lower"})[0]["verdict"] == identified.LIMIT
    # An error: normal about its mean, inside its prior.
    assert (error["parameter"], error["verdict"]) == ("sigma_ln", identified.IDENTIFIED)
    assert (error["median"], error["low"]) == pytest.approx((0.1, 0.1 - 1.645 * 0.02), abs=1e-4)
    assert (error["high"], error["sd_ratio"]) == pytest.approx((0.12, 0.02 / 0.0583), rel=0.01)


@every(("fell", "side", "bound"), [(1.0, "upper", 0.9), (0.0, "lower", 0.1)])
def test_outcomes_of_one_kind_bound_alpha_at_nine_tenths(
    fell: float, side: str, bound: float
) -> None:
    found, _ = rows(PRIOR, np.array([fell, fell, np.nan]))
    assert (found["verdict"], found["bound_side"]) == (identified.BOUND, side)
    assert found["bound"] == pytest.approx(bound, abs=1e-3)
    other, _ = rows(PRIOR, np.array([fell, fell]), name="p_rad_s")
    assert (other["verdict"], other["bound"]) == (identified.RETURNED, None)
    assert rows(PRIOR, np.array([np.nan]))[0]["bound"] is None


def test_below_two_hundred_effective_draws_nothing_is_identified() -> None:
    for effective, known in ((199, False), (201, True)):
        weights = np.zeros(len(PRIOR))
        weights[:effective] = 1.0 / effective
        found, error = rows(PRIOR, weights=weights)
        assert (found["verdict"] != NOT_IDENTIFIED) is known
        assert (found["sd_ratio"] is not None) is known
        assert (found["median"] is not None) is (error["low"] is not None) is known
        one, _ = rows(PRIOR, np.array([1.0]), weights=weights)
        assert (one["verdict"] == identified.BOUND) is known
        assert posterior(PRIOR, weights=weights).effective_draws == pytest.approx(effective)
    with pytest.raises(InputError, match="there are alpha_rad; give one of them"):
        posterior(PRIOR).interval("beta")
    heavy = np.random.default_rng(1).pareto(1.1, 2001) + 1e-3
    assert not posterior(PRIOR, weights=heavy / heavy.sum()).identified  # k above 0.7


def fit_of(values: np.ndarray, block: ObjectPrior, cells: Any = 0.0, fell: Any = BOTH) -> Any:
    """Return what contradictions need of a fit of draws of equal weight."""
    count, grid = len(values), np.zeros((3, 5, 2))
    tests = [SimpleNamespace(fell=None if np.isnan(end) else bool(end)) for end in fell]
    return SimpleNamespace(
        bench=SimpleNamespace(space=Space(block=block), tests=tests),
        weights=np.full(count, 1.0 / count),
        values=values[:, np.newaxis],
        base=np.zeros(count),
        cells=np.broadcast_to(grid + cells, (count, 3, 5, 2)),
        likelihood=SimpleNamespace(grid=grid, noise=OutcomeErrors()),
    )


EXACT: dict[str, Any] = {"alpha_rad": 0.2, "p_rad_s": 3.0, "scatter": 0.0}


def test_a_prior_is_contradicted_where_its_ends_have_grown_tenfold() -> None:
    """Odds of 1 % of the prior at an end: 1 to 99 before, and beyond 10 to 99 after."""
    block = ObjectPrior(name="a", **EXACT, housner_factor="0.8:1.2")
    for count, grown in ((80, False), (100, True)):
        low = np.concatenate([np.full(count, 0.803), np.linspace(0.81, 1.19, 1000 - count)])
        expected = {"housner_factor": "lower"} if grown else {}
        assert contradictions(fit_of(low, block)) == expected
        assert (contradictions(fit_of(2.0 - low, block)) == {"housner_factor": "upper"}) == grown
    pushed = fit_of(np.full(400, 0.801), block)
    assert contradictions(pushed) == {"housner_factor": "lower"}
    pushed.weights = np.where(np.arange(400) < 49, 1.0 / 49.0, 0.0)  # too few draws
    assert contradictions(pushed) == {}
    assert contradictions(fit_of(np.full(400, 0.801), block, fell=[1.0, np.nan])) == {}
    widest = ObjectPrior(name="a", **EXACT, housner_factor="0.1:2.0")
    assert contradictions(fit_of(np.full(400, 0.1001), widest)) == {}


def test_an_error_at_the_end_of_its_prior_is_contradicted() -> None:
    """Where its density goes on, its outer 1 % has tenfold odds; two nodes lie far from the end."""
    block = ObjectPrior(name="a", **EXACT, housner_factor="0.8:1.2")
    values = np.linspace(0.801, 1.199, 400)
    factors = {"sigma_ln": 48.1, "session_ln": CROWD, "outliers": 321.2}
    ends = ((0, "lower"), (-1, "upper"))
    for (axis, name), (place, side) in itertools.product(enumerate(factors), ends):
        for share in (0.95, 1.05):
            cells = np.zeros((3, 5, 2))
            np.moveaxis(cells, axis, 0)[place] = np.log(share * factors[name])
            # A deviation between sessions may be 0: that is no contradiction.
            grown = share > 1.0 and (name, side) != ("session_ln", "lower")
            assert contradictions(fit_of(values, block, cells)) == ({name: side} if grown else {})
    for nodes, factor in ((2, 321.2), (3, 48.1)):
        at, _ = np.polynomial.legendre.leggauss(nodes)
        slope = np.log(factor) / (0.5 * (at[-1] - at[-2]))  # over the width of the prior
        crowd = np.expm1(-0.01 * slope) / np.expm1(-slope)
        assert crowd / (1.0 - crowd) == pytest.approx(CROWD * 0.01 / 0.99, rel=0.06)
