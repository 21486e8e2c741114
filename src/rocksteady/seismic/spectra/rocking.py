"""Rocking spectra: peak rotation and velocity of blocks of all sizes under recorded motion."""

import functools
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Floats
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.housner_forms import Impacts, Restitution, form_text
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import ALPHA, Bounds
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.seismic.spectra.batch import (
    OUTPUTS,
    SpectrumRestitution,
    load_kernel,
    rectangles_in_si,
    shaken_fates,
    told_apart,
    wall_of,
)
from rocksteady.seismic.spectra.grounds import (
    axis_values,
    check_grounds,
    grounds_of,
    is_single_motion,
    is_single_number,
    names_of,
    scale_values,
)
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.cells import Cells, Variable
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.labelled import as_dataset
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

    from rocksteady.sweep.cases.cells import Labelled


PERIOD = Bounds(2e-6 * math.pi, 2e6 * math.pi, "[]", "give periods 2 pi/p in seconds")


@checked
def compute_rocking_spectrum(
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    alpha: ArrayLike,
    periods_s: ArrayLike,
    restitution: SpectrumRestitution = "housner",
    model: ModelChoice = None,
    scales: ArrayLike | None = None,
    gravity: float = STANDARD_GRAVITY,
    run: Execution | None = None,
) -> "xarray.Dataset":
    """Compute rocking spectra: peak rotation and velocity of blocks on records.

    The rocking spectrum of Makris and Konstantinidis [1]_: of every homogeneous rectangle, at rest
    when the ground begins to shake, what `simulate` would find.  The block is a slenderness alpha
    and a period 2 pi/p; its half-diagonal is ``R = 3 g/(4 p^2)``.  Blocks of given sizes, or of any
    other kind, are for `simulate_many`.

    Parameters
    ----------
    motions
        A record or several, or `BaseMotion` of a horizontal and a vertical record.  One that is
        reversed (`Record.reversed`) drives the other rotation first; for a block against a wall
        it is another motion.
    alpha
        Slenderness [rad], a number or several.
    periods_s
        Periods 2 pi/p [s], a number or several.
    restitution
        A number in (0, 1]; "housner" (default) for that of each slenderness, or
        ("housner", 0.965) for a measured factor of it.  For blocks against a wall
        (`Block.against_wall`) that of the wall, as ("wall", "housner"), or ("wall", 0.4) for a
        number in [0, 1].
    model
        ``"linear"`` or ``"nonlinear"`` (default), the full equations.
    scales
        Factors of all accelerations, above 0, a number or several; default 1.
    gravity
        Acceleration of gravity [m/s^2]; default 9.80665.
    run
        Executor, workers, store and progress; default `Execution()`.

    Returns
    -------
    xarray.Dataset
        Over ``record``, ``scale``, ``alpha`` and ``period``, in this order; what was given as a
        single record or number is no dimension.  ``peak_angle`` is the largest |theta|/alpha and
        ``peak_velocity`` the largest |d(theta/alpha)/d(p t)|: times alpha it is the angular
        velocity over p [rad].  ``status`` has the flags of `Status`; for a block that is
        "overturned" the peaks are those until it passes alpha for the last time, so that the first
        is 1, or more where it had been further out and come back.  ``impacts`` are as many as those
        of `simulate`.

    Raises
    ------
    InputError
        If an argument is outside its range.
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
    >>> spectrum = compute_rocking_spectrum(shock, alpha=0.2, periods_s=[2.0, 4.0, 8.0])
    >>> spectrum.peak_angle.values.round(4)
    array([1.    , 1.    , 0.1789])
    >>> spectrum.status.values
    array([2, 2, 1], dtype=int8)
    """
    cells = spectrum_cells(
        motions,
        alpha=alpha,
        periods_s=periods_s,
        restitution=restitution,
        model=model,
        scales=scales,
        gravity=gravity,
        run=run,
    )
    return as_dataset(cells)


def spectrum_cells(
    motions: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    alpha: ArrayLike,
    periods_s: ArrayLike,
    restitution: SpectrumRestitution,
    model: ModelChoice,
    scales: ArrayLike | None,
    gravity: float,
    run: Execution | None,
) -> "Labelled":
    """Return rocking spectra as cells.

    Parameters and errors are those of `compute_rocking_spectrum`.
    """
    grounds = grounds_of(motions)
    slenderness = [ALPHA("alpha", value) for value in axis_values("alpha", alpha)]
    periods = [PERIOD("periods_s", value) for value in axis_values("periods_s", periods_s)]
    given = 1.0 if scales is None else scales
    factors = scale_values(given)
    one_sided, impact = wall_of(restitution)
    factor = Impacts.of(impact).factor
    # Of the grid, the corner that needs most of the records, and the shape with least restitution.
    corner, _ = (
        _rectangle(value, 2.0 * math.pi / min(periods), gravity, impact, one_sided=one_sided)
        for value in (min(slenderness), max(slenderness))
    )
    ratio = corner.restitution if factor is None else impact
    equations = chosen_model(model, corner)
    check_grounds(grounds, [max(factors)] * len(grounds), [corner], equations)
    axes = (
        Axis(
            name="record",
            values=names_of(ground.record for ground in grounds),
            long_name="ground motion",
            items=grounds,
        ),
        Axis(name="scale", values=factors, long_name="factor of all accelerations"),
        Axis(name="alpha", values=slenderness, units="rad", long_name="slenderness of the block"),
        Axis(name="period", values=periods, units="s", long_name="2 pi/p"),
    )
    load_kernel(equations)
    cases = functools.partial(
        _peaks,
        restitution=("wall", ratio) if one_sided else ratio,
        gravity=corner.gravity,
        model=equations,
    )
    result = compute_cells(
        cases,
        Grid(axes=axes),
        OUTPUTS,
        run=run,
        attributes={
            "model": equations.name,
            "restitution": ratio if factor is None else form_text(factor),
            **({"one_sided": 1} if one_sided else {}),
            "gravity": corner.gravity,
            "vertical": ", ".join(names_of(ground.vertical for ground in grounds)) or "none",
        },
    )
    single = {
        "record": is_single_motion(motions),
        "scale": is_single_number(given),
        "alpha": is_single_number(alpha),
        "period": is_single_number(periods_s),
    }
    words = {"units": "rad s-1", "long_name": "frequency parameter of the block"}
    rates = 2.0 * math.pi / np.array(periods)
    dropped = [name for name, once in single.items() if once]
    if isinstance(result, Cells):
        result.coords["p"] = Variable(("period",), rates, words)
        return result.without(dropped)
    return result.assign_coords(p=("period", rates, words)).isel(dict.fromkeys(dropped, 0))


def _rectangle(
    alpha: float, p: float, gravity: float, restitution: Restitution, *, one_sided: bool
) -> Block:
    """Return a rectangle, free or against a wall."""
    if not one_sided:
        return Block.from_p(alpha=alpha, p=p, restitution=restitution, gravity=gravity)
    free = Block.from_p(alpha=alpha, p=p, restitution=1.0, gravity=gravity)
    return free.against_wall(restitution)


def _peaks(
    record: NDArray[np.object_],
    scale: Floats,
    alpha: Floats,
    period: Floats,
    *,
    restitution: SpectrumRestitution,
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
    grounds, ground = told_apart(record)
    fared = shaken_fates(
        grounds,
        ground=ground,
        scale=scale,
        sides=sides,
        gravity=np.full(len(scale), gravity),
    )
    return fared._asdict()
