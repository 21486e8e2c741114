"""Tables of segments: pulses, lines between samples, and the bounds in both."""

import math

import numpy as np
import pytest

from rocksteady.kernels.core.motions import (
    CLOSED,
    FULL_TURN,
    MAVROEIDIS_PAPAGEORGIOU,
    PIECE_COLUMNS,
    RICKER,
    RICKER_ANTISYMMETRIC,
    PulseNumbers,
    fill_bounds,
    fill_lines,
    fill_pulse,
    less_whole_turns,
    ricker_at,
)
from rocksteady.kernels.core.tables import (
    ALIKE,
    CEILING,
    CONSTANT,
    DURATION,
    FREQUENCY,
    JUMP,
    SEGMENT_COLUMNS,
    SLOPE,
)
from tests.every import every
from tests.kernels.tables import Piece, table


@every("form", [CLOSED, RICKER, RICKER_ANTISYMMETRIC, MAVROEIDIS_PAPAGEORGIOU])
def test_a_table_with_too_few_rows_counts_the_segments_of_a_pulse(form: int) -> None:
    pieces = np.ones((2 if form == CLOSED else 0, PIECE_COLUMNS))
    pulse = PulseNumbers(form, pieces, 2.0, 3.0, 1e-3, 4.0, 2.0, 0.0, 0.9)
    count, needed = fill_pulse(pulse, np.zeros((0, SEGMENT_COLUMNS)))
    assert count - needed == 2.0 if form == CLOSED else 0.0 < count - needed < 9.0
    filled = np.zeros((count + 3, SEGMENT_COLUMNS))
    assert fill_pulse(pulse, filled) == (count, needed)
    assert (filled[:count, DURATION] > 0.0).all()
    assert not filled[count:].any()


@every("form", [RICKER, RICKER_ANTISYMMETRIC])
def test_lines_along_a_wavelet_end_on_it_and_join(form: int) -> None:
    amplitude, reach = 2.5, 4.5
    pulse = PulseNumbers(
        form, np.zeros((0, PIECE_COLUMNS)), amplitude, 3.0, 1e-3, reach, 1.0, 0.0, 1.0
    )
    count, _ = fill_pulse(pulse, np.zeros((0, SEGMENT_COLUMNS)))
    lines = np.zeros((count, SEGMENT_COLUMNS))
    fill_pulse(pulse, lines)
    ends = lines[:, CONSTANT] + lines[:, SLOPE] * lines[:, DURATION]
    assert ends[:-1] == pytest.approx(lines[1:, CONSTANT], abs=1e-14)
    size = ricker_at(form == RICKER_ANTISYMMETRIC, -reach)
    assert lines[0, CONSTANT] == pytest.approx(amplitude * size, rel=1e-12)
    assert np.abs(lines[:, CONSTANT]).max() == pytest.approx(amplitude, rel=1e-2)


def test_lines_between_samples_are_followed_by_a_still_base() -> None:
    lines = np.zeros((4, SEGMENT_COLUMNS))
    fill_lines(np.array([1.0, -3.0, 0.5, 2.0]), 0.5, lines)
    assert lines[:, DURATION].tolist() == [0.5, 0.5, 0.5, math.inf]
    assert lines[:3, SLOPE].tolist() == [-8.0, 7.0, 3.0]


def test_bounds_hold_from_each_segment_on_and_samples_alike_are_counted() -> None:
    pieces = [Piece(1.0, 0.2, -0.5), Piece(1.0, 0.1), Piece(0.5, 0.0, 3.0), Piece(0.5, 0.3)]
    plain = table(*pieces, Piece(2.0, amplitude=0.7, frequency=2.0), Piece())
    for jump in (None, 3, 0):
        segments = plain.copy()
        if jump is not None:
            segments[jump, JUMP] = 0.1
        fill_bounds(segments)
        for row, own in enumerate(segments):
            later = plain[row:, CEILING].max()
            assert own[CEILING] == (math.inf if jump is not None and row < jump else later)
        alike = [1.0, 0.0, 1.0, 0.0, 0.0, 0.0]
        assert segments[:, ALIKE].tolist() == ([*alike[:2], *[0.0] * 4] if jump == 3 else alike)
        assert segments[4, FREQUENCY] == 2.0


def test_an_angle_less_whole_turns_is_the_exact_remainder() -> None:
    rng = np.random.default_rng(3)
    angles = [k * math.pi for k in range(-300, 300)]
    for scale in (1.0, 30.0, 1e6):
        angles += rng.uniform(-scale, scale, 300).tolist()
    assert [less_whole_turns(x) for x in angles] == [math.remainder(x, FULL_TURN) for x in angles]
