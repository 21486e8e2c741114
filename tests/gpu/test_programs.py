"""Which program a GPU gets: the newest that it runs, whole, and of these sources."""

from pathlib import Path

import pytest

from rocksteady.errors import InputError
from rocksteady.gpu import _programs as module
from rocksteady.gpu._programs import file_name, program, refuse_capability
from rocksteady.kernels.machine_code.sources import sources_hash
from tests.gpu.fake_gpu import write_program

NAME = "queued_lane_fates"


@pytest.fixture
def folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    installed, built = tmp_path / "installed", tmp_path / "built"
    for folder in (installed, built):
        folder.mkdir(mode=0o700)
    monkeypatch.setattr(module, "brought_folders", lambda: [installed])
    monkeypatch.setattr(module, "libraries_folder", lambda: built)
    return installed, built


def refused() -> None:
    with pytest.raises(InputError) as raised:
        program(NAME, (9, 0))
    assert str(raised.value) == (
        "executor = 'gpu' is not valid: the GPU program of queued_lane_fates is not in this "
        "installation, or it is of other sources; install 'rocksteady[gpu]', or run 'make gpu' in "
        "a checkout; leave the executor out for threads"
    )


@pytest.mark.parametrize(
    ("capability", "architecture"),
    [((8, 0), (8, 0)), ((8, 9), (8, 0)), ((9, 0), (9, 0)), ((10, 0), (9, 0)), ((12, 1), (12, 0))],
)
def test_the_newest_architecture_that_a_gpu_runs(
    capability: tuple[int, int], architecture: tuple[int, int], folders: tuple[Path, Path]
) -> None:
    for each in ((7, 0), (8, 0), (9, 0), (12, 0)):
        write_program(folders[0], each, NAME, sources_hash())
    write_program(folders[0], (10, 0), "another", sources_hash())
    assert program(NAME, capability) == folders[0] / file_name(architecture, NAME)


def test_a_program_of_other_sources_is_none(folders: tuple[Path, Path]) -> None:
    refused()
    write_program(folders[0], (9, 0), NAME, "0123456789abcdef")
    refused()
    older = write_program(folders[0], (8, 0), NAME, sources_hash())
    assert program(NAME, (9, 0)) == older


def test_an_installed_program_goes_before_one_built_here(folders: tuple[Path, Path]) -> None:
    built = write_program(folders[1], (9, 0), NAME, sources_hash())
    assert program(NAME, (9, 0)) == built
    installed = write_program(folders[0], (8, 0), NAME, sources_hash())
    assert program(NAME, (9, 0)) == installed


def test_a_wheel_of_their_own_brings_programs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert module.brought_folders() == []
    (tmp_path / module.BROUGHT).mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    assert module.brought_folders() == [tmp_path / module.BROUGHT]


def test_a_file_that_cannot_be_read_is_no_program(tmp_path: Path) -> None:
    assert module.sources_of(tmp_path / "nothing.ptx") == ""
    (tmp_path / "bytes.ptx").write_bytes(bytes(range(128, 256)))
    assert module.sources_of(tmp_path / "bytes.ptx") != sources_hash()


def test_a_gpu_that_is_too_old_is_named() -> None:
    refuse_capability("NVIDIA A100", (8, 0))
    with pytest.raises(InputError) as raised:
        refuse_capability("Tesla T4", (7, 5))
    assert str(raised.value) == (
        "executor = 'gpu' is not valid: Tesla T4 has compute capability 7.5, and the kernels are "
        "compiled for 8.0 or higher, with double precision in hardware; leave the executor out for "
        "threads"
    )
