"""Scales of axes in the units that a person gave, with the dimensionless ones on the far side."""

from typing import TYPE_CHECKING, NamedTuple

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.units import CONVERSIONS
from rocksteady.show.style import palette
from rocksteady.show.style.legends import size_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FAR_ROOM = 42.0
"""Between axes and a legend to the right of their far axis [points]."""
LEAST_FAR = (260.0, 110.0)
"""Width and height of axes [points] that have room for axes on their far sides."""


class Scale(NamedTuple):
    """How a dimensionless quantity is drawn.

    Attributes
    ----------
    factor
        Factor of dimensionless values before they are drawn.
    label
        Label of the axis, with its unit.
    far
        Label of the dimensionless axis on the far side; empty without one.
    """

    factor: float
    label: str
    far: str = ""


def scale_of(
    name: str, block: Block | DimensionlessBlock | None, *, at_start: bool = False
) -> Scale:
    """Return the scale of a quantity: in degrees, seconds, g or Hz for a block of known size.

    Parameters
    ----------
    name
        Quantity, as in `rocksteady.model.units.CONVERSIONS` and in the labels of axes.
    block
        Whose units they are; without a size, or None, the quantity stays dimensionless.
    at_start
        Whether the quantity is that of an initial state; default False.

    Examples
    --------
    >>> block = Block.rectangle(width=0.4, height=2.0)
    >>> scale_of("frequency_ratio", block).label, scale_of("frequency_ratio", None).factor
    ('frequency [Hz]', 1.0)
    """
    labelled = palette.axis_label if at_start else palette.LABELS.__getitem__
    if name not in CONVERSIONS or not isinstance(block, Block):
        return Scale(1.0, labelled(name))
    unit_name, converted = CONVERSIONS[name]
    return Scale(float(converted(block, 1.0)), labelled(unit_name), labelled(name))


def fits_far_axes(axes: "Axes") -> bool:
    """Return whether axes have room for dimensionless axes on their far sides."""
    return all(side >= least for side, least in zip(size_of(axes), LEAST_FAR, strict=True))


def draw_far_axes(axes: "Axes", right: Scale | None = None, up: Scale | None = None) -> bool:
    """Draw the dimensionless axes on the far sides of axes in units, where these have room.

    Of panels that share an abscissa the uppermost alone has one. Where results of several blocks
    share axes, a scale that is not the same for all of them is not drawn.

    Parameters
    ----------
    axes
        With the limits and scales of the near axes.
    right, up
        Scales of abscissa and ordinate; None for no axis on its far side.

    Returns
    -------
    bool
        Whether there is one on the right, for which a legend there leaves `FAR_ROOM`.
    """
    if not fits_far_axes(axes):
        return False
    place = axes.get_position()
    above = any(
        each.get_position().y0 > place.y0 for each in axes.get_shared_x_axes().get_siblings(axes)
    )
    for which, scale in (("x", None if above else right), ("y", up)):
        if scale is not None and scale.far:
            _draw_far_axis(axes, which, scale)
    return up is not None and bool(up.far)


def _draw_far_axis(axes: "Axes", which: str, scale: Scale) -> None:
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    present = [each for each in axes.child_axes if str(each.get_gid()).startswith(f"far {which}")]
    for each in present:  # of another result on the same axes
        if each.get_gid() != f"far {which} {scale.factor!r}":
            each.set_visible(False)
    if present:
        return
    functions = (lambda values: values / scale.factor, lambda values: values * scale.factor)
    if which == "x":
        far = axes.secondary_xaxis("top", functions=functions)
        far.set_xlabel(scale.far)
    else:
        far = axes.secondary_yaxis("right", functions=functions)
        far.set_ylabel(scale.far)
    far.set_gid(f"far {which} {scale.factor!r}")
    far.set_zorder(2.5)  # above filled cells
    axis, kind = (far.xaxis, axes.get_xscale()) if which == "x" else (far.yaxis, axes.get_yscale())
    if kind == "log":
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(NullFormatter())
