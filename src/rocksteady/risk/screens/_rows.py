"""Rows of the table of screens: each formula with its source, its value and its verdict."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.caps import conserving_pair
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.blocks.sides import Side, wall_ratio
from rocksteady.results.numbers import chance, number, quantity
from rocksteady.risk.screens.cabinets import nearest_cabinet
from rocksteady.risk.screens.demand import Demand
from rocksteady.risk.screens.friction import (
    SLIDES,
    Mode,
    exceeds,
    first_motion,
    lifts,
    needed_friction,
    uplift_acceleration_g,
)
from rocksteady.risk.screens.screen import Detail, Screen, Standing
from rocksteady.risk.screens.thresholds import (
    MEDIAN,
    circolare_rectangle,
    impulse_velocity_m_s,
    ishiyama_bounds,
    kaneko_hayashi,
    sampled,
    shares_at,
    velocity_number,
)
from rocksteady.seismic.measures.free_sides import first_side, free_sides, impact_ratios

NEAR = 0.25
"""Distance of a cabinet, in ln of its depth and height, up to which it has a verdict."""
LEAST_NUMBER = 0.2
"""p PGV/(g tan alpha) below which its row passes."""
RECTANGLE_SHARE = 0.75
"""M R^2/I_0 of a homogeneous rectangle."""
ALIKE = 1e-6
LIKE_EARTH = 0.01
"""Relative difference of a gravity from 9.80665 m/s^2 that formulas with fixed units bear."""
WALLS = "masonry walls"


@dataclass(frozen=True)
class Case:
    """A block, its demand and its friction, for all rows.

    Rows made for one side take the side that lifts first.
    """

    block: Block
    demand: Demand
    friction: float | None

    @cached_property
    def side(self) -> Side:
        """The side that lifts first."""
        return first_side(self.block)

    @cached_property
    def mode(self) -> Mode | None:
        """What the peak acceleration begins; None without it or without friction."""
        if self.demand.pga_g is None or self.friction is None:
            return None
        vertical = self.demand.vertical_at_peak_g
        return first_motion(self.block, self.demand.pga_g, self.friction, vertical)

    @cached_property
    def gravity_share(self) -> float:
        """Gravity less the vertical acceleration at the horizontal peak, over gravity."""
        return 1.0 - self.demand.vertical_at_peak_g * STANDARD_GRAVITY / self.block.gravity

    @property
    def shaken_up(self) -> bool:
        """Whether vertical motion acts at the horizontal peak."""
        return self.demand.vertical_at_peak_g > 0.0

    def vertical(self, words: str) -> str:
        """Return a remark on a row's use of vertical motion; empty where none is stated."""
        demand = self.demand
        if not self.shaken_up and not words.startswith("left out"):
            words = "left out, as SA_V/SA_H is stated alone; give vertical_g too"
            if demand.vertical_g:
                words = "none at the horizontal peak, as its share is 0"
        return f" Vertical motion: {words}." if demand.vertical_g or demand.sa_v_per_sa_h else ""

    @cached_property
    def off_earth(self) -> str:
        """Verdict of a formula with fixed units in another gravity; empty on Earth."""
        alike = abs(self.block.gravity / STANDARD_GRAVITY - 1.0) <= LIKE_EARTH
        return "" if alike else "no answer: made for 9.81 m/s^2"

    @cached_property
    def rectangular(self) -> bool:
        """Whether it is a homogeneous rectangle."""
        share = self.side.p**2 * self.side.radius / self.block.gravity
        alike = self.block.positive == self.block.negative
        return alike and abs(share / RECTANGLE_SHARE - 1.0) < ALIKE

    @cached_property
    def second(self) -> Side | None:
        """The side that lifts last; None where it is as the first, or a wall stands there."""
        last = max(free_sides(self.block), key=lambda side: side.alpha)
        return None if self.block.symmetric or self.block.one_sided else last

    def rocking(
        self,
        *,
        remark: str = "",
        answered: bool = True,
        approximate: bool = False,
        no_answer: str = "",
        **fields: Any,
    ) -> Screen:
        """Return a row that takes rocking for granted: refused where the block slides.

        Its formula was made for rectangles, and, unless it is one of walls, for rocking to both
        sides.  Without an answer it needs an input; with words in `no_answer` it is refused without
        a value.
        """
        if no_answer:
            fields |= {"value": None, "passes": None, "needs": "", "details": ()}
            fields["verdict"] = no_answer
            return Screen(status="refused", remark=remark * (not self.off_earth), **fields)
        if not self.rectangular:
            approximate = True
            remark += " Made for homogeneous rectangles"
            if self.second is not None:
                remark += "; the side that lifts first is taken, as if both were like it"
            remark += "."
        if self.block.one_sided and fields.get("made_for") != WALLS:
            approximate = True
            remark += " Made for blocks that rock to both sides: the wall is left out."
        status: Standing = "needs input"
        if answered and self.mode in SLIDES:
            status = "refused"
            fields |= {"verdict": "no answer: friction governs", "passes": None}
        elif answered:
            status = "approximate" if approximate else "computed"
        return Screen(status=status, remark=remark.strip(), **fields)


def _missing(demand: Demand, *keys: str) -> tuple[str, str]:
    """Return the verdict of a row that lacks some of these peaks, and their keys."""
    lacking = [key for key in keys if getattr(demand, key) is None]
    verdict = "needs " + " and ".join(f"a {key[:3].upper()}" for key in lacking)
    return verdict, " and ".join(lacking)


def uplift_row(case: Case) -> Screen:
    """Return the row of uplift."""
    value = uplift_acceleration_g(case.block, case.demand.vertical_at_peak_g)
    pga = case.demand.pga_g
    verdict, needs = _missing(case.demand, "pga_g")
    if pga is not None:
        lifted = exceeds(pga, value)
        verdict = f"stays down at {number(pga)} g"
        if lifted:
            verdict = f"lifts: {number(pga)} g is {number(pga / value)} times it"
    remark = "To its free side." if case.block.one_sided else ""
    details: tuple[Detail, ...] = ()
    if case.second is not None:
        uplift = value / tan(case.side.alpha) * tan(case.second.alpha)
        details = (("other side", uplift, "g"),)
        remark = "Of the side that lifts first."
    remark += case.vertical("downwards, a_v of (g - a_v) tan(α)")
    return Screen(
        name="uplift",
        equation="(g - a_v) tan(α)",
        edition="statics (West)",
        source="moment about the edge; often quoted as West's formula for overturning, which it "
        "is not",
        status="computed",
        value=value,
        unit="g",
        verdict=verdict,
        needs=needs,
        details=details,
        remark=remark.strip(),
    )


def friction_row(case: Case) -> Screen:
    """Return the row of the friction that rocking needs."""
    pga, friction = case.demand.pga_g, case.friction
    needs = ""
    value = tan(max(side.alpha for side in free_sides(case.block)))
    details: tuple[Detail, ...] = ()
    if pga is None:
        verdict, needs = "needs a PGA; this is its least, at uplift", "pga_g"
    else:
        need = needed_friction(case.block, pga, case.demand.vertical_at_peak_g)
        value = need.largest
        details = (("at uplift", need.at_uplift, ""), ("at impacts", need.at_impact, ""))
        if case.mode is None:
            verdict, needs = "needs the friction; below it the block slides", "friction"
        else:
            more = ": friction governs" if case.mode in SLIDES else ""
            words = "stays at rest" if case.mode == "rest" else case.mode
            verdict = f"{words}{more} (μ {number(friction or 0.0)})"
    remark = "A friction above width/height alone does not ensure pure rocking: the need grows "
    remark += "with the PGA."
    if case.second is not None:
        remark += " The greater of both sides: shaking reverses."
    return Screen(
        name="friction to rock",
        equation="rocking limit",
        edition="Shenton 1996",
        source="H. W. Shenton, J. Eng. Mech. 122, 690-693 (1996)",
        status="needs input" if pga is None else "computed",
        value=value,
        unit="",
        verdict=verdict,
        needs=needs,
        details=details,
        remark=remark + case.vertical("downwards, taken from g"),
    )


def restitution_row(case: Case) -> Screen:
    """Return the row of the restitution that conserves angular momentum about the new edge."""
    block, gravity, cap = case.block, case.block.gravity, case.block.cap
    sides = block.positive, block.negative
    first = sides.index(case.side)
    value: float | None = conserving_pair(*sides, gravity, cap)[first]
    verdict = f"this block has {number(impact_ratios(block)[first])}"
    equation, edition = "momentum at edge", "Housner 1963"
    source = (
        "G. W. Housner, Bull. Seism. Soc. Am. 53, 403-417 (1963); for unequal sides "
        "(I_c + m R1 R2 cos(alpha1 + alpha2))/(I_c + m R2^2)"
    )
    remark = "Tests often exceed it, up to its square root."
    if block.one_sided:
        value = None
        equation, edition = "momentum at wall", "Sorrentino 2008"
        source = (
            "L. Sorrentino, S. Kunnath, G. Monti and G. Scalora, Eng. Struct. 30, 2140-2153 "
            "(2008): impacts on base, wall and base, (1 - 2 k sin^2 alpha)^2 |1 - 2 k cos^2 alpha|"
        )
        remark = "Of the wall; the free block's own is not used."
        if cap is not None:
            verdict = "no answer: angular momentum gives none for a frame against a wall"
        else:
            try:
                value = wall_ratio(*sides, gravity)
            except InputError:
                verdict = "no answer: a wall does not turn back a block so stocky"
    elif cap is not None:
        edition = "Makris 2013"
        source = (
            "N. Makris and M. F. Vassiliou, Earthq. Eng. Struct. Dyn. 42, 431-449 (2013), of "
            "columns under a cap"
        )
    return Screen(
        name="restitution",
        equation=equation,
        edition=edition,
        source=source,
        status="computed",
        value=value,
        unit="",
        verdict=verdict,
        remark=remark + case.vertical("left out, as an impact has no duration"),
    )


def ishiyama_row(case: Case) -> Screen:
    """Return the row of Ishiyama's lower bounds."""
    bounds = ishiyama_bounds(case.side, case.block.gravity)
    least = case.gravity_share * bounds.pga_g
    pga, pgv = case.demand.pga_g, case.demand.pgv_m_s
    needs, passes, value, unit = "", None, bounds.pgv_m_s, "m/s"
    if pga is not None and exceeds(least, pga):
        verdict, passes, value, unit = "does not overturn: PGA below its bound", True, least, "g"
    elif pgv is not None and exceeds(bounds.pgv_m_s, pgv):
        verdict, passes = "does not overturn: PGV below its bound", True
    elif pga is not None and pgv is not None:
        verdict, passes = "may overturn: both bounds are reached", False
    else:
        verdict, needs = _missing(case.demand, "pga_g", "pgv_m_s")
    return case.rocking(
        name="Ishiyama bound",
        equation="(B/H) g, .4 V_i",
        edition="Ishiyama 1982",
        source="Y. Ishiyama, Earthq. Eng. Struct. Dyn. 10, 635-650 (1982)",
        value=value,
        unit=unit,
        verdict=verdict,
        passes=passes,
        needs=needs,
        counts_vertical=case.shaken_up and (passes is False or unit == "g"),
        details=(
            ("PGA bound", least, "g"),
            ("PGV bound", bounds.pgv_m_s, "m/s"),
            ("V_i", impulse_velocity_m_s(case.side, case.block.gravity), "m/s"),
            *((("10 B/sqrt(H)", bounds.simple_m_s, "m/s"),) if not case.off_earth else ()),
        ),
        remark=f"Both must be reached, PGA {quantity(least, 'g')} and PGV "
        f"{quantity(bounds.pgv_m_s, 'm/s')}."
        + f" His simple rule 10 B/sqrt(H) [cm, s] gives {quantity(bounds.simple_m_s, 'm/s')}."
        * (not case.off_earth)
        + case.vertical("downwards in the PGA bound; left out of PGV's, as it reverses in a swing"),
    )


def kaneko_hayashi_row(case: Case) -> Screen:
    """Return the row of Kaneko and Hayashi's 50 % threshold."""
    bounds = kaneko_hayashi(case.side, case.block.gravity)
    pga, pgv = case.demand.pga_g, case.demand.pgv_m_s
    details = [
        ("A50", bounds.acceleration_g, "g"),
        ("V50", bounds.velocity_m_s, "m/s"),
        ("Fe", bounds.limit_hz, "Hz"),
    ]
    value, unit, needs, passes = bounds.acceleration_g, "g", "", None
    if pga is not None and pgv is not None:
        hertz = pga * STANDARD_GRAVITY / (2.0 * math.pi * pgv)
        value = bounds.threshold_g(hertz)
        details += [("F = PGA/(2 pi PGV)", hertz, "Hz"), ("threshold at F", value, "g")]
        # A median bounds nothing: where it is not reached up to half still overturn.
        passes = None if pga < value else False
        verdict = f"{'more' if pga >= value else 'fewer'} than half overturn at {number(pga)} g"
    elif pga is not None and pga < bounds.acceleration_g:
        verdict = f"fewer than half overturn at {number(pga)} g"
    elif pgv is not None and pgv < bounds.velocity_m_s:
        verdict = f"fewer than half overturn at {number(pgv)} m/s"
        value, unit = bounds.velocity_m_s, "m/s"
    else:
        verdict, needs = _missing(case.demand, "pga_g", "pgv_m_s")
    return case.rocking(
        no_answer=case.off_earth,
        name="Kaneko-Hayashi 50 %",
        equation="A50, V50, Fe",
        edition="13WCEE 2004",
        source="M. Kaneko and Y. Hayashi, 13th World Conf. Earthq. Eng., Vancouver (2004)",
        value=value,
        unit=unit,
        verdict=verdict,
        passes=passes,
        needs=needs,
        details=tuple(details),
        remark=f"A50 {quantity(bounds.acceleration_g, 'g')} up to Fe "
        f"{quantity(bounds.limit_hz, 'Hz')}, V50 {quantity(bounds.velocity_m_s, 'm/s')} above it; "
        "the frequency of the floor is taken as PGA/(2 pi PGV)."
        + case.vertical("left out, as the medians are of horizontal motion alone"),
    )


def circolare_row(case: Case) -> Screen:
    """Return the row of the Circolare's rectangle, with FC 1 and with FC 1.35."""
    gravity = case.block.gravity
    full, poor = (circolare_rectangle(case.side, gravity, factor) for factor in (1.0, 1.35))
    pga, share = case.demand.pga_g, case.gravity_share
    value = share * poor.a0_lumped_g
    factors = (("FC 1", full), ("FC 1.35", poor))
    details = [(f"a0, e* 1, {name}", share * each.a0_lumped_g, "g") for name, each in factors]
    details += [(f"a0, e* 0.75, {name}", share * each.a0_g, "g") for name, each in factors]
    details += [("d0", full.d0_m, "m"), ("0.4 d0 (SLV)", full.d_slv_m, "m")]
    details += [("0.6 d0 (SLC)", full.d_slc_m, "m")]
    for name, each in factors:
        details += [(f"T_SLV, {name}", each.t_slv_s, "s"), (f"T_SLC, {name}", each.t_slc_s, "s")]
    verdict, needs = _missing(case.demand, "pga_g")
    passes = None
    if pga is not None:
        passes = pga <= value
        verdict = f"S_e(0) {'below' if passes else 'above'} a0 with FC 1.35, without q"
        if not passes and pga <= share * full.a0_lumped_g:
            verdict = "S_e(0) below a0 with FC 1, above it with FC 1.35, without q"
    return case.rocking(
        made_for=WALLS,
        name="Circolare rectangle",
        equation="C8.7.1 (3,10,11)",
        edition="Circ. 2019 n. 7",
        source="Circolare 21 January 2019 n. 7, C8.7.1, pages 272-277; the second bullets of both "
        "displacement limits could not be read",
        value=value,
        unit="g",
        verdict=verdict,
        passes=passes,
        counts_vertical=case.shaken_up,
        needs=needs,
        details=tuple(details),
        remark="S_e(0), the PGA, is compared without the behaviour factor q = 2 that SLV's linear "
        "check allows: `facade` makes the checks. With the mass at its centre, e* = 1, which "
        "decides; with the mass spread, e* = 0.75, a0 is "
        f"{quantity(share * poor.a0_g, 'g')}. d0 {quantity(full.d0_m, 'm')}, T_SLV "
        f"{quantity(full.t_slv_s, 's')} with FC 1."
        + case.vertical("downwards in a0; left out of d0 and periods, as it reverses in a swing"),
    )


def velocity_row(case: Case) -> Screen:
    """Return the row of p PGV/(g tan alpha), with what fell in its range."""
    gravity, pgv, pga = case.block.gravity, case.demand.pgv_m_s, case.demand.pga_g
    value, passes = None, None
    verdict, needs = _missing(case.demand, "pgv_m_s")
    outside = not sampled(case.side)
    middle = MEDIAN * gravity * tan(case.side.alpha) / case.side.p
    details = [(f"PGV at {MEDIAN:g}", middle, "m/s")]
    lifted = pga is None or lifts(case.block, pga, case.demand.vertical_at_peak_g)
    if pgv is not None:
        value = velocity_number(case.side, gravity, pgv)
        if not lifted:
            verdict, passes = "stays down: PGA below uplift", True
        else:
            shares = shares_at(value)
            published, ours = (chance(share) for share in shares)
            verdict = f"{published} and {ours} of such blocks fall"
            passes = value < LEAST_NUMBER
            details += [("published", shares[0], ""), ("this package", shares[1], "")]
        ratio = pgv / impulse_velocity_m_s(case.side, gravity)
        details.append(("PGV/V_i", ratio, ""))
    return case.rocking(
        name="p PGV/(g tan alpha)",
        equation="two lognormals",
        edition="Chu et al. 2025",
        source="inferred from 28,399 classified runs, Chu et al., Earthq. Eng. Struct. Dyn. 54, "
        "3576 (2025), doi 10.1002/eqe.70042; second figure runs of this package on 56 records",
        value=value,
        unit="",
        verdict=verdict,
        passes=passes,
        counts_vertical=case.shaken_up and pga is not None and (passes is False or not lifted),
        needs=needs,
        details=tuple(details),
        answered=value is not None,
        approximate=outside,
        remark="Of blocks that lift, at any PGA: theirs, and that of runs of this package. "
        f"Passed below {LEAST_NUMBER:g} only."
        + (" The block lies outside the latter: alpha 0.1 to 0.3 rad, p 1 to 3 rad/s." * outside)
        + case.vertical("downwards in uplift; the formula of the shares has none"),
    )


def cabinets_row(case: Case) -> Screen:
    """Return the row of FEMA P-58's cabinets: the one nearest to the block."""
    cabinet = nearest_cabinet(case.side)
    distance = cabinet.distance(case.side)
    pgv = case.demand.pgv_m_s
    needs, passes = "", None
    details = [
        ("distance", distance, ""),
        ("median", cabinet.median_m_s, "m/s"),
        ("p median/(g tan alpha)", cabinet.number, ""),
    ]
    if pgv is None:
        verdict, needs = "needs a peak floor velocity", "pgv_m_s"
    else:
        share = cabinet.probability(pgv)
        details.append(("probability", share, ""))
        passes = None if pgv < cabinet.median_m_s else False
        verdict = f"{chance(share)} of such cabinets fall"
    size = f"{cabinet.depth_in:g} x {cabinet.height_in:g} in"
    return case.rocking(
        no_answer=case.off_earth or "no cabinet is near to this size" * (distance > NEAR),
        made_for="cabinets",
        name="FEMA P-58 cabinets",
        equation=cabinet.row,
        edition="FEMA P-58",
        source="FEMA P-58 fragility database, unanchored cabinets, E.20.22.102a to 125a, peak "
        "floor velocity, beta 0.5",
        value=cabinet.median_m_s,
        unit="m/s",
        verdict=verdict,
        passes=passes,
        needs=needs,
        details=tuple(details),
        remark=f"Nearest is {cabinet.row}, {size}, at a distance of {number(distance)} in the "
        f"logarithms of depth and height; a verdict up to {NEAR:g}."
        + case.vertical("left out, as the medians are of peak floor velocity alone"),
    )


ROWS = (uplift_row, friction_row, restitution_row, ishiyama_row, kaneko_hayashi_row, velocity_row)
"""Rows for any block, the most general first."""
