"""Rocking frames: equal free-standing columns under one rigid cap, as one equivalent block.

A frame has two columns or more; one pier with its cap is a body (`rocksteady.Block.capped`).  The
cap stands on the upper corners of the columns and only translates, twice as far as their mass
centres.  With a cap of `cap_mass_ratio` = gamma times the mass of its columns the frame obeys the
equation of one column with another p and another restitution::

    p^2 = g (1 + 2 gamma)/(R (j + 4 gamma)),    e = 1 - 2 sin^2 alpha (1 + 4 gamma)/(j + 4 gamma)

where j = I_0/(M R^2) of a column.  With 4/3 of a rectangle p^2 is (1 + 2 gamma)/(1 + 3 gamma) times
that of a column, and e is ``(1 - 1.5 sin^2 alpha + 3 gamma cos 2 alpha)/(1 + 3 gamma)``.

N. Makris and M. F. Vassiliou, Earthquake Eng. Struct. Dyn. 42, 431-449 (2013).
"""

import math
from dataclasses import dataclass, replace
from typing import Annotated

from rocksteady.errors import InputError, ModelError
from rocksteady.kernels.elementary.arrays import sin
from rocksteady.model.blocks.sides import SAME_BODY, Side, housner_pair, wall_ratio
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, Whole

CAP_MASS = Bounds(0.0, 1000.0, "[]", "give the mass of the cap over that of all columns, as 2")
COLUMNS = Whole(1, 1000, "give the number of equal columns, as 4")


@checked
@dataclass(frozen=True, kw_only=True)
class Cap:
    """The cap of a rocking frame.

    Parameters
    ----------
    columns
        Number of equal columns that it stands on; alpha, p and restitution do not depend on it.
    cap_mass_ratio
        Its mass over that of all columns together.

    Raises
    ------
    InputError
        If there are fewer than two columns, or the ratio is below 0 or above 1000.
    """

    columns: Annotated[int, COLUMNS._replace(low=2)]
    cap_mass_ratio: Annotated[float, CAP_MASS]

    @property
    def lever(self) -> float:
        """Motion of the mass centre of the whole frame over that of one column."""
        return (1.0 + 2.0 * self.cap_mass_ratio) / (1.0 + self.cap_mass_ratio)

    @property
    def words(self) -> str:
        """The frame in words, before the size of a column."""
        return f"frame of {self.columns} columns, cap {self.cap_mass_ratio:.4g} of their mass,"

    def to_dict(self) -> dict[str, float]:
        """Return it under the names of the commands' JSON."""
        return dict(vars(self))

    def of_column(self, column: Side, gravity: float) -> Side:
        """Return the side of the frame of a column, with the column's restitution."""
        share = gravity / (column.p * column.p * column.radius) + 4.0 * self.cap_mass_ratio
        p = math.sqrt(gravity * (1.0 + 2.0 * self.cap_mass_ratio) / (column.radius * share))
        return replace(column, p=p, cap_mass_ratio=self.cap_mass_ratio)

    def check_column(self, side: Side, gravity: float, *, alike: bool) -> None:
        """Refuse a side of a frame that no column of it has.

        Parameters
        ----------
        side, gravity
            Of the frame.
        alike
            Whether its sides are alike, in their default outline.

        Raises
        ------
        ModelError
            If they are not, or a column would have a negative moment of inertia.
        """
        if not alike:
            raise ModelError(
                "cap",
                self,
                "columns have their mass in mid-height, are as wide as their base, and have sides "
                "that are alike",
                "give such a column, and take its capped(...)",
            )
        share = (1.0 + 2.0 * self.cap_mass_ratio) / (1.0 + 4.0 * self.cap_mass_ratio)
        most = math.sqrt(share * gravity / side.radius)
        if side.p > most * (1.0 + SAME_BODY):
            raise ModelError(
                "p",
                side.p,
                f"columns without a moment of inertia would have {most:.10g} rad/s",
                "give the column, and take its capped(...)",
            )

    def housner_ratio(self, side: Side, gravity: float) -> float:
        """Return the restitution of a side that conserves angular momentum, positive or not."""
        share = gravity * (1.0 + 2.0 * self.cap_mass_ratio) / (side.p * side.p * side.radius)
        sine = sin(side.alpha)
        return 1.0 - 2.0 * (sine * sine) * (1.0 + 4.0 * self.cap_mass_ratio) / share


def conserving_pair(
    positive: Side, negative: Side, gravity: float, cap: Cap | None
) -> tuple[float, float]:
    """Return `housner_pair` of a single block, or the same of a frame."""
    if cap is None:
        return housner_pair(positive, negative, gravity)
    return (cap.housner_ratio(positive, gravity),) * 2


def has_factor(
    factor: float,
    positive: Side,
    negative: Side,
    gravity: float,
    wall: float | None,
    cap: Cap | None,
) -> bool:
    """Return whether the restitutions of a block are a factor of Housner's.

    Parameters
    ----------
    factor
        The factor.
    positive, negative, gravity
        The block.
    wall
        Restitution of the wall that it stands against; None of none.
    cap
        Cap of a frame; None of a single block.
    """
    if wall is None:
        given = [positive.restitution, negative.restitution]
        values = [*conserving_pair(positive, negative, gravity, cap)]
    else:
        try:
            given, values = [wall], [wall_ratio(positive, negative, gravity)]
        except InputError:  # so stocky that it has none
            return False
    pairs = zip(given, values, strict=True)
    return all(math.isclose(ratio, factor * value, rel_tol=SAME_BODY) for ratio, value in pairs)
