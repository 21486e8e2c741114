"""Values that no argument of the package takes, or that lie at the ends of what it takes."""

import datetime as dt
import decimal
import fractions
import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
import xarray

import rocksteady as rs


class Quantity:
    """A number with a unit, as pint has it: NumPy converts it, and drops the unit."""

    def __init__(self, magnitude: Any, units: str) -> None:
        self.magnitude, self.units = magnitude, units

    def to(self, units: str) -> "Quantity":
        """Return it in another unit, unconverted."""
        return Quantity(self.magnitude, units)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        """Return the magnitude alone."""
        return np.asarray(self.magnitude, dtype=dtype)

    def __float__(self) -> float:
        """Return the magnitude alone."""
        return float(self.magnitude)


class Broken:
    """An object all of whose conversions fail."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        raise RuntimeError("no array")

    def __float__(self) -> float:
        raise RuntimeError("no number")

    def __len__(self) -> int:
        raise RuntimeError("no length")

    def __iter__(self) -> Iterator[Any]:
        raise RuntimeError("no items")

    def __eq__(self, other: object) -> bool:
        raise RuntimeError("equal to nothing")

    __hash__ = None  # type: ignore[assignment]


class Vast:
    """A sequence that is said to be too long for any memory."""

    def __len__(self) -> int:
        return 2**62

    def __getitem__(self, index: int) -> float:
        return 1.0


class Nonsense:
    """A base motion whose segments are none."""

    def segments(self) -> Any:
        """Return what is no segment."""
        return (1.0, "two")


def _same(value: Any) -> Any:
    return value


def endless() -> Iterator[float]:
    """Yield numbers for ever."""
    while True:
        yield 1.0


def itself() -> list[Any]:
    """Return a list that holds itself."""
    items: list[Any] = []
    items.append(items)
    return items


def deep() -> list[Any]:
    """Return a list nested deeper than Python nests calls."""
    items: list[Any] = []
    for _ in range(3_000):
        items = [items]
    return items


class Unshowable:
    """An object that has no text."""

    def __repr__(self) -> str:
        raise RuntimeError("no text")


def read_only() -> Any:
    """Return an array that cannot be written to."""
    array = np.array([0.5, 1.0])
    array.flags.writeable = False
    return array


SCALARS: tuple[Callable[[], Any], ...] = tuple(
    partial(_same, value)
    for value in (
        None,
        math.nan,
        math.inf,
        -math.inf,
        -0.0,
        0,
        0.0,
        -1,
        -1.5,
        1,
        2,
        0.5,
        1e300,
        1e308,
        -1e308,
        -1e300,
        1e-300,
        5e-324,
        3e-7,
        1.4e-11,
        1e6,
        1e12,
        10**6,
        10**9,
        2**31,
        2**63,
        2**64,
        10**400,
        -(10**400),
        True,
        False,
        1 + 2j,
        complex("nan"),
        decimal.Decimal("0.5"),
        decimal.Decimal("sNaN"),
        fractions.Fraction(1, 3),
        fractions.Fraction(10**400, 3),
        np.float16(0.5),
        np.longdouble(0.5),
        np.longdouble("1e4000"),
        np.uint8(3),
        np.int16(3),
        np.float64("nan"),
        np.int8(-3),
        np.bool_(True),
        np.datetime64("2020-01-01"),
        np.timedelta64(3, "s"),
        np.ma.masked,
        dt.timedelta(seconds=1),
        "",
        "abc",
        "1",
        "nan",
        "housner",
        rs.Linear(),
        rs.Nonlinear(),
        "nonlinear",
        "amplitude",
        "é\u202e\U0001f600",
        "a\0b",
        "x" * 5000,
        "\n",
        "a\udcff",
        b"abc",
        bytearray(b"abc"),
        range(3),
        range(10**12),
        object(),
        NotImplemented,
        ...,
        id,
        float,
        rs.Block,
        rs.Status.ROCKING,
        rs.outcomes.AttractorKind.REST,
        rs,
    )
)

MADE: tuple[Callable[[], Any], ...] = (
    Broken,
    Vast,
    Nonsense,
    endless,
    itself,
    deep,
    Unshowable,
    lambda: [Unshowable()],
    lambda: {Unshowable(): deep()},
    read_only,
    list,
    tuple,
    dict,
    set,
    lambda: lambda x: x,
    lambda: [1.0, "two"],
    lambda: [1.0, None],
    lambda: [1.0, math.nan],
    lambda: (math.nan, 1.0),
    lambda: (2.0, 1.0),
    lambda: (1.0,),
    lambda: (1.0, 2.0, 3.0),
    lambda: (0.0, math.inf),
    lambda: [[1.0, 2.0], [3.0]],
    lambda: [[[1.0]]],
    lambda: ["amplitude"],
    lambda: ("amplitude", "amplitude"),
    lambda: {"amplitude": 1.0},
    lambda: {"amplitude": [1.0, math.nan]},
    lambda: {"amplitude": []},
    lambda: {"nothing": [1.0]},
    lambda: {1: 2},
    lambda: {1.0, 2.0},
    lambda: (number for number in (1.0, 2.0)),
    lambda: iter([1.0, 2.0]),
    lambda: Quantity(1.0, "m"),
    lambda: Quantity(np.array([1.0, 2.0]), "cm"),
    lambda: [Quantity(1.0, "m"), Quantity(2.0, "m")],
    lambda: Quantity(0.8, "g"),
    lambda: np.array(1.0),
    lambda: np.array(3, dtype=np.int8),
    lambda: np.ma.array(0.8),
    lambda: [fractions.Fraction(1, 2), 1],
    lambda: [fractions.Fraction(10**400), 1.0],
    lambda: [decimal.Decimal("0.5")],
    lambda: {"a" * 10_000: []},
    lambda: np.array(math.nan),
    lambda: np.array([]),
    lambda: np.array([1.0]),
    lambda: np.array([1, 2], dtype=object),
    lambda: np.array([1.0, None], dtype=object),
    lambda: np.array([1.0, math.nan]),
    lambda: np.array([math.inf, 1.0]),
    lambda: np.array([[0.5, 1.0], [1.5, 2.0]]),
    lambda: np.zeros((0, 3)),
    lambda: np.zeros((2, 0)),
    lambda: np.ones((1, 1, 1)),
    lambda: np.array(["a", "b"]),
    lambda: np.array([b"a"]),
    lambda: np.array([True, False]),
    lambda: np.array([1 + 2j]),
    lambda: np.array([(1, 2.0)], dtype=[("a", int), ("b", float)]),
    lambda: np.array(["2020-01-01"], dtype="datetime64[D]"),
    lambda: np.array([0.5, 1.0], dtype=">f8"),
    lambda: np.array([0.5, 1.0], dtype=np.float16),
    lambda: np.array([0.5, 1.0], dtype=np.longdouble),
    lambda: np.array([np.longdouble("1e4000"), 1.0]),
    lambda: np.array([2**63 + 1, 1], dtype=np.uint64),
    lambda: np.array([-5, 7], dtype=np.int8),
    lambda: np.arange(10.0)[::-3],
    lambda: np.broadcast_to(1.0, (10**12,)),
    lambda: np.broadcast_to(1.0, (10**6, 10**6)),
    lambda: np.ma.array([1.0, -99999.0, 2.0], mask=[False, True, False]),
    lambda: np.ma.array([1.0, 2.0]),
    lambda: np.ma.array([1.0, math.nan], mask=[False, True]),
    lambda: [np.ma.masked, 1.0],
    lambda: memoryview(b"ab"),
    lambda: xarray.DataArray([0.5, 1.0], dims="x", attrs={"units": "mm"}),
    lambda: xarray.DataArray([0.5, 1.0], dims="x"),
    lambda: xarray.DataArray(0.5, attrs={"units": "g"}),
    xarray.Dataset,
    lambda: xarray.Dataset({"a": ("x", [1.0])}),
)
