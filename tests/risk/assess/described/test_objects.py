"""Object files: what is read, and the one line for everything that is not."""

import math
from pathlib import Path
from typing import Any

import pytest

from rocksteady.errors import RocksteadyError
from rocksteady.model.blocks.block import Block
from rocksteady.risk.assess.described.objects import EXAMPLE, DescribedObject, read_object
from tests.every import every

SIZES = {"width_m": 0.32, "height_m": 1.8}


def made(geometry: dict[str, Any] | None = None, **keys: Any) -> DescribedObject:
    return DescribedObject(
        values={"name": "x", "geometry": geometry or SIZES, **keys}, source="desk.toml"
    )


def test_a_rectangle_is_that_of_its_constructor_to_the_last_bit() -> None:
    assert made().block == Block.rectangle(width=0.32, height=1.8)
    g = 1.62
    assert made(gravity_m_s2=g).block == Block.rectangle(width=0.32, height=1.8, gravity=g)
    assert made(restitution=0.8).block.restitution == 0.8


def test_slenderness_and_frequency_give_back_themselves() -> None:
    block = made({"alpha_deg": 10, "p_rad_s": 2.5}).block
    assert block.alpha == pytest.approx(math.radians(10.0), rel=1e-12)
    assert block.p == pytest.approx(2.5, rel=1e-12)
    same = made({"alpha_rad": math.radians(10.0), "p_rad_s": 2.5}).block
    assert same == block


def test_corners_have_the_ends_of_all_ranges_together_but_for_what_cannot_rock() -> None:
    ranges = {"width_m": {"low": 0.3, "high": 0.4}, "height_m": {"low": 1.2, "high": 1.8}}
    apart = [made({"width_m": w, "height_m": h}).block for w in (0.3, 0.4) for h in (1.2, 1.8)]
    assert made(ranges).corners() == tuple(apart)
    assert made().corners() == ()
    stocky = {"width_m": {"low": 0.3, "high": 0.9}, "height_m": {"low": 0.6, "high": 1.8}}
    widths = [each.width for each in made(stocky).corners()]
    assert widths == pytest.approx([0.3, 0.3, 0.9])


def test_three_ways_to_one_body() -> None:
    """An off-centre mass: by its offset, by its edges, and by inertia in place of gyration."""
    k = math.hypot(0.4, 1.2) / math.sqrt(12.0)
    one = made({"width_m": 0.4, "height_m": 1.2, "offset_m": 0.05}).block
    edges = {"left_m": 0.25, "right_m": 0.15, "mass_centre_height_m": 0.6}
    assert made(edges).block.p == pytest.approx(one.p, rel=1e-12)
    heavy = made({**edges, "mass_kg": 7.0, "inertia_kg_m2": 7.0 * k * k}).block
    for block in (made({**edges, "gyration_m": k}).block, heavy):
        assert block.positive.alpha == pytest.approx(one.positive.alpha, rel=1e-12)
        assert block.negative.alpha == pytest.approx(one.negative.alpha, rel=1e-12)
        assert block.negative.p == pytest.approx(one.negative.p, rel=1e-12)
    assert one.positive.distance > one.negative.distance  # to the right is away from the left edge


def test_the_outline_of_an_object_is_that_of_its_block() -> None:
    """By hand: what is measured of the outside stays, whatever moves edges and mass centre."""
    low = made({**SIZES, "mass_centre_height_m": 0.5, "base_width_m": 0.24, "offset_m": 0.02})
    assert low.block.height == 1.8
    assert low.block.positive.centre_height == pytest.approx(0.5)
    assert low.block.overhangs == pytest.approx((0.04, 0.04))
    assert made(SIZES).block.overhangs == (0.0, 0.0)
    edges = {"left_m": 0.25, "right_m": 0.15, "mass_centre_height_m": 0.6}
    assert made(edges).block.height == pytest.approx(1.2)
    tall = made({**edges, "height_m": 1.9})
    assert tall.block.height == 1.9
    square = (0.4**2 + 1.9**2) / 12.0  # I_c of the outline
    side = tall.block.positive
    assert 9.80665 * side.radius / side.p**2 - side.radius**2 == pytest.approx(square)
    ballasted = tall.block_of(tall.body.with_share(0.5, 0.05))
    assert ballasted.positive.centre_height == pytest.approx((0.6 + 0.5 * 0.05) / 1.5)
    assert ballasted.height == 1.9
    high = made(
        {**SIZES, "mass_centre_height_m": 1.7}
    )  # a change of the mass centre passes the top
    assert high.block_of(high.body.with_centre(1.1)).height == pytest.approx(1.87)
    frame = made({**SIZES, "columns": 4, "cap_mass_ratio": 1.0})
    assert frame.block_of(frame.body.with_centre(1.1)).height == pytest.approx(1.98)
    wider = low.block_of(low.body.wider(1.1))
    assert wider.width + sum(wider.overhangs) == pytest.approx(0.32)
    vase = {"mass_kg": 1.0, "mass_centre_height_m": 2.4}
    assert made({**SIZES, "mass_kg": 1.0}, content=vase, fixed_parts=True).block.height == 2.4
    pier = made({**SIZES, "columns": 1, "cap_mass_ratio": 2.0}, fixed_parts=True)
    assert pier.block.height == 1.8
    assert pier.block.positive.centre_height == pytest.approx((0.9 + 2.0 * 1.8) / 3.0)


def test_content_is_added_as_two_point_masses_would_be() -> None:
    """Steiner by hand: both parts about the pivot, then p = sqrt(M g R/I_0)."""
    both = made(
        {**SIZES, "mass_kg": 60.0},
        content={"mass_kg": 40.0, "mass_centre_height_m": 1.5},
        fixed_parts=True,
    ).block
    height = (60.0 * 0.9 + 40.0 * 1.5) / 100.0
    own = 60.0 * ((0.32**2 + 1.8**2) / 12.0 + 0.16**2 + 0.9**2)
    inertia = own + 40.0 * (0.16**2 + 1.5**2)
    radius = math.hypot(0.16, height)
    assert both.positive.centre_height == pytest.approx(height, rel=1e-12)
    assert both.p == pytest.approx(math.sqrt(100.0 * 9.80665 * radius / inertia), rel=1e-12)


def test_one_pier_of_a_file_is_that_of_the_constructor_with_its_whole_mass() -> None:
    """Not the frame's: mass centre and inertia of column and point, and the mass of both."""
    shape = {"columns": 1, "cap_mass_ratio": 2.0}
    described = made({**SIZES, **shape, "mass_kg": 60.0}, fixed_parts=True)
    pier = Block.frame(width=0.32, height=1.8, **shape)  # type: ignore[arg-type]
    for name in ("alpha", "radius", "p", "restitution"):
        assert getattr(described.block, name) == pytest.approx(getattr(pier, name), rel=1e-14)
    assert described.body.whole_mass_kg == pytest.approx(180.0)
    slender = made({"alpha_deg": 10, "p_rad_s": 2.5, **shape}, fixed_parts=True).block
    column = made({"alpha_deg": 10, "p_rad_s": 2.5}).block
    capped = column.capped(**shape)  # type: ignore[arg-type]
    assert slender.p == pytest.approx(capped.p, rel=1e-13)


def test_a_worn_base_is_narrower_and_its_inertia_that_of_the_outline() -> None:
    block = made({**SIZES, "base_width_m": 0.24}).block
    assert math.tan(block.alpha) == pytest.approx(0.24 / 1.8, rel=1e-12)
    inertia = (0.32**2 + 1.8**2) / 12.0 + 0.12**2 + 0.9**2
    assert block.p**2 == pytest.approx(9.80665 * block.radius / inertia, rel=1e-12)


def test_ranges_take_the_middle_and_vary_to_both_ends() -> None:
    described = made(
        {"width_m": {"low": 0.3, "high": 0.34}, "height_m": 1.8, "mass_kg": 50},
        content={"mass_kg": {"low": 0.5, "high": 50.0}, "mass_centre_height_m": 1.7},
        fixed_parts=True,
    )
    assert described.block.width == pytest.approx(0.32)
    found = {variant.label: variant.block for variant in described.variants()}
    assert list(found) == [
        "geometry.width_m 0.3", "geometry.width_m 0.34",
        "content.mass_kg 0.5", "content.mass_kg 50",
    ]  # fmt: skip
    assert found["geometry.width_m 0.3"].width == pytest.approx(0.30)
    assert found["content.mass_kg 50"].alpha < described.block.alpha
    assert found["content.mass_kg 0.5"].alpha > described.block.alpha
    assert made().variants() == ()


def test_the_example_is_read_and_is_more_slender_than_its_outline() -> None:
    example = read_object(EXAMPLE)
    assert "example" in example.name
    assert example.block.alpha < math.atan2(0.36, 1.70)
    assert len(example.sha256 or "") == 64
    assert example.summary().startswith(example.name)
    assert example.to_dict()["friction"] == {"low": 0.45, "high": 0.6}


WRONG: list[tuple[dict[str, Any], str]] = [
    ({}, "desk.toml is empty: an object has a name and a [geometry]"),
    ({"name": "x"}, "[geometry] is missing"),
    ({"geometry": SIZES}, "desk.toml: name is missing"),
    ({"name": "x", "geometry": {}}, "[geometry] has no size"),
    ({"geometry": {"width_mm": 320, "height_m": 1.8}}, "[geometry] width_mm is unknown"),
    ({"geometry": {"width_mm": 320, "height_m": 1.8}}, "columns, cap_mass_ratio; did you mean w"),
    ({"width_m": 0.3}, "desk.toml: width_m is unknown"),
    ({"width_m": 0.3}, "it belongs to [geometry]"),
    ({"zzzz": 0.3}, "; remove it"),
    ({"demand": {"pga": 0.3}}, "did you mean pga_g?"),
    ({"geometry": {"width_m": 600, "height_m": 1800}}, "write 0.6 for 600 mm"),
    ({"geometry": {**SIZES, "height_m": math.nan}}, "height_m = nan is not valid: it must lie in"),
    ({"geometry": {**SIZES, "height_m": math.inf}}, "height_m = inf is not valid"),
    ({"geometry": {**SIZES, "height_m": -1.8}}, "height_m = -1.8 is not valid"),
    ({"geometry": {**SIZES, "height_m": True}}, "height_m = True is not valid: it must be a"),
    ({"geometry": {**SIZES, "height_m": "1.8"}}, "height_m = '1.8' is not valid: it must be a num"),
    ({"geometry": {**SIZES, "height_m": [1.8]}}, "height_m = [1.8] is not valid: it must be a num"),
    ({"geometry": {**SIZES, "height_m": 10**400}}, "is not valid: it must be a number of usual"),
    ({"geometry": {**SIZES, "left_m": 0.1}}, "[geometry] has both width_m and left_m"),
    ({"geometry": {"width_m": 0.3}}, "[geometry] height_m is missing"),
    ({"geometry": {"left_m": 0.3}}, "[geometry] right_m is missing"),
    ({"geometry": {"alpha_deg": 3}}, "[geometry] p_rad_s is missing"),
    ({"geometry": {"alpha_deg": 3, "alpha_rad": 0.1, "p_rad_s": 2}}, "both alpha_rad and alpha_d"),
    ({"geometry": {"alpha_deg": 3, "p_rad_s": 2, "mass_kg": 3}}, "mass_kg does not go with alpha"),
    ({"geometry": {**SIZES, "inertia_kg_m2": 3}}, "inertia_kg_m2 needs the mass beside it"),
    ({"geometry": {**SIZES, "mass_kg": 1, "inertia_kg_m2": 3, "gyration_m": 1}}, "has both gyrat"),
    ({"geometry": {**SIZES, "offset_m": 0.2}}, "the mass centre must stand above the base, 0.16"),
    ({"geometry": {**SIZES, "base_width_m": 0.4}}, "the base is at most as wide as width_m, 0.32"),
    ({"geometry": {**SIZES, "mass_centre_height_m": 1.9}}, "it is at most height_m, 1.8"),
    ({"geometry": {"left_m": 1, "right_m": 1, "height_m": 2, "mass_centre_height_m": 2.5}},
     "mass_centre_height_m = 2.5 is not valid: it is at most height_m, 2"),
    ({"geometry": {"left_m": 1, "right_m": 1, "height_m": 2}}, "mass_centre_height_m is missing"),
    ({"geometry": {"width_m": 3.6, "height_m": 1.8}}, "[geometry] width = 3.6 is not valid"),
    ({"geometry": {**SIZES, "width_m": {"low": 0.3}}}, "[geometry] width_m has no high"),
    ({"geometry": {**SIZES, "width_m": {"low": 0.3, "hi": 1}}}, "width_m: hi is unknown: its keys"),
    ({"geometry": {**SIZES, "width_m": {"low": 2, "high": 1}}}, "low must not be above high"),
    ({"geometry": [1]}, "geometry = [1] is not valid: it must be a table of keys"),
    ({"name": 3}, "name = 3 is not valid: it must be a text; write texts in quotes"),
    ({"name": " "}, "name = ' ' is not valid: it must not be empty"),
    ({"kind": " "}, "kind = ' ' is not valid: it must not be empty"),
    ({"restitution": "hausner"}, "a factor of it as 'housner*0.965', a number or { low = ..., "),
    ({"restitution": 1.2}, "restitution = 1.2 is not valid: it must lie in (0, 1]"),
    ({"friction": {"low": 0.3, "high": 9}}, "friction = 9.0 is not valid"),
    ({"content": {"mass_kg": 10}}, "[content] mass_centre_height_m is missing: [content] needs it"),
    ({"content": {"mass_kg": 10, "mass_centre_height_m": 1}, "fixed_parts": True},
     "content needs the mass of the obj"),
    ({"content": {"mass_kg": 10, "mass_centre_height_m": 1}},
     "desk.toml: fixed_parts is not true: object and content are computed as one body"),
    ({"content": {"mass_kg": 10, "mass_centre_height_m": 1}, "fixed_parts": False},
     "add fixed_parts = true (in a table: yes) where they are fixed to each other, or describe"),
    ({"geometry": {**SIZES, "columns": 1, "cap_mass_ratio": 2}},
     "desk.toml: fixed_parts is not true: pier and point cap are computed as one body"),
    ({"fixed_parts": 1}, "fixed_parts = 1 is not valid: it must be true or false"),
    ({"demand": {"pgv_m_s": 45}}, "write 0.4 for 40 cm/s"),
    ({"demand": {"spectrum": {"period_s": [1, 2], "sa_g": [0.1], "damping": 0.05}}}, "have 2 and"),
    ({"demand": {"spectrum": {"period_s": [1, -2], "sa_g": [1, 1], "damping": 0.05}}}, "= -2.0 is"),
    ({"demand": {"place": "roof"}}, "it must be one of ground, floor; leave it out for 'ground'"),
    ({"assessment": {"draws": 2.5}}, "[assessment] draws = 2.5 is not valid: it must be a whole"),
    ({"assessment": {"draws": 0}}, "it must be a whole number from 1 to 1000"),
    ({"assessment": {"levels": 20}}, "[assessment] levels is unknown: the keys of"),
    ({"assessment": {"intensity_measure": "pga_g"}}, "[assessment] intensity_measure is unknown"),
    ({"assessment": {"damage_states": ["tilted"]}}, "damage_states = 'tilted' is not valid"),
    ({"assessment": {"replicates": 200}}, "[assessment] replicates is unknown"),
    ({"assessment": {"target_probability": 1}}, "it must lie in (0, 1)"),
    ({"assessment": {"damage_states": []}}, "there must be one or more, each of another name"),
    ({"assessment": {"damage_states": [{"name": "a", "peek": 1}]}}, "did you mean peak?"),
    ({"assessment": {"records": ""}}, "records = '' is not valid: it must not be empty"),
]  # fmt: skip


@every(("values", "line"), WRONG)
def test_what_is_wrong_is_named_in_one_line(values: dict[str, Any], line: str) -> None:
    whole = values if len(values) < 1 or "name" in values else {"name": "x", **values}
    if whole and "geometry" not in values and line != "[geometry] is missing":
        whole = {**whole, "geometry": SIZES}
    if line.startswith("desk.toml: name is missing"):
        whole = values
    with pytest.raises(RocksteadyError) as refusal:
        DescribedObject(values=whole, source="desk.toml")
    assert line in str(refusal.value)
    assert str(refusal.value).startswith("desk.toml")
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 500


@every(
    ("content", "line"),
    [
        (b"", "desk.toml is empty"),
        (b"# nothing but a remark\n", "desk.toml is empty"),
        (b"name = 'Sta\xe4tue'", "byte 12 is not UTF-8, as TOML must be; save the file as UTF-8"),
        (b"[geometry]\n[geometry]\n", "it is not TOML: Cannot declare ('geometry',) twice"),
        (b"name = 'x'\nname = 'y'\n", "it is not TOML: Cannot overwrite a value (at line 2"),
        (b"name = statue\n", "it is not TOML: Invalid value (at line 1, column 8)"),
        (b"x = " + b"[" * 5000 + b"]" * 5000, "nested or its numbers are long beyond reason"),
        (b"x = 1" + b"0" * 5000, "nested or its numbers are long beyond reason"),
        (b"x = .5", "write key = 0.5 (not .5)"),
        (b"\xef\xbb\xbfname = 'x'\n", "[geometry] is missing"),  # a byte-order mark is no fault
    ],
)
def test_a_file_that_is_none_is_refused_in_one_line(
    content: bytes, line: str, tmp_path: Path
) -> None:
    file = tmp_path / "desk.toml"
    file.write_bytes(content)
    with pytest.raises(RocksteadyError) as refusal:
        read_object(file)
    assert line in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_file_that_is_not_there_or_a_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(RocksteadyError, match=r"none.toml' is not valid: No such file"):
        read_object(tmp_path / "none.toml")
    with pytest.raises(RocksteadyError, match="Is a directory"):
        read_object(tmp_path)
