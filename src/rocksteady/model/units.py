"""Columns of tables in degrees, seconds, g and Hz, beside the dimensionless ones.

A quantity of a block of known size has two columns: the one in its unit, whose name ends in that
unit, and the dimensionless one of the equations.
"""

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.blocks.gravity import in_g

if TYPE_CHECKING:
    import pandas as pd


Converter: TypeAlias = Callable[[Block, Any], Any]
"""Takes a number or an array, and returns it in its unit."""


def _degrees(block: Block, ratio: Any) -> Any:
    return math.degrees(block.alpha) * ratio


CONVERSIONS: Final[Mapping[str, tuple[str, Converter]]] = {
    "pt": ("time_s", lambda block, pt: pt / block.p),
    "amplitude": (
        "accel_g",
        lambda block, amplitude: in_g(amplitude * block.uplift_acceleration),
    ),
    "frequency_ratio": ("freq_hz", lambda block, ratio: ratio * block.p / (2.0 * math.pi)),
    "angle": ("angle_deg", _degrees),
    "angle_per_alpha": ("angle_deg", _degrees),
    "peak": ("peak_deg", _degrees),
    "highest": ("highest_deg", _degrees),
    "lowest": ("lowest_deg", _degrees),
    "velocity": ("velocity_deg_s", lambda block, rate: _degrees(block, rate) * block.p),
    "velocity_per_pt": ("velocity_deg_s", lambda block, rate: _degrees(block, rate) * block.p),
    "speed_per_pivot_time": ("speed_deg_s", lambda block, rate: _degrees(block, rate) * block.p),
    "acceleration_per_pt2": (
        "acceleration_deg_s2",
        lambda block, turn: _degrees(block, turn) * block.p * block.p,
    ),
    "base_acceleration_per_alpha_g": (
        "base_acceleration_g",
        lambda block, base: in_g(base * block.uplift_acceleration),
    ),
    "vertical_acceleration_per_g": (
        "vertical_acceleration_g",
        lambda block, lift: in_g(lift * block.gravity),
    ),
}
"""Name with its unit, and the conversion, of each dimensionless column."""


def in_units(
    columns: Mapping[str, Any], block: Block | DimensionlessBlock | None
) -> dict[str, Any]:
    """Return the columns of a table, with those in the units of a block added.

    Parameters
    ----------
    columns
        Lists or arrays by their names; None or nan for a missing number.  What has a column in
        radians has one in degrees instead.
    block
        Without a size, or None, nothing is added; peaks have no degrees where its sides differ.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=1.2, restitution=0.9)
    >>> table = in_units({"kind": ["symmetric"], "highest": [0.5], "highest_rad": [0.16]}, block)
    >>> print(list(table), round(table["highest_deg"][0], 3))
    ['kind', 'highest_deg', 'highest'] 9.217
    """
    if not isinstance(block, Block):
        return dict(columns)
    made = {name: CONVERSIONS[name] for name in columns if name in CONVERSIONS}
    if not (block.symmetric or block.one_sided):
        made.pop("peak", None)  # in the alpha of its side, which is not known here
    radians = {f"{name.removesuffix('_deg')}_rad" for name, _ in made.values()}
    table: dict[str, Any] = {}
    for name, values in columns.items():
        if name in made and made[name][0] not in columns:
            unit_name, converted = made[name]
            table[unit_name] = (
                [None if value is None else converted(block, value) for value in values]
                if isinstance(values, list)
                else converted(block, np.asarray(values, dtype=np.float64))
            )
        if name not in radians:
            table[name] = values
    return table


def framed(
    rows: Iterable[Mapping[str, Any]], block: Block | DimensionlessBlock | None, *names: str
) -> "pd.DataFrame":
    """Return rows as a data frame with units; `names` are its columns where there are no rows."""
    import pandas as pd

    listed = list(rows)
    columns = {name: [row[name] for row in listed] for name in (listed[0] if listed else names)}
    table = in_units(columns, block)
    for name in filter(lambda name: _counts(table[name]), table):
        table[name] = pd.array(table[name], dtype="Int64")
    return pd.DataFrame(table)


def _counts(values: Sequence[Any]) -> bool:
    """Return whether these are whole numbers, some of which are missing."""
    return {type(value) for value in values} == {int, type(None)}


COORDINATES: Final[Mapping[str, tuple[str, float]]] = {
    "alpha": ("alpha_deg", math.degrees(1.0)),
    "acceleration_m_s2": ("accel_g", in_g(1.0)),
}
"""Name with its unit, and factor, of coordinates of sweeps."""


def with_unit(name: str, unit: str) -> str:
    """Return the name of a column that ends in its unit.

    Examples
    --------
    >>> with_unit("period", "s"), with_unit("frequency_hz", "Hz"), with_unit("impacts", "1")
    ('period_s', 'frequency_hz', 'impacts')
    >>> with_unit("p", "rad s-1"), with_unit("level", "m/s"), with_unit("acceleration", "cm/s^2")
    ('p_rad_s', 'level_m_s', 'acceleration_cm_s2')
    """
    parts = re.split("[ /]", unit.replace("^", "").replace("-", "").lower())
    ending = "_".join(part.removesuffix("1") for part in parts)
    return name if not ending or name.endswith(f"_{ending}") else f"{name}_{ending}"
