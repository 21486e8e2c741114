"""Objects that fall at a known level of the first measure, for oracles by hand."""

import numpy as np
from numpy.typing import NDArray

from rocksteady import Nonlinear
from rocksteady.calibration import ObjectPrior, Survey
from rocksteady.measures import Measure
from rocksteady.risk.back_analysis._analysis import Tried
from rocksteady.risk.back_analysis._chances import Levels
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.risk.observations.spread import PriorRange

Floats = NDArray[np.float64]

MEASURES = (Measure("pga_g"), Measure("pgv_m_s"))


def noise(sigma_ln: float, outliers: float) -> OutcomeErrors:
    """Return errors that are known exactly."""
    return OutcomeErrors(
        sigma_ln=PriorRange.exactly(sigma_ln), outliers=PriorRange.exactly(outliers)
    )


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
    errors: OutcomeErrors,
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
        model=Nonlinear(),
    )
