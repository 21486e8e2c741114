"""The errors that the package raises.

A single call that cannot be answered raises one of the exceptions below; a batch of many cases
never raises for one of them and returns a `rocksteady.outcomes.Status` for each instead.

The tree::

    RocksteadyError
    ├── InputError      an argument is outside its valid range (also a ValueError)
    │   └── RecordFileError a ground-motion file cannot be read
    ├── ModelError      arguments valid alone are refused together (also a ValueError)
    ├── OutputError     a file or a folder cannot be written
    ├── MissingKernelsError compiled kernels cannot be used
    └── UnfinishedError a long computation was stopped; what is finished is kept, and can be resumed

This module is in the lowest layer: it imports nothing from the package, and nothing heavy.
"""

from collections.abc import Callable
from functools import wraps
from importlib.util import find_spec
from numbers import Number
from os import PathLike, fspath
from typing import ParamSpec, TypeVar

__all__ = [
    "InputError",
    "MissingKernelsError",
    "ModelError",
    "OutputError",
    "RecordFileError",
    "UnfinishedError",
]
"""The public errors, beside `RocksteadyError` on top of the package."""

P = ParamSpec("P")
T = TypeVar("T")

_LONGEST_VALUE = 100
"""Characters of a value that an error line shows; for a longer one its middle is left out."""


class Words(str):
    """What was given, where that is no value: a verb and more, as "is not given".

    The message of an error is then ``NAME WORDS: VALID; HINT``, without a verdict on a value.
    """

    __slots__ = ()


class RocksteadyError(Exception):
    """Base class of every error that the package raises on purpose.

    Catch it to catch them all. The errors derived from it carry the same four parts, and their
    message is one line made of them.

    Parameters
    ----------
    name
        The argument, as the caller wrote it (``restitution``).
    value
        What was given; `Words` where that is no value.
    valid
        What is valid, as a clause that reads on from "it is not valid:" (``it must lie in
        (0, 1]``).
    hint
        What to do next, as a clause (``give a ratio of angular velocities``).

    Attributes
    ----------
    name, value, valid, hint
        The parameters, unchanged, for a caller that words its own message.
    """

    _verdict = "is not accepted"

    def __init__(self, name: str, value: object, valid: str, hint: str) -> None:
        self.name = name
        self.value = value
        self.valid = valid
        self.hint = hint
        given = f"{value}" if isinstance(value, Words) else f"= {_shown(value)} {self._verdict}"
        super().__init__(one_line(f"{name} {given}: {valid}; {hint}"))

    def __reduce__(self) -> tuple[object, ...]:
        # pickle would rebuild it from the message; it has to come back whole from a worker
        # process, with the notes added there.
        parts = (self.name, self.value, self.valid, self.hint)
        return type(self), parts, self.__dict__


class InputError(RocksteadyError, ValueError):
    """An argument is outside its valid range.

    The message reads ``NAME = VALUE is not valid: VALID; HINT``.

    Examples
    --------
    >>> raise InputError(
    ...     "restitution",
    ...     1.2,
    ...     "it must lie in (0, 1]",
    ...     "give the ratio of the angular velocities after and before an impact",
    ... )
    Traceback (most recent call last):
    ...
    rocksteady.errors.InputError: restitution = 1.2 is not valid: it must lie in (0, 1]; give the \
ratio of the angular velocities after and before an impact
    """

    _verdict = "is not valid"


class RecordFileError(InputError):
    """A ground-motion file cannot be read: it is missing, invalid or incomplete.

    The message reads ``record = PATH cannot be read: line LINE, FOUND: VALID; HINT``, without the
    line where the whole file is meant.

    Parameters
    ----------
    path
        The file.
    valid
        What is wrong, or what it must be, as a clause.
    hint
        What to do next, as a clause.
    line
        Number of the line, the first one being 1.
    found
        What stands there.
    kind
        Word for a count of what is left out: ``velocity``, ``displacement``, ``spectra``,
        ``counts``, ``no record``; ``damaged`` of a file that is cut or garbled.

    Examples
    --------
    >>> raise RecordFileError(
    ...     path="hut.AT2",
    ...     line=4,
    ...     found="NPTS= 12",
    ...     valid="it must state the number of samples and their interval",
    ...     hint="write it as NPTS= 12, DT= .01 SEC",
    ... )
    Traceback (most recent call last):
    ...
    rocksteady.errors.RecordFileError: record = 'hut.AT2' cannot be read: line 4, 'NPTS= 12': it \
must state the number of samples and their interval; write it as NPTS= 12, DT= .01 SEC
    """

    _verdict = "cannot be read"

    def __init__(
        self,
        *,
        path: str | PathLike[str],
        valid: str,
        hint: str,
        line: int | None = None,
        found: str | None = None,
        kind: str = "",
    ) -> None:
        self.path = path
        self.line = line
        self.found = found
        self.kind = kind
        self.clause = valid
        place = "" if line is None else f"line {line}"
        if found is not None:
            place = f"{place}, {_shown(found)}" if place else _shown(found)
        super().__init__(
            name="record",
            value=fspath(path) if isinstance(path, PathLike) else path,
            valid=f"{place}: {valid}" if place else valid,
            hint=hint,
        )

    def __reduce__(self) -> tuple[object, ...]:
        parts = (self.path, self.clause, self.hint, self.line, self.found)
        return _rebuilt_of_file, parts, self.__dict__


class ModelError(RocksteadyError, ValueError):
    """Arguments are valid alone, but the model refuses them together.

    Vertical base motion with the linear equations of motion is one: the equations have no such
    term. The message reads ``NAME = VALUE is refused by the model: VALID; HINT``.
    """

    _verdict = "is refused by the model"


class MissingKernelsError(RocksteadyError):
    """Compiled kernels are missing, damaged, or of other sources or another processor.

    The message reads ``NAME FAULT: VALID; HINT``.
    """


class OutputError(RocksteadyError):
    """A file or a folder cannot be written.

    It exists already, or its folder is missing or not writable. Raised before anything is
    computed, so that nothing is left half written. The message reads ``NAME = VALUE cannot be
    written: VALID; HINT``.
    """

    _verdict = "cannot be written"


class UnfinishedError(RocksteadyError):
    """A long computation was stopped; finished results are kept and it can be resumed.

    The disk is full, or a cluster has been lost. The message reads ``NAME = VALUE is not finished:
    VALID; HINT``.
    """

    _verdict = "is not finished"


def check_installed(
    refused: Callable[[str, str], RocksteadyError], extra: str, *packages: str
) -> None:
    """Raise an error where a package of an extra is not installed.

    Parameters
    ----------
    refused
        Makes the error from its last two parts.
    extra
        The extra.  Where the package was installed from a checkout, pip takes the requirements of
        the extra from there.
    packages
        Names to import.
    """
    for package in packages:
        if find_spec(package) is None:
            hint = f"install it: pip install 'rocksteady[{extra}]'"
            raise refused(f"{package} is not installed", hint)


def with_call_errors(function: Callable[P, T]) -> Callable[P, T]:
    """Return a function whose calls with missing or extra arguments raise `InputError`."""

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> T:
        try:
            return function(*args, **kwargs)
        except TypeError:
            misfit = call_error(function, args, kwargs)
            if misfit is None:
                raise
        raise misfit

    return call


def call_error(
    function: Callable[..., object], args: tuple[object, ...], kwargs: dict[str, object]
) -> InputError | None:
    """Return the error that a call does not fit a signature; None where it does."""
    import inspect
    from difflib import get_close_matches

    signature = inspect.signature(function)
    try:
        signature.bind(*args, **kwargs)
    except TypeError:
        pass
    else:
        return None
    owner, _, name = function.__qualname__.rpartition(".")
    called = owner if name == "__init__" else name
    parameters = list(signature.parameters.values())
    accepted = [each for each in parameters if each.name not in {"self", "cls"}]
    by_place = [each for each in parameters if each.kind is each.POSITIONAL_OR_KEYWORD]
    names = ", ".join(each.name for each in accepted) or "none"
    unknown = next((key for key in kwargs if key not in signature.parameters), None)
    if unknown is not None:
        close = get_close_matches(unknown, [each.name for each in accepted], n=1)
        hint = f"did you mean {close[0]}?" if close else f"its arguments are: {names}"
        return InputError(unknown, kwargs[unknown], f"{called} has no such argument", hint)
    if len(args) > len(by_place):
        extra = args[len(by_place)]
        most = len(by_place) - (len(parameters) - len(accepted))
        valid = f"{called} takes {most or 'no'} argument{'s' * (most != 1)} without a name"
        return InputError(f"argument {most + 1}", extra, valid, f"name the others: {names}")
    repeated = next((each.name for each in by_place[: len(args)] if each.name in kwargs), None)
    if repeated is not None:
        valid = f"{called} takes it once"
        return InputError(repeated, Words("is given twice"), valid, "give it by place or by name")
    needs = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    needed = [each.name for each in accepted if each.default is each.empty and each.kind in needs]
    given = {each.name for each in by_place[: len(args)]} | set(kwargs)
    missing = [each for each in needed if each not in given]
    verb = Words("is not given" if len(missing) == 1 else "are not given")
    valid = f"{called} needs {', '.join(needed)}"
    return InputError(", ".join(missing), verb, valid, f"its arguments are: {names}")


def one_line(text: str) -> str:
    """Return a message as one printable line: long words without their middle.

    A word may be a name of thousands of letters, which a file or a caller has given.
    """
    words = " ".join(_cut(word) for word in text.split())
    if words.isprintable():
        return words
    return "".join(
        letter if letter.isprintable() else letter.encode("unicode_escape").decode()
        for letter in words
    )


def _shown(value: object) -> str:
    """Return `value` as one short line: numbers and paths without their type, the rest by repr.

    A value that has no text, as a list nested thousands deep, is shown as its class.
    """
    try:
        if isinstance(value, Number):
            text = str(value)  # of a NumPy scalar the number alone, where repr names its class
        elif isinstance(value, PathLike):
            text = repr(fspath(value))
        else:  # of a text of NumPy, repr is "np.str_('a')"
            text = repr(str(value) if isinstance(value, str) else value)
        return _cut(" ".join(text.split()))
    except Exception:  # noqa: BLE001 -- its own code fails, or Python nests no deeper
        return f"<{type(value).__name__}>"


def _cut(text: str) -> str:
    """Return a text without the middle of a long one."""
    if len(text) <= _LONGEST_VALUE:
        return text
    half = (_LONGEST_VALUE - len(" ... ")) // 2
    return f"{text[:half]} ... {text[-half:]}"


def _rebuilt_of_file(
    path: str | PathLike[str], valid: str, hint: str, line: int | None, found: str | None
) -> RecordFileError:
    """Make the error of a file again from its parts, for pickle."""
    return RecordFileError(path=path, valid=valid, hint=hint, line=line, found=found)
