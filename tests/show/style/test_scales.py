"""Axes in the units that were given: their factors, and the dimensionless ones on the far side."""

import math

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocksteady import Block, DimensionlessBlock, Pulse, simulate
from rocksteady.show.style.layout import plain_ticks
from rocksteady.show.style.palette import LABELS
from rocksteady.show.style.scales import draw_far_axes, scale_of
from tests.every import every

BLOCK = Block.rectangle(width=0.4, height=2.0)


def far_axes(axes: Axes) -> list[str]:
    return [str(each.get_xlabel() or each.get_ylabel()) for each in axes.child_axes]


def test_factors_are_those_of_the_units() -> None:
    g = 9.80665
    for name, factor in (
        ("pt", 1.0 / BLOCK.p),
        ("amplitude", BLOCK.uplift_acceleration / g),
        ("frequency_ratio", BLOCK.p / (2.0 * math.pi)),
        ("angle", math.degrees(BLOCK.alpha)),
        ("velocity", math.degrees(BLOCK.alpha) * BLOCK.p),
    ):
        scale = scale_of(name, BLOCK)
        assert scale.factor == pytest.approx(factor, rel=1e-14)
        assert (scale.far, scale_of(name, None).label) == (LABELS[name], LABELS[name])
        assert scale_of(name, DimensionlessBlock(restitution=0.8)) == scale_of(name, None)


@pytest.mark.parametrize("kind", ["linear", "log"])
def test_a_far_axis_reads_the_dimensionless_values(kind: str) -> None:
    axes = Figure(figsize=(7.0, 4.0)).add_subplot()
    scale = scale_of("frequency_ratio", BLOCK)
    axes.set(xscale=kind, xlim=(1.0 * scale.factor, 8.0 * scale.factor))
    assert not draw_far_axes(axes, scale)
    (far,) = axes.child_axes
    axes.figure.draw_without_rendering()  # type: ignore[union-attr]
    np.testing.assert_allclose(far.get_xlim(), (1.0, 8.0))


def test_narrow_and_low_axes_have_none_and_of_panels_the_uppermost_alone() -> None:
    right, up = scale_of("pt", BLOCK), scale_of("angle", BLOCK)
    for size, count in (((7.0, 4.0), 2), ((3.3, 4.0), 0), ((7.0, 1.6), 0)):
        axes = Figure(figsize=size).add_subplot()
        assert draw_far_axes(axes, right, up) is bool(count)
        assert len(axes.child_axes) == count
    first, second = Figure(figsize=(7.0, 8.0)).subplots(2, sharex=True)
    for axes in (first, second):
        draw_far_axes(axes, right, up)
    assert far_axes(first) == [LABELS["pt"], LABELS["angle"]]
    assert far_axes(second) == [LABELS["angle"]]
    free, other = Figure(figsize=(7.0, 8.0)).subplots(2)
    for axes in (free, other):
        draw_far_axes(axes, right)
    assert far_axes(free) == far_axes(other) == [LABELS["pt"]]


def test_blocks_that_share_axes_have_the_scales_alone_that_they_share() -> None:
    axes = Figure(figsize=(7.0, 4.0)).add_subplot()
    pulse = Pulse.from_si(BLOCK, shape="one-sine", acceleration_m_s2=3.0, frequency_hz=2.5)
    first = simulate(BLOCK, pulse)
    first.plot(axes)
    limits = axes.get_xlim(), axes.get_ylim()
    assert [each.get_visible() for each in axes.child_axes] == [True, True]
    twice = Block.rectangle(width=0.8, height=4.0)  # of the same slenderness
    simulate(twice, pulse).plot(axes)
    shown = dict(zip(far_axes(axes), (each.get_visible() for each in axes.child_axes), strict=True))
    assert shown == {LABELS["pt"]: False, LABELS["angle"]: True}
    for (low, high), (least, most) in zip((axes.get_xlim(), axes.get_ylim()), limits, strict=True):
        assert low <= least < most <= high


@every(
    ("low", "high", "width"),
    [
        (1.0, 1.2, 3.3),
        (0.45, 1.7, 3.3),
        (1.0, 3.0, 8.0),
        (0.02, 2.0, 3.3),
        (1e-5, 0.2, 8.0),
        (3.0, 4e5, 3.3),
    ],
)
def test_a_logarithmic_axis_has_two_labels_or_more_and_none_in_letters(
    low: float, high: float, width: float
) -> None:
    axes = Figure(figsize=(width, 3.0)).add_subplot(xscale="log", xlim=(low, high))
    plain_ticks(axes)
    places = zip(axes.get_xticks(), axes.get_xticklabels(), strict=True)
    labels = [text.get_text() for at, text in places if low <= at <= high and text.get_text()]
    assert len(labels) >= 2
    assert not any(part in label for label in labels for part in ("e-", "e+"))
    plain = [label for label in labels if "$" not in label]
    assert plain in ([], labels), "all of one kind"
