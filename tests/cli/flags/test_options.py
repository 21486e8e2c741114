"""The flags of all commands, by the names that errors give them."""

import inspect
from types import UnionType
from typing import get_args, get_origin

from rocksteady.cli import app
from rocksteady.cli.flags import options
from tests.cli.program import rocksteady

EVERY_COMMAND = (
    *("steady", "simulate", "attractor", "orbits", "bifurcate", "curves", "basins", "edge", "map"),
    *("overturn", "record", "paper", "fragility", "assess", "facade", "screens", "explore"),
)


def test_every_flag_that_errors_name_exists() -> None:
    text = "".join(rocksteady(f"{command} --help-all").out for command in EVERY_COMMAND)
    for flag in options.FLAG_OF_ARGUMENT.values():
        assert flag.partition("/")[0] in text


def test_the_default_of_each_flag_is_of_its_type() -> None:
    seen = 0
    for name, command in app.COMMANDS.items():
        for parameter in inspect.signature(command.run).parameters.values():
            if get_args(parameter.annotation) and parameter.default not in (parameter.empty, ...):
                kind, option = get_args(parameter.annotation)
                kinds = get_args(kind) if get_origin(kind) is UnionType else (kind,)
                assert type(parameter.default) in kinds, (name, option.param_decls)
                seen += 1
    assert seen > 300
