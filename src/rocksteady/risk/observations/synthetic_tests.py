"""Synthetic shaking tests of a known block, for examples and trials."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.elementary.arrays import exp
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import LARGEST_SEED, Bounds, Whole
from rocksteady.model.equations import ModelChoice
from rocksteady.model.motions.record import Record
from rocksteady.model.motions.synthetic_suite import make_synthetic_suite
from rocksteady.outcomes import Status
from rocksteady.risk.observations.fates import Scatter, compute_test_fates
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.shaking_test import GAIN, LARGEST_SIGMA, ShakingTest
from rocksteady.seismic.measures.scalar import compute_measure

LEVELS: Final = (0.4, 0.6, 0.8, 1.0)
"""p PGV/(g tan alpha) of the tests of a record, where no gains are given."""

HALF_WIDTH: Final = 0.3
"""Of the prior of alpha and p about the truth, relative."""

NAME: Final = "synthetic block"
WIDTH_M, HEIGHT_M, MOTIONS = 0.15, 0.6, 12
"""Of the example."""
MOST_TESTS: Final = 100_000


@checked
def make_synthetic_tests(
    truth: Block | None = None,
    motions: Sequence[Record] | None = None,
    *,
    gains: ArrayLike | None = None,
    gain_error: Annotated[float, Bounds(0.0, LARGEST_SIGMA, "[]", "give 0.2")] = 0.2,
    restitution_scatter: float = 0.0,
    prior: ObjectPrior | None = None,
    model: ModelChoice = None,
    seed: Annotated[int, Whole(0, LARGEST_SEED, "give a seed, as 0")] = 0,
) -> Observations:
    """Make shaking tests of a known block, with errors in their gains.

    Each motion shakes the block at each gain times exp(z), z normal, and the table of tests has the
    gain without z: what `calibrate` is to see through.

    Parameters
    ----------
    truth
        The block; default a rectangle of 0.15 m x 0.6 m.  One against a wall is refused, because
        no `ObjectPrior` has a wall.
    motions
        Records with names; default ``make_synthetic_suite(12)``.
    gains
        Factors on the motions, shape (gains,), or (motions, gains) for others of each; by default
        those with p PGV/(g tan alpha) of 0.4, 0.6, 0.8 and 1.
    gain_error
        Standard deviation of z, from 0 to 3; default 0.2.
    restitution_scatter
        Standard deviation of the restitution from impact to impact, from 0 to 0.5; default 0.
    prior
        What is known of the block before the tests; by default alpha and p within 30 % of the
        truth, and restitution and scatter as `ObjectPrior` has them.
    model
        ``"linear"`` or ``"nonlinear"`` (default), the full equations.
    seed
        A whole number from 0 to 2^64 - 1; the same one gives the same tests.

    Returns
    -------
    Observations
        A test for each motion and gain, the gains of a motion one after another.

    Raises
    ------
    InputError
        If there is no motion, one has no name, or a number is outside its range.
    ModelError
        If the block stands against a wall.

    Examples
    --------
    >>> from rocksteady.motions import make_synthetic_suite
    >>> make_synthetic_tests(motions=make_synthetic_suite(6))
    <Observations: 24 tests of 1 object on 6 records: 9 fell, 15 stood>
    """
    block = Block.rectangle(width=WIDTH_M, height=HEIGHT_M) if truth is None else truth
    if block.one_sided:
        raise ModelError(
            "truth",
            Words("stands against a wall"),
            "objects of tests rock to both sides",
            "give a block without a wall, or run its tests with compute_test_fates",
        )
    records = make_synthetic_suite(MOTIONS) if motions is None else list(motions)
    if not records:
        raise InputError("motions", [], "there must be one or more", "give a list of Record")
    nominal = _gains(block, records, gains)
    rng = np.random.default_rng(seed)
    error = exp(gain_error * rng.standard_normal(nominal.shape))
    known = prior if prior is not None else _around(block)
    levels = nominal.shape[1]
    unknown = [
        ShakingTest(name=f"test {k + 1}", record=records[k // levels], object=known.name, gain=gain)
        for k, gain in enumerate(nominal.ravel().tolist())
    ]
    ends = compute_test_fates(
        block,
        unknown,
        gains=error.reshape(-1, 1),
        scatter=Scatter(restitution_scatter, seed=seed),
        outputs=["status"],
        model=model,
    ).status.values.ravel()
    tests = [
        replace(test, fell=bool(end == Status.OVERTURNED))
        for test, end in zip(unknown, ends, strict=True)
    ]
    return Observations(tests=tests, objects={known.name: known})


def _gains(truth: Block, records: list[Record], gains: ArrayLike | None) -> Floats:
    """Return the gains of the table, shape (motions, gains)."""
    if gains is None:
        unit = [compute_measure(record, "p_pgv_per_uplift", truth) for record in records]
        return np.array([[level / each for level in LEVELS] for each in unit])
    values = checked_array("gains", gains, GAIN)
    fits = values.ndim == 1 or (values.ndim == 2 and len(values) == len(records))
    if not fits or not 1 <= values.size * len(records) <= MOST_TESTS:
        raise InputError(
            "gains",
            Words(f"has the shape {values.shape}"),
            f"it is a row, or has a row for each of the {len(records)} motions",
            "give factors, as [0.5, 1.0, 1.5]",
        )
    return np.array(np.broadcast_to(values, (len(records), values.shape[-1])))


def _around(truth: Block) -> ObjectPrior:
    """Return a prior around the truth."""
    low, high = 1.0 - HALF_WIDTH, 1.0 + HALF_WIDTH

    def near(value: float) -> str:
        return f"{low * value!r}:{high * value!r}"

    if truth.symmetric:
        return ObjectPrior(name=NAME, alpha_rad=near(truth.alpha), p_rad_s=near(truth.p))
    positive, negative = truth.positive, truth.negative
    return ObjectPrior(
        name=NAME,
        left_m=near(positive.distance),
        right_m=near(negative.distance),
        mass_centre_height_m=near(positive.centre_height),
    )
