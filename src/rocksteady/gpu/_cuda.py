"""Calls of the CUDA driver through cuda-python, each of them checked."""

import ctypes
import sys
from importlib import import_module
from typing import Any

from rocksteady.errors import InputError

OUT_OF_MEMORY = "CUDA_ERROR_OUT_OF_MEMORY"
THREADS = "leave the executor out for threads"


class DriverError(Exception):
    """A call of the driver has failed.

    Parameters
    ----------
    code
        Name of the error, as "CUDA_ERROR_OUT_OF_MEMORY".
    text
        What the driver has for it.

    Attributes
    ----------
    code
        The parameter, unchanged.
    """

    def __init__(self, code: str, text: str) -> None:
        super().__init__(f"{code} ({text})" if text else code)
        self.code = code


class Driver:
    """The driver of this machine.

    Parameters
    ----------
    functions
        `cuda.bindings.driver`, or what has the same functions and constants.
    """

    def __init__(self, functions: Any) -> None:
        self._functions = functions

    def __getattr__(self, name: str) -> Any:
        """Return a constant."""
        return getattr(self._functions, name)

    def call(self, name: str, *arguments: Any) -> Any:
        """Return the result of a function; None where it has none.

        Raises
        ------
        DriverError
            If it returns an error.
        """
        code, *results = getattr(self._functions, name)(*arguments)
        if int(code):
            failed, text = self._functions.cuGetErrorString(code)
            readable = "" if int(failed) or text is None else text.decode("utf-8", "replace")
            raise DriverError(getattr(code, "name", f"error {int(code)}"), readable)
        return results[0] if results else None


def loaded_driver() -> Driver:
    """Return the driver, started.

    Raises
    ------
    InputError
        If cuda-python is not installed, or there is no driver, none that starts, or no GPU.
    """
    driver = Driver(_bindings())
    try:
        driver.call("cuInit", 0)
        if not driver.call("cuDeviceGetCount"):
            raise DriverError("CUDA_ERROR_NO_DEVICE", "")
    except DriverError as error:
        raise unusable(error) from error
    except RuntimeError as error:  # of the bindings
        if _has_library():  # without all functions of CUDA 12
            raise _refused(
                "the CUDA driver is older than version 525", "update the driver of the GPU"
            ) from error
        raise _refused(
            "there is no CUDA driver on this machine (libcuda is not found)",
            "install the driver of an NVIDIA GPU",
        ) from error
    return driver


def _has_library() -> bool:
    """Return whether the library of a driver can be loaded, of whatever version."""
    try:
        ctypes.CDLL("nvcuda.dll" if sys.platform == "win32" else "libcuda.so.1")
    except OSError:
        return False
    return True


def _bindings() -> Any:
    """Return the functions of the driver as cuda-python has them."""
    try:
        return import_module("cuda.bindings.driver")
    except ImportError as error:
        raise InputError(
            "executor",
            "gpu",
            "cuda-python is not installed",
            f"install 'rocksteady[gpu]', or {THREADS}",
        ) from error


def unusable(error: DriverError) -> InputError:
    """Return the error for a driver that does not start, or finds no GPU."""
    if error.code == "CUDA_ERROR_NO_DEVICE":
        return _refused("the CUDA driver shows no GPU", "check nvidia-smi and CUDA_VISIBLE_DEVICES")
    if error.code == "CUDA_ERROR_STUB_LIBRARY":
        return _refused(
            "there is no CUDA driver on this machine (libcuda is a stub of the toolkit)",
            "install the driver of an NVIDIA GPU",
        )
    return _refused(f"the CUDA driver does not start: {error}", "check it with nvidia-smi")


def _refused(valid: str, hint: str) -> InputError:
    return InputError("executor", "gpu", valid, f"{hint}, or {THREADS}")
