"""Symmetric steady states of the nonlinear model, and starts on them."""

import math
from contextlib import suppress

import numpy as np
import pytest

from rocksteady import (
    Block,
    Harmonic,
    Steady,
    find_attractor,
    find_orbits,
    map_attractors,
    simulate,
)
from rocksteady.dynamics.history.start import initial_march
from rocksteady.errors import ModelError
from rocksteady.formulas import steady_states
from rocksteady.model.equations import Nonlinear
from tests.dynamics.full_integrator import impacts_by_integrator
from tests.every import every

POINTS = [
    # alpha, amplitude, frequency ratio, restitution, order, branch
    (0.3, 2.0, 4.0, 0.8, 1, 1),
    (0.6, 2.0, 4.0, 0.9, 1, 1),
    (0.2, 2.0, 1.9, 0.8, 1, 1),
    (0.4, 1.0, 2.0, 0.8, 1, 2),
    (0.3, 2.0, 4.0, 0.8, 3, 1),
    (0.3, 2.0, 4.0, 0.8, 3, 2),
    (0.15, 4.0, 6.0, 0.8, 3, 1),
]
points = every(("alpha", "a", "w", "delta", "order", "branch"), POINTS)


def body(alpha: float, delta: float) -> Block:
    return Block.from_p(alpha=alpha, p=1.7, restitution=delta)


def begun(block: Block, shaking: Harmonic, start: Steady) -> tuple[float, float]:
    """Return phase and velocity of a start."""
    sides = Nonlinear().sides(block)
    _, march = initial_march(start, block.dimensionless(), shaking, sides)
    return march.half_cycles * math.pi + march.phase, march.velocity


@points
def test_half_a_cycle_later_the_motion_is_its_mirror_image(
    alpha: float, a: float, w: float, delta: float, order: int, branch: int
) -> None:
    block, shaking = body(alpha, delta), Harmonic(amplitude=a, frequency_ratio=w)
    start = Steady(branch=branch, order=order, kick=1e-12)
    run = simulate(block, shaking, start=start, cycles=order, model=Nonlinear())
    first = run(0.0).velocity
    half = order * math.pi / w
    np.testing.assert_allclose(run.impacts.pt[0], half, rtol=1e-9)
    np.testing.assert_allclose(run.impacts.velocity_after[0], -first, rtol=1e-9)
    # An adaptive integrator of the equations in seconds finds the same.
    phase = run.motion.phase if isinstance(run.motion, Harmonic) else math.nan
    (landing,) = impacts_by_integrator(
        lambda t: a * alpha * math.sin(w * block.p * t + phase),
        block=block,
        angle=0.0,
        velocity=float(first) * alpha * block.p,
        breaks=(0.0, 2.0 * half / block.p),
        longest_step=0.05 / block.p,
        count=1,
    )
    assert landing == pytest.approx(half / block.p, abs=1e-8)


@points
def test_it_goes_to_the_linear_one_with_the_square_of_the_slenderness(
    alpha: float, a: float, w: float, delta: float, order: int, branch: int
) -> None:
    shaking = Harmonic(amplitude=a, frequency_ratio=w)
    states = steady_states(a, w, delta, order=order)
    linear = float(states.phase[branch - 1]), float(states.velocity[branch - 1])
    errors = []
    for slender in (0.02 * alpha, 0.04 * alpha):
        start = Steady(branch=branch, order=order, kick=1e-15)
        found = begun(body(slender, delta), shaking, start)
        apart = np.angle(np.exp(1j * (found[0] - linear[0]))), found[1] - linear[1]
        errors.append(np.hypot(*apart))
    assert errors[1] / errors[0] == pytest.approx(4.0, rel=0.02)


@every("side", [1, -1])
@every(
    ("alpha", "a", "w", "order", "branch"),
    [(0.4, 1.0, 2.0, 1, 2), (0.3, 2.0, 4.0, 3, 2), (0.2, 2.0, 1.9, 1, 1)],
)
def test_an_unstable_one_is_left_along_its_own_direction(
    alpha: float, a: float, w: float, order: int, branch: int, side: int
) -> None:
    block, shaking = body(alpha, 0.8), Harmonic(amplitude=a, frequency_ratio=w)
    steady = Steady(branch=branch, order=order, kick=1e-15, side=side)
    phase, velocity = begun(block, shaking, steady)
    kicked = begun(block, shaking, Steady(branch=branch, order=order, kick=1e-6, side=side))
    away = np.array([kicked[0] - phase, kicked[1] / velocity - 1.0])
    assert np.hypot(*away) == pytest.approx(1e-6, rel=1e-6)
    assert np.sign(away[1]) == side
    # Half a cycle later the difference has grown by the multiplier, in the same direction.
    start = Steady(branch=branch, order=order, kick=1e-6, side=side)
    run = simulate(block, shaking, start=start, cycles=order, model=Nonlinear())
    later = np.array(
        [
            run.impacts.pt[0] * w + kicked[0] - phase - order * math.pi,
            -run.impacts.velocity_after[0] / velocity - 1.0,
        ]
    )
    rate = later @ away / (away @ away)
    assert abs(rate) > 1.0
    np.testing.assert_allclose(later, rate * away, rtol=0.0, atol=2e-3 * np.hypot(*later))
    listed = [
        orbit
        for orbit in find_orbits(block, shaking, max_period=order, seeds=1, model=Nonlinear())
        if (orbit.branch, orbit.period) == (branch, order)
    ]
    assert rate**2 == pytest.approx(listed[0].multipliers[0].real, rel=1e-3)


def test_the_attractor_from_it_is_the_steady_state_itself() -> None:
    block, shaking = body(0.3, 0.8), Harmonic(amplitude=2.0, frequency_ratio=4.0)
    found = find_attractor(block, shaking, start=Steady(), model=Nonlinear())
    assert found.orbit is not None
    assert found.orbit.highest == pytest.approx(0.181107, abs=1.2e-6)
    assert found.after <= 17  # known at the first look
    assert found.model == Nonlinear()


def test_cells_of_a_map_begin_where_a_single_motion_does() -> None:
    block = body(0.3, 0.8)
    for branch in (1, 2):
        start = Steady(branch=branch)
        axes = {"amplitude": [0.05, 0.6, 1.0, 2.0], "frequency_ratio": [1.9, 3.0]}
        found = map_attractors(block, axes=axes, start=start, model=Nonlinear())
        meanings = found.kind.attrs["flag_meanings"].split()
        for i, a in enumerate(axes["amplitude"]):
            for j, w in enumerate(axes["frequency_ratio"]):
                shaking = Harmonic(amplitude=a, frequency_ratio=w)
                kind = meanings[int(found.kind[i, j])]
                try:
                    alone = find_attractor(block, shaking, start=start, model=Nonlinear())
                except ModelError:
                    assert kind == "no-start"
                    continue
                assert kind == alone.kind.value
                if alone.orbit is not None:
                    assert float(found.highest[i, j]) == pytest.approx(
                        alone.orbit.highest, rel=1e-12
                    )


@every("w", [0.7, 2.0, 8.0])
def test_both_branches_end_together_in_a_fold(w: float) -> None:
    # The fold of a stocky block lies at a higher amplitude than that of the linear model.
    block, fold = body(0.5, 0.8), float(steady_states(1.0, w, 0.8).existence)
    there = []
    for share in (1.00001, 1.01, 1.03, 1.05, 1.07, 1.1, 1.2):
        pair = []
        shaking = Harmonic(amplitude=share * fold, frequency_ratio=w)
        for branch in (1, 2):
            with suppress(ModelError):
                pair.append(begun(block, shaking, Steady(branch=branch, kick=1e-15)))
        assert len(pair) in {0, 2}
        there.append(len(pair))
        if pair:
            (one, first), (two, second) = pair
            assert first != pytest.approx(second, rel=1e-3)
            assert one != pytest.approx(two, abs=1e-3)
    assert there == sorted(there)
    assert (there[0], there[-1]) == (0, 2)
    with pytest.raises(ModelError, match=r"alpha 0\.5 there is none of order 1"):
        begun(block, Harmonic(amplitude=1.00001 * fold, frequency_ratio=w), Steady())


def test_what_the_linear_model_has_not_is_refused_with_its_reason() -> None:
    block = body(0.3, 0.8)
    with pytest.raises(ModelError, match="there is none of order 1"):
        simulate(
            block,
            Harmonic(amplitude=0.05, frequency_ratio=4.0),
            start=Steady(),
            model=Nonlinear(),
        )
    with pytest.raises(ModelError, match="through the floor"):
        simulate(
            block,
            Harmonic(amplitude=2.0, frequency_ratio=4.0),
            start=Steady(branch=2),
            model=Nonlinear(),
        )
    unlike = Block.asymmetric(left=0.3, right=0.5, height=1.6)
    with pytest.raises(ModelError, match="is asymmetric has none"):
        simulate(
            unlike, Harmonic(amplitude=2.0, frequency_ratio=4.0), start=Steady(), model=Nonlinear()
        )
