"""The module that the page holds: where it is taken from, and what is refused."""

import hashlib
from pathlib import Path

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer import module
from rocksteady.explorer.module import BEGINS, NAME, page_module, prune
from rocksteady.kernels.machine_code import library
from rocksteady.kernels.machine_code.library import checksum_file
from rocksteady.kernels.machine_code.sources import sources_hash

SOUND = BEGINS + sources_hash().encode()


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a wheel, empty."""
    folder = tmp_path / "wheel"
    folder.mkdir()
    monkeypatch.setattr(module, "installed_folder", lambda: folder)
    return folder


@pytest.fixture
def built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of what is built on this machine, empty and private."""
    folder = tmp_path / "kernels" / sources_hash() / "library"
    for each in (folder.parents[1], folder.parent, folder):
        each.mkdir(mode=0o700)
    monkeypatch.setattr(library, "version_folder", lambda _: folder.parent)
    return folder


def put(folder: Path, content: bytes = SOUND) -> Path:
    """Write a module with its checksum."""
    path = folder / NAME
    path.write_bytes(content)
    checksum_file(path).write_text(f"{hashlib.sha256(content).hexdigest()} tools\n", "ascii")
    return path


def test_the_module_of_a_wheel_comes_first(installed: Path, built: Path) -> None:
    own = put(built)
    assert page_module() == own
    assert page_module() == own
    theirs = put(installed)
    checksum_file(theirs).unlink()  # pip has checked it
    assert page_module() == theirs


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (BEGINS + b"0123456789abcdef", "was made from other sources"),
        (b"<script>" + sources_hash().encode(), "is no WebAssembly module"),
        (b"", "is no WebAssembly module"),
    ],
)
def test_what_is_no_module_of_these_sources_is_refused_and_named(
    content: bytes, reason: str, installed: Path, built: Path
) -> None:
    found = put(installed, content)
    with pytest.raises(MissingKernelsError, match=rf"{found} {reason}.*`make library`") as error:
        page_module()
    assert "\n" not in str(error.value)
    own = put(built)
    assert page_module() == own


@pytest.mark.usefixtures("installed", "built")
def test_without_a_module_the_error_says_what_to_do() -> None:
    with pytest.raises(MissingKernelsError, match=r"it is not there.*`make library`"):
        page_module()


@pytest.mark.usefixtures("installed")
def test_a_damaged_module_is_refused(built: Path) -> None:
    put(built).write_bytes(SOUND + b"\0")
    with pytest.raises(MissingKernelsError, match="is damaged"):
        page_module()
    checksum_file(built / NAME).unlink()
    with pytest.raises(MissingKernelsError, match="cannot be read"):
        page_module()


@pytest.mark.usefixtures("installed")
def test_a_folder_that_others_may_write_to_is_not_trusted(built: Path) -> None:
    put(built)
    built.chmod(0o777)
    with pytest.raises(MissingKernelsError, match="can be written by other users"):
        page_module()
    built.chmod(0o700)
    assert page_module() == built / NAME


def test_modules_go_with_the_libraries_of_their_versions(built: Path) -> None:
    versions = [built.parents[1] / name / "library" for name in ("0" * 16, "1" * 16, "other")]
    for folder in versions:
        folder.mkdir(mode=0o700, parents=True)
        put(folder)
    alone, beside, foreign = versions
    (beside / "rocksteady-linux-x86-64-v2.so").touch()
    own = put(built)
    prune()
    assert not alone.parent.exists()
    assert (beside / NAME).exists()
    assert (foreign / NAME).exists()
    assert own.exists()
