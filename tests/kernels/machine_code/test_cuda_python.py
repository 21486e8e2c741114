"""The real cuda-python, over a driver in C that computes on the processor."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
SCRIPT = """
import sys
from pathlib import Path
import numpy as np
from rocksteady.errors import UnfinishedError
from rocksteady.kernels.machine_code import programs
from rocksteady.kernels.machine_code.gpu import gpu
from rocksteady.kernels.machine_code.sources import sources_hash
from tests.kernels.machine_code.in_memory.gpu import write_program
from tests.kernels.machine_code.test_gpu import FORM, Squares

folder = Path(sys.argv[1])
write_program(folder, (8, 0), "queued_squares", sources_hash())
programs.brought_folders = lambda: [folder]
print(gpu())
with gpu().stream() as stream, gpu().stream() as another:
    for cells in (5, 1000):
        values, status = np.linspace(0.0, 3.0, cells), np.zeros(cells, dtype=np.int64)
        squares = np.zeros((cells, 2))
        for each in (stream, another):
            each.run(FORM, (values, Squares(status, squares)))
        print(status.max(), np.array_equal(squares[:, 1], values * values))
    try:
        stream.run(FORM, (-values - 1.0, Squares(status, squares)))
    except UnfinishedError as error:
        print(error)
"""


def compiler() -> list[str] | None:
    found = shutil.which("cc")
    if found is not None:
        return [found]
    if importlib.util.find_spec("ziglang") is not None:
        return [sys.executable, "-m", "ziglang", "cc"]
    return None


pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="makes a libcuda.so.1"),
    pytest.mark.skipif(
        importlib.util.find_spec("cuda") is None, reason="cuda-python is not installed"
    ),
    pytest.mark.skipif(compiler() is None, reason="no C compiler is installed"),
]


def printed(folder: Path, script: str, *options: str) -> list[str]:
    """Return the lines that a script prints over the driver in C, compiled with some options."""
    library, source = folder / "libcuda.so.1", HERE / "in_memory/libcuda.c"
    linked = ["-shared", "-fPIC", "-o", library, source, "-lpthread", "-ldl"]
    command = [*(compiler() or ()), *options, *linked]
    subprocess.run(command, check=True, timeout=120)
    ran = subprocess.run(
        [sys.executable, "-c", script, str(folder)],
        cwd=HERE.parents[2],
        env={**os.environ, "LD_LIBRARY_PATH": str(folder)},
        capture_output=True,
        text=True,
        check=False,
    )
    return ran.stdout.splitlines() or [ran.stderr]


def test_every_call_reaches_the_driver_with_its_arguments(tmp_path: Path) -> None:
    name, *launches, failure = printed(tmp_path, SCRIPT)
    assert name == "A processor, compute capability 8.6"
    assert launches == ["64 True", "384 True"]
    assert failure == (
        "executor = 'gpu' is not finished: A processor has failed: CUDA_ERROR_ILLEGAL_ADDRESS (an "
        "address of nothing); start Python again, or leave the executor out for threads; a store "
        "can be resumed"
    )


def test_a_driver_that_is_too_old_is_named(tmp_path: Path) -> None:
    script = (
        "from rocksteady.errors import InputError\n"
        "from rocksteady.kernels.machine_code.gpu import gpu\n"
        "try: gpu()\n"
        "except InputError as error: print(error)\n"
    )
    (line,) = printed(tmp_path, script, "-DOLD")
    assert line == (
        "executor = 'gpu' is not valid: the CUDA driver is older than version 525; update the "
        "driver of the GPU, or leave the executor out for threads"
    )
