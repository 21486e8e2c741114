"""Remedies: the least width, ballast or friction cap that brings a probability below a target."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocksteady.errors import InputError
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.gravity import STANDARD_GRAVITY
from rocksteady.results.numbers import chance, counted, length, number, plural
from rocksteady.risk.assess._counts import Basis, Counts, Motions, run_at
from rocksteady.risk.assess._demand_level import DemandLevel, measured
from rocksteady.risk.assess._probability import fitted_probability
from rocksteady.risk.assess._sensitivity import (
    CENTRE,
    MOST_DRAWS,
    Case,
    band_of,
    case_of,
    levels_about,
    stays,
)
from rocksteady.risk.assess.described.body import Body
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.seismic.measures.scalar import Measure
from rocksteady.sweep.run import Execution

BALLAST_HEIGHT_M = 0.05
"""Height of the ballast's mass centre above the base [m]."""
MOST_WIDTH, MOST_BALLAST = 3.0, 10.0
"""Factor of the width and share of the mass beyond which a remedy is not given."""
FINEST = 0.01
"""Relative width of the bracket of the least change at which the search ends."""
ROUNDS = 16
"""Runs of the changed object after which the search ends; halves alone need 8 for a width."""
MARGIN = 0.1
"""Share of a bracket that a step keeps from both ends."""
ASIDE = 0.4
"""Part of `FINEST` by which a step goes beyond the change that is thought to be the least."""
SMALLEST = 1e-3
"""Probability below which a step takes every other for the same."""
WITHIN = "not worked out: the object is within the target as it is"
"""Of remedies where there is nothing to remedy."""
STAYS = "not worked out: the demand lifts an end of its ranges alone, not the object as described"
"""Of remedies where the object as described stays where it stands."""
NO_LIFT = "not worked out: no run lifts the object so changed at the demand"
"""Of remedies whose probability is not known."""


@dataclass(frozen=True, kw_only=True)
class Remedy:
    """One change that brings the probability of falling down to the target.

    Attributes
    ----------
    name
        "width", "ballast" or "friction cap".
    words
        What to do.
    change
        Relative change of the design variable; None where no change within reach is enough.
    value, unit
        The design variable: width between the edges [m], ballast [kg] or as a share of the mass, or
        the largest coefficient of friction.
    probability, basis
        Probability of the changed object at the demand, nan where no run lifts, and what it is
        from: "curve" (through its runs about the demand), "count" (of its runs there) or "statics".
        Where no change is enough, or none is needed, that of the largest change tried, or of the
        object as it is.
    fell, trials
        Its runs at the demand; None by statics.
    confirmed
        Whether a change was found that brings the probability to the target or below.
    """

    name: str
    words: str
    change: float | None = None
    value: float | None = None
    unit: str = ""
    probability: float
    basis: Basis
    fell: int | None = None
    trials: int | None = None
    confirmed: bool = False

    @property
    def result(self) -> str:
        """What to do, and the probability that follows."""
        if self.value is None:
            return self.words
        if self.basis == "statics":
            return f"{self.words}; the demand then does not lift it"
        if self.basis == "count" and self.trials and self.fell is not None:
            runs = plural(self.trials, "run")
            return f"{self.words}; then {counted(self.fell, runs)} at the demand"
        return f"{self.words}; the probability is then {chance(self.probability)}"

    def to_dict(self) -> dict[str, Any]:
        """Return plain values."""
        unknown = math.isnan(self.probability)
        return vars(self) | {"probability": None if unknown else self.probability}


class Search:
    """The probability of falling of a changed object, by the method of the object as described.

    Parameters
    ----------
    described, motions, level
        The object, the suite and the demand.
    target
        Probability to come down to.
    run
        As for `run_ensemble`.
    """

    def __init__(
        self,
        described: DescribedObject,
        motions: Motions,
        level: DemandLevel,
        target: float,
        run: Execution | None,
    ) -> None:
        self.described, self.motions, self.level = described, motions, level
        self.target, self.run = target, run
        self.made: dict[Block, Counts] = {}
        self.cases: dict[Block, Case] = {}
        self.unknown = False
        at_one = measured(motions, level.measure)
        pga = measured(motions, Measure("pga_g")) * (level.value / at_one)
        logs = np.log(pga)
        self.centre, self.spread = (
            float(logs.mean()),
            float(logs.std(ddof=1)) if len(pga) > 1 else 0.0,
        )

    def fitted(self, block: Block, curve: FragilityCurve) -> float:
        """Return the probability of a block at the demand, P(falls | uplift) or all of it.

        Over other measures than PGV it is times P(uplift), that of a lognormal through the PGA of
        the records at the demand; the curve is over the measure relative to the block's uplift and
        size.
        """
        from scipy.special import ndtr

        uplift = math.log(block.gravity * tan(first_side(block).alpha) / STANDARD_GRAVITY)
        lifts = float(ndtr((self.centre - uplift) / max(self.spread, 1e-6)))
        if self.level.measure.given_uplift:
            lifts = 0.0 if stays(self.described, block) else 1.0
        falls = float(curve.probability(np.array([relative(self.level, block)]))[0])
        return lifts * (0.0 if math.isnan(falls) else falls)

    def curve_of(self, counts: Counts, block: Block) -> FragilityCurve:
        """Return P(falls | uplift) of some runs over the relative measure."""
        from rocksteady.risk.fits.fragility_curve import fit_curve

        lifted = counts.lifted > 0
        at = np.broadcast_to(
            counts.levels / self.level.value * relative(self.level, block), lifted.shape
        )
        groups = np.broadcast_to(np.arange(len(lifted))[:, np.newaxis], lifted.shape)
        return fit_curve(
            at[lifted], counts.fell[lifted], counts.lifted[lifted], groups=groups[lifted]
        )

    def runs(self, block: Block) -> Counts:
        """Return the runs of a changed object about the demand."""
        if block not in self.made:
            (self.made[block],) = run_at(
                [block],
                self.motions,
                self.level.measure,
                levels_about(self.level),
                restitution=band_of(self.described, most=MOST_DRAWS),
                run=self.run,
            )
        return self.made[block]

    def case(self, block: Block) -> Case:
        """Return the probability of a changed object, as `probability_of` gives the object's own.

        Its curve goes through runs at all levels; the runs about the demand are counted.
        """
        if block not in self.cases:
            rests, by_levels = stays(self.described, block), math.nan
            if not rests:
                by_levels = fitted_probability(
                    self.described, block, self.motions, self.level, run=self.run
                )
            case = case_of("", "", self.runs(block), rests=rests, by_levels=by_levels)
            if not rests and math.isnan(by_levels):
                case = replace(case, fitted=case.counted, basis="count")
            self.cases[block] = case
        return self.cases[block]

    def least(self, made: Callable[[float], Body], most: float) -> tuple[float | None, Case]:
        """Return the least change, from 0 to `most`, whose own probability is the target.

        Every step runs the changed object, and its own fit is what counts.  The search ends with
        two changes, 1 % of the object apart: one is above the target, the other, which is
        returned, at the target or below.  The change is None where the largest is not enough.
        """
        block_of = self.described.block_of
        low = high = change = 0.0
        # Fitted probabilities at both ends, as distances from the target.
        above = below = 0.0
        best: tuple[float | None, Case] | None = None
        rounds, enough = 0, False
        while True:
            block = block_of(made(change))
            case = self.case(block)
            rounds += 1
            if case.probability <= self.target:
                # An end that has stood twice counts half, so that the other comes to it.
                above *= 0.5 if enough else 1.0
                best, high, below, enough = (change, case), change, self._beyond(case), True
            elif math.isnan(case.probability):
                self.unknown = True
                break
            elif change == most or rounds == ROUNDS:
                break
            else:
                below *= 1.0 if enough else 0.5
                low, above, enough = change, self._beyond(case), False
            if best is None:
                change = self._guess(block, case, made, (low, most))
                continue
            apart = math.log1p(high) - math.log1p(low)
            if apart <= math.log1p(FINEST) or rounds == ROUNDS:
                break
            part = above / (above - below) if above else 0.5
            # To the other side of where the target is thought to be, so that both ends come near.
            part += ASIDE * FINEST / apart * (-1.0 if enough else 1.0)
            part = min(max(part, MARGIN), 1.0 - MARGIN)
            change = math.expm1(math.log1p(low) + part * apart)
        return (None, case) if best is None else best

    def reach(self, made: Callable[[float], Body], most: float) -> float:
        """Return the largest change, `most` at most, of which a block can be made that rocks."""

        def rocks(change: float) -> bool:
            try:
                self.described.block_of(made(change))
            except InputError:  # Housner's restitution of a stocky block is none
                return False
            return True

        low, high = 0.0, most
        if rocks(most):
            return most
        while high - low > FINEST:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if rocks(middle) else (low, middle)
        return low

    @property
    def idle(self) -> str:
        """Why no change of the object as described is needed."""
        return STAYS if stays(self.described, self.described.block) else WITHIN

    def _beyond(self, case: Case) -> float:
        """Return by how much a probability is above the target, in standard deviations."""
        from scipy.special import ndtri

        fitted, target = (
            min(max(share, SMALLEST), 1.0 - SMALLEST) for share in (case.probability, self.target)
        )
        # Exactly at the target is still below.
        return float(ndtri(fitted) - ndtri(target)) or -SMALLEST

    def _guess(
        self,
        block: Block,
        case: Case,
        made: Callable[[float], Body],
        reach: tuple[float, float],
    ) -> float:
        """Return a change further than one that is not enough, by the runs about the demand.

        Their curve has to come down by as many standard deviations as the probability.
        """
        from scipy.optimize import brentq
        from scipy.special import ndtr, ndtri

        low, most = reach
        curve = self.curve_of(self.runs(block), block)
        here = min(max(self.fitted(block, curve), SMALLEST), 1.0 - SMALLEST)
        aim = float(ndtr(ndtri(here) - self._beyond(case)))

        def excess(tried: float) -> float:
            return self.fitted(self.described.block_of(made(tried)), curve) - aim

        if excess(most) > 0.0:
            return most
        guess = float(brentq(excess, low, most, xtol=1e-3)) if excess(low) > 0.0 else low
        return min(most, max(guess, math.expm1(math.log1p(low) + 2.0 * FINEST)))


def relative(level: DemandLevel, block: Block) -> float:
    """Return the demand relative to a block's uplift, and to its size where it is a velocity."""
    name = level.measure.name
    if name == "pgv_m_s":
        return level.of(Measure("p_pgv_per_uplift"), block)
    if name == "pga_g":
        return level.of(Measure("pga_per_uplift"), block)
    return level.value / tan(first_side(block).alpha)


def find_remedies(search: Search) -> tuple[Remedy, ...]:
    """Return width, ballast and friction cap in the order of their change; a frame has no ballast.

    The cap stands at twice the height of the columns' mass centres, which ballast would move.
    """
    remedies = [_width(search), _friction_cap(search.described)]
    if search.described.body.columns is None:
        remedies.insert(1, _ballast(search))
    return tuple(
        sorted(remedies, key=lambda each: math.inf if each.change is None else each.change)
    )


def cheapest(remedies: Sequence[Remedy]) -> Remedy | None:
    """Return the remedy of the least relative change; None where none is within reach."""
    possible = [each for each in remedies if each.change is not None]
    return min(possible, key=lambda each: each.change or 0.0, default=None)


def _width(search: Search) -> Remedy:
    """Return the least width between the edges."""
    body = search.described.body
    before = body.left + body.right
    most = search.reach(lambda change: body.wider(1.0 + change), MOST_WIDTH - 1.0)
    change, case = search.least(lambda change: body.wider(1.0 + change), most)
    if change is None:
        words = f"not even {number(1.0 + most)} times the width is enough"
        return _of_runs(case, "width", NO_LIFT if search.unknown else words, unit="m")
    if change == 0.0:
        return _of_runs(case, "width", search.idle, unit="m")
    width = before * (1.0 + change)
    return _of_runs(
        case,
        "width",
        f"widen the base from {length(before)} to {length(width)}, mass centre and inertia "
        "unchanged",
        change=change,
        value=width,
        unit="m",
        confirmed=True,
    )


def _ballast(search: Search) -> Remedy:
    """Return the least ballast at the base."""
    body = search.described.body
    if body.centre_height <= BALLAST_HEIGHT_M:
        case = search.case(search.described.block)
        return _of_runs(case, "ballast", "the mass centre is at the base already")

    def made(share: float) -> Body:
        return body.with_share(share, BALLAST_HEIGHT_M) if share > 0.0 else body

    most = search.reach(made, MOST_BALLAST)
    share, case = search.least(made, most)
    if share is None:
        words = f"not even {number(most)} times its mass is enough"
        return _of_runs(case, "ballast", NO_LIFT if search.unknown else words)
    if share == 0.0:
        return _of_runs(case, "ballast", search.idle)
    mass = None if body.mass_kg is None else share * body.mass_kg
    centre = body.with_share(share, BALLAST_HEIGHT_M).centre_height
    amount = f"{number(100.0 * share)} % of its mass" if mass is None else f"{number(mass)} kg"
    return _of_runs(
        case,
        "ballast",
        f"fix {amount} of ballast in its base, {length(BALLAST_HEIGHT_M)} above the "
        f"floor, which lowers the mass centre from {length(body.centre_height)} to "
        f"{length(centre)}",
        change=share,
        value=share if mass is None else mass,
        unit="of its mass" if mass is None else "kg",
        confirmed=True,
    )


def _friction_cap(described: DescribedObject) -> Remedy:
    """Return the friction below which it slides and does not lift, with its mass centre higher."""
    # At either end of every range too, a range of the mass centre for itself: what lifts first.
    bodies = [described.body.with_centre(1.0 + CENTRE)]
    for variant in described.variants():
        stated = variant.key == "geometry.mass_centre_height_m"
        bodies.append(variant.body if stated else variant.body.with_centre(1.0 + CENTRE))
    blocks = [described.block_of(body) for body in bodies]
    cap = min(tan(first_side(block).alpha) for block in blocks)
    friction = described.given.friction
    change = None if friction is None else max(0.0, 1.0 - cap / bounds_of(friction)[1])
    return Remedy(
        name="friction cap",
        words=f"let it slide on a base with a coefficient of friction of at most {number(cap)}, "
        f"where it does not lift even with its mass centre {100.0 * CENTRE:g} % higher than "
        "stated, at either end of each range of its geometry; "
        "it needs room to slide and no edge to catch on"
        + ("" if friction is not None else "; its friction now is not given"),
        change=change,
        value=cap,
        probability=0.0,
        basis="statics",
        confirmed=True,
    )


def _of_runs(case: Case, name: str, words: str, **fields: Any) -> Remedy:
    """Return a remedy with the probability of the runs of the object so changed."""
    of_runs = case.basis != "statics"
    return Remedy(
        name=name,
        words=words,
        probability=case.probability,
        basis=case.basis,
        fell=case.fell if of_runs else None,
        trials=case.trials if of_runs else None,
        **fields,
    )
