"""Forms of what the package writes: an object and a store of today are read by later versions."""

import re
from collections import defaultdict
from pathlib import Path

from tools.freeze.records import FOLDER, loaded

KEYS = Path(__file__).with_name("json-keys.txt")
"""Of each schema the keys that its objects have, each with the block or flag that it belongs to."""


def written() -> dict[str, set[str]]:
    """The keys of the JSON objects that commands print, by schema, from the recorded answers."""
    found: dict[str, set[str]] = defaultdict(set)
    for part in ("commands", "long-commands"):
        for text in loaded((FOLDER / f"{part}.txt").read_text(encoding="utf-8")).values():
            for schema in re.findall(r'^schema: "(\S+)"$', text, re.MULTILINE):
                found[schema] |= set(re.findall(r"^(\w+): ", text, re.MULTILINE))
    return found


def promised() -> dict[str, set[str]]:
    """The keys that stay as long as the number of their schema."""
    lines = KEYS.read_text(encoding="utf-8").splitlines()
    return {
        schema: set(keys.split()) for schema, _, keys in (each.partition(": ") for each in lines)
    }


def test_a_key_goes_only_with_the_number_of_its_schema() -> None:
    """A schema with a new number gets a line of its own; a new key is added to its line."""
    now = written()
    lost = {schema: keys - now[schema] for schema, keys in promised().items() if schema in now}
    assert {schema: sorted(keys) for schema, keys in lost.items() if keys} == {}
    assert {schema: sorted(keys - promised()[schema]) for schema, keys in now.items()} == {
        schema: [] for schema in now
    }
    assert len(now) > 20


def test_every_schema_has_a_number() -> None:
    numbers = [re.fullmatch(r"rocksteady/[a-z-]+/([1-9]\d*)", schema) for schema in promised()]
    assert all(numbers)
