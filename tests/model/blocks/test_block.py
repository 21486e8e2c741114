"""Blocks: their constructors against each other, against formulae and against published numbers."""

import dataclasses
import math
import pickle
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocksteady import Block, DimensionlessBlock
from rocksteady.errors import InputError, ModelError
from rocksteady.formulas import Side, housner_restitution
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.risk import DescribedObject
from tests.every import every
from tests.strategies import logarithmic

slender = st.floats(0.01, 0.9)  # Housner's value is positive up to 0.955 rad
pytestmark = pytest.mark.filterwarnings("ignore:.*sizes are in metres:UserWarning")

sizes = logarithmic(0.01, 100.0)
gravities = logarithmic(0.1, 100.0)

CONSTRUCTORS: dict[str, tuple[Callable[..., Block], dict[str, float]]] = {
    "rectangle": (Block.rectangle, {"width": 0.4, "height": 1.2}),
    "from_radius": (Block.from_radius, {"alpha": 0.3, "radius": 0.7}),
    "from_p": (Block.from_p, {"alpha": 0.3, "p": 3.0}),
    "general": (Block.general, {"mass": 100.0, "inertia": 80.0, "radius": 0.7, "alpha": 0.3}),
}
SIDE = {"alpha": 0.3, "radius": 0.7, "p": 3.0, "restitution": 0.9}

BAD_NUMBERS = [0.0, -1.0, -0.0, math.nan, math.inf, -math.inf, "0.3", True, None, 1j, [0.3]]
BAD_RESTITUTIONS = [0.0, -0.5, 1.2, 1.0 + 1e-15, math.nan, math.inf, "0.8", "Housner", True, None]


def arguments_of_constructors() -> list[tuple[str, str]]:
    return [
        (name, argument)
        for name, (_, values) in CONSTRUCTORS.items()
        for argument in [*values, "gravity"]
    ]


@given(sizes, sizes, gravities)
def test_a_rectangle_has_the_p_of_its_moment_of_inertia(
    width: float, height: float, gravity: float
) -> None:
    block = Block.rectangle(width=width, height=height, restitution=0.7, gravity=gravity)
    # I_0 = m (w^2 + h^2)/3 about a corner, p^2 = m g R / I_0
    square = width**2 + height**2
    assert block.p == pytest.approx(math.sqrt(gravity * 0.5 * math.sqrt(square) / (square / 3.0)))
    assert block.alpha == pytest.approx(math.atan(width / height), rel=1e-14)
    assert block.radius == pytest.approx(0.5 * math.sqrt(square), rel=1e-14)
    assert (block.width, block.height) == pytest.approx((width, height), rel=1e-13)
    assert block.uplift_acceleration == pytest.approx(block.alpha * gravity, rel=1e-15)


@given(slender, sizes, gravities)
def test_the_four_constructors_make_the_same_rectangle(
    alpha: float, radius: float, gravity: float
) -> None:
    block = Block.from_radius(alpha=alpha, radius=radius, gravity=gravity)
    mass = 17.0
    same = [
        Block.rectangle(
            width=2.0 * radius * math.sin(alpha),
            height=2.0 * radius * math.cos(alpha),
            gravity=gravity,
        ),
        Block.from_p(alpha=alpha, p=math.sqrt(3.0 * gravity / (4.0 * radius)), gravity=gravity),
        Block.general(
            mass=mass,
            inertia=4.0 / 3.0 * mass * radius**2,
            radius=radius,
            alpha=alpha,
            gravity=gravity,
        ),
    ]
    for other in same:
        assert dataclasses.astuple(other.positive) == pytest.approx(
            dataclasses.astuple(block.positive), rel=1e-10
        )
        assert other.negative == other.positive
        assert other.gravity == gravity


def test_equation_27_at_the_block_of_the_paper() -> None:
    # p = 2 pi: R = 3 g / (4 p^2)
    block = Block.from_p(alpha=0.2, p=2.0 * math.pi, restitution=0.8)
    assert block.radius == pytest.approx(0.75 * 9.80665 / (4.0 * math.pi**2), rel=1e-14)
    assert block.gravity == STANDARD_GRAVITY == 9.80665


def test_equation_26_of_a_block_that_is_no_rectangle() -> None:
    # A thin vertical rod of mass m and length 2 R that rocks about its foot: I_0 = 4 m R^2/3; with
    # all its mass at the top end (a pendulum turned over), R is its length and I_0 = m R^2.
    assert Block.general(
        mass=3.0, inertia=3.0 * 4.0, radius=2.0, alpha=0.1, gravity=10.0
    ).p == pytest.approx(math.sqrt(10.0 / 2.0))
    assert Block.general(
        mass=5.0, inertia=45.0, radius=1.5, alpha=0.1, gravity=9.0
    ).p == pytest.approx(math.sqrt(5.0 * 9.0 * 1.5 / 45.0))


@every(("degrees", "expected"), [(10.0, 0.954769), (15.0, 0.899519), (20.0, 0.824533)])
def test_housners_restitution(degrees: float, expected: float) -> None:  # H2
    alpha = math.radians(degrees)
    assert housner_restitution(alpha) == pytest.approx(expected, abs=5e-7)
    assert Block.from_p(alpha=alpha, p=2.0).restitution == pytest.approx(expected, abs=5e-7)
    assert Block.rectangle(width=math.tan(alpha), height=1.0).restitution == pytest.approx(
        expected, abs=5e-7
    )


@given(slender, sizes, st.floats(1.0, 5.0))
def test_the_general_restitution_conserves_angular_momentum_about_the_new_pivot(
    alpha: float, radius: float, ratio: float
) -> None:
    mass, inertia = 2.0, ratio * 2.0 * radius**2  # about a pivot
    # Before: spin about the mass centre plus its momentum times the lever about the new pivot.
    about_centre = inertia - mass * radius**2
    lever = about_centre + mass * radius**2 * math.cos(2.0 * alpha)
    expected = lever / inertia
    if expected <= 1e-9:
        return
    block = Block.general(mass=mass, inertia=inertia, radius=radius, alpha=alpha)
    assert block.restitution == pytest.approx(expected, rel=1e-9, abs=1e-12)


def test_a_stocky_block_is_refused_unless_its_restitution_is_measured() -> None:
    with pytest.raises(InputError, match=r"^width = 3\.0 is not valid: with a height of 1 m"):
        Block.rectangle(width=3.0, height=1.0)
    with pytest.raises(InputError, match="Housner's restitution"):
        Block.from_radius(alpha=1.0, radius=1.0)
    assert Block.rectangle(width=3.0, height=1.0, restitution=0.3).restitution == 0.3


def test_the_stockiest_block_that_rocks_has_sine_squared_of_two_thirds() -> None:
    limit = math.asin(math.sqrt(2.0 / 3.0))
    assert Block.from_radius(alpha=limit - 1e-6, radius=1.0).restitution > 0.0
    with pytest.raises(InputError):
        Block.from_radius(alpha=limit + 1e-6, radius=1.0)


def test_no_body_has_less_inertia_than_a_point() -> None:
    with pytest.raises(ModelError, match="at least mass"):
        Block.general(mass=2.0, inertia=1.9, radius=1.0, alpha=0.2)
    point = Block.general(mass=2.0, inertia=2.0, radius=1.0, alpha=0.2)
    assert point.p == pytest.approx(math.sqrt(STANDARD_GRAVITY))


@given(sizes, slender, gravities, gravities, st.sampled_from([0.8, "housner"]))
def test_a_rectangle_under_another_gravity_is_that_of_its_constructor_to_the_last_bit(
    radius: float, alpha: float, here: float, there: float, how: Any
) -> None:
    make = partial(Block.from_radius, alpha=alpha, radius=radius, restitution=how)
    moved = dataclasses.replace(make(gravity=here), gravity=there)
    assert moved == make(gravity=there)
    assert dataclasses.replace(moved, gravity=there) == moved


BODIES: dict[str, Callable[..., Block]] = {
    **{name: partial(make, **values) for name, (make, values) in CONSTRUCTORS.items()},
    "asymmetric": partial(Block.asymmetric, left=0.1, right=0.3, height=1.2, gyration=0.5),
    "from_alphas": partial(Block.from_alphas, positive=0.2, negative=0.3, radius=1.0),
    "factor": partial(Block.rectangle, width=0.4, height=1.2, restitution=("housner", 0.9)),
    "frame": partial(Block.frame, columns=3, cap_mass_ratio=2.0, width=0.4, height=2.0),
    "pier": partial(Block.frame, columns=1, cap_mass_ratio=2.0, width=0.4, height=2.0),
    "pair": partial(Block.asymmetric, left=0.2, right=0.2, height=1.2, restitution=(0.8, 0.9)),
    "statue": partial(Block.named, "statue-on-plinth"),
    "object": lambda gravity: (
        DescribedObject(
            values={
                "name": "desk",
                "geometry": {"left_m": 0.2, "right_m": 0.3, "mass_centre_height_m": 0.8},
                "gravity_m_s2": gravity,
            }
        ).block
    ),
}


@every("name", [name for name in BODIES if name != "from_p"])
@every("gravity", [1.62, 24.8])
def test_a_body_of_any_constructor_keeps_its_inertia_under_another_gravity(
    name: str, gravity: float
) -> None:
    here, there = BODIES[name](gravity=STANDARD_GRAVITY), BODIES[name](gravity=gravity)
    walls = here.against_wall(0.5), there.against_wall(0.5)
    for old, new in ((here, there), walls):
        moved = dataclasses.replace(old, gravity=gravity)
        assert moved.housner_factor == new.housner_factor
        for one, other in ((moved.positive, new.positive), (moved.negative, new.negative)):
            assert (one.alpha, one.radius) == (other.alpha, other.radius)
            assert one.p == pytest.approx(other.p, rel=4e-16)
            assert one.restitution == pytest.approx(other.restitution, rel=1e-15)
        back = dataclasses.replace(moved, gravity=STANDARD_GRAVITY)
        assert back.p == pytest.approx(old.p, rel=1e-15)
        assert pickle.loads(pickle.dumps(moved)) == moved


def test_a_block_by_its_p_keeps_its_size_under_another_gravity() -> None:
    """A quarter of the gravity halves p of the same half-diagonal."""
    here = Block.from_p(alpha=0.3, p=3.0)
    moved = dataclasses.replace(here, gravity=STANDARD_GRAVITY / 4.0)
    assert (here.p, here.radius) == (3.0, moved.radius)
    assert moved.p == pytest.approx(1.5, rel=1e-15)


def test_sides_that_are_given_have_their_p_under_the_gravity_of_the_block() -> None:
    """A number stays as it is; a side of another block is that body under this gravity."""
    side = Side(**SIDE)
    for gravity in (7.0, 9.80665, 24.8):
        block = Block(positive=side, negative=side, gravity=gravity)
        assert block.p == 3.0
        taken = Block(positive=block.positive, negative=block.positive, gravity=4.0 * gravity)
        assert taken.p == pytest.approx(6.0, rel=1e-15)
        assert block.positive == side


@every("alike", [True, False])
def test_a_body_of_negative_inertia_is_refused_from_either_side(alike: bool) -> None:
    """Above sqrt(g/R), of all mass in one point, a p is of no body; at it, it is of one."""
    limit = math.sqrt(STANDARD_GRAVITY / 0.7)
    point = Side(**{**SIDE, "p": limit})
    assert Block(positive=point, negative=point).p == limit
    fast = Side(**{**SIDE, "p": 1.001 * limit})
    other = fast if alike else dataclasses.replace(fast, restitution=0.8)
    for sides in ((fast, other), (other, fast), (Side(**SIDE), fast), (fast, Side(**SIDE))):
        with pytest.raises(
            ModelError, match=r"so 0 or more; give p up to sqrt\(g/radius\) = 3.742926662 rad/s$"
        ):
            Block(positive=sides[0], negative=sides[1])
    with pytest.raises(ModelError, match="so 0 or more"):
        dataclasses.replace(Block.rectangle(width=0.4, height=1.2), positive=fast, negative=fast)


@every(("constructor", "argument"), arguments_of_constructors())
@every("value", BAD_NUMBERS)
def test_a_bad_number_is_refused_by_its_name(
    constructor: str, argument: str, value: object
) -> None:
    make, values = CONSTRUCTORS[constructor]
    arguments: dict[str, Any] = {**values, "restitution": 0.9, argument: value}
    with pytest.raises(InputError, match=f"^{argument} = "):
        make(**arguments)


@every("constructor", ["from_radius", "from_p", "general"])
@every("alpha", [0.5 * math.pi, 1.6, 10.0, math.degrees(0.2)])
def test_an_angle_of_a_right_one_or_above_is_refused(constructor: str, alpha: float) -> None:
    make, values = CONSTRUCTORS[constructor]
    with pytest.raises(InputError, match=r"^alpha = .*\(0, 1\.57"):
        make(**{**values, "alpha": alpha, "restitution": 0.9})


@every("constructor", CONSTRUCTORS)
@every("value", BAD_RESTITUTIONS)
def test_a_bad_restitution_is_refused(constructor: str, value: Any) -> None:
    make, values = CONSTRUCTORS[constructor]
    with pytest.raises(InputError, match=r"^restitution = .*\(0, 1\]"):
        make(**values, restitution=value)
    with pytest.raises(InputError, match=r"^restitution = "):
        DimensionlessBlock(restitution=value)


@every("constructor", CONSTRUCTORS)
@every("value", [1.0, 1, 0.5, 5e-324])
def test_every_restitution_up_to_1_is_accepted(constructor: str, value: float) -> None:
    make, values = CONSTRUCTORS[constructor]
    restitution = make(**values, restitution=value).restitution
    assert restitution == value
    assert type(restitution) is float


@every("constructor", CONSTRUCTORS)
def test_constructors_take_keywords_only(constructor: str) -> None:
    make, values = CONSTRUCTORS[constructor]
    with pytest.raises(InputError, match="takes no arguments without a name"):
        make(*values.values())


@every("name", SIDE)
@every("value", [0.0, -1.0, math.nan, "1", True])
def test_a_side_is_validated_too(name: str, value: Any) -> None:
    with pytest.raises(InputError, match=f"^{name} = "):
        Side(**{**SIDE, name: value})


def test_blocks_are_frozen_and_compare_by_value() -> None:
    block = Block.rectangle(width=0.4, height=1.2)
    field = "gravity"
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(block, field, 1.0)
    field = "alpha"
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(block.positive, field, 1.0)
    assert block == Block.rectangle(width=0.4, height=1.2)
    assert hash(block) == hash(Block.rectangle(width=0.4, height=1.2))
    assert block != Block.rectangle(width=0.4, height=1.3)


def test_what_the_equation_of_motion_sees_of_a_block_is_its_restitution() -> None:
    bare = Block.rectangle(width=0.4, height=1.2, restitution=0.77).dimensionless()
    assert bare == DimensionlessBlock(restitution=0.77)
    assert bare.dimensionless() is bare
    assert bare.sides == ((0.77, 1.0, 1.0), (0.77, 1.0, 1.0))


def test_a_block_that_is_no_rectangle_is_not_described_as_one() -> None:
    sizes = {"left": 0.25, "right": 0.25, "height": 1.0}  # twice that of the mass centre
    outline = (0.5**2 + 2.0**2) / 12.0  # of 0.5 x 2 m
    low = Block.asymmetric(**sizes, gyration=outline**0.5)
    assert "0.5 m wide block with its mass centre at 0.5 m, " in repr(low)
    assert "<td" in low._repr_html_()
    assert "x" not in low.summary()
    assert "0.5 x 1 m block" in repr(Block.asymmetric(**sizes))
    alike = Block.asymmetric(**sizes, gyration=((0.5**2 + 1.0) / 12.0) ** 0.5)
    assert "0.5 x 1 m block" in repr(alike)
    moved = Block.asymmetric(left=0.2, right=0.3, height=1.0, gravity=1.6)
    assert "0.5 x 1 m block" in repr(moved)


def test_a_block_lifts_at_an_acceleration_in_standard_gravity() -> None:
    weak = Block.asymmetric(left=0.2, right=0.3, height=2.0, gravity=4.903325)
    assert "0.1 g and 0.15 g" in weak.summary()


def test_a_notebook_shows_the_numbers_of_a_block() -> None:
    block = Block.from_p(alpha=0.25, p=2.14, restitution=0.9)
    table = block._repr_html_()
    for number in ("14.3°", "2.14 rad/s", "0.9", "0.255 g", "1.61 m", "795 mm x 3.11 m"):
        assert f">{number}</td>" in table
    assert repr(block) == "<Block: 0.795 x 3.11 m block, alpha 14.3°, restitution 0.9>"
    assert block.to_dict() == {
        "alpha_rad": 0.25,
        "radius_m": block.radius,
        "p_rad_s": 2.14,
        "restitution": 0.9,
    }
