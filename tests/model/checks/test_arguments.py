"""The types of public arguments: what is refused at the door, and what the line says."""

import inspect
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from functools import partial
from typing import Annotated, Any, Literal, NamedTuple, Optional, TypeVar

import numpy as np
import pytest
import xarray
from numpy.typing import ArrayLike, NDArray
from typing_extensions import TypeAliasType

import rocksteady
from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Record,
    Rest,
    compute_rocking_spectrum,
    simulate,
)
from rocksteady.errors import InputError
from rocksteady.export import ExplorerView
from rocksteady.formulas import housner_restitution, impact_restitution, steady_states
from rocksteady.measures import compute_response_spectrum
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.arrays import guard_result
from rocksteady.model.checks.bounds import Bounds, Whole
from rocksteady.motions import add
from rocksteady.sweeps import Axis
from tests.every import every
from tests.public.junk import Quantity
from tools.namespace import THINGS

BLOCK = Block.rectangle(width=0.4, height=1.2)
BARE = DimensionlessBlock(restitution=0.8)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=4.0)
RECORD = Record(acceleration_m_s2=np.array([0.0, 1.0, -1.0]), dt_s=0.01)
MASKED = np.ma.array([1.0, -99999.0, 2.0], mask=[False, True, False])


@every(
    ("call", "words"),
    [
        (
            lambda: Harmonic.from_si(BARE, acceleration_m_s2=1.0, frequency_hz=2.0),  # type: ignore[arg-type]
            ["block = <DimensionlessBlock: ", "it must be a Block;", "Block.rectangle("],
        ),
        (lambda: simulate(BLOCK, Harmonic), ["motion = ", "it must be a Motion"]),  # type: ignore[arg-type]
        (lambda: ExplorerView(motion=Harmonic), ["motion = ", "it must be a Harmonic"]),  # type: ignore[arg-type]
        (
            lambda: simulate(SHAKING, BLOCK),  # type: ignore[arg-type]
            ["block = ", "a Block or a DimensionlessBlock; the block comes first"],
        ),
        (lambda: steady_states(2.0, 4.0, 0.8, order="1"), ["order = '1'", "a whole number"]),
        (lambda: steady_states(2.0, 4.0, 0.8, order=MASKED), ["order = ", "1 of its 3 elem"]),
        (lambda: simulate(BLOCK, SHAKING, model="cubic"), ["model = 'cubic'"]),  # type: ignore[arg-type]
        (lambda: simulate(BLOCK, SHAKING, start=Rest), ["start = ", "a Rest, a State, a"]),  # type: ignore[arg-type]
        (lambda: simulate(BLOCK, SHAKING, max_flights=2**64), ["max_flights = 18446744073709"]),
        (
            lambda: compute_rocking_spectrum(RECORD, alpha=[], periods_s=1.0),
            ["alpha = ", "one value"],
        ),
        (lambda: add(SHAKING, 3.0), ["motions = 3.0", "it must be a Motion"]),  # type: ignore[arg-type]
        (lambda: housner_restitution(0.2, p=math.nan), ["p = nan"]),
        (lambda: housner_restitution(0.2, radius=-1.0), ["radius = -1.0"]),
        (lambda: impact_restitution((0.2, 0.3), (1.0, 1.1), gyration=-0.5), ["gyration = -0.5"]),
        (lambda: impact_restitution((0.2, math.nan), (1.0, 1.1), gyration=0.5), ["alphas = "]),
        (lambda: steady_states([[1.0, 2.0], [3.0]], 4.0, 0.8), ["amplitude = ", "one length"]),
        (lambda: steady_states(np.broadcast_to(1.0, 10**12), 4.0, 0.8), ["at most 100000000"]),
        (lambda: Block.rectangle(width=1e308, height=1.0), ["width = 1e+308"]),
    ],
)  # fmt: skip
def test_what_is_no_such_thing_is_refused_in_one_line(call: Any, words: list[str]) -> None:
    with pytest.raises(InputError) as caught:
        call()
    line = str(caught.value)
    assert "\n" not in line
    for word in words:
        assert word in line


@every(
    "call",
    [
        lambda x: Record(acceleration_m_s2=x, dt_s=0.01),
        lambda x: steady_states(x, 4.0, 0.8),
        lambda x: rocksteady.sweeps.Axis(name="amplitude", values=x),
        lambda x: compute_response_spectrum(RECORD, x),
        lambda x: simulate(BLOCK, SHAKING, cycles=1).at_time(x),
        lambda x: simulate(BLOCK, SHAKING, cycles=1).base_acceleration(x),
    ],
)
def test_a_mask_a_unit_and_no_number_are_refused_everywhere(call: Any) -> None:
    with pytest.raises(InputError, match="1 of its 3 elements are masked"):
        call(MASKED)
    for quantity in (Quantity(np.array([0.1, 0.2]), "cm"), [Quantity(0.1, "cm")]):
        with pytest.raises(InputError, match=r"it carries a unit.*magnitude"):
            call(quantity)
    with pytest.raises(InputError, match="its units attribute is 'mm'"):
        call(xarray.DataArray([0.1, 0.2], attrs={"units": "mm"}))
    for array in (np.array([True, False]), np.array([0.1, None]), [0.1j, 0.2]):
        with pytest.raises(InputError):
            call(array)


@every("within", [5, "ab", (1.9,), (1.0, 2.0, 3.0)])
def test_what_is_no_pair_is_refused_with_a_pair(within: Any) -> None:
    block, motion = DimensionlessBlock(restitution=0.8), Harmonic(amplitude=2.0, frequency_ratio=4)
    with pytest.raises(InputError, match=r"within = .* 2 values; give a pair, as \(1.0, 2.0\)$"):
        rocksteady.find_bifurcations(block, motion, "amplitude", within=within)


def test_scalars_keep_neither_a_mask_nor_a_unit() -> None:
    values: tuple[Any, ...] = (
        np.ma.masked,
        Quantity(0.4, "m"),
        xarray.DataArray(0.4, attrs={"units": "mm"}),
    )
    for value in values:
        with pytest.raises(InputError, match=r"^width = "):
            Block.rectangle(width=value, height=1.2)


def test_an_array_in_si_and_a_mask_without_effect_are_taken() -> None:
    plain = steady_states([1.0, 2.0], 4.0, 0.8).phase
    si = xarray.DataArray([1.0, 2.0], dims="x", attrs={"units": "1"})
    for given in (si, np.ma.array([1.0, 2.0]), np.array([1.0, 2.0], dtype=">f8")):
        assert np.array_equal(steady_states(given, 4.0, 0.8).phase, plain, equal_nan=True)


def test_sizes_like_millimetres_are_questioned() -> None:
    with pytest.warns(UserWarning, match=r"a block 1800 m high.*give width=0\.6, height=1\.8"):
        Block.rectangle(width=600, height=1800)
    with pytest.warns(UserWarning, match=r"radius=950 make.*give radius=0\.95"):
        Block.from_radius(alpha=0.3, radius=950)
    with pytest.warns(UserWarning, match=r"give left=0\.3, right=0\.3, height=1\.8"):
        Block.asymmetric(left=300, right=300, height=1800)
    with pytest.warns(UserWarning, match="sizes are in metres"):
        Block.from_alphas(positive=0.2, negative=0.3, radius=950)
    with pytest.warns(UserWarning, match="sizes are in metres"):
        Block.general(mass=1.0, inertia=1.2e6, radius=950, alpha=0.3)
    with pytest.warns(UserWarning, match="sizes are in metres"):
        Block.rectangle(width=60, height=180)
    with pytest.warns(UserWarning, match="sizes are in metres"):
        Block.asymmetric(left=200, right=400, height=1800)
    # Towers that stand: warnings are errors here.
    Block.rectangle(width=16.8, height=169.0)
    Block.rectangle(width=3.0, height=30.0)
    Block.from_p(alpha=0.2, p=1e-3)


def test_signatures_and_annotations_stay() -> None:
    parameters = inspect.signature(simulate).parameters
    assert list(parameters)[:4] == ["block", "motion", "start", "cycles"]
    assert simulate.__module__ == "rocksteady.dynamics.history.simulate"
    assert simulate.__doc__ is not None
    assert list(inspect.signature(Block.rectangle).parameters) == [
        "width", "height", "restitution", "gravity",
    ]  # fmt: skip
    with pytest.raises(InputError, match=r"cycels = 2 .*simulate has no such .*mean cycles\?"):
        simulate(BLOCK, SHAKING, cycels=2)  # type: ignore[call-arg]


def test_a_rule_stands_in_an_annotation_and_the_signature_shows_the_type_alone() -> None:
    share = Bounds(0.0, 1.0, "(]", "give a share")
    none: Any = None

    @checked
    def taken(
        first: Annotated[float, share],
        *,
        last: Annotated[float | None, share] = 0.5,
        text: str = "",
    ) -> object:
        return first, last, text

    @checked
    @dataclass(frozen=True, kw_only=True)
    class Kept:
        part: Annotated[float, share]
        count: Annotated[int, Whole(1, None, "give 1")] = 1

    assert taken(np.float32(0.5), last=None) == (0.5, None, "")  # type: ignore[arg-type]
    assert str(inspect.signature(taken)) == "(first: float, *, last: float | None = 0.5, text: str = '') -> object"  # fmt: skip  # noqa: E501
    assert str(inspect.signature(Kept)) == "(*, part: float, count: int = 1) -> None"
    other: Any = {"part": np.array(1.0), "count": np.int8(1)}
    assert repr(Kept(part=1)) == repr(Kept(**other))
    assert type(replace(Kept(part=1), part=1).part) is float
    calls: list[tuple[Callable[[], object], str]] = [
        (lambda: taken(0.0), "first = 0.0 is not valid: it must lie in (0, 1]; give a share"),
        (lambda: taken(0, last=math.nan), "first = 0 is not valid"),
        (lambda: taken(1.0, last=math.nan), "last = nan is not valid"),
        (lambda: taken(none), "first = None is not valid: it must lie in (0, 1]"),
        (lambda: Kept(part=2.0, count=0), "part = 2.0 is not valid"),
        (lambda: Kept(part=1.0, count=0), "count = 0 is not valid: it must be a whole number of 1"),
    ]
    for call, line in calls:
        with pytest.raises(InputError, match=re.escape(line)):
            call()


def test_types_come_before_rules_and_a_call_that_does_not_fit_before_both() -> None:
    @checked
    def taken(
        first: Annotated[float, Bounds(0.0, 1.0, "[]", "give 1")], *, names: list[str]
    ) -> None:
        pass

    with pytest.raises(InputError, match="names = 1 is not valid"):
        taken(2.0, names=1)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="names is not given"):
        taken(2.0)  # type: ignore[call-arg]
    with pytest.raises(InputError, match="name = 1 is not valid: taken has no such argument"):
        taken(2.0, names=[], name=1)  # type: ignore[call-arg]
    with pytest.raises(InputError, match=r"first = 2\.0 is not valid"):
        taken(2.0, names=[])


def test_every_public_function_is_checked() -> None:
    bare = {
        name
        for name, thing in THINGS.items()
        if inspect.isfunction(thing) and not hasattr(thing, "__wrapped__")
    }
    assert bare == set()


def test_a_doctest_finder_sees_through_the_check() -> None:
    @checked
    def function(x: float) -> float:
        return x

    assert function.__globals__ is globals()


@every("kind", [np.int8, np.uint8, np.int16, partial(np.array, dtype=np.int8)])
def test_integers_of_small_types_are_plain_ones(kind: Any) -> None:
    @checked
    def taken(cycles: int, width: float, most: int | None = None) -> tuple[object, ...]:
        return cycles, width, most

    found = taken(kind(3), width=kind(4), most=kind(5))
    assert found == (3, 4, 5)
    assert {type(number) for number in found} == {int}


@every("kind", [np.float16, np.longdouble, Fraction, partial(np.array, dtype=np.float32)])
def test_floats_of_other_types_are_plain_ones(kind: Any) -> None:
    @checked
    def taken(width: float, *, pair: tuple[float, float]) -> tuple[object, ...]:
        return width, *pair

    found = taken(kind(0.5), pair=(kind(1.0), kind(2.0)))
    assert found == (0.5, 1.0, 2.0)
    assert {type(number) for number in found} == {float}


@every(
    "call",
    [
        lambda number: Harmonic(amplitude=2.0, frequency_ratio=number),
        lambda number: DimensionlessBlock(restitution=number),
        lambda number: steady_states(2.0, 4.0, number),
        lambda number: steady_states(2.0, [4.0, number], 0.8),
        lambda number: Record(acceleration_m_s2=np.array([0.0, number]), dt_s=0.01),
        lambda number: Axis(name="amplitude", values=[number]),
        lambda number: simulate(BLOCK, SHAKING, cycles=number),
    ],
)
def test_fractions_are_taken_and_decimals_are_refused_everywhere(call: Any) -> None:
    call(Fraction(4, 5))
    with pytest.raises(InputError, match="it is a Decimal, and numbers are computed as floats"):
        call(Decimal("0.8"))


def test_a_fraction_beyond_the_floats_is_infinite_and_refused() -> None:
    huge: Any = Fraction(-(10**400))
    with pytest.raises(InputError, match="frequency_ratio = -inf is not valid"):
        steady_states(2.0, [4.0, huge], 0.8)


def test_a_choice_of_two_is_said_in_quotes_and_of_three_as_a_list() -> None:
    @checked
    def taken(side: Literal["left", "right"], way: Literal["a", "b", "c"] = "a") -> None:
        pass

    wrong: Any = "up"
    with pytest.raises(InputError, match=r"side = 'up' .*must be 'left' or 'right'; give"):
        taken(wrong)
    with pytest.raises(InputError, match=r"way = 'up' .*must be one of a, b, c; give"):
        taken("left", wrong)


def test_arrays_are_short_words_in_a_signature_and_other_lists_stay() -> None:
    @checked
    def taken(
        first: ArrayLike, names: Sequence[str], last: ArrayLike | None = None
    ) -> NDArray[np.float64]:
        return np.asarray([first, names, last])

    expected = "(first: ArrayLike, names: Sequence[str], last: ArrayLike | None = None) -> ndarray"
    assert str(inspect.signature(taken)).partition("[Any")[0] == expected  # of earlier NumPy too


def test_arrays_of_a_kept_class_are_read_only_views_in_fields_and_tuples() -> None:
    class Pair(NamedTuple):
        one: Any
        other: Any

    @guard_result
    @dataclass(frozen=True)
    class Kept:
        array: Any
        several: Any
        plain: Any

    given, plain = np.zeros(3), (1.0, ("a", None))
    kept = Kept(given, (given, Pair(given, 2.0)), plain)
    for view in (kept.array, kept.several[0], kept.several[1].one):
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 1.0
    assert type(kept.several[1]) is Pair
    assert kept.plain is plain
    given[0] = 1.0
    assert kept.array[0] == 1.0


def test_aliases_of_arrays_are_checked_as_what_they_stand_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """From Python 3.12 and NumPy 2.5 on, ArrayLike and NDArray are aliases, of aliases."""
    item = TypeVar("item", bound=np.generic)
    array = TypeAliasType("array", np.ndarray[Any, np.dtype[item]], type_params=(item,))
    inner = TypeAliasType("inner", Sequence[float] | float)
    like = TypeAliasType("like", memoryview | inner)
    monkeypatch.setattr("numpy.typing.ArrayLike", like)

    def call(values: Any, more: Any = None, whole: Any = None) -> tuple[Any, ...]:
        return values, more, whole

    call.__annotations__ |= {
        "values": like,
        "more": Optional[like],  # noqa: UP045 -- a union of an alias
        "whole": Optional[array[np.float64]],  # noqa: UP045
    }
    taken = checked(call)([1, 2.5], 3, np.arange(2.0))
    assert [np.asarray(each).tolist() for each in taken] == [[1.0, 2.5], 3.0, [0.0, 1.0]]
    for name in ("values", "more", "whole"):
        with pytest.raises(InputError, match=f"{name} = "):
            checked(call)(**{"values": 1.0, name: MASKED})
    assert str(inspect.signature(checked(call))).startswith(
        "(values: ArrayLike, more: ArrayLike | None = None, whole: "
    )
