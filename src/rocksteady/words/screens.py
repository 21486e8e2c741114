"""Words of published formulas: of one, and of all for a block side by side."""

from rocksteady.model.facts import block_text, block_values
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import number, quantity
from rocksteady.results.result import describes
from rocksteady.risk.screens.cabinets import CABINETS
from rocksteady.risk.screens.friction import SLIDES
from rocksteady.risk.screens.screen import ANY_BLOCK, Screen
from rocksteady.risk.screens.screens import Screens


@describes(Screen)
def describe_screen(screen: Screen) -> Description:
    """Return value, verdict and source, and the intermediate quantities."""
    columns = (
        Column("quantity", "quantity", left=True),
        Column("value", "value", number),
        Column("unit", "unit", left=True),
    )
    keys = [column.key for column in columns]
    rows = [dict(zip(keys, detail, strict=True)) for detail in screen.details]
    shown = ("verdict", "equation", "edition", "status", "made_for", "source")
    return Description(
        headline=f"{screen.name}: {screen.words}; {screen.verdict}",
        facts=[
            Fact(key, value, key.replace("_", " ") if key in shown and value else "")
            for key, value in screen.values().items()
        ],
        tables=[Table("details", rows, columns)] if rows else [],
        notes=[screen.remark] if screen.remark else [],
    )


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


@describes(Screens)
def describe_screens(screens: Screens) -> Description:
    """Return the rows with their sources, intermediate quantities and remarks."""
    demand = screens.demand
    judged = [row for row in screens.rows if row.passes is not None]
    passed = sum(row.passes is True for row in judged)
    pairs = ((demand.pga_g, "g"), (demand.pgv_m_s, "m/s"))
    peaks = [quantity(value, unit) for value, unit in pairs if value is not None]
    shaking = f" at {' and '.join(peaks)}" if peaks else ""
    vertical = quantity(demand.vertical_g, "g")
    shaking += f" with a vertical peak of {vertical}" if _counts_vertical(screens) else ""
    friction = "not known" if screens.friction is None else number(screens.friction)
    words = [{**row.values(), "value": row.words} for row in screens.rows]
    details = [
        {"screen": row.name, "quantity": name, "value": value, "unit": unit}
        for row in screens.rows
        for name, value, unit in row.details
    ]
    left_out = [{"name": row.name, "made_for": row.made_for} for row in screens.left_out]
    remarks = [f"{row.name}: {row.remark}" for row in screens.rows if row.remark]
    sentence, screen, rows = _answer(screens, shaking, passed, judged)
    return Description(
        headline=f"Screens of a {screens.kind or 'block'}{shaking}: it passes {passed} of "
        f"{len(judged)}",
        facts=[
            *screen,
            Fact("block", block_values(screens.block), "block", block_text(screens.block)),
            Fact("kind", screens.kind, *screens.scope),
            *(Fact(key, getattr(demand, key)) for key in PEAKS),
            Fact("sa_v_per_sa_h", demand.spectral_ratio),
            Fact("friction", screens.friction, "friction", friction),
            Fact("motion", screens.motion, "motion", screens.motion or "needs PGA and friction"),
        ],
        tables=[
            Table("screens", [row.values() for row in screens.rows]),
            Table("", words, RESULTS),
            Table("", words, SOURCES, title="Sources"),
            Table("left_out", left_out),
            Table("details", details),
            Table("cabinets", [cabinet.values() for cabinet in CABINETS]),
        ],
        notes=[DISCLAIMER, *remarks],
        sentence=sentence,
        rows=rows,
    )


def _counts_vertical(screens: Screens) -> bool:
    """Whether the vertical peak enters a verdict, or the block slides under it."""
    sliding = screens.motion in SLIDES and screens.demand.vertical_at_peak_g > 0.0
    return sliding or any(r.counts_vertical for r in screens.rows if r.passes is not None)


def _answer(
    screens: Screens, at: str, passed: int, judged: list[Screen]
) -> tuple[str, list[Fact], list[tuple[str, str]]]:
    """Return how many formulas it passes, and the formulas, those not passed first."""
    count, made_for = len(judged), f" for {f'a {screens.kind}' if screens.kind else ANY_BLOCK}"
    prefix = governs = ""
    if (first := screens.governing) and first.passes is None:
        governs = f"The screen made for a {screens.kind}, {first.name}: {first.verdict}. "
        prefix, made_for = "other ", ""
    formulas = f"{prefix}published screen{'s' * (count != 1)}{made_for}"
    passes = f"passes {passed or 'none'} of {count} {formulas}"
    if count == 1:
        passes = f"{'passes' if passed else 'fails'} the one {formulas} that has a verdict"
    none = f"No answer yet: none of the {formulas} has a verdict"
    sentence = f"{governs}{f'It {passes}' if judged else none}{at}."
    if screens.motion in SLIDES:
        sentence = f"It slides{at}: no screen of rocking is an answer."
    shown = [row for row in screens.rows if not row.needs and row.name != "restitution"]
    order, last = {False: 0, None: 1, True: 2}, screens.kind is not None
    shown.sort(key=lambda row: ((row.made_for == ANY_BLOCK) == last, order[row.passes]))
    following = _next(screens)
    needs = [row for row in screens.rows[bool(governs) :] if row.needs][: 0 if following else 2]
    needed = [f"{row.name} {row.verdict.partition(';')[0]}" for row in needs]
    outside = ", ".join(row.name for row in judged if row.status == "approximate")
    unused = f"{quantity(screens.demand.vertical_g, 'g')} enters no row that has a verdict"
    unused *= screens.demand.vertical_g > 0.0 and not _counts_vertical(screens)
    facts = [
        line(*screens.scope),
        line("as one body", screens.block.parts),
        line("no verdict", "; ".join(needed)),
        line("give next", following),
        line("approximate", outside and f"{outside}: the block is outside its range"),
        line("vertical motion", unused),
    ]
    rows = [(row.name, f"{row.verdict} ({row.words})".removesuffix(" (—)")) for row in shown]
    return sentence, facts, rows


def _next(screens: Screens) -> str:
    """Return what a demand of a spectrum alone is without, in words; empty of others."""
    demand = screens.demand
    if demand.spectrum is None or demand.pga_g is not None:
        return ""
    damping = any(row.needs == "spectrum_damping" for row in screens.rows)
    rest = "for the rest a PGA (or its row at period 0) and a PGV, or a record"
    return "its damping, as 0.05; " * damping + rest
