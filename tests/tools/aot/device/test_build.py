"""Which files of PTX are built again."""

from pathlib import Path

import pytest

from rocksteady.kernels.machine_code.library import checksum_file
from rocksteady.kernels.machine_code.sources import sources_hash
from tools.aot.build import publish
from tools.aot.device.build import device_tools, file_of, is_current

TEXT = f"// rocksteady kernels {sources_hash()}\n.visible .entry rs_queued\n".encode("ascii")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    file = file_of(tmp_path, "sm_90", "queued")
    publish(file, TEXT, device_tools())
    return file


def test_what_was_written_is_current(file: Path) -> None:
    assert is_current(file)


def test_half_a_file_is_not(file: Path) -> None:
    file.write_bytes(TEXT[:-5])
    assert not is_current(file)


def test_a_file_of_other_tools_is_not(file: Path) -> None:
    publish(file, TEXT, "other")
    assert not is_current(file)


def test_a_file_of_other_sources_is_not(file: Path) -> None:
    publish(file, TEXT.replace(sources_hash().encode("ascii"), b"0" * 16), device_tools())
    assert not is_current(file)


@pytest.mark.parametrize("missing", [checksum_file, Path])
def test_a_file_that_is_missing_is_not(missing: object, file: Path) -> None:
    assert callable(missing)
    missing(file).unlink()
    assert not is_current(file)
