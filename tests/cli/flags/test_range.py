"""The one axis of a diagram."""

import pytest

from rocksteady import Block
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.range import Range, range_of
from rocksteady.errors import InputError
from tests.every import every

BARE = BlockFlags(restitution="0.8")
SIZED = BlockFlags(width_m="0.4", height_m="1.2")


def shaken(amplitude: str, ratio: str) -> ShakingFlags:
    return ShakingFlags(amplitude=amplitude, frequency_ratio=ratio)


@every(
    ("shaking", "block", "parameter", "fixed"),
    [
        (shaken("1:3:5", "2"), BARE, "amplitude", {"frequency_ratio": 2.0, "restitution": 0.8}),
        (shaken("2", "3:1:5"), BARE, "frequency_ratio", {"amplitude": 2.0, "restitution": 0.8}),
        (
            shaken("2", "4"),
            BlockFlags(restitution="0.7:0.9:5"),
            "restitution",
            {"amplitude": 2.0, "frequency_ratio": 4.0},
        ),
    ],
)
def test_the_parameter_that_moves_is_the_one_given_as_an_axis(
    shaking: ShakingFlags, block: BlockFlags, parameter: str, fixed: dict[str, float]
) -> None:
    span = range_of(shaking, block)
    assert span.parameter == parameter
    assert list(span.values) == sorted(span.values)
    for value in span.values:
        block_there, moved = span.at(value)
        there = {
            "amplitude": moved.amplitude,
            "frequency_ratio": moved.frequency_ratio,
            "restitution": block_there.dimensionless().restitution,
        }
        assert there == {**fixed, parameter: value}


def test_an_axis_in_g_or_hertz_is_one_too() -> None:
    span = range_of(ShakingFlags(accel_g="0.4:0.8:3", freq_hz="2"), SIZED)
    assert span.parameter == "amplitude"
    for value, accel in zip(span.values, (0.4, 0.6, 0.8), strict=True):
        block_there, moved = span.at(value)
        assert isinstance(block_there, Block)
        in_g = moved.acceleration_m_s2(block_there) / 9.80665
        assert (in_g, moved.frequency_hz(block_there)) == pytest.approx((accel, 2.0))


@every(
    ("shaking", "block", "words"),
    [
        (shaken("1", "2"), BARE, "none of -A, -W and -r is an axis"),
        (shaken("1:2:3", "1:2:3"), BARE, "2 of -A, -W and -r are axes"),
        (shaken("1:2:3", "1:2:3"), BlockFlags(restitution="0.7:0.9:5"), "3 of -A, -W and -r"),
        (shaken("2:2:3", "2"), BARE, "--amplitude/-A is 2 at both ends"),
        (shaken("1:2:3", "-1"), BARE, "frequency_ratio = -1"),
        (shaken("-1:2:3", "1"), BARE, "amplitude = -1"),
        (shaken("1", "2"), BlockFlags(restitution="0.7:1.1:5"), "restitution = 1.1"),
    ],
)
def test_what_is_no_one_axis_is_refused(
    shaking: ShakingFlags, block: BlockFlags, words: str
) -> None:
    with pytest.raises((InputError, FlagError), match=words):
        range_of(shaking, block)


def test_a_range_holds_its_block_as_it_is() -> None:
    span = range_of(shaken("1:3:5", "2"), SIZED)
    assert isinstance(span, Range)
    assert isinstance(span.body, Block)
