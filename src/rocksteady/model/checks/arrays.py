"""Conversion of array and scalar arguments, lossless or refused.

NumPy drops the mask of a masked array and the unit of a quantity without an error, so that both
are refused here.  An `xarray.DataArray` may carry SI units, which are those of all arguments.
Fractions are taken as the nearest floats; a `decimal.Decimal` is refused everywhere.
"""

import functools
import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import fields, is_dataclass
from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Real
from types import MappingProxyType
from typing import Any, Final, TypeVar

from rocksteady.results.result import read_only

T = TypeVar("T")

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


def guard_result(kind: T) -> T:
    """Let a frozen result stay as it is, and be equal to its copies where it compares by value.

    What it holds cannot be written to.  Arrays of `KERNEL_FIELDS` of its class stay writable in the
    `vars` of a result: kernels take no others.
    """
    parameters = getattr(kind, "__dataclass_params__", None)
    if parameters is not None:
        if parameters.frozen:
            keep_contents(kind)
            for name in getattr(kind, "KERNEL_FIELDS", ()):
                setattr(kind, name, _shown(name))
        if parameters.eq and "__eq__" in vars(kind):
            compare_by_value(kind)
        if "to_dataset" in vars(kind):
            _give_away_datasets(kind)
    return kind


def _shown(name: str) -> property:
    """Return a field whose array is read only when it is read, and writable where it is kept."""

    def show(thing: Any) -> Any:
        return _locked(vars(thing)[name])

    def keep(thing: Any, value: Any) -> None:
        flags = getattr(value, "flags", None)
        vars(thing)[name] = value if flags is None or flags.writeable else value.copy()

    return property(show, keep, doc="A table as kernels take it, read only.")


def _give_away_datasets(kind: Any) -> None:
    """Let a result's datasets be copies, which their owner may change."""
    of_result = kind.to_dataset

    @functools.wraps(of_result)
    def to_dataset(self: Any, *args: Any, **kwargs: Any) -> Any:
        return of_result(self, *args, **kwargs).copy(deep=True)

    kind.to_dataset = to_dataset


def keep_contents(kind: Any) -> None:
    """Let public fields of a frozen class and computed properties hold nothing that is writable.

    Lists become tuples, dicts read-only mappings and arrays read-only views: an array that a caller
    has given stays writable by its own name.
    """
    frozen = getattr(getattr(kind, "__dataclass_params__", None), "frozen", False)
    kernels = getattr(kind, "KERNEL_FIELDS", ())
    every = [each.name for each in fields(kind)] if frozen else []
    names = [name for name in every if name[0] != "_" and name not in kernels]
    computed = {
        name: member
        for base in kind.__mro__
        for name, member in vars(base).items()
        if isinstance(member, functools.cached_property) and name[0] != "_"
    }
    for member in computed.values():
        member.func = _locking(member.func)
    if not names and not computed:
        return
    construct = kind.__init__

    @functools.wraps(construct)
    def make(self: Any, *args: Any, **kwargs: Any) -> None:
        construct(self, *args, **kwargs)
        _lock(self, names)

    def restore(self: Any, state: dict[str, Any]) -> None:
        """Take what a copy holds, whose arrays are writable again."""
        self.__dict__.update(state)
        _lock(self, [*names, *(name for name in computed if name in state)])

    if names:
        kind.__init__ = make
    if not hasattr(kind, "__setstate__") or hasattr(kind.__setstate__, "locks"):  # that of a base
        restore.locks = True  # type: ignore[attr-defined]
        kind.__setstate__ = restore


def compare_by_value(kind: T) -> T:
    """Let a dataclass be equal to its copies: NaN to NaN, arrays and results by what they hold."""
    made: Any = kind
    names = [field.name for field in fields(made) if field.compare]

    def __eq__(self: Any, other: object) -> bool:  # noqa: N807
        if type(other) is not type(self):
            return NotImplemented
        return all(_same(getattr(self, name), getattr(other, name)) for name in names)

    def __hash__(self: Any) -> int:  # noqa: N807
        return hash(tuple(_hash_of(getattr(self, name)) for name in names))

    made.__eq__, made.__hash__ = __eq__, __hash__
    return kind


def _same(one: Any, other: Any) -> bool:
    """Return whether two values are the same, with all that they hold."""
    if hasattr(one, "dtype") or hasattr(other, "dtype"):
        import numpy as np

        known = np.asarray(one).dtype.kind in "fc"
        return bool(np.array_equal(one, other, equal_nan=known))
    if type(one) is not type(other):
        return False
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(_same, one, other))
    if is_dataclass(one):
        names = [field.name for field in fields(one) if field.compare]
        return all(_same(getattr(one, name), getattr(other, name)) for name in names)
    return bool(one == other or (one != one and other != other))  # noqa: PLR0124 -- NaN


def _hash_of(value: Any) -> int:
    """Return a number that values share which are the same."""
    if hasattr(value, "dtype") or isinstance(value, Mapping):
        return 0
    if isinstance(value, list | tuple):
        return hash(tuple(map(_hash_of, value)))
    if is_dataclass(value):
        return hash(
            tuple(_hash_of(getattr(value, field.name)) for field in fields(value) if field.compare)
        )
    if isinstance(value, Hashable):
        return 0 if value != value else hash(value)  # noqa: PLR0124 -- NaN
    return 0


def _lock(thing: Any, names: list[str]) -> None:
    """Replace what can be written to in some fields."""
    for name in names:
        value = getattr(thing, name, None)
        locked = _locked(value)
        if locked is not value:
            object.__setattr__(thing, name, locked)


def _locking(compute: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Return a computation of a property that is read only; itself where it is."""
    if hasattr(compute, "locks"):  # of a base that several classes share
        return compute

    @functools.wraps(compute)
    def locking(thing: Any) -> Any:
        return _locked(compute(thing))

    locking.locks = True  # type: ignore[attr-defined]
    return locking


def _locked(value: Any) -> Any:
    """Return an array, a list, a dict or a tuple with these in a read-only form, all else as it is.

    A read-only mapping, which nothing here can replace, is returned as a new one.
    """
    kind = type(value)
    if kind is dict or kind is MappingProxyType:
        return read_only({key: _locked(item) for key, item in value.items()})
    if kind is list:
        return tuple(map(_locked, value))
    if isinstance(value, tuple):
        items = [_locked(item) for item in value]
        if all(new is old for new, old in zip(items, value, strict=True)):
            return value
        return kind(*items) if hasattr(kind, "_fields") else kind(items)
    # Without NumPy loaded there are no arrays.
    if kind.__module__ != "numpy" or kind.__name__ != "ndarray" or not value.flags.writeable:
        return value
    view = value.view()
    view.flags.writeable = False
    return view


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
