"""Priors of objects: the constructors of `Block` as the oracle of geometry, SciPy that of draws."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from scipy import stats

from rocksteady.errors import InputError, ModelError, RocksteadyError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.sides import impact_restitution
from rocksteady.risk.observations.object_prior import ObjectPrior
from tests.every import every

EXACT: dict[str, Any] = {"housner_factor": 1.0, "scatter": 0.0}


def test_an_object_without_any_spread_is_one_block() -> None:
    column = ObjectPrior(name="column", width_m=0.15, height_m=0.6, base=1.0, **EXACT)
    assert column.parameters == ()
    assert column.block([]) == Block.rectangle(width=0.15, height=0.6)
    assert column.blocks(np.empty((2, 0))) == [Block.rectangle(width=0.15, height=0.6)] * 2
    assert column.draw(np.empty((3, 0))).shape == (3, 0)
    assert column.scatter_of(np.empty((2, 0))).tolist() == [0.0, 0.0]


def test_the_base_is_narrower_than_the_outline_whose_inertia_stays() -> None:
    w, h, ratio = 0.3, 1.1, 0.7
    stone = ObjectPrior(name="stone", width_m=w, height_m=h, base=ratio, **EXACT)
    k = math.sqrt((w * w + h * h) / 12.0)
    oracle = Block.asymmetric(left=0.5 * (w * ratio), right=0.5 * (w * ratio), height=h, gyration=k)
    assert stone.block([]) == oracle
    # By hand: the parallel-axis theorem about the edge of the base.
    radius = math.hypot(0.5 * w * ratio, 0.5 * h)
    assert stone.block([]).p == pytest.approx(math.sqrt(9.80665 * radius / (k * k + radius**2)))
    assert stone.outline_alpha_rad == pytest.approx(math.atan(w / h))
    assert stone.block([]).alpha == pytest.approx(math.atan(ratio * w / h))


def test_an_offset_moves_the_mass_centre_to_the_right_of_the_middle() -> None:
    w, h = 0.4, 1.2
    statue = ObjectPrior(name="statue", width_m=w, height_m=h, base=1.0, offset="-0.2:0.2", **EXACT)
    assert statue.parameters == ("offset",)
    right, left, middle = statue.blocks([[0.2], [-0.2], [0.0]])
    assert right.positive.distance == pytest.approx(0.24)  # from the left edge
    assert right.negative.distance == pytest.approx(0.16)
    assert (left.positive, left.negative) == (right.negative, right.positive)
    assert middle == Block.rectangle(width=w, height=h)
    sides = [(side.alpha, side.radius) for side in (right.positive, right.negative)]
    angles, radii = zip(*sides, strict=True)
    k = math.sqrt((w * w + h * h) / 12.0)
    assert right.restitution == pytest.approx(impact_restitution(angles, radii, gyration=k))


@every(
    ("sizes", "oracle"),
    [
        ({"alpha_rad": 0.2, "p_rad_s": 3.0}, lambda: Block.from_p(alpha=0.2, p=3.0)),
        (
            {"left_m": 0.2, "right_m": 0.3, "mass_centre_height_m": 0.9},
            lambda: Block.asymmetric(left=0.2, right=0.3, height=1.8),
        ),
        (
            {"left_m": 0.2, "right_m": 0.2, "mass_centre_height_m": 0.9},
            lambda: Block.rectangle(width=0.4, height=1.8),
        ),
        (
            {"left_m": 0.2, "right_m": 0.3, "mass_centre_height_m": 0.9, "gyration_m": 0.4},
            lambda: Block.asymmetric(left=0.2, right=0.3, height=1.8, gyration=0.4),
        ),
        (
            {"width_m": 0.4, "height_m": 1.8, "base": 1.0, "gyration_m": 0.4},
            lambda: Block.asymmetric(left=0.2, right=0.2, height=1.8, gyration=0.4),
        ),
        (
            {"width_m": 0.4, "height_m": 1.8, "base": 1.0, "mass_centre_height_m": 0.6},
            lambda: Block.asymmetric(
                left=0.2, right=0.2, height=1.2, gyration=math.sqrt((0.4**2 + 1.8**2) / 12.0)
            ),
        ),
    ],
)
def test_every_way_to_give_a_size_is_a_constructor_of_block(
    sizes: dict[str, Any], oracle: Any
) -> None:
    found = ObjectPrior(name="one", **sizes, **EXACT).block([])
    expected = oracle()
    for side in ("positive", "negative"):
        for name in ("alpha", "radius", "p", "restitution"):
            assert getattr(getattr(found, side), name) == pytest.approx(
                getattr(getattr(expected, side), name), rel=1e-14
            )


def test_a_factor_multiplies_the_restitution_of_the_base_that_rocks() -> None:
    sizes: dict[str, Any] = {"width_m": 0.3, "height_m": 0.9, "base": 0.8, "scatter": 0.0}
    momentum = ObjectPrior(name="a", **sizes, housner_factor=1.0).block([])
    less = ObjectPrior(name="a", **sizes, housner_factor=0.9).block([])
    assert less.restitution == pytest.approx(0.9 * momentum.restitution, rel=1e-15)
    assert less.with_restitution(1.0) == momentum.with_restitution(1.0)
    elastic = ObjectPrior(name="a", **sizes, housner_factor=1.5).block([])
    assert elastic.restitution == 0.999
    measured = ObjectPrior(name="a", **sizes, restitution=0.7).block([])
    assert measured == momentum.with_restitution(0.7)


def test_draws_are_the_quantiles_of_independent_spreads() -> None:
    prior = ObjectPrior(
        name="a", width_m="0.2:0.3", height_m="0.9+-0.05", base="0.7:1.0", restitution=0.9
    )
    assert prior.parameters == ("width_m", "height_m", "base", "scatter")
    shares = np.random.default_rng(3).random((400, 4))
    values = prior.draw(shares)
    oracles = [
        stats.uniform(0.2, 0.1),
        stats.truncnorm((1e-3 - 0.9) / 0.05, (20.0 - 0.9) / 0.05, 0.9, 0.05),
        stats.uniform(0.7, 0.3),
        stats.uniform(0.0, 0.1),
    ]
    for column, oracle in enumerate(oracles):
        np.testing.assert_allclose(values[:, column], oracle.ppf(shares[:, column]), rtol=1e-8)
    np.testing.assert_array_equal(prior.scatter_of(values), values[:, 3])


def test_sides_are_to_the_last_bit_those_of_the_blocks_row_by_row() -> None:
    prior = ObjectPrior(
        name="a", width_m="0.2:0.3", height_m="0.8:1.0", offset="-0.3:0.3", gyration_m="0.2:0.4"
    )
    values = prior.draw(np.random.default_rng(4).random((50, len(prior.parameters))))
    sides = prior.sides(values)
    for row, (block, numbers) in enumerate(zip(prior.blocks(values), sides, strict=True)):
        assert prior.block(values[row]) == block
        for side, columns in zip((block.positive, block.negative), numbers.tolist(), strict=True):
            assert [side.alpha, side.radius, side.p, side.restitution] == columns
            assert 0.0 < side.restitution < 1.0


def test_what_is_not_given_is_a_default_that_others_replace() -> None:
    prior = ObjectPrior(name="a", width_m=0.2, height_m=0.9)
    assert prior.defaults == ("base", "offset", "housner_factor", "scatter")
    assert [str(prior.spreads[key]) for key in prior.defaults] == [
        "0.75+-0.2", "0.0", "0.85:1.1", "0.0:0.1",
    ]  # fmt: skip
    spreads = ObjectPrior(name="b", alpha_rad=0.2, p_rad_s=3, restitution="0.8:0.9").spreads
    assert "base" not in spreads  # there is no outline
    others = {"base": spreads["restitution"], "restitution": spreads["restitution"]}
    changed = prior.with_defaults(others)
    assert changed.spreads["base"] == spreads["restitution"]
    assert "housner_factor" not in changed.spreads
    own = ObjectPrior(name="c", width_m=0.2, height_m=0.9, base=1, housner_factor=0.95)
    assert own.with_defaults(others).spreads == own.spreads
    rows = prior.to_dict()["parameters"]
    assert {row["parameter"]: row["from"] for row in rows} == {
        "width_m": "given", "height_m": "given", "base": "default", "offset": "default",
        "housner_factor": "default", "scatter": "default",
    }  # fmt: skip


@every(
    ("given", "kind", "line"),
    [
        ({}, ModelError, "has no size"),
        ({"width_m": 0.2}, ModelError, "height_m is missing"),
        ({"alpha_rad": 0.2}, ModelError, "p_rad_s is missing"),
        ({"left_m": 0.2, "right_m": 0.2}, ModelError, "mass_centre_height_m is missing"),
        ({"width_m": 1, "height_m": 2, "p_rad_s": 3}, ModelError, "has both width_m and p_rad_s"),
        (
            {"alpha_rad": 0.2, "p_rad_s": 3, "base": 0.8},
            ModelError,
            "base does not go with alpha_rad",
        ),
        (
            {"width_m": 0.2, "height_m": 1, "restitution": 0.9, "housner_factor": 1},
            ModelError,
            "are both given",
        ),
        ({"width_m": 200, "height_m": 600}, InputError, "write 0.6 for 600 mm"),
        ({"width_m": 0.2, "height_m": 1, "base": "0.9:1.6"}, InputError, "base = 1.6 is not valid"),
        ({"width_m": 0.2, "height_m": 1, "orientation_rad": 2}, InputError, "orientation_rad = 2"),
        ({"width_m": 0.2, "height_m": 1, "restitution": 1.2}, InputError, "restitution = 1.2"),
        ({"width_m": 0.2, "height_m": 1, "scatter": -0.1}, InputError, "scatter = -0.1"),
        ({"width_m": 0.2, "height_m": 1, "offset": math.nan}, InputError, "offset = nan"),
        ({"width_m": 2, "height_m": "0.7:0.9"}, InputError, "is too stocky: its restitution"),
        (
            {"width_m": 0.2, "height_m": 1, "mass_centre_height_m": 1.1},
            InputError,
            "it is below the top",
        ),
    ],
)
def test_what_no_object_has_is_refused_in_one_line(
    given: dict[str, Any], kind: type[RocksteadyError], line: str
) -> None:
    with pytest.raises(kind) as refusal:
        ObjectPrior(name="thing", **given)
    assert line in str(refusal.value)


def test_a_stocky_object_may_be_given_with_its_restitution() -> None:
    cube = ObjectPrior(name="cube", width_m=1.5, height_m=0.8, base=1.0, restitution=0.5, scatter=0)
    assert cube.block([]).restitution == 0.5


def test_every_block_of_a_wide_prior_exists() -> None:
    prior = ObjectPrior(
        name="a", width_m="0.3+-0.05", height_m="0.8+-0.2", offset="-0.5:0.5", base="0.3:1"
    )
    shares = np.array(list(itertools.product((0.0, 0.5, 1.0), repeat=len(prior.parameters))))
    blocks = prior.blocks(prior.draw(shares))
    assert len(blocks) == 3 ** len(prior.parameters)
    assert all(0.0 < block.negative.restitution < 1.0 for block in blocks)


@every("values", [[0.3], [[0.3, 0.1, 0.2]], [[]]])
def test_rows_have_a_value_for_each_parameter(values: Any) -> None:
    prior = ObjectPrior(name="a", alpha_rad="0.2:0.3", p_rad_s=3, restitution=0.9)
    for method in (prior.scatter_of, prior.blocks, prior.sides, prior.draw):
        with pytest.raises(InputError, match="each row has 2 values: alpha_rad, scatter"):
            method(values)


def test_a_value_that_is_not_possible_is_named() -> None:
    prior = ObjectPrior(name="a", alpha_rad="0.2:0.3", p_rad_s=3, restitution=0.9)
    with pytest.raises(InputError, match=r"alpha_rad = -0\.1 is not valid"):
        prior.blocks([[-0.1, 0.0]])


def test_an_object_given_in_two_ways_or_in_none() -> None:
    for sizes, words in (
        ({}, "has no size: the size is given in one way.*; add width_m and height_m"),
        ({"width_m": 0.2}, "height_m is missing: .*; add it"),
        ({"width_m": 0.2, "height_m": 1.0, "alpha_rad": 0.2}, "has both .*; leave one of the two"),
        ({"alpha_rad": 0.2, "p_rad_s": 2.0, "base": 0.9}, "base does not go with alpha_rad"),
        ({"width_m": 0.2, "height_m": 1.0, "mass_centre_height_m": 1.0}, "it is below the top of"),
        ({"width_m": 3.0, "height_m": 1.0}, "is too stocky: .*; give a restitution, or a more sle"),
    ):
        with pytest.raises(RocksteadyError, match=words):
            ObjectPrior(name="o", **sizes)
