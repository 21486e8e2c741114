"""Sizes in millimetres: which are questioned, in which words, and where the warning points."""

import math
import warnings
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest

from rocksteady import Block
from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.sizes import check_inertia, check_one_size, question_millimetres


def questions(call: Callable[[], Any]) -> list[warnings.WarningMessage]:
    """Return the warnings of a call."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    return caught


def test_sizes_are_questioned_above_200_m_and_whole_ones_above_50_m() -> None:
    wrong = []
    for height, whole, expected in (
        (50.0, True, False),
        (math.nextafter(50.0, 60.0), False, False),
        (51.0, True, True),
        (51.0, False, False),
        (200.0, False, False),
        (math.nextafter(200.0, 300.0), False, True),
        (200.5, False, True),
        (200.0, True, True),
        (201.0, True, True),
        (49.0, True, False),
        (1.0, True, False),
    ):
        sizes = {"width": 2.0 if whole else 2.5, "height": height}
        call = partial(question_millimetres, sizes, height=height)
        if len(questions(call)) != expected:
            wrong.append((height, whole))
    assert not wrong, wrong


def test_the_question_says_what_to_write_and_points_to_the_caller() -> None:
    one = "for one in millimetres give"
    calls: list[tuple[Callable[[], Any], str, str]] = [
        (
            lambda: Block.rectangle(width=600, height=1800.5),
            "width=600, height=1800.5 make a block 1800.5 m high",
            "width=0.6, height=1.8005",
        ),
        (
            lambda: Block.asymmetric(left=300, right=350, height=1800),
            "left=300, right=350, height=1800 make a block 1800 m high",
            "left=0.3, right=0.35, height=1.8",
        ),
        (
            lambda: Block.asymmetric(left=300, right=300, height=1800),
            "left=300, right=300, height=1800 make a block 1800 m high",
            "left=0.3, right=0.3, height=1.8",
        ),
        (
            lambda: Block.from_radius(alpha=0.3, radius=900),
            "radius=900 make a block 1719.61 m high",
            "radius=0.9",
        ),
        (
            lambda: Block.from_alphas(positive=0.3, negative=0.2, radius=900),
            "radius=900 make a block 1719.61 m high",
            "radius=0.9",
        ),
        (
            lambda: Block.general(mass=1.0, inertia=1.2e6, radius=900, alpha=0.3),
            "radius=900 make a block 1719.61 m high",
            "radius=0.9",
        ),
    ]
    for call, size, instead in calls:
        (warning,) = questions(call)
        assert str(warning.message) == f"{size}: sizes are in metres; {one} {instead}"
        assert warning.category is UserWarning
        assert warning.filename == __file__, size


def test_a_block_by_its_rate_is_not_questioned() -> None:
    for call in (
        lambda: Block.from_p(alpha=0.2, p=1e-3),
        lambda: Block.from_alphas(positive=0.2, negative=0.2, p=1e-3),
        lambda: Block.from_alphas(positive=0.2, negative=0.3, p=1e-3),
        lambda: Block.rectangle(width=2.0, height=50.0),
        lambda: Block.asymmetric(left=1.0, right=2.0, height=50.0),
        lambda: Block.asymmetric(left=1.0, right=2.0, height=50.0, gyration=20.0),
    ):
        assert questions(call) == []


def test_one_size_is_a_radius_alone_or_with_a_gyration_or_a_rate_alone() -> None:
    for radius in (None, 1.0):
        for p in (None, 2.0):
            for gyration in (None, 0.5):
                fit = (radius is not None and p is None) or (
                    radius is None and p is not None and gyration is None
                )
                given = {"radius": radius, "p": p, "gyration": gyration}
                if fit:
                    check_one_size(radius=radius, p=p, gyration=gyration)
                    continue
                names = " and ".join(name for name, value in given.items() if value is not None)
                words = f"do not fit, with {names} given" if names else "are all missing"
                with pytest.raises(ModelError) as caught:
                    check_one_size(radius=radius, p=p, gyration=gyration)
                assert str(caught.value) == (
                    f"radius, p, gyration {words}: a radius, with or without a gyration, or a p "
                    "alone sets its size; give radius=..., or p=..."
                )


def test_all_mass_in_one_point_is_the_least_inertia() -> None:
    for factor, fit in ((1.0, True), (1.0 - 1e-13, True), (2.0, True), (1.0 - 1e-11, False)):
        if fit:
            check_inertia(3.0 * factor, 3.0)
        else:
            with pytest.raises(ModelError, match=r"at least mass \* radius\^2 = 3 kg m\^2"):
                check_inertia(3.0 * factor, 3.0)
    point = Block.general(mass=2.0, inertia=8.0, radius=2.0, alpha=0.2)
    assert point.p == pytest.approx(math.sqrt(9.80665 / 2.0), rel=1e-14)


def test_a_rate_gives_the_radius_that_gives_the_rate() -> None:
    for positive, negative in ((0.2, 0.3), (0.4, 0.1), (0.05, 0.6)):
        for gravity in (9.80665, 1.62):
            made = Block.from_alphas(positive=positive, negative=negative, p=2.0, gravity=gravity)
            again = Block.from_alphas(
                positive=positive, negative=negative, radius=made.radius, gravity=gravity
            )
            assert (made.p, again.p) == pytest.approx((2.0, 2.0), rel=1e-13)
            # The radius of gyration is that of a homogeneous rectangle of this base and height.
            square = (made.width**2 + made.height**2) / 12.0
            for side in (made.positive, made.negative):
                rate = gravity * side.radius / (square + side.radius**2)
                assert side.p**2 == pytest.approx(rate, rel=1e-12)
                assert side.radius * math.cos(side.alpha) == pytest.approx(0.5 * made.height)


def test_a_stocky_rectangle_is_refused_by_its_width() -> None:
    # 1 - 1.5 sin^2 alpha is 0 where width = sqrt(2) height.
    assert Block.rectangle(width=1.414, height=1.0).restitution > 0.0
    with pytest.raises(InputError) as caught:
        Block.rectangle(width=1.5, height=1.0)
    assert str(caught.value) == (
        "width = 1.5 is not valid: with a height of 1 m Housner's restitution is -0.03846, and "
        "rocking needs one above 0; give a measured restitution in (0, 1], or a more slender block"
    )
    assert Block.rectangle(width=1.5, height=1.0, restitution=0.5).restitution == 0.5
