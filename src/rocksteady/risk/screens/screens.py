"""All published formulas for one block and one demand, side by side, never averaged."""

from dataclasses import dataclass
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.facts import block_text, block_values
from rocksteady.results.answer import Answer, left_out
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, quantity
from rocksteady.results.result import Result
from rocksteady.risk.screens import _rows
from rocksteady.risk.screens._asce_row import OF_SPECTRUM, asce_row
from rocksteady.risk.screens._cabinets import CABINETS
from rocksteady.risk.screens._rows import SLIDES
from rocksteady.risk.screens.demand import FRICTION, Demand
from rocksteady.risk.screens.friction import Mode
from rocksteady.risk.screens.screen import Screen

DISCLAIMER = (
    "Each row implements the equation that it names, not checked against the printed standard; the "
    "engineer verifies. The rows stand side by side and are not averaged."
)
RESULTS = (
    Column("name", "screen", left=True),
    Column("value", "value", str),
    Column("verdict", "verdict", left=True),
)
SOURCES = (
    Column("name", "screen", left=True),
    Column("equation", "equation", left=True),
    Column("edition", "edition", left=True),
)


def four_digits(value: float) -> str:
    """Return a number with four significant digits, zeros included."""
    return f"{value:#.4g}"


CABINET_COLUMNS = (
    Column("row", "P-58 row", left=True),
    Column("size", "depth x height", left=True),
    Column("median_m_s", "m/s", four_digits),
    Column("median_cm_s", "cm/s", four_digits),
    Column("median_in_s", "in/s", four_digits),
    Column("p_pfv_per_uplift", "p v/(g tan alpha)", four_digits),
)


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class Screens(Result):
    """Published formulas for one block, from `rocksteady.screen_block`.

    Attributes
    ----------
    block, demand, friction
        Inputs of the screens; no friction where it is not known.
    rows
        One `Screen` for each formula.
    motion
        What the peak acceleration begins: "rest", "rocks", "slides" or "slides and rocks"; None
        without PGA or friction.  Where it slides, rows on rocking are refused.
    """

    block: Block
    demand: Demand
    friction: float | None
    rows: tuple[Screen, ...]
    motion: str | None

    @property
    def negative(self) -> bool:
        """Whether any row does not pass, or the block slides and rows on rocking are refused."""
        return self.motion in SLIDES or any(row.passes is False for row in self.rows)

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
        passed = sum(bool(row.passes) for row in judged)
        peaks = [
            quantity(value, unit)
            for value, unit in ((demand.pga_g, "g"), (demand.pgv_m_s, "m/s"))
            if value is not None
        ]
        shaking = f" at {' and '.join(peaks)}" if peaks else ""
        vertical = ("vertical", demand.vertical_words) if demand.vertical_words else ()
        friction = "not known" if self.friction is None else number(self.friction)
        shown = [row.values() for row in self.rows]
        words = [{**row.values(), "value": row.words} for row in self.rows]
        details = [
            {"screen": row.name, "quantity": name, "value": value, "unit": unit}
            for row in self.rows
            for name, value, unit in row.details
        ]
        cabinets = [cabinet.values() for cabinet in CABINETS]
        sized = [{**row, "size": f"{row['depth_in']} x {row['height_in']} in"} for row in cabinets]
        remarks = [f"{row.name}: {row.remark}" for row in self.rows if row.remark]
        return Description(
            headline=f"Screens of a block{shaking}: it passes {passed} of {len(judged)}",
            facts=[
                Fact("block", block_values(self.block), "block", block_text(self.block)),
                Fact("pga_g", demand.pga_g),
                Fact("pgv_m_s", demand.pgv_m_s),
                Fact("vertical_g", demand.vertical_g, *vertical),
                Fact("vertical_share", demand.vertical_share),
                Fact("sa_v_per_sa_h", demand.sa_v_per_sa_h),
                Fact("friction", self.friction, "friction", friction),
                Fact("motion", self.motion, "motion", self.motion or "needs PGA and friction"),
            ],
            tables=[
                Table("screens", shown),
                Table("", words, RESULTS),
                Table("", words, SOURCES, title="Sources"),
                Table("details", details),
                Table("cabinets", cabinets),
                Table("", sized, CABINET_COLUMNS, title="FEMA P-58 cabinets, median velocities"),
            ],
            notes=[DISCLAIMER, *remarks],
            answer=self._answer(shaking, passed, len(judged)),
        )

    def _answer(self, at: str, passed: int, judged: int) -> Answer:
        """Return how many formulas it passes, and the formulas, those not passed first."""
        sentence = f"No answer yet: none of the published screens has a verdict{at}."
        row = self.row(OF_SPECTRUM)
        if self.demand.spectrum is not None and row.needs:
            sentence = f"No answer yet: a spectrum alone decides {row.name}, which {row.verdict}."
        if judged:
            sentence = f"It passes {passed or 'none'} of {judged} published screens{at}."
        if self.motion in SLIDES:
            sentence = f"It slides{at}: no screen of rocking is an answer."
        shown = [row for row in self.rows if row.value is not None and not row.needs]
        shown = [row for row in shown if row.name != "restitution"]
        shown.sort(key=lambda row: (row.passes is True, row.passes is None))
        most = max(5, sum(row.passes is False for row in shown))
        following = self._next()
        needs = [] if following else [row for row in self.rows if row.needs]
        left = [row.name for row in shown[most:]]
        facts = [
            left_out(len(left), ", ".join(left)),
            (
                "no verdict",
                "; ".join(f"{row.name} {row.verdict.partition(';')[0]}" for row in needs[:2]),
            ),
            ("give next", following),
            ("vertical", self.demand.vertical_words),
        ]
        rows = [(row.name, f"{row.verdict} ({row.words})") for row in shown[:most]]
        return Answer(sentence, facts, rows)

    def _next(self) -> str:
        """Return what a demand of a spectrum alone is without, in words; empty of others."""
        demand = self.demand
        if demand.spectrum is None or demand.pga_g is not None:
            return ""
        damping = "its damping, as 0.05; " if demand.spectrum_damping is None else ""
        return f"{damping}for the rest a PGA (or its row at period 0) and a PGV, or a record"


@checked
def screen_block(
    block: Block, demand: Demand, *, friction: Annotated[float | None, FRICTION] = None
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

    Returns
    -------
    Screens
        A row for each formula: equation, edition, value, unit, verdict.

    Raises
    ------
    InputError
        If the friction is negative, or the base falls as fast as the block.

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
    rows = (
        _rows.uplift_row(case),
        _rows.friction_row(case),
        _rows.restitution_row(case),
        asce_row(case),
        _rows.ishiyama_row(case),
        _rows.kaneko_hayashi_row(case),
        _rows.circolare_row(case),
        _rows.velocity_row(case),
        _rows.cabinets_row(case),
    )
    mode: Mode | None = case.mode
    return Screens(block=block, demand=demand, friction=friction, rows=rows, motion=mode)
