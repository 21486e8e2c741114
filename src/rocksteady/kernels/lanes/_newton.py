"""Newton steps of lanes towards an impact, and the stage that follows each step."""

from rocksteady.kernels.core.clock import PI_HIGH, PI_LOW
from rocksteady.kernels.core.forcing import HALF_PI, TWO_PI
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.elementary.bits import nearest_whole
from rocksteady.kernels.elementary.circular import sincos_short
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._exp_sincos import growth_and_decay, turned_by
from rocksteady.kernels.lanes._fields import LAST_STEPS, working
from rocksteady.kernels.linear.zeros import reversion
from rocksteady.kernels.machine_code.compilation import compiled

SHORTEST = 0.25  # below it, in t and Omega t, cancellation asks for Taylor's polynomial ...
LONGEST = 0.3  # ... which serves up to here: 2e-17 of its largest term is left out


@compiled
def shake(lanes: Floats) -> None:
    """Find sine and cosine at `TIME`."""
    for j in range(working(lanes)):
        sine, cosine = sincos_short(
            lanes[lane.PHASE + j] + lanes[lane.FREQUENCY + j] * lanes[lane.TIME + j]
        )
        lanes[lane.SINE_THERE + j] = sine
        lanes[lane.COSINE_THERE + j] = cosine


@compiled
def fly(lanes: Floats) -> None:
    """Find angle and velocity at `TIME` by the closed form."""
    for j in range(working(lanes)):
        grown, decayed = growth_and_decay(lanes[lane.TIME + j])
        beta = lanes[lane.BETA + j]
        sine = lanes[lane.SINE + j]
        growing = lanes[lane.GROWING + j]
        up = growing * grown
        down = ((beta * sine - 1.0) - growing) * decayed
        lanes[lane.ANGLE_THERE + j] = up - down + beta * (sine - lanes[lane.SINE_THERE + j])
        lanes[lane.VELOCITY_THERE + j] = (
            lanes[lane.VELOCITY + j]
            + up
            + down
            + beta
            * lanes[lane.FREQUENCY + j]
            * (lanes[lane.COSINE + j] - lanes[lane.COSINE_THERE + j])
        )


@compiled
def bounce(lanes: Floats) -> None:
    """Find them by Taylor's polynomial, in the lanes at `SHORT`."""
    for j in range(working(lanes)):
        short = lanes[lane.STAGE + j] >= lane.SHORT
        time = lanes[lane.TIME + j] if short else 0.0
        w, amplitude = lanes[lane.FREQUENCY + j], lanes[lane.AMPLITUDE + j]
        velocity = lanes[lane.VELOCITY + j]
        swing_even = amplitude * lanes[lane.SINE + j]
        swing_odd = (amplitude * w) * lanes[lane.COSINE + j]
        w2 = -w * w
        even = swing_even - 1.0
        odd = velocity + swing_odd
        half = 0.5 * time
        third = time * time * (1.0 / 6.0)
        rise = even * half + odd * third
        speed = even * time + odd * half * time
        for n in range(4, 14, 2):
            swing_even *= w2
            swing_odd *= w2
            even += swing_even
            odd += swing_odd
            half = third * (time * (1.0 / n))
            third = half * (time * (1.0 / (n + 1)))
            rise += even * half + odd * third
            speed += even * half * n + odd * third * (n + 1)
        y, v = lanes[lane.ANGLE_THERE + j], lanes[lane.VELOCITY_THERE + j]
        lanes[lane.ANGLE_THERE + j] = time * (velocity + rise) if short else y
        lanes[lane.VELOCITY_THERE + j] = velocity + speed if short else v


@compiled
def approach(lanes: Floats) -> None:
    """Step towards the zero as `rocksteady.kernels.linear.zeros.series_step` does.

    `OUTCOME` receives 2 where the step has landed on it, 1 where it has not, 0 where F does not
    fall.
    """
    for j in range(working(lanes)):
        frequency, amplitude = lanes[lane.FREQUENCY + j], lanes[lane.AMPLITUDE + j]
        v = lanes[lane.VELOCITY_THERE + j]
        falls = v < 0.0
        v = v if falls else -1.0
        y = lanes[lane.ANGLE_THERE + j]
        swing = amplitude * lanes[lane.SINE_THERE + j]
        swing_rate = (amplitude * frequency) * lanes[lane.COSINE_THERE + j]
        w2 = frequency * frequency
        d2 = y - 1.0 + swing
        d3 = v + swing_rate
        d4 = d2 - w2 * swing
        d5 = d3 - w2 * swing_rate
        inverse = 1.0 / v
        z = -y * inverse
        # a_n = y^(n) z^(n-1) / (n! y')
        ratio = (z * inverse) * (1.0 / 2.0)
        a2 = d2 * ratio
        ratio *= z
        d3 *= 1.0 / 3.0
        a3 = d3 * ratio
        ratio *= z
        d4 *= 1.0 / 12.0
        a4 = d4 * ratio
        ratio *= z
        d5 *= 1.0 / 60.0
        a5 = d5 * ratio
        newton = (abs(a2) > 0.2) | (abs(a3) > 0.04)
        step = z if newton else z * reversion(a2, a3, a4, a5)
        final = (
            (abs(frequency * z) < 0.03)
            & (abs(a2) < 1e-3)
            & (abs(a3) < 1e-6)
            & (abs(a4) < 1e-9)
            & (abs(a5) < 1e-12)
        )
        half = 0.5 * step
        lanes[lane.STEP + j] = step
        lanes[lane.REACHED + j] = lanes[lane.TIME + j] + step
        lanes[lane.VELOCITY_THERE + j] = v + step * (
            d2 + half * (3.0 * d3 + step * (4.0 * d4 + step * (5.0 * d5)))
        )
        lanes[lane.OUTCOME + j] = (2.0 if final else 1.0) if falls else 0.0


@compiled
def land(lanes: Floats, below: float) -> None:
    """Judge the step of lanes at stages below one: an impact, another step, or another way."""
    for j in range(working(lanes)):
        stage = lanes[lane.STAGE + j]
        active = (stage >= lane.POLISH) & (stage < below)
        old = lanes[lane.PHASE + j]
        frequency = lanes[lane.FREQUENCY + j]
        reached = lanes[lane.REACHED + j]
        outcome = lanes[lane.OUTCOME + j]
        turned = frequency * reached
        phase = old + turned
        inside = (
            (outcome > 0.0)
            & (reached > 0.0)
            & (phase > lanes[lane.START_PHASE + j])
            & (phase < lanes[lane.END_PHASE + j])
        )
        brief = max(reached, turned)
        short = stage >= lane.SHORT
        tiny = (brief < SHORTEST) & (not short) & inside
        right = inside & (not tiny) & ((brief < LONGEST) | (not short))
        landed = active & right & (outcome > 1.0)
        more = (stage != LAST_STEPS[0]) & (stage != LAST_STEPS[1]) & (stage != LAST_STEPS[2])
        failed = lane.DOWN if stage < lane.KNOWN else lane.LEAVE
        failed = lane.SHORT if tiny & (lanes[lane.START_PHASE + j] == old) else failed
        onward = stage + 1.0 if right & more else failed
        onward = lane.LANDED if landed else onward
        lanes[lane.STAGE + j] = onward if active else stage
        turns = (phase - HALF_PI) * (1.0 / TWO_PI) - 0.5
        halves = 2.0 * nearest_whole(turns) + 1.0
        phase = (phase - halves * PI_HIGH) - halves * PI_LOW
        lanes[lane.PHASE + j] = phase if landed else old
        lanes[lane.LEFT + j] -= halves if landed else 0.0
        lanes[lane.IMPACTS + j] += 1.0 if landed else 0.0
        lanes[lane.VELOCITY + j] = (
            -lanes[lane.DELTA + j] * lanes[lane.VELOCITY_THERE + j]
            if landed
            else lanes[lane.VELOCITY + j]
        )
        sine, cosine = turned_by(
            lanes[lane.SINE_THERE + j],
            lanes[lane.COSINE_THERE + j],
            frequency * lanes[lane.STEP + j] if landed else 0.0,
        )
        lanes[lane.SINE + j] = -sine if landed else lanes[lane.SINE + j]
        lanes[lane.COSINE + j] = -cosine if landed else lanes[lane.COSINE + j]
        lanes[lane.TIME + j] = reached if active & inside else lanes[lane.TIME + j]
