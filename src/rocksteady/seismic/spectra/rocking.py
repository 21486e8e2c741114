"""Rocking spectra: peak rotation and velocity of blocks of all sizes under recorded motion."""

import functools
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.history.lowering import segment_table
from rocksteady.dynamics.history.nonlinear_tables import refuse_vertical
from rocksteady.errors import InputError, Words
from rocksteady.model.blocks.block import STANDARD_GRAVITY, Block
from rocksteady.model.blocks.sides import Restitution, alpha_value, p_value, restitution_value
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.equations import Linear, Model, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.seismic.spectra._batch import (
    GroundShaking,
    load_kernel,
    rectangles_in_si,
    shaken_fates,
)
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import evaluate
from rocksteady.sweep.run import Run

if TYPE_CHECKING:
    import xarray

Floats = NDArray[np.float64]

OUTPUTS = (
    Output(
        name="status",
        dtype=np.int8,
        long_name="how it ended",
        flags={int(status): status.label for status in Status},
    ),
    Output(name="peak_angle", long_name="largest |theta|/alpha"),
    Output(name="peak_velocity", long_name="largest |d(theta/alpha)/d(p t)|"),
    Output(name="impacts", dtype=np.int64, long_name="impacts until then"),
)


@checked
def compute_rocking_spectrum(
    records: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    alpha: ArrayLike,
    periods_s: ArrayLike | None = None,
    p: ArrayLike | None = None,
    restitution: Restitution = "housner",
    model: Model | None = None,
    scale: ArrayLike = 1.0,
    reverse: bool = False,
    gravity: float = STANDARD_GRAVITY,
    run: Run | None = None,
) -> "xarray.Dataset":
    """Return peak rotation and velocity of homogeneous blocks under recorded ground motion.

    The rocking spectrum of Makris and Konstantinidis [1]_: of every block, at rest when the ground
    begins to shake, what `simulate` would find.  The block is a slenderness alpha and a period
    2 pi/p; its half-diagonal is ``R = 3 g/(4 p^2)``.

    Parameters
    ----------
    records
        The ground motion, or a suite of them: records, or a `BaseMotion` of a horizontal and a
        vertical record.
    alpha
        Slenderness [rad], a number or several.
    periods_s, p
        One of the two, a number or several: periods 2 pi/p [s], or frequency parameters [rad/s].
    restitution
        A number in (0, 1], or "housner" (default) for that of each slenderness.
    model
        `Linear()` or `Nonlinear()` (default), the full equations.
    scale
        What all accelerations are multiplied by, above 0, a number or several.
    reverse
        Whether the horizontal records are reversed: their positive values then drive negative
        rotation.
    gravity
        Acceleration of gravity [m/s^2].
    run
        As for `rocksteady.sweep.evaluate.evaluate`.

    Returns
    -------
    xarray.Dataset
        Over ``record``, ``scale``, ``alpha`` and ``period``, in this order; what was given as a
        single record or number is no dimension.  ``peak_angle`` is the largest |theta|/alpha and
        ``peak_velocity`` the largest |d(theta/alpha)/d(p t)|: times alpha it is the angular
        velocity over p [rad].  ``status`` has the flags of `Status`; of a block that is
        "overturned" the peaks are those until it passes alpha for the last time, so that the first
        is 1, or more where it had been further out and come back.  ``impacts`` counts, of the
        infinitely many before a rest, those before it was proved.

    Raises
    ------
    InputError
        If an argument is outside its range, or both or none of `periods_s` and `p` are given.
    ModelError
        If the linear model meets a vertical motion.
    OutputError, UnfinishedError
        As for `rocksteady.sweep.evaluate.evaluate`.

    References
    ----------
    .. [1] N. Makris and D. Konstantinidis, Earthquake Eng. Struct. Dyn. 32, 1879-1898 (2003).

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import Record, compute_rocking_spectrum
    >>> time = np.arange(0.0, 1.0, 0.01)
    >>> shock = Record(acceleration_m_s2=4.0 * np.sin(2.0 * np.pi * time), dt_s=0.01)
    >>> found = compute_rocking_spectrum(shock, alpha=0.2, periods_s=[2.0, 4.0, 8.0])
    >>> found.peak_angle.values.round(4)
    array([1.    , 1.    , 0.1789])
    >>> found.status.values
    array([2, 2, 1], dtype=int8)
    """
    grounds = _grounds(records)
    if reverse:
        grounds = [replace(ground, record=ground.record.reversed()) for ground in grounds]
    suite = [ground.record for ground in grounds]
    verticals = [ground.vertical for ground in grounds if ground.vertical is not None]
    slenderness = [alpha_value(value) for value in _values("alpha", alpha)]
    periods = _periods(periods_s, p)
    factors = [
        in_range(
            "scale",
            value,
            1.0 / LARGEST,
            LARGEST,
            "[]",
            hint="give a factor, as 1.5; to reverse is another choice",
        )
        for value in _values("scale", scale)
    ]
    ratio: Restitution = "housner"
    if restitution != "housner":
        ratio = restitution_value(restitution)
    # Of the grid, the corner that asks most of the records, and the shape with least restitution.
    shapes = [
        Block.from_p(
            alpha=value, p=2.0 * math.pi / min(periods), restitution=ratio, gravity=gravity
        )
        for value in (min(slenderness), max(slenderness))
    ]
    corner = shapes[0]
    equations = chosen_model(model, corner, suite[0])
    if isinstance(equations, Linear):
        for one in verticals:
            refuse_vertical(one)
    for motion in (*suite, *verticals):
        segment_table(motion.scaled(max(factors)), corner)
    axes = (
        Axis(name="record", values=_names(suite), long_name="ground motion", items=grounds),
        Axis(name="scale", values=factors, long_name="factor of all accelerations"),
        Axis(name="alpha", values=slenderness, units="rad", long_name="slenderness of the block"),
        Axis(name="period", values=periods, units="s", long_name="2 pi/p"),
    )
    load_kernel(equations)
    cases = functools.partial(
        _peaks,
        restitution=ratio,
        gravity=corner.gravity,
        model=equations,
    )
    found = evaluate(
        cases,
        Grid(axes=axes),
        OUTPUTS,
        run=run,
        attributes={
            "model": equations.name,
            "restitution": ratio,
            "gravity": corner.gravity,
            "direction": "reversed" if reverse else "as recorded",
            "vertical": ", ".join(_names(verticals)) or "none",
        },
    )
    single = [
        name
        for name, given in (("record", records), ("scale", scale), ("alpha", alpha))
        if _is_single(given)
    ]
    single += ["period"] if _is_single(p if periods_s is None else periods_s) else []
    words = {"units": "rad s-1", "long_name": "frequency parameter of the block"}
    rates = ("period", 2.0 * math.pi / np.array(periods), words)
    return found.assign_coords(p=rates).isel(dict.fromkeys(single, 0))


def _peaks(
    record: NDArray[np.object_],
    scale: Floats,
    alpha: Floats,
    period: Floats,
    *,
    restitution: Restitution,
    gravity: float,
    model: Model,
) -> dict[str, NDArray[Any]]:
    """Return how the blocks of some cells fare."""
    sides = rectangles_in_si(
        alpha=alpha,
        p=2.0 * math.pi / period,
        restitution=restitution,
        gravity=gravity,
        model=model,
    )
    fared = shaken_fates(shaking=record, scale=scale, sides=sides, gravity=gravity)
    return {
        "status": fared.status.astype(np.int8),
        "peak_angle": fared.peak_angle,
        "peak_velocity": fared.peak_velocity,
        "impacts": fared.impacts,
    }


def _is_single(value: object) -> bool:
    """Return whether something is one motion or one number, and no axis."""
    return isinstance(value, Record | BaseMotion) or np.ndim(value) == 0  # type: ignore[arg-type]


def _grounds(
    records: Record | BaseMotion | Sequence[Record | BaseMotion],
) -> list[GroundShaking]:
    """Return one or more ground motions."""
    given: object = records
    several = [given] if isinstance(given, Record | BaseMotion) else given
    grounds: list[GroundShaking] = []
    for each in several if isinstance(several, list | tuple) else ():
        across, up = (
            (each.horizontal, each.vertical) if isinstance(each, BaseMotion) else (each, None)
        )
        if not isinstance(across, Record) or not isinstance(up, Record | None):
            grounds = []
            break
        grounds.append(GroundShaking(record=across, vertical=up))
    if not grounds:
        raise InputError(
            "records",
            given,
            "it must be a record, a BaseMotion of records, or a list of them",
            "give records, as [read_record('one.AT2'), read_record('two.AT2')]",
        )
    return grounds


def _names(suite: Sequence[Record]) -> list[str]:
    """Return a name for each record, no two alike."""
    found: list[str] = []
    for number, record in enumerate(suite, start=1):
        name = record.name or f"record {number}"
        found.append(name if name not in found else f"{name} ({number})")
    return found


def _values(name: str, given: ArrayLike) -> list[float]:
    """Return the values of an axis, or the one of a number."""
    values: list[float] = np.atleast_1d(real_array(name, given)).tolist()
    if not values:
        raise InputError(name, given, "it must have one value or more", "give one")
    return values


def _periods(periods_s: ArrayLike | None, p: ArrayLike | None) -> list[float]:
    """Return the periods 2 pi/p [s]."""
    if (periods_s is None) == (p is None):
        raise InputError(
            "periods_s",
            Words("and p are both missing" if p is None else "and p are both given"),
            "a spectrum is over periods 2 pi/p or over p",
            "give periods_s=numpy.linspace(0.5, 8.0, 100), or p",
        )
    if p is not None:
        return [2.0 * math.pi / p_value(value) for value in _values("p", p)]
    hint = "give periods 2 pi/p in seconds"
    shortest, longest = 2e-6 * math.pi, 2e6 * math.pi
    return [
        in_range("periods_s", value, shortest, longest, "[]", hint=hint)
        for value in _values("periods_s", periods_s if periods_s is not None else [])
    ]
