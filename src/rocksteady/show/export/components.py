"""Components of loss models: what is written for pelicun and OpenQuake, in SI units and g.

Counted shares are written as points: 0 at the lowest uplift, the step there, and the share at each
level above it.  All states have the same levels, so that each line lies below that of the state
before it, and no point is above the share that lifts.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.dynamics.arrays import checked_array
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds, nonempty_text
from rocksteady.model.checks.validation import positive
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.risk.fragility.damage_states import UPLIFT
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import GOOD, StateFragility
from rocksteady.risk.hazard.hazard_measures import intensity_named
from rocksteady.seismic.measures.scalar import Measure

MEASURES = {"pga_g": False, "pgv_m_s": False, "sa_g": True}
"""Intensity measures that loss tools have a name for, and whether they have a period."""
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_.]{0,74}")
LONGEST = 75
"""Characters of a name, in OpenQuake."""
WORDS_FOR_NOTHING = frozenset(
    {"inf", "infinity", "na", "nan", "none", "null", "true", "false", "units"}
)
"""Identifiers that a reader of tables takes for a missing or another value, in small letters."""
MOST_STATES = 9
"""Of a component: pelicun takes limit states in the order of the alphabet, LS10 before LS2."""
INTENSITY = Bounds(0.0, math.inf, "[]", "give an intensity in the component's unit")
GAP = 2e-5
"""Least ratio of two levels, less 1: pelicun keeps six digits."""
STEP = 1.5 * GAP
"""Ratio of the levels before and after the step at uplift, less 1."""


def text_value(name: str, value: object) -> str:
    """Return a value that is a text.

    Raises
    ------
    InputError
        If the value is no text.
    """
    if isinstance(value, str):
        return value
    raise InputError(name, value, "it must be a text", "give a str")


def _identifier(name: str, value: object) -> str:
    """Return an identifier that both tools take."""
    text = text_value(name, value)
    if IDENTIFIER.fullmatch(text) and text.lower() not in WORDS_FOR_NOTHING:
        return text
    valid = (
        f"it must be a letter, then letters, digits, '_' and '.', {LONGEST} at most, and no word"
    )
    raise InputError(name, value, f"{valid} for a missing value", "name it as RS.cabinet")


def _measure(name: str, value: object) -> Measure:
    """Return a measure that both tools take."""
    measure = intensity_named(name, value)
    if MEASURES.get(measure.name) != (measure.period_s is not None):
        names = ", ".join(f"{each}:PERIOD" if needs else each for each, needs in MEASURES.items())
        hint = 'write a period in seconds, as "sa_g:1.0"'
        raise InputError(name, value, f"loss tools accept {names}", hint)
    return measure


def _levels(name: str, value: Sequence[float]) -> tuple[float, ...]:
    """Return the levels of points: two or more that rise."""
    levels = tuple(float(each) for each in value)
    rising = all(after > before * (1.0 + GAP) for before, after in pairwise(levels))
    if len(levels) < 2 or not rising or levels[0] <= 0.0 or math.isinf(levels[-1]):
        valid = "there must be two or more above 0, each above the one before it in six digits"
        raise InputError(name, value, valid, "sort them, and give each once")
    return levels


def _shares(name: str, value: Sequence[float]) -> tuple[float, ...]:
    """Return the shares of points: from 0 to at most 1, none falling."""
    shares = tuple(float(each) for each in value)
    if not shares or shares[0] != 0.0 or shares[-1] > 1.0 or list(shares) != sorted(shares):
        valid = "they must go from 0 to at most 1, none below the one before it"
        raise InputError(name, value, valid, "begin at the highest level that none exceeds")
    return shares


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class LossState:
    """Damage state of a component, with its fragility: a lognormal, or points.

    Parameters
    ----------
    name
        In words, as "theta/alpha > 0.5".
    median
        Intensity at which half exceed the state, in the component's unit; None with points.
    beta
        Standard deviation of the logarithm; None with points.
    levels
        Intensities of the points, two or more, rising, in the component's unit; None with a
        lognormal.
    shares
        Probability at each level: the first 0, none below the one before it; None with a
        lognormal.

    Raises
    ------
    InputError
        If the name is empty, the median or beta is not above 0, the levels or shares do not rise,
        or neither pair is given, or both.

    Examples
    --------
    >>> state = LossState(name="overturned", median=0.724, beta=0.5)
    >>> state.probability([0.724]).round(3)
    array([0.5])
    >>> state = LossState(name="overturned", levels=[0.25, 0.5, 0.75], shares=[0.0, 0.5, 0.75])
    >>> state.probability([0.1, 0.375, 0.5, 2.0]).tolist()
    [0.0, 0.25, 0.5, 0.75]
    """

    name: Annotated[str, nonempty_text]
    median: Annotated[float | None, partial(positive, hint="give an intensity")] = None
    beta: Annotated[float | None, partial(positive, hint="give that of ln x")] = None
    levels: Annotated[Sequence[float] | None, _levels] = None
    shares: Annotated[Sequence[float] | None, _shares] = None

    def __post_init__(self) -> None:
        """Validate the pairs."""
        keys = ("median", "beta", "levels", "shares")
        pair = [key for key in keys if getattr(self, key) is not None]
        several = len(self.levels or ()), len(self.shares or ())
        if pair not in (["median", "beta"], ["levels", "shares"]) or several[0] != several[1]:
            valid = "a state has a median and a beta, or levels and as many shares"
            raise InputError("median", self.median, valid, "give one of the two pairs")

    def probability(self, intensity: ArrayLike) -> Floats:
        """Return the probability of the state or a worse one.

        Between points it is on straight lines, before the first 0, and after the last the last.

        Parameters
        ----------
        intensity
            In the component's unit, 0 or above, of any shape.

        Raises
        ------
        InputError
            If an intensity is negative or NaN.
        """
        at = checked_array("intensity", intensity, INTENSITY)
        if self.levels is not None and self.shares is not None:
            return np.asarray(np.interp(at, self.levels, self.shares))
        from scipy.special import ndtr

        assert self.median is not None
        assert self.beta is not None
        with np.errstate(divide="ignore"):  # ln 0 is -inf, whose probability is 0
            return np.asarray(ndtr(np.log(at / self.median) / self.beta))


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class LossComponent:
    """Component of a loss model: its demand, and its damage states.

    Parameters
    ----------
    identifier
        Letter first, then letters, digits, "_" and ".", at most 75 characters; pelicun splits
        names at "-".
    measure
        "pga_g", "pgv_m_s", or "sa_g:0.7" for 5 % damping and a period of 0.7 s.
    states
        In increasing order of severity: all are lognormals, or all have points.
    floor
        Whether the demand is that of a floor and not of the ground; off by default.
    description
        Description of the object, in a sentence; default none.
    note
        What a user must know of the component; default none.

    Raises
    ------
    InputError
        If the identifier or measure is not valid, two states have one name, lognormals and points
        are mixed, or there are more than nine states: pelicun takes LS10 before LS2.

    Examples
    --------
    >>> falls = LossState(name="overturned", median=0.724, beta=0.5)
    >>> component = LossComponent(identifier="RS.cabinet", measure="pgv_m_s", states=(falls,))
    >>> component.identifier
    'RS.cabinet'
    """

    identifier: Annotated[str, _identifier]
    measure: Annotated[Measure | str, _measure]
    states: tuple[LossState, ...]
    floor: bool = False
    description: Annotated[str, text_value] = ""
    note: Annotated[str, text_value] = ""

    def __post_init__(self) -> None:
        """Validate the states."""
        names = [state_name(state.name) for state in self.states]
        if not 1 <= len(names) <= MOST_STATES or len(set(names)) < len(names):
            valid = f"there must be 1 to {MOST_STATES}, of names that differ in letters and digits"
            raise InputError("states", names, valid, "choose fewer, or rename each")
        if len({state.median is None for state in self.states}) > 1:
            valid = "all must be lognormals, or all must have points"
            raise InputError("states", names, valid, "give all the same")

    @property
    def intensity(self) -> Measure:
        """The measure."""
        return intensity_named("measure", self.measure)

    @classmethod
    def from_fragility(
        cls,
        identifier: str,
        fragility: Fragility,
        *,
        floor: bool = False,
        lognormal: bool = False,
        description: str = "",
    ) -> "LossComponent":
        """Make a component of the counted shares of a fragility.

        The points of each state give the counted share at each level.  A state that no run reaches
        is left out, and the note names it.

        Parameters
        ----------
        identifier, floor, description
            As of the class.
        fragility
            Shares of one block over PGA, PGV or spectral acceleration.
        lognormal
            Whether each state but uplift is its lognormal in place of points, which must be within
            10 points of the counted shares; default False.

        Returns
        -------
        LossComponent
            With the states of the fragility.

        Raises
        ------
        InputError
            If the fragility is of several blocks or over another measure, no run reaches a state,
            or a lognormal is further from the counted shares.

        Examples
        --------
        >>> from rocksteady import Block, compute_fragility
        >>> from rocksteady.export import LossComponent
        >>> from rocksteady.motions import make_synthetic_suite
        >>> from rocksteady.risk import Levels, RestitutionBand
        >>> fragility = compute_fragility(
        ...     Block.rectangle(width=0.3, height=1.5),
        ...     make_synthetic_suite(4),
        ...     levels=Levels("pga_g", [0.25, 0.5, 1.0]),
        ...     restitution=RestitutionBand(draws=1),
        ... )
        >>> component = LossComponent.from_fragility("RS.cabinet", fragility)
        >>> component.states[0].probability([0.19, 0.21]).tolist()
        [0.0, 1.0]
        """
        runs, measure = fragility.ensemble, fragility.measure
        if measure is None or runs.sizes["block"] > 1:
            raise InputError(
                "fragility",
                Words(f"is of {plural(runs.sizes['block'], 'block')} over {fragility.key}"),
                f"a component is of one block over {', '.join(MEASURES)}",
                "count the runs of one block over pga_g",
            )
        if measure.name == "sa_g" and measure.period_s is None:
            signs = [sign for sign in ("", "negative_") if f"{sign}alpha" in runs.coords]
            sides = [(float(runs[f"{sign}alpha"][0]), float(runs[f"{sign}p"][0])) for sign in signs]
            measure = replace(measure, period_s=2.0 * math.pi / min(sides)[1])
        levels = fragility.states[-1].curve.levels
        reached = [each for each in fragility.states if each.share(levels[-1]) > 0.0]
        missed = ", ".join(each.state.name for each in fragility.states if each not in reached)
        if not reached:
            words = Words(f"has no run that reaches {missed}")
            valid = "some run must reach a state of a component"
            raise InputError("fragility", words, valid, "count at higher levels")
        kept = [each for each in reached if each.state.name != UPLIFT or not lognormal] or reached
        left_out = f" Left out: {missed}, which no run reaches." if missed else ""
        if len(kept) < len(reached):
            left_out += f" Left out: {UPLIFT}, whose share is a step."
        note = (
            f"{fragility.runs:,} runs of {plural(fragility.records, 'record')} at "
            f"{plural(len(levels), 'level')} up to {quantity(levels[-1], measure.unit)}, "
            f"{'as lognormals' if lognormal else 'made monotone'}."
        )
        return cls(
            identifier=identifier,
            measure=measure,
            states=tuple(map(_lognormal_of if lognormal else _points_of, kept)),
            floor=floor,
            description=description,
            note=note + left_out,
        )


def state_name(name: str) -> str:
    """Return the name of a damage state as OpenQuake takes it: letters, digits and underscores.

    Examples
    --------
    >>> state_name("theta/alpha > 0.25"), state_name("no return")
    ('theta_alpha_0p25', 'no_return')
    """
    plain = re.sub(r"(?<=\d)\.(?=\d)", "p", name)
    plain = re.sub(r"[^A-Za-z0-9_]+", "_", plain).strip("_")[:LONGEST]
    return plain if plain[:1].isalpha() else f"state_{plain}"[:LONGEST]


def check_identifiers(components: Sequence[LossComponent]) -> None:
    """Check that there are components, each with its own identifier.

    Raises
    ------
    InputError
        If there are none, or two have the same identifier.
    """
    names = [component.identifier for component in components]
    if not names or len(set(names)) < len(names):
        twice = sorted({name for name in names if names.count(name) > 1})
        words = Words(f"have {', '.join(twice)} twice" if twice else "are none")
        valid = "there must be one or more, each with its own identifier"
        raise InputError("components", words, valid, "give each its own")


def _lognormal_of(state: StateFragility) -> LossState:
    """Return a damage state as its lognormal, which must summarise the counted shares."""
    best = state.lognormal
    if not state.is_lognormal:
        misfit = f"{number(100.0 * best.misfit, 2)} points away"
        away = (
            "no lognormal is near" if math.isnan(best.beta) else f"the best lognormal is {misfit}"
        )
        words = Words(f"does not hold '{state.state.name}', {away}")
        valid = f"it must be within {100.0 * GOOD:g} points of the counted shares"
        raise InputError("lognormal", words, valid, "leave it out: points hold them")
    return LossState(name=state.state.name, median=best.median, beta=best.beta)


def _points_of(state: StateFragility) -> LossState:
    """Return a damage state as points, which some run must reach.

    Of two levels that six digits cannot separate the lower one stays.
    """
    first = float(state.curve.lifts_at[0])
    above = state.curve.levels[state.curve.levels > first]
    above = above[np.diff(above, prepend=0.0) > STEP * above]
    if above[0] > first * (1.0 + STEP) ** 2:
        above = np.append(first * (1.0 + STEP), above)
    levels = np.append(min(first, above[0] / (1.0 + STEP)), above)
    # Between equal shares, interpolation may be off by a rounding.
    shares = np.maximum.accumulate(state.share(levels))
    return LossState(name=state.state.name, levels=levels.tolist(), shares=shares.tolist())
