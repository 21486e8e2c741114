"""Maps of attractors: every cell is what one gets at that point alone."""

import math
from typing import Any

import numpy as np
import pytest

from rocksteady import (
    DimensionlessBlock,
    Harmonic,
    InputError,
    ModelError,
    Rest,
    State,
    Steady,
    attractor,
    attractor_map,
)
from rocksteady.dynamics.settled import KIND_FLAGS, piece_size

BLOCK = DimensionlessBlock(restitution=0.8)
AMPLITUDES = np.linspace(0.4, 6.0, 12)
RATIOS = np.linspace(0.6, 8.0, 11)


@pytest.mark.parametrize(
    ("start", "phase", "side"),
    [
        (Rest(), 0.0, 1),
        (State(angle=0.2, velocity=-0.1), 5.0, 1),
        (State(angle=0.0, velocity=-0.3), 1.0, 1),
        (Steady(), 0.0, -1),
        (Steady(branch=2, order=3, kick=1e-3), 0.0, 1),
    ],
)
def test_every_cell_is_the_attractor_at_that_point(start: Any, phase: float, side: int) -> None:
    found = attractor_map(
        BLOCK, AMPLITUDES, RATIOS, start=start, phase=phase, side=side, cycles=300
    )
    assert found.kind.dims == ("amplitude", "frequency_ratio")
    for a in AMPLITUDES:
        for w in RATIOS:
            cell = found.sel(amplitude=a, frequency_ratio=w)
            shaking = Harmonic(amplitude=a, frequency_ratio=w, phase=phase)
            kind = KIND_FLAGS[int(cell.kind)]
            try:
                alone = attractor(BLOCK, shaking, start=start, side=side, cycles=300)
            except ModelError:
                assert kind == "no-start"
                assert math.isnan(cell.highest)
                continue
            assert kind == alone.kind.value
            assert int(cell.period) == (alone.period or 0)
            orbit = alone.orbit
            impacts = 0 if orbit is None else (-1 if orbit.impacts is None else orbit.impacts)
            assert int(cell.impacts) == impacts
            peaks = (math.nan, math.nan) if alone.peaks is None else alone.peaks
            assert np.array_equal([cell.highest, cell.lowest], peaks, equal_nan=True)
            assert np.array_equal(float(cell.lyapunov), alone.lyapunov, equal_nan=True)
            assert int(cell.after) == alone.after


def test_the_codes_of_the_kinds_are_kept_for_ever() -> None:
    # Stored maps hold them.
    assert KIND_FLAGS == {
        0: "symmetric",
        1: "unsymmetric",
        2: "rest",
        3: "overturned",
        4: "aperiodic",
        5: "undecided",
        6: "no-start",
    }


def test_executors_agree_to_the_bit_and_progress_is_told() -> None:
    told: list[int] = []
    one = attractor_map(BLOCK, AMPLITUDES, RATIOS, cycles=300, done=told.append)
    other = attractor_map(BLOCK, AMPLITUDES, RATIOS, cycles=300, executor="serial")
    assert one.identical(other)
    assert sum(told) == 12 * 11
    assert one.attrs["restitution"] == 0.8
    assert one.attrs["start"] == "Rest()"


def test_the_longer_motions_are_followed_the_fewer_make_a_piece() -> None:
    assert [piece_size(cycles) for cycles in (1, 500, 2000, 20_000, 1_000_000)] == [
        64,
        64,
        32,
        3,
        1,
    ]


@pytest.mark.parametrize(
    ("amplitude", "ratio", "more", "valid"),
    [
        ([-1.0], [2.0], {}, "amplitude = -1.0 is not valid"),
        ([1.0], [0.0], {}, "frequency_ratio = 0.0 is not valid"),
        ([], [2.0], {}, "one or more real numbers"),
        ([1.0], [2.0], {"start": "rest"}, "must be a Rest"),
        ([1.0], [2.0], {"side": 0}, "must be 1 or -1"),
        ([1.0], [2.0], {"cycles": 0}, "whole number"),
        ([1.0], [2.0], {"phase": math.nan}, "phase"),
    ],
)
def test_bad_arguments_are_refused(
    amplitude: Any, ratio: Any, more: dict[str, Any], valid: str
) -> None:
    with pytest.raises(InputError, match=valid):
        attractor_map(BLOCK, amplitude, ratio, **more)
