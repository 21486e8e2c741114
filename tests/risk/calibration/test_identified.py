"""Verdicts on parameters: each from its own limit on, and bounds of outcomes of one kind."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from rocksteady.results.doubts import NOT_IDENTIFIED
from rocksteady.risk.calibration._identified import (
    BOUND,
    IDENTIFIED,
    LIMIT,
    NARROWED,
    RETURNED,
    parameters_of,
)
from rocksteady.risk.calibration._space import Space
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampling import DrawOptions
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.prior import OutcomeErrors
from tests.every import every

PRIOR = np.linspace(0.0, 1.0, 2001)
BOTH = np.array([1.0, 0.0, np.nan])


@dataclass(frozen=True, kw_only=True)
class One(Space):
    """A space of one number, whatever its prior."""

    one: str

    @property
    def names(self) -> tuple[str, ...]:
        return (self.one,)

    def derived(self, values: np.ndarray) -> dict[str, np.ndarray]:  # noqa: ARG002
        return {}


def posterior(values: np.ndarray, name: str = "alpha_rad", weights: Any = None) -> Posterior:
    """Return draws of one number, of equal weights by default."""
    count = len(values)
    equal = np.full(count, 1.0 / count) if weights is None else weights
    space = One(
        block=ObjectPrior(name="vase", alpha_rad=0.3, p_rad_s=3.0), noise=OutcomeErrors(), one=name
    )
    return Posterior(
        object="vase",
        space=space,
        values=values[:, np.newaxis],
        weights=equal,
        untempered_weights=equal,
        prior_weights=equal,
        fates=np.zeros((count, 1)),
    )


def row(values: np.ndarray, fell: np.ndarray = BOTH, name: str = "alpha_rad", **keys: Any) -> Any:
    (found,) = parameters_of(posterior(values, name, **keys), {name: PRIOR}, fell)
    return found


@every(
    ("part", "verdict"),
    [(0.49, IDENTIFIED), (0.51, NARROWED), (0.69, NARROWED), (0.71, RETURNED), (1.0, RETURNED)],
)
def test_a_number_is_identified_below_half_of_its_prior(part: float, verdict: str) -> None:
    values = 0.5 + part * (PRIOR - 0.5)
    found = row(values)
    assert found["sd_ratio"] == pytest.approx(part)
    assert found["verdict"] == row(values, name="p_rad_s")["verdict"] == verdict
    few = row(values[:: len(values) // 60])
    assert few["verdict"] == (NARROWED if verdict == IDENTIFIED else verdict)
    assert (found["prior_low"], found["prior_high"]) == pytest.approx((0.05, 0.95))
    assert found["median"] == pytest.approx(0.5, abs=1e-3)
    assert (found["low"], found["high"]) == pytest.approx(
        (0.5 - 0.45 * part, 0.5 + 0.45 * part), abs=1e-3
    )
    assert (found["bound"], found["bound_side"], found["outline"]) == (None, None, 0.3)


@every("end", [0.0, 1.0])
@every(("share", "pushed"), [(0.29, False), (0.31, True)])
def test_a_third_at_an_end_of_the_prior_is_pushed_there(
    end: float, share: float, pushed: bool
) -> None:
    count = round(1000 * share)
    for inwards, verdict in ((0.04, LIMIT if pushed else IDENTIFIED), (0.06, IDENTIFIED)):
        near, far = abs(end - inwards), abs(end - 0.3)
        values = np.concatenate([np.full(count, near), np.full(1000 - count, far)])
        assert row(values)["verdict"] == verdict


@every(("fell", "side", "bound"), [(1.0, "upper", 0.9), (0.0, "lower", 0.1)])
def test_outcomes_of_one_kind_bound_alpha_at_nine_tenths(
    fell: float, side: str, bound: float
) -> None:
    found = row(PRIOR, np.array([fell, fell, np.nan]))
    assert (found["verdict"], found["bound_side"]) == (BOUND, side)
    assert found["bound"] == pytest.approx(bound, abs=1e-3)
    other = row(PRIOR, np.array([fell, fell]), name="p_rad_s")
    assert (other["verdict"], other["bound"]) == (RETURNED, None)
    assert row(PRIOR, np.array([np.nan]))["bound"] is None


def test_below_fifty_effective_draws_nothing_is_said() -> None:
    for effective, known in ((49, False), (51, True)):
        weights = np.zeros(len(PRIOR))
        weights[:effective] = 1.0 / effective
        found = row(PRIOR, weights=weights)
        assert (found["verdict"] != NOT_IDENTIFIED) is known
        assert (found["sd_ratio"] is not None) is known
        assert (found["median"] is not None) is known
        one = row(PRIOR, np.array([1.0]), weights=weights)
        assert (one["verdict"] == BOUND) is known
        assert ("not identified" in posterior(PRIOR, weights=weights).summary()) is not known


def test_what_is_known_exactly_comes_back() -> None:
    exact = np.full(2001, 0.4)
    (found,) = parameters_of(posterior(exact), {"alpha_rad": exact}, BOTH)
    assert (found["verdict"], found["sd_ratio"]) == (RETURNED, 1.0)


@every(
    ("draws", "rounds", "each"),
    [
        (30, None, [30]),
        (199, None, [199]),
        (200, None, [100, 100]),
        (1500, None, [250] * 6),
        (32, 3, [11, 11, 10]),
        (30, 6, [5] * 6),
    ],
)
def test_draws_are_shared_by_rounds_of_a_hundred_up_to_six(
    draws: int, rounds: int | None, each: list[int]
) -> None:
    assert DrawOptions(draws=draws, rounds=rounds).per_round == each


@every(("draws", "rounds"), [(30, 7), (30, 0), (29, None), (100_001, None)])
def test_rounds_have_five_draws_at_least(draws: int, rounds: int | None) -> None:
    with pytest.raises(ValueError, match=r"rounds|draws"):
        DrawOptions(draws=draws, rounds=rounds)
