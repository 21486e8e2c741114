"""Chaos near the hilltops proved: a motion for every sequence of impact phases and flights."""

import math
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any, NamedTuple

from rocksteady.certify.balls import (
    above,
    arb,
    ball,
    below,
    decimal_of,
    exact,
    halves,
    mid,
    precision,
    size,
)
from fractions import Fraction

from rocksteady.certify.certificate import (
    PROVED,
    UNDECIDED,
    Certificate,
    harmonic_numbers,
    place,
)
from rocksteady.certify.flight import (
    Arc,
    Factors,
    Phase,
    Row,
    Shaking,
    factors,
    factors_from,
    landing,
    liftoff,
    row,
    stays_above,
)
from rocksteady.results.description import Fact

BITS = 64
RADII = ("0.15", "0.1", "0.05", "0.02")
"""Half-widths of the boxes of impact phases that are tried [rad]."""
LONGEST = 15
"""Largest number of half periods that is tried for the shortest flight."""
SPLITS = 12
"""Bisections of a box of phases after which a test is undecided."""


class Horseshoe(NamedTuple):
    """A claim: every sequence of impact phases in boxes, and of flights, is one motion.

    A flight lasts n half periods plus the difference of its phases, n any of `least`,
    `least` + 2, ...; `centres` and `radius` are decimals.
    """

    centres: tuple[str, ...]
    radius: str
    least: int

    @property
    def boxes(self) -> list[arb]:
        """The boxes of impact phases."""
        radius = exact(Fraction(self.radius))
        return [
            (centre - radius).union(centre + radius)
            for centre in (exact(Fraction(text)) for text in self.centres)
        ]

    @property
    def entropy(self) -> float:
        """A lower bound of the topological entropy per period of the shaking.

        Sequences whose flights add up to L half periods grow in number as z^-L, with
        ``symbols z^least/(1 - z^2) = 1``.
        """
        count, low, high = len(self.centres), Fraction(0), Fraction(1)
        for _ in range(40):
            z = (low + high) / 2
            enough = count * z**self.least >= 1 - z * z
            low, high = (low, z) if enough else (z, high)
        with precision(BITS):
            bound = -2 * exact(high).log()
            return math.nextafter(float(bound.lower()), 0.0)


class Link(NamedTuple):
    """Flights from one box of phases to another: of one duration, or of all longer ones."""

    start: int
    end: int
    half_periods: int
    longer: bool

    def factors(self, shaking: Shaking, phase: arb, next_phase: arb) -> Factors:
        """Return the factors of its flights."""
        duration = shaking.duration(phase, next_phase, self.half_periods)
        return factors_from(duration) if self.longer else factors(duration)


def sure(test: Callable[..., Any], boxes: tuple[arb, ...], left: int = SPLITS) -> bool:
    """Return whether a test holds on boxes, which are bisected where it is undecided."""
    stack = [(boxes, left)]
    while stack:
        parts, depth = stack.pop()
        if test(*parts):
            continue
        if depth == 0:
            return False
        widest = max(range(len(parts)), key=lambda k: float(parts[k].rad()))
        for half in halves(parts[widest]):
            stack.append(((*parts[:widest], half, *parts[widest + 1 :]), depth - 1))
    return True


def prove_horseshoe(shaking: Shaking, claim: Horseshoe) -> str:
    """Return which part of the proof fails; empty where all of it holds.

    1. (E3) changes sign across each box, whatever the neighbours: a motion for every sequence
    (Poincare, Miranda; Tychonoff).  2. Its Jacobian is diagonally dominant: exactly one, and
    hyperbolic.  3. Each flight leaves the floor, stays above it and lands: it is a motion.
    """
    boxes = claim.boxes
    count = len(boxes)
    kinds = ((claim.least, False), (claim.least + 2, True))
    link = [Link(i, j, *kind) for i, j, kind in product(range(count), range(count), kinds)]
    if not all(_flies(shaking, each, mid(boxes[each.start]), mid(boxes[each.end])) for each in link):
        return "a flight passes through the floor"
    pairs = [(first, then) for first in link for then in link if then.start == first.end]
    for first, then in pairs:
        last, here, following = (boxes[k] for k in (first.start, first.end, then.end))

        def rows(x: arb, y: arb, z: arb, first: Link = first, then: Link = then) -> Row:
            sines = (Phase(*phase.sin_cos()) for phase in (x, y, z))
            return row(
                shaking, *sines, first.factors(shaking, x, y), then.factors(shaking, y, z)
            )

        signs = []
        for face in (below(here), above(here)):
            for sign in (1, -1):

                def pushes(x: arb, z: arb, face: arb = face, sign: int = sign) -> bool:
                    return bool(sign * rows(x, face, z).mismatch > 0)

                if sure(pushes, (last, following)):
                    signs.append(sign)
                    break
        if len(signs) < 2 or signs[0] == signs[1]:
            return "an impact phase can leave its box"

        def dominates(x: arb, y: arb, z: arb) -> bool:
            found = rows(x, y, z)
            return bool(abs(found.at) > abs(found.before) + abs(found.after))

        if not sure(dominates, (last, here, following)):
            return "motions of one sequence may be several"
    for each in link:

        def flies(x: arb, y: arb, each: Link = each) -> bool:
            return _flies(shaking, each, x, y)

        if not sure(flies, (boxes[each.start], boxes[each.end])):
            return "a flight may pass through the floor"
    return ""


def _flies(shaking: Shaking, link: Link, phase: arb, next_phase: arb) -> bool:
    """Return whether all flights of a link between phases are proved to be flights."""
    duration = shaking.duration(phase, next_phase, link.half_periods)
    if not duration > 0:
        return False
    ends = Phase(*phase.sin_cos()), Phase(*next_phase.sin_cos())
    flight = link.factors(shaking, phase, next_phase)
    rising = liftoff(shaking, *ends, flight) > 0 and landing(shaking, *ends, flight) > 0
    arc = Arc(phase, next_phase, duration, link.longer)
    return bool(rising and stays_above(shaking, arc, 14))


def hilltop_phases(shaking: Shaking) -> list[float]:
    """Return the impact phases of endless flights, by docs/theory/steady.md; none below A_het."""
    amplitude, ratio, loss = (
        float(x.mid()) for x in (shaking.amplitude, shaking.ratio, shaking.restitution)
    )
    share = (1.0 - loss) / (1.0 + loss)
    level = share * (1.0 + ratio * ratio) / (amplitude * math.hypot(1.0, share * ratio))
    if level >= 1.0:
        return []
    lag = math.atan(share * ratio)
    return [math.asin(level) - lag, math.pi - math.asin(level) - lag]


def claims(shaking: Shaking) -> Iterator[Horseshoe]:
    """Yield claims to try, those of the largest entropy first."""
    centres = hilltop_phases(shaking)
    if not centres:
        return
    texts = tuple(f"{centre:.5f}" for centre in centres)
    sets = (texts, texts[1:], texts[:1])
    kinds = [
        Horseshoe(phases, RADII[0], least)
        for phases in sets
        for least in range(1, LONGEST + 1, 2)
    ]
    for kind in sorted(kinds, key=lambda each: -each.entropy):
        for radius in RADII:
            yield kind._replace(radius=radius)


def certify_hilltops(amplitude: Any, ratio: Any, restitution: Any) -> Certificate:
    """Return the horseshoe of the largest entropy that is proved near the hilltops."""
    numbers = harmonic_numbers(amplitude, ratio, restitution)
    with precision(BITS):
        shaking = Shaking.of(numbers)
        reason = "A is below that of the heteroclinic motions, A_het"
        for claim in claims(shaking):
            reason = prove_horseshoe(shaking, claim)
            if not reason:
                return _certificate(numbers, claim)
    return Certificate(
        kind="chaos",
        verdict=UNDECIDED,
        claim=f"chaos near the hilltops: {place(numbers)}",
        model=numbers,
        bits=BITS,
        content={},
        reason=reason,
    )


def _certificate(numbers: Any, claim: Horseshoe) -> Certificate:
    """Return the certificate of a horseshoe."""
    symbols = len(claim.centres)
    flights = f"{claim.least}, {claim.least + 2}, {claim.least + 4}, ..."
    phases = "either of two impact phases" if symbols == 2 else "one impact phase"
    entropy = f"{math.floor(claim.entropy * 1000) / 1000:.3f}"
    return Certificate(
        kind="chaos",
        verdict=PROVED,
        claim=f"every sequence of flights of {flights} half periods is a motion: {place(numbers)}",
        model=numbers,
        bits=BITS,
        content={
            "phases": list(claim.centres),
            "radius": claim.radius,
            "least_half_periods": claim.least,
            "claim": {"entropy_per_period": entropy},
        },
        facts=(
            Fact("impact_phases", list(claim.centres), "sequences", f"{phases} at each impact"),
            Fact("radius", claim.radius, "phases within", f"{claim.radius} rad"),
            Fact("entropy", claim.entropy, "entropy", f"at least {entropy} per period"),
            Fact("scope", "", "not claimed", "that a motion from rest settles on this set"),
        ),
    )
