"""The probability that a block falls, from PGA and PGV alone, by a closed form."""

import math
from dataclasses import dataclass
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import FRICTION
from rocksteady.model.facts import block_text, block_values
from rocksteady.results.answer import Answer
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import chance, number, quantity
from rocksteady.results.result import Result
from rocksteady.results.words import Label, facts_of
from rocksteady.risk.screens.demand import PGA, PGV, Demand
from rocksteady.risk.screens.friction import (
    FrictionNeed,
    Mode,
    first_motion,
    lifts,
    needed_friction,
    uplift_acceleration_g,
)
from rocksteady.risk.screens.thresholds import (
    BETA,
    MEDIAN,
    OTHER_BETA,
    OTHER_MEDIAN,
    shares_at,
    velocity_number,
)
from rocksteady.seismic.measures.free_sides import first_side

SOURCE = (
    "Lognormal in p PGV/(g tan alpha), median 0.757 and beta 0.592, where PGA > g tan alpha; "
    "0 below. Inferred from 28,399 classified runs of Chu, Giouvanidis, Loong and "
    "Dimitrakopoulos, Earthq. Eng. Struct. Dyn. 54, 3576 (2025), doi 10.1002/eqe.70042. The "
    "second probability has 0.672 and 0.462, from nonlinear runs of this package on 56 records."
)
CAVEAT = (
    "Not covered: the uncertainty of the shaking, bouncing, sliding during rocking, a soft floor, "
    "three dimensions, vertical motion after uplift, and restitution other than Housner's. The "
    "probability is a share of many motions of this PGA and PGV, not a prediction for one of them. "
    "It is no substitute for anchorage rules; the engineer verifies."
)
STRONGEST_PGA_G = 4.0
"""Beyond it a PGA is remarked on: about 4 g was recorded in 2008 (IWTH25, vertical included)."""
USUAL_RATIO_S = (0.01, 0.5)
"""PGV/PGA [s] of recorded motions; beyond it a unit is doubtful."""
SAMPLED_ALPHA, SAMPLED_P = (0.1, 0.3), (1.0, 3.0)
"""Slenderness [rad] and p [rad/s] of runs of this package."""
WORDS = (
    (0.001, "1 in 1000"),
    (0.002, "1 in 500"),
    (0.003, "3 in 1000"),
    (0.005, "1 in 200"),
    (0.01, "1 in 100"),
    (0.02, "1 in 50"),
    (0.03, "3 in 100"),
    (0.05, "1 in 20"),
    (0.1, "1 in 10"),
    (0.15, "3 in 20"),
    (0.2, "1 in 5"),
    (0.25, "1 in 4"),
    (0.3, "3 in 10"),
    (1.0 / 3.0, "1 in 3"),
    (0.4, "2 in 5"),
    (0.5, "1 in 2"),
    (0.6, "3 in 5"),
    (2.0 / 3.0, "2 in 3"),
    (0.7, "7 in 10"),
    (0.75, "3 in 4"),
    (0.8, "4 in 5"),
    (0.85, "17 in 20"),
    (0.9, "9 in 10"),
    (0.95, "19 in 20"),
    (0.98, "49 in 50"),
    (0.99, "99 in 100"),
)
"""Probabilities that a reader knows from life."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class FormulaAssessment(Result):
    """Probability that a block falls, from `rocksteady.risk.assess_by_formula`.

    Attributes
    ----------
    block, pga_g, pgv_m_s, friction, vertical_g, vertical_share
        Inputs of the assessment; no friction where it is not known.
    probability
        Probability of overturning; None where the block slides, since the formula is for rocking
        alone.
    other_probability
        The same with median and beta of runs of this package.
    median_pgv_m_s, beta
        PGV at which half of such blocks that lift fall [m/s], and standard deviation of its
        logarithm.
    other_median_pgv_m_s, other_beta
        The same of runs of this package.
    uplift_pga_g
        PGA that lifts the block [g], with the vertical motion.
    friction_needed
        Friction with which it rocks without sliding at this PGA, impacts included.
    friction_cause
        What needs that friction: "uplift" (Shenton 1996) or "impacts".
    verdict
        "rest", "rocks" or "slides", alone or while it rocks; without friction it does not slide.
    sentence
        The answer.
    remarks
        Doubts about the input.
    """

    block: Block
    pga_g: Annotated[float, Label("PGA", unit="g")]
    pgv_m_s: Annotated[float, Label("PGV", unit="m/s")]
    friction: float | None
    vertical_g: float
    vertical_share: float
    probability: Annotated[float | None, Label("probability of falling", chance)]
    other_probability: Annotated[float | None, Label("second probability", chance)]
    median_pgv_m_s: Annotated[float, Label("median PGV")]
    beta: float
    other_median_pgv_m_s: float
    other_beta: float
    uplift_pga_g: Annotated[float, Label("lifts at", unit="g")]
    friction_needed: Annotated[float, Label("friction needed")]
    friction_cause: str
    verdict: str
    sentence: str
    remarks: tuple[str, ...] = ()

    @property
    def demand(self) -> Demand:
        """Both peaks and the vertical motion."""
        return Demand(
            pga_g=self.pga_g,
            pgv_m_s=self.pgv_m_s,
            vertical_g=self.vertical_g,
            vertical_share=self.vertical_share,
        )

    def describe(self) -> Description:
        """Return the sentence, both probabilities, the thresholds and the source."""
        given = "not given" if self.friction is None else f"{number(self.friction)} given"
        need = f"{number(self.friction_needed)} to rock without sliding at this PGA"
        if self.friction_cause == "impacts":
            need += ", for impacts"
        vertical = self.demand.vertical_words
        return Description(
            headline=self.sentence,
            facts=facts_of(
                self,
                Fact("block", block_values(self.block), "block", block_text(self.block)),
                "pga_g pgv_m_s",
                Fact("vertical_g", self.vertical_g, "vertical" if vertical else "", vertical),
                "vertical_share probability other_probability median_pgv_m_s beta "
                "other_median_pgv_m_s other_beta uplift_pga_g friction_needed friction_cause "
                "friction verdict sentence",
                Fact("source", SOURCE),
                "remarks",
                median_pgv_m_s=f"{quantity(self.median_pgv_m_s, 'm/s')}, beta {self.beta:g}; "
                f"second {quantity(self.other_median_pgv_m_s, 'm/s')}, {self.other_beta:g}",
                friction_needed=f"{need}; {given}",
            ),
            notes=[*self.remarks, SOURCE, CAVEAT],
            answer=self._answer(),
        )

    def _answer(self) -> Answer:
        """Return the probability beside the second one, what lifts the block, and doubts."""
        vertical = self.demand.vertical_words
        peaks = f"{quantity(self.pga_g, 'g')} and {quantity(self.pgv_m_s, 'm/s')}"
        peaks += f" with {vertical}" if vertical else ""
        lifting = quantity(self.uplift_pga_g, "g") + " as one body" * bool(self.block.parts)
        lifting += f", {number(self.uplift_pga_g / self.pga_g, 2)} of the demand"
        second = half = ""
        if self.probability is None:
            sentence = f"It slides at {peaks}: no probability of falling by rocking."
        elif self.verdict == "rest":
            sentence = f"It stands at {peaks}: this does not lift it."
        else:
            sentence = f"{chance(self.probability)} of such blocks fall at {peaks}, by a formula."
            second = f"{chance(self.other_probability or 0.0)} by runs of this package"
            half = quantity(self.median_pgv_m_s, "m/s")
        given = "not known, and below it the block slides"
        if self.friction is not None:
            given = f"{number(self.friction)} given"
        facts = [
            ("second formula", second),
            ("doubt", " ".join(each for each in self.remarks if "friction" not in each)),
            ("friction needed", f"{number(self.friction_needed)}; {given}"),
            ("lifts at", lifting),
            ("half fall at", half),
        ]
        return Answer(sentence, facts)


@checked
def assess_by_formula(
    block: Block,
    pga_g: float,
    pgv_m_s: float,
    friction: float | None = None,
    *,
    vertical_g: float = 0.0,
    vertical_share: float = 1.0,
) -> FormulaAssessment:
    """Compute the probability that a block falls, from PGA and PGV.

    ``P = 1[PGA > (g - a_v) tan alpha] Phi(ln(p PGV/(0.757 g tan alpha))/0.592)``, of the side that
    lifts first.

    Parameters
    ----------
    block
        The block.
    pga_g
        Peak acceleration of the ground or floor [g].
    pgv_m_s
        Peak velocity [m/s].
    friction
        Coefficient between block and base; None (default) where it is not known, and then its need
        is stated.  Below the need rocking alone is no answer, and there is no probability.
    vertical_g, vertical_share
        As for `Demand`: they lower what lifts the block and raise the friction that it needs.

    Returns
    -------
    FormulaAssessment
        Probability, its alternative, thresholds, and one sentence.

    Raises
    ------
    InputError
        If a peak is not above 0, the friction is negative, or the base falls as fast as the block.

    Examples
    --------
    >>> from rocksteady import Block
    >>> from rocksteady.risk import assess_by_formula
    >>> answer = assess_by_formula(Block.rectangle(width=0.32, height=1.8), 0.35, 0.4)
    >>> print(f"{answer.probability:.4f} {answer.median_pgv_m_s:.4f} {answer.uplift_pga_g:.4f}")
    0.3992 0.4653 0.1778
    >>> print(answer.sentence)
    About 2 in 5 blocks of this shape and size would fall at a PGA of 0.35 g and a PGV of 0.4 m/s.
    """
    pga, pgv = PGA("pga_g", pga_g), PGV("pgv_m_s", pgv_m_s)
    demand = Demand(pga_g=pga, pgv_m_s=pgv, vertical_g=vertical_g, vertical_share=vertical_share)
    vertical = demand.vertical_at_peak_g
    if friction is not None:
        friction = FRICTION("friction", friction)
    uplift = uplift_acceleration_g(block, vertical)
    mode: Mode = "rocks" if lifts(block, pga, vertical) else "rest"
    if friction is not None:
        mode = first_motion(block, pga, friction, vertical)
    side = first_side(block)
    unit = block.gravity * tan(side.alpha) / side.p
    medians = MEDIAN * unit, OTHER_MEDIAN * unit
    if not math.isfinite(medians[0]) or medians[0] <= 0.0:
        raise InputError("alpha", side.alpha, "the block is too slender", "give it in radians")
    shares: list[float | None] = [None, None]
    if mode == "rest":
        shares = [0.0, 0.0]
    elif mode == "rocks":
        shares = [*shares_at(velocity_number(side, block.gravity, pgv))]
    need = needed_friction(block, pga, vertical)
    return FormulaAssessment(
        block=block,
        pga_g=pga,
        pgv_m_s=pgv,
        friction=friction,
        vertical_g=demand.vertical_g,
        vertical_share=demand.vertical_share,
        probability=shares[0],
        other_probability=shares[1],
        median_pgv_m_s=medians[0],
        beta=BETA,
        other_median_pgv_m_s=medians[1],
        other_beta=OTHER_BETA,
        uplift_pga_g=uplift,
        friction_needed=need.largest,
        friction_cause=need.cause,
        verdict="slides" if mode == "slides and rocks" else mode,
        sentence=_sentence(mode, shares[0], demand, uplift, need),
        remarks=tuple(_remarks(block, pga, pgv, friction, need.largest)),
    )


def _sentence(
    mode: Mode, share: float | None, demand: Demand, uplift: float, need: FrictionNeed
) -> str:
    """Return the answer in one sentence."""
    pga, pgv = quantity(demand.pga_g or 0.0, "g"), quantity(demand.pgv_m_s or 0.0, "m/s")
    vertical = f" with {demand.vertical_words}" if demand.vertical_words else ""
    if mode == "rest":
        return (
            f"It stays where it stands: a PGA of {pga}{vertical} does not lift it; "
            f"{quantity(uplift, 'g')} would."
        )
    if share is None:
        more = "also slides while it rocks" if mode == "slides and rocks" else "slides"
        return (
            f"It {more} at a PGA of {pga}{vertical}: rocking alone needs a coefficient of friction "
            f"of {number(need.largest)} for {need.cause}, and no probability of falling is given."
        )
    return (
        f"{share_words(share)} blocks of this shape and size would fall at a PGA of {pga} and a "
        f"PGV of {pgv}{vertical}."
    )


def share_words(share: float) -> str:
    """Return a probability in words, of the nearest odds that a reader knows.

    Examples
    --------
    >>> share_words(0.3992), share_words(0.0004), share_words(0.997)
    ('About 2 in 5', 'Fewer than 1 in 1000', 'More than 99 in 100')
    """
    if share < WORDS[0][0]:
        return "Fewer than 1 in 1000"
    if share > WORDS[-1][0]:
        return "More than 99 in 100"
    odds = math.log(share / (1.0 - share))
    return (
        "About " + min(WORDS, key=lambda each: abs(math.log(each[0] / (1.0 - each[0])) - odds))[1]
    )


def _remarks(
    block: Block, pga: float, pgv: float, friction: float | None, need: float
) -> list[str]:
    """Return what is doubtful of the input, or beyond what the closed form was made of."""
    remarks = []
    ratio = pgv / (pga * STANDARD_GRAVITY)
    low, high = USUAL_RATIO_S
    if not low <= ratio <= high:
        remarks.append(
            f"PGV/PGA is {number(ratio)} s; recorded motions have {low:g} to {high:g} s: are the "
            "units right?"
        )
    elif pga > STRONGEST_PGA_G:
        remarks.append(
            f"A PGA of {number(pga)} g is beyond recorded ones, up to about {STRONGEST_PGA_G:g} g: "
            "are the units right?"
        )
    if friction is None:
        remarks.append(
            f"The friction is not given: with a coefficient below {number(need)} the block slides, "
            "and this answer does not hold."
        )
    side = first_side(block)
    outside = [
        f"{name} {number(value)} {unit}"
        for name, value, unit, (least, most) in (
            ("alpha", side.alpha, "rad", SAMPLED_ALPHA),
            ("p", side.p, "rad/s", SAMPLED_P),
        )
        if not least <= value <= most
    ]
    if outside:
        remarks.append(
            f"{' and '.join(outside)} lies outside the runs of this package (alpha 0.1 to "
            "0.3 rad, p 1 to 3 rad/s)."
        )
    if block.one_sided:
        remarks.append("The runs are of blocks that rock to both sides: the wall is left out.")
    elif not block.symmetric:
        remarks.append("The sides differ: both are taken to be as the side that lifts first.")
    return remarks
