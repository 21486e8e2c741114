"""Thresholds against published numbers, energy, slender limits and scale laws."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block, Demand, screen_block
from rocksteady.results.numbers import chance
from rocksteady.risk import assess_by_formula
from rocksteady.risk.screens.thresholds import (
    circolare_rectangle,
    impulse_velocity_m_s,
    ishiyama_bounds,
    kaneko_hayashi,
    shares_at,
    velocity_number,
)

G = 9.80665


def rectangle(width: float, height: float) -> Block:
    return Block.rectangle(width=width, height=height, restitution=0.5)


@given(st.floats(0.02, 0.9), st.floats(0.1, 10.0))
def test_the_impulse_velocity_is_ishiyamas_for_rectangles(slope: float, height: float) -> None:
    block = rectangle(slope * height, height)
    alpha, radius = math.atan(slope), 0.5 * height * math.hypot(1.0, slope)
    published = math.sqrt(8.0 * G * radius / 3.0 * (1.0 - math.cos(alpha))) / math.cos(alpha)
    found = impulse_velocity_m_s(block.positive, G)
    assert found == pytest.approx(published, rel=1e-9)
    assert ishiyama_bounds(block.positive, G).pgv_m_s == pytest.approx(0.4 * published, rel=1e-9)
    assert ishiyama_bounds(block.positive, G).pga_g == pytest.approx(slope)


@given(st.floats(0.05, 0.5), st.floats(0.2, 2.0), st.floats(0.05, 1.5))
def test_the_impulse_velocity_just_lifts_the_mass_centre_over_the_edge(
    slope: float, height: float, gyration: float
) -> None:
    radius = height * math.hypot(1.0, slope)
    inertia = gyration**2 + radius**2
    block = Block.general(
        mass=1.0, inertia=inertia, radius=radius, alpha=math.atan(slope), restitution=0.5
    )
    # The base jumps: of M V the part at right angles to the edge's arm turns the block.
    turning = impulse_velocity_m_s(block.positive, G) * height / inertia
    assert 0.5 * inertia * turning**2 == pytest.approx(G * (radius - height), rel=1e-9)


def test_forty_per_cent_of_it_is_about_ten_in_centimetres() -> None:
    block = rectangle(0.10, 2.0)
    published = 10.0 * 10.0 / math.sqrt(200.0) / 100.0
    bounds = ishiyama_bounds(block.positive, G)
    assert bounds.pgv_m_s == pytest.approx(published, rel=0.03)
    assert bounds.simple_m_s == pytest.approx(published, rel=1e-14)
    # Of slender rectangles 0.4 V_i = .4 sqrt(980.665/1.5) B/sqrt(H) = 10.2277 B/sqrt(H).
    slender = ishiyama_bounds(rectangle(0.01, 2.0).positive, G)
    assert slender.simple_m_s / slender.pgv_m_s == pytest.approx(10.0 / 10.2277, abs=1e-4)


@given(st.floats(0.01, 0.02), st.floats(0.1, 10.0), st.floats(0.01, 3.0))
def test_for_slender_blocks_the_number_is_pgv_over_the_impulse_velocity(
    slope: float, height: float, pgv: float
) -> None:
    block = rectangle(slope * height, height)
    ratio = pgv / impulse_velocity_m_s(block.positive, G)
    assert velocity_number(block.positive, G, pgv) == pytest.approx(ratio, rel=2e-4)


def test_kaneko_hayashi_by_hand_in_centimetres() -> None:
    found = kaneko_hayashi(rectangle(0.45, 1.80).positive, G)
    assert found.acceleration_g == pytest.approx(0.25 * 1.25)
    assert found.velocity_m_s == pytest.approx(0.1 * 45.0 / math.sqrt(180.0) * 1.25**2.5)
    assert found.limit_hz == pytest.approx(15.6 / math.sqrt(180.0) / 1.25**1.5)
    assert found.threshold_g(0.5 * found.limit_hz) == found.acceleration_g
    speed = found.threshold_g(4.0) * G / (2.0 * math.pi * 4.0)
    assert speed == pytest.approx(found.velocity_m_s)


@given(st.floats(0.05, 0.9), st.floats(0.1, 5.0))
def test_kaneko_hayashis_two_branches_meet_to_a_thousandth(slope: float, height: float) -> None:
    found = kaneko_hayashi(rectangle(slope * height, height).positive, G)
    meeting = 2.0 * math.pi * found.limit_hz * found.velocity_m_s / G
    assert meeting == pytest.approx(found.acceleration_g, rel=1e-3)


@given(st.floats(0.05, 0.9), st.floats(0.1, 5.0), st.floats(0.1, 10.0))
def test_a_block_of_twice_the_size_has_velocities_sqrt_two_times_as_large(
    slope: float, height: float, scale: float
) -> None:
    small, large = (rectangle(slope * size, size).positive for size in (height, scale * height))
    root = math.sqrt(scale)
    one, other = kaneko_hayashi(small, G), kaneko_hayashi(large, G)
    assert other.acceleration_g == pytest.approx(one.acceleration_g)
    assert other.velocity_m_s == pytest.approx(root * one.velocity_m_s)
    assert other.limit_hz == pytest.approx(one.limit_hz / root)
    first, second = ishiyama_bounds(small, G), ishiyama_bounds(large, G)
    assert second.pgv_m_s == pytest.approx(root * first.pgv_m_s)
    assert second.pga_g == pytest.approx(first.pga_g)
    wall, big = circolare_rectangle(small, G), circolare_rectangle(large, G)
    assert big.a0_g == pytest.approx(wall.a0_g)
    assert big.t_slv_s == pytest.approx(root * wall.t_slv_s)
    assert big.d0_m == pytest.approx(scale * wall.d0_m)
    assert velocity_number(large, G, root) == pytest.approx(velocity_number(small, G, 1.0))


@pytest.mark.parametrize(
    ("factor", "a0", "slv", "slc"),
    [(1.0, 0.133333, 1.685384, 2.347499), (1.35, 0.098765, 1.958239, 2.727547)],
)
def test_the_circolares_worked_wall(factor: float, a0: float, slv: float, slc: float) -> None:
    found = circolare_rectangle(rectangle(0.3, 3.0).positive, G, factor)
    assert found.a0_g == pytest.approx(a0, abs=5e-7)
    assert found.t_slv_s == pytest.approx(slv, abs=1e-6)
    assert found.t_slc_s == pytest.approx(slc, abs=1e-6)
    assert (found.d0_m, found.d_slv_m, found.d_slc_m) == pytest.approx((0.2, 0.08, 0.12))
    assert found.a0_g * factor == pytest.approx(4.0 / 3.0 * 0.1)
    assert found.a0_lumped_g * factor == pytest.approx(0.1)


def test_shares_are_those_of_the_formula_and_near_the_counts_of_the_bins() -> None:
    block = rectangle(0.32, 1.8)
    for pgv in (0.05, 0.2, 0.4, 1.0, 3.0):
        answer = assess_by_formula(block, 0.35, pgv)
        row = screen_block(block, Demand(pga_g=0.35, pgv_m_s=pgv)).row("p PGV/(g tan alpha)")
        values = {name: value for name, value, _ in row.details}
        assert values["published"] == answer.probability
        for share in (answer.probability, values["this package"]):
            assert chance(share) in row.verdict
    resting = screen_block(block, Demand(pga_g=0.1, pgv_m_s=0.4)).row("p PGV/(g tan alpha)")
    assert (resting.passes, assess_by_formula(block, 0.1, 0.4).probability) == (True, 0.0)
    # Shares of runs that rock, by bins: of Chu et al., and of this package.
    for low, high, published, ours in (
        (0.3, 0.4, 0.093, 0.078), (0.4, 0.5, 0.224, 0.156), (0.7, 1.0, 0.565, 0.679),
        (1.0, 1.5, 0.754, 0.897),
    ):  # fmt: skip
        found = shares_at(math.sqrt(low * high))
        assert found == pytest.approx((published, ours), abs=0.07)
