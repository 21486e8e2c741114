"""Check of an installation: recorded calls of every kernel, made again and compared bit for bit."""

import inspect
import platform
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.errors import InputError, with_call_errors
from rocksteady.installation._recorded import Call, Difference, differences, loaded, replayed
from rocksteady.kernels.machine_code.types import signature_of
from rocksteady.leaves import NO_GPU, import_if_present
from rocksteady.results.result import Result, read_only

RECORDED = Path(__file__).parent / "recorded-calls.bin.gz"
"""Calls that every installation must repeat to the last bit."""


@dataclass(frozen=True, kw_only=True, eq=False)
class KernelCheck:
    """Replay of the recorded calls of one kernel.

    Attributes
    ----------
    name
        Of the kernel.
    calls
        Number of calls.
    values
        Number of values compared: results, and every element of every array argument.
    differing
        How many of them differ.
    first_difference
        The first one in words; None where all are equal.
    """

    name: str
    calls: int
    values: int
    differing: int
    first_difference: str | None

    @property
    def equal(self) -> bool:
        """Whether every value is the recorded one."""
        return self.first_difference is None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Installation(Result):
    """What runs the kernels here, and whether it computes what it should.

    Attributes
    ----------
    system
        Operating system and processor.
    cpu_level
        Instruction sets of the processor, as "x86-64-v3"; None where there are no levels.
    kernels
        "library" for code compiled ahead of time, "python" for kernels that run uncompiled.
    library, target
        The file of the library, and what it was compiled for; None without one.
    sources
        Hash of the kernels' sources: installations with the same one have the same kernels.
    versions
        Of rocksteady, Python and NumPy.
    checks
        Replay of each kernel.
    gpu
        Name and compute capability of the GPU that ``executor="gpu"`` uses; None where it cannot.
    no_gpu
        Why it cannot; None where it can.
    """

    system: str
    cpu_level: str | None
    kernels: str
    library: Path | None
    target: str | None
    sources: str
    versions: Mapping[str, str]
    checks: tuple[KernelCheck, ...]
    gpu: str | None
    no_gpu: str | None

    @property
    def equal(self) -> bool:
        """Whether every value of every kernel is the recorded one."""
        return all(check.equal for check in self.checks)

    @property
    def calls(self) -> int:
        """Number of calls that were made again."""
        return sum(check.calls for check in self.checks)

    @property
    def values(self) -> int:
        """Number of values compared."""
        return sum(check.values for check in self.checks)

    @property
    def differing(self) -> int:
        """Number of values that differ."""
        return sum(check.differing for check in self.checks)


@with_call_errors
def check_installation(*, repeat_calls: bool = True) -> Installation:
    """Repeat recorded calls of every kernel and compare all values bit for bit.

    The kernels give the same bits on every processor and system; a difference means that this
    installation is faulty. Takes less than a second, and some minutes where the kernels run as
    plain Python.

    Parameters
    ----------
    repeat_calls
        Whether the calls are repeated; default True.  Without them there are no `checks`.

    Returns
    -------
    Installation
        What runs the kernels, the versions, and the comparison of each kernel.

    Examples
    --------
    >>> check_installation().equal
    True
    """
    from rocksteady.kernels.entries import ENTRIES

    if not isinstance(repeat_calls, bool):
        raise InputError("repeat_calls", repeat_calls, "it must be True or False", "give True")
    checks = replay(loaded(RECORDED.read_bytes()), ENTRIES) if repeat_calls else ()
    return Installation(**_environment(), checks=checks)


def replay(
    calls: Iterable[Call], kernels: Mapping[str, Callable[..., Any]]
) -> tuple[KernelCheck, ...]:
    """Repeat recorded calls and compare them, kernel by kernel in the order of the calls.

    Parameters
    ----------
    calls
        The records.
    kernels
        What computes them, by name.
    """
    by_kernel: dict[str, list[Call]] = {}
    for call in calls:
        by_kernel.setdefault(call.entry, []).append(call)
    # Kernels that run as plain Python warn of overflow, which is meant.
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        return tuple(_checked(name, own, kernels[name]) for name, own in by_kernel.items())


def _checked(name: str, calls: list[Call], kernel: Callable[..., Any]) -> KernelCheck:
    """Repeat the calls of one kernel."""
    values = differing = 0
    first = None
    for number, call in enumerate(calls):
        compared, unequal, difference = differences(call, replayed(call, kernel))
        values += compared
        differing += unequal
        if difference is not None and first is None:
            first = (
                f"call {number + 1} of {len(calls)}, {_place(difference, kernel)}: "
                f"{difference.computed!r} in place of {difference.recorded!r}"
            )
    return KernelCheck(
        name=name, calls=len(calls), values=values, differing=differing, first_difference=first
    )


def _place(difference: Difference, kernel: Callable[..., Any]) -> str:
    """Return where a difference is, as ``final[3, 0]`` or ``result state.phase``."""
    signature = signature_of(inspect.unwrap(kernel))
    names = [leaf.name for leaf in signature.leaves]
    for leaf in signature.returned:
        names += [f"result {leaf.name}".strip()] * leaf.cells  # two of a complex number
    place = f"{list(difference.place)}" if difference.place else ""
    return f"{names[difference.leaf]}{place}"


def _environment() -> dict[str, Any]:
    """Return what runs the kernels, and the versions."""
    from rocksteady.kernels.machine_code.compilation import LIBRARY, runner
    from rocksteady.kernels.machine_code.library import library, targets
    from rocksteady.kernels.machine_code.sources import sources_hash

    kernels = runner()
    used = library() if kernels == LIBRARY else None
    fastest = next(iter(targets()), None)
    device, reason = _gpu()
    return {
        "system": f"{platform.system()} {platform.machine()}",
        "cpu_level": None if fastest is None else fastest.partition("-")[2],
        "kernels": kernels,
        "library": None if used is None else used.path,
        "target": None if used is None else used.target,
        "sources": sources_hash(),
        "versions": read_only(
            {
                # Not imported above: the package names what this module defines.
                "rocksteady": import_module("rocksteady").__version__,
                "python": platform.python_version(),
                "numpy": np.__version__,
            }
        ),
        "gpu": device,
        "no_gpu": reason,
    }


def _gpu() -> tuple[str | None, str | None]:
    """Return the GPU that can run the kernels, or why there is none."""
    leaf = import_if_present("gpu.executor")
    if leaf is None:
        return None, NO_GPU
    try:
        return str(leaf.find_gpu()), None
    except InputError as error:
        return None, error.valid
