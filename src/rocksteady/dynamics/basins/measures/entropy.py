"""Basin entropy: how uncertain the attractor is in boxes of initial states."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats, Integers
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.arrays import UnfitError, numeric_array
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.checks.validation import whole_number
from rocksteady.results.doubts import FEWEST_BOXES
from rocksteady.results.result import Result

BOX = 20
"""Cells along a side of a box by default, as in Attractors.jl, or the most below that divide."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BasinEntropy(Result):
    """Entropy of basins of attraction over boxes of initial states.

    Attributes
    ----------
    box
        Cells along each side of a box.
    box_entropy
        Entropy of the labels in each box [nats], shape (boxes along each axis).
    basins
        Number of different labels.
    """

    box: tuple[int, ...]
    box_entropy: Floats
    basins: int

    @property
    def boxes(self) -> int:
        """Number of boxes."""
        return int(self.box_entropy.size)

    @property
    def boundary_boxes(self) -> int:
        """Number of boxes with two labels or more."""
        return int(np.count_nonzero(self.box_entropy))

    @property
    def entropy(self) -> float:
        """Basin entropy S_b: the mean over all boxes [nats]."""
        return float(self.box_entropy.sum()) / self.boxes

    @property
    def boundary_entropy(self) -> float:
        """Boundary basin entropy S_bb: the mean over boundary boxes; nan where there are none."""
        boxes = self.boundary_boxes
        return float(self.box_entropy.sum()) / boxes if boxes else math.nan

    @property
    def largest(self) -> float:
        """Largest possible entropy of that number of basins, ln(basins)."""
        return math.log(self.basins)

    @property
    def fractal(self) -> bool:
        """Whether S_bb > ln 2 in 20 boxes or more, of a fractal boundary; False decides nothing."""
        return self.boundary_boxes >= FEWEST_BOXES and self.boundary_entropy > math.log(2.0)


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BasinEntropies(Result):
    """Entropy of basins of attraction over the values of a parameter.

    Attributes
    ----------
    parameter
        "amplitude", "frequency_ratio", "restitution" or "phase".
    values
        Values of the parameter, shape (values,).
    entropies
        One per value, all over boxes of one size.
    """

    parameter: str
    values: Floats
    entropies: tuple[BasinEntropy, ...]

    @property
    def entropy(self) -> Floats:
        """Basin entropy S_b at each value [nats], shape (values,)."""
        return np.array([entropy.entropy for entropy in self.entropies])

    @property
    def boundary_entropy(self) -> Floats:
        """Boundary basin entropy S_bb at each value [nats], shape (values,); nan without any."""
        return np.array([entropy.boundary_entropy for entropy in self.entropies])


@checked
def compute_basin_entropy(
    labels: Annotated[ArrayLike, INSIDE], box: int | Sequence[int] | None = None
) -> BasinEntropy:
    """Compute the basin entropy and the boundary basin entropy of labelled states.

    The states are divided into boxes.  A box with shares p_j of its states in basin j has the
    entropy -sum p_j ln p_j; S_b is the mean of all boxes and S_bb that of the boxes with two basins
    or more [1]_.  Definitions and default are those of ``basin_entropy`` in Attractors.jl.  If
    boundaries are smooth and most boxes on them have two basins, S_bb <= ln 2: above it a boundary
    is fractal.

    Parameters
    ----------
    labels
        Integers, or truths for safe and not, one per state, of any number of dimensions: the states
        of a window as `Basins.label`, those of an erosion as ``erosion.safe[0]``.
    box
        Cells along each side of a box, one number or one for each axis, of which the shape of
        `labels` is a multiple; by default the most up to 20 that divide all axes.

    Returns
    -------
    BasinEntropy
        Both entropies, and that of each box.

    Raises
    ------
    InputError
        If the labels are no array of integers, or boxes do not divide it.

    References
    ----------
    .. [1] A. Daza et al., Sci. Rep. 6, 31416 (2016), https://doi.org/10.1038/srep31416

    Examples
    --------
    >>> entropy = compute_basin_entropy([[0, 0, 0, 1], [0, 0, 1, 1]], box=2)
    >>> print(entropy.box_entropy.round(4), f"{entropy.entropy:.4f} {entropy.boundary_entropy:.4f}")
    [[0.     0.5623]] 0.2812 0.5623
    """
    array = label_array(labels)
    sides = box_sides(box, array.shape)
    codes = np.unique(array, return_inverse=True)[1].reshape(array.shape)
    split = [
        part
        for length, side in zip(array.shape, sides, strict=True)
        for part in (length // side, side)
    ]
    inside = tuple(range(1, 2 * array.ndim, 2))
    basins = int(codes.max()) + 1
    entropy = np.zeros(split[::2])
    for label in range(basins):
        share = (codes == label).reshape(split).mean(axis=inside)
        entropy -= share * np.log(np.where(share > 0.0, share, 1.0))
    return BasinEntropy(box=sides, box_entropy=entropy + 0.0, basins=basins)


def label_array(labels: Any) -> Integers:
    """Return labels as an array of integers; truths become 0 and 1.

    Raises
    ------
    InputError
        If they are anything else, or none.
    """
    hint = "give the labels of basins, as basins.label, or whether states are safe"
    valid = "labels are an array of integers with one dimension or more, not empty"
    try:
        array = np.asarray(numeric_array("labels", labels, None))
    except UnfitError as unfit:
        raise InputError("labels", labels, *unfit.args) from None
    except ValueError:  # rows of unequal lengths
        raise InputError("labels", labels, valid, hint) from None
    if array.dtype.kind not in "iub" or array.ndim == 0 or array.size == 0:
        raise InputError("labels", labels, valid, hint)
    return array.astype(np.int64)


def box_sides(box: object, shape: tuple[int, ...]) -> tuple[int, ...]:
    """Return the cells along each side of boxes that divide an array of a shape; None: the default.

    Raises
    ------
    InputError
        If they do not, or are no whole numbers.
    """
    whole = math.gcd(*shape)
    if box is None:
        box = max((side for side in range(2, BOX + 1) if whole % side == 0), default=BOX)
    given = tuple(box) if isinstance(box, Sequence) else (box,) * len(shape)
    if len(given) != len(shape):
        valid = f"there is one number for all axes, or one for each of {len(shape)}"
        raise InputError("box", box, valid, "give one number of cells, as 20")
    hint = "give cells along a side of a box"
    sides = tuple(whole_number("box", side, at_least=1, hint=hint) for side in given)
    if any(length % side for length, side in zip(shape, sides, strict=True)):
        fit = [side for side in range(2, whole + 1) if whole % side == 0]
        raise InputError(
            "box",
            box,
            "boxes must divide the window of " + " x ".join(map(str, shape)) + " states",
            f"give {', '.join(map(str, fit[:6]))}" if fit else "take windows of 100 x 100 states",
        )
    return sides
