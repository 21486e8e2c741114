"""Objects that fall at a known level of the first measure, for oracles by hand."""

import numpy as np
from numpy.typing import NDArray

from rocksteady import Intensity, ObjectPrior, Survey
from rocksteady.risk.back_analysis._analysis import Tried
from rocksteady.risk.back_analysis._chances import Levels
from rocksteady.risk.observations.prior import Noise
from rocksteady.risk.observations.spread import Spread

Floats = NDArray[np.float64]

MEASURES = (Intensity("pga_g"), Intensity("pgv_m_s"))


def noise(sigma_ln: float, outliers: float) -> Noise:
    """Return errors that are known exactly."""
    return Noise(sigma_ln=Spread.exactly(sigma_ln), outliers=Spread.exactly(outliers))


def toy_survey(fell: list[bool]) -> Survey:
    """Return objects whose sizes play no part."""
    objects = [
        ObjectPrior(name=f"toy {place}", width_m=0.2, height_m=1.0, base=1.0)
        for place in range(len(fell))
    ]
    return Survey(objects=objects, fell=fell)


def toy_tried(
    thresholds: Floats,
    at_one: Floats,
    errors: Noise,
    *,
    limits: tuple[float, float] = (0.05, 2.0),
    count: int = 60,
) -> Tried:
    """Return runs of objects that fall from a threshold of the first measure on.

    Parameters
    ----------
    thresholds
        Of each object under each record, shape (objects, records).
    at_one
        Measures of the records, shape (records, 2).
    errors
        Their reach decides the levels.
    limits, count
        Of the levels.
    """
    levels = Levels.between(*limits, count, errors)
    fell = levels.simulated >= np.log(thresholds)[:, np.newaxis, :, np.newaxis]
    shares = fell.astype(np.float64)
    return Tried(
        names=tuple(f"record {place}" for place in range(len(at_one))),
        measures=MEASURES,
        at_one=at_one,
        levels=levels,
        shares=np.stack([shares, shares]),
        draws=2,
        seconds=0.0,
    )
