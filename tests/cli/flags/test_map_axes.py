"""The axes of a map, and the block, shaking and start at the first value of each."""

from typing import Any

import pytest

from rocksteady import Block, DimensionlessBlock, State
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.block_and_shaking import BlockFlags, ShakingFlags
from rocksteady.cli.flags.map_axes import MapStartFlags, map_case
from rocksteady.dynamics.parameters import AXES
from rocksteady.errors import InputError
from tests.every import every

BARE = BlockFlags(restitution="0.8")


def shaken(amplitude: str = "2", ratio: str = "3") -> ShakingFlags:
    return ShakingFlags(amplitude=amplitude, frequency_ratio=ratio)


def test_axes_come_in_one_order_however_they_are_given() -> None:
    start = MapStartFlags(phase="0:3:4", start="-1:1:5,0:0.5:6")
    case = map_case(shaken("3:1:3", "2:4:2"), BlockFlags(restitution="0.7:0.9:7"), start)
    assert list(case.axes) == [name for name in AXES if name in case.axes]
    sizes = {name: len(values) for name, values in case.axes.items()}
    assert sizes == {
        "amplitude": 3,
        "frequency_ratio": 2,
        "restitution": 7,
        "phase": 4,
        "angle": 5,
        "velocity": 6,
    }
    assert case.cells == 3 * 2 * 7 * 4 * 5 * 6
    # The first value is the one given first, not the least.
    assert (case.motion.amplitude, case.motion.frequency_ratio) == (3.0, 2.0)
    assert case.body == DimensionlessBlock(restitution=0.7)
    assert case.start.of(2.0) == State(angle=-1.0, velocity=0.0)
    assert case.fixed == {}


def test_the_sizes_of_a_block_are_axes_and_bring_housners_restitution() -> None:
    flags = BlockFlags(width_m="0.3:0.6:4", height_m="1.2")
    case = map_case(ShakingFlags(accel_g="0.4", freq_hz="2"), flags, MapStartFlags())
    assert list(case.axes) == ["width"]
    assert case.fixed == {
        "height": 1.2,
        "acceleration_m_s2": pytest.approx(0.4 * 9.80665),
        "frequency_hz": 2.0,
        "restitution": "housner",
    }
    assert case.body == Block.rectangle(width=0.3, height=1.2)
    measured = BlockFlags(width_m="0.3:0.6:4", height_m="1.2", restitution="housner*0.9")
    case = map_case(shaken(), measured, MapStartFlags())
    assert case.fixed["restitution"] == ("housner", 0.9)
    own = BlockFlags(width_m="0.3:0.6:4", height_m="1.2", restitution="0.9")
    assert "restitution" not in map_case(shaken(), own, MapStartFlags()).fixed
    # A block that stays as it is has its sizes in itself.
    fixed = BlockFlags(width_m="0.3", height_m="1.2")
    case = map_case(shaken("1:2:3"), fixed, MapStartFlags())
    assert not {"width", "height"} & case.fixed.keys()
    assert "restitution" not in case.fixed


def test_a_velocity_by_tau_is_one_by_pivot_time_where_the_frequency_stays() -> None:
    case = map_case(shaken("1:2:3", "4"), BARE, MapStartFlags(start="0.25,tau=-0.5:0.5:3"))
    assert case.axes["velocity"] == [-2.0, 0.0, 2.0]
    assert case.fixed["angle"] == 0.25
    upright = map_case(shaken("1", "2:4:3"), BARE, MapStartFlags(start="0.25,tau=0"))
    assert upright.fixed["velocity"] == 0.0, "no velocity is none in any unit"


@every(
    ("shaking", "block", "start", "words"),
    [
        (shaken(), BARE, {}, "none of -A, -W, -r and the other flags of the case is an axis"),
        (shaken("1", "2:4:3"), BARE, {"start": "0.25,tau=0.5"}, "is another velocity in each"),
        (
            ShakingFlags(amplitude="2", freq_hz="2"),
            BlockFlags(width_m="0.3:0.6:4", height_m="1.2"),
            {"start": "0.25,tau=0.5"},
            "is another velocity in each",
        ),
        (shaken(), BARE, {"start": "-1:1:5,"}, "it must be a number"),
        (shaken(), BARE, {"start": "one,two"}, "it is not two numbers"),
        (shaken(), BARE, {"start": "nan,0"}, "its numbers must be finite"),
        (shaken(), BARE, {"phase": "0:1"}, "it must be a number or an axis"),
        (shaken(), BARE, {"start": "steady", "phase": "0:1:3"}, "decides its phase"),
    ],
)
def test_what_makes_no_map_is_refused(
    shaking: ShakingFlags, block: BlockFlags, start: dict[str, Any], words: str
) -> None:
    with pytest.raises((InputError, FlagError), match=words):
        map_case(shaking, block, MapStartFlags(**start))


def test_an_error_shows_the_axis_that_was_typed_and_not_its_first_value() -> None:
    start = MapStartFlags(start="steady", phase="0:1:3")
    with pytest.raises(FlagError, match="--phase = '0:1:3'"):
        map_case(shaken(), BARE, start)
