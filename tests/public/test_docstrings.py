"""Every example of every docstring runs and prints what it says."""

import doctest
import importlib
import inspect
import linecache
import pkgutil

import pytest

import rocksteady
from tests.every import every
from tests.outputs import unrendered
from tests.show.assessment.pages import drawn_once
from tools.namespace import THINGS

MODULES = sorted(
    module.name
    for module in pkgutil.walk_packages(rocksteady.__path__, "rocksteady.")
    if module.name != "rocksteady.__main__"  # importing it runs the program
)

OPTIONS = doctest.IGNORE_EXCEPTION_DETAIL | doctest.NORMALIZE_WHITESPACE


def test_the_walk_finds_every_layer() -> None:
    layers = {name.split(".")[1] for name in MODULES}
    assert layers >= {"cli", "dynamics", "errors", "kernels", "model", "seismic", "show"}


@pytest.mark.parametrize("folder", sorted({name.rpartition(".")[0] for name in MODULES}))
def test_the_examples_print_what_they_say(folder: str) -> None:
    modules = [name for name in MODULES if name.rpartition(".")[0] == folder]
    linecache.clearcache()  # for each docstring doctest looks at every file that it holds
    with unrendered(), drawn_once():  # no example reads a picture
        results = {
            name: doctest.testmod(importlib.import_module(name), optionflags=OPTIONS).failed
            for name in modules
        }
    assert results == dict.fromkeys(modules, 0)


@every("name", THINGS)
def test_every_public_name_says_what_it_is(name: str) -> None:
    thing = THINGS[name]
    if not isinstance(thing, str):
        text = inspect.getdoc(thing)
        assert text
        assert not text.startswith(f"{name}("), "the signature that dataclass has put there"
