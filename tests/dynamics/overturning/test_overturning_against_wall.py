"""Pulses, kicks and free rocking of a block against a wall: closed forms, laws, time histories."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rocksteady import (
    Block,
    DimensionlessBlock,
    Execution,
    Linear,
    Nonlinear,
    Pulse,
    State,
    Status,
    Still,
    find_fatal_kicks,
    find_overturning_windows,
    simulate,
)
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import free_rocking_peaks, free_rocking_period, overturning_amplitude
from rocksteady.model.equations import Model
from rocksteady.show.plots.overturning import plot_overturning
from tests.every import every

FACADE = Block.rectangle(width=0.3, height=3.0).against_wall()
RATIOS = [1.5, 2.0, 4.0]
AWAY = 1e-6
"""How far from a border the fate is looked at."""


def against_wall(e: float) -> DimensionlessBlock:
    return DimensionlessBlock(restitution=e, one_sided=True)


def unit(shape: str, *, reverse: bool = False) -> Pulse:
    return Pulse(shape=shape, amplitude=1.0, frequency_ratio=1.0, reverse=reverse)


@pytest.mark.slow
@every(
    ("block", "model"),
    [(against_wall(0.5), Linear()), (against_wall(0.9), Linear()), (FACADE, Nonlinear())],
)
@every(
    "pulse",
    [unit("one-sine"), unit("one-cosine"), unit("one-cosine", reverse=True)],
)
def test_borders_are_those_of_time_histories(block: Any, model: Model, pulse: Pulse) -> None:
    found = find_overturning_windows(block, pulse, RATIOS, within=(1.0, 12.0), model=model)
    looked = 0
    for place, ratio in enumerate(RATIOS):

        def falls(size: float, ratio: float = ratio) -> tuple[bool, int]:
            shaken = replace(pulse, amplitude=size, frequency_ratio=ratio)
            run = simulate(block, shaken, model=model)
            assert run.status in (Status.OVERTURNED, Status.AT_REST)
            return run.status is Status.OVERTURNED, len(run.impacts)

        windows = found.at(place)
        for window, before in zip(windows, [None, *windows], strict=False):
            touches = before is not None and before.high == window.low
            assert window.side == 1
            assert falls(window.low * (1.0 + AWAY)) == (True, window.impacts)
            assert touches or not falls(window.low * (1.0 - AWAY))[0]
            middle = 0.5 * (window.low + window.high)
            assert falls(middle) == (True, window.impacts)
            looked += 1
        if windows and not windows[-1].endless:
            assert not falls(windows[-1].high * (1.0 + AWAY))[0]
        # Between the windows it stands.
        for one, other in pairwise(windows):
            if other.low > one.high * (1.0 + 1e-3):
                assert not falls(0.5 * (one.high + other.low))[0]
    assert looked >= 3


@every("e", [0.0, 0.5, 1.0])
def test_a_wall_takes_what_throws_the_block_there(e: float) -> None:
    block, halves = against_wall(e), overturning_amplitude("half-sine", RATIOS)
    towards = find_overturning_windows(block, unit("half-sine"), RATIOS)
    assert towards.first == pytest.approx(halves, rel=1e-9)
    away = find_overturning_windows(block, unit("half-sine", reverse=True), RATIOS)
    assert np.isnan(away.first).all()
    # The first half of a reversed one-sine pulse is lost on the wall: what is left is a half sine.
    reversed_sine = find_overturning_windows(block, unit("one-sine", reverse=True), RATIOS)
    assert reversed_sine.first == pytest.approx(halves, rel=1e-9)
    # Without an impact it is the free block that falls.
    sine = find_overturning_windows(block, unit("one-sine"), RATIOS)
    free = overturning_amplitude("one-sine", RATIOS)
    for place in range(len(RATIOS)):
        (low,) = (window.low for window in sine.at(place) if window.impacts == 0)
        assert low == pytest.approx(free[place], rel=1e-9)


def test_executors_agree_to_the_bit() -> None:
    def windows(run: Execution) -> Any:
        return find_overturning_windows(FACADE, "one-cosine", RATIOS, run=run).to_dataset()

    assert windows(Execution(executor="serial")).identical(windows(Execution(workers=2)))


def test_no_closed_form_is_drawn_of_a_reversed_pulse() -> None:
    def drawn(block: DimensionlessBlock, *, reverse: bool) -> list[str]:
        pulse = unit("one-sine", reverse=reverse)
        axes = plot_overturning(find_overturning_windows(block, pulse, RATIOS))
        legend = axes.get_legend()
        return [text.get_text() for text in legend.get_texts()] if legend is not None else []

    assert any("closed form" in text for text in drawn(against_wall(0.5), reverse=False))
    assert not any("closed form" in text for text in drawn(against_wall(0.5), reverse=True))
    free = DimensionlessBlock(restitution=0.5)
    assert any("closed form" in text for text in drawn(free, reverse=True))


@every(
    ("e", "u", "v"),
    [(0.3, 0.0, 0.0), (0.3, 0.5, 0.0), (0.7, 0.2, 0.3), (0.7, 0.9, -0.3), (1.0, 0.9, -0.05)],
)
def test_the_linear_closed_forms_of_kicks(e: float, u: float, v: float) -> None:
    block = against_wall(e)
    kicks = find_fatal_kicks(block, start=State(angle=u, velocity=v))
    onwards = 1.0 - u - v
    if u == 0.0:  # the wall holds it
        assert kicks.signed[0, 0] == pytest.approx(onwards, rel=1e-11)
        assert math.isnan(kicks.signed[0, 1])
        return
    # Thrown back it strikes the wall with the speed of (v - k)^2 + u (2 - u), and goes off with e
    # of it, which is to be above 1.
    back = v + math.sqrt(1.0 / e**2 - u * (2.0 - u))
    assert kicks.signed[0] == pytest.approx([onwards, -back], rel=1e-11)


def test_off_a_wall_that_keeps_all_no_kick_into_it_is_fatal() -> None:
    kicks = find_fatal_kicks(against_wall(0.0), start=State(angle=0.5, velocity=0.0))
    assert kicks.signed[0, 0] == pytest.approx(0.5, rel=1e-11)
    assert math.isnan(kicks.signed[0, 1])


@pytest.mark.parametrize("u", [0.1, 0.5])
def test_the_nonlinear_kick_back_is_the_barrier_of_energy(u: float) -> None:
    alpha, e = FACADE.alpha, FACADE.restitution
    kicks = find_fatal_kicks(FACADE, start=State(angle=u, velocity=0.0))
    # Speeds d(theta)/d(pt): 2 sin(alpha/2) at the wall lifts it over the top, e of the landing's.
    needed = (2.0 * math.sin(0.5 * alpha) / e) ** 2
    gained = 2.0 * (math.cos(alpha * (1.0 - u)) - math.cos(alpha))
    turned = math.sqrt(needed - gained) / alpha
    share = math.cos(alpha * (1.0 - u))  # of a jump of the base, which turns the block
    assert kicks.signed[0, 1] == pytest.approx(-turned / share, rel=1e-10)


def test_a_kick_on_the_way_is_that_of_the_state_there() -> None:
    block, pulse = against_wall(0.6), Pulse(shape="one-sine", amplitude=1.5, frequency_ratio=3.0)
    times = np.array([1.6, 2.4])
    kicks = find_fatal_kicks(block, motion=pulse, times_pt=times)
    run = simulate(block, pulse)
    assert kicks.angle == pytest.approx(run(times).angle, abs=1e-12)
    assert (kicks.angle >= 0.0).all()
    # From a still base on, the closed form of the state there holds.
    after = times > 2.0 * math.pi / 3.0
    assert after.any()
    onwards = 1.0 - kicks.angle - kicks.velocity
    assert kicks.signed[after, 0] == pytest.approx(onwards[after], rel=1e-9)


@pytest.mark.parametrize("start", [State(angle=-0.2, velocity=0.0), State(angle=0.0, velocity=-1)])
def test_a_start_behind_the_wall_is_refused(start: State) -> None:
    with pytest.raises(ModelError, match="positive side alone"):
        find_fatal_kicks(against_wall(0.5), start=start)


def peaks_of(run: Any) -> NDArray[np.float64]:
    """Return the largest angle between impacts."""
    impacts = run.impacts.pt
    fine = [np.linspace(one, other, 2001) for one, other in pairwise(impacts)]
    return np.array([run(pt).angle.max() for pt in fine])


@every("e", [0.5, 0.8])
@every("alpha", [None, 0.2])
def test_free_rocking_is_in_closed_form(e: float, alpha: float | None) -> None:
    block: Any = against_wall(e)
    model: Model = Linear()
    if alpha is not None:
        block = Block.from_p(alpha=alpha, p=2.0).against_wall(e)
        model = Nonlinear()
    run = simulate(block, Still(), start=State(angle=0.7, velocity=0.0), model=model)
    peaks = free_rocking_peaks(0.7, e, 6, alpha=alpha, one_sided=True)
    assert peaks_of(run)[:5] == pytest.approx(peaks[1:6], rel=1e-6)
    halves = free_rocking_period(peaks, alpha=alpha, one_sided=True)
    # The first fall is half a flight; each peak after it has a flight of its own.
    impacts = 0.5 * halves[0] + np.concatenate([[0.0], np.cumsum(halves[1:])])
    assert run.impacts.pt[:6] == pytest.approx(impacts[:6], rel=1e-9)
    # All flights together last until it rests: those beyond 400 are shorter than 1e-30.
    every = free_rocking_period(
        free_rocking_peaks(0.7, e, 400, alpha=alpha, one_sided=True), alpha=alpha, one_sided=True
    )
    assert run.rest_time_pt == pytest.approx(0.5 * every[0] + every[1:].sum(), rel=1e-8)


def test_off_a_wall_without_rebound_there_is_one_peak() -> None:
    peaks = free_rocking_peaks(0.7, 0.0, 3, one_sided=True)
    assert peaks.tolist() == pytest.approx([0.7, 0.0, 0.0, 0.0])
    free = free_rocking_period([0.2, 0.7])
    assert free_rocking_period([0.2, 0.7], one_sided=True) == pytest.approx(0.5 * free)
    with pytest.raises(InputError, match=r"\(0, 1\]"):
        free_rocking_peaks(0.7, 0.0, 3)
    with pytest.raises(InputError, match=r"\[0, 1\]"):
        free_rocking_peaks(0.7, 1.1, 3, one_sided=True)
