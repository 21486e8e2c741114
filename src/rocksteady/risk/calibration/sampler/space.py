"""Parameters of one object: what tests are to tell of its block, and priors as wide as geometry."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.kernels.elementary.arrays import hypot, log, tan
from rocksteady.risk.calibration.sampler.exact import rounded
from rocksteady.risk.observations.object_prior import BOUNDS, ObjectPrior
from rocksteady.risk.observations.spread import PriorRange

ALPHA, RATE, RATIO = 0, 2, 3
"""Columns of the sides of an object: slenderness, p, restitution."""
SHARE_BITS = 26
"""Grid of the shares of the prior that scores stand for."""
ROUND = 0.1
"""Half difference of ln tan alpha below which an object counts as nearly symmetric."""

WIDEST: Final[Mapping[str, tuple[PriorRange, PriorRange]]] = {
    "base": (PriorRange.in_logarithm(0.03, 1.2), PriorRange.in_logarithm(*BOUNDS["base"][:2])),
    "offset": (PriorRange.between(-0.6, 0.6), PriorRange.between(-0.95, 0.95)),
    "mass_centre_height_m": (PriorRange.between(0.3, 0.6), PriorRange.between(0.1, 0.9)),
    "gyration_m": (PriorRange.between(0.85, 1.1), PriorRange.between(0.5, 1.4)),
    "housner_factor": (PriorRange.between(0.85, 1.1), PriorRange.between(0.5, 1.5)),
    "scatter": (PriorRange.between(0.0, 0.1), PriorRange.between(0.0, 0.3)),
    "orientation_rad": (PriorRange.between(-0.3, 0.3), PriorRange.between(-1.5, 1.5)),
}
"""Prior of a number that is not given, and the wider one where tests contradict it.

Natural stones may rest on far less than half of their outline: a prior without that costs accuracy.

The height of the mass centre is a share of the outline's, the radius of gyration one of that of the
outline's rectangle.
"""


def widened(block: ObjectPrior, names: Mapping[str, bool]) -> ObjectPrior:
    """Return an object with the prior of some numbers that are not given.

    Parameters
    ----------
    block
        The object.
    names
        Names of numbers, each with whether its prior is the wider one.
    """
    middle = {key: spread.middle for key, spread in block.spreads.items()}
    height = middle.get("height_m", 0.0)
    width = middle.get("width_m", middle.get("left_m", 0.0) + middle.get("right_m", 0.0))
    tall = height if height > 0.0 else 2.0 * middle.get("mass_centre_height_m", 0.0)
    units = {"mass_centre_height_m": height, "gyration_m": hypot(width, tall) / np.sqrt(12.0)}
    changed = {}
    for name, wider in names.items():
        spread, unit = WIDEST[name][wider], float(units.get(name, 1.0))
        changed[name] = replace(spread, low=unit * spread.low, high=unit * spread.high)
    return replace(block, **changed) if changed else block  # type: ignore[arg-type]


@dataclass(frozen=True, kw_only=True, eq=False)
class Space:
    """What is free of an object, as normal scores: those of the prior are standard normal.

    Attributes
    ----------
    block
        What is known of the object, every number with its spread.
    """

    block: ObjectPrior

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.block.parameters

    @property
    def size(self) -> int:
        """How many there are."""
        return len(self.names)

    def values_of(self, scores: Floats) -> Floats:
        """Return values from normal scores, shape (draws, parameters)."""
        from scipy.special import ndtr

        least = 2.0**-SHARE_BITS
        shares = np.clip(rounded(ndtr(scores), SHARE_BITS), least, 1.0 - least)
        return self.block.draw(shares)

    def orientation(self, values: Floats) -> Floats:
        """Return the angle of the plane of rocking from the first channel [rad], shape (draws,)."""
        name = "orientation_rad"
        if name in self.names:
            return values[:, self.names.index(name)]
        spread = self.block.spreads.get(name)
        return np.full(len(values), 0.0 if spread is None else spread.low)

    def derived(self, values: Floats) -> dict[str, Floats]:
        """Return slenderness, p and restitution of each draw, of the side that lifts first."""
        sides = self.block.sides(values)
        first = sides[np.arange(len(sides)), np.argmin(sides[:, :, ALPHA], axis=1)]
        return {
            "alpha_rad": first[:, ALPHA],
            "p_rad_s": first[:, RATE],
            "restitution": first[:, RATIO],
        }

    def features(self, values: Floats) -> Floats:
        """Return what fates depend on, shape (draws, features).

        ln tan alpha of the weaker side, to which a block falls, half the difference d of both, |d|
        rounded at 0, mean ln p, mean restitution, scatter, and the orientation if it is free.
        """
        sides = self.block.sides(values)
        lean, rate = log(tan(sides[:, :, ALPHA])), log(sides[:, :, RATE])
        apart = 0.5 * (lean[:, 0] - lean[:, 1])
        size = np.sqrt(apart * apart + ROUND**2)
        columns = [
            0.5 * (lean[:, 0] + lean[:, 1]) - size,
            apart,
            size,
            0.5 * (rate[:, 0] + rate[:, 1]),
            0.5 * (sides[:, 0, RATIO] + sides[:, 1, RATIO]),
            self.block.scatter_of(values),
        ]
        if "orientation_rad" in self.names:
            columns.append(self.orientation(values))
        return np.stack(columns, axis=1)
