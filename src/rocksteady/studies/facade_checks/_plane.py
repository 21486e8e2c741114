"""Bare walls over slenderness and height, and the records that shake them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocksteady import Record
from rocksteady.arrays import Floats
from rocksteady.codes import Facade, RecordDemand
from rocksteady.errors import InputError
from rocksteady.motions import make_synthetic_suite
from rocksteady.results.numbers import plural

HEIGHTS_M = np.linspace(2.0, 12.0, 11)
SLENDERNESS = np.linspace(5.0, 25.0, 21)
PGA_G = (0.15, 0.25, 0.35)
"""Defaults."""
SYNTHETIC = 10
"""Motions of the synthetic suite, without records."""
BOUNDS = {
    "height_m": (0.5, 50.0, "give metres, as 2:12:11"),
    "slenderness": (3.0, 100.0, "give height over thickness, as 5:25:21"),
    "pga_g": (0.01, 3.0, "give g, as 0.15,0.25,0.35"),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Plane:
    """Walls without loads and ties, one for each height and slenderness, and their shaking.

    Parameters
    ----------
    height_m
        Heights [m], shape (rows,): two or more, ascending.
    slenderness
        Height over thickness, shape (columns,): likewise.
    pga_g
        Levels to which each record is scaled [g], shape (levels,): one or more, ascending.
    confidence_factor
        FC of all walls; default 1.
    records
        Horizontal records, 7 or more; without, a synthetic suite of 10.

    Raises
    ------
    InputError
        If a value is anything else.

    Examples
    --------
    >>> plane = Plane(height_m=[2.0, 4.0], slenderness=[5.0, 10.0], pga_g=[0.3])
    >>> wall = plane.wall(1, 0)
    >>> wall.height_m, wall.thickness_m, len(plane.records), plane.synthetic
    (4.0, 0.8, 10, True)
    """

    height_m: ArrayLike = ()
    slenderness: ArrayLike = ()
    pga_g: ArrayLike = ()
    confidence_factor: float = 1.0
    records: Sequence[Record] = ()
    synthetic: bool = False

    def __post_init__(self) -> None:
        """Validate, and keep the axes as read-only arrays."""
        for name, least in (("height_m", 2), ("slenderness", 2), ("pga_g", 1)):
            object.__setattr__(self, name, _axis(name, getattr(self, name), least))
        if not len(self.records):
            object.__setattr__(self, "records", make_synthetic_suite(SYNTHETIC))
            object.__setattr__(self, "synthetic", True)
        object.__setattr__(self, "records", RecordDemand(records=tuple(self.records)).records)
        for row in (0, -1):
            for column in (0, -1):
                self.wall(row, column)  # refuses what is out of range

    @property
    def heights_m(self) -> Floats:
        """The rows [m]."""
        return np.asarray(self.height_m, dtype=np.float64)

    @property
    def slendernesses(self) -> Floats:
        """The columns."""
        return np.asarray(self.slenderness, dtype=np.float64)

    @property
    def levels_g(self) -> Floats:
        """The levels [g]."""
        return np.asarray(self.pga_g, dtype=np.float64)

    @property
    def middle(self) -> int:
        """Place of the middle level."""
        return len(self.levels_g) // 2

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the records."""
        return tuple(
            each.name or f"record {place}" for place, each in enumerate(self.records, start=1)
        )

    def wall(self, row: int, column: int) -> Facade:
        """Return the wall of a cell."""
        height, ratio = float(self.heights_m[row]), float(self.slendernesses[column])
        return Facade(
            name=f"{height:.3g} m high, h/t = {ratio:.3g}",
            thickness_m=height / ratio,
            height_m=height,
            confidence_factor=self.confidence_factor,
        )

    def walls(self) -> list[Facade]:
        """Return the walls, row by row."""
        rows, columns = range(len(self.heights_m)), range(len(self.slendernesses))
        return [self.wall(row, column) for row in rows for column in columns]


def _axis(name: str, values: ArrayLike, least: int) -> Floats:
    """Return an axis of the plane."""
    low, high, hint = BOUNDS[name]
    points = np.atleast_1d(np.array(values, dtype=np.float64))
    if points.ndim != 1 or points.size < least:
        raise InputError(name, points.tolist(), f"it has {plural(least, 'value')} or more", hint)
    if not (np.diff(points) > 0.0).all():
        raise InputError(name, points.tolist(), "its values ascend", hint)
    for end in (float(points[0]), float(points[-1])):
        if not low <= end <= high:
            raise InputError(name, end, f"it must lie in [{low:g}, {high:g}]", hint)
    points.flags.writeable = False
    return points
