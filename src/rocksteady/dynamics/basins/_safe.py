"""Safe basin: the states that do not overturn, their share and their largest circle."""

import functools
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Bools, Floats
from rocksteady.dynamics.batch.fates import batch_size, ends_of
from rocksteady.model.motions.harmonics import Harmonics
from rocksteady.outcomes import Status
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.evaluate import compute_cells
from rocksteady.sweep.run import Execution

SAFE = Output(name="safe", dtype=np.bool_, long_name="whether the block has not overturned")


def safe_states(
    *,
    sides: Floats,
    frequency_ratio: float,
    phase: float,
    amplitudes: ArrayLike,
    angles: Floats,
    velocities: Floats,
    cycles: int,
    run: Execution,
    harmonics: Harmonics,
) -> Bools:
    """Return which states of a window do not overturn, shape (amplitudes, velocities, angles).

    Parameters
    ----------
    sides
        Sides of the block, as from `rocksteady.model.equations.Linear.sides`.
    frequency_ratio, phase, cycles
        One number each; the phase is that of the shaking at the start [rad].
    amplitudes, angles, velocities
        The axes: A, u = theta/alpha and du/d(pt).
    run
        As for `rocksteady.sweep.evaluate.evaluate`.
    harmonics
        Harmonics of a Fourier series; none for a single sinusoid.
    """
    axes = (("amplitudes", amplitudes), ("velocities", velocities), ("angles", angles))
    data = compute_cells(
        functools.partial(
            _safe,
            sides=sides,
            frequency_ratio=frequency_ratio,
            phase=phase,
            cycles=cycles,
            harmonics=harmonics,
        ),
        Grid(axes=tuple(Axis(name=name, values=values) for name, values in axes)),
        (SAFE,),
        run=run,
        batch=batch_size(cycles),
    )
    safe: Bools = data["safe"].values
    return safe


def _safe(
    amplitudes: Floats,
    velocities: Floats,
    angles: Floats,
    *,
    sides: Floats,
    frequency_ratio: float,
    phase: float,
    cycles: int,
    harmonics: Harmonics,
) -> dict[str, NDArray[Any]]:
    """Return which of some states do not overturn."""
    count = len(amplitudes)
    status = ends_of(
        amplitude=amplitudes,
        frequency_ratio=np.full(count, frequency_ratio),
        sides=np.broadcast_to(sides, (count, *sides.shape)),
        angle=angles,
        velocity=velocities,
        phase=np.full(count, phase),
        cycles=cycles,
        harmonics=harmonics,
    )
    return {"safe": status != Status.OVERTURNED}


def measured(safe: Bools, angles: Floats, velocities: Floats) -> tuple[float, float]:
    """Return the share of safe states and the radius of the largest circle of them.

    Parameters
    ----------
    safe
        Which states are, shape (velocities, angles).
    angles, velocities
        Evenly spaced; the circle is one in their measure.
    """
    from scipy.ndimage import distance_transform_edt

    steps = [float(axis[-1] - axis[0]) / (len(axis) - 1) for axis in (velocities, angles)]
    # What lies beyond the window is not known to be safe.
    distance = distance_transform_edt(np.pad(safe, 1), sampling=steps)
    return float(safe.mean()), float(np.max(distance))
