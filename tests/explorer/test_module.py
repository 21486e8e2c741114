"""The module that the page holds: where it is taken from, and what is refused."""

import hashlib
from pathlib import Path

import pytest

from rocksteady.errors import MissingKernelsError
from rocksteady.explorer import _module as module
from rocksteady.explorer._module import BEGINS, NAME, page_module
from rocksteady.kernels.machine_code.library import checksum_file
from rocksteady.kernels.machine_code.sources import sources_hash

SOUND = BEGINS + sources_hash().encode()


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a wheel, empty."""
    folder = tmp_path / "wheel"
    folder.mkdir()
    monkeypatch.setattr(module, "libraries_folder", lambda: folder)
    return folder


def put(folder: Path, content: bytes = SOUND) -> Path:
    """Write a module with its checksum."""
    path = folder / NAME
    path.write_bytes(content)
    checksum_file(path).write_text(f"{hashlib.sha256(content).hexdigest()} tools\n", "ascii")
    return path


def test_the_module_of_the_package_is_taken(installed: Path) -> None:
    own = put(installed)
    assert page_module() == own


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (BEGINS + b"0123456789abcdef", "was made from other sources"),
        (b"<script>" + sources_hash().encode(), "is no WebAssembly module"),
        (b"", "is no WebAssembly module"),
    ],
)
def test_what_is_no_module_of_these_sources_is_refused_and_named(
    content: bytes, reason: str, installed: Path
) -> None:
    found = put(installed, content)
    with pytest.raises(MissingKernelsError, match=rf"{found} {reason}.*`make library`") as error:
        page_module()
    assert "\n" not in str(error.value)


def test_a_damaged_module_is_refused(installed: Path) -> None:
    put(installed).write_bytes(SOUND + b"\0")
    with pytest.raises(MissingKernelsError, match=r"is damaged.*`make library`"):
        page_module()


@pytest.mark.usefixtures("installed")
def test_without_a_module_the_error_says_what_to_do() -> None:
    with pytest.raises(MissingKernelsError, match=r"it is not there.*`make library`"):
        page_module()
