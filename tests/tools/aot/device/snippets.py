"""Snippets of PTX: what tests of translated PTX load, and call."""

from collections.abc import Callable, Iterable

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady.kernels.machine_code.library import targets
from tools.aot.device.ptx_to_c import Program, loaded
from tools.aot.link import compilers
from tools.aot.targets import TARGETS

HEAD = ".version 7.0\n.target sm_80\n.address_size 64\n"
REGISTERS = """
.reg .pred %p<9>;
.reg .b16 %rs<9>;
.reg .b32 %r<9>;
.reg .b64 %rd<40>;
"""
Words = NDArray[np.uint64]
Load = Callable[..., dict[str, Program]]


def loads_in(folders: pytest.TempPathFactory) -> Load:
    """Return what loads a text of PTX, its head left out; skip where nothing compiles it."""
    if not targets() or not compilers(TARGETS[targets()[0]]):
        pytest.skip("no C compiler is in reach: gcc, clang or the package ziglang")

    def load(ptx: str, **how: bool | int) -> dict[str, Program]:
        folder = folders.mktemp("ptx")
        file = folder / "text.ptx"
        file.write_text(HEAD + ptx, "ascii")
        return loaded([file], folder, **how)  # type: ignore[arg-type]

    return load


def entry(name: str, lines: str) -> str:
    """Return an entry whose cells begin at %rd1."""
    first = "ld.param.u64 %rd0, [cells];\ncvta.to.global.u64 %rd1, %rd0;\n"
    return f".visible .entry {name}(\n.param .u64 cells\n)\n{{{REGISTERS}{first}{lines}\nret;\n}}\n"


def run(program: Program, cells: Iterable[int | NDArray[np.generic]], results: int = 0) -> Words:
    """Call a program with numbers and arrays; return the cells that follow."""
    given = [each if isinstance(each, int) else each.ctypes.data for each in cells]
    room = np.array([each % 2**64 for each in given] + [0] * results, dtype=np.uint64)
    assert program.entry(room.ctypes.data) == 0
    return room[len(given) :]
