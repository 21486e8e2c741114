"""Where each command is defined, by the titles of --help, and what the program alone shows."""

from collections.abc import Callable, Collection, Mapping
from types import ModuleType
from typing import Any, Final, NamedTuple

from rocksteady.leaves import import_if_present

GROUPS: Final[Mapping[str, Mapping[str, str]]] = {
    "One block": {
        "simulate": "cli.commands.simulate:simulate",
        "overturn": "cli.commands.overturn:overturn",
        "record": "cli.commands.record:record",
        "spectrum": "cli.commands.spectrum:spectrum",
        "restitution": "cli.commands.observations.restitution:restitution",
    },
    "Steady motions": {
        "steady": "cli.commands.steady:steady",
        "attractor": "cli.commands.attractor:attractor",
        "orbits": "cli.commands.orbits:orbits",
        "bifurcate": "cli.commands.bifurcate:bifurcate",
        "curves": "cli.commands.curves:curves",
        "basins": "cli.commands.windows.basins:basins",
        "edge": "cli.commands.windows.edge:edge",
        "map": "cli.commands.maps:maps",
    },
    "Objects and risk": {
        "assess": "cli.commands.risk.assess:assess",
        "screens": "cli.commands.risk.screens:screens",
        "facade": "facades.command:facade",
        "fragility": "cli.commands.risk.fragility:fragility",
        "calibrate": "cli.commands.observations.calibrate:calibrate",
        "predict": "cli.commands.observations.predict:predict",
        "back-analyse": "cli.commands.observations.back_analyse:back_analyse",
    },
    "Pages and papers": {
        "explore": "explorer.command:explore",
        "paper": "studies.tso_wong_1989.command:paper",
        "study atlas": "studies.atlas.command:atlas",
        "study chaos": "certify.chaos_study.command:chaos",
    },
    "Proofs": {"certify": "certify.command:certify"},
    "This installation": {"doctor": "cli.commands.doctor:doctor"},
}
"""Module and function of each command; those of leaves may be missing."""

QUESTIONS: Final = (
    (
        "Does it fall in a pulse?",
        "simulate --width-m 0.5 --height-m 2 \\\n--pulse one-sine --accel-g 0.4 --freq-hz 1",
    ),
    ("At which strength?", "overturn --pulse one-sine -W 3 -r 0.9"),
    ("Does it fall in my record?", "simulate --block server-rack \\\n--record FILE"),
    ("How likely does it fall?", "assess --example"),
    ("Does my facade hold?", "facade --example"),
    ("What does it settle to?", "attractor -A 2 -W 1.9 -r 0.8"),
    ("Show me.", "explore"),
)
"""Questions that the program answers, each with a line that runs."""


class Registered(NamedTuple):
    """A command."""

    module: ModuleType
    """Has its HELP and EXAMPLES, and may have MAIN."""
    run: Callable[..., Any]


def registered_commands() -> dict[str, dict[str, Registered]]:
    """Return the commands that are there by their names, below the titles of --help."""
    groups: dict[str, dict[str, Registered]] = {}
    for title, commands in GROUPS.items():
        for name, place in commands.items():
            path, _, function = place.partition(":")
            module = import_if_present(path)
            if module is not None:
                command = Registered(module, getattr(module, function))
                groups.setdefault(title, {})[name] = command
    return groups


def questions(names: Collection[str]) -> str:
    """Return what the program alone shows: the questions that commands of these names answer."""
    lines = ["Does it rock, does it fall? Exact answers for free-standing rigid blocks."]
    for question, line in QUESTIONS:
        if line.split()[0] in names:
            first, *rest = line.split("\n")
            lines.append(f"  {question:<26}  rocksteady {first}")
            lines += [f"{'':32}{each}" for each in rest]
    return "\n".join([*lines, "All commands: rocksteady --help"])
