"""Flags of block and shaking: the nouns that they are, and what is refused."""

from typing import Any

import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Pulse
from rocksteady.cli.console import terminal
from rocksteady.cli.console.refusals import FlagError
from rocksteady.cli.flags.block_and_shaking import (
    BlockFlags,
    PulseFlags,
    ShakingFlags,
    equations_for,
    refuse_of_linear,
)
from rocksteady.cli.flags.parsing import MOST_AXIS_POINTS
from rocksteady.errors import InputError
from rocksteady.model.equations import Linear, Nonlinear
from rocksteady.risk import DescribedObject
from tests.cli.program import ran_once, rocksteady
from tests.every import every

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.rectangle(width=0.4, height=1.2)
AGAINST_WALL = DimensionlessBlock(restitution=0.0, one_sided=True)
ON_THE_MOON = Block.rectangle(width=0.4, height=1.2, gravity=1.62)
LEANING = Block.asymmetric(left=0.15, right=0.25, height=1.2)


@every(
    ("flags", "block"),
    [
        ({"restitution": "0.8"}, BARE),
        (
            {"restitution": "0.8,0.9"},
            DimensionlessBlock(restitution=0.8, negative_restitution=0.9),
        ),
        ({"width_m": "0.4", "height_m": "1.2"}, SIZED),
        (
            {"width_m": "0.4", "height_m": "1.2", "restitution": "0.9", "gravity_m_s2": 9.8},
            Block.rectangle(width=0.4, height=1.2, restitution=0.9, gravity=9.8),
        ),
        (
            {"alpha_rad": "0.2", "radius_m": "1.5", "restitution": "housner"},
            Block.from_radius(alpha=0.2, radius=1.5),
        ),
        ({"alpha_rad": "0.2", "p_rad_s": "2"}, Block.from_p(alpha=0.2, p=2.0)),
        ({"left_m": 0.15, "right_m": 0.25, "height_m": "1.2"}, LEANING),
        (
            {
                "left_m": 0.15,
                "right_m": 0.25,
                "height_m": "1.2",
                "gyration_m": 0.5,
                "restitution": "0.8,0.9",
            },
            Block.asymmetric(
                left=0.15, right=0.25, height=1.2, gyration=0.5, restitution=(0.8, 0.9)
            ),
        ),
        ({"restitution": "0", "one_sided": True}, AGAINST_WALL),
        ({"width_m": "0.4", "height_m": "1.2", "one_sided": True}, SIZED.against_wall()),
        (
            {"width_m": "3", "height_m": "1", "restitution": "0", "one_sided": True},
            Block.rectangle(width=3.0, height=1.0, restitution=1.0).against_wall(0.0),
        ),
        (
            {"block": "statue-on-plinth", "restitution": "housner*0.9", "one_sided": True},
            Block.named("statue-on-plinth").against_wall(("housner", 0.9)),
        ),
        (
            {"width_m": "1.6", "height_m": "9.6", "columns": 1, "cap_mass_ratio": 2.0},
            Block.frame(columns=1, cap_mass_ratio=2.0, width=1.6, height=9.6),
        ),
        (
            {"width_m": "1.6", "height_m": "9.6", "columns": 4, "cap_mass_ratio": 2.0},
            Block.frame(columns=4, cap_mass_ratio=2.0, width=1.6, height=9.6),
        ),
        (
            {"block": "gas-cylinder", "columns": 2, "cap_mass_ratio": 1.0, "restitution": ".9,.8"},
            Block.named("gas-cylinder").capped(
                columns=2, cap_mass_ratio=1.0, restitution=(0.9, 0.8)
            ),
        ),
        (
            {
                "alpha_rad": "0.2",
                "p_rad_s": "2",
                "columns": 3,
                "cap_mass_ratio": 0.5,
                "restitution": "0.4",
                "one_sided": True,
            },
            Block.from_p(alpha=0.2, p=2.0)
            .capped(columns=3, cap_mass_ratio=0.5, restitution=1.0)
            .against_wall(0.4),
        ),
        ({"block": "tso-wong-1989"}, Block.named("tso-wong-1989")),
        (
            {"block": "tso-wong-1989", "restitution": "0.9"},
            Block.named("tso-wong-1989", restitution=0.9),
        ),
    ],
)
def test_flags_describe_the_block_of_the_constructors(
    flags: dict[str, Any], block: Block | DimensionlessBlock
) -> None:
    assert BlockFlags(**flags).described() == block


@every(
    ("flags", "words"),
    [
        ({}, "--restitution/-r is not given"),
        ({"gravity_m_s2": 9.8, "restitution": "0.8"}, "without a block gravity has no meaning"),
        ({"width_m": "0.4"}, "^no block is described by --width-m alone"),
        ({"columns": 4, "width_m": "0.4", "height_m": "2"}, "^no frame .* by --columns alone: it"),
        (
            {"columns": 4, "cap_mass_ratio": 1.0},
            "^no frame is described by --columns and --cap-mass-ratio alone",
        ),
        (
            {
                "columns": 4,
                "cap_mass_ratio": 1.0,
                "width_m": "0.4",
                "height_m": "2",
                "mass_centre_height_m": 0.9,
            },
            "--mass-centre-height-m .* a frame's columns have their mass in mid-height",
        ),
        (
            {"columns": 4, "cap_mass_ratio": -1.0, "width_m": "0.4", "height_m": "2"},
            "cap_mass_ratio = -1.0 .* give the mass of the cap over that of all columns",
        ),
        (
            {"width_m": "0.4", "radius_m": "1"},
            "^no block is described by --width-m --radius-m alone",
        ),
        (
            {"left_m": 0.15, "height_m": "1.2"},
            "^no block is described by --height-m --left-m alone",
        ),
        (
            {"block": "tso-wong-1989", "height_m": "1.2"},
            "^no block is described by --block --height-m alone",
        ),
        ({"width_m": "0.3:0.4:3", "height_m": "1.2"}, "--width-m has 3 values"),
        ({"width_m": "-1", "height_m": "1.2"}, "width = -1"),
        ({"left_m": -0.1, "right_m": 0.25, "height_m": "1.2"}, "left = -0.1"),
        ({"restitution": "1.2"}, "restitution = 1.2"),
    ],
)
def test_what_describes_no_block_is_refused(flags: dict[str, Any], words: str) -> None:
    with pytest.raises((InputError, FlagError), match=words):
        BlockFlags(**flags).described()


def test_flags_with_axes_have_a_block_at_the_first_values() -> None:
    flags = BlockFlags(width_m="0.4:0.2:3", height_m="1.2", restitution="0.9:0.7:3")
    assert flags.sizes == {"width": [0.4, pytest.approx(0.3), 0.2], "height": [1.2]}
    assert flags.restitutions == [0.9, pytest.approx(0.8), 0.7]
    first = flags.at_first().described()
    assert first == Block.rectangle(width=0.4, height=1.2, restitution=0.9)
    assert BlockFlags(restitution="0.8").restitutions == []


@pytest.mark.parametrize("block", [SIZED, LEANING, ON_THE_MOON])
def test_shaking_in_si_is_what_the_block_feels(block: Block) -> None:
    flags = ShakingFlags(accel_g="0.2:0.6:3", freq_hz="2")
    amplitudes, (ratio,) = flags.of(block)
    for accel, amplitude in zip((0.2, 0.4, 0.6), amplitudes, strict=True):
        felt = Harmonic.from_si(block, acceleration_m_s2=accel * 9.80665, frequency_hz=2.0)
        assert (amplitude, ratio) == pytest.approx((felt.amplitude, felt.frequency_ratio))
    mixed = ShakingFlags(amplitude="2", freq_hz="2").at(block, phase=0.5)
    assert mixed == Harmonic(amplitude=2.0, frequency_ratio=ratio, phase=0.5)


@every(
    ("flags", "block", "words"),
    [
        ({"accel_g": "0.4", "frequency_ratio": "2"}, BARE, "g and Hz need a block"),
        ({"amplitude": "2", "freq_hz": "2"}, BARE, "g and Hz need a block"),
        ({"amplitude": "2"}, BARE, "of --frequency-ratio/-W and --freq-hz, neither given"),
        ({"frequency_ratio": "2"}, SIZED, "of --amplitude/-A and --accel-g, neither given"),
        (
            {"amplitude": "2", "accel_g": "0.4", "freq_hz": "2"},
            SIZED,
            "--amplitude/-A and --accel-g are both given",
        ),
        ({"accel_g": "-0.4", "freq_hz": "2"}, SIZED, "--accel-g = -0.4"),
        ({"accel_g": "0.4:-0.4:3", "freq_hz": "2"}, SIZED, "--accel-g = -0.4"),
        ({"amplitude": "1:2:1001", "frequency_ratio": "1:2:1000"}, BARE, "1000000 points together"),
        ({"amplitude": "1:2:3", "frequency_ratio": "2"}, BARE, "--amplitude/-A has 3 values"),
    ],
)
def test_what_is_no_shaking_is_refused(
    flags: dict[str, Any], block: Block | DimensionlessBlock, words: str
) -> None:
    with pytest.raises((InputError, FlagError), match=words):
        ShakingFlags(**flags).at(block)


def test_axes_may_have_as_many_points_together_as_one_alone() -> None:
    amplitudes, ratios = ShakingFlags(amplitude="1:2:1000", frequency_ratio="1:2:1000").of(BARE)
    assert len(amplitudes) * len(ratios) == MOST_AXIS_POINTS


def test_a_pulse_has_the_size_of_the_shaking() -> None:
    size = Harmonic(amplitude=2.0, frequency_ratio=3.0)
    flags = PulseFlags(pulse="mavroeidis-papageorgiou", oscillations=2.5)
    assert flags.given
    assert flags.of(size, phase=1.0) == Pulse(
        shape="mavroeidis-papageorgiou",
        amplitude=2.0,
        frequency_ratio=3.0,
        oscillations=2.5,
        phase=1.0,
    )
    assert not PulseFlags().given
    with pytest.raises(FlagError, match="without --pulse it has no meaning"):
        _ = PulseFlags(oscillations=2.5).given


def test_the_nonlinear_model_needs_a_slenderness_and_has_flags_of_its_own() -> None:
    assert equations_for("nonlinear", SIZED) == Nonlinear()
    assert equations_for("linear", BARE) == Linear()
    assert equations_for(None, SIZED) == Nonlinear()
    assert equations_for(None, BARE) == Linear()
    assert equations_for(None, SIZED, 1e-8) == Nonlinear(tolerance=1e-8)
    with pytest.raises(FlagError, match="the full equations need the block's slenderness"):
        equations_for("nonlinear", BARE)
    refuse_of_linear("nonlinear", "vertical", "up.AT2")
    refuse_of_linear("linear", "vertical", None)
    with pytest.raises(FlagError, match="only the nonlinear model has it"):
        equations_for("linear", SIZED, 1e-8)
    with pytest.raises(FlagError, match="only the nonlinear model has it"):
        refuse_of_linear("linear", "vertical", "up.AT2")


@every(("model", "suggested"), [(None, True), ("nonlinear", False)])
def test_full_equations_that_nobody_asked_for_suggest_the_linear_ones(
    model: str | None, suggested: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    terminal.drop_notes()
    equations_for(model, SIZED)
    terminal.say_suggestion()
    assert capsys.readouterr().err.startswith("rocksteady: --model linear") is suggested


def test_only_flags_that_are_given_count() -> None:
    assert not ShakingFlags().given
    assert ShakingFlags(freq_hz="2").given
    assert not BlockFlags().given
    assert BlockFlags(gravity_m_s2=9.8).given
    words = str(BlockFlags(restitution="0.8,0.9").refuse_sides("they must be alike", "give one"))
    assert words.startswith("--restitution/-r makes a block whose sides differ: ")


def test_metres_per_second_squared_are_g() -> None:
    block = Block.rectangle(width=0.4, height=1.6)
    (one,), _ = ShakingFlags(accel_m_s2="3", freq_hz="2").of(block)
    (other,), _ = ShakingFlags(accel_g=repr(3.0 / 9.80665), freq_hz="2").of(block)
    assert one == 3.0 / block.uplift_acceleration
    assert other == pytest.approx(one, rel=1e-14)
    with pytest.raises(FlagError, match="--accel-g and --accel-m-s2 are both given"):
        ShakingFlags(accel_g="0.3", accel_m_s2="3", freq_hz="2").of(block)


def test_a_mass_centre_off_the_middle_is_an_asymmetric_block() -> None:
    sized: dict[str, Any] = {"width_m": "0.5", "height_m": "1.8"}
    block = BlockFlags(**sized, offset_m=0.05).described()
    assert isinstance(block, Block)
    assert block == Block.asymmetric(left=0.3, right=0.2, height=1.8)
    assert isinstance(block, Block)
    outline = {"width_m": 0.5, "height_m": 1.8, "offset_m": 0.05}
    of_file = DescribedObject(values={"name": "statue", "geometry": outline}).block
    assert block.positive.distance == of_file.positive.distance
    assert block.negative.distance == of_file.negative.distance
    assert BlockFlags(**sized, offset_m=0.0).described() == Block.rectangle(width=0.5, height=1.8)
    low = BlockFlags(**sized, offset_m=-0.05, mass_centre_height_m=0.7).described()
    assert isinstance(low, Block)
    assert (low.positive.distance, low.negative.distance) == pytest.approx((0.2, 0.3))
    assert (low.height, low.positive.centre_height) == pytest.approx((1.8, 0.7))
    for side in (low.positive, low.negative):  # I_c of the homogeneous outline
        square = low.gravity * side.radius / side.p**2 - side.radius**2
        assert square == pytest.approx((0.5**2 + 1.8**2) / 12.0)
    edges: dict[str, Any] = {"left_m": 0.2, "right_m": 0.3, "height_m": "1.8"}
    assert BlockFlags(**edges, mass_centre_height_m=0.7).described() == low


@every(
    ("flags", "words"),
    [
        ({"width_m": "0.5", "height_m": "1.8", "offset_m": 0.25}, "--offset-m"),
        ({"width_m": "0.5", "height_m": "1.8", "mass_centre_height_m": 2.0}, "mass_centre"),
        ({"mass_centre_height_m": 0.5}, "^no block .* by --mass-centre-height-m alone"),
        (
            {"left_m": 0.2, "right_m": 0.3, "height_m": "1.8", "offset_m": 0.1},
            "^no block is described by --height-m --left-m --right-m --offset-m alone",
        ),
        ({"width_m": "-0.5", "height_m": "1.8", "offset_m": 0.1}, "width"),
        (
            {"width_m": "0.5", "offset_m": 0.1},
            "^no block is described by --width-m --offset-m alone",
        ),
        ({"offset_m": 0.1}, "^no block is described by --offset-m alone"),
        (
            {"block": "server-rack", "offset_m": 0.1},
            "^no block is described by --block --offset-m alone",
        ),
    ],
)
def test_what_has_no_mass_centre_there_is_refused(flags: dict[str, Any], words: str) -> None:
    with pytest.raises((FlagError, InputError), match=words):
        BlockFlags(**flags).described()


def test_sizes_above_50_m_are_refused_by_their_flags_in_the_words_of_object_files() -> None:
    flags: list[dict[str, Any]] = [
        {"width_m": "600", "height_m": "1800"},
        {"width_m": "0.6", "height_m": "1.8:1800:3"},
        {"alpha_rad": "0.3", "radius_m": "950"},
        {"left_m": 300.0, "right_m": 300.0, "height_m": "1.8"},
        {"width_m": "0.6", "height_m": "1.8", "mass_centre_height_m": 900.0},
    ]
    names = ("width", "height", "radius", "left", "mass-centre-height")
    for given, name in zip(flags, names, strict=True):
        with pytest.raises(InputError, match=rf"^--{name}-m = .*write 0\.6 for 600 mm.*--p-rad-s"):
            BlockFlags(**given).described()
    with pytest.raises(InputError, match=r"write 0\.6 for 600 mm"):
        DescribedObject(values={"name": "x", "geometry": {"width_m": 600.0, "height_m": 1800.0}})
    large = BlockFlags(alpha_rad="0.3", p_rad_s="0.1").described()
    assert isinstance(large, Block)
    assert large.height > 50.0


@every(
    "command",
    [
        "simulate --start 0.5,0",
        "simulate --pulse one-sine --accel-g 0.25 --freq-hz 0.5",
        "overturn --pulse one-sine --freq-hz 1",
        "overturn --kick --start 0.5,0",
        "attractor --accel-g 0.5 --freq-hz 2",
        "orbits --accel-g 0.4 --freq-hz 2",
        "bifurcate --accel-g 0.4:0.5:2 --freq-hz 1",
        "map --accel-g 0.1:0.5:3 --freq-hz 1:4:3",
        "edge --accel-g 0.3 --freq-hz 3",
        "basins --accel-g 0.4 --freq-hz 2 --angles=-1:1:5",
        "screens --pga-g 0.3",
        "assess --pga-g 0.3 --pgv-m-s 0.4",
    ],
)
@every(
    "block",
    [
        "--block statue-on-plinth",
        "--columns 1 --cap-mass-ratio 2 --width-m 1.6 --height-m 9.6",
    ],
)
def test_an_answer_names_parts_that_are_computed_as_one_body(command: str, block: str) -> None:
    ran = rocksteady(f"{command} {block}")
    assert ran.code in (0, 3), ran.err
    assert "as one body" in " ".join(ran.out.split())
    assert ran.out.count("\n") <= (12 if command.startswith("screens") else 8)  # with its rows
    alike = ran_once(f"{command} --width-m 0.6 --height-m 3")
    assert "one body" not in alike.out
