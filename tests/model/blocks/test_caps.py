"""Rocking frames: published numbers, and energies and impulses of columns and cap one by one."""

import math
import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rocksteady import Block
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.caps import Cap
from rocksteady.model.blocks.outlines import Outline
from rocksteady.model.blocks.sides import Side
from rocksteady.model.facts import block_values

SIZES = {"width": 1.6, "height": 9.6}
GAMMAS = st.floats(0.0, 20.0)
SHAPES = st.tuples(st.floats(0.05, 0.35), st.floats(0.2, 5.0))


@pytest.mark.parametrize(
    ("gamma", "p", "restitution"),
    [(0.0, 1.22941, 0.95946), (1.0, 1.06470, 0.94932), (2.0, 1.03904, 0.94788),
     (4.0, 1.02293, 0.94699)],
)  # fmt: skip
def test_columns_of_the_literature(gamma: float, p: float, restitution: float) -> None:
    """Columns of 1.6 x 9.6 m by the formulas of Makris and Vassiliou (2013)."""
    column, frame = Block.rectangle(**SIZES), Block.frame(columns=4, cap_mass_ratio=gamma, **SIZES)
    assert round(frame.p, 5) == p
    assert round(frame.restitution, 5) == restitution
    alpha = column.alpha
    closed = (1 - 1.5 * math.sin(alpha) ** 2 + 3 * gamma * math.cos(2 * alpha)) / (1 + 3 * gamma)
    assert frame.restitution == pytest.approx(closed, rel=1e-14)
    assert frame.p / column.p == pytest.approx(math.sqrt((1 + 2 * gamma) / (1 + 3 * gamma)))
    assert (frame.alpha, frame.uplift_acceleration) == (alpha, column.uplift_acceleration)
    assert (frame.width, frame.height) == (column.width, column.height)


@given(GAMMAS, SHAPES)
def test_p_is_the_rate_of_leaving_the_balance_by_energies(
    gamma: float, shape: tuple[float, float]
) -> None:
    """At theta = alpha p^2 is -V''/(2 T/w^2), from heights and speeds of all parts."""
    (alpha, radius), columns, step = shape, 3, 1e-4
    frame = Block.from_radius(alpha=alpha, radius=radius).capped(
        columns=columns, cap_mass_ratio=gamma, restitution=0.9
    )

    def places(theta: float) -> Any:
        """Return mass centre and upper corner of a column that has turned."""
        lean = math.pi / 2 - alpha + theta
        return np.array([radius, 2.0 * radius]) * np.exp(1j * lean)

    masses = np.array([columns, gamma * columns])  # of columns of 1 kg, and of the cap
    v = [9.80665 * masses @ places(alpha + k * step).imag for k in (-1, 0, 1)]
    speeds = np.abs(places(alpha + step) - places(alpha - step)) / (2 * step)
    b, h = radius * math.sin(alpha), radius * math.cos(alpha)
    kinetic = masses @ speeds**2 + columns * (4 * b * b + 4 * h * h) / 12
    assert frame.p**2 == pytest.approx(-(v[0] - 2 * v[1] + v[2]) / step**2 / kinetic, rel=1e-5)


@given(GAMMAS, SHAPES)
def test_restitution_is_that_of_impulses_at_foot_and_head(
    gamma: float, shape: tuple[float, float]
) -> None:
    """Newton's laws of a column and its part of the cap, with unknown impulses at both contacts."""
    alpha, radius = shape
    b, h = radius * math.sin(alpha), radius * math.cos(alpha)
    inertia = radius * radius / 3
    # Unknown: impulses at the right foot (x, z) and at the upper left corner (x, z), rate after.
    # Before, the rate is 1 about the left foot, and the cap stands on the upper right corner.
    law = np.array([
        [1.0, 0.0, 1.0, 0.0, h],  # of the column: its mass centre then moves by (-h, -b)
        [0.0, 1.0, 0.0, 1.0, b],
        [h, b, -h, -b, -inertia],  # moments about its mass centre
        [0.0, 0.0, -1.0, 0.0, 2.0 * gamma * h],  # of the cap
        [0.0, 0.0, 0.0, -1.0, 2.0 * gamma * b],
    ])  # fmt: skip
    before = np.array([h, -b, -inertia, 2.0 * gamma * h, -2.0 * gamma * b])
    rate = np.linalg.solve(law, before)[-1]
    assume(rate > 1e-3)
    frame = Block.from_radius(alpha=alpha, radius=radius, restitution=1.0).capped(
        columns=2, cap_mass_ratio=gamma
    )
    assert frame.restitution == pytest.approx(rate, rel=1e-9)


PIERS = [
    (width, height, gamma)
    for width, height in ((1.6, 9.6), (0.5, 2.0), (2.0, 7.0), (0.3, 3.0))
    for gamma in (0.1, 0.5, 1.0, 2.0, 8.0)
]


def stacked(boxes: list[tuple[float, float, float, float]], base: float) -> Block:
    """Return boxes of (mass, width, height, middle above the base) as one body, by Steiner."""
    mass = sum(m for m, _, _, _ in boxes)
    centre = sum(m * z for m, _, _, z in boxes) / mass
    inertia = sum(m * ((b * b + h * h) / 12 + (0.5 * base) ** 2 + z * z) for m, b, h, z in boxes)
    radius, alpha = math.hypot(0.5 * base, centre), math.atan2(0.5 * base, centre)
    return Block.general(mass=mass, inertia=inertia, radius=radius, alpha=alpha)


@pytest.mark.parametrize(("width", "height", "gamma"), PIERS)
def test_one_pier_with_a_cap_is_a_body(width: float, height: float, gamma: float) -> None:
    """A point on the top exactly; decks of two rectangles come to it as they become small."""
    pier = Block.frame(columns=1, cap_mass_ratio=gamma, width=width, height=height)
    column = (1.0, width, height, 0.5 * height)
    point = stacked([column, (gamma, 0.0, 0.0, height)], width)
    for name in ("alpha", "radius", "p", "restitution", "uplift_acceleration"):
        assert getattr(pier, name) == pytest.approx(getattr(point, name), rel=1e-12)
    assert pier.cap is None
    assert pier.height == height
    assert pier.width == pytest.approx(width, rel=1e-14)
    misfits = [
        abs(stacked([column, (gamma, size, size, height + 0.5 * size)], width).p / pier.p - 1.0)
        for size in (0.1 * height, 0.01 * height, 1e-6 * height)
    ]
    assert misfits[0] > misfits[1] > misfits[2]
    assert misfits[2] < 1e-6
    words = pier.describe().headline
    assert f"pier with a point cap of {gamma:g} times its mass as one body" in words


@pytest.mark.parametrize(("width", "height", "gamma"), PIERS)
def test_one_pier_leaves_its_balance_as_an_integration_does(
    width: float, height: float, gamma: float
) -> None:
    """At small tilts from the balance Newton's law of both masses grows with exp(p t)."""
    pier = Block.frame(columns=1, cap_mass_ratio=gamma, width=width, height=height)
    places = [(1.0, complex(-0.5 * width, 0.5 * height)), (gamma, complex(-0.5 * width, height))]
    inertia = (width**2 + height**2) / 12 + sum(m * abs(z) ** 2 for m, z in places)

    def torque(theta: float) -> float:
        """Return the moment about the right edge, positive towards the fall (clockwise)."""
        turned = [(m, z * complex(math.cos(theta), -math.sin(theta))) for m, z in places]
        return 9.80665 * sum(m * z.real for m, z in turned)

    assert torque(pier.alpha) == pytest.approx(0.0, abs=1e-9 * abs(torque(0.0)))
    lean, rate, dt = pier.alpha + 1e-5, 0.0, 1e-4 / pier.p
    for _ in range(10_000):  # leapfrog, up to p t = 1
        rate += dt * torque(lean + 0.5 * dt * rate) / inertia
        lean += dt * rate
    assert lean - pier.alpha == pytest.approx(1e-5 * math.cosh(1.0), rel=3e-4)


def test_a_cap_needs_two_columns_and_a_body_takes_all_forms_of_restitution() -> None:
    with pytest.raises(InputError, match=r"columns = 1 .* whole number from 2 to 1000"):
        Cap(columns=1, cap_mass_ratio=1.0)
    how: Any = {"columns": 1, "cap_mass_ratio": 2.0, **SIZES}
    own = Block.frame(**how)
    assert Block.frame(**how, restitution=("housner", 0.9)).restitution == 0.9 * own.restitution
    pair = Block.frame(**how, restitution=(0.8, 0.9))
    assert (pair.positive.restitution, pair.negative.restitution) == (0.8, 0.9)
    assert "as one body" in pair.against_wall(0.5).describe().headline
    wide: Any = {"columns": 1, "cap_mass_ratio": 0.1, "width": 2.0, "height": 1.0}
    with pytest.raises(InputError, match="Housner's restitution for it is -"):
        Block.frame(**wide)


def test_a_frame_is_a_block_for_all_that_takes_one() -> None:
    """It is copied, compared and described; a wall needs a number."""
    frame = Block.frame(columns=4, cap_mass_ratio=2.0, **SIZES)
    assert pickle.loads(pickle.dumps(frame)) == frame
    assert frame != Block.rectangle(**SIZES)
    assert hash(frame) == hash(replace(frame))
    facts = {"columns": 4, "cap_mass_ratio": 2.0}
    assert facts.items() <= frame.to_dict().items()
    assert facts.items() <= block_values(frame).items()
    assert "frame of 4 columns, cap 2 of their mass, of 1.6 x 9.6 m" in repr(frame)
    assert frame.against_wall(0.5).restitution == 0.5
    with pytest.raises(InputError, match="none for a frame against a wall"):
        frame.against_wall()


def test_restitutions_of_a_frame_are_given_as_those_of_a_block() -> None:
    """A number, a factor of the frame's own, or a pair; and back to its own."""
    frame = Block.frame(columns=4, cap_mass_ratio=2.0, **SIZES)
    part = Block.frame(columns=4, cap_mass_ratio=2.0, restitution=("housner", 0.9), **SIZES)
    assert part.restitution == 0.9 * frame.restitution
    assert part.housner_factor == 0.9
    assert part.with_restitution("housner") == frame
    pair = Block.frame(columns=4, cap_mass_ratio=2.0, restitution=(0.8, 0.9), **SIZES)
    assert (pair.positive.restitution, pair.negative.restitution) == (0.8, 0.9)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"columns": 0}, "columns = 0 .* whole number from 1 to 1000; give the number"),
        ({"columns": 2.5}, "columns = 2.5 .* whole number"),
        ({"cap_mass_ratio": -1.0}, r"cap_mass_ratio = -1.0 .* \[0, 1000\]; give the mass"),
        ({"width": 0.0}, "width = 0.0 .* give the full width in metres"),
        ({"width": 12.0}, "with columns of alpha 0.8961 rad the frame's restitution is"),
    ],
)
def test_bad_input_is_one_line(wrong: dict[str, float], words: str) -> None:
    """Which argument, what was given, what is valid, what to do."""
    given = {"columns": 4, "cap_mass_ratio": 9.0, **SIZES, **wrong}
    with pytest.raises(InputError, match=words):
        Block.frame(**given)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "column",
    [
        Block.asymmetric(left=0.1, right=0.2, height=1.0),
        Block.rectangle(width=0.3, height=1.5).against_wall(),
        Block.frame(columns=2, cap_mass_ratio=1.0, **SIZES),
        Block.frame(columns=1, cap_mass_ratio=1.0, **SIZES),
    ],
)
def test_columns_are_single_symmetric_blocks(column: Block) -> None:
    """Others are refused."""
    with pytest.raises(ModelError, match="single blocks whose sides are alike; give such a block"):
        column.capped(columns=2, cap_mass_ratio=1.0)


def test_a_frame_is_made_of_a_column_and_not_of_parts_of_another() -> None:
    """A cap sets the p of its columns: a replaced one, or an outline, would make no body."""
    column = Block.rectangle(width=1.6, height=9.6)
    frame = column.capped(columns=4, cap_mass_ratio=2.0)
    more = Cap(columns=6, cap_mass_ratio=2.0)
    assert replace(frame, cap=more) == column.capped(columns=6, cap_mass_ratio=2.0)
    for block, cap in ((frame, None), (frame, Cap(columns=4, cap_mass_ratio=5.0)), (column, more)):
        with pytest.raises(ModelError, match="cap is not the one that the p of its sides is for"):
            replace(block, cap=cap)
    with pytest.raises(ModelError, match="columns have their mass in mid-height"):
        replace(frame, outline=Outline(height=12.0))
    bare = Side(alpha=0.165, radius=4.87, p=1.229, restitution=0.9)
    with pytest.raises(ModelError, match=r"p = 1\.229 .* columns without a moment of inertia"):
        Block(positive=bare, negative=bare, cap=more)
    leaning = Block.asymmetric(left=0.7, right=0.9, height=9.6, restitution=0.9)
    one, other = (replace(side, gravity=None) for side in (leaning.positive, leaning.negative))
    with pytest.raises(ModelError, match="have sides that are alike"):
        Block(positive=one, negative=other, cap=more)
