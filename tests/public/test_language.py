"""One language: the rules of docs/interface.md, walked over the whole namespace."""

import inspect
import pydoc
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import rocksteady as rs
from rocksteady.errors import InputError
from tests.every import every
from tests.public.calls import calls as calls_that_succeed
from tests.public.calls import room
from tools.namespace import PLACES, THINGS

INTERFACE = (Path(__file__).parents[2] / "docs" / "interface.md").read_text(encoding="utf-8")
MOST_PARAMETERS = 8
SCREEN = 66
"""Lines of a tall terminal."""
FIRST_SENTENCE = 16
"""Words; 15, and an article."""
DEFAULTS = {
    "cycles": "what is long enough depends on the question",
    "max_cycles": "likewise",
    "order": "an array where a formula takes arrays",
    "tolerance": "of a drop, of a sampled pulse and of the equations of motion",
    "phase": "a pulse's own where none is given",
    "restitution": "a block's own where none is given; a formula has none",
    "legend": "where it stands depends on the picture",
    "key": "likewise",
    "measure": "of a fit its name in texts, of a hazard what the file or the fragility is over",
    "max_period": "one point is searched, a range is followed",
    "max_impacts": "likewise",
    "reverse": "an ensemble has both signs, a run one",
    "count": "periods of an average, motions of a suite",
    "seed": "states are drawn anew where none is given, a suite is the same each time",
    "gravity": "housner_restitution takes p and radius with g = 1",
}
"""Arguments with more than one default, each with the reason."""
UNITS = {
    "_m_s2": "m/s^2",
    "_rad_s": "rad/s",
    "_m_s": "m/s",
    "_rad": "rad",
    "_hz": "Hz",
    "_g": "g",
    "_m": "m",
    "_s": "s",
}
"""Units by the suffix of a name, the longer ones first."""
PATTERNS = (
    r"\bis said\b|\bare said\b|\bsays nothing\b|\bnobody says\b",
    r"\btold\b|\basked for\b|\bis asked\b",
    r"\bunlike\b|\bleaning\b|\bone-sided\b",
    r"\bcrew\b|\bdeal\b|\bparcel\b|\bshelf\b|\bkeeper\b",
    r"\btrail\b|\bbeginnings\b",
    r"\bthose that\b",
)
"""Words that `docs/interface.md` replaces, in the docstrings of public names."""

FUNCTIONS = [name for name, thing in THINGS.items() if inspect.isfunction(thing)]
CLASSES = [name for name, thing in THINGS.items() if inspect.isclass(thing)]


def calls() -> Iterator[tuple[str, Any]]:
    """Yield every public function, constructor by class method, and method."""
    for name in FUNCTIONS:
        yield name, THINGS[name]
    for name in CLASSES:
        for own, member in vars(THINGS[name]).items():
            plain = getattr(member, "__func__", member)
            if not own.startswith("_") and inspect.isfunction(plain):
                yield f"{name}.{own}", plain


CALLS = dict(calls())


@every("name", CALLS)
def test_no_function_has_more_than_eight_parameters(name: str) -> None:
    parameters = [p for p in inspect.signature(CALLS[name]).parameters if p not in ("self", "cls")]
    assert len(parameters) <= MOST_PARAMETERS, parameters


@every("name", FUNCTIONS)
def test_every_parameter_has_a_type_and_a_description(name: str) -> None:
    function = THINGS[name]
    documented = pydoc.getdoc(function)
    for parameter in inspect.signature(function).parameters.values():
        assert parameter.annotation is not parameter.empty, parameter
        assert re.search(rf"(^|\W)\*?{parameter.name}(\W|$)", documented), parameter


def test_one_argument_has_one_default() -> None:
    defaults: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for name in FUNCTIONS:
        if name.startswith("plot_"):
            continue
        for parameter in inspect.signature(THINGS[name]).parameters.values():
            if parameter.default is not parameter.empty:
                defaults[parameter.name][repr(parameter.default)].append(name)
    several = {key: dict(found) for key, found in defaults.items() if len(found) > 1}
    assert {key: found for key, found in several.items() if key not in DEFAULTS} == {}


def test_every_function_with_a_model_takes_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(room())
    takes = {
        label: call
        for label, call in calls_that_succeed().items()
        if "model" in call.parameters
        and inspect.signature(call.function).parameters["model"].default is None
    }
    assert len(takes) > 25
    for label, call in takes.items():
        words = r"model = 'foo' .*two equations of motion; give .linear. or .nonlinear."
        with pytest.raises(InputError, match=words):
            call(model="foo")
        assert "Literal['linear', 'nonlinear']" in str(inspect.signature(call.function)), label


def test_results_keep_the_model_that_was_named() -> None:
    block, motion = (
        rs.Block.rectangle(width=0.6, height=2.0),
        rs.Harmonic(amplitude=2.0, frequency_ratio=4.0),
    )
    assert rs.simulate(block, motion, cycles=1.0, model="linear").model == rs.Linear()
    assert rs.simulate(block, motion, cycles=1.0, model="nonlinear").model == rs.Nonlinear()


def described_units() -> dict[str, dict[str, list[str]]]:
    """The units in the descriptions of arguments that have one of their own, and who says so."""
    units: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for name, function in {**CALLS, **{name: THINGS[name] for name in CLASSES}}.items():
        section = re.search(
            r"Parameters\n-+\n(.*?)(\n\n[A-Z][a-z]+\n-+\n|\Z)", pydoc.getdoc(function), re.DOTALL
        )
        for argument, text in re.findall(
            r"^(\w+)\n((?:    [^\n]*\n?|\n(?=    ))+)", section[1] if section else "", re.MULTILINE
        ):
            for unit in re.findall(
                rf"\[({'|'.join(map(re.escape, UNITS.values()))})\b[^\]]*\]", text
            ):
                units[argument][unit].append(name)
    return units


def test_one_argument_has_one_unit_and_that_of_its_suffix() -> None:
    units = described_units()
    assert len(units) > 15
    assert {name: found for name, found in units.items() if len(found) > 1} == {}
    for name, found in units.items():
        suffix = next((suffix for suffix in UNITS if name.endswith(suffix)), None)
        if suffix is not None:
            assert set(found) == {UNITS[suffix]}, name


@every("name", [*FUNCTIONS, *CLASSES])
def test_every_name_is_documented_in_one_short_first_sentence(name: str) -> None:
    text = pydoc.getdoc(THINGS[name])
    sentence = re.split(r"[.:;](?:\s|$)", text, maxsplit=1)[0]
    assert sentence
    assert len(sentence.split()) <= FIRST_SENTENCE, sentence


@every("name", FUNCTIONS)
def test_help_of_a_function_fits_a_screen(name: str) -> None:
    assert len(pydoc.getdoc(THINGS[name]).splitlines()) <= SCREEN


@every("name", FUNCTIONS)
def test_every_function_has_an_example(name: str) -> None:
    documented = inspect.getdoc(THINGS[name]) or ""
    assert ">>> " in documented or name.startswith("plot_")


@every("pattern", PATTERNS)
def test_public_docstrings_use_the_usual_words(pattern: str) -> None:
    found = {
        name: match[0]
        for name, thing in {**THINGS, **CALLS}.items()
        if (match := re.search(pattern, inspect.getdoc(thing) or ""))
    }
    assert found == {}


def test_a_suffix_is_a_unit() -> None:
    for name in CLASSES:
        for field in getattr(THINGS[name], "__dataclass_fields__", {}):
            assert not re.fullmatch(r"(end|rest|overturn|start)_s", field), (name, field)
    for name in FUNCTIONS:
        for parameter in inspect.signature(THINGS[name]).parameters:
            assert parameter != "s", name


@every("name", [name for name in FUNCTIONS if not name.startswith("plot_")])
def test_the_interface_lists_every_verb_and_formula(name: str) -> None:
    assert f"`{PLACES[name]}`" in INTERFACE


def test_the_interface_lists_nothing_else() -> None:
    listed = set(re.findall(r"^\| `.*", INTERFACE, flags=re.MULTILINE))
    words = {word for line in listed for word in re.findall(r"`([a-z_.]+)`", line)}
    functions = {word for word in words if "_" in word and not word.endswith("_")}
    assert functions - set(PLACES.values()) == set()
