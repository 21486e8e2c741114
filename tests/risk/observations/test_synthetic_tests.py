"""Synthetic tests: outcomes of `simulate`, gains of the table that are not those of the runs."""

from collections.abc import Mapping

import numpy as np
import pytest
from scipy import stats

from rocksteady.dynamics.history.simulate import simulate
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.outcomes import Status
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.synthetic_tests import make_synthetic_tests
from rocksteady.seismic.measures.scalar import compute_measure

SUITE = make_synthetic_suite(3)
COLUMN = Block.rectangle(width=0.1, height=0.5)


def test_without_an_error_outcomes_are_those_of_simulate() -> None:
    gains = [1.0, 1.6, 2.4]
    made = make_synthetic_tests(COLUMN, SUITE, gains=gains, gain_error=0.0)
    assert len(made) == 9
    ends = [simulate(COLUMN, test.motion).status is Status.OVERTURNED for test in made.tests]
    assert made.fell.tolist() == [float(end) for end in ends]
    assert 0.0 < made.fell.mean() < 1.0
    assert [test.gain for test in made.tests] == gains * 3
    assert made.groups.tolist() == [record.name for record in SUITE for _ in gains]


def test_the_same_seed_gives_the_same_tests_and_another_one_others() -> None:
    first, again, other = (
        make_synthetic_tests(COLUMN, SUITE, gains=np.linspace(0.6, 1.6, 15), seed=seed)
        for seed in (1, 1, 2)
    )
    assert first.fell.tolist() == again.fell.tolist()
    assert first.fell.tolist() != other.fell.tolist()


def test_the_error_of_the_gain_is_lognormal() -> None:
    """A single long push lifts and topples above one gain, which is so seen at many gains."""
    push = Record(acceleration_m_s2=np.full(400, 1.0), dt_s=0.01, name="push")
    low, high = 1.0, 4.0
    for _ in range(30):  # the gain that topples, by bisection of `simulate`
        middle = 0.5 * (low + high)
        fell = simulate(COLUMN, push.scaled(middle)).status is Status.OVERTURNED
        low, high = (low, middle) if fell else (middle, high)
    sigma, count = 0.3, 2000
    for told in (0.7 * high, high, 1.2 * high):
        made = make_synthetic_tests(
            COLUMN, [push], gains=np.full(count, told), gain_error=sigma, seed=5
        )
        expected = stats.norm.cdf(np.log(told / high) / sigma)
        error = np.sqrt(expected * (1.0 - expected) / count)
        assert abs(made.fell.mean() - expected) < 4.0 * error


def test_default_gains_are_levels_of_velocity_and_make_both_outcomes() -> None:
    made = make_synthetic_tests()
    assert len(made) == 48
    (prior,) = made.objects.values()
    block = Block.rectangle(width=0.15, height=0.6)
    levels = [compute_measure(test.motion, "p_pgv_per_uplift", block) for test in made.tests]
    np.testing.assert_allclose(levels, [0.4, 0.6, 0.8, 1.0] * 12, rtol=1e-9)
    assert 0.2 < made.fell.mean() < 0.8
    spreads: Mapping[str, object] = prior.spreads
    assert {"alpha_rad", "p_rad_s", "housner_factor", "scatter"} == set(spreads)
    alpha = prior.spreads["alpha_rad"]
    assert alpha.low < block.alpha < alpha.high


def test_a_prior_may_be_given_and_unlike_sides_have_one() -> None:
    prior = ObjectPrior(name="statue", width_m="0.3:0.5", height_m=1.0)
    made = make_synthetic_tests(COLUMN, SUITE, gains=[1.0], prior=prior)
    assert made.objects == {"statue": prior}
    leaning = Block.asymmetric(left=0.1, right=0.2, height=1.0)
    found = make_synthetic_tests(leaning, SUITE, gains=[1.0]).objects["synthetic block"]
    for key, value in (("left_m", 0.1), ("right_m", 0.2), ("mass_centre_height_m", 0.5)):
        spread = found.spreads[key]
        assert (spread.low, spread.high) == pytest.approx((0.7 * value, 1.3 * value))


def test_scatter_changes_some_outcomes() -> None:
    gains = np.linspace(0.6, 1.8, 25)
    steady, loose = (
        make_synthetic_tests(
            COLUMN, SUITE, gains=gains, gain_error=0.0, restitution_scatter=scatter
        ).fell
        for scatter in (0.0, 0.1)
    )
    assert 0.0 < np.mean(steady != loose) < 0.5


def test_gains_for_each_motion_and_what_is_refused() -> None:
    own = np.array([[1.0, 2.0], [1.1, 2.1], [1.2, 2.2]])
    made = make_synthetic_tests(COLUMN, SUITE, gains=own)
    assert [test.gain for test in made.tests] == own.ravel().tolist()
    for gains in ([[1.0]], [], 1.0, [0.0], [np.nan], [-1.0]):
        with pytest.raises(InputError, match="gains"):
            make_synthetic_tests(COLUMN, SUITE, gains=gains)
    with pytest.raises(InputError, match="motions"):
        make_synthetic_tests(COLUMN, [])


def test_a_truth_against_a_wall_is_refused() -> None:
    with pytest.raises(ModelError, match=r"truth stands against a wall.*compute_test_fates"):
        make_synthetic_tests(Block.rectangle(width=0.15, height=0.6).against_wall())
