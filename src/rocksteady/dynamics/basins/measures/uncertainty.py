"""Uncertainty exponent of basins: how the share of uncertain states falls with their precision."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.basins.measures.entropy import label_array
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.checks.confidence import Confidence
from rocksteady.model.checks.validation import whole_number
from rocksteady.results.doubts import FEWEST_SIZES
from rocksteady.results.numbers import CONFIDENCE
from rocksteady.results.result import Result

Probe = Literal["states", "boxes"]

PARTS = 20
"""The largest default size is the longer side of the window over this."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class UncertaintyExponent(Result):
    """Uncertainty exponent of a basin boundary, with the counts from which it follows.

    Attributes
    ----------
    by
        What was counted: "states" or "boxes".
    size
        Perturbation of a state, or side of a box [cells], shape (sizes,).
    uncertain
        Number of uncertain states or boxes, shape (sizes,).
    total
        Number of all states or boxes, shape (sizes,).
    dimensions
        Number of dimensions of the window.
    """

    by: Probe
    size: Integers
    uncertain: Integers
    total: Integers
    dimensions: int

    @property
    def share(self) -> Floats:
        """Share of uncertain states or boxes, shape (sizes,)."""
        return self.uncertain / self.total

    @property
    def _logs(self) -> tuple[Floats, Floats]:
        """Logarithms of the sizes at which something is uncertain, and of what is fitted there."""
        used = self.uncertain > 0
        # Boxes count as in Attractors.jl, by their number and not by their share.
        y = self.share if self.by == "states" else self.uncertain
        return np.log(self.size[used].astype(np.float64)), np.log(y[used])

    @cached_property
    def _fit(self) -> tuple[float, float, float]:
        """Slope of the line, its standard error, and r^2."""
        x, y = self._logs
        if len(x) < FEWEST_SIZES:
            return math.nan, math.nan, math.nan
        away = x - x.mean()
        slope = float(away @ y / (away @ away))
        left = y - y.mean() - slope * away
        spread = float(((y - y.mean()) ** 2).sum())
        fitted = 1.0 - float(left @ left) / spread if spread > 0.0 else 1.0
        return slope, math.sqrt(float(left @ left) / (len(x) - 2) / float(away @ away)), fitted

    @property
    def exponent(self) -> float:
        """Uncertainty exponent; nan where fewer than three sizes meet a boundary."""
        return self._fit[0] + (0.0 if self.by == "states" else self.dimensions)

    @property
    def dimension(self) -> float:
        """Dimension of the boundary: that of the window less the exponent."""
        return self.dimensions - self.exponent

    @property
    def standard_error(self) -> float:
        """Standard error of the slope; nan for fewer than three sizes."""
        return self._fit[1]

    @property
    def r_squared(self) -> float:
        """Share of the variance of the logarithms that the line has."""
        return self._fit[2]

    @property
    def fitted(self) -> Floats:
        """Share on the fitted line at each size, shape (sizes,); nan where there is no line."""
        x, y = self._logs
        if not len(x):
            return np.full(len(self.size), math.nan)
        line = np.exp(y.mean() + self._fit[0] * (np.log(self.size) - x.mean()))
        return np.asarray(line if self.by == "states" else line / self.total)

    def interval(self, confidence: Confidence = CONFIDENCE) -> tuple[float, float]:
        """Return the interval of the exponent, from Student's distribution.

        The counts at several sizes are of one boundary and not independent: the interval measures
        how straight the line is, not the scatter between windows.

        Raises
        ------
        InputError
            If the confidence is outside its range.
        """
        from scipy.stats import t

        left = int(np.count_nonzero(self.uncertain)) - 2
        if left < 1:
            return math.nan, math.nan
        half = float(t.ppf(0.5 + 0.5 * confidence, left)) * self.standard_error
        return self.exponent - half, self.exponent + half


@checked
def compute_uncertainty_exponent(
    labels: Annotated[ArrayLike, INSIDE],
    sizes: Sequence[int] | None = None,
    *,
    by: Probe = "states",
) -> UncertaintyExponent:
    """Compute the uncertainty exponent of labelled states, and the dimension of their boundary.

    If initial conditions are known to within a distance e, a share f(e) of them has an uncertain
    attractor, and f falls as e^a [1]_: a = 1 for smooth boundaries, a < 1 for fractal ones, whose
    dimension is that of the window less a.  The exponent is the slope of ln f over ln e, a least
    squares line.

    By "states", a state is uncertain if a state e cells away on either side along an axis has
    another label.  By "boxes", as ``uncertainty_exponent`` of Attractors.jl, the window is divided
    into boxes of e cells a side, what is left at its ends does not count, and N(e) boxes have two
    labels or more: the dimension is the slope of ln N over -ln e.  Boxes of few states miss
    boundaries between them, so that a smooth boundary comes out above 1.

    Parameters
    ----------
    labels
        As for `compute_basin_entropy`.
    sizes
        e in cells, two or more; by default 1, 2, ... (of boxes 2, 3, ...) up to a twentieth of the
        window's longer side.
    by
        "states" (default) or "boxes".

    Returns
    -------
    UncertaintyExponent
        Exponent, dimension, standard error of the slope, and the counts.

    Raises
    ------
    InputError
        If the labels are no array of integers, or sizes are fewer than two or too large.

    References
    ----------
    .. [1] C. Grebogi, S. W. McDonald, E. Ott and J. A. Yorke, Phys. Lett. A 99, 415-418 (1983),
       https://doi.org/10.1016/0375-9601(83)90945-3

    Examples
    --------
    >>> import numpy as np
    >>> x, y = np.meshgrid(np.arange(200), np.arange(200))
    >>> exponent = compute_uncertainty_exponent(x > 120)
    >>> print(f"{exponent.exponent:.3f} {exponent.dimension:.3f}")
    1.000 1.000
    """
    array = label_array(labels)
    spans = probe_sizes(sizes, array.shape, by)
    counts = (_states if by == "states" else _boxes)(array, spans)
    return UncertaintyExponent(
        by=by, size=spans, uncertain=counts[0], total=counts[1], dimensions=array.ndim
    )


def probe_sizes(sizes: Sequence[int] | None, shape: tuple[int, ...], by: Probe) -> Integers:
    """Return the sizes in ascending order, or the default ones of a shape.

    Raises
    ------
    InputError
        If they are fewer than two, or outside their range.
    """
    # A perturbation reaches to both sides of a state.
    least, most = (1, (min(shape) - 1) // 2) if by == "states" else (2, min(shape))
    given = range(least, max(shape) // PARTS + 1) if sizes is None else sizes
    hint = "give whole numbers of cells, as [2, 4, 8]"
    if sizes is None and len(given) < 2:
        raise InputError(
            "sizes",
            Words("by default do not fit a window of " + " x ".join(map(str, shape)) + " states"),
            f"they need {PARTS * (least + 1)} or more along an axis",
            "take more states, or give sizes, as [2, 3, 4]",
        )
    numbers = {
        whole_number("sizes", size, at_least=least, at_most=max(least, most), hint=hint)
        for size in given
    }
    if len(numbers) < 2:
        raise InputError("sizes", sizes, "a line needs two different sizes or more", hint)
    return np.array(sorted(numbers), dtype=np.int64)


def _states(array: Integers, sizes: Integers) -> tuple[Integers, Integers]:
    """Return how many states are uncertain, those near the edge of the window left out."""
    margin = int(sizes[-1])
    inner = tuple(slice(margin, length - margin) for length in array.shape)
    middle = array[inner]
    counts = []
    for size in sizes.tolist():
        unsure = np.zeros(middle.shape, dtype=np.bool_)
        for axis in range(array.ndim):
            for step in (-size, size):
                shifted = list(inner)
                shifted[axis] = slice(margin + step, array.shape[axis] - margin + step)
                unsure |= array[tuple(shifted)] != middle
        counts.append(int(np.count_nonzero(unsure)))
    return np.array(counts, dtype=np.int64), np.full(len(sizes), middle.size, dtype=np.int64)


def _boxes(array: Integers, sizes: Integers) -> tuple[Integers, Integers]:
    """Return how many boxes have two labels or more, and how many there are."""
    counts, totals = [], []
    for size in sizes.tolist():
        box_counts = [length // size for length in array.shape]
        whole = array[tuple(slice(0, number * size) for number in box_counts)]
        split = whole.reshape([part for number in box_counts for part in (number, size)])
        inside = tuple(range(1, 2 * array.ndim, 2))
        mixed = split.max(axis=inside) != split.min(axis=inside)
        counts.append(int(np.count_nonzero(mixed)))
        totals.append(int(mixed.size))
    return np.array(counts, dtype=np.int64), np.array(totals, dtype=np.int64)
