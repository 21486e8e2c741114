"""The entries are what Python calls: nothing else runs as Python."""

import inspect
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

import rocksteady as rs
import rocksteady.kernels
from rocksteady.kernels.entries import ENTRIES
from rocksteady.kernels.machine_code.compilation import Kernel
from rocksteady.kernels.machine_code.types import signature_of
from tests.public.calls import calls
from tests.strategies import PLAIN

KERNELS = "rocksteady.kernels."
ROOT = Path(__file__).parents[2]
MODELS = (rs.Linear(), rs.Nonlinear())

pytestmark = pytest.mark.skipif(PLAIN, reason="nothing is compiled")


def test_each_entry_says_with_which_types_it_is_called() -> None:
    for kernel in ENTRIES.values():
        signature_of(kernel.py_func)


def test_no_other_kernel_has_the_name_of_an_entry() -> None:
    # The library knows its functions by name.
    for kernel in all_kernels():
        assert ENTRIES.get(kernel.py_func.__name__, kernel) is kernel


@pytest.mark.slow
def test_public_calls_run_no_kernel_as_python(tmp_path: Path) -> None:
    assert in_a_process("print_kernels_that_run_as_python", tmp_path) == []


@pytest.mark.slow
def test_public_calls_import_no_numba(tmp_path: Path) -> None:
    assert in_a_process("print_imports_of_numba", tmp_path) == []


def in_a_process(name: str, folder: Path) -> list[list[str]]:
    """Return what a function of this file prints, called in a process and a folder of its own."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", f"from {__name__} import {name}; {name}()"],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found: list[list[str]] = json.loads(done.stdout)
    return found


def all_kernels() -> list[Kernel]:
    """Return every kernel of the package."""
    for module in walk_packages(rocksteady.kernels.__path__, "rocksteady.kernels."):
        import_module(module.name)
    modules = [module for name, module in sys.modules.items() if name.startswith("rocksteady.")]
    kernels = {
        id(member): member
        for module in modules
        for _, member in inspect.getmembers(module, lambda member: isinstance(member, Kernel))
    }
    return list(kernels.values())


def print_kernels_that_run_as_python() -> None:
    """Print the kernels that public calls run as Python, called from outside the kernels."""
    mpl.use("Agg")
    found = set()
    first_call = Kernel._first_call

    def watched(kernel: Kernel, *arguments: Any) -> Any:
        caller = sys._getframe(2).f_globals["__name__"]
        result = first_call(kernel, *arguments)
        if kernel._call.__module__ == Kernel.__module__ and not caller.startswith(KERNELS):
            found.add(f"{kernel.py_func.__module__}.{kernel.py_func.__qualname__} by {caller}")
        return result

    watch: Any = Kernel
    watch._first_call = watched
    for call in all_calls():
        call()
    json.dump(sorted(found), sys.stdout)


def print_imports_of_numba() -> None:
    """Print which of its modules a simulation and maps have imported."""
    block = rs.Block.rectangle(width=0.4, height=1.2)
    rs.simulate(block, rs.Harmonic(amplitude=2.0, frequency_ratio=4.0), cycles=3)
    for call in grids(block, rs.Nonlinear()):
        call()
    json.dump(sorted(name for name in sys.modules if name.startswith("numba")), sys.stdout)


def all_calls() -> Iterator[Callable[[], object]]:
    """Yield a call of every public function, and more of those that move blocks."""
    for name, call in calls().items():
        if not name.startswith(("plot", "animate")):
            yield call.__call__
    for model in MODELS:
        for block in (
            rs.Block.rectangle(width=0.4, height=1.2),
            rs.Block.asymmetric(left=0.15, right=0.25, height=1.2),
        ):
            yield from motions(block, model)
            yield from orbits(block, model)
            yield from grids(block, model)
            yield from layouts(block, model)
        yield from of_symmetric_blocks(rs.Block.rectangle(width=0.4, height=1.2), model)


def motions(block: rs.Block, model: Any) -> Iterator[Callable[[], object]]:
    """Yield time histories under every kind of motion, with all that is read off them."""
    record = rs.Record(acceleration_m_s2=4.0 * np.sin(0.25 * np.arange(60)), dt_s=0.05)
    shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    follow = partial(followed, block, model=model)
    yield partial(follow, shaking, cycles=3)
    yield partial(follow, rs.Harmonic(amplitude=9.0, frequency_ratio=4.0), cycles=30)
    yield partial(follow, shaking, cycles=3, start=rs.State(angle=0.1, velocity=0.2))
    yield partial(follow, rs.Still(), start=rs.State(angle=-0.1, velocity=0.2))
    yield partial(follow, rs.motions.Impulses(velocities=(0.5, -0.1), times=(0.0, 1.0)))
    yield partial(follow, rs.Pulse(shape="ricker", amplitude=2.0, frequency_ratio=4.0))
    yield partial(follow, record)
    if isinstance(model, rs.Nonlinear):
        yield partial(follow, rs.BaseMotion(record, record))


def followed(*arguments: Any, **options: Any) -> None:
    run = rs.simulate(*arguments, **options)
    run(np.linspace(0.0, min(run.end_time_pt, 3.0), 5))
    run.phase_path(5)
    run.base_displacement([0.1])
    _ = run.peak, run.peak_velocity, run.impacts, run.overturn_time_pt, run.growth


def orbits(block: rs.Block, model: Any) -> Iterator[Callable[[], object]]:
    """Yield attractors, orbits and the return map, with orbits that rest and such that do not."""
    for amplitude, ratio in ((2.0, 4.0), (1.2, 1.0)):
        shaking = rs.Harmonic(amplitude=amplitude, frequency_ratio=ratio)
        yield partial(rs.find_attractor, block, shaking, max_cycles=60, model=model)
        yield partial(
            rs.find_orbits, block, shaking, max_period=1, max_impacts=2, seeds=3, model=model
        )
    shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    state = rs.histories.ImpactState(side=1, phase=0.5, speed=0.3)
    yield partial(rs.orbits.ReturnMap(block, shaking, model=model), state)
    if isinstance(model, rs.Linear):
        yield partial(
            rs.orbits.sweep_attractor, block, shaking, "amplitude", [1.9, 2.0], max_cycles=20
        )


def grids(block: rs.Block, model: Any) -> Iterator[Callable[[], object]]:
    """Yield maps, basins and overturning windows."""
    few = [-0.5, 0.0, 0.5]
    axes = {"amplitude": [1.0, 2.0], "frequency_ratio": [3.0, 4.0]}
    window = {"angles": few, "velocities": few, "model": model}
    shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    yield partial(rs.map_attractors, block, axes=axes, max_cycles=20, model=model)
    yield partial(rs.map_fates, block, axes=axes, cycles=10, model=model)
    yield partial(rs.compute_basins, block, shaking, max_cycles=10, **window)
    yield partial(rs.compute_erosion, block, shaking, [0.5, 3.0], cycles=5, **window)
    reach = {"within": (3.0, 4.0), "resolution": 0.1, "model": model}
    yield partial(rs.find_overturning_windows, block, "half-sine", [3.0], **reach)


def layouts(block: rs.Block, model: Any) -> Iterator[Callable[[], object]]:
    """Yield calls with arrays that are no C-contiguous, writable float64 ones."""
    values = np.linspace(1.0, 2.0, 8)
    frozen = values.copy()
    frozen.setflags(write=False)
    shaking = rs.Harmonic(amplitude=2.0, frequency_ratio=4.0)
    run = rs.simulate(block, shaking, cycles=3, model=model)
    for given in (frozen, values[::2], values.astype(np.float32), values.reshape(2, 4).T):
        yield partial(run, given)
        yield partial(rs.formulas.steady_states, given, 4.0, 0.8)
        yield partial(rs.formulas.steady_states, 2.0, given, 0.5 * given)
        yield partial(rs.orbits.compute_region_boundaries, given, 0.8, order=3)
        yield partial(
            rs.map_fates, block, shaking, axes={"amplitude": given.ravel()}, cycles=5, model=model
        )


def of_symmetric_blocks(block: rs.Block, model: Any) -> Iterator[Callable[[], object]]:
    """Yield spectra, and what starts on steady states."""
    record = rs.Record(acceleration_m_s2=4.0 * np.sin(0.25 * np.arange(60)), dt_s=0.05)
    shaking = rs.Harmonic(amplitude=1.0, frequency_ratio=2.0)
    sizes = {"alpha": [0.2, 0.3], "periods_s": [1.0, 2.0], "model": model}
    yield partial(rs.compute_rocking_spectrum, record, **sizes)
    yield partial(rs.compute_rocking_spectrum, [record, record.scaled(2.0)], **sizes)
    if isinstance(model, rs.Nonlinear):
        yield partial(rs.compute_rocking_spectrum, [rs.BaseMotion(record, record)], **sizes)
    axes = {"amplitude": [1.0, 2.0], "frequency_ratio": [3.0, 4.0]}
    for branch in (1, 2):
        start = rs.Steady(branch=branch)
        yield partial(rs.simulate, block, shaking, cycles=3, start=start, model=model)
        yield partial(rs.map_attractors, block, axes=axes, max_cycles=20, start=start, model=model)
        yield partial(rs.map_fates, block, axes=axes, cycles=10, start=start, model=model)
