"""The hash that names machine code."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from rocksteady.kernels.machine_code import sources as module
from rocksteady.kernels.machine_code.sources import sources, sources_hash, unchanged


@pytest.fixture
def copy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Have the kernels hashed where they can be changed."""
    folder = tmp_path / "kernels"
    shutil.copytree(module._root(), folder, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(module, "_root", lambda: folder)
    forget()
    yield folder
    forget()


def forget() -> None:
    sources_hash.cache_clear()
    module._stamps.cache_clear()


def test_every_python_file_of_the_kernels_counts() -> None:
    folder = module._root()
    assert {path.relative_to(folder) for path in sources()} == {
        path.relative_to(folder) for path in folder.rglob("*.py")
    }
    assert folder / "march" / "march.py" in sources()


def test_a_change_changes_the_hash_of_the_next_process_and_is_noticed_in_this(copy: Path) -> None:
    before = sources_hash()
    assert unchanged()
    edited = copy / "linear" / "flight.py"
    edited.write_text(edited.read_text(encoding="utf-8") + "# edited\n", encoding="utf-8")
    assert sources_hash() == before
    assert not unchanged()
    forget()
    assert sources_hash() != before


def test_a_name_counts_like_a_content(copy: Path) -> None:
    before = sources_hash()
    (copy / "linear" / "flight.py").rename(copy / "linear" / "flights.py")
    forget()
    assert sources_hash() != before
