"""Test of whether the boundary of basins is smooth at the scale of a ball of states."""

import math
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats, Integers
from rocksteady.dynamics.basins.measures.entropy import label_array
from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import INSIDE
from rocksteady.model.checks.validation import whole_number
from rocksteady.results.result import Result

RADIUS = 20
"""Default radius of a ball in cells, that of Attractors.jl."""
BALLS, FEWEST_BALLS = 1000, 100
"""Default number of balls, and the least."""
MOST_BALLS = 100_000
"""Above which an answer takes longer than its digits are worth."""
TRIES = 2000
"""Centres that are drawn for each ball before it is given up."""
AT_ONCE = 4096
FACTOR, POWER = 0.224, -1.006
"""Of the bias of a ball of cells, fitted by Puy et al."""
FINE = 50
"""Radii along a side of the window from which on it counts as fine enough."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class BoundaryCheck(Result):
    """Verdict on a basin boundary: smooth or fractal at the scale of a ball.

    Attributes
    ----------
    verdict
        "smooth" or "fractal".
    boundary_entropy
        Mean entropy of the balls [nats].
    standard_error
        Standard deviation of their entropy over the root of their number.
    smooth_entropy
        That of a plane boundary between two basins.
    bias
        Largest increase of the entropy that the cells may cause.
    radius
        Radius of the balls, in cells.
    balls
        Number of balls drawn on the boundary.
    seed
        Seed with which they were drawn.
    fine
        Whether the window is 50 radii wide or more.
    """

    verdict: Literal["smooth", "fractal"]
    boundary_entropy: float
    standard_error: float
    smooth_entropy: float
    bias: float
    radius: int
    balls: int
    seed: int
    fine: bool


@checked
def check_boundary(
    labels: Annotated[ArrayLike, INSIDE], ball: int = RADIUS, *, balls: int = BALLS, seed: int = 0
) -> BoundaryCheck:
    """Test whether the boundary of labelled states is smooth at one scale.

    Balls are drawn at random in the window, and those with two labels or more are kept.  If their
    mean entropy lies within one standard error of that of a plane boundary, and of the bias
    0.224 ball^-1.006 above it, the boundary counts as smooth [1]_.  About one smooth boundary in
    six is called fractal by chance.  As ``basins_fractal_test`` of Attractors.jl, with two
    differences: balls lie in the window whole, and the mean is of all balls.

    Parameters
    ----------
    labels
        As for `compute_basin_entropy`.
    ball
        Radius of a ball in cells (default 20).
    balls
        Number of balls on the boundary (default 1000, at least 100).
    seed
        Seed of the draw.

    Returns
    -------
    BoundaryCheck
        Verdict, entropy and what it is compared with.

    Raises
    ------
    InputError
        If an argument is not valid, or the window is no larger than a ball.
    ModelError
        If hardly a ball of the window lies on a boundary.

    References
    ----------
    .. [1] A. Puy et al., Commun. Nonlinear Sci. Numer. Simul. 95, 105588 (2021),
       https://doi.org/10.1016/j.cnsns.2020.105588

    Examples
    --------
    >>> import numpy as np
    >>> x, y = np.meshgrid(np.arange(400), np.arange(400))
    >>> print(check_boundary(x + 2 * y > 600, 8).verdict)
    smooth
    """
    array = label_array(labels)
    hint = "give a radius in cells below half of the window's width"
    most = max(1, (min(array.shape) - 1) // 2)
    reach = whole_number("ball", ball, at_least=1, at_most=most, hint=hint)
    balls_drawn = whole_number(
        "balls", balls, at_least=FEWEST_BALLS, at_most=MOST_BALLS, hint="give 1000"
    )
    source = whole_number("seed", seed, at_least=0, hint="give a seed, as 1")
    entropies = _ball_entropies(array, reach, balls_drawn, np.random.default_rng(source))
    mean = float(entropies.mean())
    error = float(entropies.std(ddof=1)) / math.sqrt(balls_drawn)
    smooth, bias = smooth_entropy(array.ndim), FACTOR * reach**POWER
    inside = smooth - error <= mean <= smooth + error + bias
    return BoundaryCheck(
        verdict="smooth" if inside else "fractal",
        boundary_entropy=mean,
        standard_error=error,
        smooth_entropy=smooth,
        bias=bias,
        radius=reach,
        balls=balls_drawn,
        seed=source,
        fine=min(array.shape) >= FINE * reach,
    )


def smooth_entropy(dimensions: int) -> float:
    """Return the mean entropy of balls that a plane cuts at random, in a number of dimensions.

    A plane at the distance h of the centre, -1 < h < 1, leaves the share p = I_{(1+h)/2}(c, c),
    c = (dimensions + 1)/2, of a ball on one side, I the regularised incomplete beta function; the
    mean of -p ln p - (1 - p) ln(1 - p) is over all h.

    Examples
    --------
    >>> [round(smooth_entropy(dimensions), 4) for dimensions in (1, 2, 3)]
    [0.5, 0.4395, 0.3961]
    """
    from scipy.integrate import quad
    from scipy.special import betainc, xlogy

    half = 0.5 * (dimensions + 1)

    def entropy(part: float) -> float:
        p = float(betainc(half, half, part))
        return -float(xlogy(p, p) + xlogy(1.0 - p, 1.0 - p))

    return float(quad(entropy, 0.0, 1.0)[0])


def _ball_entropies(array: Integers, radius: int, many: int, draw: np.random.Generator) -> Floats:
    """Return the entropy of balls drawn in a window, of those with two labels or more.

    Raises
    ------
    ModelError
        If there are next to none.
    """
    from scipy.ndimage import maximum_filter, minimum_filter

    # A ball lies in the cube around the cell nearest to its centre.
    cube = 2 * radius + 3
    mixed = maximum_filter(array, cube, mode="nearest") != minimum_filter(
        array, cube, mode="nearest"
    )
    steps = np.indices((2 * radius + 2,) * array.ndim).reshape(array.ndim, -1)
    low, high = float(radius), np.array(array.shape) - 1.0 - radius
    entropies: list[float] = []
    for _ in range(max(1, TRIES * many // AT_ONCE)):
        centres = low + draw.random((AT_ONCE, array.ndim)) * (high - low)
        nearest = np.rint(centres).astype(np.int64)
        for centre in centres[mixed[tuple(nearest.T)]]:
            places = np.floor(centre).astype(np.int64)[:, None] - radius + steps
            near = ((places - centre[:, None]) ** 2).sum(axis=0) <= radius * radius
            values = array[tuple(places[:, near])]
            counts = np.unique(values, return_counts=True)[1] / near.sum()
            if len(counts) > 1:
                entropies.append(-float(counts @ np.log(counts)))
            if len(entropies) == many:
                return np.array(entropies)
    raise ModelError(
        "labels",
        Words(f"have a boundary in {len(entropies)} of {TRIES * many:,} balls"),
        f"the test needs {many}",
        "take a window around the boundary, or a larger radius",
    )
