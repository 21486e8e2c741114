"""The error tree, and the errors of calls that do not fit a signature."""

import enum
import inspect
import pickle
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rocksteady
from rocksteady.errors import (
    InputError,
    MissingKernelsError,
    ModelError,
    OutputError,
    RocksteadyError,
    Words,
    with_call_errors,
)
from tests.every import every
from tools.namespace import THINGS

KINDS = (InputError, ModelError, OutputError, MissingKernelsError)


def restitution_error(value: object = 1.2) -> InputError:
    return InputError(
        "restitution", value, "it must lie in (0, 1]", "give a ratio of angular velocities"
    )


def test_the_line_of_an_input_error() -> None:
    assert str(restitution_error()) == (
        "restitution = 1.2 is not valid: it must lie in (0, 1]; give a ratio of angular velocities"
    )


def test_the_line_of_a_model_error() -> None:
    error = ModelError(
        "model", "linear", "the linear equations have no vertical motion", "take model='nonlinear'"
    )
    assert str(error) == (
        "model = 'linear' is refused by the model: the linear equations have no vertical motion; "
        "take model='nonlinear'"
    )


def test_the_line_of_an_output_error() -> None:
    error = OutputError("--plot", Path("a.png"), "the file exists", "add --force")
    assert str(error) == "--plot = 'a.png' cannot be written: the file exists; add --force"


def test_the_line_of_missing_kernels() -> None:
    error = MissingKernelsError(
        "compiled code",
        Words("is missing"),
        "there is no library for this system, and no numba",
        "install numba",
    )
    assert str(error) == (
        "compiled code is missing: there is no library for this system, and no numba; install numba"
    )


def test_a_message_is_one_short_printable_line_of_whatever_it_is_made() -> None:
    deep: list[Any] = []
    for _ in range(3_000):
        deep = [deep]
    name = "a" * 5_000 + "\n\udcff\x1b"
    for part in (name, f"it must be {name}"):
        for value in (deep, {1: deep}, name, Words(name), Path(name), 1.0):
            line = str(InputError(part, value, part, part))
            assert line.isprintable(), line
            assert len(line) < 600
            line.encode()
    assert "[0] = <list> is not valid" in str(InputError("[0]", deep, "a", "b"))


@every("kind", KINDS)
def test_every_error_is_caught_as_a_rocksteady_error(kind: type[RocksteadyError]) -> None:
    with pytest.raises(RocksteadyError):
        raise kind(name="a", value=0, valid="b", hint="c")


@every(("kind", "is_one"), [*zip(KINDS, (True, True, False, False), strict=True)])
def test_what_is_wrong_with_arguments_is_a_value_error(
    kind: type[RocksteadyError], is_one: bool
) -> None:
    assert issubclass(kind, ValueError) is is_one


@every("kind", KINDS)
def test_an_error_comes_back_whole_from_another_process(kind: type[RocksteadyError]) -> None:
    error = kind(name="width", value=-1.0, valid="it must be above 0", hint="give metres")
    back = pickle.loads(pickle.dumps(error))
    assert type(back) is kind
    assert str(back) == str(error)
    assert vars(back) == vars(error)


def test_an_error_carries_its_parts() -> None:
    error = restitution_error()
    assert (error.name, error.value) == ("restitution", 1.2)
    assert (error.valid, error.hint) == (
        "it must lie in (0, 1]",
        "give a ratio of angular velocities",
    )


@every(
    ("value", "shown"),
    [
        (np.float64(1.2), "1.2"),
        (np.int64(2), "2"),
        (float("nan"), "nan"),
        (2j, "2j"),
        ("housner", "'housner'"),
        (None, "None"),
        (np.array([[1.0, 2.0], [3.0, 4.0]]), "array([[1., 2.], [3., 4.]])"),
    ],
)
def test_how_a_value_is_shown(value: object, shown: str) -> None:
    assert str(restitution_error(value)).startswith(f"restitution = {shown} is not valid")


@given(st.one_of(st.text(), st.binary(), st.lists(st.floats()), st.integers()))
def test_the_message_is_one_line_of_bounded_length_whatever_the_value(value: object) -> None:
    message = str(restitution_error(value))
    assert message.splitlines() == [message]
    assert len(message) <= len(str(restitution_error(""))) + 100


def test_a_long_value_keeps_its_beginning_and_its_end() -> None:
    path = Path("results") / ("x" * 300) / "steady.png"
    message = str(restitution_error(path))
    assert message.startswith("restitution = 'results")
    assert "steady.png' is not valid" in message


def test_what_is_no_value_is_stated_without_a_verdict_on_it() -> None:
    error = InputError("--plot", Words("needs two sizes"), "it has one", "go")
    assert str(error) == "--plot needs two sizes: it has one; go"
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error)


MADE_INSIDE = {"Installation", "KernelCheck", "OverturningWindow", "Scores"}
"""Results that only the package constructs: below the checks of arguments, as tuples, with NaN."""


def callables() -> Iterator[tuple[str, Callable[..., Any], tuple[object, ...]]]:
    """Public functions, constructors and methods, with what stands for ``self``."""
    for name, value in THINGS.items():
        odd = not inspect.isclass(value) or issubclass(value, BaseException | enum.Enum)
        if odd or name in MADE_INSIDE:
            if inspect.isfunction(value):
                yield name, value, ()
            continue
        yield name, value, ()
        for each, member in inspect.getmembers_static(value):
            if each.startswith("_"):
                continue
            if isinstance(member, classmethod | staticmethod):
                yield f"{name}.{each}", getattr(value, each), ()
            elif inspect.isfunction(member) and member.__module__.startswith("rocksteady"):
                yield f"{name}.{each}", member, (object.__new__(value),)


def test_calls_that_do_not_fit_a_signature_are_refused_in_one_line() -> None:
    counted = 0
    for name, function, before in callables():
        kinds = [each.kind for each in inspect.signature(function).parameters.values()]
        parameters = list(inspect.signature(function).parameters.values())[len(before) :]
        needed = [
            each.name
            for each in parameters
            if each.default is each.empty and each.kind < each.VAR_KEYWORD
            if each.kind is not each.VAR_POSITIONAL
        ]
        if inspect.Parameter.VAR_KEYWORD not in kinds:
            with pytest.raises(InputError, match="has no such argument") as refused:
                function(*before, no_such_argument=1)
            assert str(refused.value).startswith("no_such_argument = 1 is not valid"), name
            counted += 1
        if needed:
            with pytest.raises(InputError, match=f"{needed[-1]}.* (is|are) not given") as refused:
                function(*before)
            counted += 1
        if inspect.Parameter.VAR_POSITIONAL not in kinds:
            # A value of a wrong type may be refused first.
            with pytest.raises(RocksteadyError) as line:
                function(*before, *[None] * (len(parameters) + 1))
            assert "\n" not in str(line.value), name
            counted += 1
    assert counted > 1500


def test_the_line_names_what_is_meant() -> None:
    block: Any = rocksteady.DimensionlessBlock
    calls: tuple[tuple[Callable[..., Any], str], ...] = (
        (rocksteady.motions.cut, "motion, at are not given: cut needs motion, at"),
        (lambda: block(restituton=0.8), "restituton = 0.8 .*; did you mean restitution"),
        (lambda: block(0.8), "argument 1 = 0.8 .* DimensionlessBlock takes no arguments without"),
        (lambda: rocksteady.motions.cut(rocksteady.Still(), 1.0, at=2.0), "at is given twice"),  # type: ignore[misc]
    )
    for call, line in calls:
        with pytest.raises(InputError, match=line):
            call()


def test_an_error_inside_a_function_is_no_error_of_its_call() -> None:
    def fails(period: float, /, phase: float = 0.0) -> float:
        return period + "1" + phase  # type: ignore[operator]

    with pytest.raises(TypeError, match="unsupported operand"):
        with_call_errors(fails)(1.0)
