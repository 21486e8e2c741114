"""Accelerations of floors by the formulas of codes, beside which computed responses stand."""

from typing import TYPE_CHECKING, Annotated, Final

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.risk.screens.demand import PGA

if TYPE_CHECKING:
    from rocksteady.arrays import Floats

PERIOD: Final = Bounds(0.01, 60.0, "[]", "give the building's period in seconds, as 0.5")
HEIGHT_RATIO: Final = Bounds(0.0, 1.0, "[]", "give z/H: 0 at the ground, 1 at the roof")
NTC: Final = ((0.8, 1.4, 5.0), (0.3, 1.2, 4.0), (0.3, 1.0, 2.5))
"""a, b and a_p for T_1 < 0.5 s, to 1 s and beyond (Circolare 7/2019, table C7.2.II)."""


@checked
def floor_accelerations(
    periods_s: ArrayLike,
    *,
    pga_g: Annotated[float, PGA],
    building_period_s: Annotated[float, PERIOD],
    height_ratio: Annotated[float, HEIGHT_RATIO],
) -> "dict[str, Floats]":
    """Return the acceleration of components on a floor [g] by three codes, of an elastic building.

    Parameters
    ----------
    periods_s
        Periods T_a of the component [s], 0 or above, shape (periods,).
    pga_g
        Peak ground acceleration a_g S, or 0.4 S_DS [g].
    building_period_s
        T_1 of the building [s].
    height_ratio
        z/H of the floor.

    Returns
    -------
    dict
        "ASCE 7-22", the peak of the floor, alike for all periods: ``a (1 + a_1 z/H + a_2
        (z/H)^10)`` with ``a_1 = 1/T_1 <= 2.5`` and ``a_2 = 1 - (0.4/T_1)^2 >= 0`` (eq. 13.3-4
        with R_mu = 1); "EN 1998-1", ``a (3 (1 + z/H)/(1 + (1 - T_a/T_1)^2) - 0.5) >= a``
        (4.3.5.2); "NTC 2018", ``a (1 + z/H) a_p/(1 + (a_p - 1)(1 - T_a/(c T_1))^2)``, c = a below
        a T_1, a_p alone to b T_1, and c = b and at least a beyond (Circolare C7.2.3,
        of buildings with frames).

    Raises
    ------
    InputError
        If a number is outside its range.

    Examples
    --------
    >>> found = floor_accelerations([0.0, 0.5], pga_g=0.2, building_period_s=0.5, height_ratio=1.0)
    >>> {code: [round(float(a), 3) for a in values] for code, values in found.items()}
    {'ASCE 7-22': [0.672, 0.672], 'EN 1998-1': [0.5, 1.1], 'NTC 2018': [0.4, 1.6]}
    """
    periods = np.asarray(periods_s, dtype=np.float64)
    if not (np.isfinite(periods) & (periods >= 0.0)).all():
        raise InputError("periods_s", periods_s, "all must be 0 or above", "give seconds")
    t1, z = building_period_s, height_ratio
    flexible, roof = min(1.0 / t1, 2.5), max(1.0 - (0.4 / t1) ** 2, 0.0)
    asce = np.full(periods.shape, 1.0 + flexible * z + roof * z**10)
    a, b, most = NTC[(t1 >= 0.5) + (t1 > 1.0)]
    with np.errstate(over="ignore"):  # infinite, a period is that of the limit
        en = np.maximum(3.0 * (1.0 + z) / (1.0 + (1.0 - periods / t1) ** 2) - 0.5, 1.0)
        low, high = (most / (1.0 + (most - 1.0) * (1.0 - periods / (c * t1)) ** 2) for c in (a, b))
    between = np.where(periods < a * t1, low, most)
    ntc = np.where(periods < b * t1, (1.0 + z) * between, np.maximum((1.0 + z) * high, 1.0))
    codes = {"ASCE 7-22": asce, "EN 1998-1": en, "NTC 2018": ntc}
    return {code: pga_g * values for code, values in codes.items()}
