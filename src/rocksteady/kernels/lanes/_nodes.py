"""State of lanes at a node: whether a zero lies before it, or none can follow."""

from rocksteady.kernels.core.clock import PI_HIGH
from rocksteady.kernels.core.forcing import TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.lanes._exp_sincos import growth_and_decay, nearest_whole
from rocksteady.kernels.lanes._fields import (
    AHEAD,
    ANGLE_THERE,
    BETA,
    COSINE,
    DECAY_AHEAD,
    DOWN,
    END_PHASE,
    ENDED,
    ENDING,
    EXCESS,
    FALLEN,
    FARTHEST,
    FREQUENCY,
    GROWING,
    GROWN,
    GROWTH_AHEAD,
    GUESS,
    INVERSE,
    KNOWN,
    LANES,
    LEAVE,
    LEFT,
    LOSS,
    NEXT_ANGLE,
    NEXT_DOUBT,
    NEXT_VELOCITY,
    NODE_COSINE,
    NODE_SINE,
    OUTCOME,
    PHASE,
    POLISH,
    REACHED,
    SINE,
    SIZE,
    STAGE,
    START_ANGLE,
    START_PHASE,
    START_VELOCITY,
    STOP,
    STOP_COSINE,
    STOP_SINE,
    TIME,
    UNKNOWN,
    UP,
    VELOCITY,
    VELOCITY_THERE,
    weight,
)
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


@compiled
def node_state(lanes: Floats) -> None:
    """Find the state at the end of a piece and the doubt about it."""
    for j in range(LANES):
        frequency = lanes[FREQUENCY + j]
        inverse = lanes[INVERSE + j]
        time = (lanes[END_PHASE + j] - lanes[PHASE + j]) * inverse
        beta = lanes[BETA + j]
        sine = lanes[SINE + j]
        growing = lanes[GROWING + j]
        velocity = lanes[VELOCITY + j]
        far = time > FARTHEST
        grown, decayed = growth_and_decay(FARTHEST if far else time)
        up = growing * grown
        down = ((beta * sine - 1.0) - growing) * decayed
        # At the end of the run the phase is LEFT pi + STOP.
        left = lanes[LEFT + j]
        even = 1.0 - 2.0 * abs(left - 2.0 * nearest_whole(0.5 * left))
        ending = lanes[ENDING + j] > 0.0
        node_cosine = lanes[NODE_COSINE + j]
        end_cosine = -node_cosine if lanes[STAGE + j] == UP else node_cosine
        end_cosine = even * lanes[STOP_COSINE + j] if ending else end_cosine
        end_sine = even * lanes[STOP_SINE + j] if ending else lanes[NODE_SINE + j]
        lanes[REACHED + j] = time
        lanes[GROWN + j] = growing + up
        lanes[ANGLE_THERE + j] = up - down + beta * (sine - end_sine)
        lanes[VELOCITY_THERE + j] = (
            velocity + up + down + beta * frequency * (lanes[COSINE + j] - end_cosine)
        )
        rounding = LOSS * (velocity + lanes[SIZE + j]) * (1.0 + time + inverse)
        lanes[OUTCOME + j] = UNKNOWN if far else rounding * (4.0 + grown)
        # At the node after a rising one e^t has grown by a constant.
        more, less = lanes[GROWTH_AHEAD + j], lanes[DECAY_AHEAD + j]
        grown += more * (1.0 + grown)
        decayed += less * (1.0 - decayed)
        up = growing * grown
        down = ((beta * sine - 1.0) - growing) * decayed
        lanes[NEXT_ANGLE + j] = up - down + beta * (sine - lanes[NODE_SINE + j])
        lanes[NEXT_VELOCITY + j] = (
            velocity + up + down + beta * frequency * (lanes[COSINE + j] + node_cosine)
        )
        wait = lanes[AHEAD + j] * inverse
        lanes[NEXT_DOUBT + j] = (
            UNKNOWN if wait > FARTHEST else rounding * (4.0 + grown) * (1.0 + wait)
        )


@compiled
def node_decision(lanes: Floats) -> int:
    """Decide from the states at both ends of a piece whether a zero lies in it; count again."""
    count = 0
    for j in range(LANES):
        stage = lanes[STAGE + j]
        positive = stage == UP
        active = positive | (stage == DOWN)
        frequency = lanes[FREQUENCY + j]
        phase = lanes[PHASE + j]
        end_phase = lanes[END_PHASE + j]
        start_phase = lanes[START_PHASE + j]
        start_angle = lanes[START_ANGLE + j]
        start_velocity = lanes[START_VELOCITY + j]
        y = lanes[ANGLE_THERE + j]
        v = lanes[VELOCITY_THERE + j]
        doubt = lanes[OUTCOME + j]
        width = (end_phase - start_phase) * lanes[INVERSE + j]
        passes = passes_over(start_angle, start_velocity, y, v, width, doubt)
        none = (y > doubt) & ((not positive) | passes)
        found = (y < -doubt) & ((not positive) | (start_angle + start_velocity <= 2.0 * doubt))
        growing = lanes[GROWING + j]
        lost = (growing > LOSS * (lanes[VELOCITY + j] + lanes[SIZE + j])) & (
            2.0 * lanes[GROWN + j] >= lanes[EXCESS + j]
        )
        # Newton from the right on a concave F, from the left on a convex one.
        near_y = start_angle if positive else y
        near_v = start_velocity if positive else v
        near_t = (start_phase - phase) * lanes[INVERSE + j] if positive else lanes[REACHED + j]
        falls = near_v < 0.0
        newton = near_t - near_y / (near_v if falls else -1.0)
        guess = lanes[GUESS + j]
        # The next piece, or the one after that where the next has r > 0 and no zero.
        ahead = lanes[AHEAD + j]
        left = lanes[LEFT + j] * PI_HIGH + lanes[STOP + j]
        next_angle, next_velocity = lanes[NEXT_ANGLE + j], lanes[NEXT_VELOCITY + j]
        next_doubt = lanes[NEXT_DOUBT + j]
        beyond = (
            (not positive)
            & (left > end_phase + ahead)
            & (next_angle > next_doubt)
            & passes_over(y, v, next_angle, next_velocity, ahead * lanes[INVERSE + j], next_doubt)
        )
        falling = positive | beyond
        begin_phase = end_phase + ahead if beyond else end_phase
        later_phase = begin_phase + (TWO_PI - ahead if falling else ahead)
        last = left < later_phase
        later_phase = left if last else later_phase
        guessed = phase + frequency * guess
        direct = falling & (guessed > begin_phase) & (guessed < later_phase)
        onward = DOWN if falling else UP
        onward = POLISH if direct else onward
        onward = ENDED if lanes[ENDING + j] > 0.0 else onward
        onward = FALLEN if lost else onward
        near = phase + frequency * newton
        inside = found & (near > start_phase) & (near < end_phase) & falls
        decided = KNOWN if inside else LEAVE
        decided = onward if none else decided
        following = decided if active else stage
        lanes[STAGE + j] = following
        moves = active & none
        lanes[START_PHASE + j] = begin_phase if moves else start_phase
        lanes[START_ANGLE + j] = y if moves else start_angle
        lanes[START_VELOCITY + j] = v if moves else start_velocity
        lanes[END_PHASE + j] = later_phase if moves else end_phase
        lanes[ENDING + j] = 1.0 if moves & last else lanes[ENDING + j]
        time = guess if moves else lanes[TIME + j]
        lanes[TIME + j] = newton if active & inside else time
        count += weight(following)
    return count
