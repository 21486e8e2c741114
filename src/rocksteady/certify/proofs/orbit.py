"""Periodic motions proved: existence, uniqueness, first impacts and stability."""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

from flint import arb

from rocksteady.certify.proofs._balls import decimals_around, mid, precision, size
from rocksteady.certify.proofs._flight import (
    Arc,
    Factors,
    Phase,
    Row,
    Shaking,
    factors,
    liftoff,
    row,
    stays_above,
)
from rocksteady.certify.proofs._krawczyk import Enclosure, enclose
from rocksteady.certify.proofs.certificate import (
    MOST_BITS,
    PROVED,
    REFUTED,
    UNDECIDED,
    BitCount,
    Certificate,
    Numbers,
    attempts,
    check_model,
    harmonic_numbers,
    place,
)
from rocksteady.dynamics.continuation.from_orbit import chain_at
from rocksteady.dynamics.continuation.points import BranchPoint
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.errors import ModelError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.description import Fact
from rocksteady.results.numbers import plural


class Proposal(NamedTuple):
    """What floating-point numbers propose: the impacts of an orbit, or of half a symmetric one.

    The phases are seen from the side on which each flight begins; `half_periods` is n_k, odd, in
    T_k = (psi_(k+1) - psi_k + n_k pi)/Omega.
    """

    numbers: Numbers
    half_periods: tuple[int, ...]
    phases: tuple[float, ...]


@dataclass(frozen=True)
class OrbitProof:
    """What is proved of a proposal, and with how many bits."""

    verdict: str
    reason: str
    bits: int
    numbers: Numbers
    zero: Enclosure | None = None
    stability: str = ""
    trace: arb | None = None


def propose(origin: Orbit | BranchPoint) -> Proposal:
    """Return the impacts of an orbit that the package has found.

    Raises
    ------
    ModelError
        If no proof is written for its equations, its block or its shaking.
    """
    check_model(origin.block, origin.model)
    if isinstance(origin, Orbit) and origin.rest_phases:
        raise ModelError(
            "origin",
            Words("is an orbit with rests"),
            "proofs of orbits lack the infinitely many impacts before a rest",
            "take one without rest",
        )
    chain = chain_at(origin)
    if chain.harmonics:
        raise ModelError(
            "origin",
            Words("is an orbit under a Fourier series"),
            "proofs lack flights under several sinusoids",
            "take one under Harmonic shaking",
        )
    turns, count = chain.turns.tolist(), chain.impacts
    lifts = [*turns, turns[0] + chain.half_cycles]
    flips = [(turn + k) % 2 for k, turn in enumerate(turns)]
    flips.append(flips[0])
    orders = tuple(lifts[k + 1] - lifts[k] - flips[k + 1] + flips[k] for k in range(count))
    phases = tuple(
        phase + math.pi * flip for phase, flip in zip(chain.phases.tolist(), flips, strict=False)
    )
    return Proposal(harmonic_numbers(*chain.parameters.tolist()), orders, phases)


class Links(NamedTuple):
    """A chain of impacts in balls: flights and the equations of the impacts between them."""

    phases: list[Phase]
    flights: list[Factors]
    rows: list[Row]


def links(shaking: Shaking, phases: list[Any], half_periods: tuple[int, ...]) -> Links:
    """Return the flights and the equations (E3) of a closed chain of impacts.

    Parameters
    ----------
    shaking
        Its parameters.
    phases
        The impact phases, balls or power series.
    half_periods
        The odd number of half periods of each flight.
    """
    ends = [phases[-1], *phases, phases[0]]
    sines = [Phase(*phase.sin_cos()) for phase in ends]
    orders = (half_periods[-1], *half_periods)
    flights = [
        factors((-shaking.duration(ends[k], ends[k + 1], order)).exp())
        for k, order in enumerate(orders)
    ]
    rows = [row(shaking, sines[k : k + 3], flights[k], flights[k + 1]) for k in range(len(phases))]
    return Links(sines[1:-1], flights[1:], rows)


def jacobian(rows: list[Row]) -> list[list[arb]]:
    """Return the derivatives of the mismatches."""
    count = len(rows)
    matrix = [[arb(0)] * count for _ in rows]
    for k, each in enumerate(rows):
        for j, value in ((k - 1, each.before), (k, each.at), (k + 1, each.after)):
            matrix[k][j % count] = matrix[k][j % count] + value
    return matrix


def trace_of(rows: list[Row]) -> Any:
    """Return the trace of the linearised chain, by its recurrence from impact to impact."""
    a, b, c, d = arb(1), arb(0), arb(0), arb(1)
    for each in rows:
        scale = -1 / each.after
        p, q = each.at * scale, each.before * scale
        a, b, c, d = p * a + q * c, p * b + q * d, a, b
    return a + d


def passage(
    shaking: Shaking, phases: list[arb], half_periods: tuple[int, ...], chain: Links
) -> str:
    """Return what is wrong with the flights of a chain: empty, "undecided" or "refuted"."""
    count = len(phases)
    for k, flight in enumerate(chain.flights):
        after = (k + 1) % count
        ends = phases[k], phases[after]
        arc = Arc(*ends, shaking.duration(*ends, half_periods[k]))
        speed = liftoff(shaking, chain.phases[k], chain.phases[after], flight)
        clear = stays_above(shaking, arc) if speed > 0 and arc.duration > 0 else None
        if speed < 0 or clear is False:
            return REFUTED
        if not clear:
            return UNDECIDED
    return ""


def may_repeat(shaking: Shaking, phases: list[arb], half_periods: tuple[int, ...]) -> bool:
    """Return whether a part of a closed chain may be the whole motion.

    A chain of m flights closes after m impacts, or 2 m where m is odd.
    """
    count = len(phases)
    places = range(count)
    times = [shaking.duration(phases[k - 1], phases[k], half_periods[k - 1]) for k in places]

    def differ(k: int, j: int) -> bool:
        return bool(((phases[k] - phases[j]) / 2).sin() != 0 or times[k] != times[j])

    return any(
        not any(differ(k, k - part) for k in places)
        for part in range(1, count)
        if count % part == 0 and part * (1 + part % 2) < count * (1 + count % 2)
    )


def prove_orbit(proposal: Proposal, most_bits: int = MOST_BITS) -> OrbitProof:
    """Return what is proved of an orbit, with as many bits as it takes."""
    proof = OrbitProof(UNDECIDED, "no precision was tried", 0, proposal.numbers)
    for bits, numbers in attempts(proposal.numbers, most_bits):
        with precision(bits):
            proof = _proof(proposal, numbers, bits)
        if proof.verdict != UNDECIDED:
            break
    return proof


def _proof(proposal: Proposal, numbers: Numbers, bits: int) -> OrbitProof:
    """Return what one precision proves."""
    shaking, orders = Shaking.of(numbers), proposal.half_periods
    count = len(orders)

    def system(phases: list[arb]) -> tuple[list[arb], list[list[arb]]]:
        rows = links(shaking, phases, orders).rows
        return [each.mismatch for each in rows], jacobian(rows)

    def failed(reason: str, verdict: str = UNDECIDED) -> OrbitProof:
        return OrbitProof(verdict, reason, bits, numbers, zero)

    zero = enclose(system, [arb(phase) for phase in proposal.phases])
    if zero is None:
        return failed("no box around it passes the test of Krawczyk")
    if may_repeat(shaking, zero.box, orders):
        return failed("a part of its impacts may be the whole motion")
    chain = links(shaking, zero.box, orders)
    wrong = passage(shaking, zero.box, orders, chain)
    if wrong == REFUTED:
        return failed("it passes through the floor and is no motion", REFUTED)
    if wrong:
        return failed("it is too near the floor")
    trace = trace_of(chain.rows)
    loss = shaking.restitution ** (2 * count)
    inside, outside = abs(trace) < 1 + loss, abs(trace) > 1 + loss
    if not inside and not outside:
        return failed("it is too near a bifurcation")
    stability = "unstable" if outside else ("stable" if loss < 1 else "neutral")
    return OrbitProof(PROVED, "", bits, numbers, zero, stability, trace)


@checked
def certify_orbit(origin: Orbit | BranchPoint, *, most_bits: BitCount = MOST_BITS) -> Certificate:
    """Prove that a periodic motion exists, and whether it is stable.

    Proved are, in balls: there is exactly one such motion near the given one, each flight leaves
    the floor and meets it next at the end, and both multipliers lie inside the unit circle, or one
    outside.  Its phases solve (E3) of docs/theory/proofs.md.

    Parameters
    ----------
    origin
        An orbit of the linear model without rest, or a point of a branch.
    most_bits
        Precision at which the proof gives up.

    Returns
    -------
    Certificate
        "refuted" of a solution that passes through the floor.

    Raises
    ------
    ModelError
        If no proof is written for its equations, its block or its shaking.

    Examples
    --------
    >>> import rocksteady as rs
    >>> block = rs.DimensionlessBlock(restitution=0.8)
    >>> motion = rs.Harmonic(amplitude=2.0, frequency_ratio=2.0)
    >>> orbit = rs.find_orbits(block, motion, max_period=1)[0]
    >>> certify_orbit(orbit).claim
    'one stable symmetric motion, 1 period, 2 impacts: A = 2.0, W = 2.0, restitution = 0.8'
    """
    proposal = propose(origin)
    proof = prove_orbit(proposal, most_bits)
    count = len(proposal.half_periods)
    impacts = 2 * count if count % 2 == 1 else count
    kind = f"{proof.stability} {origin.kind}".strip()
    what = f"one {kind} motion, {plural(origin.period, 'period')}, {plural(impacts, 'impact')}"
    claim = f"{what}: {place(proof.numbers)}"
    content: dict[str, object] = {}
    facts: list[Fact] = []
    if proof.zero is not None and proof.verdict == PROVED:
        with precision(proof.bits):
            centres, radii = decimals_around(proof.zero.box)
            widest = max(size(part - mid(part)) for part in proof.zero.box)
            apart = max(
                size(part - arb(phase))
                for part, phase in zip(proof.zero.box, proposal.phases, strict=True)
            )
            assert proof.trace is not None
            trace = proof.trace.str(12)
        content = {
            "half_periods": list(proposal.half_periods),
            "phases": centres,
            "radii": radii,
            "claim": {"stability": proof.stability},
        }
        facts = [
            Fact("phase", centres[0], "first phase", f"{centres[0][:20]} rad"),
            Fact("error", widest, "phases within", f"{widest:.1g} rad"),
            Fact("alone_within", proof.zero.alone, "alone within", f"{proof.zero.alone:.2g} rad"),
            Fact("double_error", apart, "doubles off by", f"{apart:.1g} rad"),
            Fact("trace", trace, "trace", trace),
        ]
    return Certificate(
        kind="orbit",
        verdict=proof.verdict,
        claim=claim,
        model=proof.numbers,
        bits=proof.bits,
        content=content,
        facts=tuple(facts),
        reason=proof.reason,
    )
