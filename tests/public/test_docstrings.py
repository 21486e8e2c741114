"""Every example of every docstring runs and prints what it says."""

import doctest
import importlib
import inspect
import pkgutil

import pytest

import rocksteady

MODULES = sorted(
    module.name
    for module in pkgutil.walk_packages(rocksteady.__path__, "rocksteady.")
    if module.name != "rocksteady.__main__"  # importing it runs the program
)

OPTIONS = doctest.IGNORE_EXCEPTION_DETAIL | doctest.NORMALIZE_WHITESPACE


def test_the_walk_finds_every_layer() -> None:
    layers = {name.split(".")[1] for name in MODULES}
    assert layers >= {"cli", "dynamics", "errors", "kernels", "model", "seismic", "show"}


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_print_what_they_say(name: str) -> None:
    result = doctest.testmod(importlib.import_module(name), optionflags=OPTIONS)
    assert result.failed == 0


@pytest.mark.parametrize("name", rocksteady.__all__)
def test_every_public_name_says_what_it_is(name: str) -> None:
    thing = getattr(rocksteady, name)
    if not isinstance(thing, str):
        text = inspect.getdoc(thing)
        assert text
        assert not text.startswith(f"{name}("), "the signature that dataclass has put there"
