"""Arrays as arguments: which numbers pass.  Results: when they are equal, and what is locked."""

import copy
import math
from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
import pytest
import xarray

from rocksteady.model.checks.arrays import (
    UnfitError,
    compare_by_value,
    guard_result,
    numeric_array,
    refuse_mask_and_unit,
    scalar_of,
)
from tests.public.junk import Quantity


def test_whole_numbers_pass_that_an_array_of_them_can_hold() -> None:
    for fit, beyond in ((2**64 - 1, 2**64), (-(2**63), -(2**63) - 1)):
        assert numeric_array("x", fit) == fit
        with pytest.raises(UnfitError, match="2\\^63"):
            numeric_array("x", beyond)


class Pair(NamedTuple):
    """Two things with names."""

    first: Any
    second: Any


class Unhashable:
    """What is equal by its number, and has no hash."""

    __hash__ = None  # type: ignore[assignment]

    def __init__(self, number: int) -> None:
        self.number = number

    def __eq__(self, other: object) -> bool:
        """Return whether the numbers are equal."""
        return isinstance(other, Unhashable) and self.number == other.number


@compare_by_value
@dataclass(frozen=True)
class Kept:
    """A result with a note that does not count."""

    value: Any
    note: Any = field(default=None, compare=False)


@dataclass(frozen=True)
class Inner:
    """A part of a result, with a note that does not count."""

    value: Any
    note: Any = field(default=None, compare=False)


NAN = math.nan
ALIKE: list[tuple[Any, Any]] = [
    (1.0, 1.0),
    (NAN, float("nan")),
    ([1.0, NAN], [1.0, float("nan")]),
    ((), ()),
    ((1, ("a", None)), (1, ("a", None))),
    (np.array([1.0, NAN]), np.array([1.0, float("nan")])),
    (np.array([1j, NAN]), np.array([1j, float("nan")])),
    (np.array(["a", "b"]), np.array(["a", "b"])),
    (np.array([True]), np.array([True])),
    ([np.arange(3)], [np.arange(3)]),
    (Inner(NAN, 1), Inner(float("nan"), 2)),
    (Inner(np.arange(2)), Inner(np.arange(2))),
    (Unhashable(1), Unhashable(1)),
    ({"a": 1}, {"a": 1}),
    (Kept([NAN]), Kept([float("nan")])),
]
"""Values that are the same."""
UNLIKE: list[tuple[Any, Any]] = [
    (1.0, 2.0),
    (1.0, NAN),
    (NAN, 1.0),
    (1, 1.0),
    (1, True),
    ([1.0], (1.0,)),
    ([1.0], [1.0, 2.0]),
    ([1.0, 2.0], [1.0]),
    ((1.0, 2.0), (1.0, 3.0)),
    ((2.0, 1.0), (3.0, 1.0)),
    (np.array([1.0]), np.array([2.0])),
    (np.array([1.0, 1.0]), np.array([1.0])),
    (np.array([1.0]), "a"),
    ("a", np.array([1.0])),
    (np.array(["a"]), np.array(["b"])),
    (Inner(1.0), Inner(2.0)),
    (Inner(1.0), Kept(1.0)),
    (Unhashable(1), Unhashable(2)),
    ({"a": 1}, {"a": 2}),
    (None, 0),
]
"""Values that are not."""


def test_results_are_equal_that_hold_the_same_and_share_a_hash() -> None:
    for value, copied in ALIKE:
        one, again = Kept(value, note=1), Kept(copied, note=2)
        assert one == again, (value, copied)
        assert hash(one) == hash(again), (value, copied)
    for value, changed in UNLIKE:
        assert Kept(value) != Kept(changed), (value, changed)
    others: list[Any] = [Inner(1.0), 1.0, None]
    assert Kept(1.0) not in others
    several = [
        Kept(value) for value in (1.0, 2.0, "a", (1.0, 2.0), [2.0, 1.0], Inner(1.0), Inner(2))
    ]
    assert len({hash(each) for each in several}) == len(several)


def test_a_kept_class_is_equal_by_value_where_dataclasses_compare() -> None:
    arrays = np.array([1.0, NAN]), np.array([1.0, NAN])

    @guard_result
    @dataclass(frozen=True)
    class Compared:
        value: Any

    @guard_result
    @dataclass(frozen=True, eq=False)
    class Apart:
        value: Any

    @guard_result
    @dataclass
    class Loose:
        value: Any

    first, second = map(Compared, arrays)
    assert first == second
    alone, other = map(Apart, arrays)
    assert alone == alone  # noqa: PLR0124
    assert alone != other
    loose = Loose(arrays[0])
    loose.value[0] = 1.0  # only what is frozen is locked
    assert Loose([NAN]) == Loose([float("nan")])


def test_arrays_of_copies_stay_read_only() -> None:
    @guard_result
    @dataclass(frozen=True)
    class Locked:
        table: Any
        several: Any = ()

        @cached_property
        def later(self) -> Any:
            return np.zeros(2)

        @cached_property
        def rows(self) -> Any:
            return Pair(np.zeros(1), 1), [np.zeros(1)]

        @cached_property
        def _hidden(self) -> Any:
            return np.zeros(2)

    made = Locked(np.zeros(2), (np.zeros(1), "a"))
    made.later  # noqa: B018
    for each in (made, copy.deepcopy(made), copy.copy(made), replace(made, several=made.several)):
        for array in (each.table, each.several[0], each.later, each.rows[0].first):
            assert not array.flags.writeable
        assert type(each.rows[0]) is Pair
        assert type(each.rows[1]) is tuple
        assert not each.rows[1][0].flags.writeable
        assert each._hidden.flags.writeable
    assert made.several is replace(made).several


def test_tables_of_kernels_are_read_only_to_readers_alone() -> None:
    @guard_result
    @dataclass(frozen=True)
    class Table:
        KERNEL_FIELDS: ClassVar = ("rows",)
        rows: Any
        other: Any

    locked = np.zeros(2)
    locked.flags.writeable = False
    given = np.zeros(2)
    for rows in (given, locked):
        made = Table(rows, np.zeros(1))
        assert not made.rows.flags.writeable
        assert not made.other.flags.writeable
        assert vars(made)["rows"].flags.writeable
    assert vars(Table(given, 1))["rows"] is given
    assert vars(Table("a", 1))["rows"] == "a"


def test_plain_arrays_pass_as_they_are_and_others_lose_nothing() -> None:
    for array in (np.arange(3), np.arange(3.0), np.arange(3, dtype=np.uint8)):
        assert numeric_array("x", array) is array
    for kinds, array in (("U", np.array(["a"])), ("c", np.array([1j])), (None, np.array([True]))):
        assert numeric_array("x", array, kinds) is array
    long = np.array([1.0, 1e308], dtype=np.longdouble)
    assert numeric_array("x", long).dtype == np.float64
    assert np.isinf(numeric_array("x", long * 100)[1])
    mixed = numeric_array("x", [[Fraction(1, 2), 1], [2.5, Fraction(3)]])
    assert mixed.tolist() == [[0.5, 1.0], [2.5, 3.0]]
    assert mixed.dtype == np.float64
    ragged = [[1.0], [1.0, 2.0]]
    assert numeric_array("x", ragged, None) is ragged
    words = {
        "it must be an array of numbers": ragged,
        "it must be an array of real numbers, not bool": [True],
        "it must be an array of real numbers, not object": [Fraction(1), None],
        "it must be an array of real numbers, not complex128": [1j],
        "it is a Decimal, and numbers are computed as floats": [[Decimal(1)]],
        "it must have at most 100000000 elements": np.broadcast_to(1.0, 100_000_001),
    }
    for valid, value in words.items():
        assert _refused(numeric_array, "x", value)[0] == valid
    for value in ([Fraction(1), True], [Fraction(1), np.True_], [Fraction(1), "a"]):
        assert _refused(numeric_array, "x", value)[0].startswith("it must be an array of real")
    most = np.broadcast_to(1.0, 100_000_000)
    assert numeric_array("x", most) is most


def _refused(check: Any, *given: Any) -> tuple[str, str]:
    """Return the clauses of a refusal."""
    with pytest.raises(UnfitError) as caught:
        check(*given)
    valid, hint = caught.value.args
    return valid, hint


def test_masks_units_and_decimals_are_seen_four_lists_deep_and_no_deeper() -> None:
    lost = Quantity(1.0, "cm"), Decimal(1), np.ma.array([1.0, 2.0], mask=[True, False])
    for value in lost:
        for depth in range(5):
            refuse_mask_and_unit("x", _nested(value, depth + 1), depth)
            for looked in (depth, 4):
                with pytest.raises(UnfitError):
                    refuse_mask_and_unit("x", _nested(value, depth), looked)
        refuse_mask_and_unit("x", _nested(value, 5))
    assert _refused(refuse_mask_and_unit, "x", lost[2]) == (
        "1 of its 2 elements are masked, and a mask would be lost",
        "fill them, or leave them out with .compressed()",
    )
    refuse_mask_and_unit("x", np.ma.array([1.0, 2.0], mask=[False, False]))


def _nested(value: Any, depth: int) -> Any:
    """Return a value inside of so many lists and tuples."""
    for level in range(depth):
        value = [1.0, value] if level % 2 else (value,)
    return value


def test_a_quantity_is_told_its_unit_by_the_name_of_its_argument() -> None:
    units = {
        "acceleration_m_s2": "'m/s^2'",
        "velocity_m_s": "'m/s'",
        "frequency_hz": "'Hz'",
        "width_m": "'m'",
        "dt_s": "'s'",
    }
    for name, unit in units.items():
        assert _refused(refuse_mask_and_unit, name, Quantity(1.0, "cm")) == (
            "it carries a unit, which would be lost",
            f"give the number, .to({unit}).magnitude",
        )
    assert _refused(refuse_mask_and_unit, "width", Quantity(1.0, "cm"))[1] == (
        "give the number, .to(...).magnitude in the unit documented"
    )
    for unit in ("m", "m s-2", "rad/s", "1", "", "kg", "Hz"):
        refuse_mask_and_unit("x", xarray.DataArray([1.0], attrs={"units": unit}))
    refuse_mask_and_unit("x", xarray.DataArray([1.0], attrs={"title": "a"}))
    assert _refused(refuse_mask_and_unit, "x", xarray.DataArray([1.0], attrs={"units": "g"})) == (
        "its units attribute is 'g', and arguments are in SI units",
        "convert it and set its units attribute",
    )


def test_scalars_become_plain_and_what_is_none_stays() -> None:
    rows: list[tuple[Any, Any]] = [
        (np.float32(0.5), 0.5),
        (np.int8(3), 3),
        (np.array(2.5), 2.5),
        (np.array(2), 2),
        (np.True_, True),
        (np.array("a"), "a"),
        (Fraction(1, 4), 0.25),
        (Fraction(10**400), math.inf),
        (Fraction(-(10**400)), -math.inf),
        (np.longdouble(0.5), 0.5),
        (10**400, 10**400),
        (True, True),
        ("a", "a"),
        (1j, 1j),
    ]
    for given, plain in rows:
        taken = scalar_of(given)
        assert (type(taken), taken) == (type(plain), plain), given
    kept: list[Any] = [np.array([1.0]), np.ma.masked, Quantity(1.0, "m"), Decimal(1), float, None]
    for given in kept:
        assert scalar_of(given) is given
