"""Figures in notebooks: n plots are n pictures, whichever comes first, and no setting changes."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BEFORE = """
import matplotlib as mpl
import rocksteady as rs

block = rs.DimensionlessBlock(restitution=0.8)
run = rs.simulate(block, rs.Harmonic(amplitude=2.0, frequency_ratio=1.7), cycles=3)
unlike = lambda: sorted(
    key for key in settings if key != "interactive" and mpl.rcParams[key] != settings[key]
)
"""
KEPT = "settings = dict(mpl.rcParams)"
OURS = "rs.plots.trajectory(run);"
THEIRS = "import matplotlib.pyplot as plt; plt.plot([0, 1]);"
THREAD = (
    "import threading; from rocksteady.show.figures.single import simulation_figure\n"
    "thread = threading.Thread(target=simulation_figure, args=(run,))\n"
    "thread.start(); thread.join()"
)
FILM = (
    "film = rs.plots.animate(run, span=(0.0, 0.5), fps=10.0);film.save('film.gif', writer='pillow')"
)
CELLS = [
    (OURS, 1),
    (THEIRS, 1),
    (OURS, 1),
    ("rs.plots.phase_portrait(run); rs.plots.base(run);", 2),
    ("plt.figure().add_subplot(); " + OURS, 2),
    ("figure, axes = plt.subplots(); rs.plots.trajectory(run, axes);", 1),
    (THREAD, 0),
    (FILM, 0),
    (THEIRS, 1),
    ("with plt.style.context('dark_background'): " + OURS, 1),
    (OURS, 1),
    (THEIRS, 1),
]
ORDERS = {
    "ours-first": CELLS,
    "theirs-first": [(THEIRS, 1), *CELLS],
    "film-first": [(FILM, 0), *CELLS],
}

CELL_BY_CELL = """
import json, sys
names = {}
for code in json.load(sys.stdin):
    exec(code, names)
    backend = sys.modules.get("tests.show.inline_backend")
    print(backend.end_of_cell() if backend else 0)
print(names["unlike"](), names["mpl"].is_interactive())
"""


@pytest.mark.slow
def test_every_figure_of_a_notebook_is_shown(tmp_path: Path) -> None:
    cells = ORDERS["film-first"]
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", CELL_BY_CELL],
        input=json.dumps([BEFORE + KEPT, *(code for code, _ in cells)]),
        cwd=tmp_path,
        env={
            **os.environ,
            "MPLBACKEND": "module://tests.show.inline_backend",
            "PYTHONPATH": str(ROOT),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    *shown, after = done.stdout.splitlines()
    assert [int(count) for count in shown] == [0, *(count for _, count in cells)]
    assert after == "[] True"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("first", "magic"), [("theirs-first", ""), ("ours-first", "%matplotlib inline\n")]
)
def test_a_real_notebook_shows_n_pictures_of_n_plots(
    first: str, magic: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import nbformat
    from nbclient import NotebookClient

    cells = ORDERS[first]
    for folder in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR"):
        monkeypatch.setenv(folder, str(tmp_path / folder.lower()))
    monkeypatch.delenv("MPLBACKEND", raising=False)  # the kernel names its own
    codes = [BEFORE + magic + KEPT, *(code for code, _ in cells), "print(unlike())"]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code) for code in codes])
    client = NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}})
    client.execute()
    *drawn, last = notebook.cells
    shown = [sum("image/png" in one.get("data", {}) for one in cell.outputs) for cell in drawn]
    assert shown == [0, *(count for _, count in cells)]
    assert last.outputs[0].text == "[]\n"
