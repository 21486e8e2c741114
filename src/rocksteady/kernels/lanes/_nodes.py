"""State of lanes at a node: whether a zero lies before it, or none can follow.

A hump is decided by its end.  A bound without e^t at the launch was tried, and saved nothing.
"""

from rocksteady.kernels.core.clock import PI_HIGH
from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import nearest_whole
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._exp_sincos import growth_and_decay
from rocksteady.kernels.lanes._fields import FARTHEST, LOSS, UNKNOWN, weight, working
from rocksteady.kernels.machine_code.compilation import compiled, inlined


@inlined
def passes_over(
    angle: float,
    velocity: float,
    end_angle: float,
    end_velocity: float,
    width: float,
    doubt: float,
) -> bool:
    """Return whether there is surely no zero in a piece with r > 0 that ends above the floor."""
    upward = angle + velocity > 2.0 * doubt
    steep = abs(velocity) + abs(end_velocity)
    room = 2.0 * doubt * (steep * (1.0 + width) + abs(angle) + abs(end_angle))
    meet = velocity * end_angle - end_velocity * angle - velocity * end_velocity * width
    return upward | (end_velocity < -doubt) | (meet < -room)


@inlined
def size_of(beta: float, frequency: float) -> float:
    """Return the size of the terms of an angle, of which the velocity at the start is another."""
    return 1.0 + beta * (1.0 + frequency)


@inlined
def positive_length(lanes: Floats, j: int) -> float:
    """Return the phase from a rising node to the falling one after it."""
    length: float = PI_HIGH - 2.0 * lanes[lane.RISING + j]
    return length


@compiled
def node_state(lanes: Floats) -> None:
    """Find the state at the end of a piece and the doubt about it."""
    for j in range(working(lanes)):
        frequency = lanes[lane.FREQUENCY + j]
        inverse = lanes[lane.INVERSE + j]
        time = (lanes[lane.END_PHASE + j] - lanes[lane.PHASE + j]) * inverse
        beta = lanes[lane.BETA + j]
        sine = lanes[lane.SINE + j]
        growing = lanes[lane.GROWING + j]
        velocity = lanes[lane.VELOCITY + j]
        far = time > FARTHEST
        grown, decayed = growth_and_decay(FARTHEST if far else time)
        up = growing * grown
        down = ((beta * sine - 1.0) - growing) * decayed
        # At the end of the run the phase is LEFT pi + STOP.
        left = lanes[lane.LEFT + j]
        even = 1.0 - 2.0 * abs(left - 2.0 * nearest_whole(0.5 * left))
        ending = lanes[lane.ENDING + j] > 0.0
        node_cosine = lanes[lane.NODE_COSINE + j]
        end_cosine = -node_cosine if lanes[lane.STAGE + j] == lane.UP else node_cosine
        end_cosine = even * lanes[lane.STOP_COSINE + j] if ending else end_cosine
        end_sine = even * lanes[lane.STOP_SINE + j] if ending else lanes[lane.NODE_SINE + j]
        lanes[lane.REACHED + j] = time
        lanes[lane.GROWN + j] = growing + up
        lanes[lane.ANGLE_THERE + j] = up - down + beta * (sine - end_sine)
        lanes[lane.VELOCITY_THERE + j] = (
            velocity + up + down + beta * frequency * (lanes[lane.COSINE + j] - end_cosine)
        )
        rounding = LOSS * (velocity + size_of(beta, frequency)) * (1.0 + time + inverse)
        lanes[lane.OUTCOME + j] = UNKNOWN if far else rounding * (4.0 + grown)
        # At the node after a rising one e^t has grown by a constant.
        more, less = lanes[lane.GROWTH_AHEAD + j], lanes[lane.DECAY_AHEAD + j]
        grown += more * (1.0 + grown)
        decayed += less * (1.0 - decayed)
        up = growing * grown
        down = ((beta * sine - 1.0) - growing) * decayed
        lanes[lane.NEXT_ANGLE + j] = up - down + beta * (sine - lanes[lane.NODE_SINE + j])
        lanes[lane.NEXT_VELOCITY + j] = (
            velocity + up + down + beta * frequency * (lanes[lane.COSINE + j] + node_cosine)
        )
        wait = positive_length(lanes, j) * inverse
        lanes[lane.NEXT_DOUBT + j] = (
            UNKNOWN if wait > FARTHEST else rounding * (4.0 + grown) * (1.0 + wait)
        )


@compiled
def node_decision(lanes: Floats) -> int:
    """Decide from the states at both ends of a piece whether a zero lies in it; count again."""
    count = 0
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        positive = stage == lane.UP
        active = positive | (stage == lane.DOWN)
        frequency = lanes[lane.FREQUENCY + j]
        phase = lanes[lane.PHASE + j]
        end_phase = lanes[lane.END_PHASE + j]
        start_phase = lanes[lane.START_PHASE + j]
        start_angle = lanes[lane.START_ANGLE + j]
        start_velocity = lanes[lane.START_VELOCITY + j]
        y = lanes[lane.ANGLE_THERE + j]
        v = lanes[lane.VELOCITY_THERE + j]
        doubt = lanes[lane.OUTCOME + j]
        width = (end_phase - start_phase) * lanes[lane.INVERSE + j]
        passes = passes_over(start_angle, start_velocity, y, v, width, doubt)
        none = (y > doubt) & ((not positive) | passes)
        found = (y < -doubt) & ((not positive) | (start_angle + start_velocity <= 2.0 * doubt))
        growing = lanes[lane.GROWING + j]
        size = size_of(lanes[lane.BETA + j], frequency)
        lost = (growing > LOSS * (lanes[lane.VELOCITY + j] + size)) & (
            2.0 * lanes[lane.GROWN + j] >= lanes[lane.EXCESS + j]
        )
        # Newton from the right on a concave F, from the left on a convex one.
        near_y = start_angle if positive else y
        near_v = start_velocity if positive else v
        near_t = (
            (start_phase - phase) * lanes[lane.INVERSE + j] if positive else lanes[lane.REACHED + j]
        )
        falls = near_v < 0.0
        newton = near_t - near_y / (near_v if falls else -1.0)
        guess = lanes[lane.GUESS + j]
        # The next piece, or the one after that where the next has r > 0 and no zero.
        ahead = positive_length(lanes, j)
        left = lanes[lane.LEFT + j] * PI_HIGH + lanes[lane.STOP + j]
        next_angle, next_velocity = lanes[lane.NEXT_ANGLE + j], lanes[lane.NEXT_VELOCITY + j]
        next_doubt = lanes[lane.NEXT_DOUBT + j]
        beyond = (
            (not positive)
            & (left > end_phase + ahead)
            & (next_angle > next_doubt)
            & passes_over(
                y, v, next_angle, next_velocity, ahead * lanes[lane.INVERSE + j], next_doubt
            )
        )
        falling = positive | beyond
        begin_phase = end_phase + ahead if beyond else end_phase
        later_phase = begin_phase + (TWO_PI - ahead if falling else ahead)
        last = left < later_phase
        later_phase = left if last else later_phase
        guessed = phase + frequency * guess
        direct = falling & (guessed > begin_phase) & (guessed < later_phase)
        onward = lane.DOWN if falling else lane.UP
        onward = lane.POLISH if direct else onward
        onward = lane.ENDED if lanes[lane.ENDING + j] > 0.0 else onward
        onward = lane.FALLEN if lost else onward
        near = phase + frequency * newton
        inside = found & (near > start_phase) & (near < end_phase) & falls
        decided = lane.KNOWN if inside else lane.LEAVE
        decided = onward if none else decided
        following = decided if active else stage
        lanes[lane.STAGE + j] = following
        moves = active & none
        lanes[lane.START_PHASE + j] = begin_phase if moves else start_phase
        lanes[lane.START_ANGLE + j] = y if moves else start_angle
        lanes[lane.START_VELOCITY + j] = v if moves else start_velocity
        lanes[lane.END_PHASE + j] = later_phase if moves else end_phase
        lanes[lane.ENDING + j] = 1.0 if moves & last else lanes[lane.ENDING + j]
        time = guess if moves else lanes[lane.TIME + j]
        lanes[lane.TIME + j] = newton if active & inside else time
        count += weight(following)
    return count
