"""Bound proving that a lossless block with very many impacts does not overturn.

Without loss a block that has only just lifted off bounces for as long as the pulse lasts, millions
of times.  What it can come to is bounded without following it.  With h the base acceleration seen
from its side, in units of alpha g, let::

    H = v^2/2 + integral from 0 to y of (g(z) - h k(z)) dz,

g and k being what gravity and base do to a block at the angle z: 1 - z and 1 in the linear model,
``sin(alpha (1 - z))/alpha`` and ``cos(alpha (1 - z))`` in the nonlinear one.  In flight ``dH/dt =
-h' integral of k``, at most ``|h'| y`` where the acceleration h of that side falls, and not above 0
where it rises; at an impact H is ``v^2/2`` and loses.  While ``0 <= y <= 1``, by the concavity of
the sine::

    H >= v^2/2 + c y - q y^2/2,   c = w - h cos(alpha),   q = w + max(h, 0) alpha sin(alpha),

with ``w = sin(alpha)/alpha``; in the linear model w = q = 1 and c = 1 - h.  So v is bounded by H
and y; y grows by no more than v; and where ``c^2 > 2 q H`` and y has not come past the larger root
of ``c y - q y^2/2 = H``, it is below the smaller one.  Step by step through the rest of the pulse
this gives upper bounds of H and of y on either side, the same for all bounces.  If at its end H is
below the barrier, the block stands.  Bounds of a step are guessed, and taken once they confirm
themselves; those of h and h' are the chords of the step with what a sinusoid may stand out beyond.
Of a block against a wall its one side counts, and y of the other is 0 for ever.
"""

import math

from rocksteady.kernels.batch._still_base import over_the_top
from rocksteady.kernels.core import tables as columns
from rocksteady.kernels.core.clock import elapsed_time, segment_start
from rocksteady.kernels.core.tables import Floats, March, free_side, is_nonlinear
from rocksteady.kernels.elementary.circular import sincos_near
from rocksteady.kernels.machine_code.compilation import allocating, compiled

STEPS = 600
"""In which the rest of the pulse is gone through, at least one a segment."""
GUESSES = 60
"""After which a step's bounds are given up."""
SEED = 1e-300
"""Guess of how far y comes that is too low for whatever moves."""


@compiled
def furthest(angle: float, energy: float, pull: float, bend: float, time: float) -> float:
    """Return an upper bound of y in a step, from those of y at its start and of H in it; or inf.

    `pull` is the least c of the step, `bend` the largest q.
    """
    reached = angle + SEED  # from 0 even a block at rest may lift off
    for _ in range(GUESSES):
        speed = math.sqrt(2.0 * (energy + max(-pull, 0.0) * reached) + bend * reached * reached)
        bound = angle + time * speed
        if bound <= reached:
            break
        if bound >= 1.0:
            return math.inf
        reached = bound * 1.001
    else:
        return math.inf
    room = pull * pull - 2.0 * bend * energy
    if pull > 0.0 and room > 0.0 and reached * bend < pull + math.sqrt(room):
        return min(reached, 2.0 * energy / (pull + math.sqrt(room)))
    return reached


@allocating
def largest_margin(segments: Floats, sides: Floats, state: March) -> float:
    """Return an upper bound, below 0, of the margin of a block that is proved to stand; or inf.

    Parameters
    ----------
    segments
        Table of a pulse, without the still base after it.
    sides
        Of a block, shape (2, 3) or (2, 5); nothing is proved of one whose two sides differ, nor
        while the base has a vertical motion to come: H knows of none.
    state
        Just after an impact, from which on the block is not followed.
    """
    free = free_side(sides)
    if state.angle != 0.0 or (free == 0 and not (sides[0] == sides[1]).all()):
        return math.inf
    if segments.shape[1] > columns.LIFT and segments[state.segment, columns.LIFT_CEILING] != 0.0:
        return math.inf
    row = 1 if free < 0 else 0
    lean, rate = sides[row, columns.LEAN], sides[row, columns.RATE]
    weight, cosine, sine = 1.0, 1.0, 0.0
    if is_nonlinear(sides):
        alpha = sides[row, columns.ALPHA]
        sine, cosine = sincos_near(alpha)
        weight, sine = sine / alpha, alpha * sine
    speed = state.velocity / (lean * rate)
    energy, plus, minus = 0.5 * speed * speed, 0.0, 0.0
    half, phase = segment_start(segments, state.segment)
    since = elapsed_time(
        state.half_cycles, state.phase, half, phase, segments[state.segment, columns.FREQUENCY]
    )
    left = -since
    for index in range(state.segment, len(segments)):
        left += segments[index, columns.DURATION]
    base, climb = math.nan, 0.0  # h and h' at the end of the step before
    for index in range(state.segment, len(segments)):
        if segments[index, columns.JUMP] != 0.0:
            return math.inf
        duration = segments[index, columns.DURATION] - since
        count = max(1, math.ceil(STEPS * duration / left))
        step = duration / count
        size, slope = (
            segments[index, columns.AMPLITUDE] / lean,
            segments[index, columns.SLOPE] / lean,
        )
        frequency, beyond = (
            segments[index, columns.FREQUENCY],
            segments[index, columns.FREQUENCY] * step,
        )
        beyond = size * beyond * beyond / 8.0
        for k in range(count + 1):
            time = since + k * step
            turned = segments[index, columns.PHASE] + frequency * time
            swing, swing_rate = sincos_near(turned)
            h = segments[index, columns.CONSTANT] / lean + slope * time + size * swing
            rise = slope + size * frequency * swing_rate
            if k == 0:
                if not math.isnan(base):  # a step of the base acceleration
                    energy += max((base - h) * plus, (h - base) * minus, 0.0)
                base, climb = h, rise
                continue
            low, high = min(base, h) - beyond, max(base, h) + beyond
            most = max(climb, rise) + beyond * frequency
            least = min(climb, rise) - beyond * frequency
            bend_plus, bend_minus = weight + max(high, 0.0) * sine, weight + max(-low, 0.0) * sine
            bound = energy
            for _ in range(GUESSES):
                up = down = 0.0
                if free >= 0:
                    up = furthest(plus, bound, weight - high * cosine, bend_plus, step * rate)
                if free <= 0:
                    down = furthest(minus, bound, weight + low * cosine, bend_minus, step * rate)
                grown = energy + step * max(-least * up, most * down, 0.0)
                if grown <= bound:
                    break
                if grown >= 0.5:
                    return math.inf
                bound = grown * 1.0001
            else:
                return math.inf
            energy, plus, minus = grown, up, down
            base, climb = h, rise
        since = 0.0
    energy += max(base * plus, -base * minus, 0.0)
    margin = math.sqrt(2.0 * energy) / -over_the_top(sides, row, 0.0) - 1.0
    return margin if margin < 0.0 else math.inf
