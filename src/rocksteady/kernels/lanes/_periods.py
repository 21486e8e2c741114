"""Detection of periodic motions in lanes, whose whole periods are then skipped."""

from rocksteady.kernels.core.returns import PERIODIC, Reference, compared, leapt
from rocksteady.kernels.core.tables import Floats
from rocksteady.kernels.lanes import _fields as lane
from rocksteady.kernels.lanes._fields import LANES, UNKNOWN
from rocksteady.kernels.lanes._law import Law, after_return, draw_near, law_of, put_law
from rocksteady.kernels.machine_code.compilation import compiled, inlined

ATTRACTED = -3.0  # what has become of a lag, as `PERIODIC`: the motion surely settles to an orbit


@inlined
def reference_of(lanes: Floats, j: int) -> Reference:
    """Return the reference of a lane."""
    return Reference(
        lanes[lane.REF_PHASE + j],
        lanes[lane.REF_VELOCITY + j],
        lanes[lane.REF_LEFT + j],
        lanes[lane.REF_IMPACTS + j],
        lanes[lane.LAG + j],
        lanes[lane.WIDEST + j],
    )


@compiled
def compare(lanes: Floats, most: int) -> int:
    """Compare states about to be launched with earlier ones; count those that are periodic.

    A motion with more impacts than `most` is not: it is to be given up.
    """
    count = 0
    for j in range(LANES):
        stage = lanes[lane.STAGE + j]
        reference = reference_of(lanes, j)
        impacts = lanes[lane.IMPACTS + j]
        phase, velocity = lanes[lane.PHASE + j], lanes[lane.VELOCITY + j]
        left = lanes[lane.LEFT + j]
        launched = (stage > 0.0) & (stage <= lane.LANDED)
        compares = launched & (reference.lag >= 0.0) & (impacts <= most)
        then = compared(reference, compares, phase, velocity, left, impacts)
        back = compares & (reference.lag > 0.0) & (impacts - reference.impacts == reference.lag)
        delta = lanes[lane.DELTA + j]
        area = lanes[lane.AREA + j] * (delta * delta if stage == lane.LANDED else 1.0)
        # Of a flight by the march it is not counted.
        area = UNKNOWN if launched & (stage < lane.LANDED) else area
        law, attracted = after_return(
            law_of(lanes, j, area),
            back,
            phase - reference.phase if back else 0.0,
            velocity - reference.velocity if back else 0.0,
        )
        attracted &= (reference.left > left) & (then.lag > 0.0)
        afresh = then.lag != reference.lag
        marked = (then.impacts != reference.impacts) & (not attracted)
        put_law(
            lanes,
            j,
            Law(
                law.product,
                0.0 if afresh else law.square,
                1.0 if marked else law.area,
                0.0 if afresh else law.last_phase,
                0.0 if afresh else law.last_velocity,
                0.0 if afresh else law.before_phase,
                0.0 if afresh else law.before_velocity,
            ),
        )
        lanes[lane.REF_PHASE + j] = then.phase
        lanes[lane.REF_VELOCITY + j] = then.velocity
        lanes[lane.REF_LEFT + j] = reference.left if attracted else then.left
        lanes[lane.REF_IMPACTS + j] = reference.impacts if attracted else then.impacts
        lag = ATTRACTED if attracted else then.lag
        lanes[lane.LAG + j] = lag
        lanes[lane.WIDEST + j] = then.widest
        count += 1 if (lag == PERIODIC) | (lag == ATTRACTED) else 0
    return count


@compiled
def leap(lanes: Floats) -> None:
    """Leap over all but the last whole period of the lanes that have become periodic."""
    for j in range(LANES):
        lag = lanes[lane.LAG + j]
        if lag == ATTRACTED:
            lanes[lane.LAG + j] = PERIODIC
        left, period = lanes[lane.LEFT + j], lanes[lane.REF_LEFT + j] - lanes[lane.LEFT + j]
        lanes[lane.LEFT + j], lanes[lane.IMPACTS + j], lanes[lane.LAG + j] = leapt(
            reference_of(lanes, j), left, lanes[lane.IMPACTS + j]
        )
        if lag == ATTRACTED:
            draw_near(lanes, j, (left - lanes[lane.LEFT + j]) / period)
