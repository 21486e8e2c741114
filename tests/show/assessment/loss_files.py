"""The files for loss models of a folder, read back as both tools do."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from tests.show.export.test_components import load_tabular, multilinear
from tests.show.export.test_openquake import read

Curve = Callable[[float], float]


def read_loss_files(folder: Path) -> dict[str, tuple[Curve, Curve]]:
    """Return the share that falls over PGA [g], as pelicun and OpenQuake read it, by identifier."""
    table = load_tabular(folder / "fragility.csv")
    states, functions, _ = read(folder / "fragility.xml")
    assert [*table.index] == [*functions]
    last = f"LS{len(states)}", "Theta_0"
    return {
        name: (multilinear(row[last], 9.80665), partial(functions[name].__call__, states[-1]))
        for name, row in table.iterrows()
    }
