"""Uplift and friction against the equations of motion, solved for the forces at the edge."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block
from rocksteady.errors import InputError
from rocksteady.risk.screens.friction import (
    first_motion,
    lifts,
    needed_friction,
    uplift_acceleration_g,
)

G = 9.80665


def forces(
    distance: float, height: float, gyration: float, pga_g: float, upwards_g: float = 0.0
) -> tuple[float, float, float]:
    """Return friction, normal force and rotation a unit mass has when it starts to turn.

    Newton's and Euler's equations of the mass centre, three unknowns: H, V and theta''.
    """
    # Turning by theta about the edge at the origin moves the centre (d, h) by theta (-h, d).
    matrix = np.array(
        [[1.0, 0.0, height], [0.0, 1.0, -distance], [height, -distance, -(gyration**2)]]
    )
    right = np.array([pga_g * G, G * (1.0 + upwards_g), 0.0])
    h, v, turning = np.linalg.solve(matrix, right)
    return float(h), float(v), float(turning)


def test_shentons_worked_value() -> None:
    a, ratio = 1.0 / 6.0, 0.35
    published = (ratio * (1.0 + 4.0 * a * a) + 3.0 * a) / (4.0 + a * a + 3.0 * ratio * a)
    found = needed_friction(Block.rectangle(width=0.3, height=1.8), 0.35).largest
    assert found == pytest.approx(published, rel=1e-13)
    assert round(found, 4) == 0.2115


@given(
    st.floats(0.05, 0.9),
    st.floats(0.05, 0.9),
    st.floats(0.2, 3.0),
    st.floats(0.05, 2.0),
    st.floats(1.01, 8.0),
    st.floats(0.0, 0.9),
)
def test_the_need_is_the_ratio_of_the_forces_at_the_edge_of_any_block(
    left: float, right: float, height: float, gyration: float, excess: float, vertical: float
) -> None:
    """Of the base motion in the worst direction: no other up to that magnitude needs more."""
    block = Block.asymmetric(
        left=left * height, right=right * height, height=2.0 * height, gyration=gyration,
        restitution=0.5,
    )  # fmt: skip
    pga = excess * min(left, right)  # of the other side perhaps below uplift: it turns about both
    need = needed_friction(block, pga, vertical).at_uplift
    ratios = []
    for part in (-1.0, -0.6, 0.0, 1.0):
        upwards, lifting = part * vertical, []
        for distance in (left * height, right * height):
            h, v, _ = forces(distance, height, gyration, pga, upwards)
            lifting.append(h / v)
        ratios.append(max(lifting))
        assert uplift_acceleration_g(block, vertical) <= min(left, right) * (1.0 + upwards) + 1e-12
        assert need >= ratios[-1] * (1.0 - 1e-9)
    assert need == pytest.approx(ratios[0], rel=1e-9)


def test_a_frame_needs_the_ratio_of_the_forces_on_all_its_columns() -> None:
    width, height, cap, pga = 0.6, 3.3, 1.5, 0.41
    frame = Block.frame(columns=4, cap_mass_ratio=cap, width=width, height=height)
    # Of columns of unit mass and a cap that moves twice as far as their mass centres.
    square = 0.25 * (width**2 + height**2)
    pull = (1.0 + 2.0 * cap) * G * 0.5 * (pga * height - width)
    turning = pull / ((4.0 / 3.0 + 4.0 * cap) * square)
    across = (1.0 + cap) * pga * G - (1.0 + 2.0 * cap) * 0.5 * height * turning
    down = (1.0 + cap) * G + (1.0 + 2.0 * cap) * 0.5 * width * turning
    need = needed_friction(frame, pga)
    assert need.largest == need.at_uplift == pytest.approx(across / down, rel=1e-12)
    assert round(need.largest, 4) == 0.2099
    assert first_motion(frame, pga, 0.25) == "rocks"


@given(st.floats(0.05, 0.6), st.floats(0.3, 4.0))
def test_at_uplift_the_need_is_the_slope_and_it_grows_from_there(slope: float, size: float) -> None:
    block = Block.rectangle(width=slope * size, height=size)
    needs = [
        needed_friction(block, slope * factor).at_uplift for factor in (0.5, 1.0, 1.3, 2.0, 5.0)
    ]
    assert needs[0] == pytest.approx(0.5 * slope)
    assert needs[1] == pytest.approx(slope, rel=1e-12)
    assert needs == sorted(needs)
    assert needs[-1] > slope


def test_vertical_motion_has_no_sign_and_lifts_sooner() -> None:
    block = Block.rectangle(width=0.32, height=1.8)
    slope = 0.32 / 1.8
    assert uplift_acceleration_g(block) == pytest.approx(slope)
    assert uplift_acceleration_g(block, 0.3) == pytest.approx(0.7 * slope)
    on_the_moon = Block.rectangle(width=0.32, height=1.8, gravity=1.62)
    assert uplift_acceleration_g(on_the_moon) == pytest.approx(1.62 / G * slope)
    same = needed_friction(on_the_moon, 0.35 * 1.62 / G)
    assert same == pytest.approx(needed_friction(block, 0.35), rel=1e-12)
    for call in (
        lambda: needed_friction(on_the_moon, 0.1, 0.2),
        lambda: first_motion(on_the_moon, 0.1, 0.5, 0.2),
    ):
        with pytest.raises(InputError, match=r"vertical_g = 0\.2 .* below 0\.165"):
            call()


def test_motions_change_where_shentons_borders_are() -> None:
    block = Block.rectangle(width=0.3, height=1.8)
    a, need = 1.0 / 6.0, needed_friction(block, 0.35).largest
    assert first_motion(block, 0.35, need * 1.0001) == "rocks"
    assert first_motion(block, 0.35, need * 0.9999) == "slides and rocks"
    assert first_motion(block, 0.35, a * 0.9999) == "slides"
    assert first_motion(block, a * 0.999, 0.3) == "rest"
    assert first_motion(block, 0.1, 0.0999) == "slides"
    assert first_motion(block, 0.1, 0.1001) == "rest"


def test_an_asymmetric_block_counts_by_its_worse_direction() -> None:
    block = Block.asymmetric(left=0.1, right=0.3, height=1.0)  # slopes .2 and .6
    assert first_motion(block, 0.4, 1.0) == "rocks"  # one side lifts, the other rests
    assert first_motion(block, 0.4, 0.35) == "slides"  # the other needs .4 to rest
    need = needed_friction(block, 0.4)
    assert 0.4 < need.at_impact < need.at_uplift < 0.6  # once it turns about the other edge
    assert first_motion(block, 0.4, need.at_uplift * 0.9999) == "slides and rocks"
    assert first_motion(block, 0.4, need.at_uplift * 1.0001) == "rocks"
    assert first_motion(block, 0.19, 0.2) == "rest"
    assert tuple(needed_friction(block, 0.19)) == (0.19, 0.0)


@given(
    st.floats(0.05, 0.9),
    st.floats(0.05, 0.9),
    st.floats(0.2, 3.0),
    st.floats(0.1, 1.0),
)
def test_an_impact_needs_the_ratio_of_its_impulses(
    left: float, right: float, height: float, ratio: float
) -> None:
    """From the velocity of the mass centre before and after: it turns about one edge, then both."""
    block = Block.asymmetric(
        left=left * height, right=right * height, height=2.0 * height, restitution=ratio
    )
    needs = []
    for sign, pivot, struck in ((1.0, left, right), (-1.0, right, left)):
        # About an edge at (-sign d, 0) the centre moves by omega (-h, sign d).
        before = -sign * np.array([-height, sign * pivot * height])  # rotation comes back to 0
        after = -sign * ratio * np.array([-height, -sign * struck * height])
        across, up = after - before
        assert up > 0.0
        needs.append(abs(across) / up)
    found = needed_friction(block, 2.0 * max(left, right))
    assert found.at_impact == pytest.approx(max(needs), rel=1e-9)
    if left == right:
        assert max(needs) == pytest.approx((1.0 - ratio) / (1.0 + ratio) / left)
    assert found.largest == max(found)
    assert found.cause == ("impacts" if max(needs) > found.at_uplift else "uplift")
    assert needed_friction(block.against_wall(0.5), 2.0).at_impact == 0.0


def test_impacts_that_lose_much_need_more_friction_than_uplift_and_at_rest_there_are_none() -> None:
    soft = Block.rectangle(width=0.3, height=1.8, restitution=0.8)
    need = needed_friction(soft, 0.2)
    assert need.at_impact == pytest.approx(6.0 * 0.2 / 1.8)
    assert (need.largest, need.cause) == (need.at_impact, "impacts")
    assert [first_motion(soft, 0.2, mu) for mu in (0.66, 0.67)] == ["slides and rocks", "rocks"]
    assert needed_friction(soft, 0.1).at_impact == 0.0
    housner = Block.rectangle(width=0.3, height=1.8)
    assert needed_friction(housner, 0.2).cause == "uplift"


@pytest.mark.parametrize(
    ("width", "height"), [(0.3, 1.5), (0.31, 1.55), (0.4, 2.0), (0.33, 1.65), (0.7, 3.5)]
)
def test_a_peak_at_uplift_lifts_no_block_whatever_its_size(width: float, height: float) -> None:
    """All have a slope of 0.2, but for rounding, on either side of it."""
    block = Block.rectangle(width=width, height=height)
    assert not lifts(block, 0.2)
    assert first_motion(block, 0.2, 0.5) == "rest"
    need = needed_friction(block, 0.2)
    assert need.at_uplift == pytest.approx(0.2)
    assert need.at_impact == 0.0
    assert lifts(block, 0.2 * (1.0 + 1e-8))
