"""Components of loss models: what is written for pelicun and OpenQuake, in SI units and g."""

import itertools
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rocksteady.arrays import Floats
from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import positive
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.risk.hazard.hazard_measures import intensity_named

LossMeasure = Literal["pga_g", "pgv_m_s", "sa_g"]

MEASURES: tuple[LossMeasure, ...] = ("pga_g", "pgv_m_s", "sa_g")
"""Intensity measures that loss tools have a name for."""
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_.]{0,74}")
LONGEST = 75
"""Characters of a name, in OpenQuake."""
WORDS_FOR_NOTHING = frozenset(
    {"inf", "infinity", "na", "nan", "none", "null", "true", "false", "units"}
)
"""Identifiers that a reader of tables takes for a missing or another value, in small letters."""
MOST_STATES = 9
"""Of a component: pelicun takes limit states in the order of the alphabet, LS10 before LS2."""
POINTS = 151
"""Probabilities at whose intensities a curve is written."""
LEAST = 1e-6
"""Least probability that a file of points holds above 0."""
STEP = 1e-4
"""Of ln(intensity): half of the width that a step has in a file of points."""
SEARCHED = (1e-4, 1e4)
"""Intensities between which a curve goes from 0 to 1."""
CROSSING = 0.001
"""Probability by which a state may exceed a lighter one without a note."""


@checked
@dataclass(frozen=True, kw_only=True, eq=False)
class LossState:
    """Damage state of a component, with its fragility: a lognormal, or any other curve.

    Parameters
    ----------
    name
        In words, as "theta/alpha > 0.5".
    median
        Intensity at which half exceed the state, in the component's unit; None with a curve.
    beta
        Standard deviation of the logarithm; None with a curve.
    curve
        Probability at an array of intensities, of the same shape, in place of a lognormal; default
        None. Files hold it as points.
    note
        What the curve stands for, and how far it is from the runs.

    Raises
    ------
    InputError
        If the name is empty, the median or beta is not above 0, or it is not the one or the other.

    Examples
    --------
    >>> state = LossState(name="overturned", median=0.724, beta=0.5)
    >>> state.probability([0.724]).round(3)
    array([0.5])
    """

    name: str
    median: float | None = None
    beta: float | None = None
    curve: Callable[..., Any] | None = None
    note: str = ""

    def __post_init__(self) -> None:
        """Validate all."""
        if not text_value("name", self.name).strip():
            raise InputError("name", self.name, "a state has a name", "name it as 'overturned'")
        text_value("note", self.note)
        if (self.median is None) != (self.beta is None) or (
            (self.median is None) == (self.curve is None)
        ):
            raise InputError(
                "median",
                self.median,
                "a state has a median and a beta, or a curve",
                "give both, or the probability as a function of the intensity alone",
            )
        if self.median is not None:
            hint = "give an intensity in the component's unit"
            object.__setattr__(self, "median", positive("median", self.median, hint=hint))
            hint = "give the standard deviation of the logarithm"
            object.__setattr__(self, "beta", positive("beta", self.beta, hint=hint))

    def probability(self, intensity: ArrayLike) -> Floats:
        """Return the probability of the state or a worse one.

        Parameters
        ----------
        intensity
            In the component's unit, 0 or above, of any shape.

        Raises
        ------
        InputError
            If an intensity is negative or NaN.
        """
        values = np.asarray(intensity, dtype=np.float64)
        if not (values >= 0.0).all():
            worst = float(values[~(values >= 0.0)].flat[0])
            raise InputError("intensity", worst, "it must be 0 or above", "give an intensity")
        if self.curve is not None:
            return np.asarray(self.curve(values), dtype=np.float64)
        from scipy.special import ndtr

        assert self.median is not None
        assert self.beta is not None
        with np.errstate(divide="ignore"):  # ln 0 is -inf, whose probability is 0
            ratio = np.log(values) - math.log(self.median)
        return np.asarray(ndtr(ratio / self.beta), dtype=np.float64)


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
        "pga_g", "pgv_m_s" or "sa_g"; "sa_g:0.7" gives the period too.
    states
        In increasing order of severity.
    period_s
        Period of "sa_g" [s], 5 % damped.
    floor
        Whether the demand is that of a floor and not of the ground; off by default.
    no_damage
        Intensity up to which there is no damage at all, in the unit of the measure, as the uplift
        limit g tan(alpha) of a peak acceleration; None by default.
    description
        Description of the object, in a sentence.

    Raises
    ------
    InputError
        If the identifier is not valid, a period is missing or superfluous, two states have one
        name, or there are more than nine: pelicun takes LS10 before LS2.

    Examples
    --------
    >>> falls = LossState(name="overturned", median=0.724, beta=0.5)
    >>> component = LossComponent(identifier="RS.cabinet", measure="pgv_m_s", states=(falls,))
    >>> component.identifier
    'RS.cabinet'
    """

    identifier: str
    measure: LossMeasure | str
    states: tuple[LossState, ...]
    period_s: float | None = None
    floor: bool = False
    no_damage: float | None = None
    description: str = ""

    def __post_init__(self) -> None:
        """Validate all."""
        text_value("identifier", self.identifier)
        text_value("description", self.description)
        if (
            not IDENTIFIER.fullmatch(self.identifier)
            or self.identifier.lower() in WORDS_FOR_NOTHING
        ):
            raise InputError(
                "identifier",
                self.identifier,
                f"it must be a letter, then letters, digits, '_' and '.', {LONGEST} at most, and "
                "no word for a missing value",
                "name it as RS.cabinet",
            )
        if ":" in str(self.measure) and self.period_s is None:
            intensity = intensity_named("measure", self.measure)
            object.__setattr__(self, "measure", intensity.name)
            object.__setattr__(self, "period_s", intensity.period_s)
        if self.measure not in MEASURES:
            raise InputError(
                "measure",
                self.measure,
                "loss tools accept " + ", ".join(MEASURES),
                "use one of them",
            )
        if (self.period_s is not None) != (self.measure == "sa_g"):
            raise InputError(
                "period_s", self.period_s, "sa_g has a period, and no other measure", "give seconds"
            )
        for name in ("period_s", "no_damage"):
            value = getattr(self, name)
            if value is not None:
                hint = "give seconds" if name == "period_s" else "leave it out for none"
                object.__setattr__(self, name, positive(name, value, hint=hint))
        names = [state_name(state.name) for state in self.states]
        if not 1 <= len(names) <= MOST_STATES or len(set(names)) < len(names):
            valid = f"there must be 1 to {MOST_STATES}, of names that differ in letters and digits"
            raise InputError("states", names, valid, "choose fewer, or rename each")

    @property
    def notes(self) -> list[str]:
        """Sentences on what the curves stand for, and on curves that cross."""
        each = [f"{state.name}: {state.note}" for state in self.states if state.note]
        return [*each, *_crossings(self)]


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


def checked_components(components: object) -> list[LossComponent]:
    """Return components: one or more, each with its own identifier.

    A writer's own annotation is quoted, so that counted shares are refused here and by their name.

    Raises
    ------
    InputError
        If there are none, one is something else, or two have the same identifier.
    """
    given = list(components) if isinstance(components, list | tuple) else [components]
    if any(isinstance(each, Fragility | StateFragility) for each in given):
        raise InputError(
            "components",
            Words("are counted shares"),
            "files for loss tools are made of a median and a beta that you give",
            "give a LossComponent, whose states have both",
        )
    made = [each for each in given if isinstance(each, LossComponent)]
    if len(made) < len(given):
        raise InputError(
            "components",
            components,
            "it must be a list of components",
            "give a list of LossComponents",
        )
    names = [component.identifier for component in made]
    if not names or len(set(names)) < len(names):
        twice = sorted({name for name in names if names.count(name) > 1})
        raise InputError(
            "components",
            Words(f"have {', '.join(twice)} twice" if twice else "are none"),
            "there must be one or more, each with its own identifier",
            "give each its own",
        )
    return made


def _crossings(component: LossComponent) -> list[str]:
    """Return a sentence for each state that is likelier than a lighter one at some intensity."""
    if len(component.states) == 1:
        return []
    crossings = []
    levels = np.geomspace(*SEARCHED, 8001)
    rows = [probability_of(component, state, levels) for state in component.states]
    pairs = itertools.pairwise(zip(component.states, rows, strict=True))
    for (lighter, low), (worse, high) in pairs:
        over = np.nan_to_num(high - low)
        if over.max() > CROSSING:
            crossings.append(
                f"The curve of '{worse.name}' is up to {over.max():.2g} above that of "
                f"'{lighter.name}', at {levels[over.argmax()]:.3g}: curves are not forced apart."
            )
    return crossings


def probability_of(component: LossComponent, state: LossState, intensity: ArrayLike) -> Floats:
    """Return the probability of a state in a component: 0 up to its limit without damage."""
    at = np.asarray(intensity, dtype=np.float64)
    shares = state.probability(at)
    return shares if component.no_damage is None else np.where(at > component.no_damage, shares, 0)


def _unfit(curve: Floats) -> str:
    """Return why points cannot hold a curve; empty where they can."""
    if not np.isfinite(curve).all():
        return "no probability at some intensities"
    if (np.diff(curve) < -LEAST).any():
        return "a probability that falls with the intensity"
    if curve[0] > LEAST or curve[-1] < 1.0 - 10.0 * LEAST:
        return "a probability that does not go from 0 to 1"
    return ""


def points_of(component: LossComponent, state: LossState) -> Floats:
    """Return intensities between which straight lines hold a curve, from its probability 0 to 1.

    They are those of probabilities from 1e-6 to 1 - 1e-5, in equal steps of the logarithm of the
    odds, and the two sides of each step.

    Raises
    ------
    InputError
        If the curve has no probability at some intensities, falls, or does not go from 0 to 1.
    """
    odds = np.linspace(math.log(LEAST), -math.log(10.0 * LEAST), POINTS)
    asked = 1.0 / (1.0 + np.exp(-odds))

    def shares(logs: Floats) -> Floats:
        return probability_of(component, state, np.exp(logs))

    trial = np.log(np.geomspace(*SEARCHED, 8001))
    curve = shares(trial)
    reason = _unfit(curve)
    if reason:
        raise InputError(
            component.identifier,
            Words(f"has {reason} in {state.name!r}"),
            "a file of points holds curves that rise from 0 to 1",
            "leave the state out",
        )
    place = np.searchsorted(np.maximum.accumulate(curve), asked).clip(1)
    low, high = trial[place - 1], trial[place]
    for _ in range(40):
        middle = 0.5 * (low + high)
        above = shares(middle) >= asked
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    first = np.diff(high, prepend=-np.inf) > 2.0 * STEP
    last = np.diff(high, append=np.inf) > 2.0 * STEP
    sides = [high[first & ~last] - STEP, high[last & ~first] + STEP]
    levels: Floats = np.exp(np.sort(np.concatenate([high[first & last], *sides])))
    return levels
