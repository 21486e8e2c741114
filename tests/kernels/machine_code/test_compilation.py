"""How kernels are compiled, and where their machine code is kept."""

import atexit
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from enum import IntEnum
from importlib import metadata
from pathlib import Path
from types import SimpleNamespace

import numba
import numba.core.config
import pytest

from rocksteady.kernels.machine_code import compilation, sources
from rocksteady.kernels.machine_code.compilation import cache_folder, compiled
from rocksteady.kernels.march.march import march
from tests.strategies import PLAIN

SOURCES = Path(compilation.__file__).parents[1]


@pytest.fixture(autouse=True)
def _forget_the_folder() -> Iterator[None]:
    _forget()
    yield
    _forget()


def _forget() -> None:
    for known in (cache_folder, sources.sources_hash, sources._stamps):
        known.cache_clear()


def key_of(folder: Path, monkeypatch: pytest.MonkeyPatch, cache: Path) -> str:
    """Return the version that sources in `folder` would have."""
    monkeypatch.setattr(sources, "_root", lambda: folder)
    monkeypatch.setattr(
        "rocksteady.kernels.machine_code._folders.platformdirs.user_cache_dir",
        lambda _name: str(cache),
    )
    _forget()
    return cache_folder().parent.name


def test_the_cache_folder_changes_with_any_of_the_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy = tmp_path / "kernels"
    shutil.copytree(SOURCES, copy, ignore=shutil.ignore_patterns("__pycache__"))
    first = key_of(copy, monkeypatch, tmp_path / "cache")
    assert key_of(copy, monkeypatch, tmp_path / "cache") == first
    keys = {first}
    for name in ("linear/flight.py", "nonlinear/flight.py"):
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
        "rocksteady.kernels.machine_code._folders.platformdirs.user_cache_dir",
        lambda _name: str(blocked),
    )
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.warns(UserWarning, match="home.* cannot be written: File exists; mend that"):
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
    options = march.dispatcher.targetoptions  # type: ignore[attr-defined]
    assert options["nogil"] is True
    assert options["error_model"] == "numpy"
    assert not options.get("fastmath")


# -------------------------------------------------------------------------- whose code is the same

SHARED = """
import sys
from pathlib import Path
from numba.core import event
import numpy as np
from rocksteady.kernels.machine_code import _folders, compilation
_folders.platformdirs.user_cache_dir = lambda _: sys.argv[1]
from rocksteady.kernels.core import clock
first = compilation.must_compile("clock.segment_start")
for edited in sys.argv[2:]:
    with Path(clock.__file__).with_name(edited).open("a") as source:
        source.write("# edited")
with event.install_recorder("numba:compile") as recorder:
    clock.segment_start(np.ones((1, 9)), 0)
count = sum(item.is_start for _, item in recorder.buffer)
print(clock.__file__, first, count, compilation.must_compile("clock.segment_start"))
"""


def copied(folder: Path) -> Path:
    """Copy as much of the package as kernels need, with new time stamps; return where to."""
    (folder / "rocksteady").mkdir(parents=True)
    for name in ("__init__.py", "__init__.pyi", "errors.py", "outcomes.py"):
        shutil.copyfile(SOURCES.parent / name, folder / "rocksteady" / name)
    for part in ("kernels", "results"):
        shutil.copytree(
            SOURCES.parent / part,
            folder / "rocksteady" / part,
            ignore=shutil.ignore_patterns("__pycache__"),
            copy_function=shutil.copyfile,
        )
    return folder


def ran(package: Path, cache: Path, *edited: str) -> tuple[bool, int, bool]:
    """Call a kernel of a copy of the package, after edits of its sources.

    Returns
    -------
    tuple
        Whether it must be compiled, how many functions are compiled, and whether it must be again.
    """
    done = subprocess.run(
        [sys.executable, "-c", SHARED, str(cache), *edited],
        env={**os.environ, "PYTHONPATH": str(package), "ROCKSTEADY_KERNELS": "jit"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    file, first, count, last = done.stdout.rsplit(maxsplit=3)
    assert Path(file).is_relative_to(package)
    return first == "True", int(count), last == "True"


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_copies_of_the_package_share_machine_code_where_their_kernels_are_the_same(
    tmp_path: Path,
) -> None:
    cache = tmp_path / "cache"
    one, other = copied(tmp_path / "one"), copied(tmp_path / "somewhere" / "other")
    first, count, last = ran(one, cache)
    assert (first, last) == (True, False)
    assert count > 0
    assert ran(other, cache) == (False, 0, False)
    # A callee in another file, which the called file does not name.
    source = other / "rocksteady" / "kernels" / "core" / "forcing.py"
    source.write_text(source.read_text(encoding="utf-8") + "# changed\n", encoding="utf-8")
    assert ran(other, cache) == (True, count, False)
    assert ran(one, cache) == (False, 0, False)


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_what_is_compiled_after_an_edit_is_not_kept(tmp_path: Path) -> None:
    # It may hold what was edited, in the folder of what was there before.
    cache, package = tmp_path / "cache", copied(tmp_path / "package")
    first, count, last = ran(package, cache, "forcing.py")
    assert (first, last) == (True, True)
    assert count > 0
    assert not list(cache.rglob("*.nb?"))


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
@pytest.mark.parametrize("tool", ["numba", "llvmlite", "numpy"])
def test_every_version_of_a_tool_has_machine_code_of_its_own(
    tool: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = preferred(tmp_path, monkeypatch)
    monkeypatch.setattr(
        compilation, "version", lambda name: "99.1" if name == tool else metadata.version(name)
    )
    other = cache_folder()
    assert other != folder
    assert other.parent == folder.parent  # of the same sources


def test_the_cache_folder_changes_with_the_status_codes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = preferred(tmp_path, monkeypatch)
    monkeypatch.setattr(sources, "Status", IntEnum("Status", ["ROCKING", "AT_REST"]))
    _forget()
    assert cache_folder().parent != folder.parent


def test_other_versions_are_removed_when_the_folder_is_chosen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = preferred(tmp_path, monkeypatch)
    for number in range(3):
        other = folder.parent.with_name(f"{number:016x}")
        other.mkdir(mode=0o700)
        os.utime(other, (0.0, number))
    cache_folder()
    assert len(list(folder.parents[1].iterdir())) == 2


# ------------------------------------------------------------------------- who can change the cache


def preferred(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Have machine code kept below a folder; return the one of this version."""
    home = tmp_path / "home"
    home.mkdir(mode=0o700)
    (tmp_path / "tmp").mkdir()
    monkeypatch.setattr(
        "rocksteady.kernels.machine_code._folders.platformdirs.user_cache_dir",
        lambda name: str(home / ".cache" / name),
    )
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "tmp"))
    monkeypatch.setattr(atexit, "register", lambda _: None)
    folder = cache_folder()
    assert folder.is_relative_to(home)
    cache_folder.cache_clear()
    return folder


def assert_private(folder: Path, tmp_path: Path) -> None:
    assert folder.parent == tmp_path / "tmp"
    assert folder.stat().st_mode & 0o777 == 0o700
    assert folder.stat().st_uid == os.getuid()
    assert not list(folder.iterdir())


@pytest.mark.parametrize("below", range(5))
@pytest.mark.parametrize("mode", [0o777, 0o1777])
def test_a_cache_that_others_can_write_is_not_used(
    below: int, mode: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = preferred(tmp_path, monkeypatch)
    weak = [folder, *folder.parents][below]
    weak.chmod(mode)
    if below and mode == 0o1777:  # there nobody may rename what is ours
        assert cache_folder() == folder
        return
    with pytest.warns(UserWarning, match="kept for this run only") as caught:
        assert_private(cache_folder(), tmp_path)
    assert len(caught) == 1
    assert str(weak) in str(caught[0].message)
    assert "\n" not in str(caught[0].message)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such groups")
@pytest.mark.parametrize(
    ("name", "members", "used"),
    [
        ("self", [], True),
        ("self", ["self"], True),
        ("self", ["other"], False),
        ("staff", [], False),
    ],
)
def test_a_group_may_write_if_the_user_is_alone_in_it(
    name: str,
    members: list[str],
    used: bool,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # As many systems set up each user, whose folders are then open to that group.
    folder = preferred(tmp_path, monkeypatch)
    group = folder.stat().st_gid
    user = SimpleNamespace(pw_name="self", pw_gid=group)
    monkeypatch.setattr("pwd.getpwuid", lambda _: user)
    found = SimpleNamespace(gr_name=name, gr_gid=group, gr_mem=members)
    monkeypatch.setattr("grp.getgrgid", lambda _: found)
    for parent in (folder.parent, folder.parent.parent, folder.parent.parent.parent):
        parent.chmod(0o775)
    if used:
        assert cache_folder() == folder
    else:
        with pytest.warns(UserWarning, match="can be written by other users"):
            assert_private(cache_folder(), tmp_path)


@pytest.mark.skipif(os.name == "nt" or os.getuid() != 0, reason="only root gives files away")
@pytest.mark.parametrize("below", range(5))
@pytest.mark.parametrize("link", [True, False])
def test_a_cache_of_another_user_is_not_used(
    below: int, link: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = preferred(tmp_path, monkeypatch)
    theirs = [folder, *folder.parents][below]
    if link:
        theirs.rename(tmp_path / "elsewhere")
        theirs.symlink_to(tmp_path / "elsewhere")
    os.chown(theirs, 12345, 12345, follow_symlinks=False)
    with pytest.warns(UserWarning, match="belongs to another user"):
        assert_private(cache_folder(), tmp_path)


def test_a_link_through_a_folder_that_others_can_write_is_not_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = preferred(tmp_path, monkeypatch)
    (tmp_path / "open").mkdir()
    (tmp_path / "open").chmod(0o777)
    (tmp_path / "open" / "link").symlink_to(folder.parents[1])
    folder.parents[1].rename(tmp_path / "kernels")
    (tmp_path / "open" / "link").unlink()
    (tmp_path / "open" / "link").symlink_to(tmp_path / "kernels")
    folder.parents[1].symlink_to(tmp_path / "open" / "link")
    with pytest.warns(UserWarning, match=r"open can be written by other users"):
        assert_private(cache_folder(), tmp_path)


def test_a_link_of_one_s_own_is_followed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = preferred(tmp_path, monkeypatch)
    folder.parents[1].rename(tmp_path / "kernels")
    folder.parents[1].symlink_to("../../../kernels")
    assert cache_folder() == folder


def test_a_planted_folder_of_the_name_it_once_had_is_not_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = preferred(tmp_path, monkeypatch)
    planted = tmp_path / "tmp" / f"rocksteady-{os.getuid()}-{folder.parent.name}"
    planted.mkdir()
    (planted / "march.march-1.py311.nbi").write_bytes(b"code")
    folder.chmod(0o777)
    with pytest.warns(UserWarning, match="kept for this run only"):
        assert_private(cache_folder(), tmp_path)
    assert cache_folder() != planted


# ---------------------------------------------------------------------------- garbled machine code

PROGRAM = """
import sys
from numba.core import event
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from rocksteady.kernels.machine_code import _folders
_folders.platformdirs.user_cache_dir = lambda _: sys.argv[2]
import kernel_of_a_test
with event.install_recorder("numba:compile") as recorder:
    assert kernel_of_a_test.twice(2.0) == 4.0
print(len(recorder.buffer))
"""

GARBLED: dict[str, Callable[[bytes], bytes]] = {
    "garbage": lambda _: b"garbage" * 20,
    "empty": lambda _: b"",
    "one bit": lambda content: (
        content[: len(content) // 2]
        + bytes([content[len(content) // 2] ^ 1])
        + content[len(content) // 2 + 1 :]
    ),
    "numba's own": lambda content: content[32:],
}


def compilations(folder: Path, cache: Path) -> int:
    """Return how many functions a process compiles to call the kernel in a folder."""
    command = [sys.executable, "-c", PROGRAM, str(folder), str(cache)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return int(done.stdout)


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a kernel, and in `cache` its machine code, which a process finds."""
    folder = tmp_path_factory.mktemp("kept")
    (folder / "kernel_of_a_test.py").write_text(
        "from rocksteady.kernels.machine_code.compilation import compiled\n"
        "@compiled\n"
        "def twice(number):\n"
        "    return 2.0 * number\n",
        encoding="utf-8",
    )
    assert compilations(folder, folder / "cache") > 0
    assert compilations(folder, folder / "cache") == 0
    return folder


@pytest.mark.slow
@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
@pytest.mark.parametrize(
    ("damage", "ending"), list(zip(GARBLED, ["nbi", "nbc", "nbc", "nbi"], strict=True))
)
def test_garbled_machine_code_is_compiled_again(
    damage: str, ending: str, kept: Path, tmp_path: Path
) -> None:
    cache = shutil.copytree(kept / "cache", tmp_path / "cache")
    (file,) = cache.rglob(f"*.{ending}")
    file.write_bytes(GARBLED[damage](file.read_bytes()))
    assert compilations(kept, cache) > 0
    assert compilations(kept, cache) == 0


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_a_folder_in_the_place_of_machine_code_ends_no_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    preferred(tmp_path, monkeypatch)

    @compiled
    def thrice(number: float) -> float:
        return 3.0 * number

    cache = thrice.dispatcher._cache  # type: ignore[attr-defined]
    Path(cache._cache_file._index_path).mkdir(parents=True)
    assert thrice(2.0) == 6.0
