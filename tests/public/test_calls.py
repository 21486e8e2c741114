"""Calls with missing, unknown or too many arguments: each is refused in one line."""

import enum
import inspect
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import rocksteady
from rocksteady import InputError, RocksteadyError

MADE_INSIDE = {"Installation", "KernelCheck", "OverturningWindow", "Scores"}
"""Results that only the package constructs: below the checks of arguments, as tuples, with NaN."""


def callables() -> Iterator[tuple[str, Callable[..., Any], tuple[object, ...]]]:
    """Public functions, constructors and methods, with what stands for ``self``."""
    for name in rocksteady.__all__:
        value = getattr(rocksteady, name)
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
            elif inspect.isfunction(member):
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
        (rocksteady.cut_motion, "motion, at are not given: cut_motion needs motion, at"),
        (lambda: block(restituton=0.8), "restituton = 0.8 .*; did you mean restitution"),
        (lambda: block(0.8), "argument 1 = 0.8 .* DimensionlessBlock takes no arguments without"),
        (lambda: rocksteady.cut_motion(rocksteady.Still(), 1.0, at=2.0), "at is given twice"),  # type: ignore[misc]
    )
    for call, line in calls:
        with pytest.raises(InputError, match=line):
            call()


def test_an_error_inside_a_function_is_no_error_of_its_call() -> None:
    def fails(period: float, /, phase: float = 0.0) -> float:
        return period + "1" + phase  # type: ignore[operator]

    with pytest.raises(TypeError, match="unsupported operand"):
        rocksteady.errors.with_call_errors(fails)(1.0)
