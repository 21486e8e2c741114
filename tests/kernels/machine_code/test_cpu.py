"""Which level of instructions a processor is taken to have."""

import ctypes
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from rocksteady.kernels.machine_code import _cpu
from rocksteady.kernels.machine_code._cpu import level_of, x86_64_level
from tests.every import every

V2 = "fpu sse sse2 ssse3 sse4_1 sse4_2 popcnt cx16 lahf_lm"
V3 = f"{V2} avx avx2 bmi1 bmi2 f16c fma abm movbe"
V4 = f"{V3} avx512f avx512bw avx512cd avx512dq avx512vl"


def described(*flags: str) -> str:
    """Return a text like /proc/cpuinfo for processors with these flags."""
    lines = (f"processor\t: {i}\nflags\t\t: {found}\nbugs\t:\n" for i, found in enumerate(flags))
    return "\n".join(lines)


@every(("flags", "level"), [(V2, 2), (V3, 3), (V4, 4)])
def test_a_level_needs_all_of_its_flags(flags: str, level: int) -> None:
    assert level_of(described(flags)) == level
    for flag in set(flags.split()) - set(V2.split()):
        assert level_of(described(flags.replace(f" {flag}", "", 1))) < level


def test_the_least_of_several_processors_counts() -> None:
    assert level_of(described(V4, V3, V4)) == 3


@every("text", ["", "Features : fp asimd", "flags"])
def test_a_text_that_tells_nothing_is_the_lowest_level(text: str) -> None:
    assert level_of(text) == 2


def test_this_processor_has_a_level() -> None:
    assert x86_64_level() in {2, 3, 4}


@pytest.mark.skipif(sys.platform != "linux", reason="compares with /proc/cpuinfo")
def test_numpy_tells_what_windows_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    described = Path("/proc/cpuinfo").read_text("ascii", "replace")
    windows = SimpleNamespace(
        kernel32=SimpleNamespace(IsProcessorFeaturePresent=lambda _: level_of(described) > 2)
    )
    monkeypatch.setattr(ctypes, "windll", windows, raising=False)
    monkeypatch.setattr(sys, "platform", "win32")
    assert x86_64_level() == level_of(described)
    monkeypatch.setitem(sys.modules, _cpu._NUMPY, None)  # of another release
    assert x86_64_level() == min(level_of(described), 3)
