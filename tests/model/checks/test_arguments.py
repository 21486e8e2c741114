"""The types of public arguments: what is refused at the door, and what the line says."""

import inspect
import itertools
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    Optional,
    Protocol,
    TypeVar,
    runtime_checkable,
)

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
from rocksteady.model.checks.arguments import checked, checked_result
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


@runtime_checkable
class Walks(Protocol):
    """What walks."""

    def walk(self) -> int:
        """Return steps."""
        ...


class Walker:
    """Something that walks."""

    def walk(self) -> int:
        """Return steps."""
        return 1


class Rambler(Walker):
    """What walks too."""


class _Hostile:
    """What fails where it is looked at."""

    @property
    def shape(self) -> Any:
        raise RuntimeError

    def __iter__(self) -> Any:
        raise RuntimeError


WALKER, PATH = Walker(), Path("a", "b")
WHOLE, REAL = (
    ("it must be a whole number", "give an int"),
    ("it must be a real number", "give a float"),
)
TEXT, LIST = ("it must be a text", "give a str"), ("it must be a list or a tuple", "give a list")
LIST_OF = ("it must be a list or a tuple", "give a list of them")
MAKE = "make one with Block.rectangle(width=..., height=...)"
READ = "read one with read_record(path), or make a Record(acceleration_m_s2=..., dt_s=...)"
NO_PAIRS: list[Any] = [(), (1.0,), (1.0, 2.0, 3.0), "ab", {1: 2, 3: 4}, 1, b"ab", tuple, _Hostile()]
NO_PATH = ("it must be a path", "give a str or a pathlib.Path")
NOTHING = ("it must be None", "leave it out")
TYPES: list[tuple[Any, list[Any], list[tuple[Any, tuple[str, str]]]]] = [
    (float, [1.0, 2, "a", None, True, [1.0]], []),
    (int, [1.0, 2, "a", None, True], []),
    (None, [None], [(0, NOTHING), (False, NOTHING)]),
    (object, [None, 1, "a", float], []),
    (Any, [None, 1, "a", float], []),
    (
        str,
        ["a", "", b"a", 1.0, None],
        [(["a"], TEXT), (PATH, TEXT), ({}, TEXT), (Decimal(1), TEXT)],
    ),
    (
        Path,
        [PATH, "a", "a" * 255, "/".join(["a" * 255] * 3)],
        [
            (1, NO_PATH),
            (b"a", NO_PATH),
            (None, NO_PATH),
            (Path, NO_PATH),
            ("\ud800\udfff" + chr(0xD800), NO_PATH),
            ("a\0b", ("it must be a path, in text", NO_PATH[1])),
            ("", ("it must be a path, not an empty text", "name a file or a folder")),
            ("a" * 256, ("it must be a path of names up to 255 bytes", "shorten it")),
            ("b/" + "ä" * 128, ("it must be a path of names up to 255 bytes", "shorten it")),
        ],
    ),
    (
        Callable,
        [len, Walker().walk, lambda: 1],
        [(each, ("it must be a function", "give a callable")) for each in (1, "a", int, None)],
    ),
    (
        Literal["a", "b"],
        ["a", "b", np.array("b")],
        [(each, ("it must be 'a' or 'b'", "give one of them")) for each in ("c", 1, None, ["a"])],
    ),
    (
        Literal[1, -1],
        [1, -1, np.int8(1)],
        [(each, ("it must be 1 or -1", "give one of them")) for each in (True, 1.0, 0, "1", None)],
    ),
    (
        Literal["a", "b", "c"],
        ["c"],
        [("d", ("it must be one of a, b, c", "give one of them"))],
    ),
    (
        bool,
        [True, False, np.True_],
        [(each, ("it must be True or False", "give a bool")) for each in (0, 1, "a", None)],
    ),
    (
        Block,
        [BLOCK],
        [
            (BARE, ("it must be a Block", MAKE)),
            (SHAKING, ("it must be a Block", "the block comes first, then the shaking")),
            (Block, ("it must be a Block", "make one of the class, Block(...)")),
        ],
    ),
    (
        Harmonic,
        [SHAKING, rocksteady.Still()],  # the function says why it takes no other motion
        [(BLOCK, ("it must be a Harmonic", "make a Harmonic(amplitude=..., frequency_ratio=...)"))],
    ),
    (Axis, [Axis(name="amplitude", values=[1.0])], [(1, ("it must be an Axis", "give an Axis"))]),
    (
        Walks,
        [WALKER],
        [(each, ("it must be a Walks", "give a Walks")) for each in (1, None, BLOCK)]
        + [(Walker, ("it must be a Walks", "give a Walks"))],
    ),
    ("Walker", [WALKER, Rambler()], [(1, ("it must be a Walker", "give a Walker"))]),
    ("None | Walker", [WALKER, None], [(1, ("it must be a Walker", "give a Walker"))]),
    ("Envelope", [], [(1, ("it must be an Envelope", "give an Envelope"))]),
    ("x.Record", [RECORD], [(1, ("it must be a Record", READ))]),
    ("Mapping[str, float]", [1, None], []),  # no class by its name
    (
        tuple[float, float],
        [(1.0, 2.0)],
        [
            (each, ("it must be a tuple of 2 values", "give a pair, as (1.0, 2.0)"))
            for each in NO_PAIRS
        ]
        + [
            ((1.0, math.nan), ("it must not hold NaN", "leave NaN out")),
            ((None, 1.0), REAL),
            ((1.0, "a"), REAL),
        ],
    ),
    (
        tuple[int, str, int],
        [(1, "a", 2)],
        [
            ((1, "a"), ("it must be a tuple of 3 values", "give a list of as many")),
            ((1, "a", 2.0), WHOLE),
            ((True, "a", 2), WHOLE),
            ((1, 2, 2), TEXT),
        ],
    ),
    (tuple[int, ...], [(), (1,), (1, 2, 3)], [((1, 2.0), WHOLE), (1, LIST), ("ab", LIST_OF)]),
    (
        Sequence[float],
        [[1.0], (), (1.0, 2)],
        [(iter([1.0]), LIST), ({1.0}, LIST), (1.0, LIST), ([True], REAL), ([None], REAL)],
    ),
    (Iterable[int], [[1], (1, 2)], [([1.0], WHOLE), (1, LIST_OF), ("ab", LIST_OF)]),
    (list[str], [["a"]], [("a", LIST_OF), ([1], TEXT), ({"a": 1}, LIST_OF), (b"a", LIST_OF)]),
    (
        Mapping[str, float],
        [{}, {"a": 2, "b": 0.5}],
        [
            ([("a", 1)], ("it must be a mapping", "give a dict")),
            (None, ("it must be a mapping", "give a dict")),
            ({None: 1}, ("its keys must be texts", "give a dict of names")),
        ],
    ),
    (float | None, [1.0, None, "a", True], []),
    (
        float | Block,
        [1.0, BLOCK, "a", None],
        [
            ([], ("it must be a number or a Block", MAKE)),
            ({}, ("it must be a number or a Block", MAKE)),
        ],
    ),
    (Block | None, [BLOCK, None], [(1, ("it must be a Block", MAKE))]),
    (
        Block | DimensionlessBlock,
        [BLOCK, BARE],
        [(1, ("it must be a Block or a DimensionlessBlock", MAKE))],
    ),
    (
        Path | str | None,
        [PATH, "a", None],
        [(1, NO_PATH), ("a\0b", ("it must be a path, in text", NO_PATH[1]))],
    ),
    (
        bool | list[int],
        [True, [1]],
        [(1, ("it must be True or False or a list or a tuple", "give a bool"))],
    ),
]
"""Of annotations: what passes, and what is refused with which clauses."""


def _outcome(call: Callable[..., Any], *given: Any, **named: Any) -> Any:
    """Return what a call returns, or name and clauses of its refusal."""
    try:
        return call(*given, **named)
    except InputError as error:
        return error.name, error.valid, error.hint


def test_each_annotation_takes_its_values_and_says_what_else_it_wants() -> None:
    wrong = []
    for annotation, fit, unfit in TYPES:

        def taken(x: Any) -> Any:
            return x

        def several(*x: Any) -> Any:
            return x

        for function in (taken, several):
            function.__annotations__["x"] = annotation
        once, often = checked(taken), checked(several)
        rows = [(value, value) for value in fit]
        rows += [(value, ("x", *clauses)) for value, clauses in unfit]
        for value, expected in rows:
            kept = (*fit[:1], value) if any(value is each for each in fit) else expected
            outcomes = [
                (_outcome(once, value), expected),
                (_outcome(once, x=value), expected),
                (_outcome(often, *fit[:1], value), kept),
            ]
            if any(found is not right and found != right for found, right in outcomes):
                wrong.append((annotation, value, outcomes))
    assert not wrong, "\n".join(map(repr, wrong))


def test_numbers_are_checked_in_results_and_left_to_the_validators_elsewhere() -> None:
    def given(kind: Any) -> Any:
        @kind
        @dataclass(frozen=True)
        class Kept:
            real: float = 0.0
            whole: int = 0
            text: str = ""
            row: Any = None

            def turned(self, by: float, _more: int = 0) -> Any:
                return by

            @classmethod
            def of(cls, real: float) -> Any:
                return cls(real)

            @staticmethod
            def alone(whole: int, names: list[str]) -> Any:
                return whole, names

            def _hidden(self, names: list[str]) -> Any:
                return names

            def __call__(self, names: list[str]) -> Any:
                return names

        return Kept

    result, plain = given(checked_result), given(checked)
    for name, value, clauses in (
        ("real", "a", REAL),
        ("real", True, REAL),
        ("real", None, REAL),
        ("whole", 1.0, WHOLE),
        ("whole", True, WHOLE),
        ("text", 1.0, TEXT),
    ):
        assert _outcome(result, **{name: value}) == (name, *clauses), (name, value)
        assert getattr(plain(**{name: value}), name) is value, (name, value)
    assert math.isnan(result(real=np.float32(math.nan)).real)
    assert type(result(real=np.float32(0.5)).real) is float
    assert type(result(np.int8(2)).whole) is int
    for kind in (result, plain):
        kept = kind()
        assert kept.turned("a") == "a"
        assert type(kept.turned(np.float32(0.5))) is float
        assert kept._hidden(1) == 1
        assert _outcome(kept, 1) == ("names", *LIST)
        assert kept(["a"]) == ["a"]
        assert type(kind.of(np.float32(0.5)).real) is float
        assert type(kind.alone(np.int8(1), ["a"])[0]) is int
        assert _outcome(kind.alone, 1, names=["a", 1]) == ("names", *TEXT)
        assert _outcome(kept.alone, 1, 2) == ("names", *LIST)


def test_arguments_keep_their_places_whatever_they_are_given_by() -> None:
    @checked
    def checked_call(
        first: float, second: float, *rest: float, last: float = 4.0, **more: float
    ) -> Any:
        return first, second, *rest, last, more

    taken: Any = checked_call
    one, two, three, four = (Fraction(number) for number in (1, 2, 3, 4))
    outcomes: list[tuple[Any, tuple[Any, ...]]] = [
        (taken(one, two), (1.0, 2.0, 4.0, {})),
        (taken(second=two, first=one), (1.0, 2.0, 4.0, {})),
        (taken(one, second=two, last=three), (1.0, 2.0, 3.0, {})),
        (taken(one, two, three, four, last=one), (1.0, 2.0, 3.0, 4.0, 1.0, {})),
        (taken(one, two, other=5.0), (1.0, 2.0, 4.0, {"other": 5.0})),
    ]
    for outcome, expected in outcomes:
        assert outcome == expected
        assert {type(each) for each in outcome[:-1]} == {float}


def test_what_can_be_gone_through_once_is_kept_as_a_tuple() -> None:
    @checked
    def taken(x: Iterable[int], y: Sequence[int] = ()) -> tuple[object, object]:
        return x, y

    given: list[Iterable[int]] = [iter([1, 2]), (k for k in (1, 2)), {1: "a", 2: "b"}.keys()]
    for each in given:
        assert taken(each)[0] == (1, 2)
    rows = np.array([1, 2])
    assert taken(rows)[0] == (1, 2)
    with pytest.raises(InputError, match=r"y = .* it must be a list or a tuple; give a list"):
        taken([], iter([1]))  # type: ignore[arg-type]
    endless = itertools.count()
    with pytest.raises(InputError, match=r"x = .* it must have at most 1000000 items; give fewer"):
        taken(endless)


def test_a_mask_and_a_unit_are_named_in_a_union_too() -> None:
    @checked
    def taken(x: Block | list[float], y: float | Block = 1.0) -> tuple[object, object]:
        return x, y

    masked: Any = MASKED
    quantity: Any = Quantity(1.0, "cm")
    mask = "1 of its 3 elements are masked, and a mask would be lost"
    unit = "it carries a unit, which would be lost"
    assert _outcome(taken, masked)[:2] == ("x", mask)
    assert _outcome(taken, [quantity])[:2] == ("x", unit)
    assert _outcome(taken, [1.0], quantity)[:2] == ("y", unit)
