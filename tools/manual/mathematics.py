"""The typesetter of the formulae, copied into the site: it works from a file and offline."""

import shutil
from importlib.util import find_spec
from pathlib import Path

PACKAGE = "sphinx-mathjax-offline"
"""A folder of the environment, with MathJax 3; its name is no name of a module."""
SCRIPT = "mathjax/tex-svg-full.js"
FOLDER = Path(__file__).parents[2] / "build" / "manual" / "mathematics"


def static_path() -> list[str]:
    """Return the folder whose files the site takes over: one script, which draws its own glyphs."""
    found = find_spec("sphinx")
    assert found is not None
    assert found.origin is not None
    packages = Path(found.origin).parents[1]
    target = FOLDER / SCRIPT
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(packages / PACKAGE / "static" / SCRIPT, target)
    return [str(FOLDER)]
