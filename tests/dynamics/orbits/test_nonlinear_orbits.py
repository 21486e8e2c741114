"""Periodic motions of the nonlinear model: what motions settle to, and all at a point."""

import math
from functools import cache

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Harmonic,
    State,
    Status,
    Steady,
    find_attractor,
    find_orbits,
    map_attractors,
    map_fates,
    simulate,
)
from rocksteady.dynamics.orbits.return_map import ReturnMap
from rocksteady.errors import ModelError
from rocksteady.model.equations import Nonlinear
from rocksteady.orbits import Orbit, sweep_attractor
from tests.dynamics.full_integrator import impacts_by_integrator


def test_an_attractor_is_where_a_long_run_ends() -> None:
    block = Block.from_p(alpha=0.3, p=1.0, restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=4.0)
    found = find_attractor(block, shaking, model=Nonlinear())
    assert found.orbit is not None
    assert (found.orbit.model, found.orbit.symmetric, found.orbit.impacts) == (Nonlinear(), True, 2)
    assert found.orbit.residual < 1e-12
    run = simulate(block, shaking, cycles=100, model=Nonlinear())
    last = np.abs(run(np.linspace(run.end_time_pt - 1.6, run.end_time_pt, 20_001)).angle).max()
    assert found.orbit.highest == pytest.approx(last, abs=1e-8)
    assert np.prod(found.orbit.multipliers).real == pytest.approx(0.8**4, rel=1e-12)
    drawn = found.orbit.trajectory()
    assert drawn.model == Nonlinear()
    assert drawn.peak == pytest.approx(found.orbit.highest, rel=1e-13)


def test_slender_blocks_settle_as_in_the_linear_model() -> None:
    block = Block.from_p(alpha=1e-6, p=1.0, restitution=0.8)
    for ratio, side in ((1.9, -1), (4.0, 1)):
        shaking = Harmonic(amplitude=2.0, frequency_ratio=ratio)
        full = find_attractor(block, shaking, start=Steady(side=side), model=Nonlinear())
        plain = find_attractor(block, shaking, start=Steady(side=side))
        assert full.kind is plain.kind
        assert full.peaks == pytest.approx(plain.peaks, rel=1e-9)


def test_cells_of_maps_are_single_answers() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    start = State(angle=0.0, velocity=0.3)
    axes = {"alpha": [0.1, 0.3, 0.6], "amplitude": [0.8, 2.0, 5.0]}
    block = Block.from_radius(alpha=0.2, radius=1.0, restitution=0.8)
    settled = map_attractors(block, shaking, axes=axes, start=start, model=Nonlinear())
    fates = map_fates(block, shaking, axes=axes, start=start, cycles=30, model=Nonlinear())
    assert settled.attrs["model"] == "nonlinear"
    for i, alpha in enumerate(axes["alpha"]):
        for j, amplitude in enumerate(axes["amplitude"]):
            body = Block.from_radius(alpha=alpha, radius=1.0, restitution=0.8)
            base = Harmonic(amplitude=amplitude, frequency_ratio=3.0)
            single = find_attractor(body, base, start=start, model=Nonlinear())
            meanings = settled.kind.attrs["flag_meanings"].split()
            assert meanings[int(settled.kind[i, j])] == single.kind.value
            if single.orbit is not None:
                assert float(settled.highest[i, j]) == pytest.approx(
                    single.orbit.highest, rel=1e-12
                )
            run = simulate(body, base, start=start, cycles=30, model=Nonlinear())
            assert Status(int(fates.fate[i, j])) is run.status


def test_a_block_without_slenderness_is_refused() -> None:
    bare = DimensionlessBlock(restitution=0.8)
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    with pytest.raises(ModelError, match="slenderness"):
        ReturnMap(bare, shaking, model=Nonlinear())
    with pytest.raises(ModelError, match="slenderness"):
        find_attractor(bare, shaking, model=Nonlinear())
    with pytest.raises(ModelError, match="slenderness"):
        map_fates(bare, shaking, axes={"amplitude": [1.0, 2.0]}, model=Nonlinear())
    with pytest.raises(ModelError, match="slenderness"):
        find_orbits(bare, shaking, model=Nonlinear())
    with pytest.raises(ModelError, match="slenderness"):
        sweep_attractor(bare, shaking, "amplitude", [1.0, 2.0], model=Nonlinear())


# --------------------------------------------------------------------- all orbits at a point

ASYMMETRY = Block.asymmetric(left=0.3, right=0.5, height=1.6, restitution=(0.8, 0.9))
SLENDER = Block.from_p(alpha=0.2, p=1.4, restitution=0.8)
CASES = [
    # block, amplitude, frequency ratio, longest period
    (SLENDER, 2.0, 1.9, 3),
    (Block.from_p(alpha=0.3, p=2.0, restitution=0.25), 6.0, 6.0, 2),
    (Block.from_p(alpha=0.5, p=1.0, restitution=0.9), 2.0, 4.0, 3),
    (Block.from_p(alpha=0.3, p=1.0, restitution=0.4), 1.15, 1.0, 2),
    (ASYMMETRY, 3.0, 6.0, 2),
    (ASYMMETRY, 2.0, 3.0, 2),
]
cases = pytest.mark.parametrize(("block", "a", "w", "longest"), CASES)


@cache
def listed(block: Block, a: float, w: float, longest: int) -> tuple[Orbit, ...]:
    shaking = Harmonic(amplitude=a, frequency_ratio=w)
    found = find_orbits(
        block, shaking, max_period=longest, max_impacts=4, seeds=20, model=Nonlinear()
    )
    return tuple(orbit for orbit in found if orbit.admissible)


def images(orbit: Orbit) -> list[Orbit]:
    """An orbit and, where it has one, its mirror image."""
    if orbit.symmetric or not orbit.block.symmetric:
        return [orbit]
    return [orbit, orbit.mirrored]


@cases
def test_each_orbit_is_back_after_its_period(
    block: Block, a: float, w: float, longest: int
) -> None:
    found = listed(block, a, w, longest)
    assert found
    for orbit in (image for each in found for image in images(each)):
        assert (orbit.model, orbit.admissible) == (Nonlinear(), True)
        run = simulate(
            block,
            orbit.motion,
            start=orbit.start,
            cycles=orbit.period + 0.01,
            model=Nonlinear(),
        )
        if orbit.rest_phases:  # it forgets everything, and lifts again when it did at first
            drawn = orbit.trajectory()
            assert drawn.peak == pytest.approx(run.peak, rel=1e-10)
            here = run(2.0 * math.pi * orbit.period / w)
            assert (here.angle, here.velocity) == pytest.approx((0.0, 0.0), abs=1e-12)
            continue
        assert orbit.impacts == len(orbit.states)
        # What rounding leaves of the states grows on the way.
        off = 1e-14 * (1.0 + np.cumprod([growth(orbit, k) for k in range(len(orbit.states))]))
        assert len(run.impacts) == orbit.impacts
        after = [*orbit.states[1:], orbit.states[0]]
        for k, state in enumerate(after):
            turned = orbit.motion.phase + w * run.impacts.pt[k] - state.phase
            assert abs(np.angle(np.exp(1j * turned))) < 1e3 * off[k] + 1e-11
            velocity = run.impacts.velocity_after[k]
            assert velocity == pytest.approx(
                state.side * state.speed, rel=1e3 * off[k] + 1e-11, abs=0.0
            )
        assert run.impacts.pt[-1] * w == pytest.approx(2.0 * math.pi * orbit.period, abs=1e-6)


def growth(orbit: Orbit, k: int) -> float:
    """Return by how much the passage after a state may magnify a difference."""
    step = ReturnMap(orbit.block, orbit.motion, model=Nonlinear())(orbit.states[k])
    return float(np.linalg.norm(step.jacobian, 2)) + 1.0


@cases
def test_the_flow_contracts_by_the_restitutions_alone(
    block: Block, a: float, w: float, longest: int
) -> None:
    for orbit in listed(block, a, w, longest):
        if orbit.rest_phases:
            assert not orbit.multipliers.any()
            continue
        step = ReturnMap(block, orbit.motion, model=Nonlinear())(orbit.states[0], len(orbit.states))
        first, second = block.positive.restitution, block.negative.restitution
        exact = (first * second) ** len(orbit.states)
        assert len(orbit.states) % 2 == 0
        # Measured, not assumed: the product of the derivatives of the passages.
        size = np.abs(step.jacobian).max() ** 2
        assert np.linalg.det(step.jacobian) == pytest.approx(exact, abs=1e-9 * (1.0 + size))
        trace, sizes = step.jacobian.trace(), np.abs(orbit.multipliers)
        assert orbit.multipliers.sum().real == pytest.approx(trace, rel=1e-6)
        assert np.prod(orbit.multipliers).real == pytest.approx(exact, rel=1e-9)
        assert sizes[0] >= sizes[1]


@pytest.mark.parametrize("block", [SLENDER, ASYMMETRY])
def test_an_adaptive_integrator_lands_where_the_orbits_do(block: Block) -> None:
    for orbit in listed(*next(case for case in CASES if case[0] is block)):
        w, a = orbit.motion.frequency_ratio, orbit.motion.amplitude
        if orbit.largest_multiplier > 100.0:
            continue
        landings = impacts_by_integrator(
            lambda t, w=w, a=a, phase=orbit.motion.phase: (  # type: ignore[misc]
                a * block.alpha * math.sin(w * block.p * t + phase)
            ),
            block=block,
            angle=0.0,
            velocity=orbit.start.side * orbit.start.speed * block.alpha * block.p,
            breaks=(0.0, 2.01 * math.pi * orbit.period / (w * block.p)),
            longest_step=0.05 / block.p,
            count=len(orbit.states),
        )
        assert landings[-1] * w * block.p == pytest.approx(2.0 * math.pi * orbit.period, abs=1e-8)


def test_orbits_go_to_those_of_the_linear_model_with_the_square_of_the_slenderness() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    bare = DimensionlessBlock(restitution=0.8)
    limits = find_orbits(bare, shaking, seeds=20, max_period=1)
    errors = []
    for alpha in (0.01, 0.02):
        block = Block.from_p(alpha=alpha, p=1.0, restitution=0.8)
        found = find_orbits(block, shaking, seeds=20, max_period=1, model=Nonlinear())
        assert [(orbit.kind, orbit.branch) for orbit in found] == [
            (orbit.kind, orbit.branch) for orbit in limits
        ]
        errors.append(
            [
                abs(orbit.highest - limit.highest)
                for orbit, limit in zip(found, limits, strict=True)
                if limit.admissible
            ]
        )
    np.testing.assert_allclose(np.array(errors[1]) / errors[0], 4.0, rtol=0.02)


@cases
def test_the_attractor_from_rest_is_among_them(
    block: Block, a: float, w: float, longest: int
) -> None:
    found = find_attractor(block, Harmonic(amplitude=a, frequency_ratio=w), model=Nonlinear())
    if found.orbit is None or found.orbit.period > longest:
        return
    stable = [orbit for orbit in listed(block, a, w, longest) if orbit.stable]
    peaks = [(orbit.highest, orbit.lowest) for each in stable for orbit in images(each)]
    own = found.orbit.highest, found.orbit.lowest
    apart = [np.hypot(*np.subtract(own, pair)) for pair in peaks]
    assert min(apart) < 1e-11


def test_without_shaking_there_are_none() -> None:
    assert (
        find_orbits(SLENDER, Harmonic(amplitude=0.0, frequency_ratio=2.0), model=Nonlinear()) == ()
    )


def test_a_trail_settles_at_each_value_as_the_attractor_does() -> None:
    shaking = Harmonic(amplitude=2.0, frequency_ratio=1.9)
    values = [2.1, 1.9, 1.8]
    trail = sweep_attractor(
        SLENDER, shaking, "frequency_ratio", values, start=Steady(), model=Nonlinear()
    )
    for value, found, peaks in zip(values, trail.attractors, trail.peaks, strict=True):
        alone = find_attractor(
            SLENDER,
            Harmonic(amplitude=2.0, frequency_ratio=value),
            start=Steady(),
            model=Nonlinear(),
        )
        assert (found.model, found.kind) == (Nonlinear(), alone.kind)
        assert found.orbit is not None
        assert alone.orbit is not None
        sizes = sorted((found.orbit.highest, -found.orbit.lowest))
        assert sizes == pytest.approx(sorted((alone.orbit.highest, -alone.orbit.lowest)), rel=1e-9)
        assert peaks.max() == pytest.approx(found.orbit.highest, rel=1e-12)
        assert peaks.min() == pytest.approx(found.orbit.lowest, rel=1e-12)
