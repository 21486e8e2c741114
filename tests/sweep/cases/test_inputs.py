"""Inputs: everything that a result follows from is written down, and differences are named."""

import functools
import hashlib
import json
import math
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady
from rocksteady import DimensionlessBlock, Harmonic, Steady
from rocksteady.errors import InputError
from rocksteady.sweep.cases.axes import Axis
from rocksteady.sweep.cases.grid import Grid
from rocksteady.sweep.cases.inputs import (
    PACKAGE,
    as_text,
    differences,
    inputs_of,
    named_function,
    plain,
    sources_of,
)
from rocksteady.sweep.cases.outputs import Output
from rocksteady.sweep.cases.task import Task
from tests.every import every


class Colour(Enum):
    RED = 1


def cases(a: Any, *more: Any, **constants: Any) -> Any:
    raise NotImplementedError


def task_of(function: Any = cases, **changed: Any) -> Task:
    axes = changed.get("axes", (Axis(name="a", values=[1.0, 2.0]), Axis(name="b", values=[1.0])))
    return Task(
        cases=function,
        grid=Grid(axes=axes),
        outputs=changed.get("outputs", (Output(name="x"),)),
        numbered=changed.get("numbered"),
        batch=changed.get("batch", 64),
    )


def inputs(*args: Any, **changed: Any) -> dict[str, Any]:
    found = json.loads(as_text(inputs_of(task_of(*args, **changed))))
    assert isinstance(found, dict)
    return found


def test_constants_are_written_as_people_read_them() -> None:
    bound = functools.partial(
        functools.partial(cases, 7, block=DimensionlessBlock(restitution=0.8), start=Steady()),
        shaking=Harmonic(amplitude=2.0, frequency_ratio=3.0),
        more={"colour": Colour.RED, "beyond": math.inf},
        array=np.arange(3.0),
        count=np.int64(5),
    )
    found = inputs(bound)
    assert found["case"].endswith("test_inputs:cases")
    constants = found["constants"]
    assert constants["0"] == 7
    assert constants["block"]["is"] == "DimensionlessBlock"
    assert constants["block"]["restitution"] == 0.8
    assert constants["start"] == {
        "is": "Steady",
        "branch": 1,
        "order": 1,
        "side": 1,
        "kick": 1e-06,
    }
    assert constants["shaking"]["amplitude"] == 2.0
    assert constants["more"] == {"colour": "RED", "beyond": "inf"}
    assert constants["array"].keys() == {"dtype", "shape", "sha256"}
    assert constants["count"] == 5


def test_the_later_of_two_bindings_counts() -> None:
    twice = functools.partial(functools.partial(cases, factor=1.0), factor=2.0)
    assert inputs(twice)["constants"] == {"factor": 2.0}


def around(value: int) -> Any:
    return lambda: value


@every("value", [object(), around(1), {1, 2}, np.array([None]), 1j, int])
def test_what_cannot_be_written_down_is_refused(value: Any) -> None:
    with pytest.raises(InputError, match=r"factor = .* dataclasses, numbers, texts and arrays"):
        plain(value, "factor")


@every(
    ("changed", "said"),
    [
        ({"axes": (Axis(name="a", values=[1.0, 2.0]), Axis(name="b", values=[2.0]))}, "b from 1.0"),
        ({"axes": (Axis(name="a", values=[1.0, 2.5, 2.0]), Axis(name="b", values=[1.0]))}, "a po"),
        ({"axes": (Axis(name="b", values=[1.0]), Axis(name="a", values=[1.0, 2.0]))}, "dimensions"),
        ({"axes": (Axis(name="a", values=[1.0, 2.0]),)}, "b from 1.0 there, nothing here"),
        ({"outputs": (Output(name="x", dtype=np.int8),)}, "outputs x float64 there, int8 here"),
        ({"outputs": (Output(name="y"),)}, "outputs x float64 there, nothing here"),
        ({"numbered": "n"}, "numbered None there, n here"),
    ],
)
def test_what_differs_is_named(changed: dict[str, Any], said: str) -> None:
    found = differences(inputs(), inputs(**changed))
    assert any(difference.startswith(said) for difference in found), found


def test_constants_differ_by_their_own_names() -> None:
    one, other = (
        inputs(
            functools.partial(cases, factor=1.0, shaking=Harmonic(amplitude=a, frequency_ratio=3.0))
        )
        for a in (2.0, 2.5)
    )
    assert differences(one, one) == []
    assert differences(one, other) == ["shaking amplitude 2.0 there, 2.5 here"]
    source = {**one, "source": {"rocksteady": "0"}, "version": "0.0.1"}
    assert [said.split()[0] for said in differences(source, one)] == ["source", "source", "version"]


def test_the_size_of_a_call_makes_no_difference() -> None:
    assert inputs(batch=1) == inputs(batch=4096)


def test_the_things_of_an_axis_count() -> None:
    def of(amplitude: float) -> tuple[Axis, ...]:
        things = (Harmonic(amplitude=amplitude, frequency_ratio=1.0),)
        return (Axis(name="a", values=["one"], items=things),)

    assert differences(inputs(axes=of(1.0)), inputs(axes=of(1.0))) == []
    (difference,) = differences(inputs(axes=of(1.0)), inputs(axes=of(2.0)))
    assert difference.startswith("a items ")


def test_only_what_can_be_found_again_is_named() -> None:
    named_function(task_of())
    named_function(task_of(functools.partial(cases, factor=1.0)))
    for hidden in (lambda a: a, functools.partial(lambda a: a)):
        with pytest.raises(InputError, match="module level"):
            named_function(task_of(hidden))


@every("what", [3, "cases", int, functools.partial(int)])
def test_a_case_function_is_a_function(what: Any) -> None:
    with pytest.raises(InputError, match=r"a function or a functools.partial"):
        inputs(what)


def test_a_function_of_python_itself_is_known_by_its_version() -> None:
    assert sources_of(id) == sources_of(len)
    assert sources_of(id).keys() == {"builtins", "rocksteady"}


def test_a_function_that_was_typed_in_is_known_wherever_it_stands() -> None:
    def typed(text: str, file: str) -> Any:
        space: dict[str, Any] = {"__name__": "typed_in"}
        exec(compile(text, file, "exec"), space)
        return space["cases"]

    text = "def cases(a):\n    return [x + 1 for x in a]\n"
    one, moved, other = (
        inputs(typed(lines, file))["source"]["typed_in"]
        for lines, file in (
            (text, "<cell 1>"),
            ("\n\n" + text, "<cell 7>"),
            (text.replace("1", "2"), "<cell 1>"),
        )
    )
    assert one == moved != other


def test_a_hash_is_shown_where_nothing_else_tells() -> None:
    bound = [functools.partial(cases, table=np.array(table)) for table in ([1.0, 2.0], [1.0, 3.0])]
    (difference,) = differences(*(inputs(one) for one in bound))
    assert difference.startswith("table sha256 ")
    axes = (Axis(name="a", values=[1.0, 3.0]), Axis(name="b", values=[1.0]))
    assert differences(inputs(), inputs(axes=axes)) == ["a to 2.0 there, 3.0 here"]


def test_a_constant_may_be_a_function_and_is_told_by_what_it_does() -> None:
    one, same, other = (inputs(functools.partial(cases, f=f)) for f in (cases, cases, lambda: 0))
    assert one == same
    assert any(said.startswith("f code ") for said in differences(one, other))


def test_the_sources_of_the_package_are_all_of_its_modules() -> None:
    assert Path(PACKAGE) == Path(rocksteady.__file__)
    files = sorted(Path(rocksteady.__file__).parent.rglob("*.py"))
    digest = hashlib.sha256()
    for file in files:
        name = file.relative_to(files[0].parent).as_posix()
        digest.update(name.encode() + b"\0" + file.read_bytes())
    assert sources_of(json.dumps)["rocksteady"] == digest.hexdigest()[:16]


def test_names_in_any_script_stay_readable_in_a_store() -> None:
    assert as_text({"record": "Ōtsuchi", "axis": "größe"}) == (
        '{"axis": "größe", "record": "Ōtsuchi"}'
    )
