"""Windows of the full equations: published numbers, brute force, an integrator, slender blocks."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Pulse,
    Status,
    find_overturning_windows,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.core.clock import segment_start
from rocksteady.kernels.core.tables import LEAN, OVERTURNED, RATE, March
from rocksteady.kernels.core.tuples import Kept, Tables, Until
from rocksteady.kernels.march.march import march
from rocksteady.model.equations import Model, Nonlinear
from rocksteady.overturning import OverturningWindows
from tests.dynamics.full_integrator import impacts_by_integrator
from tests.every import every
from tests.strategies import sample_size

Floats = NDArray[np.float64]
G = 9.81
CABINET = Block.from_p(alpha=0.25, p=2.14, restitution=0.9, gravity=G)


def nonlinear(block: Block, shape: str, ratio: float, top: float = 20.0) -> OverturningWindows:
    return find_overturning_windows(
        block,
        shape,
        [ratio],
        model=Nonlinear(),
        within=(1.0, top),
        run=Execution(executor="serial"),
    )


# ---------------------------------------------------------------------- published numbers


def test_h7_the_half_sine_that_overturns_a_block() -> None:
    block = Block.rectangle(width=0.4, height=1.2, gravity=G)
    ((low, _),) = nonlinear(block, "half-sine", 2.0 * math.pi / block.p).intervals(0)
    assert low * block.alpha == pytest.approx(0.574725, abs=1.1e-6)


@pytest.mark.parametrize(
    ("shape", "accel_g"), [("one-sine", 0.468727), ("one-cosine", 0.625845)]
)  # M1, M2
def test_m1_m2_the_smallest_accelerations_of_a_block(shape: str, accel_g: float) -> None:
    block = Block.rectangle(width=1, height=3, restitution=0.85, gravity=G)
    found = nonlinear(block, shape, 2.0 * math.pi / block.p)
    assert found.first[0] * block.alpha == pytest.approx(accel_g, abs=5.1e-7)
    assert found.at(0)[0].impacts == 1


def test_m3_one_cosine_with_housners_restitution() -> None:
    block = Block.from_p(alpha=math.radians(15.0), p=2.0, gravity=G)
    found = nonlinear(block, "one-cosine", 0.5 * math.pi)
    assert found.first[0] * block.alpha == pytest.approx(0.3150340189, abs=1e-9)


def test_z2_one_sine_overturns_between_two_amplitudes_and_above_a_third() -> None:
    first, second = nonlinear(CABINET, "one-sine", 5.0).at(0)
    # Printed are 3.03238, 6.74283 and 7.49301: see test_simulate_nonlinear_published.
    assert (first.impacts, first.side, second.impacts, second.side) == (1, -1, 0, 1)
    for border, expected in (
        (first.low, 3.0323392),
        (first.high, 6.743019),
        (second.low, 7.4929997),
    ):
        assert border == pytest.approx(expected, rel=1e-7)


@pytest.mark.slow
def test_z4_a_higher_frequency_and_the_end_of_the_window_after_one_impact() -> None:
    found = nonlinear(CABINET, "one-sine", 15.7 / 2.14)
    assert found.at(0)[0].impacts == 1
    # Printed is 2.2235 g; an integrator agrees with ours to the last digits, below.
    assert found.first[0] * 0.25 == pytest.approx(2.2235, abs=4e-4)
    there, gone = (nonlinear(CABINET, "one-sine", w).at(0) for w in (7.5, 7.6))
    assert [window.impacts for window in there] == [1, 0]
    assert [window.impacts for window in gone] == [0]


# ---------------------------------------------------------------------- independent


@pytest.mark.slow
@every(
    ("shape", "ratio", "block", "which"),
    [
        ("one-sine", 15.7 / 2.14, CABINET, 0),
        ("one-sine", 5.0, CABINET, 1),
        ("one-cosine", 1.5, Block.from_p(alpha=0.5, p=2.0, restitution=0.8), 0),
        (
            "one-sine",
            3.0,
            Block.from_alphas(positive=0.2, negative=0.3, p=2.0, restitution=(0.9, 0.85)),
            0,
        ),
    ],
)
def test_an_integrator_falls_inside_a_border_and_lands_again_outside(
    shape: str, ratio: float, block: Block, which: int
) -> None:
    window = nonlinear(block, shape, ratio).at(0)[which]
    omega = ratio * block.p
    shift = 0.5 * math.pi if shape == "one-cosine" else 0.0
    length = 2.0 * math.pi / omega

    def impacts(amplitude: float) -> int:
        def base(t: float) -> float:
            return amplitude * block.alpha * math.sin(omega * t + shift) if t < length else 0.0

        lift = 0.0
        if shift == 0.0:
            lift = math.asin(math.tan(block.alpha) / (amplitude * block.alpha)) / omega
        times = impacts_by_integrator(
            base,
            block=block,
            angle=1e-300,
            velocity=0.0,
            breaks=[lift, length, length + 45.0 / block.p],
            longest_step=length / 8.0,
            count=window.impacts + 2,
        )
        return len(times)

    # Near the border a block hovers for some ln(1e8)/p before it decides.
    assert impacts(window.low * (1.0 + 1e-8)) == window.impacts
    assert impacts(window.low * (1.0 - 1e-8)) > window.impacts


def brute_force(block: Block, model: Model, pulse: Pulse) -> Callable[[float, float], bool]:
    """Whether a block falls, by a march with the still base and the march's own proofs."""
    table, sides = Nonlinear().lower(block, pulse).segments, model.sides(block)
    half, phase = segment_start(table, 0)

    def falls(amplitude: float, ratio: float) -> bool:
        own = sides.copy()
        own[:, LEAN] /= amplitude
        own[:, RATE] /= ratio
        start, rest = March(0, 0.0, 0.0, 0, half, phase, 0, 0), 1e-3 / amplitude / ratio
        rows, peaks = np.zeros((0, 8)), np.zeros(0)
        code, _ = march(Tables(table, own), start, Until(0, 1e15, rest, 10**5), Kept(rows, peaks))
        return code == OVERTURNED

    return falls


@pytest.mark.slow
@every("seed", range(sample_size(6, 1)))
def test_brute_force_finds_no_other_window(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shape = ("one-sine", "one-cosine", "type-c1", "triangle", "versed-sine", "one-cosine")[seed]
    ratio, alpha = float(np.exp(rng.uniform(0.0, 1.8))), float(rng.uniform(0.05, 0.6))
    delta = float(rng.uniform(0.4, 1.0))
    block = Block.from_p(alpha=alpha, p=2.0, restitution=delta)
    if seed % 2:
        block = Block.from_alphas(
            positive=alpha, negative=1.3 * alpha, p=2.0, restitution=(delta, 0.9 * delta)
        )
    pulse = Pulse(shape=shape, amplitude=1.0, frequency_ratio=1.0)
    falls = brute_force(block, Nonlinear(), pulse)
    found = nonlinear(block, shape, ratio)
    assert not found.undecided.any()
    spread = np.exp(rng.uniform(0.0, math.log(20.0), sample_size(1500, 10)))
    for a in spread.tolist():
        assert falls(a, ratio) == any(low <= a <= high for low, high in found.intervals(0)), a


@pytest.mark.parametrize("shape", ["one-sine", "one-cosine"])
def test_time_histories_agree_on_both_sides_of_every_border(shape: str) -> None:
    found = nonlinear(CABINET, shape, 2.0, 8.0)
    for window in found.at(0):
        for a, inside in ((window.low * (1.0 + 1e-9), True), (window.low * (1.0 - 1e-9), False)):
            pulse = Pulse(shape=shape, amplitude=a, frequency_ratio=2.0)
            run = simulate(CABINET, pulse, model=Nonlinear())
            if inside:
                assert run.status is Status.OVERTURNED
                assert len(run.impacts) == window.impacts
            else:
                assert run.status is Status.AT_REST


@pytest.mark.parametrize(("shape", "ratio"), [("one-sine", 4.0), ("one-cosine", 2.0)])
def test_towards_slender_blocks_the_windows_are_the_linear_ones(shape: str, ratio: float) -> None:
    linear = find_overturning_windows(DimensionlessBlock(restitution=0.9), shape, [ratio])
    change = []
    for alpha in (0.02, 0.04):
        block = Block.from_p(alpha=alpha, p=2.0, restitution=0.9)
        found = nonlinear(block, shape, ratio)
        assert [one.impacts for one in found.at(0)] == [one.impacts for one in linear.at(0)]
        change.append((found.low[0] - linear.low[0]) / alpha**2)
    # The difference goes with alpha squared.
    np.testing.assert_allclose(change[1], change[0], rtol=0.03)


def test_where_a_block_lies_before_the_pulse_ends_no_window_is_lost() -> None:
    # A very strong reversal raises a stocky block that has all but come to lie on its side.
    block = Block.from_p(alpha=0.6, p=2.0, restitution=0.9)
    found = nonlinear(block, "one-sine", 3.0, 200.0)
    falls = brute_force(
        block, Nonlinear(), Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=1.0)
    )
    for a in np.geomspace(1.0, 200.0, sample_size(1500, 10)).tolist():
        assert falls(a, 3.0) == any(low <= a <= high for low, high in found.intervals(0)), a
    assert len(found.at(0)) > 1


# ---------------------------------------------------------------------- bad input


def test_a_block_without_slenderness_is_refused() -> None:
    with pytest.raises(ModelError, match="slenderness"):
        find_overturning_windows(
            DimensionlessBlock(restitution=0.9), "one-sine", [2.0], model=Nonlinear()
        )
    with pytest.raises(InputError, match="there are two equations of motion"):
        find_overturning_windows(CABINET, "one-sine", [2.0], model="exact")  # type: ignore[arg-type]


def test_where_nobody_says_the_search_goes_beyond_uplift() -> None:
    flat = Block.from_p(alpha=1.5, p=1.0, restitution=0.5)
    uplift = math.tan(1.5) / 1.5  # 9.4
    one = find_overturning_windows(
        flat, "rectangle", [0.5], model=Nonlinear(), run=Execution(executor="serial")
    )
    assert 2.0 * uplift < one.within[1] == 20.0
    flatter = Block.from_p(alpha=1.56, p=1.0, restitution=0.5)
    other = find_overturning_windows(
        flatter, "rectangle", [0.5], model=Nonlinear(), run=Execution(executor="serial")
    )
    assert other.within[1] == pytest.approx(2.0 * math.tan(1.56) / 1.56)  # where 20 lifts nothing
    assert other.intervals(0)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1.99734, 5.39448])
def test_no_window_of_a_wavelet_is_lost_between_its_rough_and_its_fine_lines(ratio: float) -> None:
    block = Block.from_p(alpha=0.2, p=1.0, restitution=0.9)
    intervals = nonlinear(block, "ricker", ratio).intervals(0)
    for amplitude in np.geomspace(1.02, 19.9, 12).tolist():
        pulse = Pulse(shape="ricker", amplitude=amplitude, frequency_ratio=ratio)
        fallen = simulate(block, pulse, model=Nonlinear()).status == Status.OVERTURNED
        assert fallen == any(low <= amplitude <= high for low, high in intervals)
