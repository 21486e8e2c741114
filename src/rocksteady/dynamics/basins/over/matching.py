"""Matching of attractors at neighbouring values of a parameter, by the distance of their orbits."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Literal

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import positive

Distance = Literal["hausdorff", "centroid", "nearest"]

THRESHOLD = 0.3
"""Default distance in theta/alpha from which on orbits do not match."""
SAMPLES = 64
"""Angles of a forcing period that are compared."""
DECIMALS = 9
"""Of a distance: what is beyond them is rounding, and a tie."""
TURN = 2.0 * math.pi


@checked
@dataclass(frozen=True, kw_only=True)
class MatchingOptions:
    """How attractors at neighbouring values of a parameter become one family.

    As ``MatchBySSSetDistance`` of Attractors.jl: of all pairs of an attractor and one at the value
    before, the closest is matched first, then the closest of those left, up to a threshold.  An
    orbit of n forcing periods is a set of n states, at phase 0 of the shaking; two states are as
    far apart as the angles theta/alpha over the forcing period that follows, in root mean square.
    Where an impact passes the phase, that is continuous; the velocity jumps.

    Parameters
    ----------
    distance
        Distance of two sets: "hausdorff" (default), the largest distance of a state of one to the
        nearest of the other; "centroid", that of their means, the default of Attractors.jl;
        "nearest", that of the two closest states.
    threshold
        Distance in theta/alpha from which on two orbits are never one family (default 0.3);
        infinite, the default of Attractors.jl, for none.
    vanished
        Whether attractors are matched with those of families too that have vanished at a value
        before, as they were last (default False).

    Raises
    ------
    InputError
        If there is no such distance, or the threshold is not above 0.

    Examples
    --------
    >>> MatchingOptions(distance="centroid", threshold=float("inf")).threshold
    inf
    """

    distance: Distance = "hausdorff"
    threshold: float = THRESHOLD
    vanished: bool = False

    def __post_init__(self) -> None:
        """Validate."""
        given: object = self.threshold
        if not (isinstance(given, Real) and given == math.inf):
            hint = "give a distance as 0.3, or infinity"
            object.__setattr__(self, "threshold", positive("threshold", given, hint=hint))


def apart(matching: MatchingOptions, first: Floats, second: Floats) -> float:
    """Return the distance of two sets of courses of the angle, shape (states, samples) each."""
    if matching.distance == "centroid":
        first, second = first.mean(axis=0, keepdims=True), second.mean(axis=0, keepdims=True)
    away = np.sqrt(np.square(first[:, None, :] - second[None, :, :]).mean(axis=2))
    if matching.distance == "nearest":
        return float(away.min())
    return float(max(away.min(axis=0).max(), away.min(axis=1).max()))


def matched(
    matching: MatchingOptions, new: Sequence[Floats], old: Sequence[Floats]
) -> list[int | None]:
    """Return the place among the old sets that each new set takes over; None for none.

    Ties go to the first of the new sets, then to the first of the old ones.
    """
    pairs = sorted(
        (round(apart(matching, states, others), DECIMALS), place, taken)
        for place, states in enumerate(new)
        for taken, others in enumerate(old)
    )
    partners: dict[int, int] = {}
    for distance, place, taken in pairs:
        if (
            distance < matching.threshold
            and place not in partners
            and taken not in partners.values()
        ):
            partners[place] = taken
    return [partners.get(place) for place in range(len(new))]


def courses(orbit: Orbit) -> Floats:
    """Return the angle of an orbit over each of its forcing periods, from phase 0 on.

    Returns
    -------
    ndarray, shape (periods, 64)
        theta/alpha at equal steps of the phase.
    """
    run = orbit.trajectory()
    steps = TURN / SAMPLES * np.arange(SAMPLES * orbit.period)
    since = (steps - orbit.states[0].phase) % (TURN * orbit.period)
    here = run(np.minimum(since / orbit.motion.frequency_ratio, run.end_time_pt))
    angles: Floats = np.asarray(here.angle).reshape(orbit.period, SAMPLES)
    return angles
