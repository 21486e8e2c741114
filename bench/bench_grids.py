"""Grids of initial states and of parameters, on all cores: basins, erosion, maps of attractors.

Elapsed time, since threads share the work.  Guides: 5 s for 200 x 200 states over 200 periods, and
5 s for a map of 100 x 100 attractors, on two cores.
"""

import time
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    State,
    compute_basins,
    compute_erosion,
    map_attractors,
)

PERIODIC = (1.0, 2.0, 0.8)
CHAOTIC = (6.0, 6.0, 0.25)
"""Amplitude, frequency ratio, restitution: what does not repeat is followed to the end."""


@pytest.mark.parametrize("point", [PERIODIC, CHAOTIC], ids=["periodic", "chaotic"])
@pytest.mark.benchmark(group="grids", timer=time.perf_counter)
def test_basins(benchmark: Any, point: tuple[float, float, float]) -> None:
    amplitude, frequency, restitution = point
    block = DimensionlessBlock(restitution=restitution)
    shaking = Harmonic(amplitude=amplitude, frequency_ratio=frequency)
    found = benchmark.pedantic(
        compute_basins, args=(block, shaking), kwargs={"max_cycles": 200}, rounds=3, warmup_rounds=1
    )
    benchmark.extra_info["cells"] = found.label.size
    benchmark.extra_info["shares"] = {
        one.name: part.share for one, part in zip(found.attractors, found.fractions(), strict=True)
    }


@pytest.mark.benchmark(group="grids", timer=time.perf_counter)
def test_erosion(benchmark: Any) -> None:
    amplitudes = np.linspace(0.0, 1.6, 17)
    shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    block = DimensionlessBlock(restitution=0.9)
    found = benchmark.pedantic(
        compute_erosion, args=(block, shaking, amplitudes), rounds=3, warmup_rounds=1
    )
    benchmark.extra_info["cells"] = found.safe.size


@pytest.mark.parametrize("model", [Linear(), Nonlinear()], ids=lambda model: model.name)
@pytest.mark.benchmark(group="grids", timer=time.perf_counter)
def test_erosion_of_block(benchmark: Any, model: Linear | Nonlinear) -> None:
    """Fewer states than above and a block with a slenderness: one model beside the other."""
    block = Block.from_p(alpha=0.2, p=1.0, restitution=0.9)
    shaking = Harmonic(amplitude=1.0, frequency_ratio=2.0)
    found = benchmark.pedantic(
        compute_erosion,
        args=(block, shaking, np.linspace(0.0, 1.6, 17)),
        kwargs={
            "angles": np.linspace(-1.0, 1.0, 30),
            "velocities": np.linspace(-1.0, 1.0, 30),
            "model": model,
        },
        rounds=3,
        warmup_rounds=1,
    )
    benchmark.extra_info["cells"] = found.safe.size


@pytest.mark.benchmark(group="grids", timer=time.perf_counter)
def test_attractors_of_b1(benchmark: Any) -> None:
    """B1 on a grid four times as fine, each cell followed to what it settles to."""
    axes = {"amplitude": np.linspace(1.0, 6.0, 200), "frequency_ratio": np.linspace(1.0, 12.0, 200)}
    found = benchmark.pedantic(
        map_attractors,
        args=(DimensionlessBlock(restitution=0.8),),
        kwargs={"axes": axes, "start": State(angle=0.0, velocity=0.3)},
        rounds=5,
        warmup_rounds=1,
    )
    benchmark.extra_info["cells"] = found.kind.size


@pytest.mark.benchmark(group="grids", timer=time.perf_counter)
def test_attractor_map(benchmark: Any) -> None:
    axes = {"amplitude": np.linspace(0.5, 6.0, 100), "frequency_ratio": np.linspace(0.5, 10.0, 100)}
    block = DimensionlessBlock(restitution=0.8)
    found = benchmark.pedantic(
        map_attractors, args=(block,), kwargs={"axes": axes}, rounds=5, warmup_rounds=1
    )
    benchmark.extra_info["cells"] = found.kind.size
