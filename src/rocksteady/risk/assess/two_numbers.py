"""The probability that a block falls, from PGA and PGV by a formula, to compare runs with."""

from dataclasses import dataclass
from typing import Annotated

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import FRICTION
from rocksteady.results.numbers import chance, number, quantity
from rocksteady.results.result import Result
from rocksteady.results.words import Label
from rocksteady.risk.screens.demand import PGA, PGV, VERTICAL
from rocksteady.risk.screens.friction import (
    SLIDES,
    Mode,
    first_motion,
    lifts,
    needed_friction,
    uplift_acceleration_g,
)
from rocksteady.risk.screens.thresholds import BETA, MEDIAN, sampled, shares_at, velocity_number
from rocksteady.seismic.measures.free_sides import first_side

STRONGEST_PGA_G = 4.0
"""Beyond it a PGA is remarked on: about 4 g was recorded in 2008 (IWTH25, vertical included)."""
LEAST_RATIO_S, MOST_RATIO_S = 0.01, 0.5
"""PGV/PGA [s] of recorded motions; beyond it a unit is doubtful."""


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False)
class FormulaAssessment(Result):
    """Probability that a block falls, from `rocksteady.risk.assess_by_formula`.

    Attributes
    ----------
    block, pga_g, pgv_m_s, friction, vertical_g
        Inputs; no friction where it is not known.
    probability
        Probability of overturning; None where the block slides, since the formula is for rocking
        alone.
    median_pgv_m_s, beta
        PGV at which half of such blocks that lift fall [m/s], and standard deviation of its
        logarithm.
    uplift_pga_g
        PGA that lifts the block [g], with the vertical motion.
    friction_needed
        Friction with which it rocks without sliding at this PGA, impacts included.
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
    friction: Annotated[float | None, Label("friction given")]
    vertical_g: Annotated[float, Label("vertical", unit="g")]
    probability: Annotated[float | None, Label("probability of falling", chance)]
    median_pgv_m_s: Annotated[float, Label("half fall at", unit="m/s")]
    beta: Annotated[float, Label("beta")]
    uplift_pga_g: Annotated[float, Label("lifts at", unit="g")]
    friction_needed: Annotated[float, Label("friction needed")]
    verdict: Annotated[str, Label("")]
    sentence: Annotated[str, Label("")]
    remarks: Annotated[tuple[str, ...], Label("")] = ()


@checked
def assess_by_formula(
    block: Block,
    pga_g: Annotated[float, PGA],
    pgv_m_s: Annotated[float, PGV],
    friction: Annotated[float | None, FRICTION] = None,
    *,
    vertical_g: Annotated[float, VERTICAL["vertical_g"]] = 0.0,
) -> FormulaAssessment:
    """Compute the probability that a block falls, from PGA and PGV.

    ``P = 1[PGA > (g - a_v) tan alpha] Phi(ln(p PGV/(0.757 g tan alpha))/0.592)``, of the side that
    lifts first.  Use it to compare with the literature: a suite with another ratio of PGV to PGA
    gives other shares, and the counted runs of `assess_object` are the answer.

    Parameters
    ----------
    block
        The block.
    pga_g
        Peak acceleration of the ground or floor [g].
    pgv_m_s
        Peak velocity [m/s].
    friction
        Coefficient between block and base; None (default) where it is not known.  Below
        `friction_needed` there is no probability.
    vertical_g
        Magnitude of the vertical base acceleration at the horizontal peak [g]; default 0.  The
        worse direction, downwards, counts.

    Returns
    -------
    FormulaAssessment
        Probability, thresholds, and one sentence.

    Raises
    ------
    InputError
        If a peak is not above 0, the friction is negative, or the base falls as fast as the block.

    Examples
    --------
    >>> from rocksteady import Block
    >>> from rocksteady.risk import assess_by_formula
    >>> result = assess_by_formula(Block.rectangle(width=0.32, height=1.8), 0.35, 0.4)
    >>> print(f"{result.probability:.4f} {result.median_pgv_m_s:.4f} {result.uplift_pga_g:.4f}")
    0.3992 0.4653 0.1778
    >>> print(result.sentence)
    40 % of such blocks fall at 0.35 g and 0.4 m/s, by a formula.
    """
    side = first_side(block)
    median = MEDIAN * block.gravity * tan(side.alpha) / side.p
    if median <= 0.0:
        raise InputError("alpha", side.alpha, "the block is too slender", "give it in radians")
    mode: Mode = "rocks" if lifts(block, pga_g, vertical_g) else "rest"
    if friction is not None:
        mode = first_motion(block, pga_g, friction, vertical_g)
    peaks = f"{quantity(pga_g, 'g')} and {quantity(pgv_m_s, 'm/s')}"
    peaks += f" with {quantity(vertical_g, 'g')} of vertical motion downwards" * bool(vertical_g)
    probability: float | None = 0.0
    sentence = f"It stands at {peaks}: this does not lift it."
    if mode in SLIDES:
        probability = None
        sentence = f"It slides at {peaks}: no probability of falling by rocking."
    elif mode == "rocks":
        probability, _ = shares_at(velocity_number(side, block.gravity, pgv_m_s))
        sentence = f"{chance(probability)} of such blocks fall at {peaks}, by a formula."
    need = needed_friction(block, pga_g, vertical_g).largest
    return FormulaAssessment(
        block=block,
        pga_g=pga_g,
        pgv_m_s=pgv_m_s,
        friction=friction,
        vertical_g=vertical_g,
        probability=probability,
        median_pgv_m_s=median,
        beta=BETA,
        uplift_pga_g=uplift_acceleration_g(block, vertical_g),
        friction_needed=need,
        verdict="slides" if mode in SLIDES else mode,
        sentence=sentence,
        remarks=_remarks(block, pga_g, pgv_m_s, friction, need),
    )


def _remarks(
    block: Block, pga_g: float, pgv_m_s: float, friction: float | None, need: float
) -> tuple[str, ...]:
    """Return doubts about friction and units, and about a block unlike those of the runs."""
    ratio = pgv_m_s / (pga_g * STANDARD_GRAVITY)
    remarks = (
        f"The friction is not given: with a coefficient below {number(need)} the block slides, "
        "and this answer does not hold." * (friction is None),
        f"PGV/PGA is {number(ratio)} s and the PGA {number(pga_g)} g; recorded motions have "
        f"{LEAST_RATIO_S:g} to {MOST_RATIO_S:g} s and up to {STRONGEST_PGA_G:g} g: are the units "
        "right?" * (not LEAST_RATIO_S <= ratio <= MOST_RATIO_S or pga_g > STRONGEST_PGA_G),
        "The block lies outside the runs that check the formula: alpha 0.1 to 0.3 rad, "
        "p 1 to 3 rad/s." * (not sampled(first_side(block))),
        "The runs are of blocks that rock to both sides: the wall is left out." * block.one_sided,
        "The sides differ: both are taken to be as the side that lifts first."
        * (not block.symmetric and not block.one_sided),
    )
    return tuple(filter(None, remarks))
