"""Dimensionless block: restitution, and the ratios between its two sides."""

from dataclasses import dataclass, replace

from rocksteady.errors import ModelError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import RESTITUTION, Bounds, restitution_of_wall
from rocksteady.results.result import Result

SideRow = tuple[float, float, float]
"""Restitution, alpha over the reference alpha, p over the reference p."""

LARGEST_RATIO = 100.0

_OF_SIDES = Bounds(
    1.0 / LARGEST_RATIO, LARGEST_RATIO, "[]", "give the negative side's over the positive side's"
)
_RULES = {
    "restitution": RESTITUTION,
    "negative_restitution": RESTITUTION,
    "alpha_ratio": _OF_SIDES,
    "p_ratio": _OF_SIDES,
}


@checked
@dataclass(frozen=True, kw_only=True, repr=False)
class DimensionlessBlock(Result):
    """A dimensionless block: its restitution, and the ratios between its sides.

    Angles count in units of alpha, times in units of 1/p, accelerations in units of alpha g, with
    alpha and p of the positive side.

    Parameters
    ----------
    restitution
        Ratio of the angular velocities after and before an impact, in (0, 1]; where there is a
        `negative_restitution`, before an impact that ends positive rotation.
    negative_restitution
        The same of an impact that ends negative rotation; None (default) for `restitution`.
    alpha_ratio, p_ratio
        The negative side's alpha and p over the positive side's, from 0.01 to 100; 1 (default) of a
        symmetric block.
    one_sided
        Whether a wall behind the block stops it at angle 0, so that it rocks to the positive side
        alone; False by default.  `restitution` is then that of the wall, in [0, 1], and the block
        has no other side.

    Raises
    ------
    InputError
        If a number lies outside its range.

    Examples
    --------
    >>> DimensionlessBlock(restitution=0.8).sides
    ((0.8, 1.0, 1.0), (0.8, 1.0, 1.0))
    >>> DimensionlessBlock(restitution=0.8, alpha_ratio=1.5, p_ratio=0.95).sides
    ((0.8, 1.0, 1.0), (0.8, 1.5, 0.95))
    """

    restitution: float
    negative_restitution: float | None = None
    alpha_ratio: float = 1.0
    p_ratio: float = 1.0
    one_sided: bool = False

    def __post_init__(self) -> None:
        """Validate."""
        if self.one_sided:
            ratio = restitution_of_wall("restitution", self.restitution)
            object.__setattr__(self, "restitution", ratio)
            self._refuse_another_side()
            return
        for name, rule in _RULES.items():
            value = getattr(self, name)
            if value is not None or name != "negative_restitution":
                object.__setattr__(self, name, rule(name, value))

    def _refuse_another_side(self) -> None:
        """Refuse numbers of a side that a block against a wall does not have."""
        for name, plain in (("negative_restitution", None), ("alpha_ratio", 1), ("p_ratio", 1)):
            if getattr(self, name) != plain:
                raise ModelError(
                    name,
                    getattr(self, name),
                    "a block against a wall rocks on its positive side alone",
                    "leave it out, or leave out one_sided",
                )

    def __eq__(self, other: object) -> bool:
        """Return whether the other is a block that moves alike."""
        return isinstance(other, DimensionlessBlock) and self.sides == other.sides

    def __hash__(self) -> int:
        """Return the same number for blocks that move alike."""
        return hash(self.sides)

    @property
    def sides(self) -> tuple[SideRow, SideRow]:
        """(restitution, alpha ratio, p ratio) of the positive and of the negative side.

        The ratios refer to the positive side.  A wall's restitution is negative, as the ratio of
        velocities is; the row of the wall's side has 1 in all places.
        """
        if self.one_sided:
            return (-self.restitution, 1.0, 1.0), (1.0, 1.0, 1.0)
        negative = (
            self.restitution if self.negative_restitution is None else self.negative_restitution
        )
        return (self.restitution, 1.0, 1.0), (negative, self.alpha_ratio, self.p_ratio)

    @property
    def symmetric(self) -> bool:
        """Whether the two sides are alike, so that the mirror image of a motion is a motion."""
        return self.sides[0] == self.sides[1]

    @property
    def lossless(self) -> bool:
        """Whether no impact takes anything from the velocity: restitution 1 on both sides."""
        return abs(self.sides[0][0]) == self.sides[1][0] == 1.0

    def with_restitution(self, restitution: float) -> "DimensionlessBlock":
        """Return the block with another restitution, the same of both impacts."""
        return replace(self, restitution=restitution, negative_restitution=None)

    def dimensionless(self) -> "DimensionlessBlock":
        """Return itself."""
        return self
