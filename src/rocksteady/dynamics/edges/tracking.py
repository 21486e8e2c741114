"""Edge states by tracking: a motion kept on the border of two basins by bisection.

After J. D. Skufca, J. A. Yorke and B. Eckhardt (2006).  Between two states that end differently a
bisection finds two as close as rounding lets one, on either side of the border.  Both are followed
until they have parted, a bisection between them finds a close pair again, and so on: the pairs
follow a motion on the border.  Whatever it settles to is known by its returns and polished by
Newton's method.
"""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.dynamics.batch.fates import ends_of
from rocksteady.dynamics.edges._flow import Flow
from rocksteady.dynamics.edges._outcomes import Outcome, Outcomes
from rocksteady.dynamics.edges.edge_state import EdgeState
from rocksteady.dynamics.edges.hilltop import HilltopSaddle, find_hilltop_saddles
from rocksteady.dynamics.history.start import (
    HasStart,
    Rest,
    Start,
    State,
    initial_march,
    set_going,
    start_of,
)
from rocksteady.dynamics.orbits.orbit import Orbit, orbit_from
from rocksteady.dynamics.orbits.return_map import harmonic, make_system
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.elementary.arrays import hypot, log
from rocksteady.kernels.orbits import periodic
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import side_value, whole_number
from rocksteady.model.equations import ModelChoice, Nonlinear, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.outcomes import Status

Point = tuple[float, float]
TURN = 2.0 * math.pi

CLOSE = 1e-10
"""Distance of a pair, over 1 + |u| + |du/ds|, to which it is bisected,"""
PARTED = 1e-5
"""and at which it is bisected again."""
STEP = 1.0
"""Pivot time for which a pair is followed at most before its distance is measured."""
RETURNED = 1e-3
"""Distance of a tracked state from an earlier one at which Newton's method is tried,"""
REACHED = 1e-4
"""and from the saddle at which the tracked motion has settled to it."""
LONGEST_ORBIT = 12
"""Largest period of an edge state [forcing periods]."""
MOST_CYCLES, FEWEST_PERIODS = 500, 200
LONGEST_APPROACH, MOST_PERIODS = 60.0, 10_000
"""Pivot time for which the border of fast shaking is tracked by default, and the most periods."""
MOST_KICK = 4.0
KICKS = 4000
"""Sizes at which a fatal kick is looked for."""
LEAST_APART, MOST_APART = 1e-13, 1e-3
"""Kicks by which a second state is moved off the border until it falls [alpha g/p]."""
HALVINGS = 100
SKIPPED = 3
"""Steps of a new pair before its growth counts."""


class Pair(NamedTuple):
    """Two states at one phase of the shaking, on either side of the border."""

    inside: Point
    outside: Point

    @property
    def middle(self) -> Point:
        """The state between them."""
        (a, b), (c, d) = self
        return 0.5 * (a + c), 0.5 * (b + d)

    @property
    def distance(self) -> float:
        """How far they are apart."""
        (a, b), (c, d) = self
        return hypot(a - c, b - d)

    @property
    def size(self) -> float:
        """What distances are measured against."""
        a, b = self.middle
        return 1.0 + abs(a) + abs(b)


@checked
def find_edge_state(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    *,
    start: Start | HasStart | None = None,
    other: State | Rest | HasStart | None = None,
    kick: int = 1,
    max_periods: int | None = None,
    max_cycles: int = MOST_CYCLES,
    model: ModelChoice = None,
) -> EdgeState:
    """Find what a motion on the border of two basins settles to, by tracking it.

    The border is sought on the line between two states that end differently.  Where one of them
    overturns and the other does not, it is the border of overturning; otherwise that of the basin
    to which `start` belongs.  Without a second state it is sought among the states to which a
    sudden change of the base velocity takes the block: the border is then reached by exactly the
    least fatal kick, and the edge state is what the block settles to under it.  Kicks are tried at
    steps of 0.001 alpha g/p: where the border is fractal, a smaller one between two steps may be
    fatal too.

    Parameters
    ----------
    block
        The block.
    motion
        Harmonic shaking; its phase is that of both states, unless `start` decides on it.
    start
        `Rest` (default), `State`, `Steady` or `ImpactState`.
    other
        The second state, `State` without a phase or `Rest`; None for a kick.
    kick
        +1 (default) or -1, the sign of the change of the base velocity; counts without `other`.
    max_periods
        Forcing periods for which the border is tracked; default 200, and of fast shaking those of
        60 pivot times, up to 10,000.
    max_cycles
        Forcing periods after which a motion is taken to stand, or as undecided; default 500.
    model
        ``"linear"`` (default) or ``"nonlinear"``, which needs the block's slenderness.

    Returns
    -------
    EdgeState
        The saddle on the border, or that the tracked motion has not repeated.

    Raises
    ------
    InputError, ModelError
        If both states end alike, no kick up to 4 alpha g/p is fatal, a number is outside its range,
        or the shaking is not harmonic.

    References
    ----------
    J. D. Skufca, J. A. Yorke and B. Eckhardt, Phys. Rev. Lett. 96, 174101 (2006),
    doi:10.1103/PhysRevLett.96.174101; L. Halekotte and U. Feudel, Sci. Rep. 10, 11783 (2020),
    doi:10.1038/s41598-020-68805-6.

    Examples
    --------
    >>> from rocksteady import DimensionlessBlock, Harmonic
    >>> motion = Harmonic(amplitude=0.2, frequency_ratio=2.0)
    >>> edge = find_edge_state(DimensionlessBlock(restitution=0.9), motion)
    >>> print(edge.kind, edge.saddle.side, f"{edge.kick:.6f}", edge.outcomes[1])
    hilltop 1 0.920000 overturned to the positive side
    """
    bare, shaken = block.dimensionless(), harmonic(motion)
    equations = chosen_model(model, block)
    if max_periods is None:
        lasting = LONGEST_APPROACH * shaken.frequency_ratio / TURN
        max_periods = min(max(FEWEST_PERIODS, math.ceil(lasting)), MOST_PERIODS)
    limits = {}
    for name, value, most in (
        ("max_periods", max_periods, 100_000),
        ("max_cycles", max_cycles, 1_000_000),
    ):
        hint = "give a number of forcing periods"
        limits[name] = whole_number(name, value, at_least=1, at_most=most, hint=hint)
    direction = side_value("kick", kick)
    initial = start_of(start)
    flow = Flow(block, shaken, equations)
    tilted = flow.sides if isinstance(equations, Nonlinear) else None
    moved, begin = initial_march(initial, bare, shaken, tilted)
    shaken = harmonic(moved)
    phase = shaken.phase % TURN
    here = begin.angle, begin.velocity
    outcomes = Outcomes(flow, limits["max_cycles"])
    size: float | None = None
    if other is None:
        low, high = _fatal(flow, here, phase, direction, limits["max_cycles"])
        size = direction * 0.5 * (low + high)
        near = _kicked(flow.sides, here, direction * low)
        far = _kicked(flow.sides, here, direction * high)
    else:
        near, far = here, _second(other, bare)
    ends = outcomes.of(*here, phase), outcomes.of(*far, phase)
    wider = LEAST_APART
    while size is not None and not ends[1].falls and wider < MOST_APART:
        # Rounding decides at the border, and not alike where a motion is followed to its end.
        far = _kicked(flow.sides, here, size + direction * wider)
        ends, wider = (ends[0], outcomes.of(*far, phase)), 2.0 * wider
    border = _Border(outcomes, *ends)
    pair = border.bisected(Pair(near, far), phase)
    tracked = border.track(pair, phase, limits["max_periods"])
    return EdgeState(
        block=block,
        motion=replace(shaken, phase=phase),
        kind=_kind(tracked.saddle),
        saddle=tracked.saddle,
        start=State(angle=here[0], velocity=here[1]),
        other=State(angle=far[0], velocity=far[1]),
        attractors=(ends[0].attractor, ends[1].attractor),
        outcomes=(ends[0].name, ends[1].name),
        boundary=State(angle=pair.middle[0], velocity=pair.middle[1]),
        kick=size,
        angle=tracked.states[:, 0],
        velocity=tracked.states[:, 1],
        bisections=outcomes.asked,
        exponent=tracked.exponent,
        distance=tracked.distance,
        model=equations,
    )


class Tracked(NamedTuple):
    """A motion on a border: its states at the phase, and what it has settled to."""

    states: Floats
    saddle: Orbit | HilltopSaddle | None
    distance: float
    exponent: float


class _Growth:
    """Growth of the distance of pairs, without the first steps of each.

    In these the part of the distance along the border has not yet died away.

    Parameters
    ----------
    count
        Steps in a forcing period.
    """

    def __init__(self, count: int) -> None:
        self.count, self.steps, self.grown = count, 0, 0.0
        self._age, self._begin, self._distance = 0, 0, 0.0

    def note(self, step: int, distance: float, *, last: bool) -> None:
        """Take note of a distance after a number of steps, of a pair the last or not."""
        self._age += 1
        if self._age == SKIPPED:
            self._begin, self._distance = step, distance
        elif last and self._age > SKIPPED and self._distance > 0.0:
            self.grown += log(distance / self._distance)
            self.steps += step - self._begin
        if last:
            self._age = 0

    @property
    def exponent(self) -> float:
        """Rate of growth per forcing period; nan where no pair has parted."""
        return self.grown / self.steps * self.count if self.steps else math.nan


class _Border:
    """Border of the basin of a first state.

    Parameters
    ----------
    outcomes
        Outcomes of states.
    first, second
        Outcomes of the two states between which the border lies.
    """

    def __init__(self, outcomes: Outcomes, first: Outcome, second: Outcome) -> None:
        if first.same(second):
            raise ModelError(
                "other",
                Words(f"ends as start does: {first.name}"),
                "an edge lies between states that end differently",
                "give another state, or leave it out for the least fatal kick",
            )
        self.outcomes, self.flow = outcomes, outcomes.flow
        self.first = first
        self.of_falls = first.falls != second.falls

    def belongs(self, point: Point, phase: float) -> bool:
        """Return whether a state lies on the first one's side."""
        if self.of_falls:
            return self.outcomes.falls(*point, phase) == self.first.falls
        return self.outcomes.of(*point, phase).same(self.first)

    def bisected(self, pair: Pair, phase: float) -> Pair:
        """Return a close pair on the line between two states."""
        for _ in range(HALVINGS):
            middle = pair.middle
            if pair.distance <= CLOSE * pair.size or middle in pair:
                break
            belongs = self.belongs(middle, phase)
            pair = Pair(middle, pair.outside) if belongs else Pair(pair.inside, middle)
        return pair

    def track(self, pair: Pair, phase: float, periods: int) -> Tracked:
        """Follow the border from a pair on it, for a number of forcing periods at most."""
        ratio = self.flow.motion.frequency_ratio
        count = math.ceil(TURN / ratio / STEP)
        states, impacts = [pair.middle], [0]
        growth = _Growth(count)
        saddles = find_hilltop_saddles(self.flow.block, self.flow.motion, model=self.flow.model)
        saddle: Orbit | HilltopSaddle | None = None
        distance, apart = math.nan, 0  # impacts that one of the pair is ahead of the other
        for period in range(periods):
            bounced = 0
            for step in range(count):
                begin = phase + TURN * (step / count)
                end = phase + TURN * ((step + 1) / count)
                first, two = (self.flow.carried(*point, begin, end) for point in pair)
                pair = Pair((first.angle, first.velocity), (two.angle, two.velocity))
                bounced += first.impacts
                apart += first.impacts - two.impacts
                if not math.isfinite(pair.distance):
                    raise ModelError(
                        "other",
                        Words(f"leads to a pair that parts at once, after {period} periods"),
                        "the border could not be followed",
                        "give states that are closer together",
                    )
                if apart != 0:  # one of them has an impact that the other is still to have
                    continue
                parted = pair.distance > PARTED * pair.size
                growth.note(period * count + step + 1, pair.distance, last=parted)
                if parted:
                    pair = self.bisected(pair, end)
            states.append(pair.middle)
            impacts.append(bounced)
            saddle, distance = self._settled(states, impacts, phase, saddles)
            if saddle is not None and growth.steps > 0:
                break
        return Tracked(np.array(states), saddle, distance, growth.exponent)

    def _settled(
        self,
        states: list[Point],
        impacts: list[int],
        phase: float,
        saddles: tuple[HilltopSaddle, ...],
    ) -> tuple[Orbit | HilltopSaddle | None, float]:
        """Return the saddle to which tracked states have come, and the distance from it."""
        last = states[-1]
        for period in range(1, min(LONGEST_ORBIT, len(states) - 1) + 1):
            before = states[-1 - period]
            if hypot(last[0] - before[0], last[1] - before[1]) > RETURNED:
                continue
            bounces = sum(impacts[-period:])
            if bounces == 0:
                for saddle in saddles:
                    angle, velocity = saddle.at(phase)
                    distance = hypot(last[0] - float(angle), last[1] - float(velocity))
                    if distance <= REACHED:
                        return saddle, distance
                continue
            orbit = self._polished(before, phase, bounces, period)
            if orbit is not None:
                distance = _distance(orbit, last, phase)
                if distance <= REACHED:
                    return orbit, distance
        return None, math.nan

    def _polished(self, point: Point, phase: float, impacts: int, period: int) -> Orbit | None:
        """Return the saddle orbit near a state; None where Newton's method finds none."""
        flow = self.flow
        first = flow.after(*point, phase, 1, longest=TURN * (period + 1))
        if not math.isfinite(first.velocity) or first.velocity == 0.0:
            return None
        half, rest = clock(first.phase)
        system = make_system(flow.block, flow.motion, flow.model)
        table = np.zeros((impacts, periodic.ORBIT_COLUMNS))
        begin = Section(first.side, half, rest, abs(first.velocity))
        fixed = periodic.polish(system, begin, impacts, period, table)
        if not fixed.found or fixed.rests or fixed.grazes:
            return None
        passages, shortest = periodic.primitive(table, impacts, period)
        table = table[:passages].copy()
        orbit = orbit_from(flow.block, flow.motion, table, shortest, fixed.residual, flow.model)
        first_modulus, second_modulus = (abs(complex(value)) for value in orbit.multipliers)
        return orbit if first_modulus > 1.0 > second_modulus else None


def _distance(orbit: Orbit, point: Point, phase: float) -> float:
    """Return how far a state is from an orbit at a phase of the shaking."""
    run = orbit.trajectory()
    since = (phase - orbit.states[0].phase) % TURN + TURN * np.arange(orbit.period)
    here = run(np.minimum(since / orbit.motion.frequency_ratio, run.end_time_pt))
    return float(hypot(here.angle - point[0], here.velocity - point[1]).min())


def _kind(saddle: Orbit | HilltopSaddle | None) -> str:
    if saddle is None:
        return "aperiodic"
    return "hilltop" if isinstance(saddle, HilltopSaddle) else "orbit"


def _second(other: State | Rest | HasStart, block: DimensionlessBlock) -> Point:
    """Return the second state."""
    given = start_of(other, name="other")
    if not isinstance(given, Rest | State) or getattr(given, "phase", None) is not None:
        raise InputError(
            "other",
            other,
            "it must be Rest() or a State without a phase",
            "give State(angle=..., velocity=...)",
        )
    _, begin = initial_march(given, block, Harmonic(amplitude=0.0, frequency_ratio=1.0))
    return begin.angle, begin.velocity


def _kicked(sides: Floats, point: Point, kick: float) -> Point:
    """Return a state after a sudden change of the base velocity, in units of alpha g/p."""
    return point[0], set_going(*point, kick, sides)[1]


def _fatal(
    flow: Flow, point: Point, phase: float, direction: int, cycles: int
) -> tuple[float, float]:
    """Return the sizes of a kick that leaves the block standing and of one that is fatal.

    They enclose the least fatal one of those tried, and are bisected as far as numbers go.
    """
    sizes = np.linspace(0.0, MOST_KICK, KICKS + 1)
    states = np.array([_kicked(flow.sides, point, direction * size) for size in sizes.tolist()])
    count = len(sizes)
    status = ends_of(
        amplitude=np.full(count, flow.motion.amplitude),
        frequency_ratio=np.full(count, flow.motion.frequency_ratio),
        sides=np.broadcast_to(flow.sides, (count, *flow.sides.shape)).copy(),
        angle=states[:, 0].copy(),
        velocity=states[:, 1].copy(),
        phase=np.full(count, phase),
        cycles=cycles,
        harmonics=(),
    )
    falls = np.flatnonzero(status == int(Status.OVERTURNED))
    if not len(falls) or falls[0] == 0:
        reason = "overturns without a kick" if len(falls) else "stands under every kick"
        raise ModelError(
            "start",
            Words(f"{reason} up to {MOST_KICK:g} alpha g/p"),
            "the least fatal kick is sought from a state that stands, towards one that falls",
            "give another start, the other sign of the kick, or a second state as other",
        )
    low, high = float(sizes[falls[0] - 1]), float(sizes[falls[0]])

    def fatal(size: float) -> bool:
        state = _kicked(flow.sides, point, direction * size)
        return flow.carried(*state, phase, phase + TURN * cycles).fallen

    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if high - low <= 1e-13 * high or middle in (low, high):
            break
        low, high = (low, middle) if fatal(middle) else (middle, high)
    return low, high
