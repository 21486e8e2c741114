"""One visual language: the same word never has two looks, the same look never two words."""

import contextlib
from collections import defaultdict
from collections.abc import Iterator
from functools import cache

from matplotlib.figure import Figure

from rocksteady.show.style.page import Page
from tests.public.calls import calls, close_pictures
from tests.show.seen import Seen, read_figure
from tools.freeze.results import figures, room

MEET = {
    "map of fates": ("rest", "rocks", "falls", "undecided"),
    "map of kinds": (
        *("rest", "symmetric", "unsymmetric", "subharmonic", "aperiodic", "falls", "undecided"),
    ),
    "history": ("motion", "base", "impact", "ink"),
    "branches": ("motion", "unsymmetric_line", "subharmonic_line", "aperiodic_line", "ink"),
    "block on its ground": ("rest", "rocks", "falls", "soil", "impact", "base"),
    "fragility": ("risk", "ink", "paper"),
}
"""Roles that meet in one picture."""
LEAST = 9.0
"""Distance in CIEDE2000 of two colours that meet, in each of four visions."""


def drawn() -> Iterator[tuple[str, Figure]]:
    """Yield every kind of figure by its name."""
    with contextlib.chdir(room()):
        for name, draw in figures().items():
            yield name, draw(page=Page())
        for label, call in calls().items():
            if call.function.__module__.startswith("rocksteady.show.plots"):
                yield label, call().figure
                close_pictures()


@cache
def seen() -> dict[Seen, set[str]]:
    """Return every entry of a legend and every coloured label, with the pictures that have it."""
    found: defaultdict[Seen, set[str]] = defaultdict(set)
    for name, figure in drawn():
        for each in read_figure(figure):
            found[each].add(name)
    return dict(found)
