"""Parameters of an object: quantiles by SciPy, properties of blocks by their geometry."""

import math

import numpy as np
import pytest
from scipy import stats

from rocksteady.calibration import ObjectPrior
from rocksteady.risk.calibration.sampler.space import ROUND, WIDEST, Space, widened
from rocksteady.risk.observations.spread import PriorRange

STONE = ObjectPrior(name="stone", width_m=0.7, height_m=0.8)


def test_what_is_not_given_is_as_wide_as_geometry_in_shares_of_the_outline() -> None:
    names = ("base", "offset", "mass_centre_height_m", "gyration_m", "orientation_rad")
    spreads = widened(STONE, dict.fromkeys(names, False)).spreads
    rectangle = math.hypot(0.7, 0.8) / math.sqrt(12.0)
    for name, unit in (("base", 1.0), ("mass_centre_height_m", 0.8), ("gyration_m", rectangle)):
        usual = WIDEST[name][0]
        assert spreads[name].low == pytest.approx(unit * usual.low)
        assert spreads[name].high == pytest.approx(unit * usual.high)
    assert spreads["base"] == PriorRange.in_logarithm(0.03, 1.2)
    wider = widened(STONE, {"base": True, "offset": False}).spreads
    assert (wider["base"].low, wider["base"].high) == pytest.approx((0.01, 1.5))
    assert widened(STONE, {}) is STONE


def test_scores_are_quantiles_of_the_priors() -> None:
    space = Space(block=widened(STONE, {"base": False, "offset": False}))
    assert space.names == ("base", "offset", "housner_factor", "scatter")
    scores = np.random.default_rng(1).normal(size=(50, 4))
    values = space.values_of(scores)
    oracles = (stats.loguniform(0.03, 1.2), stats.uniform(-0.6, 1.2), stats.uniform(0.85, 0.25))
    for column, oracle in enumerate(oracles):
        expected = oracle.ppf(stats.norm.cdf(scores[:, column]))
        assert values[:, column] == pytest.approx(expected, abs=1e-6)
    assert space.values_of(np.full((1, 4), 40.0))[0] == pytest.approx([1.2, 0.6, 1.1, 0.1])


def test_properties_of_blocks_follow_from_their_sides() -> None:
    given = widened(STONE, {"base": False, "offset": False, "orientation_rad": False})
    space = Space(block=given)
    values = space.values_of(np.random.default_rng(2).normal(size=(9, 5)))
    features, derived = space.features(values), space.derived(values)
    for row, (base, offset, _, scatter, angle) in enumerate(values.tolist()):
        # Half of the base times 1 +- offset, over the height of the mass centre.
        leans = [math.log(0.35 * base * (1.0 + sign * offset) / 0.4) for sign in (1.0, -1.0)]
        d = 0.5 * (leans[0] - leans[1])
        block = given.block(values[row])
        sides = (block.positive, block.negative)
        expected = [
            sum(leans) / 2.0 - math.hypot(d, ROUND), d, math.hypot(d, ROUND),
            sum(math.log(side.p) for side in sides) / 2.0,
            sum(side.restitution for side in sides) / 2.0, scatter, angle,
        ]  # fmt: skip
        assert features[row] == pytest.approx(expected, rel=1e-9)
        weaker = min(sides, key=lambda side: side.alpha)
        found = [derived[name][row] for name in ("alpha_rad", "p_rad_s", "restitution")]
        assert found == [weaker.alpha, weaker.p, weaker.restitution]
