"""Cells of the manual: each picture comes twice, and the cell leaves what it left."""

import io
import os
from base64 import b64decode
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
import pytest
from nbclient import NotebookClient
from PIL import Image

from tools.manual import cells, twins

ROOT = Path(__file__).parents[2]
CELLS = (
    "import rocksteady as rs\nblock = rs.DimensionlessBlock(restitution=0.9)",
    """start = rs.State(angle=0.5, velocity=0.0)
run = rs.simulate(block, rs.Still(), start=start)
seen = id(run)
print('drawn')
run.plot();""",
    "print(seen == id(run), rs.simulate(block, rs.Still(), start=start) is run)",
)


@pytest.fixture(name="ran")
def _ran(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Return the outputs of cells that a kernel of the manual has run."""
    profile = tmp_path / "profile_default"
    profile.mkdir()
    (profile / "ipython_kernel_config.py").write_text(cells.CONFIGURATION, encoding="utf-8")
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    path = [str(ROOT), str(ROOT / "src"), os.environ.get("PYTHONPATH", "")]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(path))
    monkeypatch.delenv("MPLBACKEND", raising=False)
    made: Any = nbformat.v4
    notebook = made.new_notebook(cells=[made.new_code_cell(each) for each in CELLS])
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    return [each.outputs for each in notebook.cells]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_cell_draws_on_both_papers_and_prints_and_binds_once(ran: list[Any]) -> None:
    _, drawn, last = ran
    assert [each.text for each in drawn if each.output_type == "stream"] == ["drawn\n"]
    pictures = [each.data["image/png"] for each in drawn if each.output_type != "stream"]
    shown = [Image.open(io.BytesIO(b64decode(each))) for each in pictures]
    assert [each.info[twins.PAPER] for each in shown] == ["light", "dark"]
    light, dark = (np.asarray(each) for each in shown)
    assert light.shape == dark.shape
    assert light[0, 0, 3] == dark[0, 0, 3] == 0
    assert light[light[..., 3] == 255].mean() < dark[dark[..., 3] == 255].mean()
    assert last[0].text == "True False\n"
