"""All published formulas for one block and one demand, side by side, never averaged."""

from dataclasses import dataclass, replace
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import FRICTION
from rocksteady.results.result import Result
from rocksteady.risk.screens import _rows
from rocksteady.risk.screens._asce import asce_row
from rocksteady.risk.screens.demand import Demand
from rocksteady.risk.screens.friction import SLIDES
from rocksteady.risk.screens.screen import ANY_BLOCK, KINDS, Kind, Screen


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class Screens(Result):
    """Published formulas for one block, from `rocksteady.screen_block`.

    Attributes
    ----------
    block, demand, friction, kind
        Inputs of the screens; no friction and no kind of object where they are not known.
    rows
        One `Screen` for each formula that applies: the governing one of a kind first.  Without a
        kind those for any block, then those made for one kind, which have no `passes`.
    left_out
        Rows made for other kinds of object.
    motion
        What the peak acceleration begins: "rest", "rocks", "slides" or "slides and rocks"; None
        without PGA or friction.  Where it slides, rows on rocking are refused.
    """

    block: Block
    demand: Demand
    friction: float | None
    kind: Kind | None
    rows: tuple[Screen, ...]
    left_out: tuple[Screen, ...]
    motion: str | None

    @property
    def negative(self) -> bool:
        """Whether any row does not pass, or the block slides and rows on rocking are refused."""
        return self.motion in SLIDES or any(row.passes is False for row in self.rows)

    @property
    def governing(self) -> Screen | None:
        """The row made for the kind of object; None where there is none."""
        first = self.rows[0]
        return None if first.made_for == ANY_BLOCK else first

    @property
    def undecided(self) -> bool:
        """Whether the row that governs neither passes nor fails, or no row does."""
        lacks = self.governing is not None and self.governing.passes is None
        return lacks or all(row.passes is None for row in self.rows)

    @property
    def scope(self) -> tuple[str, str]:
        """Label and words of the rows left out, or of a kind that is not stated."""
        if self.kind is None:
            words = "rows of all kinds are shown, and those for any block counted"
            return "kind", f"none of {', '.join(KINDS)} is stated: {words}"
        return f"not for a {self.kind}", ", ".join(row.name for row in self.left_out)

    def row(self, name: str) -> Screen:
        """Return the row of a name.

        Raises
        ------
        InputError
            If there is none.
        """
        for row in self.rows:
            if row.name == name:
                return row
        names = ", ".join(row.name for row in self.rows)
        raise InputError("name", name, "there is no such row", f"give one of: {names}")

    def ratio(self, row: Screen) -> float | None:
        """Return the demand over the threshold of a row; None of one without a threshold."""
        demand = {"g": self.demand.pga_g, "m/s": self.demand.pgv_m_s}.get(row.unit)
        return demand / row.value if demand is not None and row.value and not row.needs else None


@checked
def screen_block(
    block: Block,
    demand: Demand,
    *,
    friction: Annotated[float | None, FRICTION] = None,
    object_kind: Kind | None = None,
) -> Screens:
    """Apply published formulas for rocking and overturning to a block, side by side.

    Parameters
    ----------
    block
        The block.  For one whose sides differ the side that lifts first is taken, and rows made for
        rectangles note this; for one against a wall its free side, and rows made for rocking to
        both sides note this.
    demand
        Peak acceleration in g and velocity in m/s, and a spectrum where it is known.  A row whose
        input is missing names it.
    friction
        Coefficient between block and base; None (default) where it is not known.  Where it is too
        small for rocking alone the rows on rocking are refused.
    object_kind
        Kind of object: "cask" (any component of a nuclear facility), "cabinet", "wall" or "statue".
        The row made for it stands first, and rows made for other kinds are left out.  None
        (default) where it is not known: rows of all kinds, of which those for any block count.

    Returns
    -------
    Screens
        A row for each formula that applies: equation, edition, value, unit, verdict.

    Raises
    ------
    InputError
        If the friction is negative, the kind is unknown, or the base falls as fast as the block.

    Examples
    --------
    >>> from rocksteady import Block, Demand, screen_block
    >>> block = Block.rectangle(width=0.32, height=1.8)
    >>> screens = screen_block(block, Demand(pga_g=0.35, pgv_m_s=0.4), friction=0.4)
    >>> print(screens.motion, f"{screens.row('friction to rock').value:.4f}")
    rocks 0.2199
    """
    demand = demand.with_peak()
    case = _rows.Case(block, demand, friction)
    rows = [make(case) for make in _rows.ROWS]
    special = {
        "cask": asce_row(case),
        "wall": _rows.circolare_row(case),
        "cabinet": _rows.cabinets_row(case),
    }
    others = [row for of, row in special.items() if of != object_kind]
    if object_kind is None:
        rows += [
            replace(row, passes=None, verdict=f"{row.verdict}; made for {row.made_for}")
            for row in others
        ]
    return Screens(
        block=block,
        demand=demand,
        friction=friction,
        kind=object_kind,
        rows=(*([special[object_kind]] if object_kind in special else []), *rows),
        left_out=tuple(others if object_kind else []),
        motion=case.mode,
    )
