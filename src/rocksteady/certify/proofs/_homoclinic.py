"""Search of chaos of the rocking itself: sets along a motion homoclinic to the symmetric one.

A state is the pair of the last two impact phases, and (E3) of docs/theory/proofs.md gives the next
one; every flight lasts one half period plus the difference of its phases. All in floating point:
what is found is proved by `rocksteady.certify.proofs.chaos_checker`.
"""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.certify.proofs._flight import Phase, Row, Shaking, factors, row
from rocksteady.dynamics.steady.states import steady_states

NEAR = 1e-3
"""Distance from the symmetric motion at which its homoclinic motion is cut [rad]."""
POINTS, STEPS = 3000, 36
"""Points of the unstable manifold that are followed, and for how many impacts."""
MARGIN = 1.15
"""Factor by which a set grows less, and shrinks less, than the motion would have it."""
DIGITS = 6
"""Decimals of a set, of which the proof takes account."""


class Saddle(NamedTuple):
    """The symmetric motion: its phase, and both multipliers of half a period."""

    phase: float
    unstable: float
    stable: float


class Model(NamedTuple):
    """Amplitude, frequency ratio and restitution."""

    amplitude: float
    ratio: float
    restitution: float

    def row(self, x: Any, y: Any, z: Any) -> Row:
        """Return (E3) and its derivatives of arrays of phases."""
        shaking = Shaking(*self, math.pi)
        spans = shaking.duration(x, y, 1), shaking.duration(y, z, 1)
        first, second = (factors(np.exp(-span)) for span in spans)
        return row(shaking, [Phase(np.sin(v), np.cos(v)) for v in (x, y, z)], first, second)

    def next_phase(self, x: Any, y: Any) -> Any:
        """Return the next impact phases of states, nan where Newton's method finds none."""
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
    sets: list[tuple[int, Floats]] = []
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
                sets.append((k, course[: k + 2, n]))
    for _, orbit in sorted(sets, key=lambda each: each[0])[:12]:
        yield orbit


def polished(model: Model, saddle: Saddle, orbit: Floats) -> Floats | None:
    """Return a homoclinic motion to rounding, with impacts beside the saddle at both ends."""
    pad = 2 + round(math.log(1e-13 / NEAR) / math.log(abs(saddle.stable)))
    before = 2 + round(math.log(1e13 * NEAR) / math.log(abs(saddle.unstable)))
    ends = np.full(before, saddle.phase), np.full(pad, saddle.phase)
    phases = np.concatenate([ends[0], orbit, ends[1]])
    step = np.full(1, np.inf)
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


def frames_along(model: Model, saddle: Saddle, orbit: Floats) -> list[list[str]] | None:
    """Return the sets of a chain of coverings: one around the saddle, and one for each impact.

    Sides lie along the unstable direction carried forwards and the stable one carried backwards;
    their sizes grow and shrink along the way by a margin less than the motion would have it.
    """
    count = len(orbit) - 2
    basis = np.array([[1.0, 1.0], [saddle.unstable, saddle.stable]])
    basis /= np.linalg.norm(basis, axis=0)
    first, last = (np.linalg.solve(basis, orbit[k : k + 2] - saddle.phase) for k in (0, count))
    slopes = [model.slopes(*orbit[k : k + 3]) for k in range(count)]
    ahead, behind = [basis[:, 0]], [basis[:, 1]]
    for slope in slopes:
        ahead.append(slope @ ahead[-1])
        ahead[-1] /= np.linalg.norm(ahead[-1])
    for slope in slopes[::-1]:
        behind.append(np.linalg.solve(slope, behind[-1]))
        behind[-1] /= np.linalg.norm(behind[-1])
    behind.reverse()
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
    sets = [_frame(np.full(2, saddle.phase), basis[:, 0] * wide, basis[:, 1] * high)]
    for k in range(1, count):
        if a < needed[k] or b > allowed[k]:
            return None
        sets.append(_frame(orbit[k : k + 2], ahead[k] * a, behind[k] * b))
        if k + 1 < count:
            a = min(a * growth[k] / MARGIN, max(NEAR, needed[k + 1]))
            b = max(b * shrinkage[k] * MARGIN, min(NEAR, allowed[k + 1]))
    return sets


def _frame(centre: Floats, wide: Floats, high: Floats) -> list[str]:
    """Return the decimals of a parallelogram: centre, unstable and stable half-side."""
    return [f"{x:.{DIGITS}f}" for x in (*centre, *wide, *high)]


def entropy_of(impacts: int) -> float:
    """Return the entropy per period of all sequences of words of 1 and of some impacts.

    Words that add up to L impacts grow in number as z^-L, with ``z + z^impacts = 1``; a period has
    two impacts.
    """
    z = 0.5
    for _ in range(200):
        z -= (z + z**impacts - 1.0) / (1.0 + impacts * z ** (impacts - 1))
    return -2.0 * math.log(z)


def chains(amplitude: float, ratio: float, restitution: float) -> Iterator[dict[str, Any]]:
    """Yield what the certificates of chains of coverings would hold, the shortest first.

    Nothing where the symmetric motion of branch 1 is no saddle with a multiplier below -1.
    """
    model = Model(amplitude, ratio, restitution)
    saddle = find_saddle(model)
    if saddle is None:
        return
    for course in homoclinics(model, saddle):
        orbit = polished(model, saddle, course)
        frames = None if orbit is None else frames_along(model, saddle, orbit)
        if frames is not None:
            shown = f"{math.floor(entropy_of(len(frames)) * 1e4 - 1e-6) / 1e4:.4f}"
            yield {"frames": frames, "claim": {"entropy_per_period": shown}}
