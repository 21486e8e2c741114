"""From the strings and numbers of the command line to the nouns of the model."""

import math
from typing import TYPE_CHECKING

from rocksteady.errors import InputError, ModelError
from rocksteady.model.block import Block, DimensionlessBlock, Restitution
from rocksteady.model.examples import example_block
from rocksteady.model.motions import Harmonic
from rocksteady.model.validation import non_negative, odd_order

if TYPE_CHECKING:
    from rocksteady.dynamics.start import Start

MOST_AXIS_POINTS = 1_000_000


def number(flag: str, text: str) -> float:
    """Return the number that a flag was given.

    Raises
    ------
    InputError
        If the text is no number.
    """
    try:
        return float(text)
    except ValueError:
        raise InputError(
            name=flag, value=text, valid="it must be a number", hint="write it as 2 or 0.35"
        ) from None


def axis(flag: str, text: str) -> list[float]:
    """Return the values of ``start:stop:count``, both ends included; ``log:`` before it spaces them
    logarithmically.  A single number is an axis of one.

    Raises
    ------
    InputError
        If the text is neither.
    """  # noqa: D205 -- one sentence
    parts = text.split(":")
    logarithmic = parts[0] == "log"
    ends = parts[1:] if logarithmic else parts
    if len(parts) == 1:
        return [number(flag, text)]
    hint = "write start:stop:count or log:start:stop:count, as 0.5:12:200"
    if len(ends) != 3 or not ends[2].isdigit():
        raise InputError(name=flag, value=text, valid="it must be a number or an axis", hint=hint)
    start, stop, count = number(flag, ends[0]), number(flag, ends[1]), int(ends[2])
    if not (math.isfinite(start) and math.isfinite(stop)):
        raise InputError(name=flag, value=text, valid="the ends must be finite", hint=hint)
    if not 2 <= count <= MOST_AXIS_POINTS:
        valid = f"an axis has from 2 to {MOST_AXIS_POINTS} points"
        raise InputError(name=flag, value=text, valid=valid, hint=hint)
    if logarithmic and not (start > 0.0 and stop > 0.0):
        valid = "the ends of a logarithmic axis must be above 0"
        raise InputError(name=flag, value=text, valid=valid, hint=hint)
    last = count - 1
    if logarithmic:
        ratio = math.log(stop / start)
        return [start, *(start * math.exp(ratio * i / last) for i in range(1, last)), stop]
    return [start, *(start + (stop - start) * i / last for i in range(1, last)), stop]


def restitution_from(text: str | None, *, default: Restitution | None) -> Restitution:
    """Return a restitution: a number, "housner", or the default where none was given.

    Raises
    ------
    InputError
        If it is missing and has no default, or is neither.
    """
    if text is None:
        if default is None:
            raise InputError(
                name="restitution",
                value="not given",
                valid="without a block it is needed",
                hint="add -r 0.8, or describe a block to take Housner's value",
            )
        return default
    if text == "housner":
        if default is None:
            raise InputError(
                name="restitution",
                value=text,
                valid="Housner's value follows from a block's slenderness",
                hint="describe a block, or give a number in (0, 1]",
            )
        return "housner"
    try:
        return float(text)
    except ValueError:
        raise InputError(
            name="restitution",
            value=text,
            valid="it must be a number in (0, 1] or 'housner'",
            hint="write it as -r 0.8",
        ) from None


def block_from(
    *,
    named: str | None,
    width_m: float | None,
    height_m: float | None,
    alpha_rad: float | None,
    radius_m: float | None,
    p_rad_s: float | None,
    gravity_m_s2: float,
    restitution: str | None,
) -> Block | DimensionlessBlock:
    """Return the block that the flags describe; a dimensionless one where none does.

    Raises
    ------
    InputError
        If a number is outside its range.
    ModelError
        If the flags describe a block in two ways, or half of one.
    """
    sizes = {
        "--width-m": width_m,
        "--height-m": height_m,
        "--alpha-rad": alpha_rad,
        "--radius-m": radius_m,
        "--p-rad-s": p_rad_s,
    }
    given = [flag for flag, value in sizes.items() if value is not None]
    if named is not None:
        if given:
            raise _two_blocks(["--block", *given])
        own = None if restitution is None else restitution_from(restitution, default="housner")
        return example_block(named, restitution=own, gravity=gravity_m_s2)
    if not given:
        ratio = restitution_from(restitution, default=None)
        return DimensionlessBlock(restitution=float(ratio))
    ratio = restitution_from(restitution, default="housner")
    if width_m is not None and height_m is not None and len(given) == 2:
        return Block.rectangle(
            width=width_m, height=height_m, restitution=ratio, gravity=gravity_m_s2
        )
    if alpha_rad is not None and radius_m is not None and len(given) == 2:
        return Block.from_radius(
            alpha=alpha_rad, radius=radius_m, restitution=ratio, gravity=gravity_m_s2
        )
    if alpha_rad is not None and p_rad_s is not None and len(given) == 2:
        return Block.from_p(alpha=alpha_rad, p=p_rad_s, restitution=ratio, gravity=gravity_m_s2)
    raise _two_blocks(given)


def _two_blocks(given: list[str]) -> ModelError:
    return ModelError(
        name="the block",
        value=" ".join(given),
        valid="it is described by --width-m with --height-m, by --alpha-rad with --radius-m, by "
        "--alpha-rad with --p-rad-s, or by --block alone",
        hint="give one of these pairs",
    )


def shaking_from(
    block: Block | DimensionlessBlock,
    *,
    amplitude: str | None,
    frequency_ratio: str | None,
    accel_g: float | None,
    freq_hz: float | None,
) -> tuple[list[float], list[float]]:
    """Return amplitudes A and frequency ratios of harmonic shaking, each an axis or one value.

    Raises
    ------
    InputError, ModelError
        If a value is missing, given twice, or needs a block.
    """
    for flag, value in (("--accel-g", accel_g), ("--freq-hz", freq_hz)):
        if value is not None and isinstance(block, DimensionlessBlock):
            raise ModelError(
                name=flag,
                value=value,
                valid="g and Hz need a block with a slenderness and a p",
                hint="describe a block, or give -A and -W",
            )
    for flag, one, other in (
        ("--amplitude/-A and --accel-g", amplitude, accel_g),
        ("--frequency-ratio/-W and --freq-hz", frequency_ratio, freq_hz),
    ):
        if (one is None) == (other is None):
            state = "both given" if one is not None else "neither given"
            raise ModelError(
                name=flag, value=state, valid="exactly one of the two is needed", hint="give one"
            )
    amplitudes = axis("amplitude", amplitude) if amplitude is not None else []
    ratios = axis("frequency_ratio", frequency_ratio) if frequency_ratio is not None else []
    if accel_g is not None:
        non_negative("--accel-g", accel_g, hint="give the peak in g; 0.3 is usual")
    if isinstance(block, Block) and not (amplitudes and ratios):
        # What was given dimensionless is left out of this shaking, and what it says of the rest
        # is kept.
        shaking = Harmonic.from_si(
            block,
            acceleration_m_s2=1.0 if accel_g is None else accel_g * block.gravity,
            frequency_hz=block.p / (2.0 * math.pi) if freq_hz is None else freq_hz,
        )
        amplitudes = amplitudes or [shaking.amplitude]
        ratios = ratios or [shaking.frequency_ratio]
    return amplitudes, ratios


def single(flag: str, values: list[float]) -> float:
    """Return the one value of an axis of one.

    Raises
    ------
    InputError
        If it is an axis of several.
    """
    if len(values) > 1:
        raise InputError(
            name=flag,
            value=f"{len(values)} values",
            valid="this command takes one value",
            hint="give a number, not an axis",
        )
    return values[0]


def start_from(text: str, *, order: int, frequency_ratio: float | None) -> "Start":
    """Return the start that ``rest``, ``steady``, ``steady:2``, ``U,DU`` or ``U,w=V`` names.

    Raises
    ------
    InputError
        If the text is none of these.
    """
    from rocksteady.dynamics.start import Rest, State, Steady

    odd_order(order)
    if text == "rest":
        return Rest()
    if text in ("steady", "steady:1", "steady:2"):
        return Steady(branch=2 if text.endswith("2") else 1, order=order)
    parts = text.split(",")
    hint = "write rest, steady, steady:2, U,DU (du/dtau) or U,w=V (du/d(pt)), as 0.4,0 or 0.4,w=0"
    if len(parts) != 2:
        raise InputError(name="start", value=text, valid="it is no known start", hint=hint)
    angle = number("start", parts[0])
    with_rate = parts[1].startswith("w=")
    velocity = number("start", parts[1].removeprefix("w="))
    if not (math.isfinite(angle) and math.isfinite(velocity)):
        raise InputError(name="start", value=text, valid="its numbers must be finite", hint=hint)
    if with_rate:
        return State(angle=angle, velocity=velocity)
    if frequency_ratio is None:
        raise InputError(
            name="start",
            value=text,
            valid="du/dtau needs harmonic shaking",
            hint="give du/d(pt) as U,w=V",
        )
    return State.per_tau(angle=angle, velocity=velocity, frequency_ratio=frequency_ratio)
