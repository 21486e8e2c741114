"""Data of the study as tables: a header of column names, then rows."""

import math

from rocksteady.studies.facade_checks._checked_walls import CheckedWalls
from rocksteady.studies.facade_checks._findings import CLASSES, variant_values

Table = tuple[tuple[str, ...], list[tuple[object, ...]]]


def walls_table(checked: CheckedWalls) -> Table:
    """Return demand over capacity and the verdicts, cell by cell; inf where a run is beyond d0."""
    header = (
        "pga_g", "height_m", "slenderness", "linear", "nonlinear_static", "dynamic",
        "records_beyond_d0", "verdicts",
    )  # fmt: skip
    plane, beyond = checked.plane, checked.dynamics[0].beyond
    rows: list[tuple[object, ...]] = []
    for level, pga_g in enumerate(plane.levels_g.tolist()):
        for row, height in enumerate(plane.heights_m.tolist()):
            for column, ratio in enumerate(plane.slendernesses.tolist()):
                cell = (level, row, column)
                rows.append(
                    (
                        pga_g,
                        height,
                        ratio,
                        *(_number(float(each[cell])) for each in checked.ratios.values()),
                        int(beyond[cell]),
                        CLASSES[int(checked.classes[cell])],
                    )
                )
    return header, rows


def variants_table(checked: CheckedWalls) -> Table:
    """Return what other equations and restitutions come to."""
    values = variant_values(checked)
    return tuple(values[0]), [tuple(each.values()) for each in values]


def _number(value: float) -> object:
    """Return a number as in a table."""
    return value if math.isfinite(value) else "inf"
