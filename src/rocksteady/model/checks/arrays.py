"""Conversion of array and scalar arguments, lossless or refused.

NumPy drops the mask of a masked array and the unit of a quantity without an error, so that both
are refused here.  An `xarray.DataArray` may carry SI units, which are those of all arguments.
Fractions are taken as the nearest floats; a `decimal.Decimal` is refused everywhere.
"""

import math
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Real
from typing import Any, Final

MOST_ELEMENTS: Final = 100_000_000
"""Of an array that is given: 800 MB of floats."""

MOST_ITEMS: Final = 1_000_000
"""Of a list that is given: an iterable without an end is refused there."""

SI_UNITS: Final = frozenset(
    [
        "",
        "1",
        "rad",
        "m",
        "s",
        "Hz",
        "kg",
        "m s-1",
        "m/s",
        "m s-2",
        "m/s2",
        "m/s^2",
        "m s**-2",
        "m/s**2",
        "rad s-1",
        "rad/s",
        "1/s",
        "s-1",
    ]
)
"""Units that a `DataArray` may carry."""

UNITS_BY_SUFFIX: Final = {"_m_s2": "m/s^2", "_m_s": "m/s", "_hz": "Hz", "_m": "m", "_s": "s"}


class UnfitError(Exception):
    """A value is not what an argument takes: what is valid and what to do, as two clauses."""


def numeric_array(name: str, value: Any, kinds: str | None = "iuf") -> Any:
    """Return an array of numbers or of names as a plain array, a plain number as it is.

    `kinds` are those of the dtypes that pass, all without.

    Raises
    ------
    UnfitError
        If elements are masked, it carries a unit, rows have unequal lengths, or the elements are
        anything else.
    """
    kind = type(value)
    if kind is float or kind is int:
        if kind is int and not -(2**63) <= value < 2**64:
            raise UnfitError("it must be below 2^63", "give a float")
        return value
    import numpy as np

    passes = False
    if kind is np.ndarray:  # objects may be fractions, and long doubles are beyond floats
        known = kinds is None or value.dtype.kind in kinds
        passes = known and value.dtype.char not in "Og"
    if passes and value.size <= MOST_ELEMENTS:
        return value
    refuse_mask_and_unit(name, value)
    try:
        array = np.asarray(value)
    except Exception as error:  # noqa: BLE001 - ragged rows, or its own conversion fails
        if kinds is None and isinstance(error, ValueError):
            return value
        raise UnfitError("it must be an array of numbers", "give rows of one length") from None
    if array.dtype.kind == "O" and array.size <= MOST_ITEMS:
        array = _fractions_as_floats(name, array)
    if array.dtype.char == "g" and array.size <= MOST_ELEMENTS:
        with np.errstate(over="ignore"):  # infinite, it is refused as any infinity
            array = array.astype(np.float64)
    if kinds is not None and array.dtype.kind not in kinds:
        raise UnfitError(f"it must be an array of real numbers, not {array.dtype}", "give floats")
    if array.size > MOST_ELEMENTS:
        raise UnfitError(f"it must have at most {MOST_ELEMENTS} elements", "give fewer points")
    return array


def _fractions_as_floats(name: str, array: Any) -> Any:
    """Return real numbers of which one or more are fractions as floats, all else as it is."""
    import numpy as np

    items = array.ravel().tolist()
    refuse_mask_and_unit(name, items)
    real = all(isinstance(item, Real) and not isinstance(item, bool | np.bool_) for item in items)
    if not real or not any(isinstance(item, Fraction) for item in items):
        return array
    return np.array([float(_plain_real(item)) for item in items]).reshape(array.shape)


def refuse_mask_and_unit(name: str, value: Any, depth: int = 4) -> None:
    """Refuse masked elements, units and decimals, which a conversion would drop or cut.

    Of nested lists, `depth` levels are looked through.
    """
    if isinstance(value, list | tuple):
        if depth and len(value) <= MOST_ITEMS:
            for item in value:
                if type(item) not in (float, int, str):
                    refuse_mask_and_unit(name, item, depth - 1)
        return
    if isinstance(value, Decimal):
        raise UnfitError("it is a Decimal, and numbers are computed as floats", "give a float")
    attributes = _attributes(value)
    mask = attributes.get("mask")
    if mask is not None and hasattr(value, "filled"):
        import numpy as np

        count = int(np.sum(np.ma.getmaskarray(value)))
        if count:
            size = int(np.size(value))
            raise UnfitError(
                f"{count} of its {size} elements are masked, and a mask would be lost",
                "fill them, or leave them out with .compressed()",
            )
    if attributes.get("magnitude") is not None and attributes.get("units") is not None:
        unit = next((u for end, u in UNITS_BY_SUFFIX.items() if name.endswith(end)), None)
        into = f".to({unit!r}).magnitude" if unit else ".to(...).magnitude in the unit documented"
        raise UnfitError("it carries a unit, which would be lost", f"give the number, {into}")
    units = attributes.get("attrs")
    if isinstance(units, Mapping) and str(units.get("units", "1")) not in SI_UNITS:
        raise UnfitError(
            f"its units attribute is {units['units']!r}, and arguments are in SI units",
            "convert it and set its units attribute",
        )


def _attributes(value: Any) -> dict[str, Any]:
    """Return the attributes that mark a masked array, a quantity and a `DataArray`."""
    if isinstance(value, type) or type(value).__module__ == "builtins":
        return {}
    attributes = {}
    for name in ("mask", "magnitude", "units", "attrs"):
        try:
            attributes[name] = getattr(value, name, None)
        except Exception:  # noqa: BLE001 - its own property fails: it has no such attribute
            continue
    return attributes


def scalar_of(value: Any) -> Any:
    """Return the Python scalar that a NumPy scalar or an array of shape () holds, else the value.

    A fraction and a `numpy.longdouble` become floats, infinite where they are beyond them. A masked
    element and a quantity with a unit stay as they are, and are no number.
    """
    if type(value) in (float, int) or isinstance(value, type):
        return value
    try:
        if value.shape == () and hasattr(value, "item"):
            refuse_mask_and_unit("", value)
            return _plain_real(value.item())
    except UnfitError:
        return value
    except Exception:  # noqa: BLE001 - its own property fails: it is no scalar
        pass
    return _plain_real(value)


def _plain_real(given: Any) -> Any:
    """Return a real number that is no integer as a float, all else as it is."""
    if not isinstance(given, Real) or isinstance(given, Integral):
        return given
    try:
        return float(given)
    except OverflowError:  # a fraction beyond the largest float
        return -math.inf if given < Fraction(0) else math.inf
