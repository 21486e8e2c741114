"""Parts of the freeze: what each holds, and which belong to the large set alone."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

from rocksteady.kernels.elementary import loops
from rocksteady.kernels.entries import ENTRIES
from tests.cli.test_app import COMMANDS
from tests.explorer.browser.test_opening import TABS
from tests.show.all_pictures import pages, pictures
from tools.freeze import commands, explorer, kernels, results, targets

Found = Iterator[tuple[str, str]]
"""Names of items, and what they show."""


class Part(NamedTuple):
    """A part, whose units can be computed in any order and in any process.

    Where a unit may raise `MissingProgramError`, names of its items begin with it and a colon.
    """

    units: Callable[[], list[str]]
    freeze: Callable[[str], Found]


def _once() -> list[str]:
    return [""]


def _entries() -> list[str]:
    return [name for name, kernel in ENTRIES.items() if kernel.__module__ != loops.__name__]


PARTS = {
    "calls": Part(_once, results.freeze_calls),
    "things": Part(_once, results.freeze_things),
    "pictures": Part(lambda: [*pictures(), *pages()], results.freeze_pictures),
    "kernels": Part(_entries, kernels.freeze_entry),
    "cells": Part(_once, kernels.freeze_cells),
    "commands": Part(lambda: commands.lines(long=False), commands.freeze_line),
    "stores": Part(_once, results.freeze_stores),
    "refusals": Part(lambda: list(COMMANDS), commands.freeze_refusals),
    "help": Part(commands.paths, commands.freeze_help),
    "signatures": Part(_once, results.freeze_signatures),
    "long-commands": Part(lambda: commands.lines(long=True), commands.freeze_line),
    "targets": Part(lambda: list(targets.TARGETS), targets.freeze_target),
    "physics": Part(lambda: explorer.ASKING, explorer.freeze_physics),
    "views": Part(lambda: list(TABS), explorer.freeze_view),
}
"""All parts, those that take longest first."""
LARGE = {"pictures", "long-commands", "targets"}
"""Parts of the large set alone."""
