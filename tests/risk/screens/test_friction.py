"""Uplift and friction against the equations of motion, solved for the forces at the edge."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block
from rocksteady.risk.screens.friction import (
    first_motion,
    needed_friction,
    uplift_acceleration_g,
)
from rocksteady.seismic.measures.free_sides import first_side

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
    found = needed_friction(Block.rectangle(width=0.3, height=1.8), 0.35)
    assert found == pytest.approx(published, rel=1e-13)
    assert round(found, 4) == 0.2115


@given(
    st.floats(0.05, 0.9),
    st.floats(0.05, 0.9),
    st.floats(0.2, 3.0),
    st.floats(0.05, 2.0),
    st.floats(1.01, 8.0),
    st.floats(-0.6, 0.6),
)
def test_the_need_is_the_ratio_of_the_forces_at_the_edge_of_any_block(
    left: float, right: float, height: float, gyration: float, excess: float, upwards: float
) -> None:
    block = Block.asymmetric(
        left=left * height, right=right * height, height=2.0 * height, gyration=gyration,
        restitution=0.5,
    )  # fmt: skip
    pga = excess * max(left, right) * (1.0 + upwards)
    ratios = []
    for distance in (left * height, right * height):
        h, v, turning = forces(distance, height, gyration, pga, upwards)
        assert turning > 0.0
        ratios.append(h / v)
    assert needed_friction(block, pga, upwards) == pytest.approx(max(ratios), rel=1e-9)


@given(st.floats(0.05, 0.6), st.floats(0.3, 4.0))
def test_at_uplift_the_need_is_the_slope_and_it_grows_from_there(slope: float, size: float) -> None:
    block = Block.rectangle(width=slope * size, height=size)
    needs = [needed_friction(block, slope * factor) for factor in (0.5, 1.0, 1.3, 2.0, 5.0)]
    assert needs[0] == pytest.approx(0.5 * slope)
    assert needs[1] == pytest.approx(slope, rel=1e-12)
    assert needs == sorted(needs)
    assert needs[-1] > slope


def test_a_floor_that_rises_holds_the_block_down() -> None:
    block = Block.rectangle(width=0.32, height=1.8)
    slope = 0.32 / 1.8
    assert uplift_acceleration_g(block) == pytest.approx(slope)
    assert uplift_acceleration_g(block, 0.3) == pytest.approx(1.3 * slope)
    assert uplift_acceleration_g(block, -0.3) == pytest.approx(0.7 * slope)
    on_the_moon = Block.rectangle(width=0.32, height=1.8, gravity=1.62)
    assert uplift_acceleration_g(on_the_moon) == pytest.approx(1.62 / G * slope)


def test_the_side_of_the_smaller_angle_lifts_first() -> None:
    block = Block.asymmetric(left=0.3, right=0.1, height=1.0)
    assert first_side(block) == block.negative
    assert uplift_acceleration_g(block) == pytest.approx(0.2)


def test_motions_change_where_shentons_borders_are() -> None:
    block = Block.rectangle(width=0.3, height=1.8)
    a, need = 1.0 / 6.0, needed_friction(block, 0.35)
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
    assert math.isclose(needed_friction(block, 0.4), 0.4)
