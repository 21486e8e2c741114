"""Runs of a facade under records: the dynamic check of Circolare 2019 n. 7, C8.7.1.2.1.9."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError, Words
from rocksteady.facades.checks.facade import Facade
from rocksteady.facades.checks.mechanism import SHARE_SLC, SHARE_SLV
from rocksteady.facades.checks.record_demand import FEWEST, different_motions
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.equations import Model, ModelChoice, chosen_model
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.outcomes import Status
from rocksteady.results.numbers import plural
from rocksteady.results.result import Result
from rocksteady.seismic.spectra.grounds import grounds_of, names_of
from rocksteady.seismic.spectra.many import DIRECTIONS, cells_of_many
from rocksteady.sweep.run import Execution

LIMITS: Final = {"SLV": SHARE_SLV, "SLC": SHARE_SLC}
"""Displacement over d0 that the mean may reach, by the limit state."""
BEYOND: Final = "beyond d0"
"""Kind of a record of which a run went beyond d0."""
ENDED: Final = (int(Status.AT_REST), int(Status.ROCKING))
"""Statuses of runs whose largest displacement is known; a lossless one rocks on."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class FacadeRuns(Result):
    """Largest displacements of a facade under records [m], from `rocksteady.codes.run_facade`.

    A run counts as beyond d0 where the facade overturns, where it tilts beyond its balance and
    comes back, and where its end could not be decided.  A displacement is that of the control
    point, ``d = run_d0 theta/theta0``, and infinite where the facade does not come back.

    Attributes
    ----------
    facade
        Facade of the runs.
    limit_state
        Limit state of the records, "SLV" or "SLC".
    model
        Equations of motion.
    records, directions
        Names of the records, and signs: "as recorded", "reversed".
    pga_g, scale
        Largest horizontal acceleration that was run [g], and the factor of each record, shape
        (records,).
    vertical
        Whether a record was run with its vertical component, for each.
    status
        Codes of `rocksteady.Status`, shape (records, directions).
    share
        Largest displacement over d0, shape (records, directions).
    motions
        Number of different horizontal motions in the records; None (default) where each differs.
    """

    facade: Facade
    limit_state: str
    model: Model
    records: tuple[str, ...]
    directions: tuple[str, ...]
    pga_g: Floats
    scale: Floats
    vertical: tuple[bool, ...]
    status: Integers
    share: Floats
    motions: int | None = None

    @property
    def displacement_m(self) -> Floats:
        """Largest displacement of each run [m], shape (records, directions)."""
        displacement: Floats = self.share * self.facade.mechanism.d0_m
        return displacement

    @property
    def largest_m(self) -> Floats:
        """Largest displacement of each record [m], that of the worse sign, shape (records,)."""
        largest: Floats = self.displacement_m.max(axis=1)
        return largest

    @property
    def enough(self) -> bool:
        """Whether there are different motions for a mean, 7 or more."""
        return self._different >= FEWEST

    @property
    def _different(self) -> int:
        return len(self.records) if self.motions is None else self.motions

    @property
    def mean_m(self) -> float | None:
        """Mean of the largest displacements [m]; infinite with a fall, None of fewer than 7."""
        return float(np.mean(self.largest_m)) if self.enough else None

    @property
    def beyond_d0(self) -> NDArray[np.bool_]:
        """Whether each run went beyond d0, shape (records, directions)."""
        beyond: NDArray[np.bool_] = self.share > 1.0
        return beyond

    @property
    def beyond(self) -> tuple[str, ...]:
        """Names of the records with a run beyond d0."""
        return tuple(np.array(self.records, dtype=object)[self.beyond_d0.any(axis=1)])

    @property
    def limit_m(self) -> float:
        """Displacement that the mean may reach [m], d_SLV or d_SLC."""
        return LIMITS[self.limit_state] * self.facade.mechanism.d0_m

    @property
    def satisfied(self) -> bool | None:
        """Whether the dynamic check holds; None of fewer than 7 records."""
        mean = self.mean_m
        return None if mean is None else not self.beyond and mean <= self.limit_m

    @property
    def refusal(self) -> str | None:
        """Why there is no check of the mean; None where there is one."""
        if self.enough:
            return None
        given = plural(self._different, "record" if self.motions is None else "different record")
        return (
            f"The mean of the largest displacements needs {FEWEST} records and there "
            f"{'is' if self._different == 1 else 'are'} {given}: no verdict; add records."
        )

    @property
    def remarks(self) -> list[str]:
        """What a reader must know of the runs."""
        notes = [] if self.refusal is None else [self.refusal]
        still = int((self.share == 0.0).sum())
        if still:
            notes.append(f"In {still} of {self.share.size} runs the facade does not lift.")
        undecided = int((~np.isin(self.status, (*ENDED, int(Status.OVERTURNED)))).sum())
        if undecided:
            notes.append(
                f"The end of {plural(undecided, 'run')} could not be decided, or the base fell "
                "away under the facade: counted as beyond d0."
            )
        back = self.beyond_d0 & np.isfinite(self.share)
        if back.any():
            notes.append(
                f"In {plural(int(back.sum()), 'run')} the facade tilts beyond d0 and comes back: "
                "counted as beyond d0."
            )
        return notes


@checked
def run_facade(
    facade: Facade,
    records: Record | BaseMotion | Sequence[Record | BaseMotion],
    *,
    scale: float | None = None,
    pga_g: float | None = None,
    limit_state: Literal["SLV", "SLC"] = "SLV",
    directions: Literal["both", "as recorded", "reversed"] = "both",
    model: ModelChoice = None,
    run: Execution | None = None,
) -> FacadeRuns:
    """Run a facade under records and return its largest displacements [m].

    The facade is its equivalent block (`Mechanism.block`), at rest as each record begins; it is
    followed after the record's end to rest or proven overturning::

        theta'' = -p^2 [sin(theta0 - theta) - lambda a(t)/g cos(theta0 - theta)],
        p^2 = sqrt(M^2 + K^2)/(I FC),    lambda = FC D/K,    d = run_d0 theta/theta0

    with the sign of a(t) that tilts outwards.  What ends and holds the facade is left out from the
    beginning, and what ends and does not hold it acts throughout (`Mechanism.in_runs`).  This is
    exact where the centres of all masses lie on a line from the hinge, and to O(theta^2) elsewhere.
    A vertical component changes the weight of all that carries or holds, ties and thrusts too.

    Parameters
    ----------
    facade
        The facade.
    records
        Records, or `BaseMotion` of a horizontal and a vertical record; 7 or more for a verdict.
    scale
        Factor of all accelerations, above 0; default 1.
    pga_g
        Peak of each horizontal record after scaling [g], in place of `scale`.
    limit_state
        What the records stand for: "SLV" (default) or "SLC", whose limit the mean has.
    directions
        "both" (default) for the records as they are and reversed, as a facade may face either way;
        or one of "as recorded" and "reversed".
    model
        ``"nonlinear"`` (default), or ``"linear"``.
    run
        Executor, workers and progress; default `Execution()`.  No result depends on it.

    Raises
    ------
    InputError, ModelError
        If `scale` and `pga_g` are both given or not above 0, a record occurs twice or has too
        large accelerations, or the linear model meets a vertical motion.

    Examples
    --------
    >>> from rocksteady.codes import Facade, run_facade
    >>> from rocksteady.motions import make_synthetic_suite
    >>> wall = Facade(name="front", thickness_m=0.5, height_m=4.0)
    >>> runs = run_facade(wall, make_synthetic_suite(7), pga_g=0.3)
    >>> runs.satisfied, runs.beyond
    (True, ())
    """
    grounds = grounds_of(records)
    different = different_motions(grounds)
    peaks = np.array([ground.record.reference.peak_acceleration_m_s2 for ground in grounds])
    factors = _factors(scale, pga_g, peaks)
    mechanism = facade.mechanism
    motions = []
    for ground, factor in zip(grounds, factors.tolist(), strict=True):
        across = ground.record.scaled(factor * mechanism.base_factor)
        # Gravity is not scaled with the base: neither is what adds to it.
        up = None if ground.vertical is None else ground.vertical.scaled(factor)
        motions.append(across if up is None else BaseMotion(across, up))
    block = mechanism.block()
    equations = chosen_model(model, block)
    signs = DIRECTIONS if directions == "both" else (directions,)
    cells = cells_of_many(
        block,
        motions,
        reverse="both" if directions == "both" else directions == DIRECTIONS[1],
        model=equations,
        run=run,
    )
    shape = (len(grounds), len(signs))
    over = mechanism.run_d0_m / mechanism.d0_m  # at most 1
    status = cells["status"].values.astype(np.int64).reshape(shape)
    tilt = cells["peak_angle"].values.reshape(shape)
    return FacadeRuns(
        facade=facade,
        limit_state=limit_state,
        model=equations,
        records=tuple(names_of(ground.record for ground in grounds)),
        directions=signs,
        pga_g=peaks * factors / STANDARD_GRAVITY,
        scale=factors,
        vertical=tuple(ground.vertical is not None for ground in grounds),
        status=status,
        share=np.where(np.isin(status, ENDED), tilt * over, np.inf),
        motions=None if different == len(grounds) else different,
    )


def _factors(scale: float | None, pga_g: float | None, peaks: Floats) -> Floats:
    """Return the factor of each record."""
    if scale is not None and pga_g is not None:
        raise InputError(
            "pga_g",
            Words("and scale are both given"),
            "records are scaled by a factor or to a PGA",
            "leave one of the two out",
        )
    if pga_g is None:
        hint = "give a factor, as 1.5"
        factor = 1.0 if scale is None else in_range("scale", scale, 0.0, LARGEST, hint=hint)
        return np.full(len(peaks), factor)
    level = in_range("pga_g", pga_g, 0.0, LARGEST, hint="give a PGA in g, as 0.3")
    factors: Floats = level * STANDARD_GRAVITY / peaks
    return factors
