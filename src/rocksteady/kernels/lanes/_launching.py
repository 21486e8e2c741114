"""Start of a flight in a lane: interval between nodes to search, rest, or end of run."""

from rocksteady.kernels.core.clock import PI_HIGH
from rocksteady.kernels.core.forcing import HALF_PI, TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._fields import LANES, weight
from rocksteady.kernels.machine_code.compilation import compiled

WINDOW = 3.0  # times v / (pull (1 - delta)): how long chatter is given to die out


@compiled
def launch(lanes: Floats) -> int:
    """Begin flights from the floor; return the census, `SPECIALS` for `begin_special` in it."""
    count = 0
    for j in range(LANES):
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
        swing = lanes[lane.AMPLITUDE + j] * sine
        speed = frequency * velocity
        early = phase < rising
        positive = (velocity == 0.0) | ((not early) & (phase < PI_HIGH - rising))
        start_phase = PI_HIGH - rising if positive else phase
        end_phase = rising if early & (not positive) else rising + TWO_PI
        least = 1.0 - abs(swing)
        slow = (max(velocity, speed) < 0.1 * (1.0 - swing)) | (
            (velocity < 0.2 * least)
            & (lanes[lane.AMPLITUDE + j] * speed < lanes[lane.CALMING + j] * least)
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
    for j in range(LANES):
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
        lifting = calm & (not for_good)
        guess = lanes[lane.TIME + j]
        time = 2.0 * velocity / (pull if short else 1.0) if short else guess
        guessed = phase + frequency * guess
        direct = (guessed > start_phase) & (guessed < cut)
        following = lane.POLISH if direct else lane.DOWN
        following = lane.SHORT if short else following
        resting = lane.RESTED if for_good else lane.LAUNCH
        following = resting if calm else following
        lanes[lane.STAGE + j] = following if special else stage
        lanes[lane.END_PHASE + j] = cut if special else end_phase
        lanes[lane.ENDING + j] = 1.0 if special & last else lanes[lane.ENDING + j]
        lanes[lane.TIME + j] = time if special else guess
        lanes[lane.LEFT + j] -= 1.0 if lifting & (phase > HALF_PI) else 0.0
        lanes[lane.PHASE + j] = rising if lifting else phase
        lanes[lane.VELOCITY + j] = 0.0 if lifting else velocity
        lanes[lane.SINE + j] = lanes[lane.NODE_SINE + j] if lifting else sine
        lanes[lane.COSINE + j] = lanes[lane.NODE_COSINE + j] if lifting else cosine
