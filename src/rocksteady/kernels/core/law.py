"""Linear law that returns near an orbit follow, by which it is known before they repeat."""

import math
from typing import NamedTuple

from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.machine_code.compilation import compiled, inlined

CLOSE = 1e-5  # returns as close are held against the law ...
EXACT = 1e-12  # ... which is to foretell them to this part of 1 + D - |T| ...
BENT = 1e-4  # ... and to this part of them
ROOM = 0.05  # between 1 + D and |T|, and between D and 1
UNKNOWN = 1e140  # an area that has not been counted; its square is finite
NEGLIGIBLE = 1e-11  # part of such differences that adds nothing to a state


class Law(NamedTuple):
    """The law of a lane, and the differences of its last returns."""

    product: float  # T, as fitted to the last returns, is this ...
    square: float  # ... over this, which is 0 before
    area: float  # part to which the impacts since the last return have reduced areas
    last_phase: float
    last_velocity: float
    before_phase: float
    before_velocity: float


@inlined
def law_of(lanes: Floats, first: int, count: int, area: float) -> Law:
    """Return the law that begins at a place, with what an area has shrunk to by now."""
    return Law(
        lanes[first],
        lanes[first + count],
        area,
        lanes[first + 3 * count],
        lanes[first + 4 * count],
        lanes[first + 5 * count],
        lanes[first + 6 * count],
    )


@inlined
def put_law(lanes: Floats, first: int, count: int, law: Law) -> None:
    """Put a law in the fields of one of so many lanes, from a place on."""
    lanes[first] = law.product
    lanes[first + count] = law.square
    lanes[first + 2 * count] = law.area
    lanes[first + 3 * count] = law.last_phase
    lanes[first + 4 * count] = law.last_velocity
    lanes[first + 5 * count] = law.before_phase
    lanes[first + 6 * count] = law.before_velocity


@inlined
def after_return(law: Law, back: bool, further: float, faster: float) -> tuple[Law, bool]:
    """Return the law after a return, and whether it is surely that of a stable orbit nearby.

    `back` is false where there is no return; the differences of it are to be 0 then.
    """
    along_phase = further + law.area * law.before_phase
    along_velocity = faster + law.area * law.before_velocity
    square = law.last_phase * law.last_phase + law.last_velocity * law.last_velocity
    product = along_phase * law.last_phase + along_velocity * law.last_velocity
    # All in units of the square, which saves a division.
    off = max(
        abs(along_phase * law.square - law.product * law.last_phase),
        abs(along_velocity * law.square - law.product * law.last_velocity),
    )
    gap = max(abs(further), abs(faster))
    room = (1.0 + law.area) * law.square - abs(law.product)
    attracted = (
        back
        & (law.square > 0.0)
        & (gap < CLOSE)
        & (room >= ROOM * law.square)
        & (law.area <= 1.0 - ROOM)
        & (off <= EXACT * room)
        & (off <= BENT * gap * law.square)
    )
    fitted = back & (not attracted)
    then = Law(
        product if fitted else law.product,
        square if fitted else law.square,
        law.area,
        further if back else law.last_phase,
        faster if back else law.last_velocity,
        law.last_phase if back else law.before_phase,
        law.last_velocity if back else law.before_velocity,
    )
    return then, attracted


@compiled
def drawn_near(law: Law, times: float) -> tuple[float, float]:
    """Return by how much so many returns bring phase and velocity nearer to the orbit."""
    trace, area = law.product / law.square, law.area
    phase, velocity = law.last_phase, law.last_velocity
    before_phase, before_velocity = law.before_phase, law.before_velocity
    further = faster = 0.0
    if fades(trace, area, times):
        # The sum of all differences to come.
        room = 1.0 + area - trace
        further = ((trace - area) * phase - area * before_phase) / room
        faster = ((trace - area) * velocity - area * before_velocity) / room
        times = 0.0
    while times > 0.0:
        next_phase = trace * phase - area * before_phase
        next_velocity = trace * velocity - area * before_velocity
        before_phase, before_velocity = phase, velocity
        phase, velocity = next_phase, next_velocity
        further += phase
        faster += velocity
        times -= 1.0
    return further, faster


@compiled
def fades(trace: float, area: float, times: float) -> bool:
    """Return whether differences become negligible within a number of returns."""
    root = trace * trace - 4.0 * area
    largest = 0.5 * (abs(trace) + math.sqrt(root)) if root > 0.0 else math.sqrt(area)
    count = 1.0
    while 2.0 * count <= times and largest > NEGLIGIBLE:
        largest *= largest
        count *= 2.0
    return largest <= NEGLIGIBLE
