"""FEMA P-58's fragilities of nine unanchored cabinets, in every unit that tools need."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.sides import Side
from rocksteady.risk.screens.thresholds import normal_share, velocity_number

INCH_M: Final = 0.0254
BETA: Final = 0.5
"""Standard deviation of ln(peak floor velocity), of all nine."""


@dataclass(frozen=True)
class Cabinet:
    """An unanchored cabinet of the P-58 fragility database.

    Attributes
    ----------
    row
        Its identifier.
    depth_in, height_in
        Size [in].
    median_m_s
        Median peak floor velocity of overturning [m/s].
    """

    row: str
    depth_in: float
    height_in: float
    median_m_s: float

    @cached_property
    def block(self) -> Block:
        """The cabinet as a homogeneous rectangle."""
        return Block.rectangle(width=INCH_M * self.depth_in, height=INCH_M * self.height_in)

    @property
    def number(self) -> float:
        """The median as p v/(g tan alpha)."""
        return velocity_number(self.block.positive, self.block.gravity, self.median_m_s)

    def distance(self, side: Side) -> float:
        """Return the root of the sum of squares of ln(depth ratio) and ln(height ratio)."""
        depth = 2.0 * side.distance / (INCH_M * self.depth_in)
        height = 2.0 * side.centre_height / (INCH_M * self.height_in)
        return math.hypot(math.log(depth), math.log(height))

    def probability(self, pfv_m_s: float) -> float:
        """Return the probability of overturning at a peak floor velocity [m/s]."""
        return normal_share(math.log(pfv_m_s / self.median_m_s) / BETA)

    def values(self) -> dict[str, str | float]:
        """Return the row of a table; mean and deviation are those that NRML 0.5 takes."""
        mean_cm_s = 100.0 * self.median_m_s * math.exp(0.5 * BETA * BETA)
        return {
            "row": self.row,
            "depth_in": self.depth_in,
            "height_in": self.height_in,
            "median_m_s": self.median_m_s,
            "median_cm_s": 100.0 * self.median_m_s,
            "median_in_s": self.median_m_s / INCH_M,
            "beta": BETA,
            "p_pfv_per_uplift": self.number,
            "nrml_mean_cm_s": mean_cm_s,
            "nrml_sd_cm_s": mean_cm_s * math.sqrt(math.expm1(BETA * BETA)),
        }


CABINETS: Final = tuple(
    Cabinet(f"E.20.22.{row}", depth, height, median)
    for row, depth, height, median in (
        ("102a", 12.625, 29.0, 0.724),
        ("103a", 12.625, 41.0, 0.493),
        ("104a", 12.625, 56.0, 0.361),
        ("105a", 12.625, 71.0, 0.290),
        ("106a", 12.625, 81.25, 0.251),
        ("112a", 15.0, 24.0, 1.229),
        ("114a", 15.0, 52.0, 0.498),
        ("124a", 18.6, 52.5, 0.688),
        ("125a", 18.6, 67.75, 0.526),
    )
)
"""Rows of FEMA P-58 for unanchored cabinets: depth and height [in], median velocity [m/s]."""


def nearest_cabinet(side: Side) -> Cabinet:
    """Return the cabinet whose depth and height are nearest, in ratios, to those of a block.

    FEMA P-58, fragility database, rows E.20.22.102a to 125a: medians and beta read in the source.
    They are about 0.79 of Kaneko and Hayashi's V50.
    """
    return min(CABINETS, key=lambda cabinet: cabinet.distance(side))
