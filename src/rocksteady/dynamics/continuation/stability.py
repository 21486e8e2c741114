"""Stretches of a branch with unchanged stability and admissibility."""

from dataclasses import dataclass
from itertools import groupby

from rocksteady.dynamics.continuation.points import BIFURCATIONS, MARGINAL, Branch, PointType
from rocksteady.model.checks.arguments import checked, checked_result


@checked_result
@dataclass(frozen=True, kw_only=True)
class Stretch:
    """Consecutive points of a branch with unchanged stability and admissibility.

    Attributes
    ----------
    first, last
        Their indices, both included; the last of one stretch is the first of the next.
    stable
        Whether the motions between them are stable.
    admissible
        Whether the solutions between them are motions.
    """

    first: int
    last: int
    stable: bool
    admissible: bool


@checked
def stretches(branch: Branch) -> tuple[Stretch, ...]:
    """Split a branch into stretches of unchanged stability.

    Between two bifurcations without a point between them the stretch is what the one before is not:
    of two multipliers whose product is below 1, one passes the unit circle at a time.

    Parameters
    ----------
    branch
        From `rocksteady.find_branches`.

    Returns
    -------
    tuple of Stretch
        In the order of the branch; none of a branch of one point.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic, find_branches, find_orbits
    >>> shaking = Harmonic(amplitude=2.0, frequency_ratio=2.2)
    >>> starts = find_orbits(DimensionlessBlock(restitution=0.8), shaking, max_period=1)
    >>> branch = find_branches(starts[:1], "frequency_ratio", (1.6, 2.4), max_period=1)[0]
    >>> for stretch in stretches(branch):
    ...     ends = branch.values[[stretch.first, stretch.last]]
    ...     print(f"{ends[0]:.3f} {ends[1]:.3f} {stretch.stable}")
    1.600 1.948 False
    1.948 2.400 True
    """
    kinds: list[tuple[bool, bool]] = []
    for index in range(len(branch.points) - 1):
        inside = [end for end in (index + 1, index) if _decided(branch, end)]
        if inside:
            stable = bool(branch.stable[inside[0]])
        else:
            before = kinds[-1][0] if kinds else False
            stable = not before if branch.points[index].type in MARGINAL else before
        whole = bool(branch.admissible[index] and branch.admissible[index + 1])
        kinds.append((stable and whole, whole))
    found, first = [], 0
    for (stable, whole), same in groupby(kinds):
        last = first + len(list(same))
        found.append(Stretch(first=first, last=last, stable=stable, admissible=whole))
        first = last
    return tuple(found)


def _decided(branch: Branch, index: int) -> bool:
    """Return whether the multipliers of a point say what is stable beside it.

    Not where one lies on the unit circle, nor at a graze, next to which they grow without bound.
    """
    point = branch.points[index]
    lossless = branch.parameter == "restitution" and point.restitution == 1.0
    undecided = (*BIFURCATIONS, PointType.LOST, PointType.STALLED)
    return point.type not in undecided and not lossless
