"""From motions to tables: records sample by sample, and which segments are alike."""

import math

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Linear, Piecewise, Record
from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.core.tables import ALIKE, DURATION
from rocksteady.model.linear_tables import only_side, record_table, segment_table
from rocksteady.motions import Segment

BLOCK = Block.from_p(alpha=0.2, p=2.5, restitution=0.8)
VALUES = np.array([0.5, 1.5, -3.0, 2.0, 0.4])


def as_pieces(record: Record, block: Block) -> Piecewise:
    """Return the record as segments, put together one by one."""
    a, h = record.acceleration_m_s2 / block.uplift_acceleration, record.dt_s * block.p
    return Piecewise(
        pieces=tuple(
            Segment(duration=h, constant=here, slope=(there - here) / h)
            for here, there in zip(a[:-1].tolist(), a[1:].tolist(), strict=True)
        )
    )


def test_a_record_is_the_table_of_its_segments() -> None:
    record = Record(acceleration_m_s2=VALUES, dt_s=0.02)
    np.testing.assert_array_equal(
        segment_table(record, BLOCK), segment_table(as_pieces(record, BLOCK))
    )


def test_without_a_block_a_table_is_in_seconds_and_metres() -> None:
    table = record_table(Record(acceleration_m_s2=VALUES, dt_s=0.02))
    assert table[:, DURATION].tolist() == [0.02] * 4 + [math.inf]
    np.testing.assert_allclose(table[:-1, 2], VALUES[:-1])
    np.testing.assert_allclose(table[:-1, 2] + 0.02 * table[:-1, 3], VALUES[1:])
    np.testing.assert_allclose(table[:, 7], [3.0, 3.0, 3.0, 2.0, 0.0])


def test_segments_alike_are_as_long_and_without_sinusoid_and_jump() -> None:
    line, longer = Segment(duration=0.1, slope=1.0), Segment(duration=math.nextafter(0.1, 1.0))
    kick, swing = Segment(duration=0.1, jump=0.5), Segment(duration=0.1, frequency=1.0)
    for pieces, alike in (
        ((), [0]),
        ((line,), [0, 0]),
        ((line, line, line), [2, 1, 0, 0]),
        ((line, line, longer, line, line), [1, 0, 0, 1, 0, 0]),
        ((kick, line, kick, line), [1, 0, 1, 0, 0]),
        ((line, swing, line, line), [0, 0, 1, 0, 0]),
        ((longer, longer, Segment(duration=math.inf)), [1, 0, 0]),
    ):
        assert segment_table(Piecewise(pieces=pieces))[:, ALIKE].tolist() == alike
    shaking = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    assert segment_table(shaking)[:, ALIKE].tolist() == [0.0]


def test_a_record_needs_a_block_with_sizes() -> None:
    record = Record(acceleration_m_s2=VALUES, dt_s=0.02)
    for block in (None, DimensionlessBlock(restitution=0.8)):
        with pytest.raises(ModelError, match=r"^motion = Record\(.*give a Block"):
            segment_table(record, block)


def test_samples_beyond_what_the_block_can_be_asked_for_are_refused() -> None:
    with pytest.raises(InputError, match=r"^dt_s = 1000000\.0 .*at most 400000"):
        segment_table(Record(acceleration_m_s2=VALUES, dt_s=1e6), BLOCK)
    with pytest.raises(InputError, match=r"^acceleration_m_s2 = 1e\+60 "):
        segment_table(Record(acceleration_m_s2=np.array([0.0, 1e60]), dt_s=0.01), BLOCK)


def test_the_one_side_of_a_block_against_a_wall_is_named_by_its_sign() -> None:
    free, leaning = (
        Linear().sides(DimensionlessBlock(restitution=0.6, one_sided=wall))
        for wall in (False, True)
    )
    assert (only_side(free), only_side(leaning), only_side(leaning[::-1])) == (0, 1, -1)
