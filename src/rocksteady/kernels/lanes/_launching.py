"""Start of a flight in a lane: interval between nodes to search, rest, or end of run."""

import math

from rocksteady.kernels.core.clock import PI_HIGH
from rocksteady.kernels.core.forcing import HALF_PI, TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.core.typed import FALSE, TRUE
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._both_sides import other
from rocksteady.kernels.lanes._fields import weight, working
from rocksteady.kernels.machine_code.compilation import compiled, inlined
from rocksteady.kernels.march.rest import STILL

WINDOW = 3.0  # times v / (pull (1 - delta)): how long chatter is given to die out


@compiled
def launch(lanes: Floats) -> int:
    """Begin flights from the floor; return the census, `SPECIALS` for `begin_special` in it."""
    count = 0
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        launched = (stage > 0.0) & (stage <= lane.LANDED)
        phase = lanes[lane.PHASE + j]
        frequency = lanes[lane.FREQUENCY + j]
        velocity = lanes[lane.VELOCITY + j]
        sine = lanes[lane.SINE + j]
        rising = lanes[lane.RISING + j]
        time = lanes[lane.TIME + j]
        growing = 0.5 * (
            velocity + lanes[lane.BETA + j] * (sine + frequency * lanes[lane.COSINE + j]) - 1.0
        )
        amplitude, delta = lanes[lane.AMPLITUDE + j], lanes[lane.DELTA + j]
        swing = amplitude * sine
        speed = frequency * velocity
        early = phase < rising
        positive = (velocity == 0.0) | ((not early) & (phase < PI_HIGH - rising))
        start_phase = PI_HIGH - rising if positive else phase
        end_phase = rising if early & (not positive) else rising + TWO_PI
        # Here and on the other side.
        least = min(1.0 - swing, 1.0 + other(lanes, j, lane.AMPLITUDE) * sine)
        # From the bound of the rest with c = c_0, v << c: above it there is no need to ask.
        slow = (max(velocity, speed) < 0.1 * (1.0 - swing)) | (
            (velocity < 0.2 * least)
            & (amplitude * speed * max(delta, STILL) < 1.5 * (1.0 - delta) * least)
        )
        last = lanes[lane.LEFT + j] * PI_HIGH + lanes[lane.STOP + j] < end_phase
        special = launched & (last | (slow & (not positive)))
        guessed = phase + frequency * time
        direct = (guessed > start_phase) & (guessed < end_phase)
        following = lane.POLISH if direct else lane.DOWN
        following = lane.SPECIAL if special else following
        following = following if launched else stage
        lanes[lane.STAGE + j] = following
        lanes[lane.GROWING + j] = growing
        lanes[lane.START_PHASE + j] = start_phase if launched else lanes[lane.START_PHASE + j]
        lanes[lane.END_PHASE + j] = end_phase if launched else lanes[lane.END_PHASE + j]
        lanes[lane.ENDING + j] = 0.0 if launched else lanes[lane.ENDING + j]
        lanes[lane.GUESS + j] = time if launched else lanes[lane.GUESS + j]
        count += weight(following)
    return count


@compiled
def begin_special(lanes: Floats) -> None:
    """Begin flights that may be short, come to rest, or outlast the run."""
    begin_slow(lanes, FALSE)


@compiled
def begin_special_apart(lanes: Floats) -> None:
    """Do what `begin_special` does, where blocks may be unlike or against a wall."""
    begin_slow(lanes, TRUE)


@inlined
def begin_slow(lanes: Floats, two_sided: bool) -> None:
    """Do what both do; inlined once for each."""
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        special = stage == lane.SPECIAL
        phase = lanes[lane.PHASE + j]
        frequency = lanes[lane.FREQUENCY + j]
        velocity = lanes[lane.VELOCITY + j]
        sine = lanes[lane.SINE + j]
        cosine = lanes[lane.COSINE + j]
        delta = lanes[lane.DELTA + j]
        amplitude = lanes[lane.AMPLITUDE + j]
        rising = lanes[lane.RISING + j]
        start_phase = lanes[lane.START_PHASE + j]
        end_phase = lanes[lane.END_PHASE + j]
        left = lanes[lane.LEFT + j] * PI_HIGH + lanes[lane.STOP + j]
        speed = frequency * velocity
        swing = amplitude * sine
        pull = 1.0 - swing
        # The end of the run.
        last = left < end_phase
        cut = left if last else end_phase
        # A short bounce.
        short = (
            (start_phase == phase)
            & (velocity > 0.0)
            & (max(velocity, speed) < 0.1 * pull)
            & (speed < 0.4 * pull * (cut - phase))
        )
        # Chatter.
        least = 1.0 - abs(swing)
        calming = 1.0 - delta
        maybe = (velocity > 0.0) & (velocity < least) & (calming > 0.0) & special
        x = WINDOW * speed / (least * calming if maybe else 1.0)
        later = amplitude * (abs(sine + cosine * x) + x * x * (abs(sine) * 0.5 + x * (1.0 / 6.0)))
        least_later = 1.0 - max(abs(swing), min(later, amplitude))
        root = least_later - velocity
        calm = (
            maybe
            & (root > 0.0)
            & (
                2.0 * least * calming * root
                <= WINDOW * (root * root * calming - (2.0 / 3.0) * delta * amplitude * speed)
            )
            & (phase + x < left)
        )
        for_good = last | (amplitude <= 1.0)
        crosses = phase > HALF_PI
        turned, lifted = (1.0 if crosses else 0.0), lane.LAUNCH
        guess = lanes[lane.TIME + j]
        time = 2.0 * velocity / (pull if short else 1.0) if short else guess
        if two_sided:
            apart = lanes[lane.APART + j] != 0.0
            dies, until, to_other = rests_apart(lanes, j)
            calm = ((dies < left) & special) if apart else calm
            crosses = to_other if apart else crosses
            for_good = (until >= left) if apart else for_good
            whole = 2.0 if phase >= rising else 0.0
            turned = (1.0 if crosses else whole) if apart else turned
            lifted = lane.LIFTED if apart & crosses else lifted
            crosses &= apart
            there = other(lanes, j, lane.RISING)
            rising = there if crosses else rising
            # By a wall most flights are short: r is taken as linear, by the series of the root C
            # of C = 1 + bend C^2.
            bend = time * (velocity + amplitude * frequency * cosine) * (1.0 / 3.0)
            bend /= pull if short else 1.0
            series = 1.0 + bend * (1.0 + bend * (2.0 + bend * (5.0 + bend * 14.0)))
            time = time * series if apart & short else time
        lifting = calm & (not for_good)
        guessed = phase + frequency * guess
        direct = (guessed > start_phase) & (guessed < cut)
        following = lane.POLISH if direct else lane.DOWN
        following = lane.SHORT if short else following
        resting = lane.RESTED if for_good else lifted
        following = resting if calm else following
        lanes[lane.STAGE + j] = following if special else stage
        lanes[lane.END_PHASE + j] = cut if special else end_phase
        lanes[lane.ENDING + j] = 1.0 if special & last else lanes[lane.ENDING + j]
        lanes[lane.TIME + j] = time if special else guess
        lanes[lane.LEFT + j] -= turned if lifting else 0.0
        lanes[lane.PHASE + j] = rising if lifting else phase
        lanes[lane.VELOCITY + j] = 0.0 if lifting else velocity
        node_sine, node_cosine = lanes[lane.NODE_SINE + j], lanes[lane.NODE_COSINE + j]
        if two_sided:
            there_sine = other(lanes, j, lane.NODE_SINE)
            there_cosine = other(lanes, j, lane.NODE_COSINE)
            node_sine = there_sine if crosses else node_sine
            node_cosine = there_cosine if crosses else node_cosine
        lanes[lane.SINE + j] = node_sine if lifting else sine
        lanes[lane.COSINE + j] = node_cosine if lifting else cosine


@inlined
def rests_apart(lanes: Floats, j: int) -> tuple[float, float, bool]:
    """Return when unlike sides, or a wall, have let chatter die out, and what lifts the block next.

    Returns
    -------
    tuple
        Phase by which it has died out, infinite without proof; phase of the uplift after it, and
        whether the other side lifts.
    """
    phase, sine, cosine = lanes[lane.PHASE + j], lanes[lane.SINE + j], lanes[lane.COSINE + j]
    velocity, amplitude = lanes[lane.VELOCITY + j], lanes[lane.AMPLITUDE + j]
    other_velocity = velocity * lanes[lane.ACROSS + j]
    other_amplitude = other(lanes, j, lane.AMPLITUDE)
    speed = lanes[lane.FREQUENCY + j] * velocity
    other_speed = other(lanes, j, lane.FREQUENCY) * other_velocity
    delta = max(lanes[lane.DELTA + j], other(lanes, j, lane.DELTA))
    calming = 1.0 - delta
    pull, other_pull = 1.0 - amplitude * sine, 1.0 + other_amplitude * sine
    maybe = (velocity > 0.0) & (velocity < pull) & (other_velocity < other_pull) & (calming > 0.0)
    here_longer = speed * other_pull >= other_speed * pull
    longer, its_pull = (speed, pull) if here_longer else (other_speed, other_pull)
    x = WINDOW * longer / (its_pull * calming if maybe else 1.0)
    bend = x * x * (abs(sine) * 0.5 + x * (1.0 / 6.0))
    highest = max(sine, min(sine + cosine * x + bend, 1.0))
    lowest = max(-sine, min(bend - sine - cosine * x, 1.0))
    room = 1.0 - amplitude * highest - velocity
    other_room = 1.0 - other_amplitude * lowest - other_velocity
    maybe &= (room > 0.0) & (other_room > 0.0)
    # The longer bounce of either side, with the larger gain of either.
    gain = (2.0 / 3.0) * delta * amplitude * speed
    other_gain = (2.0 / 3.0) * delta * other_amplitude * other_speed
    left_over = x * (calming * (room * room) - gain)
    other_left_over = x * (calming * (other_room * other_room) - other_gain)
    square, other_square = 2.0 * room * room, 2.0 * other_room * other_room
    calm = (
        maybe
        & (speed * square <= left_over * room)
        & (speed * other_square <= other_left_over * room)
        & (other_speed * square <= left_over * other_room)
        & (other_speed * other_square <= other_left_over * other_room)
    )
    here, there = lanes[lane.RISING + j], other(lanes, j, lane.RISING) + PI_HIGH
    again = here + TWO_PI
    here = again if phase >= here else here
    here = here if amplitude > 1.0 else math.inf
    there = there if other_amplitude > 1.0 else math.inf
    dies = phase + x
    return dies if calm else math.inf, min(here, there), there < here
