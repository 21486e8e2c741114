"""State of a flight in a run of samples, in its side's units: what lanes and the march exchange.

The march holds a state in reference units between flights, and in those of the side while it flies
through samples.  Lanes that take a flight over at the start of a sample or after a landing in it,
and give it back, do so in the latter, so that what comes out is the march's own to the last bit.
"""

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import inlined

HELD = 0  # 1 where the columns below hold a flight, in place of the state that goes with them
ANGLE = 1
VELOCITY = 2
TOP_ANGLE = 3  # the peaks so far, where they are watched
TOP_SPEED = 4
ON = 5  # 1 where the march is to go on to its end
RIDE_COLUMNS = 6


@inlined
def is_ride(ride: Floats) -> bool:
    """Return whether a march is to end with the first flight within a run of samples."""
    return len(ride) > 0 and ride[ON] == 0.0


@inlined
def is_held(ride: Floats) -> bool:
    """Return whether a flight is held, in a run of samples."""
    return len(ride) > 0 and ride[HELD] > 0.0


@inlined
def hold(ride: Floats, angle: float, velocity: float, top_angle: float, top_speed: float) -> None:
    """Hold a flight."""
    ride[HELD] = 1.0
    ride[ANGLE], ride[VELOCITY] = angle, velocity
    ride[TOP_ANGLE], ride[TOP_SPEED] = top_angle, top_speed
