"""Parameters of block, shaking and start: names, units, and how one is varied."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import combinations
from typing import Any, NamedTuple, TypeVar

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.validation import finite, is_pair
from rocksteady.model.motions.fourier import FourierSeries, PeriodicMotion
from rocksteady.model.motions.segments import Harmonic

PARAMETERS = ("amplitude", "frequency_ratio", "restitution")
"""What orbits are followed in and motions are carried along."""
SYMBOLS = {"amplitude": "A", "frequency_ratio": "Ω", "restitution": "restitution"}
"""The same, as texts and titles have them."""
SIZES = ("width", "height", "alpha", "radius", "p")
"""Of a homogeneous rectangle."""
NARROWEST = 1e-9
"""Of a range in which orbits are followed, its width over the size of its larger end."""
ASYMMETRY = ("negative_restitution", "alpha_ratio", "p_ratio")
"""By what the sides of a dimensionless block differ."""


class Parameter(NamedTuple):
    """What a parameter is."""

    units: str
    """As in the attributes of a dataset."""
    long_name: str
    """In words."""


AXES: Mapping[str, Parameter] = {
    "kick": Parameter("1", "distance from the steady state at the start"),
    "phase": Parameter("rad", "phase of the shaking at the start"),
    "restitution": Parameter("1", "angular velocity after an impact over that before it"),
    "negative_restitution": Parameter("1", "restitution of the impact that ends negative rotation"),
    "p_ratio": Parameter("1", "p of the negative side over that of the positive one"),
    "alpha_ratio": Parameter("1", "alpha of the negative side over that of the positive one"),
    "p": Parameter("rad s-1", "frequency parameter of the block"),
    "radius": Parameter("m", "half-diagonal of the block"),
    "alpha": Parameter("rad", "slenderness of the block"),
    "height": Parameter("m", "full height of the block"),
    "width": Parameter("m", "full width of the block"),
    "velocity": Parameter("1", "d(theta/alpha)/d(p t) at the start"),
    "angle": Parameter("1", "theta/alpha at the start"),
    "amplitude": Parameter("1", "a_max/(alpha g)"),
    "acceleration_m_s2": Parameter("m s-2", "peak base acceleration"),
    "frequency_ratio": Parameter("1", "omega/p"),
    "frequency_hz": Parameter("Hz", "frequency of the shaking"),
}
"""Parameters that may be axes of a map, in the default order of dimensions: of two that make a
picture the first is drawn upwards, the second to the right."""

TWICE = (
    {"amplitude", "acceleration_m_s2"},
    {"frequency_ratio", "frequency_hz"},
    {"radius", "p"},
    *({side, measure} for side in ("width", "height") for measure in ("alpha", "radius", "p")),
)
"""Pairs that set one thing in two ways."""


def validated_axes(axes: Iterable[str], fixed: Iterable[str] = ()) -> tuple[str, ...]:
    """Return the names of a map's axes.

    Parameters
    ----------
    axes
        One or more.
    fixed
        Parameters that are given one value, in place of that of block, shaking and start.

    Raises
    ------
    InputError
        If there is no axis, or a name is not in `AXES`.
    ModelError
        If two of all these names set one thing in two ways.

    Examples
    --------
    >>> validated_axes(["amplitude", "width"], ["frequency_hz"])
    ('amplitude', 'width')
    """
    moved = tuple(axes)
    names = (*moved, *fixed)
    if not moved:
        raise InputError(
            "axes",
            names,
            "a map has one axis or more",
            "give a mapping of names to values, as {'amplitude': [1.0, 2.0]}",
        )
    for name in names:
        if name not in AXES:
            raise InputError(
                "axes", name, "there is no parameter of that name", "choose from " + ", ".join(AXES)
            )
    for pair in combinations(names, 2):
        if pair[0] == pair[1] or set(pair) in TWICE:
            raise ModelError(
                "axes",
                Words(f"hold both {pair[0]} and {pair[1]}"),
                "they set one thing in two ways",
                f"leave {pair[0]} or {pair[1]} out",
            )
    return moved


def shaking_of(block: Block | DimensionlessBlock, given: Mapping[str, float]) -> Harmonic:
    """Return the shaking that parameters describe, amplitude and frequency in either measure.

    Parameters
    ----------
    block
        That is shaken; m/s^2 and Hz need one with a size.
    given
        amplitude or acceleration_m_s2, frequency_ratio or frequency_hz, and phase, 0 where it is
        not given.  Other parameters are not looked at.

    Raises
    ------
    InputError
        If a value is outside its range.

    Examples
    --------
    >>> block = Block.from_p(alpha=0.2, p=3.0, gravity=10.0)
    >>> shaking_of(block, {"acceleration_m_s2": 4.0, "frequency_ratio": 5.0})
    Harmonic(amplitude=2.0, frequency_ratio=5.0, phase=0.0)
    """
    phase = given.get("phase", 0.0)
    known = {name: given[name] for name in ("amplitude", "frequency_ratio") if name in given}
    if len(known) == 2 or not isinstance(block, Block):
        return Harmonic(phase=phase, **known)
    shaking = Harmonic.from_si(  # what is known in the other measure takes its place below
        block,
        acceleration_m_s2=given.get("acceleration_m_s2", 0.0),
        frequency_hz=given.get("frequency_hz", block.p),
        phase=phase,
    )
    return replace(shaking, **known)


AnyBlock = TypeVar("AnyBlock", Block, DimensionlessBlock, Block | DimensionlessBlock)


AnyShaking = TypeVar("AnyShaking", Harmonic, FourierSeries, PeriodicMotion)


def moved_to(
    block: AnyBlock, shaking: AnyShaking, parameter: str, value: float
) -> tuple[AnyBlock, AnyShaking]:
    """Return block and shaking with one of the parameters at a value.

    Raises
    ------
    InputError
        If the value is outside the parameter's range.
    """
    if parameter == "restitution":
        return block.with_restitution(value), shaking
    moved: Any = {parameter: value}
    return block, replace(shaking, **moved)


def range_of(within: object, parameter: str) -> tuple[float, float]:
    """Return both ends of a range of a parameter, the lower one first.

    Raises
    ------
    InputError
        If they are not two finite numbers in this order, or nearly equal: steps of a search in it
        would be those of rounding.
    """
    hint = f"give a pair (low, high) of {parameter}"
    if not is_pair(within):
        raise InputError("within", within, "it must be two numbers", hint)
    low, high = (finite("within", end, hint=hint) for end in within)
    if not low < high:
        raise InputError("within", within, "its lower end must be below its upper end", hint)
    if high - low < NARROWEST * max(abs(low), abs(high)):
        valid = f"its ends must differ by {NARROWEST:g} of the larger one or more"
        raise InputError("within", within, valid, "widen it")
    return low, high
