"""Attractors along a slowly varied parameter: the brute-force bifurcation diagram."""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import real_array
from rocksteady.dynamics.history.start import HasStart, ImpactState, Rest, Start, start_of
from rocksteady.dynamics.orbits.attractor import FORCING_PERIODS, Attractor, find_attractor
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.orbits.return_map import (
    make_system,
    periodic_motion,
    section_of,
)
from rocksteady.dynamics.parameters import PARAMETERS, moved_to
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.orbits.return_map import FALL, STAY, STUCK, highest_after, next_passage
from rocksteady.kernels.orbits.systems import for_system
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.fourier import PeriodicMotion
from rocksteady.model.units import in_units
from rocksteady.outcomes import AttractorKind
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd
    import xarray


SHOWN_FLIGHTS = 200
"""Flights of a motion without an orbit whose peaks are kept."""
CARRIED = (AttractorKind.SYMMETRIC, AttractorKind.UNSYMMETRIC, AttractorKind.APERIODIC)
"""Kinds from whose last state the next value goes on."""

EXTREMES = ("highest", "lowest")


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class AttractorSweep(Result):
    """Attractors met while a parameter changes in small steps.

    Attributes
    ----------
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    values
        In the order in which they were gone through, shape (values,).
    attractors
        One per value.
    peaks
        Extreme u = theta/alpha of each flight with its side, one array per value: of a periodic
        motion those of a period, of an aperiodic one those of its next 200 flights; empty at rest
        and of a fall.
    """

    parameter: str
    values: Floats
    attractors: tuple[Attractor, ...]
    peaks: tuple[Floats, ...]
    block: Block | DimensionlessBlock
    motion: PeriodicMotion
    start: Start
    model: Model

    @property
    def direction(self) -> str:
        """Direction in a word: "up" or "down"."""
        return "up" if self.values[-1] > self.values[0] else "down"

    def runs(self) -> Iterator[tuple[float, float, list[Attractor]]]:
        """Yield neighbouring values that settle to one kind of motion: first, last, what it is."""
        pairs = zip(self.values.tolist(), self.attractors, strict=True)
        for _, same in groupby(pairs, key=lambda pair: _kind_of(pair[1])):
            run = list(same)
            yield run[0][0], run[-1][0], [attractor for _, attractor in run]

    @property
    def kinds(self) -> list[str]:
        """Kind of attractor at each value."""
        return [attractor.kind.value for attractor in self.attractors]

    @property
    def periods(self) -> list[int | None]:
        """Forcing periods of the orbit at each value; None without one."""
        return [attractor.period for attractor in self.attractors]

    def run_rows(self) -> list[dict[str, Any]]:
        """Return one row per run of neighbouring values that settle to one kind of motion."""
        rows = []
        for first, last, attractors in self.runs():
            orbit = attractors[0].orbit
            rows.append(
                {
                    "from": first,
                    "to": last,
                    "values": len(attractors),
                    "kind": attractors[0].kind.value,
                    "period": attractors[0].period,
                    "impacts_per_period": None if orbit is None else orbit.impacts,
                }
            )
        return rows

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per value: what the motion settles to there, and its extremes."""
        import pandas as pd

        peaks = [attractor.peaks or (math.nan, math.nan) for attractor in self.attractors]
        frame = pd.DataFrame(peaks, columns=["highest", "lowest"])
        frame.insert(0, self.parameter, self.values)
        frame.insert(1, "kind", self.kinds)
        frame.insert(2, "period", pd.array(self.periods, dtype="Int64"))
        return pd.DataFrame(in_units(dict(frame.items()), self.block))

    def to_dataset(self) -> "xarray.Dataset":
        """Return the attractors as an xarray Dataset with dimensions of the parameter and flight.

        Returns
        -------
        xarray.Dataset
            Over the parameter, in the order of the sweep: ``kind`` with the flags of
            `map_attractors`, ``period`` and ``impacts`` (0 without an orbit, -1 for infinitely many
            impacts), ``highest``, ``lowest``, ``lyapunov`` per forcing period and ``after``, as
            there.  ``peaks`` over flight too: extreme theta/alpha, nan beyond the last.

        Examples
        --------
        >>> from rocksteady import DimensionlessBlock, Harmonic
        >>> from rocksteady.orbits import sweep_attractor
        >>> block = DimensionlessBlock(restitution=0.8)
        >>> motion = Harmonic(amplitude=2.0, frequency_ratio=4.0)
        >>> data = sweep_attractor(block, motion, "amplitude", [0.5, 2.0, 2.5]).to_dataset()
        >>> print(data.kind.values, data.period.sel(amplitude=2.0).item())
        [2 0 0] 1
        """
        dataset: xarray.Dataset = words_module(AttractorSweep).sweep_dataset(self)
        return dataset

    def values_by_kind(self) -> dict[str, int]:
        """Return how many values settle to each kind of motion."""
        return dict(sorted(Counter(self.kinds).items()))


def _kind_of(attractor: Attractor) -> tuple[str, int | None, int | None]:
    return (
        attractor.kind.value,
        attractor.period,
        None if attractor.orbit is None else attractor.orbit.impacts,
    )


@checked
def sweep_attractor(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    parameter: str,
    values: Annotated[ArrayLike, INSIDE],
    *,
    start: Start | HasStart | None = None,
    max_cycles: int = 2000,
    model: ModelChoice = None,
) -> AttractorSweep:
    """Follow an attractor while a parameter changes in small steps.

    Run upwards and downwards it shows hysteresis: the attractor is kept for as long as there is
    one.  A block that has come to rest goes on from rest.  After a fall the next value begins from
    `start` again, or from rest where that is a steady state which does not exist.

    Parameters
    ----------
    block, motion
        Block and base motion; their own value of the parameter does not count.
    parameter
        "amplitude", "frequency_ratio" or "restitution".
    values
        To go through, in this order.
    start, max_cycles, model
        As for `rocksteady.find_attractor`.

    Returns
    -------
    AttractorSweep
        One attractor per value.

    Raises
    ------
    InputError, ModelError
        If the parameter has another name, there are no values, one is outside its range, or the
        nonlinear model meets a block without slenderness.

    Examples
    --------
    >>> import numpy as np
    >>> from rocksteady import DimensionlessBlock, Harmonic, Steady
    >>> block = DimensionlessBlock(restitution=0.8)
    >>> motion = Harmonic(amplitude=2.0, frequency_ratio=2.0)
    >>> down = np.linspace(2.0, 1.75, 6)
    >>> sweep = sweep_attractor(block, motion, "frequency_ratio", down, start=Steady())
    >>> for value, kind, period in zip(sweep.values, sweep.kinds, sweep.periods):
    ...     print(f"{value:.2f} {kind} {period}")
    2.00 symmetric 1
    1.95 symmetric 1
    1.90 unsymmetric 1
    1.85 unsymmetric 1
    1.80 unsymmetric 1
    1.75 overturned None
    """
    block.dimensionless()  # refuses sides too unlike
    shaken, equations = periodic_motion(motion), chosen_model(model, block)
    if parameter not in PARAMETERS:
        valid = "a motion is carried along " + ", ".join(PARAMETERS)
        raise InputError("parameter", parameter, valid, "name one of them")
    steps = real_array("values", values)
    if steps.ndim != 1 or steps.size == 0:
        valid = "it must be a list of one value or more"
        raise InputError("values", values, valid, "use numpy.linspace")
    periods = FORCING_PERIODS("max_cycles", max_cycles)
    begin = initial = start_of(start)
    attractors: list[Attractor] = []
    carried: ImpactState | None = None
    body = block
    for value in steps.tolist():
        body, shaken = moved_to(body, shaken, parameter, value)
        if carried is None:
            last = _from_start(body, shaken, begin, periods, equations)
        else:
            last = find_attractor(body, shaken, start=carried, max_cycles=periods, model=equations)
        attractors.append(last)
        if last.kind is AttractorKind.REST:
            begin = Rest()
        carried = last.state if last.kind in CARRIED else None
        if last.orbit is not None:
            carried = last.orbit.states[0]
    return AttractorSweep(
        parameter=parameter,
        values=steps,
        attractors=tuple(attractors),
        peaks=tuple(flight_peaks(each) for each in attractors),
        block=block,
        motion=motion,
        start=initial,
        model=equations,
    )


def _from_start(
    block: Block | DimensionlessBlock,
    motion: PeriodicMotion,
    start: Start,
    cycles: int,
    model: Model,
) -> Attractor:
    """Return what the block settles to from a start, or from rest where there is none such."""
    try:
        return find_attractor(block, motion, start=start, max_cycles=cycles, model=model)
    except ModelError:
        return find_attractor(block, motion, max_cycles=cycles, model=model)


def flight_peaks(attractor: Attractor) -> Floats:
    """Return the extreme u = theta/alpha of each flight of an attractor, with its side.

    Parameters
    ----------
    attractor
        Attractor; the flights are those of one period, or the next 200 of an aperiodic motion.

    Returns
    -------
    ndarray, shape (flights,)
        Empty at rest and of a fall.  Before a rest the first bounce to either side stands for all.
    """
    if attractor.orbit is not None:
        return _peaks_of(attractor.orbit)
    if attractor.state is None or attractor.kind not in CARRIED:
        return np.zeros(0)
    system = make_system(attractor.block, attractor.motion, attractor.model)
    here, peaks = section_of(attractor.state), []
    for _ in range(SHOWN_FLIGHTS):
        step = for_system(next_passage, system)(system, here, -1.0)
        if step.kind in (FALL, STAY, STUCK):
            break
        peaks.append(here.side * for_system(highest_after, system)(system, here, step)[0])
        here = step.state
    return np.array(peaks)


def _peaks_of(orbit: Orbit) -> Floats:
    system = make_system(orbit.block, orbit.motion, orbit.model)
    peaks = []
    for state in orbit.states:
        here = section_of(state)
        step = for_system(next_passage, system)(system, here, -1.0)
        near, far = for_system(highest_after, system)(system, here, step)
        peaks += [here.side * near] + ([-here.side * far] if far > 0.0 else [])
    return np.array([peak for peak in peaks if math.isfinite(peak)])
