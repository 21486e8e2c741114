"""The flags of all commands, by the names that errors give them."""

from rocksteady.cli.flags import options
from tests.cli.program import rocksteady

EVERY_COMMAND = (
    *("steady", "simulate", "attractor", "orbits", "bifurcate", "curves", "basins", "edge", "map"),
    *("overturn", "record", "paper", "fragility", "assess", "facade", "screens", "explore"),
)


def test_every_flag_that_errors_name_exists() -> None:
    text = "".join(rocksteady(f"{command} --help").out for command in EVERY_COMMAND)
    for flag in options.FLAG_OF_ARGUMENT.values():
        assert flag.partition("/")[0] in text
