"""A finished store, and a copy of it to be damaged."""

import shutil
from pathlib import Path

import pytest

from tests.sweep.store.faults import run


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("undisturbed") / "a.zarr"
    run(path)
    return path


@pytest.fixture
def begun(undisturbed: Path, tmp_path: Path) -> Path:
    """A store like that, to be damaged."""
    shutil.copytree(undisturbed, tmp_path / "a.zarr")
    return tmp_path / "a.zarr"
