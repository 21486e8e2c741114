"""Chaos proved, near the hilltops or of the rocking itself, by the program that checks it."""

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any, Literal

from rocksteady.certify.proofs import base_checker, chaos_checker
from rocksteady.certify.proofs._balls import precision
from rocksteady.certify.proofs._hilltops import horseshoes
from rocksteady.certify.proofs._homoclinic import chains
from rocksteady.certify.proofs.certificate import (
    PROVED,
    UNDECIDED,
    Certificate,
    Numbers,
    harmonic_numbers,
    place,
)
from rocksteady.model.checks.arguments import checked
from rocksteady.results.description import Fact

BITS = 64
"""Precision of proofs of chaos, whose boxes are wide."""
HILLTOP, HOMOCLINIC = "hilltop", "homoclinic"
Search = Callable[[float, float, float], Iterator[dict[str, Any]]]
SEARCHES: dict[str, tuple[Search, Callable[[Any, Any], None], str]] = {
    HILLTOP: (
        horseshoes,
        chaos_checker.hilltops,
        "A is below that of the heteroclinic motions, A_het",
    ),
    HOMOCLINIC: (
        chains,
        chaos_checker.homoclinic,
        "no saddle with a homoclinic motion was found: the symmetric motion may be stable",
    ),
}
"""Search, proof and what is missing where the search finds nothing."""


def proved_chaos(numbers: Numbers, kind: str) -> tuple[dict[str, Any] | None, str]:
    """Return what a certificate of chaos holds, and why there is none.

    Parameters
    ----------
    numbers
        The decimals of the shaking; of several chaos is proved for all numbers between them.
    kind
        Which search is made.
    """
    search, proof, reason = SEARCHES[kind]
    middle = [sum(map(Fraction, texts)) / len(texts) for texts in numbers.values()]
    with precision(BITS):
        arithmetic = base_checker.arb(BITS)
        for content in search(*map(float, middle)):
            try:
                proof(arithmetic, {"model": numbers, **content})
                return content, ""
            except (ArithmeticError, ValueError) as failed:
                reason = f"the last of the sets that were tried fails: {failed}"
    return None, reason


@checked
def certify_chaos(
    amplitude: float | str | tuple[float, float],
    frequency_ratio: float | str | tuple[float, float],
    restitution: float | str,
    *,
    kind: Literal["hilltop", "homoclinic"] = "hilltop",
) -> Certificate:
    """Prove chaos of the linear block, with its sequences and a bound of its entropy.

    Near the hilltops every sequence of flights of n, n + 2, n + 4, ... half periods, n odd, is a
    motion, whose impact phases lie in one box or either of two.  Along a motion homoclinic to the
    symmetric one every sequence of two words of impacts is one, of flights of one half period.
    What motions from other states settle to is not claimed.

    Parameters
    ----------
    amplitude, frequency_ratio, restitution
        Numbers, or their decimals as text; of the first two also a range (low, high), for all
        of whose members the same sequences are then motions.
    kind
        "hilltop" or "homoclinic".

    Returns
    -------
    Certificate
        Of the largest entropy that is proved; undecided where none is.

    Examples
    --------
    >>> certificate = certify_chaos(2, 2, "0.8")
    >>> certificate.proved, dict(certificate.content["claim"])
    (True, {'entropy_per_period': '0.8392'})
    """
    numbers = harmonic_numbers(amplitude, frequency_ratio, restitution)
    content, reason = proved_chaos(numbers, kind)
    where = place(numbers)
    if content is None:
        return Certificate(
            kind="chaos",
            verdict=UNDECIDED,
            claim=f"chaos, {kind}: {where}",
            model=numbers,
            bits=BITS,
            content={},
            reason=reason,
        )
    entropy = content["claim"]["entropy_per_period"]
    if kind == HILLTOP:
        least, phases = content["least_half_periods"], tuple(content["phases"])
        which = f"flights of {least}, {least + 2}, {least + 4}, ... half periods"
        boxes = " or ".join(f"{phase} rad" for phase in phases)
        facts = [
            Fact("impact_phases", phases, "impacts at", f"{boxes}, within {content['radius']}")
        ]
    else:
        count = len(content["frames"])
        which = f"words of 1 and {count} impacts"
        facts = [Fact("words", [1, count], "flights", "of one half period, beside the saddle")]
    return Certificate(
        kind="chaos",
        verdict=PROVED,
        claim=f"every sequence of {which} is a motion: {where}",
        model=numbers,
        bits=BITS,
        content=content,
        facts=(
            *facts,
            Fact("entropy_per_period", float(entropy), "entropy", f"{entropy} per period or more"),
            Fact("", "", "not claimed", "that other motions settle on this set"),
        ),
    )
