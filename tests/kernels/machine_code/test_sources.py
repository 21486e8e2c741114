"""The hash that names machine code."""

import hashlib
import shutil
from collections.abc import Iterator
from enum import IntEnum
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from rocksteady.kernels.machine_code import sources as module
from rocksteady.kernels.machine_code.sources import sources, sources_hash, unchanged
from tests.every import every


@pytest.fixture
def copy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Have the kernels hashed where they can be changed."""
    folder = tmp_path / "kernels"
    shutil.copytree(module._root(), folder, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(module, "_root", lambda: folder)
    monkeypatch.setattr(module, "libraries_folder", lambda: tmp_path)
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
    edited.write_text(edited.read_text(encoding="utf-8") + "EDITED = 1\n", encoding="utf-8")
    assert sources_hash() == before
    assert not unchanged()
    forget()
    assert sources_hash() != before


def test_a_name_counts_like_a_content(copy: Path) -> None:
    before = sources_hash()
    (copy / "linear" / "flight.py").rename(copy / "linear" / "flights.py")
    forget()
    assert sources_hash() != before


def test_comments_docstrings_and_layout_do_not_count(copy: Path) -> None:
    before = sources_hash()
    edited = copy / "linear" / "flight.py"
    edited.write_text(
        "# what it is\n" + edited.read_text("utf-8").replace('"""', '"""Now: ', 1) + "\n\n",
        encoding="utf-8",
    )
    for _ in range(2):  # walked, and kept
        forget()
        assert sources_hash() == before
    assert (copy.parent / module.NAME).read_text("ascii").split()[1] == before


@pytest.mark.usefixtures("copy")
def test_a_status_code_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    before = sources_hash()
    monkeypatch.setattr(module, "Status", IntEnum("Status", ["ROCKING", "AT_REST"]))
    forget()
    assert sources_hash() != before


@every("kept", ["", "one", "one two three", "\0"])
def test_a_damaged_note_is_written_anew(kept: str) -> None:
    with pytest.MonkeyPatch.context() as patch, TemporaryDirectory() as folder:
        expected = sources_hash()
        patch.setattr(module, "libraries_folder", lambda: Path(folder))
        Path(folder, module.NAME).write_text(kept, "ascii")
        forget()
        assert sources_hash() == expected
        assert Path(folder, module.NAME).read_text("ascii").split()[1] == expected
    forget()


def test_every_python_finds_the_same_hash() -> None:
    """Wheels are compiled by one Python and used by all: the digest below is every version's."""
    code = b'''"""A module."""
import math as m
from typing import NamedTuple

class Pair(NamedTuple):
    one: float = 1.0
    """The first."""

@m.mark(key=-1)
def f(a: int, *rest: float, b: bool = True, **more: object) -> tuple[float, ...]:
    """Return something."""
    while a > 0 and not b or a in (1, 2):
        a -= 1 if b else 2
    try:
        return tuple(x**2 for x in rest if x) + (f"{a:.3f}", 1j, None, rest[1:], *rest)
    except (ValueError, TypeError) as error:
        raise error from None
    match a:
        case [1, *_] | {"k": 2}:
            pass
    return (lambda q: q @ a)(~a)
'''
    found = hashlib.sha256(module._code(code)).hexdigest()
    assert found[:16] == "29041412aab0bc99"
