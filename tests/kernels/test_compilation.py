"""How kernels are compiled, and where their machine code is kept."""

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numba
import numba.core.config
import pytest

from rocksteady.kernels import compilation
from rocksteady.kernels.compilation import cache_folder, compiled
from rocksteady.kernels.march import march
from tests.strategies import PLAIN

SOURCES = Path(compilation.__file__).parent


@pytest.fixture(autouse=True)
def _forget_the_folder() -> Iterator[None]:
    cache_folder.cache_clear()
    yield
    cache_folder.cache_clear()


def key_of(folder: Path, monkeypatch: pytest.MonkeyPatch, cache: Path) -> str:
    """Return the name of the cache folder that sources in `folder` would have."""
    monkeypatch.setattr(compilation, "__file__", str(folder / "compilation.py"))
    monkeypatch.setattr(
        "rocksteady.kernels.compilation.platformdirs.user_cache_dir", lambda _name: str(cache)
    )
    cache_folder.cache_clear()
    return cache_folder().name


def test_the_cache_folder_changes_with_any_of_the_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy = tmp_path / "kernels"
    shutil.copytree(SOURCES, copy, ignore=shutil.ignore_patterns("__pycache__"))
    first = key_of(copy, monkeypatch, tmp_path / "cache")
    assert key_of(copy, monkeypatch, tmp_path / "cache") == first
    keys = {first}
    for name in ("flight.py", "zeros.py"):
        source = copy / name
        source.write_text(source.read_text() + "\n# changed\n")
        keys.add(key_of(copy, monkeypatch, tmp_path / "cache"))
    assert len(keys) == 3


def test_the_cache_folder_can_be_written_to() -> None:
    folder = cache_folder()
    assert folder.is_dir()
    with tempfile.TemporaryFile(dir=folder):
        pass


def test_where_home_is_read_only_the_code_is_kept_in_the_temporary_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    blocked = tmp_path / "home"
    blocked.write_text("a file, in which no folder can be made")
    monkeypatch.setattr(
        "rocksteady.kernels.compilation.platformdirs.user_cache_dir", lambda _name: str(blocked)
    )
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    folder = cache_folder()
    assert folder.parent == tmp_path
    assert folder.stat().st_mode & 0o077 == 0


def test_compiling_leaves_numba_s_own_setting_alone() -> None:
    before = numba.core.config.CACHE_DIR  # type: ignore[attr-defined]

    @compiled
    def double(number: float) -> float:
        return 2.0 * number

    assert double(2.0) == 4.0
    assert before == numba.core.config.CACHE_DIR  # type: ignore[attr-defined]


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_a_kernel_is_compiled_without_fast_math_and_without_the_lock() -> None:
    options = march.targetoptions  # type: ignore[attr-defined]
    assert options["nogil"] is True
    assert options["error_model"] == "numpy"
    assert not options.get("fastmath")


@pytest.mark.skipif(not PLAIN, reason="kernels are compiled")
def test_without_compilation_a_kernel_is_the_plain_function() -> None:
    assert type(march).__name__ == "function"


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_warming_up_leaves_nothing_to_compile() -> None:
    # A second process finds all of it on disk.
    code = (
        "import numba, sys\n"
        "from numba.core import event\n"
        "from rocksteady.kernels import warm\n"
        "with event.install_recorder('numba:compile') as recorder:\n"
        "    warm.warm()\n"
        "sys.exit(len(recorder.buffer))\n"
    )
    subprocess.run([sys.executable, "-m", "rocksteady.kernels.warm"], check=True)
    again = subprocess.run([sys.executable, "-c", code], check=False)
    assert again.returncode == 0
