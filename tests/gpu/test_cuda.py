"""Calls of the driver, and what a user reads where there is none."""

import importlib.util
import inspect
import re
import subprocess
import sys
from types import SimpleNamespace
from typing import Any

import pytest

from rocksteady.errors import InputError
from rocksteady.gpu import _cuda as module
from rocksteady.gpu import _nvidia as gpu_module
from rocksteady.gpu._cuda import Driver, DriverError, loaded_driver
from tests.every import every
from tests.gpu.fake_gpu import FakeDriver

INSTALLED = importlib.util.find_spec("cuda") is not None


def with_bindings(functions: Any, patch: pytest.MonkeyPatch) -> None:
    patch.setattr(module, "_bindings", lambda: functions)


def failing(code: str) -> FakeDriver:
    driver = FakeDriver()
    driver.fail["cuInit"] = code
    return driver


def test_a_call_returns_its_result() -> None:
    driver = Driver(FakeDriver(gpus=3))
    assert driver.call("cuDeviceGetCount") == 3
    assert driver.call("cuInit", 0) is None
    assert driver.CUstream_flags.CU_STREAM_NON_BLOCKING == 1


def test_an_error_has_its_name_and_the_words_of_the_driver() -> None:
    with pytest.raises(DriverError) as raised:
        Driver(failing("CUDA_ERROR_NOT_FOUND")).call("cuInit", 0)
    assert raised.value.code == "CUDA_ERROR_NOT_FOUND"
    assert str(raised.value) == "CUDA_ERROR_NOT_FOUND (not found)"


def test_an_error_that_nobody_knows_has_a_number() -> None:
    unnamed = SimpleNamespace(cuInit=lambda _: (999,), cuGetErrorString=lambda _: (1, None))
    with pytest.raises(DriverError, match=r"^error 999$"):
        Driver(unnamed).call("cuInit", 0)


NO_GPU = (
    "executor = 'gpu' is not valid: the CUDA driver shows no GPU; check nvidia-smi and "
    "CUDA_VISIBLE_DEVICES, or leave the executor out for threads"
)
NO_DRIVER = (
    "executor = 'gpu' is not valid: there is no CUDA driver on this machine (libcuda is a stub of "
    "the toolkit); install the driver of an NVIDIA GPU, or leave the executor out for threads"
)
MISMATCH = (
    "executor = 'gpu' is not valid: the CUDA driver does not start: "
    "CUDA_ERROR_SYSTEM_DRIVER_MISMATCH (system driver mismatch); check it with nvidia-smi, or "
    "leave the executor out for threads"
)
LINES = {
    "no GPU": (FakeDriver(gpus=0), NO_GPU),
    "no device": (failing("CUDA_ERROR_NO_DEVICE"), NO_GPU),
    "a stub": (failing("CUDA_ERROR_STUB_LIBRARY"), NO_DRIVER),
    "a mismatch": (failing("CUDA_ERROR_SYSTEM_DRIVER_MISMATCH"), MISMATCH),
}


@every("case", LINES)
def test_a_driver_without_a_gpu_is_refused_in_one_line(
    case: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    functions, line = LINES[case]
    with_bindings(functions, monkeypatch)
    with pytest.raises(InputError) as raised:
        loaded_driver()
    assert str(raised.value) == line


def test_without_cuda_python_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cuda.bindings.driver", None)
    with pytest.raises(InputError) as raised:
        loaded_driver()
    assert str(raised.value) == (
        "executor = 'gpu' is not valid: cuda-python is not installed; install 'rocksteady[gpu]', "
        "or leave the executor out for threads"
    )


# The real package, without a driver.


def has_driver() -> bool:
    try:
        loaded_driver()
    except InputError as error:
        return "libcuda" not in str(error)
    return True


@pytest.mark.skipif(not INSTALLED or has_driver(), reason="cuda-python is not here, or a driver is")
def test_without_a_driver_its_library_is_named() -> None:
    with pytest.raises(InputError) as raised:
        loaded_driver()
    assert str(raised.value) == (
        "executor = 'gpu' is not valid: there is no CUDA driver on this machine (libcuda is not "
        "found); install the driver of an NVIDIA GPU, or leave the executor out for threads"
    )


def test_a_driver_that_is_too_old_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*_: object) -> None:
        raise RuntimeError("Function not found")  # as of the bindings, without the first of them

    with_bindings(SimpleNamespace(cuInit=missing), monkeypatch)
    monkeypatch.setattr(module, "_has_library", lambda: True)
    with pytest.raises(InputError) as raised:
        loaded_driver()
    assert str(raised.value) == (
        "executor = 'gpu' is not valid: the CUDA driver is older than version 525; update the "
        "driver of the GPU, or leave the executor out for threads"
    )


@pytest.mark.skipif(not INSTALLED, reason="cuda-python is not installed")
def test_the_real_package_has_each_function_and_constant_that_is_used() -> None:
    real = importlib.import_module("cuda.bindings.driver")
    texts = [inspect.getsource(each) for each in (module, gpu_module)]
    functions = {name for text in texts for name in re.findall(r"\bcu[A-Z]\w+", text)}
    assert len(functions) >= 20
    assert {name for name in functions if not hasattr(real, name)} == set()
    for kind in ("CUdevice_attribute", "CUstream_flags", "CUctx_flags"):
        for name in vars(getattr(FakeDriver(), kind)):
            assert hasattr(getattr(real, kind), name)


def test_the_package_is_imported_without_cuda() -> None:
    script = (
        "import sys, rocksteady; from rocksteady import Execution, map_fates;"
        "from rocksteady.sweeps import evaluate;"
        "import rocksteady.sweep.executors.choice; Execution(executor='gpu');"
        "print([name for name in sys.modules if name.startswith('cuda.')])"
    )
    printed = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert printed.stdout == "[]\n"
