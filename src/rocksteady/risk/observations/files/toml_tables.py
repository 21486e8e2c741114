"""Tables and keys of a TOML file as msgspec classes, with one line for each fault of a person's."""

import difflib
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Final, TypeVar, get_args

import msgspec

from rocksteady.errors import InputError, RocksteadyError, Words

Given = TypeVar("Given", bound=msgspec.Struct)

KINDS: Final[Mapping[str, str]] = {
    "float": "a number",
    "int": "a whole number",
    "bool": "true or false",
    "str": "a text",
    "array": "a list",
    "object": "a table such as { low = 0.3, high = 0.5 }",
}
"""Words for the types of msgspec."""


@dataclass(frozen=True, kw_only=True)
class TomlTables:
    """Tables that a file may have.

    Attributes
    ----------
    kinds
        Class of each table by its name, as "demand.spectrum"; "" is what stands above the first
        table, and is the class of the whole.
    needs
        What a file must have, as a clause.
    lists
        Names of tables that may be repeated, as ``[[loads]]``.
    inline
        Keys of an inline table by its place.
    """

    kinds: Mapping[str, type[msgspec.Struct]]
    needs: str
    lists: tuple[str, ...] = ()
    inline: Callable[[str], tuple[str, ...]] = lambda _: ()

    def convert(self, values: Mapping[str, object], kind: type[Given], source: str) -> Given:
        """Return the values of a file as frozen tables.

        Parameters
        ----------
        values
            As `tomllib` returns them.
        kind
            Class of the whole.
        source
            What they come from, for messages: a file, or a file and a line.

        Raises
        ------
        InputError
            With the key that is unknown and the nearest known one, or the key that is missing or
            of another type.
        """
        values = _plain(values)
        try:
            return msgspec.convert(values, kind)
        except msgspec.ValidationError as error:
            raise self._translated(str(error), values, source) from None
        except UnicodeError:
            raise InputError(
                source,
                Words("has a text that is no UTF-8"),
                "its texts are kept in UTF-8",
                "leave out what no encoding has",
            ) from None

    def keys_of(self, table: str) -> tuple[str, ...]:
        """Return the keys of a table, in the order of the documentation."""
        kind = self.kinds.get(table)
        return self.inline(table) if kind is None else tuple(kind.__struct_fields__)

    def _translated(self, message: str, values: Mapping[str, object], source: str) -> InputError:
        """Return the line of the package for one of msgspec."""
        what, _, place = message.partition(" - at ")
        whole = place.strip("`").removeprefix("$").removeprefix(".")
        path = re.sub(r"\[[^\]]*\]", "", whole)
        number = re.search(r"\[(\d+)\]", whole)
        listed = path.partition(".")[0]
        if number is not None and listed in self.lists:
            source = f"{source}: [[{listed}]] {int(number[1]) + 1}"
        word = re.findall(r"`([^`]*)`", what)
        if "unknown field" in what:
            return self._unknown(word[0], path, source)
        if "missing required field" in what:
            return self._missing(word[0], path, source)
        table, _, key = path.rpartition(".")
        value = value_at(values, whole)
        name = self._named(source, table, key) if key else source
        if "Invalid enum value" in what:
            choices = _choices(self.kinds[table].__annotations__[key])
            valid = f"it must be one of {', '.join(choices)}"
            default = self._default(table, key)
            hint = f"leave it out for {default}" if default != "None" else "leave it out"
            return InputError(name, value, valid, hint)
        wanted = [KINDS[kind] for kind in word[0].split(" | ") if kind in KINDS] if word else []
        if path in self.kinds or not key:
            wanted = [each for each in wanted if each == KINDS["str"]] + ["a table of keys"]
            if path in self.lists:
                is_array = "array" in what.partition(",")[0]
                wanted = [f"tables, each below its own [[{path}]]"] if is_array else wanted
        if not wanted:  # of an integer beyond 64 bits nothing is quoted
            wanted = ["a number of usual size"]
        valid = f"it must be {' or '.join(dict.fromkeys(wanted))}"
        return InputError(name, value, valid, "write texts in quotes and numbers without")

    def _missing(self, key: str, path: str, source: str) -> InputError:
        """Return the refusal of a table without a key that it needs."""
        if path not in self.kinds:
            table, _, last_part = path.rpartition(".")
            return InputError(
                self._named(source, table, last_part),
                Words(f"has no {key}"),
                "a range has a low and a high",
                "write { low = 0.3, high = 0.5 }, or one number",
            )
        return InputError(
            f"{source}: [{key}]" if key in self.kinds else self._named(source, path, key),
            Words("is missing"),
            f"{self._place(path)} needs it" if path else self.needs,
            f"add it: the keys of {self._place(path)} are {', '.join(self.keys_of(path))}",
        )

    def _unknown(self, key: str, table: str, source: str) -> InputError:
        """Return the refusal of a key that no table has, or another one."""
        keys = self.keys_of(table)
        near = difflib.get_close_matches(key, keys, n=1)
        homes = [name for name in self.kinds if key in self.keys_of(name) and name != table]
        if homes:
            hint = f"it belongs to {self._place(homes[0])}"
        elif near:
            hint = f"did you mean {near[0]}?"
        else:
            every = [each for name in self.kinds for each in self.keys_of(name)]
            far = difflib.get_close_matches(key, every, n=1)
            hint = f"did you mean {far[0]}?" if far else "remove it"
        known = table in self.kinds
        above, _, last = table.rpartition(".")
        return InputError(
            self._named(source, table, key) if known else f"{named(source, above, last)}: {key}",
            Words("is unknown"),
            f"{f'the keys of {self._place(table)}' if known else 'its keys'} are {', '.join(keys)}",
            hint,
        )

    def _named(self, source: str, table: str, key: str) -> str:
        """Return a key with its table; for a list the table stands in the source already."""
        return named(source, "" if table in self.lists else table, key)

    def _place(self, table: str) -> str:
        """Return a table as a person writes it."""
        if table in self.lists:
            return f"[[{table}]]"
        return f"[{table}]" if table else "the file's top"

    def _default(self, table: str, key: str) -> str:
        """Return the default value of a key."""
        fields = {field.name: field for field in msgspec.structs.fields(self.kinds[table])}
        return repr(fields[key].default)


def _plain(value: Any) -> Any:
    """Return tables and lists of Python, where those of NumPy would pass as empty tables."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return list(map(_plain, value))
    return value.tolist() if hasattr(value, "tolist") else value


def named(source: str, table: str, key: str) -> str:
    """Return a key with its file and its table, as "desk.toml: [geometry] width_m"."""
    return f"{source}: [{table}] {key}" if table else f"{source}: {key}"


@contextmanager
def in_file(source: str, table: str = "") -> Iterator[None]:
    """Name file and table in the errors of what is inside."""
    try:
        yield
    except RocksteadyError as error:
        name = named(source, table, error.name)
        raise type(error)(name, error.value, error.valid, error.hint) from None


def value_at(values: Mapping[str, object], path: str) -> object:
    """Return what stands at a place, as "loads[0].z_m"."""
    here: object = values
    for key in re.findall(r"[^.\[\]]+", path):
        if isinstance(here, Mapping):
            here = here.get(key)
        elif isinstance(here, list) and key.isdecimal():
            here = here[int(key)]
    return here


def _choices(annotation: Any) -> list[str]:
    """Return the texts that an annotation allows."""
    parts = [each for part in get_args(annotation) for each in (get_args(part) or (part,))]
    return [part for part in parts if isinstance(part, str)]
