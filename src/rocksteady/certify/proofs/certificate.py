"""Certificates: what is proved, with the numbers from which a program of its own checks it."""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Annotated, Any

from rocksteady.certify.proofs._balls import BITS, Stated, stated
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Whole
from rocksteady.model.checks.validation import LARGEST
from rocksteady.model.equations import Linear, Model
from rocksteady.results.description import Fact
from rocksteady.results.result import Result

FORMAT = "rocking-certificate/1"
"""What the first key of a file holds."""
PROVED, REFUTED, UNDECIDED = "proved", "refuted", "undecided"
MOST_BITS = 4096
BitCount = Annotated[int, Whole(32, 2**16, "give the bits at which a proof gives up, as 1024")]
"""Default precision at which a proof gives up."""
NAMES = ("amplitude", "frequency_ratio", "restitution")
"""Names of the numbers of harmonic shaking, in the order of `flight.Shaking`."""
SYMBOLS = dict(zip(NAMES, ("A", "W", "restitution"), strict=True))
LONG = r"(\.0*\d{15})\d{6,}$"
"""Decimals of which the last are left out in words."""

Numbers = dict[str, Stated]


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Certificate(Result):
    """A claim with its verdict, and the numbers from which the standalone program proves it again.

    Attributes
    ----------
    kind
        "orbit", "point", "fate", "region" or "chaos".
    verdict
        "proved", "refuted" where the opposite is proved, or "undecided".
    claim
        The claim in a sentence.
    model
        The decimals of each parameter: of two the claim holds for all numbers between them, which
        are the text that was given and its double.
    bits
        Precision that decided; 0 where none did.
    content
        What else the file holds.
    facts
        What is known beside the claim: label and words.
    reason
        Why it is not proved; empty where it is.
    samples
        The accelerations of a record [m/s^2], of which the file holds the hash alone.
    """

    kind: str
    verdict: str
    claim: str
    model: Mapping[str, Stated]
    bits: int
    content: Mapping[str, Any]
    facts: tuple[Fact, ...] = ()
    reason: str = ""
    samples: tuple[float, ...] = ()

    @property
    def proved(self) -> bool:
        """Whether the claim is proved."""
        return self.verdict == PROVED

    def to_json(self) -> str:
        """Return the text of the certificate's file.

        Raises
        ------
        ModelError
            If the claim is not proved.
        """
        if not self.proved:
            raise ModelError(
                "certificate",
                Words(f"is {self.verdict}"),
                self.reason or "there is no proof",
                "save what is proved",
            )
        if not self.content:
            raise ModelError(
                "certificate",
                Words("has no file"),
                "it is proved here, but too long for the standalone program",
                "save one of fewer impacts",
            )
        model = {name: list(texts) for name, texts in self.model.items()}
        values = {"format": FORMAT, "kind": self.kind, "model": model, "bits": self.bits}
        values |= self.content
        return json.dumps(values, indent=1, default=dict) + "\n"


def meaning(model: Mapping[str, Stated]) -> str:
    """Return of which numbers a claim is one, in words."""
    doubles = [SYMBOLS.get(name, name) for name, texts in model.items() if len(texts) > 1]
    if not doubles:
        return "the decimals as they are written"
    return f"{', '.join(doubles)}: the decimal, its double, and all between"


def place(model: Mapping[str, Stated]) -> str:
    """Return the parameters of a claim in words."""
    words = []
    for name, texts in model.items():
        low, high = min(map(Fraction, texts)), max(map(Fraction, texts))
        ends = [
            min((text for text in texts if abs(Fraction(text) - end) <= high / 10**9), key=len)
            for end in ((low, high) if high - low > high / 10**9 else (Fraction(texts[0]),))
        ]
        shown = " to ".join(re.sub(LONG, r"\1...", end) for end in ends)
        words.append(f"{SYMBOLS.get(name, name)} = {shown}")
    return ", ".join(words)


def attempts(numbers: Numbers, most_bits: int) -> Iterator[tuple[int, Numbers]]:
    """Yield precisions and numbers to try: with the doubles first, then the decimals alone.

    Between a decimal and its double nothing is gained from more bits than the second precision.
    """
    alone = {name: texts[:1] for name, texts in numbers.items()}
    if alone != numbers:
        yield from ((bits, numbers) for bits in ladder(most_bits)[:2])
    yield from ((bits, alone) for bits in ladder(most_bits))


def ladder(most_bits: int) -> list[int]:
    """Return the precisions of a proof that gives up at a number of bits."""
    return [bits for bits in BITS if bits < most_bits] + [most_bits]


def harmonic_numbers(amplitude: Any, ratio: Any, restitution: Any) -> Numbers:
    """Return the decimals of the three parameters of harmonic shaking; of a range both ends.

    Raises
    ------
    InputError
        If one is no number, not above 0 or too large.
    """
    given = zip(NAMES, (amplitude, ratio, restitution), strict=True)
    numbers = {
        name: sum((stated(name, end) for end in value), ())
        if isinstance(value, tuple)
        else stated(name, value)
        for name, value in given
    }
    for name, texts in numbers.items():
        if not texts:
            raise InputError(name, texts, "it must be a number or a range", "give its ends")
        if (
            not 0.0
            < min(map(Fraction, texts))
            <= max(map(Fraction, texts))
            <= (1.0 if name == "restitution" else LARGEST)
        ):
            raise InputError(
                name,
                texts[0],
                f"it must be above 0{' and at most 1' * (name == NAMES[2])}",
                "give a decimal, as 0.8",
            )
    return numbers


def check_model(block: Block | DimensionlessBlock, model: Model) -> None:
    """Refuse what no proof is written for.

    Raises
    ------
    ModelError
        If the equations are the full ones, the sides differ, or the block stands against a wall.
    """
    missing = None
    if not isinstance(model, Linear):
        missing = "model", "enclosures of the Taylor series of the full equations", '"linear"'
    elif block.one_sided:
        missing = "block", "the reversal of the velocity at a wall", "a free block"
    elif not block.symmetric:
        missing = "block", "flights of two kinds for sides that differ", "a block of equal sides"
    if missing is not None:
        name, lack, instead = missing
        valid = f"proofs lack {lack}"
        raise ModelError(name, Words("is not covered by proofs"), valid, f"take {instead}")
