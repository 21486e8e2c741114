"""A synthetic survey for examples: clearly named, seeded, and of no place."""

from typing import Annotated

import numpy as np

from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Whole
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.spread import PriorRange

HEIGHTS_M = (0.5, 1.6)
SLENDERNESS = (2.5, 6.0)
"""Height over width."""
TRUE_PGA_G = 0.35
"""PGA of the survey: an object falls where this exceeds 1.25 times its width over height."""


@checked
def make_synthetic_survey(
    count: Annotated[int, Whole(2, 10_000, "give 12")] = 12,
    *,
    seed: Annotated[int, Whole(0, None, "give a seed, as 0")] = 0,
) -> Survey:
    """Make a survey of synthetic objects, for trials without a cemetery.

    Parameters
    ----------
    count
        Number of objects; default 12.
    seed
        A whole number of 0 or above; the same one gives the same survey.

    Returns
    -------
    Survey
        Objects of 0.5 to 1.6 m, 2.5 to 6 times as high as wide.  Those fell that are more slender
        than most; no shaking was simulated.

    Raises
    ------
    InputError
        If a number is outside its range.

    Examples
    --------
    >>> make_synthetic_survey()
    <Survey: 12 objects: 7 fell, 5 stood>
    """
    part = np.random.default_rng(seed).random((2, count))
    heights = HEIGHTS_M[0] * (HEIGHTS_M[1] / HEIGHTS_M[0]) ** part[0]
    ratios = SLENDERNESS[0] * (SLENDERNESS[1] / SLENDERNESS[0]) ** part[1]
    widths = heights / ratios
    objects = [
        ObjectPrior(
            name=f"synthetic {place + 1}",
            width_m=PriorRange.between(0.97 * width, 1.03 * width),
            height_m=PriorRange.between(0.98 * height, 1.02 * height),
            base=PriorRange.between(0.9, 1.0),
        )
        for place, (width, height) in enumerate(zip(widths.tolist(), heights.tolist(), strict=True))
    ]
    # West's formula with a margin: it orders objects by slenderness alone.
    return Survey(objects=objects, fell=(widths / heights < TRUE_PGA_G / 1.25).tolist())
