"""Datasets of branches and cascades: their points in one list, each with its branch."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.dynamics.continuation.branch_facts import point_row
from rocksteady.model.facts import AnyBlock
from rocksteady.results.datasets import ColumnWords, Variable, padded, variables_of

if TYPE_CHECKING:
    import xarray

# The classes that use this module are named Any: to import them would close a circle.

PARAMETER_WORDS = {
    "amplitude": ColumnWords(long_name="a_max/(alpha g)"),
    "frequency_ratio": ColumnWords(long_name="omega/p"),
    "restitution": ColumnWords(long_name="angular velocity after an impact over that before it"),
}
ORBIT_WORDS = {
    "period": ColumnWords(long_name="forcing periods of the orbit", missing=0),
    "impacts": ColumnWords(long_name="impacts in a period of the orbit", missing=0),
    "symmetric": ColumnWords(long_name="whether half of it mirrors the other half", units=""),
}
MULTIPLIER_WORDS = {
    f"multiplier_{number}_{part}": ColumnWords(
        long_name=f"{words} part of the {size} Floquet multiplier of the whole orbit"
    )
    for number, size in ((1, "larger"), (2, "smaller"))
    for part, words in (("re", "real"), ("im", "imaginary"))
}
EXTREMES = {
    "highest": ColumnWords(long_name="largest theta/alpha of the orbit"),
    "lowest": ColumnWords(long_name="smallest theta/alpha of the orbit"),
}
SI = {
    "accel_g": ColumnWords(long_name="largest base acceleration", units="g"),
    "freq_hz": ColumnWords(long_name="frequency of the shaking", units="Hz"),
    "highest_rad": ColumnWords(long_name="largest rotation of the orbit", units="rad"),
    "lowest_rad": ColumnWords(long_name="smallest rotation of the orbit", units="rad"),
}


def branches_dataset(
    branches: Sequence[Any], types: Sequence[str], block: AnyBlock
) -> "xarray.Dataset":
    """Return the points of branches, one branch after another.

    Parameters
    ----------
    branches
        In the order of their numbers, from 1.
    types
        All types of points.
    block
        In whose g, Hz and radians values stand beside, if it has a size.
    """
    import xarray

    rows, peaks = [], []
    for number, branch in enumerate(branches, start=1):
        for point, flights in zip(branch.points, branch.peaks, strict=True):
            rows.append(point_row(number, point, branch.lean, block))
            peaks.append(branch.lean * flights)
    words = {
        "branch": ColumnWords(long_name="number of the branch, from 1", missing=0),
        "type": ColumnWords(long_name="what is special about the point", flags=tuple(types)),
        **PARAMETER_WORDS,
        **ORBIT_WORDS,
        "stable": ColumnWords(long_name="whether it is a stable motion", units=""),
        "admissible": ColumnWords(long_name="whether no flight passes the floor", units=""),
        **MULTIPLIER_WORDS,
        **EXTREMES,
        "arclength": ColumnWords(long_name="arclength from the start of the branch"),
        **(SI if rows else {}),
    }
    variables = variables_of(rows, "point", words)
    along = {name: variables.pop(name) for name in PARAMETER_WORDS}
    sides: Variable = (
        ("point", "flight"),
        padded(peaks),
        {"long_name": "extreme theta/alpha of each flight, with its side", "units": "1"},
    )
    return xarray.Dataset({**variables, "peaks": sides}, coords=along)


def bifurcation_variables(points: Sequence[Any], types: Sequence[str]) -> dict[str, Variable]:
    """Return the bifurcations of a diagram along a dimension of their own."""
    rows = [
        {
            "bifurcation_type": each.point.type.value,
            **{f"bifurcation_{name}": getattr(each.point, name) for name in PARAMETER_WORDS},
            "bifurcation_branch": each.branches[0],
            "bifurcation_highest": each.highest,
            "bifurcation_lowest": each.lowest,
        }
        for each in points
    ]
    branch = ColumnWords(long_name="number of the first branch that it lies on", missing=0)
    words = {
        "type": ColumnWords(long_name="type of the bifurcation", flags=tuple(types)),
        **PARAMETER_WORDS,
        "branch": branch,
        **EXTREMES,
    }
    named = {f"bifurcation_{name}": value for name, value in words.items()}
    return variables_of(rows, "bifurcation", named)


def cascade_dataset(cascade: Any) -> "xarray.Dataset":
    """Return the doublings of a cascade, with the distances between them and their ratios."""
    import xarray

    values, count = cascade.values_by_name(), len(cascade.points)
    rows = [
        {
            **{name: getattr(point, name) for name in PARAMETER_WORDS},
            "period": point.period,
            "impacts": point.impacts,
            "distance": distance,
            "ratio": ratio,
        }
        for point, distance, ratio in zip(
            cascade.points,
            [*values["distances"], None],
            [None, *values["ratios"], None][:count],
            strict=True,
        )
    ]
    words = {
        **PARAMETER_WORDS,
        "period": ColumnWords(long_name="forcing periods of what is doubled", missing=0),
        "impacts": ColumnWords(long_name="impacts in a period of it", missing=0),
        "distance": ColumnWords(long_name="from this doubling to the next in the parameter"),
        "ratio": ColumnWords(long_name="distance to this doubling over that to the next"),
    }
    variables = variables_of(rows, "doubling", words)
    along = {name: variables.pop(name) for name in PARAMETER_WORDS}
    number: Variable = (
        ("doubling",),
        np.arange(1, count + 1),
        {"long_name": "number of the doubling", "units": "1"},
    )
    attributes = {
        "parameter": cascade.parameter,
        "limit": cascade.limit,
        "model": cascade.model.name,
    }
    return xarray.Dataset(variables, coords={"doubling": number, **along}, attrs=attributes)
