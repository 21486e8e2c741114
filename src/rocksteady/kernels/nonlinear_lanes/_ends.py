"""Ends of all lanes' steps: the zero of a polynomial, and the flight or impact that follows."""

from rocksteady.kernels.core.clock import PI_HIGH, PI_LOW
from rocksteady.kernels.core.forcing import HALF_PI, TWO_PI
from rocksteady.kernels.core.returns import LEAPT
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import ROUND
from rocksteady.kernels.elementary.circular import sincos_short
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.march.rest import STILL
from rocksteady.kernels.nonlinear_lanes import _layout as lane
from rocksteady.kernels.nonlinear_lanes._layout import HIGHEST, LANES, OFFSETS
from rocksteady.kernels.nonlinear_lanes._signs import approach
from rocksteady.kernels.nonlinear_lanes._steps import LONGEST
from rocksteady.kernels.nonlinear_lanes._two_sides import other

CLOSE = 1e-12
"""Newton's step, over the place, after which the next would be below rounding."""
ITERATIONS = 12
MOST_HALVINGS = 5.0
"""Of a step, after which the march is to decide."""
NO_LIMIT = 1e300


@compiled
def find_places(lanes: Floats) -> None:
    """Find the one zero of each polynomial that has one, and the state there or at the end."""
    approach(lanes)
    for k in range(LANES):
        single = lanes[lane.CHANGES + k] == 1.0
        stage = lanes[lane.STAGE + k]
        lanes[lane.LOW + k] = 0.0
        lanes[lane.HIGH + k] = 1.0
        lanes[lane.OPEN + k] = 1.0 if single & (stage > 0.0) & (stage <= lane.LANDED) else 0.0
    for _ in range(ITERATIONS):
        all_terms_there(lanes)
        if improve(lanes) == 0:
            break


@compiled
def all_terms_there(lanes: Floats) -> None:
    """Find y and its derivative by the part of the step at `PLACE`."""
    for k in range(LANES):
        lanes[lane.VALUE + k] = lanes[lane.TAYLOR + HIGHEST * LANES + k]
        lanes[lane.SLOPE + k] = 0.0
    for n in range(HIGHEST - 4, 0, -4):
        here = (n * LANES) & OFFSETS
        for k in range(LANES):
            x = lanes[lane.PLACE + k]
            value, slope = lanes[lane.VALUE + k], lanes[lane.SLOPE + k]
            slope = slope * x + value
            value = value * x + lanes[lane.TAYLOR + here + 3 * LANES + k]
            slope = slope * x + value
            value = value * x + lanes[lane.TAYLOR + here + 2 * LANES + k]
            slope = slope * x + value
            value = value * x + lanes[lane.TAYLOR + here + LANES + k]
            slope = slope * x + value
            value = value * x + lanes[lane.TAYLOR + here + k]
            lanes[lane.VALUE + k], lanes[lane.SLOPE + k] = value, slope
    for k in range(LANES):
        x = lanes[lane.PLACE + k]
        value, slope = lanes[lane.VALUE + k], lanes[lane.SLOPE + k]
        slope = slope * x + value
        value = value * x + lanes[lane.TAYLOR + 2 * LANES + k]
        slope = slope * x + value
        value = value * x + lanes[lane.TAYLOR + LANES + k]
        slope = slope * x + value
        value = value * x + lanes[lane.TAYLOR + k]
        lanes[lane.VALUE + k], lanes[lane.SLOPE + k] = value, slope


@inlined
def improve(lanes: Floats) -> int:
    """Take Newton's step in lanes that have not arrived; return how many have not."""
    count = 0
    for k in range(LANES):
        x = lanes[lane.PLACE + k]
        value, slope = lanes[lane.VALUE + k], lanes[lane.SLOPE + k]
        searching = lanes[lane.OPEN + k] > 0.0
        old_low, old_high = lanes[lane.LOW + k], lanes[lane.HIGH + k]
        low = x if value > 0.0 else old_low
        high = old_high if value > 0.0 else x
        step = value / slope
        near = x - step
        arrived = searching & (abs(step) <= CLOSE * x)
        inside = (near > low) & (near < high)
        near = near if inside else 0.5 * (low + high)
        # What is left moves the velocity by less than its rounding.
        low = x - step if arrived else low
        lanes[lane.LOW + k] = low if searching else old_low
        lanes[lane.HIGH + k] = high if searching else old_high
        onwards = searching & (not arrived)
        lanes[lane.PLACE + k] = near if onwards else x
        lanes[lane.OPEN + k] = 1.0 if onwards else 0.0
        count += 1 if onwards else 0
    return count


@compiled
def finish(lanes: Floats, most: int) -> int:
    """Move all lanes to the end of their steps; return how many wait for what loops do not do."""
    count = 0
    for k in range(LANES):
        stage = lanes[lane.STAGE + k]
        flies = (stage > 0.0) & (stage <= lane.LANDED)
        changes = lanes[lane.CHANGES + k]
        step = lanes[lane.STEP + k]
        old, frequency = lanes[lane.PHASE + k], lanes[lane.FREQUENCY + k]
        old_angle, old_speed = lanes[lane.ANGLE + k], lanes[lane.SPEED + k]
        start_angle, start_velocity = lanes[lane.START_ANGLE + k], lanes[lane.VELOCITY + k]
        halvings = lanes[lane.HALVINGS + k]
        root, place = lanes[lane.LOW + k], lanes[lane.PLACE + k]
        start, delta = lanes[lane.TIME + k], lanes[lane.DELTA + k]
        settled = (
            flies & (lanes[lane.OPEN + k] == 0.0) & (lanes[lane.TOTAL + k] < lanes[lane.FLAT + k])
        )
        passes = settled & (changes == 0.0)
        # No other zero is near.
        fall = lanes[lane.SLOPE + k]
        far = min(root, -fall / lanes[lane.CURVING + k])
        beyond = min(root + far, 1.0)
        square = beyond * beyond
        fourth = square * square
        doubt = lanes[lane.REST + k] * (fourth * fourth * square)
        lands = settled & (changes == 1.0) & (-fall * far > 4.0 * doubt)
        halves = flies & (not passes) & (not lands)
        place = root if lands else place
        time = start + place * step
        slope = fall / step
        # Onwards in the air.
        angle, speed = lanes[lane.VALUE + k], slope
        ended = passes & (lanes[lane.REMAINING + k] <= step)
        lost = passes & (angle > lanes[lane.LOST + k]) & (speed >= 0.0)
        # The march sees a loss at the ends of its own steps, none of which is longer than LONGEST.
        left = lanes[lane.REMAINING + k] - step
        unseen = lost & (left < LONGEST)
        fallen = lost & (not unseen)
        sunk = passes & (not (angle > 0.0))
        stuck = passes & (time == start) & (not ended)
        # An impact.
        rebound = -delta * min(slope, 0.0)
        velocity = rebound * lanes[lane.ACROSS + k]
        phase = old + frequency * time
        turns = (phase - HALF_PI) * (1.0 / TWO_PI) - 0.5
        half_cycles = 2.0 * ((turns + ROUND) - ROUND) + 1.0
        phase = (phase - half_cycles * PI_HIGH) - half_cycles * PI_LOW
        sine, _ = sincos_short(phase)
        # What holds the block down, on the side that it has left and on that which it is on now.
        calming = lanes[lane.CALMING + k]
        behind = lanes[lane.FOOT_SINE + k] + lanes[lane.FOOT_SWING + k] * sine
        pull = other(lanes, k, lane.FOOT_SINE) - other(lanes, k, lane.FOOT_SWING) * sine
        calm_behind = (rebound < behind) & (
            lanes[lane.DRIFT + k] * rebound <= calming * (behind * behind)
        )
        calm = (velocity < pull) & (
            other(lanes, k, lane.DRIFT) * velocity <= calming * (pull * pull)
        )
        slow = lands & ((velocity < STILL) | (calm_behind & calm))
        impacts = lanes[lane.IMPACTS + k] + (1.0 if lands else 0.0)
        exhausted = flies & (impacts > most) & (lanes[lane.LAG + k] != LEAPT)
        halvings = halvings + 1.0 if halves else 0.0
        left_open = halvings > MOST_HALVINGS
        following = lane.LANDED if lands else lane.FLYING
        following = lane.SLOW if slow else following
        following = lane.ENDED if ended else following
        following = lane.FALLEN if fallen else following
        following = lane.LEAVE if sunk | left_open | unseen | stuck else following
        following = lane.GIVEN_UP if exhausted else following
        following = following if flies else stage
        side = lanes[lane.SIDE + k]
        lanes[lane.SIDE + k] = -side if lands else side
        lanes[lane.STAGE + k] = following
        lanes[lane.LIMIT + k] = 0.5 * step if halves else NO_LIMIT
        lanes[lane.HALVINGS + k] = halvings
        lanes[lane.IMPACTS + k] = impacts
        lanes[lane.PHASE + k] = phase if lands else old
        lanes[lane.LEFT + k] -= half_cycles if lands else 0.0
        lanes[lane.START_ANGLE + k] = 0.0 if lands else start_angle
        lanes[lane.VELOCITY + k] = velocity if lands else start_velocity
        on = time if passes else start
        lanes[lane.TIME + k] = 0.0 if lands else on
        high = angle if passes else old_angle
        lanes[lane.ANGLE + k] = 0.0 if lands else high
        fast = speed if passes else old_speed
        lanes[lane.SPEED + k] = velocity if lands else fast
        count += 1 if (following > lane.LANDED) | (following == 0.0) else 0
    return count
