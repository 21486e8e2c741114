"""Bifurcation points proved: folds, symmetry breakings and period doublings."""

from dataclasses import dataclass
from typing import Any

from flint import arb, arb_mat, arb_series, ctx

from rocksteady.certify.proofs import base_checker, point_checker
from rocksteady.certify.proofs._balls import ball, decimals_around, mid, precision, size
from rocksteady.certify.proofs._flight import Shaking
from rocksteady.certify.proofs._krawczyk import Enclosure, enclose
from rocksteady.certify.proofs.certificate import (
    MOST_BITS,
    PROVED,
    UNDECIDED,
    BitCount,
    Certificate,
    Numbers,
    ladder,
    place,
)
from rocksteady.certify.proofs.orbit import (
    Proposal,
    links,
    passage,
    propose,
    trace_of,
)
from rocksteady.dynamics.continuation.chains.point_types import PointType
from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.description import Fact
from rocksteady.results.numbers import plural

SIGNS = {PointType.FOLD: 1, PointType.SYMMETRY_BREAKING: -1, PointType.PERIOD_DOUBLING: -1}
"""The multiplier of the chain of impacts at each type; a symmetric orbit's chain is half of it."""


@dataclass(frozen=True)
class PointProof:
    """What is proved of a point, and with how many bits."""

    verdict: str
    reason: str
    bits: int
    numbers: Numbers
    zero: Enclosure | None = None
    opens: int = 0
    critical: str = ""


class Extended:
    """The equations of a bifurcation point in the phases and the amplitude: (E3) and the trace."""

    def __init__(self, ratio: arb, restitution: arb, orders: tuple[int, ...], sign: int) -> None:
        self.ratio, self.restitution = ratio, restitution
        self.orders, self.sign = orders, sign

    def shaking(self, amplitude: Any) -> Shaking:
        """Return the shaking of an amplitude."""
        return Shaking(amplitude, self.ratio, self.restitution)

    def __call__(self, unknowns: list[arb]) -> tuple[list[arb], list[list[arb]]]:
        """Return the residuals of the phases and the amplitude, and their Jacobian."""
        columns = []
        for chosen in range(len(unknowns)):
            lifted = [arb_series([x, int(k == chosen)], 2) for k, x in enumerate(unknowns)]
            columns.append([arb(part[1]) for part in self._residuals(lifted)])
        plain = self._residuals(unknowns)
        return plain, [list(entries) for entries in zip(*columns, strict=True)]

    def _residuals(self, unknowns: list[Any]) -> list[Any]:
        """Return the mismatches, and the trace less its value at the point."""
        *phases, amplitude = unknowns
        ctx.cap = 2
        rows = links(self.shaking(amplitude), phases, self.orders).rows
        limit = 1 + self.restitution ** (2 * len(phases))
        return [*(each.mismatch for each in rows), trace_of(rows) - self.sign * limit]

    def direction(self, zero: list[arb]) -> tuple[arb, arb]:
        """Return how the orbits that meet at a point open, and how the trace passes it.

        Returns
        -------
        tuple
            a_2 of the amplitude A + a_2 s^2 along the branch that turns or begins at the point, s a
            measure of the distance (docs/theory/proofs.md), by the program that checks it, and the
            derivative of the trace by the amplitude along the orbit that doubles; 0 at a fold.
        """
        *phases, amplitude = zero
        count, ratio = len(phases), self.ratio
        shaken = amplitude, ratio, self.restitution, amplitude / (1 + ratio * ratio)
        numbers = base_checker.arb(ctx.prec)
        opens = point_checker.opening(numbers, shaken, phases, self.orders, self.sign)
        if self.sign > 0:
            return opens, arb(0)
        *rows, last = self(zero)[1]
        right = arb_mat(count, 1, [each[count] for each in rows])
        column = arb_mat([each[:count] for each in rows]).solve(right)
        return opens, last[count] - sum(last[k] * column[k, 0] for k in range(count))


def prove_point(proposal: Proposal, sign: int, most_bits: int = MOST_BITS) -> PointProof:
    """Return what is proved of a point near a proposal, with as many bits as it takes."""
    # Of the decimals alone: rounding of the parameters would only move the point.
    numbers = {name: proposal.numbers[name][:1] for name in ("frequency_ratio", "restitution")}
    proof = PointProof(UNDECIDED, "no precision was tried", 0, numbers)
    start = [*proposal.phases, float(proposal.numbers["amplitude"][0])]
    for bits in ladder(most_bits)[1:]:
        with precision(bits):
            ratio, restitution = map(ball, numbers.values())
            system = Extended(ratio, restitution, proposal.half_periods, sign)
            proof = _proof(system, start, bits, numbers)
        if proof.verdict == PROVED:
            break
    return proof


def _proof(system: Extended, start: list[float], bits: int, numbers: Numbers) -> PointProof:
    """Return what one precision proves."""
    zero = enclose(system, [arb(x) for x in start])
    if zero is None:
        reason = "no box around it passes the test of Krawczyk"
        return PointProof(UNDECIDED, reason, bits, numbers)
    *phases, amplitude = zero.box
    shaking, orders = system.shaking(amplitude), system.orders
    if passage(shaking, phases, orders, links(shaking, phases, orders)):
        return PointProof(UNDECIDED, "a flight is not above the floor", bits, numbers, zero)
    try:
        rise, passing = system.direction(zero.box)
    except (ArithmeticError, ValueError):
        return PointProof(UNDECIDED, "its criticality is undecided", bits, numbers, zero)
    opens = 1 if rise > 0 else (-1 if rise < 0 else 0)
    product = rise * passing
    critical = "supercritical" if product < 0 else ("subcritical" if product > 0 else "")
    if opens == 0 or (system.sign < 0 and not critical):
        return PointProof(UNDECIDED, "its criticality is undecided", bits, numbers, zero)
    return PointProof(PROVED, "", bits, numbers, zero, opens, critical)


def _content(
    proposal: Proposal, claim: dict[str, Any], centres: list[str], radii: list[str]
) -> dict[str, object]:
    """Return what the certificate holds, with the widest box of the first phase that is checked.

    The checker moves it over its box, and the other unknowns have to stay inside theirs; of some
    sixty impacts its inverse in doubles is too coarse, and there is nothing to hold.
    """
    numbers = {name: texts[:1] for name, texts in proposal.numbers.items() if name != "amplitude"}
    place_of_radius = int(radii[0].partition("e-")[2])
    for share in range(8):
        content = {
            "half_periods": list(proposal.half_periods),
            "phases": centres[:-1],
            "amplitude": centres[-1],
            "radii": [f"1e-{place_of_radius + share}", *radii[1:]],
            "claim": claim,
        }
        try:
            point_checker.point(base_checker.arb(ctx.prec + 64), {"model": numbers, **content})
        except (ArithmeticError, ValueError):
            continue
        return content
    return {}


@checked
def certify_point(origin: BranchPoint, *, most_bits: BitCount = MOST_BITS) -> Certificate:
    """Prove a bifurcation at a point of a branch, and enclose its amplitude.

    Proved is a regular zero of (E3) with the condition of the multiplier, in the phases and the
    amplitude: the fold is quadratic, or the multiplier passes -1; with the side to which the
    orbits open, and whether the orbits that branch off are stable (supercritical).

    Parameters
    ----------
    origin
        A fold, symmetry breaking or period doubling of the linear model; its frequency ratio
        and restitution are kept, and the amplitude is enclosed.
    most_bits
        Precision at which the proof gives up.

    Raises
    ------
    ModelError
        If no proof is written for its type, its equations, its block or its shaking.

    Examples
    --------
    >>> import rocksteady as rs
    >>> block = rs.DimensionlessBlock(restitution=0.8)
    >>> motion = rs.Harmonic(amplitude=1.0, frequency_ratio=2.0)
    >>> orbit = rs.find_orbits(block, motion, max_period=1)[0]
    >>> points = rs.branches.follow_branch(orbit, "amplitude", (0.1, 3.0))
    >>> point = next(each for each in points if each.type == "symmetry-breaking")
    >>> certify_point(point).content["amplitude"][:18]
    '2.1201669312648425'
    """
    sign = SIGNS.get(origin.type)
    if sign is None:
        raise ModelError(
            "origin",
            Words(f"is a point of type {origin.type}"),
            "points proved are a fold, a symmetry-breaking or a period-doubling",
            "take one of these",
        )
    proposal = propose(origin)
    proof = prove_point(proposal, sign, most_bits)
    name = str(origin.type).replace("-", " ")
    kind = f"{proof.critical} {name}".strip()
    impacts = plural(origin.impacts, "impact")
    claim = f"one {kind} of the {origin.kind} motion with {impacts}: {place(proof.numbers)}"
    content: dict[str, object] = {}
    facts: list[Fact] = []
    if proof.zero is not None and proof.verdict == PROVED:
        with precision(proof.bits):
            centres, radii = decimals_around(proof.zero.box)
            amplitude = proof.zero.box[-1]
            width = size(amplitude - mid(amplitude))
            apart = size(amplitude - arb(origin.amplitude))
            shown, side = amplitude.str(30), "larger" if proof.opens > 0 else "smaller"
            claim_of: dict[str, Any] = {"sign": sign, "opens": proof.opens}
            claim_of |= {"criticality": proof.critical} if sign < 0 else {}
            content = _content(proposal, claim_of, centres, radii)
        facts = [
            Fact("amplitude", centres[-1], "A", shown),
            Fact("error", width, "A within", f"{width:.1g}"),
            Fact("alone_within", proof.zero.alone, "alone within", f"{proof.zero.alone:.2g}"),
            Fact("double_error", apart, "double off by", f"{apart:.1g}"),
            Fact("opens", proof.opens, "opens", f"to {side} A"),
        ]
    return Certificate(
        kind="point",
        verdict=proof.verdict,
        claim=claim,
        model=proof.numbers,
        bits=proof.bits,
        content=content,
        facts=tuple(facts),
        reason=proof.reason,
    )
