"""Equations of motion: which hold where none are given, and what is refused."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    Linear,
    Nonlinear,
    Piecewise,
    Pulse,
    Record,
    State,
    Still,
    basins,
    branches,
    check_neighbours,
    compute_basins,
    compute_erosion,
    compute_fate_basins,
    compute_noise_fates,
    compute_rocking_spectrum,
    find_attractor,
    find_bifurcation_curves,
    find_bifurcations,
    find_edge_state,
    find_fatal_kicks,
    find_orbits,
    find_overturning_scales,
    find_overturning_windows,
    map_attractors,
    map_fates,
    proofs,
    run_ensemble,
    simulate,
    simulate_many,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import overturning_impulse
from rocksteady.model.equations import chosen_model
from rocksteady.motions import BandNoise, FourierSeries, Impulses, Segment
from rocksteady.orbits import ReturnMap, sweep_attractor
from rocksteady.risk import Levels
from tests.every import every

BLOCK = Block.from_p(alpha=0.3, p=2.0, restitution=0.8)
BARE = DimensionlessBlock(restitution=0.8)
SHAKING = Harmonic(amplitude=2.0, frequency_ratio=4.0)
RECORD = Record(acceleration_m_s2=5.0 * np.sin(0.25 * np.arange(60)), dt_s=0.05)
PULSE = Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=4.0)
MOTIONS = [
    SHAKING,
    FourierSeries(amplitude=2.0, frequency_ratio=4.0, harmonics=((1, 1.0, 0.0), (3, 0.2, 0.5))),
    PULSE,
    Impulses(velocities=(0.5,), times=(0.0,)),
    Piecewise(pieces=(Segment(duration=1.0, constant=1.5),)),
    Still(),
    RECORD,
]
FEW = np.linspace(-1.0, 1.0, 4)
WINDOW: dict[str, Any] = {"angles": FEW, "velocities": FEW}
GRID: dict[str, Any] = {"axes": {"amplitude": [1.0, 2.0], "frequency_ratio": [4.0, 5.0]}}
WEAK = Harmonic(amplitude=0.25, frequency_ratio=2.0)
NOISE = BandNoise(rms=0.2, band=(1.0, 5.0), duration=4.0, seed=1)
AT_LIFT = Harmonic(amplitude=1.05, frequency_ratio=2.0)
EVERY: dict[str, Callable[..., Any]] = {
    "simulate": lambda block, **how: simulate(block, SHAKING, cycles=5, **how),
    "find_attractor": lambda block, **how: find_attractor(block, SHAKING, **how),
    "sweep_attractor": lambda block, **how: sweep_attractor(
        block, SHAKING, "amplitude", [1.9, 2.0], **how
    ),
    "ReturnMap": lambda block, **how: ReturnMap(block, SHAKING, **how),
    "find_orbits": lambda block, **how: find_orbits(block, SHAKING, seeds=3, **how)[0],
    "find_bifurcations": lambda block, **how: find_bifurcations(
        block, SHAKING, "amplitude", within=(1.9, 2.1), values=3, **how
    ),
    "find_bifurcation_curves": lambda block, **how: find_bifurcation_curves(
        block, SHAKING, within=((4.0, 4.1), (2.0, 2.1)), **how
    ),
    "find_resting_branches": lambda block, **how: branches.find_resting_branches(
        block, AT_LIFT, "amplitude", (1.04, 1.06), resolution=0.01, **how
    ),
    "map_attractors": lambda block, **how: map_attractors(block, **GRID, max_cycles=100, **how),
    "map_fates": lambda block, **how: map_fates(block, **GRID, **how),
    "compute_basins": lambda block, **how: compute_basins(block, SHAKING, **WINDOW, **how),
    "compute_basin_shares": lambda block, **how: basins.compute_basin_shares(
        block, SHAKING, "amplitude", [1.9, 2.0], **how
    ),
    "compute_erosion": lambda block, **how: compute_erosion(
        block, WEAK, amplitudes=[0.2, 0.4], cycles=10, **WINDOW, **how
    ),
    "compute_fate_basins": lambda block, **how: compute_fate_basins(block, PULSE, **WINDOW, **how),
    "compute_noise_fates": lambda block, **how: compute_noise_fates(
        block, PULSE, NOISE, axes={"level": [1.0]}, draws=2, **how
    ),
    "find_edge_state": lambda block, **how: find_edge_state(block, WEAK, **how),
    "find_hilltop_saddles": lambda block, **how: basins.find_hilltop_saddles(block, WEAK, **how)[0],
    "compute_manifold": lambda block, **how: basins.compute_manifold(
        basins.find_hilltop_saddles(block, WEAK, **how)[0], "stable", length=1.0
    ),
    "find_overturning_windows": lambda block, **how: find_overturning_windows(
        block, "half-sine", [3.0], within=(3.0, 4.0), resolution=0.1, **how
    ),
    "find_fatal_kicks": lambda block, **how: find_fatal_kicks(
        block, start=State(angle=0.5, velocity=0.0), within=(0.0, 1.0), **how
    ),
}
"""Each function that takes a block of either kind, on a small case."""
SIZED: dict[str, Callable[..., Any]] = {
    "check_neighbours": lambda block, **how: check_neighbours(simulate(block, RECORD, **how)),
    "find_overturning_scales": lambda block, **how: find_overturning_scales(
        block, [RECORD], within=(0.9, 1.0), resolution=0.1, **how
    ),
    "simulate_many": lambda block, **how: simulate_many(block, [RECORD], scales=[1.0], **how),
    "run_ensemble": lambda block, **how: run_ensemble(
        block, [RECORD], levels=Levels("pga_g", [0.3, 0.5]), **how
    ),
}
"""Each of a block of known slenderness alone."""


def names_of(result: Any) -> set[str]:
    """Return the models that a result, its JSON object and its dataset name."""
    if hasattr(result, "attrs"):
        return {result.attrs["model"]}
    named = {result.model.name}
    if hasattr(result, "to_dict"):
        named.add(result.to_dict()["model"])
    if hasattr(result, "to_dataset"):
        named.add(result.to_dataset().attrs["model"])
    return named


@every("name", EVERY)
def test_the_block_alone_decides_and_every_answer_names_its_model(name: str) -> None:
    ask = EVERY[name]
    assert names_of(ask(BLOCK)) == {"nonlinear"}
    assert names_of(ask(BLOCK, model="linear")) == {"linear"}
    assert names_of(ask(BARE)) == {"linear"}
    with pytest.raises(ModelError, match="needs the block's slenderness"):
        ask(BARE, model=Nonlinear())


@every("name", SIZED)
def test_what_takes_sizes_alone_solves_the_full_equations(name: str) -> None:
    assert names_of(SIZED[name](BLOCK)) == {"nonlinear"}
    assert names_of(SIZED[name](BLOCK, model="linear")) == {"linear"}


@every("motion", MOTIONS)
def test_a_block_is_solved_by_the_full_equations_whatever_the_motion(motion: object) -> None:
    start = State(angle=0.4, velocity=0.0)
    run = simulate(BLOCK, motion, start=start, cycles=2)  # type: ignore[arg-type]
    given = simulate(BLOCK, motion, start=start, cycles=2, model=Nonlinear())  # type: ignore[arg-type]
    slender = simulate(BLOCK, motion, start=start, cycles=2, model=Linear())  # type: ignore[arg-type]
    assert (run.model, slender.model) == (Nonlinear(), Linear())
    assert run(0.5).angle == given(0.5).angle != slender(0.5).angle
    if not isinstance(motion, Record):
        bare = simulate(BARE, motion, start=start, cycles=2)  # type: ignore[arg-type]
        assert bare(0.5).angle == slender(0.5).angle


def test_spectra_and_impulses_are_those_of_the_full_equations() -> None:
    data = compute_rocking_spectrum(RECORD, alpha=0.2, periods_s=3.0)
    assert data.attrs["model"] == "nonlinear"
    assert overturning_impulse(BLOCK) == overturning_impulse(BLOCK, model=Nonlinear())
    assert overturning_impulse(BLOCK) > overturning_impulse(BLOCK, model=Linear())
    with pytest.raises(InputError, match="it must be a Linear or a Nonlinear"):
        find_attractor(BLOCK, SHAKING, model=Nonlinear)  # type: ignore[arg-type]
    with pytest.raises(ModelError, match="needs the block's slenderness"):
        chosen_model(Nonlinear(), BARE)


def test_what_only_the_linear_model_has_is_asked_for_by_name() -> None:
    orbit = find_orbits(BLOCK, SHAKING, seeds=3)[0]
    windows = EVERY["find_overturning_windows"](BLOCK)
    asked = (
        lambda: proofs.certify_fate(BLOCK, PULSE),
        lambda: proofs.certify_orbit(orbit),
        lambda: proofs.certify_edges(windows),
    )
    for ask in asked:
        with pytest.raises(ModelError, match=r'take "linear"$'):
            ask()
    assert proofs.certify_fate(BLOCK, PULSE, model="linear").proved
    erosion = EVERY["compute_erosion"]
    assert erosion(BLOCK).heteroclinic is None
    assert erosion(BLOCK, model="linear").heteroclinic == erosion(BARE).heteroclinic


@every("tolerance", [0.0, 1e-14, 0.1, float("nan"), "fine"])
def test_a_tolerance_has_limits(tolerance: float) -> None:
    with pytest.raises(InputError, match="tolerance"):
        Nonlinear(tolerance=tolerance)


def test_the_error_of_the_full_equations_lies_between_1e_13_and_1e_3() -> None:
    assert Nonlinear().tolerance == 1e-10
    for tolerance in (1e-13, 1e-10, 1e-3):
        given = Nonlinear(tolerance=tolerance)
        assert chosen_model(given, BLOCK) is given
        assert given.name == "nonlinear"
    for tolerance in (math.nextafter(1e-13, 0.0), math.nextafter(1e-3, 1.0), 0.0, 1.0, math.nan):
        with pytest.raises(InputError, match=r"^tolerance = .*\[1e-13, 0.001\]"):
            Nonlinear(tolerance=tolerance)
