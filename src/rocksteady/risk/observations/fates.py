"""Fates of blocks in tests: which blocks fall, at which gain, with which restitutions drawn."""

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import INSIDE, LARGEST_SEED, Bounds, Whole
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.equations import Linear, ModelChoice, chosen_model
from rocksteady.risk.observations._fate_cells import Shaken, fates_of_cells, streams_of
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.shaking_test import ShakingTest, distinct
from rocksteady.seismic.spectra.batch import OUTPUTS, GroundShaking, load_kernel, sides_in_si
from rocksteady.seismic.spectra.grounds import check_grounds, extremes_of, turned_round
from rocksteady.seismic.spectra.many import blocks_of
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray


MOST_DRAWS: Final = 1_000_000
KEPT: Final = ("status", "peak_angle", "impacts")
"""Outputs of a cell."""

FACTOR: Final = Bounds(
    1.0 / LARGEST, LARGEST, "[]", "give a factor, as 1.1; a reversed test has `reversed` set"
)
DEVIATION: Final = Bounds(0.0, 0.5, "[]", "give a standard deviation, as 0.05")


@checked
@dataclass(frozen=True, eq=False)
class Scatter:
    """Restitution that scatters from impact to impact.

    Parameters
    ----------
    deviation
        Standard deviation of the restitution about its mean, from 0 to 0.5: a number, or one for
        each block, shape (blocks,).
    draws
        Runs of each block with other random numbers; default 1.
    seed
        Seed of the random numbers, from 0 to 2^64 - 1; default 0.

    Raises
    ------
    InputError
        If a number is outside its range.

    Examples
    --------
    >>> from rocksteady.calibration import Scatter
    >>> Scatter(0.05, draws=8).draws
    8
    """

    deviation: Annotated[float | ArrayLike, lambda _, value: _deviations(value), INSIDE]
    draws: Annotated[int, Whole(1, MOST_DRAWS, "give the number of runs of each block, as 8")] = 1
    seed: Annotated[int, Whole(0, LARGEST_SEED, "give a whole number, as 7")] = 0


@checked
def compute_test_fates(
    blocks: Block | Sequence[Block],
    tests: Observations | Sequence[ShakingTest],
    *,
    gains: ArrayLike | None = None,
    scatter: Scatter | None = None,
    outputs: Sequence[str] = KEPT,
    model: ModelChoice = None,
    run: Execution | None = None,
) -> "xarray.Dataset":
    """Run every block through every test, at every gain, from rest.

    Without scatter every cell is what `simulate` finds for the block, the motion of the test and
    the gain.

    The random numbers of a cell follow from the seed, the name of its test, the place of its block
    and the number of its draw.  So a cell keeps its bits when tests are added or left out, or
    blocks and draws added after it, and all gains of a block meet the same random numbers.

    Parameters
    ----------
    blocks
        A block or several, for all tests.
    tests
        `Observations`, or one test or more, each of another name; their outcomes are not read.
    gains
        Factors on the motion of a test and its own gain, above 0: a number, or shape (gains,),
        (tests, gains) or (tests, blocks, gains); default 1.
    scatter
        Restitution that scatters from impact to impact; none by default.
    outputs
        Names of what is kept; default all three.  Without "peak_angle" the runs take a quarter to
        half less time, and with "status" alone 30 million cells take 30 MB.
    model
        ``"nonlinear"`` (default) or ``"linear"``.  `Nonlinear(tolerance=1e-8)` takes a third less
        time.
    run
        Executor, workers, store and progress; default `Execution()`.

    Returns
    -------
    xarray.Dataset
        ``status`` (with flags), ``peak_angle`` (|theta|/alpha) and ``impacts`` over ``test``,
        ``block``, ``gain`` and ``draw``.  Coordinates are the names of the tests, their ``object``,
        and ``scale``, the factor of the accelerations.

    Raises
    ------
    InputError, ModelError
        If an argument is outside its range or has another shape, or the linear model meets vertical
        motion.

    Examples
    --------
    The share of two slendernesses that fall in a test whose gain is known to a tenth:

    >>> from rocksteady import Block, Record, Status
    >>> from rocksteady.calibration import ShakingTest, compute_test_fates
    >>> record = Record(acceleration_m_s2=[0.0, 4.0, -4.0, 0.0], dt_s=0.3, name="shock")
    >>> test = ShakingTest(name="first", record=record, object="column")
    >>> columns = [Block.from_p(alpha=alpha, p=3.0) for alpha in (0.15, 0.25)]
    >>> fates = compute_test_fates(columns, [test], gains=[0.9, 1.0, 1.1], outputs=["status"])
    >>> (fates.status == Status.OVERTURNED).mean(["gain", "draw"]).values.round(2)
    array([[1.  , 0.67]])
    """
    shaking = distinct(tests.tests if isinstance(tests, Observations) else tests)
    names = [test.name for test in shaking]
    every = blocks_of(blocks)
    count = len(every)
    factors = _factors(1.0 if gains is None else gains, shaking, count)
    equations = chosen_model(model, every[0])
    upward = next((test.name for test in shaking if test.vertical is not None), None)
    if upward is not None and isinstance(equations, Linear):
        raise ModelError(
            f"test {upward!r:.60}",
            Words("has vertical motion"),
            "the linear equations of motion have no term for it",
            "take the nonlinear model, or leave the vertical motion out",
        )
    grounds, ground = _grounds(shaking)
    strongest = np.zeros(len(grounds))
    np.maximum.at(strongest, ground, factors.max(axis=(1, 2)))
    check_grounds(grounds, strongest.tolist(), extremes_of(every), equations)
    scattering = Scatter(0.0) if scatter is None else scatter
    shaken = Shaken(
        grounds=tuple(grounds),
        ground=ground,
        factors=factors,
        sides=np.stack([sides_in_si(block, equations) for block in every]).reshape(count, 2, -1),
        gravity=np.array([block.gravity for block in every]),
        deviation=_deviation(scattering, count),
    )
    kept = _outputs(outputs)
    sizes = {
        "test": (len(shaking), "test"),
        "block": (count, "block"),
        "gain": (factors.shape[2], "factor on the test's own gain"),
        "draw": (scattering.draws, "draw of the restitutions"),
    }
    load_kernel(equations)
    swept = evaluate(
        functools.partial(
            fates_of_cells,
            shaken=shaken,
            streams=streams_of(scattering.seed, names),
            peaks="peak_angle" in kept,
        ),
        Grid(
            axes=tuple(
                Axis(name=name, values=np.arange(size), long_name=words)
                for name, (size, words) in sizes.items()
            )
        ),
        [output for output in OUTPUTS if output.name in kept],
        run=run,
        attributes={"model": equations.name, "seed": str(scattering.seed)},
    )
    several = factors.shape[1] > 1
    return swept.assign_coords(
        {name: (name, np.arange(size), swept[name].attrs) for name, (size, _) in sizes.items()}
    ).assign_coords(
        test=("test", names, swept["test"].attrs),
        object=("test", [test.object for test in shaking], {"long_name": "object"}),
        scale=(
            ("test", "block", "gain") if several else ("test", "gain"),
            factors if several else factors[:, 0],
            {"units": "1", "long_name": "factor of all accelerations"},
        ),
    )


def _factors(gains: ArrayLike, tests: Sequence[ShakingTest], blocks: int) -> Floats:
    """Return factors on the records, shape (tests, blocks, gains) or (tests, 1, gains)."""
    given = np.atleast_1d(checked_array("gains", gains, FACTOR))
    count = len(tests)
    wanted = {1: (), 2: (count,), 3: (count, blocks)}
    if given.ndim not in wanted or given.shape[:-1] != wanted[given.ndim] or not given.size:
        raise InputError(
            "gains",
            Words(f"has the shape {given.shape}"),
            f"it is a number, (gains,), ({count}, gains) or ({count}, {blocks}, gains)",
            "give factors for all, for each test, or for each test and block",
        )
    if given.ndim < 3:
        given = given[..., np.newaxis, :]
    factors = np.array([test.gain for test in tests])[:, np.newaxis, np.newaxis]
    return checked_array("gains", factors * given, FACTOR)


def _grounds(tests: Sequence[ShakingTest]) -> tuple[list[GroundShaking], NDArray[np.int64]]:
    """Return the different shakings, and the number of each test's."""
    places: dict[GroundShaking, int] = {}
    numbers = []
    for test in tests:
        ground = GroundShaking(record=test.record, vertical=test.vertical)
        shaking = turned_round(ground) if test.reversed else ground
        numbers.append(places.setdefault(shaking, len(places)))
    return list(places), np.array(numbers, dtype=np.int64)


def _deviations(value: object) -> Floats:
    """Return deviations as a read-only array of shape () or (blocks,)."""
    deviations = checked_array("deviation", value, DEVIATION)  # type: ignore[arg-type]
    if deviations.ndim > 1:
        raise InputError(
            "deviation",
            Words(f"has the shape {deviations.shape}"),
            "it is a number, or one for each block",
            "give 0.05, or an array of shape (blocks,)",
        )
    deviations.flags.writeable = False
    return deviations


def _deviation(scatter: Scatter, blocks: int) -> Floats:
    """Return the deviation of each block, shape (blocks,)."""
    values = np.asarray(scatter.deviation)
    if values.shape not in ((), (blocks,)):
        raise InputError(
            "deviation",
            Words(f"has the shape {values.shape}"),
            f"it is a number or one for each of the {blocks} blocks",
            f"give 0.05, or an array of shape ({blocks},)",
        )
    return np.broadcast_to(values, (blocks,))


def _outputs(outputs: Sequence[str]) -> list[str]:
    """Return the names of what is kept."""
    names = list(outputs)
    if not names or len(set(names)) < len(names) or not set(names) <= set(KEPT):
        raise InputError(
            "outputs",
            names,
            "it has one or more of 'status', 'peak_angle' and 'impacts', each once",
            "give outputs=['status'], which is fastest",
        )
    return names
