"""Chaos of the rocking itself proved: coverings along a motion homoclinic to the symmetric one.

A state is the pair of the last two impact phases, and (E3) gives the next one; every flight lasts
one half period plus the difference of its phases.
"""

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.certify.balls import (
    above,
    arb,
    around,
    below,
    ball,
    exact,
    hull,
    mid,
    precision,
    size,
)
from rocksteady.certify.certificate import (
    PROVED,
    UNDECIDED,
    Certificate,
    Numbers,
    harmonic_numbers,
    place,
)
from rocksteady.certify.flight import (
    Arc,
    Phase,
    Shaking,
    factors,
    landing,
    liftoff,
    row,
    stays_above,
)
from rocksteady.dynamics.steady.states import steady_states
from rocksteady.results.description import Fact

BITS = 64
NEAR = 1e-3
"""Distance from the symmetric motion at which its homoclinic motion is cut [rad]."""
POINTS, STEPS = 4000, 40
"""Points of the unstable manifold that are followed, and for how many impacts."""
PIECES = 6
"""Parts of an edge of a set, and of each of its sides, in a proof of covering."""
MARGIN = 1.15
DIGITS = 12


class Frame(NamedTuple):
    """A parallelogram of states: decimals of its centre and of its columns, both half-sides."""

    centre: tuple[str, str]
    columns: tuple[str, str, str, str]
    """Unstable half-side, then the stable one, each of two phases."""


class Saddle(NamedTuple):
    """The symmetric motion in floating-point numbers: its phase, and both multipliers."""

    phase: float
    unstable: float
    stable: float


class Model(NamedTuple):
    """Floating-point numbers of the shaking."""

    amplitude: float
    ratio: float
    restitution: float

    def row(self, x: Any, y: Any, z: Any) -> tuple[Any, Any, Any, Any]:
        """Return (E3) and its derivatives of arrays of phases."""
        beta = self.amplitude / (1.0 + self.ratio**2)
        loss, ratio = self.restitution, self.ratio
        t0, t1 = (y - x + math.pi) / ratio, (z - y + math.pi) / ratio
        coth0, coth1, q0, q1 = 1 / np.tanh(t0), 1 / np.tanh(t1), 1 / np.sinh(t0), 1 / np.sinh(t1)
        early = (1 - beta * np.sin(x)) * coth0 - (1 + beta * np.sin(y)) * q0
        late = (1 + beta * np.sin(z)) * coth1 - (1 - beta * np.sin(y)) * q1
        both = loss * coth0 + coth1
        mismatch = np.sin(y) * both + loss * np.sin(x) * q0 + np.sin(z) * q1
        mismatch += (1 - loss) * ratio * np.cos(y)
        mismatch -= (np.tanh(t1 / 2) - loss * np.tanh(t0 / 2)) / beta
        at = np.cos(y) * both - (1 - loss) * ratio * np.sin(y)
        at += (loss * early * q0 + late * q1) / (beta * ratio)
        before = loss * (np.cos(x) - early / (beta * ratio)) * q0
        return mismatch, before, at, (np.cos(z) - late / (beta * ratio)) * q1

    def next_phase(self, x: Any, y: Any) -> Any:
        """Return the next impact phase of arrays of states, nan where Newton's method finds none."""
        z = np.array(y, dtype=np.float64)
        step = np.inf
        for _ in range(12):
            mismatch, _, _, after = self.row(x, y, z)
            step = mismatch / after
            z = z - np.clip(step, -0.5, 0.5)
        return np.where((np.abs(step) < 1e-9) & (np.abs(z - y) < 2.5), z, np.nan)

    def slopes(self, x: float, y: float, z: float) -> Floats:
        """Return the derivative of the step from one state to the next, shape (2, 2)."""
        _, before, at, after = self.row(x, y, z)
        return np.array([[0.0, 1.0], [-before / after, -at / after]])


def find_saddle(model: Model) -> Saddle | None:
    """Return the symmetric motion of branch 1, if it is a saddle with a multiplier below -1."""
    states = steady_states(model.amplitude, model.ratio, model.restitution)
    point = states.to_dict()
    solutions = [each for each in point["solutions"] if each["branch"] == 1]
    if not solutions or not solutions[0]["admissible"]:
        return None
    phase = float(solutions[0]["phase"])
    _, before, at, after = model.row(phase, phase, phase)
    trace, product = -at / after, before / after
    root = trace * trace / 4.0 - product
    if root <= 0.0 or trace > -(1.0 + product):
        return None
    unstable = trace / 2.0 - math.sqrt(root)
    return Saddle(phase, unstable, product / unstable)


def homoclinics(model: Model, saddle: Saddle) -> Iterator[Floats]:
    """Yield motions that leave the saddle and come back, shape (impacts,), the shortest first."""
    frame = np.array([[1.0, 1.0], [saddle.unstable, saddle.stable]])
    back = np.linalg.inv(frame)
    found: list[tuple[int, Floats]] = []
    for sign in (1.0, -1.0):
        s = sign * np.geomspace(NEAR, NEAR * saddle.unstable**2, POINTS)
        courses = [saddle.phase + s, saddle.phase + s * saddle.unstable]
        with np.errstate(all="ignore"):
            for _ in range(STEPS):
                courses.append(model.next_phase(courses[-2], courses[-1]))
        course = np.array(courses)
        offset = course - saddle.phase
        along = np.einsum("ij,jkn->ikn", back, np.array([offset[:-1], offset[1:]]))
        away = np.maximum.accumulate(np.abs(along[0]), axis=0) > 0.1
        close = (np.abs(along[0]) < 0.05) & (np.abs(along[1]) < 4.0 * NEAR) & away
        cross = (along[0][:, 1:] * along[0][:, :-1] < 0.0) & close[:, 1:] & close[:, :-1]
        for k, n in np.argwhere(cross).tolist():
            if not cross[:k, n].any():
                found.append((k, course[: k + 2, n]))
    for _, orbit in sorted(found, key=lambda each: each[0])[:12]:
        yield orbit


def polished(model: Model, saddle: Saddle, orbit: Floats) -> Floats | None:
    """Return a homoclinic motion to rounding, with impacts beside the saddle at both ends."""
    pad = 2 + round(math.log(1e-13 / NEAR) / math.log(abs(saddle.stable)))
    before = 2 + round(math.log(1e13 * NEAR) / math.log(abs(saddle.unstable)))
    ends = np.full(before, saddle.phase), np.full(pad, saddle.phase)
    phases = np.concatenate([ends[0], orbit, ends[1]])
    for _ in range(30):
        mismatch, early, at, late = model.row(phases[:-2], phases[1:-1], phases[2:])
        jacobian = np.diag(at) + np.diag(early[1:], -1) + np.diag(late[:-1], 1)
        step = np.linalg.solve(jacobian, mismatch)
        phases[1:-1] -= np.clip(step, -0.2, 0.2)
        if not np.isfinite(phases).all():
            return None
        if np.abs(step).max() < 1e-13:
            break
    offset = np.abs(phases - saddle.phase)
    away = np.flatnonzero(offset > NEAR)
    if np.abs(step).max() > 1e-11 or len(away) == 0:
        return None
    return np.array(phases[max(0, away[0] - 1) : away[-1] + 3])


def frames_along(model: Model, saddle: Saddle, orbit: Floats) -> list[Frame] | None:
    """Return the sets of a chain of coverings: one around the saddle, and one for each impact.

    Sides lie along the unstable direction carried forwards and the stable one carried backwards;
    their sizes grow and shrink along the way by a margin less than the motion would have it.
    """
    count = len(orbit) - 2
    basis = np.array([[1.0, 1.0], [saddle.unstable, saddle.stable]])
    basis /= np.linalg.norm(basis, axis=0)
    first, last = (
        np.linalg.solve(basis, orbit[k : k + 2] - saddle.phase) for k in (0, count)
    )
    slopes = [model.slopes(*orbit[k : k + 3]) for k in range(count)]
    ahead, behind = [basis[:, 0]], [basis[:, 1]]
    for slope in slopes:
        ahead.append(slope @ ahead[-1])
        ahead[-1] /= np.linalg.norm(ahead[-1])
    for slope in slopes[::-1]:
        behind.append(np.linalg.solve(slope, behind[-1]))
        behind[-1] /= np.linalg.norm(behind[-1])
    behind = behind[::-1]
    growth, shrinkage = [], []
    for k, slope in enumerate(slopes):
        image = np.linalg.solve(
            np.column_stack([ahead[k + 1], behind[k + 1]]),
            slope @ np.column_stack([ahead[k], behind[k]]),
        )
        growth.append(abs(image[0, 0]))
        shrinkage.append(abs(image[1, 1]))
    wide, high = 1.6 * abs(first[0]), max(2.2 * abs(last[1]), abs(first[0]))
    needed, allowed = [math.nan] * count, [math.nan] * count
    needed[-1] = wide * MARGIN / growth[-1]
    allowed[-1] = (high / MARGIN - abs(last[1])) / shrinkage[-1]
    for k in range(count - 2, 0, -1):
        needed[k] = needed[k + 1] * MARGIN / growth[k]
        allowed[k] = allowed[k + 1] / (MARGIN * shrinkage[k])
    a = min((wide - abs(first[0])) * growth[0] / MARGIN, max(NEAR, needed[1]))
    b = max(high * MARGIN * shrinkage[0], min(NEAR, allowed[1]))
    found = [_frame(np.full(2, saddle.phase), basis[:, 0] * wide, basis[:, 1] * high)]
    for k in range(1, count):
        if a < needed[k] or b > allowed[k]:
            return None
        found.append(_frame(orbit[k : k + 2], ahead[k] * a, behind[k] * b))
        if k + 1 < count:
            a = min(a * growth[k] / MARGIN, max(NEAR, needed[k + 1]))
            b = max(b * shrinkage[k] * MARGIN, min(NEAR, allowed[k + 1]))
    return found


def _frame(centre: Floats, wide: Floats, high: Floats) -> Frame:
    """Return a parallelogram in decimals."""
    first = tuple(f"{x:.{DIGITS}f}" for x in centre)
    second = tuple(f"{x:.{DIGITS}f}" for x in (*wide, *high))
    return Frame((first[0], first[1]), (second[0], second[1], second[2], second[3]))


class Patch:
    """A parallelogram in balls."""

    def __init__(self, frame: Frame) -> None:
        self.centre = [exact(Fraction(text)) for text in frame.centre]
        a, c, b, d = (exact(Fraction(text)) for text in frame.columns)
        self.columns = ((a, b), (c, d))
        determinant = a * d - b * c
        self.inverse = ((d / determinant, -b / determinant), (-c / determinant, a / determinant))

    def at(self, u: arb, s: arb) -> tuple[arb, arb]:
        """Return the states of coordinates."""
        (x, y), ((a, b), (c, d)) = self.centre, self.columns
        return x + a * u + b * s, y + c * u + d * s

    def coordinates(self, x: arb, y: arb) -> tuple[arb, arb]:
        """Return the coordinates of a difference of states."""
        (a, b), (c, d) = self.inverse
        return a * x + b * y, c * x + d * y


def image(shaking: Shaking, patch: Patch, other: Patch, u: arb, s: arb) -> tuple[arb, arb] | None:
    """Return the coordinates in another patch of what a part of a patch becomes at an impact.

    In the mean value form; None where the next impact phase is not proved to be one.
    """
    u0, s0 = mid(u), mid(s)
    x, y = patch.at(u, s)
    x0, y0 = (mid(part) for part in patch.at(u0, s0))
    z0 = arb(float(other.centre[1].mid()))
    for _ in range(3):
        found = _row(shaking, x0, y0, z0)
        z0 = mid(z0 - found.mismatch / found.after)
    still = _row(shaking, x0, y0, z0).mismatch
    spread = found.before * (x - x0) + found.at * (y - y0)
    z = around(z0, 1.5 * size(spread / found.after) + 1e-15)
    for _ in range(3):
        found = _row(shaking, x, y, z)
        newton = z0 - (still + found.before * (x - x0) + found.at * (y - y0)) / found.after
        if z.contains_interior(newton):
            break
        z = around(z0, 1.5 * size(newton - z0))
    else:
        return None
    (a, b), (c, d) = patch.columns
    e, f = patch.at(u0, s0)
    off = found.before * (e - x0) + found.at * (f - y0)
    start = other.coordinates(f - other.centre[0], z0 - (still + off) / found.after - other.centre[1])
    slope = [-(found.before * p + found.at * q) / found.after for p, q in ((a, c), (b, d))]
    by_u, by_s = other.coordinates(c, slope[0]), other.coordinates(d, slope[1])
    du, ds = u - u0, s - s0
    return start[0] + by_u[0] * du + by_s[0] * ds, start[1] + by_u[1] * du + by_s[1] * ds


def _row(shaking: Shaking, x: arb, y: arb, z: arb) -> Any:
    """Return (E3) of three impact phases."""
    sines = (Phase(*phase.sin_cos()) for phase in (x, y, z))
    flights = (factors(shaking.duration(*ends, 1)) for ends in ((x, y), (y, z)))
    return row(shaking, *sines, *flights)


def covers(shaking: Shaking, patch: Patch, other: Patch) -> bool:
    """Return whether a patch is proved to cover another one at the next impact.

    Its edges u = -1 and u = 1 fall beyond opposite edges of the other, and nothing of it leaves
    the other through the edges s = -1 and s = 1 (Zgliczynski and Gidea 2004).
    """
    parts = [hull(2 * k - PIECES, 2 * k + 2 - PIECES) / PIECES for k in range(PIECES)]
    beyond = []
    for edge in (-1, 1):
        found = [image(shaking, patch, other, arb(edge), s) for s in parts]
        if all(each is not None and each[0] > 1 for each in found):
            beyond.append(1)
        elif all(each is not None and each[0] < -1 for each in found):
            beyond.append(-1)
    if sorted(beyond) != [-1, 1]:
        return False
    for u in parts:
        for s in parts:
            found_part = image(shaking, patch, other, u, s)
            if found_part is None or not (abs(found_part[1]) < 1 or abs(found_part[0]) > 1):
                return False
    return True


def flies(shaking: Shaking, patch: Patch) -> bool:
    """Return whether the last flight of each state of a patch is proved to be a flight."""
    x, y = patch.at(hull(-1, 1), hull(-1, 1))
    duration = shaking.duration(x, y, 1)
    if not duration > 0:
        return False
    ends, flight = [Phase(*phase.sin_cos()) for phase in (x, y)], factors(duration)
    rising = liftoff(shaking, *ends, flight) > 0 and landing(shaking, *ends, flight) > 0
    return bool(rising and stays_above(shaking, Arc(x, y, duration), 30))


def apart(patch: Patch, other: Patch) -> bool:
    """Return whether two patches are proved to have no state in common."""
    whole = hull(-1, 1)
    pairs = zip(patch.at(whole, whole), other.at(whole, whole), strict=True)
    return any(above(p) < below(q) or above(q) < below(p) for p, q in pairs)


def prove_chain(shaking: Shaking, frames: list[Frame]) -> str:
    """Return which part of the proof of a chain of coverings fails; empty where all of it holds."""
    patches = [Patch(frame) for frame in frames]
    count = len(patches)
    if not all(flies(shaking, patch) for patch in patches):
        return "a flight may pass through the floor"
    steps = [(0, 0), *((k, (k + 1) % count) for k in range(count))]
    if not all(covers(shaking, patches[i], patches[j]) for i, j in steps):
        return "a set does not cover the next one"
    for k in range(1, count):
        if all(apart(patches[k], other) for j, other in enumerate(patches) if j != k):
            return ""
    return "no set is apart from all others"


def entropy_of(impacts: int) -> float:
    """Return a lower bound of the entropy per period: words of 1 and of some impacts.

    Their number grows as z^-impacts, with ``z + z^impacts = 1``; a period has two impacts.
    """
    low, high = Fraction(0), Fraction(1)
    for _ in range(30):
        z = (low + high) / 2
        low, high = (low, z) if z + z**impacts >= 1 else (z, high)
    with precision(BITS):
        return math.nextafter(float((-2 * exact(high).log()).lower()), 0.0)


def certify_homoclinic(amplitude: Any, ratio: Any, restitution: Any) -> Certificate:
    """Return the chaos that is proved around a motion homoclinic to the symmetric one."""
    numbers = harmonic_numbers(amplitude, ratio, restitution)
    model = Model(*(float(Fraction(texts[0])) for texts in numbers.values()))
    saddle = find_saddle(model)
    reason = "the symmetric motion of branch 1 is no saddle with a multiplier below -1"
    if saddle is not None:
        reason = "no motion that leaves the symmetric one and comes back was found"
        with precision(BITS):
            shaking = Shaking(*map(ball, numbers.values()))
            for course in homoclinics(model, saddle):
                orbit = polished(model, saddle, course)
                frames = None if orbit is None else frames_along(model, saddle, orbit)
                if frames is None:
                    continue
                reason = prove_chain(shaking, frames)
                if not reason:
                    return _certificate(numbers, frames)
    return Certificate(
        kind="chaos",
        verdict=UNDECIDED,
        claim=f"chaos of flights of one half period: {place(numbers)}",
        model=numbers,
        bits=BITS,
        content={},
        reason=reason,
    )


def _certificate(numbers: Numbers, frames: list[Frame]) -> Certificate:
    """Return the certificate of a chain of coverings."""
    count = len(frames)
    entropy = entropy_of(count)
    shown = f"{math.floor(entropy * 1e4) / 1e4:.4f}"
    return Certificate(
        kind="chaos",
        verdict=PROVED,
        claim=f"every sequence of words of 1 and {count} impacts is a motion: {place(numbers)}",
        model=numbers,
        bits=BITS,
        content={
            "frames": [[*frame.centre, *frame.columns] for frame in frames],
            "claim": {"entropy_per_period": shown},
        },
        facts=(
            Fact("words", [1, count], "sequences", "flights of one half period, near the motion"),
            Fact("coverings", count + 1, "coverings", f"{count + 1} of {count + 1} sets"),
            Fact("entropy", entropy, "entropy", f"at least {shown} per period"),
            Fact("scope", "", "not claimed", "that the attractor is this set"),
        ),
    )
