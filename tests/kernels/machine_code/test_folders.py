"""Which machine code of old versions is removed, and what is left alone."""

import os
import time
from pathlib import Path

import pytest

from rocksteady.kernels.machine_code._folders import IN_USE, KEPT, prune
from tests.every import every

NAMES = [f"{number:016x}" for number in range(9)]
CODE = ("march.march.march-102.py311.nbi", "march.march.march-102.py311.1.nbc")
LEFTOVER = "march.march.march-102.py311.1.nbc.tmp.0123456789abcdef"
"""Of a process that was killed as it wrote."""
LONG_AGO = 2.0 * IN_USE


def version(kernels: Path, name: str, seconds: float) -> Path:
    """Make the folder of a version that was last used so many seconds ago."""
    tools = kernels / name / "cpython-311-numba-0.68.1"
    for folder in (kernels / name, tools):
        folder.mkdir(mode=0o700, parents=True)
    for file in CODE:
        (tools / file).write_bytes(b"code")
    used(kernels / name, seconds)
    return kernels / name


def used(folder: Path, seconds: float) -> None:
    """Set when a version was last used."""
    then = time.time() - seconds
    os.utime(folder, (then, then))


def left(kernels: Path) -> list[str]:
    return sorted(path.name for path in kernels.iterdir())


def test_the_last_two_versions_used_are_kept(tmp_path: Path) -> None:
    assert KEPT == 2
    # Used in this order, which is not that of their names.
    for place, name in enumerate([NAMES[3], NAMES[1], NAMES[4], NAMES[2]]):
        version(tmp_path, name, 10.0 * LONG_AGO - place * IN_USE)
    prune(version(tmp_path, NAMES[0], LONG_AGO))
    assert left(tmp_path) == [NAMES[0], NAMES[2]]
    assert len(list(tmp_path.rglob("*.nb?"))) == 2 * len(CODE)


def test_a_version_counts_as_used_from_now_on(tmp_path: Path) -> None:
    folder = version(tmp_path, NAMES[0], LONG_AGO)
    before = time.time() - 1.0  # the kernel stamps files with a clock of coarser ticks
    prune(folder)
    assert before <= folder.stat().st_mtime <= time.time()


def test_versions_that_a_process_of_the_last_day_has_used_are_kept(tmp_path: Path) -> None:
    for name in NAMES[1:]:
        version(tmp_path, name, 0.9 * IN_USE)
    version(tmp_path, f"{10:016x}", 1.1 * IN_USE)
    version(tmp_path, f"{11:016x}", -LONG_AGO)  # by a clock that is ahead
    prune(version(tmp_path, NAMES[0], 0.0))
    assert left(tmp_path) == sorted([*NAMES, f"{11:016x}"])


def test_files_left_half_written_are_removed_with_their_version(tmp_path: Path) -> None:
    old = [version(tmp_path, name, LONG_AGO) for name in NAMES[1:3]]
    for folder in old:
        (folder / LEFTOVER).write_bytes(b"co")
        used(folder, LONG_AGO)
    prune(version(tmp_path, NAMES[0], 0.0))
    assert len(left(tmp_path)) == 2


@every("name", ["data", "0" * 15, "0" * 17, "0123456789ABCDEF", "0123456789abcdeg", "0" * 16 + "~"])
def test_a_folder_of_another_name_is_left_alone(name: str, tmp_path: Path) -> None:
    version(tmp_path, NAMES[1], 0.0)
    foreign = version(tmp_path, name, LONG_AGO)
    prune(version(tmp_path, NAMES[0], 0.0))
    assert len(list(foreign.rglob("*.nb?"))) == len(CODE)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such modes")
@pytest.mark.parametrize("mode", [0o755, 0o770, 0o701, 0o1777])
def test_a_folder_that_others_can_enter_is_left_alone(mode: int, tmp_path: Path) -> None:
    version(tmp_path, NAMES[1], 0.0)
    foreign = version(tmp_path, NAMES[2], LONG_AGO)
    foreign.chmod(mode)
    prune(version(tmp_path, NAMES[0], 0.0))
    assert len(list(foreign.rglob("*.nb?"))) == len(CODE)


@pytest.mark.skipif(os.name == "nt" or os.getuid() != 0, reason="only root gives files away")
def test_a_folder_of_another_user_is_left_alone(tmp_path: Path) -> None:
    version(tmp_path, NAMES[1], 0.0)
    foreign = version(tmp_path, NAMES[2], LONG_AGO)
    os.chown(foreign, 12345, 12345)
    prune(version(tmp_path, NAMES[0], 0.0))
    assert len(list(foreign.rglob("*.nb?"))) == len(CODE)


def test_a_link_in_the_place_of_a_version_is_left_alone(tmp_path: Path) -> None:
    kernels, elsewhere = tmp_path / "kernels", tmp_path / "elsewhere"
    version(kernels, NAMES[1], 0.0)
    target = version(elsewhere, NAMES[2], LONG_AGO)
    link = kernels / NAMES[2]
    link.symlink_to(target)
    os.utime(link, (0.0, 0.0), follow_symlinks=False)
    prune(version(kernels, NAMES[0], 0.0))
    assert link.is_symlink()
    assert len(list(target.rglob("*.nb?"))) == len(CODE)


def test_links_in_an_old_version_are_not_gone_through(tmp_path: Path) -> None:
    kernels, elsewhere = tmp_path / "kernels", tmp_path / "elsewhere"
    version(kernels, NAMES[1], 0.0)
    target = version(elsewhere, NAMES[2], LONG_AGO)
    old = version(kernels, NAMES[3], LONG_AGO)
    (old / "folder").symlink_to(target)
    (old / CODE[0]).symlink_to(target / "cpython-311-numba-0.68.1" / CODE[0])
    used(old, LONG_AGO)
    prune(version(kernels, NAMES[0], 0.0))
    assert len(list(target.rglob("*.nb?"))) == len(CODE)
    assert left(old) == ["folder"]  # which is not this package's to remove


def test_what_is_no_machine_code_is_left_alone(tmp_path: Path) -> None:
    version(tmp_path, NAMES[1], 0.0)
    old = version(tmp_path, NAMES[2], LONG_AGO)
    kept = [old / "thesis.tex", old / "cpython-311-numba-0.68.1" / "march.py"]
    for file in kept:
        file.write_text("the only copy")
    used(old, LONG_AGO)
    (tmp_path / "thesis.tex").write_text("the only copy")
    prune(version(tmp_path, NAMES[0], 0.0))
    assert all(file.exists() for file in [*kept, tmp_path / "thesis.tex"])
    assert not list(old.rglob("*.nb?"))


def test_what_cannot_be_removed_ends_no_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError

    for name in NAMES[1:4]:
        version(tmp_path, name, LONG_AGO)
    monkeypatch.setattr(Path, "unlink", refuse)
    monkeypatch.setattr(os, "utime", refuse)
    prune(tmp_path / NAMES[1])
    prune(tmp_path / "gone")
