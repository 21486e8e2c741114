"""Fate of one run proved: a block at rest falls, or stands, under a pulse or a record."""

import hashlib
from fractions import Fraction
from typing import Annotated, Any

from rocksteady.certify.proofs import fate_checker
from rocksteady.certify.proofs._balls import decimal_of, precision
from rocksteady.certify.proofs.certificate import (
    MOST_BITS,
    PROVED,
    UNDECIDED,
    BitCount,
    Certificate,
    Numbers,
    attempts,
    check_model,
    harmonic_numbers,
    place,
)
from rocksteady.dynamics.overturning.windows import OverturningWindows
from rocksteady.errors import ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.checks.validation import index_value
from rocksteady.model.equations import ModelChoice, chosen_model
from rocksteady.model.motions.pulses import Pulse
from rocksteady.model.motions.record import Record
from rocksteady.results.description import Fact
from rocksteady.results.numbers import plural

RECORD_BITS = 256
"""Precision from which the proof of a run under a record starts: impacts cost bits."""
EDGE = Fraction(1, 10**9)
"""Part of an amplitude on either side of an edge of a window where its enclosure starts."""


def proof_of(
    content: dict[str, Any], samples: list[float], numbers: Numbers, most_bits: int
) -> Any:
    """Return outcome and impacts, the bits that decided, and of which numbers it is that.

    The run is that of `fate_checker`, the program that checks the certificate.
    """
    bits, given = 0, numbers
    for bits, given in attempts(numbers, most_bits):
        if samples and bits < min(RECORD_BITS, most_bits):
            continue
        try:
            with precision(bits):
                arithmetic = fate_checker.arb(bits)
                return fate_checker.run(arithmetic, content, samples, given), bits, given
        except (ArithmeticError, ValueError):
            continue
    return None, bits, given


def pulse_content(pulse: Pulse) -> dict[str, Any]:
    """Return the pieces of a pulse as its certificate holds them.

    Raises
    ------
    ModelError
        If it is sampled, or its phase has no closed form.
    """
    if pulse.shape not in fate_checker.PULSES:
        raise ModelError(
            "motion",
            Words(f"is a {pulse.shape} pulse"),
            "proofs lack an enclosure of its samples or of its phase",
            "take one of half a period or of a period, as one-sine",
        )
    return {
        "pulse": pulse.shape,
        "pieces": fate_checker.pieces(pulse.shape, pulse.reverse),
    }


@checked
def certify_fate(
    block: Block | DimensionlessBlock,
    motion: Pulse | Record,
    *,
    model: ModelChoice = None,
    most_bits: BitCount = MOST_BITS,
) -> Certificate:
    """Prove whether a block at rest falls or stands.

    Each first impact is found and proved in balls, rest by the theorem of docs/theory/march.md,
    and the end by the growing part of a flight or by its energy.  A record's samples are the
    doubles that it holds, and the block's numbers are doubles.

    Parameters
    ----------
    block
        A block of equal sides.
    motion
        A record, or a pulse whose shape is exact.
    model
        ``"linear"``, the only equations with proofs: give it with a `Block`.
    most_bits
        Precision at which the proof gives up.

    Raises
    ------
    ModelError
        If no proof is written for the block or the motion.

    Examples
    --------
    >>> import rocksteady as rs
    >>> block = rs.DimensionlessBlock(restitution=0.9)
    >>> pulse = rs.Pulse(shape="one-sine", amplitude=2.0, frequency_ratio=2.0)
    >>> certify_fate(block, pulse).claim
    'the block falls: one-sine pulse, A = 2.0, W = 2.0, restitution = 0.9'
    """
    check_model(block, chosen_model(model, block))
    samples: list[float] = []
    if isinstance(motion, Pulse):
        numbers = harmonic_numbers(motion.amplitude, motion.frequency_ratio, block.restitution)
        content = pulse_content(motion)
    elif not isinstance(block, Block):
        raise ModelError(
            "motion",
            Words("is a record"),
            "a record in seconds and m/s^2 needs a block with sizes",
            "give a Block, which has p and alpha g",
        )
    else:
        doubles = block.alpha, block.p, block.gravity, motion.dt_s, block.restitution
        names = ("alpha", "p", "gravity", "dt_s", "restitution")
        numbers = {name: (decimal_of(Fraction(x)),) for name, x in zip(names, doubles, strict=True)}
        samples = motion.acceleration_m_s2.tolist()
        packed = motion.acceleration_m_s2.astype("<f8").tobytes()
        content = {"samples": len(samples), "sha256": hashlib.sha256(packed).hexdigest()}
    fate, bits, given = proof_of(content, samples, numbers, most_bits)
    if isinstance(motion, Pulse):
        what = f"{'reversed ' * motion.reverse}{motion.shape} pulse, {place(given)}"
    else:
        what = f"record {motion.name}" if motion.name else "record"
    if fate is None:
        return Certificate(
            kind="fate",
            verdict=UNDECIDED,
            claim=f"the block falls or stands: {what}",
            model=given,
            bits=bits,
            content={},
            reason=f"a landing, a rest or the end is undecided with {bits} bits",
        )
    outcome, impacts = fate
    return Certificate(
        kind="fate",
        verdict=PROVED,
        claim=f"the block {outcome}: {what}",
        model=given,
        bits=bits,
        content=content | {"claim": {"outcomes": [outcome]}},
        facts=(
            Fact("outcome", outcome),
            Fact("impacts", impacts, "known after", plural(impacts, "impact")),
            Fact("", bits, "bits", f"{bits} needed; a double has 53"),
        ),
        samples=tuple(samples),
    )


@checked
def certify_edges(
    windows: OverturningWindows,
    *,
    row: int = 0,
    places: Annotated[int, Whole(1, 300, "give digits after the point, as 30")] = 30,
) -> tuple[Certificate, ...]:
    """Enclose the edges of overturning windows: amplitudes between which the fate changes.

    Parameters
    ----------
    windows
        Windows of an exact pulse, of the linear model.
    row
        Which of its frequencies.
    places
        Digits after the point of each enclosure.

    Returns
    -------
    tuple of Certificate
        One for each edge inside the range, in ascending order: at least one edge lies in each.

    Raises
    ------
    InputError, ModelError
        If there is no such row, or no proof is written for the pulse, the block or the model.

    Examples
    --------
    >>> import rocksteady as rs
    >>> block = rs.DimensionlessBlock(restitution=0.9)
    >>> pulse = rs.Pulse(shape="one-sine", amplitude=1.0, frequency_ratio=2.0)
    >>> windows = rs.find_overturning_windows(block, pulse, [2.0], within=(1.0, 2.0))
    >>> certify_edges(windows, places=12)[0].content["between"]
    ('1.225179423268', '1.225179423269')
    """
    check_model(windows.block, windows.model)
    row = index_value(row, len(windows.frequency_ratio), "row", name="row")
    ratio = float(windows.frequency_ratio[row])
    content = pulse_content(windows.pulse)
    low, high = windows.within
    edges = {edge for pair in windows.intervals(row) for edge in pair if low < edge < high}
    return tuple(
        _edge(content, edge, ratio, windows.block.restitution, places) for edge in sorted(edges)
    )


def _edge(
    content: dict[str, Any], edge: float, ratio: float, restitution: float, places: int
) -> Certificate:
    """Return the enclosure of one edge, by bisection between decimals."""
    unit = 10**places
    ends = [round(Fraction(edge) * (1 + side * EDGE) * unit) for side in (-1, 1)]
    bits = 64 + 4 * places

    def outcome(scaled: int) -> str | None:
        given = harmonic_numbers(_decimal(scaled, places), ratio, restitution)
        alone = {name: texts[:1] for name, texts in given.items()}
        fate, _, _ = proof_of(content, [], alone, bits)
        return None if fate is None else str(fate[0])

    fates = [outcome(end) for end in ends]
    known = None not in fates and fates[0] != fates[1]
    while known and ends[1] - ends[0] > 1:
        middle = sum(ends) // 2
        fate = outcome(middle)
        if fate is None:
            break
        ends[fates.index(fate)] = middle
    between = [_decimal(end, places) for end in ends]
    numbers = harmonic_numbers(between[0], ratio, restitution)
    return Certificate(
        kind="fate",
        verdict=PROVED if known else UNDECIDED,
        claim=f"the fate changes between A = {between[0]} and {between[1]}, W = {ratio}",
        model={name: texts[:1] for name, texts in numbers.items() if name != "amplitude"},
        bits=bits,
        content=content | {"between": between, "claim": {"outcomes": fates}},
        reason="" if known else f"with {bits} bits no two fates differ beside {edge!r}",
    )


def _decimal(scaled: int, places: int) -> str:
    """Return a whole number of units of the last place as a decimal."""
    digits = str(scaled).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"
