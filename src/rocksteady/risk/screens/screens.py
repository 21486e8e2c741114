"""All published formulas for one block and one demand, side by side, never averaged."""

from dataclasses import dataclass, replace
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import FRICTION
from rocksteady.model.facts import block_text, block_values
from rocksteady.results.answer import Answer
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, quantity
from rocksteady.results.result import Result
from rocksteady.risk.screens import _rows
from rocksteady.risk.screens._asce import asce_row
from rocksteady.risk.screens._cabinets import CABINETS
from rocksteady.risk.screens.demand import Demand
from rocksteady.risk.screens.friction import SLIDES
from rocksteady.risk.screens.screen import ANY_BLOCK, KINDS, Kind, Screen

DISCLAIMER = (
    "Each row implements the equation that it names, not checked against the printed standard; the "
    "engineer verifies. The rows stand side by side and are not averaged."
)
PEAKS = ("pga_g", "pgv_m_s", "vertical_g", "vertical_share")
RESULTS = (
    Column("name", "screen", left=True),
    Column("value", "value", str),
    Column("verdict", "verdict", left=True),
)
SOURCES = (
    Column("name", "screen", left=True),
    Column("equation", "equation", left=True),
    Column("edition", "edition", left=True),
    Column("made_for", "made for", left=True),
)


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

    def describe(self) -> Description:
        """Return the rows with their sources, intermediate quantities and remarks."""
        demand = self.demand
        judged = [row for row in self.rows if row.passes is not None]
        passed = sum(row.passes is True for row in judged)
        pairs = ((demand.pga_g, "g"), (demand.pgv_m_s, "m/s"))
        peaks = [quantity(value, unit) for value, unit in pairs if value is not None]
        shaking = f" at {' and '.join(peaks)}" if peaks else ""
        vertical = quantity(demand.vertical_g, "g")
        shaking += f" with a vertical peak of {vertical}" if self._counts_vertical else ""
        friction = "not known" if self.friction is None else number(self.friction)
        words = [{**row.values(), "value": row.words} for row in self.rows]
        details = [
            {"screen": row.name, "quantity": name, "value": value, "unit": unit}
            for row in self.rows
            for name, value, unit in row.details
        ]
        left_out = [{"name": row.name, "made_for": row.made_for} for row in self.left_out]
        remarks = [f"{row.name}: {row.remark}" for row in self.rows if row.remark]
        return Description(
            headline=f"Screens of a {self.kind or 'block'}{shaking}: it passes {passed} of "
            f"{len(judged)}",
            facts=[
                Fact("block", block_values(self.block), "block", block_text(self.block)),
                Fact("kind", self.kind, *self.scope),
                *(Fact(key, getattr(demand, key)) for key in PEAKS),
                Fact("sa_v_per_sa_h", demand.spectral_ratio),
                Fact("friction", self.friction, "friction", friction),
                Fact("motion", self.motion, "motion", self.motion or "needs PGA and friction"),
            ],
            tables=[
                Table("screens", [row.values() for row in self.rows]),
                Table("", words, RESULTS),
                Table("", words, SOURCES, title="Sources"),
                Table("left_out", left_out),
                Table("details", details),
                Table("cabinets", [cabinet.values() for cabinet in CABINETS]),
            ],
            notes=[DISCLAIMER, *remarks],
            answer=self._answer(shaking, passed, judged),
        )

    @property
    def _counts_vertical(self) -> bool:
        """Whether the vertical peak enters a verdict, or the block slides under it."""
        sliding = self.motion in SLIDES and self.demand.vertical_at_peak_g > 0.0
        return sliding or any(r.counts_vertical for r in self.rows if r.passes is not None)

    def _answer(self, at: str, passed: int, judged: list[Screen]) -> Answer:
        """Return how many formulas it passes, and the formulas, those not passed first."""
        count, made_for = len(judged), f" for {f'a {self.kind}' if self.kind else ANY_BLOCK}"
        prefix = governs = ""
        if (first := self.governing) and first.passes is None:
            governs = f"The screen made for a {self.kind}, {first.name}: {first.verdict}. "
            prefix, made_for = "other ", ""
        screens = f"{prefix}published screen{'s' * (count != 1)}{made_for}"
        passes = f"passes {passed or 'none'} of {count} {screens}"
        if count == 1:
            passes = f"{'passes' if passed else 'fails'} the one {screens} that has a verdict"
        none = f"No answer yet: none of the {screens} has a verdict"
        sentence = f"{governs}{f'It {passes}' if judged else none}{at}."
        if self.motion in SLIDES:
            sentence = f"It slides{at}: no screen of rocking is an answer."
        shown = [row for row in self.rows if not row.needs and row.name != "restitution"]
        order, last = {False: 0, None: 1, True: 2}, self.kind is not None
        shown.sort(key=lambda row: ((row.made_for == ANY_BLOCK) == last, order[row.passes]))
        following = self._next()
        needs = [row for row in self.rows[bool(governs) :] if row.needs][: 0 if following else 2]
        needed = [f"{row.name} {row.verdict.partition(';')[0]}" for row in needs]
        outside = ", ".join(row.name for row in judged if row.status == "approximate")
        unused = f"{quantity(self.demand.vertical_g, 'g')} enters no row that has a verdict"
        unused *= self.demand.vertical_g > 0.0 and not self._counts_vertical
        facts = [
            self.scope,
            ("as one body", self.block.parts),
            ("no verdict", "; ".join(needed)),
            ("give next", following),
            ("approximate", outside and f"{outside}: the block is outside its range"),
            ("vertical motion", unused),
        ]
        rows = [(row.name, f"{row.verdict} ({row.words})".removesuffix(" (—)")) for row in shown]
        return Answer(sentence, facts, rows)

    def _next(self) -> str:
        """Return what a demand of a spectrum alone is without, in words; empty of others."""
        demand = self.demand
        if demand.spectrum is None or demand.pga_g is not None:
            return ""
        damping = any(row.needs == "spectrum_damping" for row in self.rows)
        rest = "for the rest a PGA (or its row at period 0) and a PGV, or a record"
        return "its damping, as 0.05; " * damping + rest


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
