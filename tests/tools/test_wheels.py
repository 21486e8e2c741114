"""The wheels: what is in them, and that their libraries keep what their tags promise."""

import base64
import csv
import hashlib
import io
import json
import shutil
import struct
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path, PurePath

import pytest
from hatchling.builders.wheel import WheelBuilder
from packaging.metadata import Metadata
from packaging.tags import sys_tags

from rocksteady.explorer import _program as program
from rocksteady.explorer._module import BEGINS, NAME
from rocksteady.gpu._programs import BROUGHT
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code import sources
from rocksteady.kernels.machine_code.compilation import PURE as PURE_FILE
from rocksteady.kernels.machine_code.library import checksum_file
from rocksteady.kernels.machine_code.sources import sources_hash
from tests.every import every
from tests.strategies import rest_slow
from tools.wheels import building
from tools.wheels.building import INSIDE, ROOT, build, build_programs, programs
from tools.wheels.first_start import sizes, wheel_of_this_machine
from tools.wheels.platforms import PLATFORMS, PURE, Platform

BESIDE = (NAME, f"{NAME}.sha256", program.NAME, sources.NAME)
"""What every wheel has of the explorer and of the hash of kernels, beside the libraries."""
PARTS = ("*.mjs", "*.mts")
"""Modules of the page, which stand in a wheel bundled."""
SQUARE = "double g(double x) { return x * x; }"
KERNELS = SQUARE + "".join(f"int rs_{name}(void) {{ return 0; }}" for name in ENTRIES)
TRIPLES = {
    "manylinux_2_28_x86_64": "x86_64-linux-gnu",
    "manylinux_2_28_aarch64": "aarch64-linux-gnu",
    "macosx_11_0_arm64": "aarch64-macos.11.0",
    "win_amd64": "x86_64-windows-gnu",
}
"""What zig calls a platform."""


def library(
    file: Path, triple: str, *options: str | Path, code: str = SQUARE, entry: str = "g"
) -> Path:
    """Compile a library that needs nothing, unless it is asked to."""
    source = file.with_suffix(".c")
    source.write_text(code, encoding="utf-8")
    command = [sys.executable, "-m", "ziglang", "cc", "-shared", "-nostdlib", "-target", triple]
    start = [f"-Wl,--entry={entry}"] if "windows" in triple else []
    subprocess.run([*command, *start, "-o", file, source, *options], check=True)
    return file


@pytest.fixture(scope="module")
def libraries(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Every library of every wheel, small ones, and what is made for the explorer."""
    folder = tmp_path_factory.mktemp("libraries")
    (folder / NAME).write_bytes(BEGINS + sources_hash().encode())
    made = {"parts": program.parts_hash(), **dict.fromkeys(program.SCRIPTS, "start();")}
    (folder / program.NAME).write_text(json.dumps(made), "utf-8")
    for file in programs(folder):
        file.write_text(f"// rocksteady kernels {sources_hash()}\n.version 7.0\n", "ascii")
    for platform in PLATFORMS:
        for file in platform.libraries(folder):
            library(file, TRIPLES[platform.tag], code=KERNELS)
            sum_up(file)
    sum_up(folder / NAME)
    (folder / sources.NAME).write_text("0 1\n", "ascii")
    return folder


def sum_up(file: Path) -> None:
    """Write the checksum of a compiled file beside it."""
    checksum_file(file).write_text(hashlib.sha256(file.read_bytes()).hexdigest(), "ascii")


def files_of(platform: Platform, folder: Path) -> list[Path]:
    """Return all files beside the package that a platform's wheel holds."""
    compiled = platform.libraries(folder)
    return [*compiled, *map(checksum_file, compiled), *(folder / name for name in BESIDE)]


class Wheels(dict[Platform, Path]):
    """The wheel of each platform, built for the first test that looks at it."""

    def __init__(self, libraries: Path, out: Path) -> None:
        super().__init__()
        self._libraries, self._out = libraries, out

    def __missing__(self, platform: Platform) -> Path:
        self[platform] = build(platform, self._libraries, self._out)
        return self[platform]


@pytest.fixture(scope="module")
def wheels(libraries: Path, tmp_path_factory: pytest.TempPathFactory) -> Wheels:
    return Wheels(libraries, tmp_path_factory.mktemp("wheels"))


def content(wheel: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def described(wheel: Path, name: str) -> bytes:
    """A file of the folder that describes a wheel."""
    (found,) = [what for file, what in content(wheel).items() if file.endswith(f"info/{name}")]
    return found


# ---------------------------------------------------------------------------- what is in a wheel


@pytest.mark.slow
@every("platform", PLATFORMS)
def test_a_wheel_holds_the_module_and_the_libraries_of_its_platform_beside_the_package(
    platform: Platform, libraries: Path, wheels: Wheels
) -> None:
    found, plain = content(wheels[platform]), content(wheels[PURE])
    inside = {name: found.pop(name) for name in list(found) if name.startswith(INSIDE)}
    for name in BESIDE:
        del plain[f"{INSIDE}/{name}"]
    assert inside == {
        f"{INSIDE}/{file.name}": file.read_bytes() for file in files_of(platform, libraries)
    }
    assert set(found) == set(plain)
    differ = {name.rpartition("/")[2] for name in found if found[name] != plain[name]}
    assert differ == (set() if platform == PURE else {"RECORD", "WHEEL"})


@pytest.mark.slow
def test_a_wheel_holds_the_sources_and_nothing_else(wheels: Wheels) -> None:
    found = {
        name: what
        for name, what in content(wheels[PURE]).items()
        if not name.startswith(f"{INSIDE}/")
    }
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "rocksteady"],
        cwd=ROOT / "src",
        capture_output=True,
        text=True,
        check=True,
    ).stdout.splitlines()
    tracked = {name for name in listed if (ROOT / "src" / name).exists()}
    kept = {name for name in tracked if not any(map(PurePath(name).match, PARTS))}
    assert {name for name in found if not name.startswith("rocksteady-")} == kept
    assert len(kept) > 100


@pytest.mark.parametrize("platform", rest_slow([PLATFORMS[0], PURE, *PLATFORMS[1:-1]], 2))
def test_name_and_record_of_a_wheel_are_those_of_its_content(
    platform: Platform, wheels: Wheels
) -> None:
    wheel = wheels[platform]
    assert wheel.name.endswith(f"-py3-none-{platform.tag}.whl")
    said = described(wheel, "WHEEL").decode().splitlines()
    assert f"Tag: py3-none-{platform.tag}" in said
    assert f"Root-Is-Purelib: {str(platform == PURE).lower()}" in said
    found = content(wheel)
    rows = list(csv.reader(io.StringIO(described(wheel, "RECORD").decode())))
    assert [name for name, _, _ in rows] == list(found)
    for name, checksum, size in rows[:-1]:
        digest = base64.urlsafe_b64encode(hashlib.sha256(found[name]).digest()).rstrip(b"=")
        assert (checksum, size) == (f"sha256={digest.decode()}", str(len(found[name])))


def test_the_metadata_are_valid_and_ask_for_no_compiler(wheels: Wheels) -> None:
    found = Metadata.from_email(described(wheels[PURE], "METADATA"), validate=True)
    needed = found.requires_dist or []
    assert f'rocksteady-gpu=={found.version}; sys_platform != "darwin" and extra == "gpu"' in {
        str(each) for each in needed
    }
    assert {str(each.name) for each in needed if each.marker is None} >= {"numpy", "scipy"}
    asking = {str(each.marker) for each in needed if each.name in {"numba", "llvmlite"}}
    assert 'extra == "build"' in asking
    assert all(marker.startswith("extra == ") for marker in asking)


def test_the_wheel_for_gpus_holds_the_programs_and_asks_for_the_package(
    libraries: Path, tmp_path: Path
) -> None:
    wheel = build_programs(libraries, tmp_path)
    assert wheel.name.startswith(f"{BROUGHT}-")
    inside = {name: what for name, what in content(wheel).items() if "info/" not in name}
    assert inside == {f"{BROUGHT}/{file.name}": file.read_bytes() for file in programs(libraries)}
    found = Metadata.from_email(described(wheel, "METADATA"), validate=True)
    assert list(map(str, found.requires_dist or [])) == [f"rocksteady[gpu]=={found.version}"]


def test_what_pip_builds_of_the_sources_is_the_wheel_without_what_is_compiled(
    wheels: Wheels, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROCKSTEADY_BUILD", "pure")
    (built,) = WheelBuilder(str(ROOT)).build(directory=str(tmp_path), versions=["standard"])
    assert Path(built).name == wheels[PURE].name
    ours, theirs = content(Path(built)), content(wheels[PURE])
    assert theirs.keys() - ours.keys() == {f"{INSIDE}/{name}" for name in BESIDE}
    assert ours.keys() - theirs.keys() == {f"{INSIDE}/{PURE_FILE}"}
    differ = {name for name in ours.keys() & theirs.keys() if ours[name] != theirs[name]}
    assert {name.rpartition("/")[2] for name in differ} == {"METADATA", "RECORD"}


def test_the_same_libraries_give_the_same_bytes(
    libraries: Path, wheels: Wheels, tmp_path: Path
) -> None:
    platform = PLATFORMS[0]
    for file in files_of(platform, libraries):
        shutil.copy(file, tmp_path)  # which gives it another time stamp
    again = build(platform, tmp_path, tmp_path)
    assert again.read_bytes() == wheels[platform].read_bytes()


def test_no_wheel_is_built_without_a_library_of_its_platform(
    libraries: Path, tmp_path: Path
) -> None:
    platform = PLATFORMS[0]
    first, *others = platform.libraries(libraries)
    for file in others:
        shutil.copy(file, tmp_path)
    with pytest.raises(SystemExit, match=f"{first.name} does not fit .*: it is missing"):
        build(platform, tmp_path, tmp_path)
    assert list(tmp_path.glob("*.whl")) == []


@every(
    ("damage", "reason"),
    [
        (None, "it is not there"),
        (b"", "is no WebAssembly module"),
        (BEGINS + b"0123456789abcdef", "was made from other sources"),
    ],
)
def test_no_wheel_is_built_without_a_module_of_these_sources(
    damage: bytes | None, reason: str, tmp_path: Path
) -> None:
    if damage is not None:
        (tmp_path / NAME).write_bytes(damage)
        sum_up(tmp_path / NAME)
    with pytest.raises(SystemExit, match=reason) as refusal:
        build(PURE, tmp_path, tmp_path)
    assert f"{program.NAME} is missing" in str(refusal.value)
    assert list(tmp_path.glob("*.whl")) == []


def test_no_wheel_is_built_without_the_programs_of_these_sources(
    libraries: Path, tmp_path: Path
) -> None:
    first, second, *others = programs(tmp_path)
    for file in programs(libraries):
        shutil.copy(file, tmp_path)
    first.write_text("// rocksteady kernels 0123456789abcdef\n", "ascii")
    second.unlink()
    with pytest.raises(SystemExit) as refusal:
        build_programs(tmp_path, tmp_path)
    said = [f"{file} is missing or was made from other sources" for file in (first, second)]
    assert str(refusal.value).splitlines() == said
    assert len(others) >= 5
    assert list(tmp_path.glob("*.whl")) == []


def test_no_wheel_is_built_with_a_script_of_other_parts(libraries: Path, tmp_path: Path) -> None:
    for name in (NAME, f"{NAME}.sha256"):
        shutil.copy(libraries / name, tmp_path)
    (tmp_path / program.NAME).write_text('{"parts": "other"}', "utf-8")
    with pytest.raises(SystemExit, match="was made from other parts"):
        build(PURE, tmp_path, tmp_path)


def test_no_wheel_is_built_of_a_library_that_does_not_fit(tmp_path: Path) -> None:
    platform = Platform("manylinux_2_28_aarch64", ("linux-aarch64",), ".so")
    (file,) = platform.libraries(tmp_path)
    library(file, "x86_64-linux-gnu")
    with pytest.raises(SystemExit, match="it is made for X86_64"):
        build(platform, tmp_path, tmp_path)


def test_a_wheel_that_is_too_large_is_refused(
    libraries: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(building, "LARGEST", 1000)
    with pytest.raises(SystemExit, match="and 1000 is the most"):
        build(PURE, libraries, tmp_path)


def test_pip_would_take_the_wheel_that_is_checked() -> None:
    names = [f"rocksteady-1.0-py3-none-{tag}.whl" for tag in ("any", "plan9_1_mips")]
    with pytest.raises(SystemExit, match="none of the wheels"):
        wheel_of_this_machine([Path(name) for name in names])
    tags = [tag.platform for tag in sys_tags() if tag.platform != "any"]
    older, newer = (Path(f"rocksteady-1.0-py3-none-{tag}.whl") for tag in (tags[-1], tags[0]))
    assert wheel_of_this_machine([older, Path(names[0]), newer, Path(names[1])]) == newer


def test_a_package_weighs_what_its_libraries_beside_it_do(tmp_path: Path) -> None:
    for name, size in (("numpy/a.py", 4_096), ("numpy.libs/b.so", 1_000_000), ("six.py", 1)):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(bytes(range(256)) * (size // 256 + 1))
    (first, larger), (second, smaller) = sizes(tmp_path)
    assert (first, second) == ("numpy", "six.py")
    assert 1.0 < larger < 1.1
    assert 0.0 < smaller < 0.1
    (tmp_path / "numpy" / "a.pyc").write_bytes(bytes(range(256)) * 4_000)
    assert sizes(tmp_path, bytecode=False) == [(first, larger), (second, smaller)]
    assert 2.0 < sizes(tmp_path)[0][1] < 2.2


# ------------------------------------------------------------------- what a library may need


def faults(file: Path, tag: str, kernels: Sequence[str] = ()) -> list[str]:
    (found,) = building.faults([file], tag, kernels)
    return found


@pytest.mark.slow
@every("tag", TRIPLES)
@every("made_for", TRIPLES)
def test_a_library_fits_its_own_platform_alone(tag: str, made_for: str, tmp_path: Path) -> None:
    file = library(tmp_path / "library", TRIPLES[made_for])
    assert (faults(file, tag) == []) == (tag == made_for)
    if tag == made_for:
        assert faults(file, tag, ["march"]) == ["it lacks the kernels march"]


def test_symbols_newer_than_the_tag_are_found(tmp_path: Path) -> None:
    """The C library here has one function, in a version that the test chooses."""
    versions = tmp_path / "versions"
    versions.write_text("GLIBC_2.29 { exp; };", encoding="utf-8")
    theirs = library(
        tmp_path / "libm.so.6",
        "x86_64-linux-gnu",
        f"-Wl,--version-script={versions}",
        "-Wl,-soname,libm.so.6",
        code="double exp(double x) { return x; }",
    )
    calls = "double exp(double); double g(double x) { return exp(x); }"
    ours = library(tmp_path / "ours.so", "x86_64-linux-gnu", theirs, code=calls)
    assert faults(ours, "manylinux_2_28_x86_64") == ["it needs GLIBC_2.29"]
    assert faults(ours, "manylinux_2_29_x86_64") == []


def test_libraries_that_not_every_system_has_are_found(tmp_path: Path) -> None:
    name = "-Wl,-soname,libopenblas.so.0"
    theirs = library(tmp_path / "libopenblas.so", "x86_64-linux-gnu", name)
    calls = "double g(double); double f(double x) { return g(x); }"
    ours = library(tmp_path / "ours.so", "x86_64-linux-gnu", theirs, code=calls)
    assert faults(ours, "manylinux_2_28_x86_64") == ["it needs the library libopenblas.so.0"]


def test_a_stack_that_can_be_executed_is_found(tmp_path: Path) -> None:
    file = library(tmp_path / "library.so", "x86_64-linux-gnu")
    data = bytearray(file.read_bytes())
    (start,) = struct.unpack_from("<Q", data, 32)
    size, count = struct.unpack_from("<HH", data, 54)
    gnu_stack, executable = 0x6474E551, 1
    changed = 0
    for header in range(start, start + size * count, size):
        kind, flags = struct.unpack_from("<II", data, header)
        if kind == gnu_stack:
            struct.pack_into("<I", data, header + 4, flags | executable)
            changed += 1
    assert changed == 1
    file.write_bytes(data)
    assert faults(file, "manylinux_2_28_x86_64") == ["it asks for a stack that can be executed"]


def test_a_macos_newer_than_the_tag_is_found(tmp_path: Path) -> None:
    file = library(tmp_path / "library.dylib", "aarch64-macos.13.0")
    assert faults(file, "macosx_11_0_arm64") == ["it needs macOS 13.0.0"]
    assert faults(file, "macosx_13_0_arm64") == []


@every("tag", TRIPLES)
def test_a_file_that_is_no_library_is_refused(tag: str, tmp_path: Path) -> None:
    file = tmp_path / "library"
    file.write_text(SQUARE, encoding="utf-8")
    assert faults(file, tag) == [f"it is no shared library of {tag.partition('_')[0]}"]


def test_an_unknown_kind_of_tag_is_refused(tmp_path: Path) -> None:
    file = library(tmp_path / "library.so", "x86_64-linux-gnu")
    assert faults(file, "musllinux_1_2_x86_64") == [
        "musllinux_1_2_x86_64 is no platform tag of a kind that is known"
    ]
