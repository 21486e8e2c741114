"""Type checks of public arguments, derived from the annotations of each signature.

A value of the wrong type is refused where it enters, by one line that names the argument, and not
by a traceback from deep inside.  What a number may be stands in its annotation, as a rule of
`rocksteady.model.checks.bounds`, or is checked by the validators of
`rocksteady.model.checks.validation` in the function itself; their hints name its unit.
"""

import functools
import inspect
import math
import os
import types
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from itertools import islice
from numbers import Integral, Number, Real
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Final, Literal, TypeVar, get_args, get_origin

from rocksteady.errors import InputError, RocksteadyError, call_error, with_call_errors
from rocksteady.model.checks._signatures import UNIONS, alternatives, is_array_like, readable
from rocksteady.model.checks.arrays import (
    MOST_ITEMS,
    UnfitError,
    guard_result,
    keep_contents,
    numeric_array,
    refuse_mask_and_unit,
    scalar_of,
)
from rocksteady.model.checks.bounds import INSIDE, Rule

T = TypeVar("T")

_ABC_NAMES: Final[Mapping[object, str]] = {str: "a text", bool: "True or False", Path: "a path"}

Fit = Callable[[str, Any], Any]

CHECKED_INSIDE: Final = frozenset({"method"})
"""Texts whose own validator describes what is valid better than their types do."""

LONGEST_NAME: Final = 255
"""Bytes of a file's name, on any file system in use."""


def checked(target: T) -> T:
    """Check the argument types of a function, or of a class's constructor and public methods.

    The signature shows types alone: the rules in annotations are taken off, and hold after the
    types of all arguments, in the order of the arguments.  Numbers without a rule, and numbers in
    place of texts, are left to the function's own validators.  What a frozen class holds, or a
    class computes once, cannot be written to.
    """
    guarded: T = _checked(target, numbers=False)
    if inspect.isclass(target):
        keep_contents(guarded)
    return guarded


def checked_result(target: T) -> T:
    """Check as `checked` does, and that numbers are numbers: of results, which may hold NaN."""
    guarded: T = guard_result(_checked(target, numbers=True))
    return guarded


def _checked(target: Any, *, numbers: bool) -> Any:
    if not inspect.isclass(target):
        function = _guarded(target, numbers=False)
        # help() would spell out the twenty types of an ArrayLike, and every class with its module.
        function.__signature__ = readable(inspect.signature(target))  # type: ignore[attr-defined]
        return function
    for name, member in list(vars(target).items()):
        if name.startswith("_") and name not in ("__init__", "__call__"):
            continue
        if isinstance(member, classmethod | staticmethod):
            setattr(target, name, type(member)(_guarded(member.__func__, numbers=False)))
        elif inspect.isfunction(member):
            setattr(target, name, _guarded(member, numbers=numbers and name == "__init__"))
    return target


def _guarded(function: Callable[..., Any], *, numbers: bool) -> Callable[..., Any]:
    """Return a function that checks its arguments first; the function itself if none has a type."""
    plan: list[tuple[str, int, bool, Fit]] | None = None
    rules, inside = _taken_rules(function)
    # The wrapper has the globals of the function's module, not of this one.
    made, inner = _plan, with_call_errors(function)
    broken, misfit = _BrokenRuleError, call_error

    def call(*args, **kwargs):  # type: ignore[no-untyped-def]
        nonlocal plan
        if plan is None:
            plan = made(function, numbers, rules, inside)
        given = args
        try:
            for name, place, variadic, fit in plan:
                if name in kwargs:
                    kwargs[name] = fit(name, kwargs[name])
                elif variadic:
                    fits = tuple([fit(name, value) for value in given[place:]])
                    given = given[:place] + fits
                elif 0 <= place < len(given):
                    value = fit(name, given[place])
                    if value is not given[place]:
                        given = (*given[:place], value, *given[place + 1 :])
        except broken as rule:
            raise misfit(function, given, kwargs) or rule.args[0] from None
        return inner(*given, **kwargs)

    # Finders of doctests know a module's functions by their globals.
    local = types.FunctionType(
        call.__code__, function.__globals__, function.__name__, closure=call.__closure__
    )
    return functools.wraps(function)(local)


class _BrokenRuleError(Exception):
    """The error of a rule, which a call that does not fit the signature comes before."""


def _taken_rules(function: Callable[..., Any]) -> tuple[dict[str, Rule], set[str]]:
    """Take rules and labels off a function's annotations; return the rules, and who is `INSIDE`."""
    rules, inside = {}, set()
    for name, annotation in function.__annotations__.items():
        for rule in getattr(annotation, "__metadata__", ()):
            origin = annotation.__origin__
            function.__annotations__[name] = getattr(origin, "__forward_arg__", origin)
            if callable(rule):  # and no label
                rules[name] = rule
            elif rule == INSIDE:
                inside.add(name)
    return rules, inside


def _plan(
    function: Callable[..., Any], numbers: bool, rules: Mapping[str, Rule], inside: set[str]
) -> list[tuple[str, int, bool, Fit]]:
    """Return name, place (-1 of a keyword), whether it is ``*args``, and the check of each.

    First come the types of all, then the rules.
    """
    plan: list[tuple[str, int, bool, Fit]] = []
    ruled: list[tuple[str, int, bool, Fit]] = []
    for place, parameter in enumerate(inspect.signature(function).parameters.values()):
        variadic = parameter.kind is parameter.VAR_POSITIONAL
        at = -1 if parameter.kind is parameter.KEYWORD_ONLY else place
        if parameter.name in rules:
            optional = types.NoneType in get_args(parameter.annotation)
            rule = _ruled(rules[parameter.name], parameter.default, optional)
            ruled.append((parameter.name, at, variadic, rule))
        fit = _fit_of(parameter.annotation, function.__globals__, numbers)
        if fit is None or parameter.kind is parameter.VAR_KEYWORD:
            continue
        if parameter.name in CHECKED_INSIDE:
            fit = _plain_text
        # A text for a model has its own hint, and a result stands for its start.
        chosen = parameter.name in ("model", "start") and parameter.default is None
        measured = Literal["housner"] in get_args(parameter.annotation)  # so has a restitution
        if chosen or measured or parameter.name in inside:
            fit = _kept if get_origin(parameter.annotation) is not Mapping else _any_mapping
        plan.append((parameter.name, at, variadic, _reported(fit, parameter.default)))
    return plan + ruled


def _ruled(rule: Rule, default: object, optional: bool) -> Fit:
    """Return the check of a rule, which a default passes, and None where the type has it."""

    def check(name: str, value: Any) -> Any:
        if value is default or (optional and value is None):
            return value
        try:
            return rule(name, value)
        except RocksteadyError as error:
            raise _BrokenRuleError(error) from None

    return check


def _reported(fit: Fit, default: object) -> Fit:
    """Return a check that raises the line of the package."""

    def check(name: str, value: Any) -> Any:
        if value is default:
            return value
        try:
            return fit(name, value)
        except UnfitError as unfit:
            valid, hint = unfit.args
            raise InputError(name, value, valid, hint) from None

    return check


def _fit_of(annotation: Any, names: Mapping[str, Any], numbers: bool) -> Fit | None:
    """Return the check of an annotation; None where everything passes."""
    if isinstance(annotation, str):
        return _fit_of_text(annotation, names, numbers)
    # ArrayLike from Python 3.12 on, NDArray from NumPy 2.5 on.
    annotation = getattr(annotation, "__value__", annotation)
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin in UNIONS:
        inner = alternatives(annotation)
    if is_array_like(inner):
        array = _array_or_names if Sequence[str] in inner else numeric_array
        return _either([array, _nothing]) if types.NoneType in inner else array
    if origin in UNIONS:
        paths = any(part is Path or get_origin(part) is PathLike for part in inner)
        parts = [part for part in inner if not (paths and part is str)]
        parts.sort(key=lambda part: part is not Path)
        return _either([_fit_of(part, names, numbers) for part in parts])
    if "numpy.ndarray" in str(origin):
        return _any_array if numbers else _kept_array
    if origin in (tuple, list, Sequence, Iterable, Mapping):
        return _fit_of_items(origin, [_fit_of(part, names, True) for part in inner])
    return _choice(inner) if origin is Literal else _fit_of_class(origin or annotation, numbers)


def _fit_of_items(origin: Any, fits: list[Fit | None]) -> Fit:
    """Return the check of a sequence or a mapping."""
    if origin is Mapping:
        free = fits[1] is numeric_array  # of axes, which may be names too
        return functools.partial(_mapping, fits[0], None if free else fits[1])
    if origin is tuple and not (len(fits) == 2 and fits[1] is None):  # not tuple[X, ...]
        return _row(fits)
    return _items(fits[0], lazily=origin is Iterable)


def _fit_of_class(kind: Any, numbers: bool) -> Fit | None:
    """Return the check of a class; None where everything passes."""
    simple: dict[Any, Fit | None] = {
        None: _nothing,
        types.NoneType: _nothing,
        float: _number if numbers else _plain,
        int: _whole if numbers else _plain,
        str: _text if numbers else _plain_text,
        Path: _path,
        PathLike: _path,
        Callable: _callable,
        object: None,
        Any: None,
        inspect.Parameter.empty: None,
    }
    if kind in simple:
        return simple[kind]
    if not isinstance(kind, type):
        return None  # a type variable, or Any
    return _of_protocol(kind) if getattr(kind, "_is_protocol", False) else _instance(kind)


def _fit_of_text(annotation: str, names: Mapping[str, Any], numbers: bool) -> Fit | None:
    """Return the check of a quoted annotation, whose classes may not be imported yet."""
    fits: list[Fit | None] = []
    for part in annotation.split("|"):
        word = part.strip().split(".")[-1]
        if not word.isidentifier():
            return None
        known = names.get(word)
        if word == "None":
            fits.append(_nothing)
        elif word == "ArrayLike":  # where NumPy is not loaded yet
            fits.append(numeric_array)
        else:
            fits.append(_fit_of_class(known, numbers) if isinstance(known, type) else _named(word))
    return _either(fits)


def _nothing(_: str, value: Any) -> Any:
    if value is not None:
        raise UnfitError("it must be None", "leave it out")
    return value


def _kept(name: str, value: Any) -> Any:
    """Pass what the function itself checks; a mask and a unit it would lose."""
    refuse_mask_and_unit(name, value)
    return value


def _plain(name: str, value: Any) -> Any:
    """Return a number as a plain float or int; the function checks its range."""
    kind = type(value)
    if kind is float or kind is int:
        return value
    refuse_mask_and_unit(name, value)
    return scalar_of(value)


def _number(name: str, value: Any) -> Any:
    """Return a real number, NaN and infinity too, as a plain one."""
    plain = _plain(name, value)
    if isinstance(plain, bool) or not isinstance(plain, Real):
        raise UnfitError("it must be a real number", "give a float")
    return plain


def _any_array(name: str, value: Any) -> Any:
    """Pass an array of numbers, complex ones and booleans too, or of names."""
    return numeric_array(name, value, "biufcU")


def _array_or_names(name: str, value: Any) -> Any:
    """Pass an array of numbers, or of names."""
    return numeric_array(name, value, "iufU")


def _kept_array(name: str, value: Any) -> Any:
    """Pass what can be an array without a loss; what it holds, the class itself checks."""
    return numeric_array(name, value, None)


def _whole(name: str, value: Any) -> Any:
    plain = _plain(name, value)
    if isinstance(plain, bool) or not isinstance(plain, Integral):
        raise UnfitError("it must be a whole number", "give an int")
    return plain


def _text(_: str, value: Any) -> Any:
    if not isinstance(value, str):
        raise UnfitError("it must be a text", "give a str")
    return value


def _plain_text(_: str, value: Any) -> Any:
    """Pass a text, and what can be compared with one: the function checks its value."""
    comparable = isinstance(value, str | bytes | Number) and not isinstance(value, Decimal)
    if value is None or comparable:
        return value
    raise UnfitError("it must be a text", "give a str")


def _path(_: str, value: Any) -> Any:
    if not isinstance(value, str | PathLike) or isinstance(value, type):
        raise UnfitError("it must be a path", "give a str or a pathlib.Path")
    try:
        text = fspath(value)
        os.fsencode(text)
    except (TypeError, UnicodeError):
        raise UnfitError("it must be a path", "give a str or a pathlib.Path") from None
    if not isinstance(text, str) or "\0" in text:
        raise UnfitError("it must be a path, in text", "give a str or a pathlib.Path")
    if text == "":  # which would mean this folder
        raise UnfitError("it must be a path, not an empty text", "name a file or a folder")
    longest = max((len(os.fsencode(part)) for part in Path(text).parts), default=0)
    if longest > LONGEST_NAME:
        raise UnfitError(f"it must be a path of names up to {LONGEST_NAME} bytes", "shorten it")
    return value


def _callable(_: str, value: Any) -> Any:
    if not callable(value) or isinstance(value, type):
        raise UnfitError("it must be a function", "give a callable")
    return value


def _choice(options: tuple[Any, ...]) -> Fit:
    kinds = tuple({type(option) for option in options})
    words = " or ".join(map(repr, options))
    if len(options) > 2:
        words = f"one of {', '.join(map(str, options))}"

    def fit(_: str, value: Any) -> Any:
        plain = scalar_of(value)
        if not isinstance(plain, kinds) or isinstance(plain, bool) or plain not in options:
            raise UnfitError(f"it must be {words}", "give one of them")
        return plain

    return fit


def _instance(kind: type) -> Fit:
    words = f"it must be {_ABC_NAMES.get(kind) or _with_article(kind.__name__)}"

    def fit(_: str, value: Any) -> Any:
        if not isinstance(value, kind):
            is_motion = callable(getattr(value, "segments", None)) and not isinstance(value, type)
            if kind.__name__ == "Harmonic" and is_motion:
                return value  # another motion, which the function refuses with its reason
            if kind is bool and type(value).__name__ in ("bool", "bool_"):
                return bool(value)
            raise UnfitError(words, _how_to_get(kind.__name__, value))
        return value

    return fit


def _named(word: str) -> Fit:
    """Return the check of a class by its name, without importing its package."""

    def fit(_: str, value: Any) -> Any:
        if not any(kind.__name__ == word for kind in type(value).__mro__):
            raise UnfitError(f"it must be {_with_article(word)}", _how_to_get(word, value))
        return value

    return fit


def _of_protocol(kind: type) -> Fit:
    methods = [name for name in vars(kind) if not name.startswith("_")]
    words = f"it must be {_with_article(kind.__name__)}"

    def fit(_: str, value: Any) -> Any:
        if isinstance(value, type) or not all(
            callable(getattr(value, method, None)) for method in methods
        ):
            raise UnfitError(words, _how_to_get(kind.__name__, value))
        return value

    return fit


def _either(fits: Sequence[Fit | None]) -> Fit | None:
    """Return the check of a union; None where everything passes.

    A number in it is left to the validator of that number, whose hint names the unit.
    """
    if None in fits:
        return None
    known = [fit for fit in fits if fit is not None]
    numeric = _plain in known
    others = [fit for fit in known if fit is not _plain]
    if numeric and all(fit is _nothing for fit in others):
        return _plain

    def fit(name: str, value: Any) -> Any:
        unfit: list[tuple[str, str]] = [("it must be a number", "give one")] if numeric else []
        for option in others:
            try:
                return option(name, value)
            except UnfitError as error:
                valid, hint = error.args
                if not valid.startswith("it must be"):  # a mask, a unit: it was nearly right
                    raise
                if option is not _nothing:
                    unfit.append((valid, hint))
        if numeric:
            plain = _plain(name, value)
            if plain is None or isinstance(plain, Number | str):
                return plain
        # A check of items may have found several kinds itself.
        kinds = (valid.removeprefix("it must be ").split(" or ") for valid, _ in unfit)
        clauses = dict.fromkeys(kind for several in kinds for kind in several)
        raise UnfitError("it must be " + " or ".join(clauses), unfit[-1 if numeric else 0][1])

    return fit


def _row(fits: Sequence[Fit | None]) -> Fit:
    """Return the check of a tuple of a fixed length, as (low, high)."""
    words = f"it must be a tuple of {len(fits)} values"
    hint = "give a pair, as (1.0, 2.0)" if len(fits) == 2 else "give a list of as many"

    def fit(name: str, value: Any) -> Any:
        items = _listed(name, value, words, len(fits) + 1, hint)
        if len(items) != len(fits):
            raise UnfitError(words, hint)
        return tuple(_item(member, name, item) for member, item in zip(fits, items, strict=True))

    return fit


def _items(one: Fit | None, *, lazily: bool) -> Fit:
    """Return the check of a sequence, each item of it."""

    def fit(name: str, value: Any) -> Any:
        if not lazily and not (hasattr(value, "__len__") and hasattr(value, "__getitem__")):
            raise UnfitError("it must be a list or a tuple", "give a list")
        items = _listed(name, value, "it must be a list or a tuple", MOST_ITEMS + 1)
        if len(items) > MOST_ITEMS:
            raise UnfitError(f"it must have at most {MOST_ITEMS} items", "give fewer")
        fitted = tuple(_item(one, name, item) for item in items)
        same = all(new is old for new, old in zip(fitted, items, strict=True))
        return value if same and isinstance(value, list | tuple) else fitted

    return fit


def _listed(
    name: str, value: Any, words: str, most: int, hint: str = "give a list of them"
) -> list[Any]:
    """Return the first items of an iterable that is no text and no mapping."""
    if isinstance(value, str | bytes | bytearray | Mapping | type):
        raise UnfitError(words, hint)
    refuse_mask_and_unit(name, value)
    try:
        return list(islice(value, most))
    except Exception:  # noqa: BLE001 - not iterable, or its own code fails
        raise UnfitError(words, hint) from None


def _item(one: Fit | None, name: str, item: Any) -> Any:
    if one is None:
        return item
    item = one(name, item)
    if isinstance(item, float) and math.isnan(item):
        raise UnfitError("it must not hold NaN", "leave NaN out")
    return item


def _mapping(keys: Fit | None, items: Fit | None, name: str, value: Any) -> Any:
    """Pass a mapping whose keys and values are of the types that it has."""
    if not isinstance(value, Mapping):
        if name == "axes":  # a list of names is nearly right: the function names what is missing
            return value
        raise UnfitError("it must be a mapping", "give a dict")
    for key, item in value.items():
        if not isinstance(key, str | Number):
            raise UnfitError("its keys must be texts", "give a dict of names")
        for fit, part in ((keys, key), (items, item)):
            try:
                (fit or refuse_mask_and_unit)(str(key), part)
            except UnfitError as unfit:
                raise InputError(f"{name}: {key}", part, *unfit.args) from None
    return value


_any_mapping: Final = functools.partial(_mapping, None, None)


def _with_article(word: str) -> str:
    return f"an {word}" if word[0] in "AEIO" else f"a {word}"


_MADE_BY: Final = {
    "Block": "make one with Block.rectangle(width=..., height=...)",
    "Motion": "give a Harmonic, a Pulse, a Piecewise, a Record or a Still",
    "Record": "read one with read_record(path), or make a Record(acceleration_m_s2=..., dt_s=...)",
    "Trajectory": "give what simulate(...) returns",
    "Orbit": "give one that find_orbits(...) returns, or find_attractor(...).orbit",
    "Harmonic": "make a Harmonic(amplitude=..., frequency_ratio=...)",
    "Axes": "give the axes of matplotlib, or leave it out for new ones",
    "LossComponent": "make one with LossComponent.from_fragility(identifier, fragility)",
    "Dataset": "give the dataset that the function named in the documentation returns",
}


def _how_to_get(word: str, value: Any) -> str:
    if word.endswith("Block") and callable(getattr(value, "segments", None)):
        return "the block comes first, then the shaking"
    if isinstance(value, type) and value.__name__ == word:
        return f"make one of the class, {word}(...)"
    return _MADE_BY.get(word, f"give {_with_article(word)}")
