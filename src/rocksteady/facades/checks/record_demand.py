"""Demand of records on a facade: the displacement spectra of a suite, for the static checks."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.kernels.elementary.arrays import exp, log
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.checks.validation import in_range
from rocksteady.model.motions.record import Record
from rocksteady.seismic.measures.response_spectrum import (
    LONGEST_S,
    SHORTEST,
    compute_response_spectrum,
)
from rocksteady.seismic.spectra.batch import GroundShaking
from rocksteady.seismic.spectra.grounds import grounds_of

FEWEST = 7
"""Records from which on a mean counts (NTC 2018, 7.3.5)."""
MOST_SHOWN = 60
"""Letters of a name in an error."""
FIRST_S, LAST_S = 0.05, 8.0
"""Periods between which the pseudo-acceleration is tabulated [s]."""
PERIODS_S: Floats = FIRST_S * exp(np.linspace(0.0, 1.0, 30) * log(LAST_S / FIRST_S))
PERIOD = Bounds(0.0, LONGEST_S, "(]", "give a period in seconds, as 1.9")
DAMPING = Bounds(0.0, 1.0, "[)", "give it over the critical one: 0.08 for 8 %")


COARSE, FINE = 16, 7
"""Periods of the search for the largest ordinate: evenly spaced, then between its neighbours."""


@checked
@dataclass(frozen=True, kw_only=True)
class RecordDemand:
    """Mean displacement [m] and acceleration [g] demands of records on a facade.

    Parameters
    ----------
    records
        Horizontal records at the base of the facade, 7 or more, scaled to the limit state.

    Raises
    ------
    InputError
        If there are fewer than 7, or one occurs twice.

    Examples
    --------
    >>> from rocksteady.codes import RecordDemand
    >>> from rocksteady.motions import make_synthetic_suite
    >>> demand = RecordDemand(records=make_synthetic_suite(7))
    >>> print(f"{demand.sa_g(0.0, 0.05):.3f}")
    0.335
    """

    records: tuple[Record, ...]
    _kept: dict[tuple[float, float], Floats] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def __post_init__(self) -> None:
        """Validate."""
        object.__setattr__(self, "records", tuple(self.records))
        if len(self.records) < FEWEST:
            raise InputError(
                "records",
                Words(f"are {len(self.records)}"),
                f"a mean over records needs {FEWEST} or more",
                "give more records, or a spectrum",
            )
        different_motions(grounds_of(self.records))

    def displacement_m(self, period_s: float, damping: float) -> float:
        """Return the mean over the records of the largest S_D [m] up to a period.

        The lower end T0 of the circular could not be read: the search begins at period 0, on the
        safe side.  The largest value of a mean spectrum would be smaller.

        Parameters
        ----------
        period_s
            The end of the range of periods [s], above 0.
        damping
            1 being critical, in [0, 1): 0.08 of the SLV, 0.10 of the SLC.

        Raises
        ------
        InputError
            If a number is outside its range.
        """
        return float(np.mean(self.displacements_m(period_s, damping)))

    def displacements_m(self, period_s: float, damping: float) -> Floats:
        """Return the largest S_D [m] of each record up to a period, shape (records,).

        Parameters and errors are those of `displacement_m`.
        """
        end = PERIOD("period_s", period_s)
        damping = DAMPING("damping", damping)
        if (end, damping) not in self._kept:
            self._kept[end, damping] = np.array(
                [_largest(record, end, damping) for record in self.records]
            )
        return self._kept[end, damping].copy()

    def sa_g(self, period_s: float, damping: float) -> float:
        """Return the mean over the records of the pseudo-acceleration [g]; the PGA at period 0.

        It is interpolated between 30 periods in equal ratios from 0.05 s to 8 s, and from the PGA.

        Parameters
        ----------
        period_s
            T [s], from 0 to 8.
        damping
            1 being critical, in [0, 1).

        Raises
        ------
        InputError
            If a number is outside its range.
        """
        hint = "give a period in seconds, as 0.5"
        period = in_range("period_s", period_s, 0.0, LAST_S, "[]", hint=hint)
        damping = DAMPING("damping", damping)
        if period == 0.0:
            peaks = [record.peak_acceleration_m_s2 for record in self.records]
            return float(np.mean(peaks)) / STANDARD_GRAVITY
        if (0.0, damping) not in self._kept:
            spectra = [
                compute_response_spectrum(record, PERIODS_S, damping=damping)
                for record in self.records
            ]
            mean = np.mean([each.pseudo_acceleration_m_s2 for each in spectra], axis=0)
            self._kept[0.0, damping] = mean / STANDARD_GRAVITY
        periods = np.append(0.0, PERIODS_S)
        values = np.append(self.sa_g(0.0, damping), self._kept[0.0, damping])
        return float(np.interp(period, periods, values))


def different_motions(grounds: Sequence[GroundShaking]) -> int:
    """Return the number of horizontal motions, once each with and without a vertical one.

    Raises
    ------
    InputError
        If two grounds are alike in every sample, whatever their names.
    """
    names: dict[object, str] = {}
    across = set()
    for number, ground in enumerate(grounds, 1):
        record, up = ground.record, ground.vertical
        name = (record.name or f"record {number}")[:MOST_SHOWN]
        level = (record.dt_s, record.acceleration_m_s2.tobytes())
        across.add(level)
        whole = (level, None if up is None else up.acceleration_m_s2.tobytes())
        if whole in names:
            raise InputError(
                "records",
                Words(f"have one motion twice, as {names[whole]} and as {name}"),
                "a mean counts each motion once",
                "leave one out",
            )
        names[whole] = name
    return len(across)


def _largest(record: Record, end: float, damping: float) -> float:
    """Return the largest S_D of a record at periods up to one."""
    low = min(max(end / COARSE, SHORTEST * record.dt_s), end)
    coarse = np.linspace(low, end, COARSE)
    displacement = compute_response_spectrum(record, coarse, damping=damping).displacement_m
    top = int(np.argmax(displacement))
    between = np.linspace(coarse[max(top - 1, 0)], coarse[min(top + 1, COARSE - 1)], FINE)
    fine = compute_response_spectrum(record, between, damping=damping).displacement_m
    return float(max(displacement[top], fine.max()))
