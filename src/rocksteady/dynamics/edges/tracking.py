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
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.dynamics.batch.fates import ends_of
from rocksteady.dynamics.edges._flow import Flow
from rocksteady.dynamics.edges._outcomes import Outcome, Outcomes
from rocksteady.dynamics.edges.edge_state import MOST_KICK, EdgeState
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
from rocksteady.kernels.elementary.arrays import exp, hypot, log
from rocksteady.kernels.orbits import periodic
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import side_value, whole_number
from rocksteady.model.equations import ModelChoice, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.outcomes import BALANCED, Status

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
KICKS = 4000
"""Sizes of either sign up to the largest kick;"""
FINER = 10
"""up to twice the least fatal one they are this much closer."""
RESOLUTION = MOST_KICK / KICKS / FINER
ZOOMS, ZOOM = 3, 20
"""Times that the sizes just below the least fatal one are tried again, each time closer by this."""
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
    kick: int | None = None,
    max_periods: int | None = None,
    max_cycles: int = MOST_CYCLES,
    model: ModelChoice = None,
) -> EdgeState:
    """Find what a motion on the border of two basins settles to, by tracking it.

    The border is sought on the line between two states that end differently.  Where one of them
    overturns and the other does not, it is the border of overturning; otherwise that of the basin
    to which `start` belongs.  Without a second state it is sought among the states to which a
    sudden change of the base velocity takes the block: the border is then reached by exactly the
    least fatal kick, and the edge state is what the block settles to under it.  Both directions are
    searched, also for a symmetric block: the phase of the shaking makes them differ.  Kicks are
    tried in steps of 0.001 alpha g/p up to 4, and in steps of 0.0001 up to twice the least.  If
    these cross the border more often than those, it is fractal: the kick is the least one found.

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
        +1 or -1, the only sign of the change of the base velocity to search; default both.  It
        counts without `other`.
    max_periods
        Forcing periods for which the border is tracked; default 200, and of fast shaking those of
        60 pivot times, up to 10,000.
    max_cycles
        Forcing periods after which a motion is taken to stand, or as undecided; default 500.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

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
    >>> print(f"the other way {edge.opposite:.6f}")
    the other way -1.080000
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
    signs = (1, -1) if kick is None else (side_value("kick", kick),)
    initial = start_of(start)
    flow = Flow(block, shaken, equations)
    moved, begin = initial_march(initial, bare, shaken, flow.sides)
    shaken = harmonic(moved)
    phase = shaken.phase % TURN
    here = begin.angle, begin.velocity
    outcomes = Outcomes(flow, limits["max_cycles"])
    size: float | None = None
    kicks: list[_Fatal] = []
    if other is None:
        kicks = [_fatal(flow, here, phase, sign, limits["max_cycles"]) for sign in signs]
        kicks.sort(key=lambda each: each.high)
        least = kicks[0]
        if not math.isfinite(least.high):
            sign = "" if kick is None else "positive " if signs[0] > 0 else "negative "
            also = "" if kick is None else ", search both signs of the kick"
            raise _no_edge(f"stands under every {sign}kick up to {MOST_KICK:g} alpha g/p", also)
        size = least.kick
        near = _kicked(flow.sides, here, least.sign * least.low)
        far = _kicked(flow.sides, here, least.sign * least.high)
    else:
        near, far = here, _second(other, bare, flow.sides)
    ends = outcomes.of(*here, phase), outcomes.of(*far, phase)
    wider = LEAST_APART
    while size is not None and not ends[1].falls and wider < MOST_APART:
        # Rounding decides at the border, and not alike where a motion is followed to its end.
        far = _kicked(flow.sides, here, size + math.copysign(wider, size))
        ends, wider = (ends[0], outcomes.of(*far, phase)), 2.0 * wider
    border = _Border(outcomes, *ends)
    pair = border.bisected(Pair(near, far), phase)
    tracked = border.track(pair, phase, limits["max_periods"])
    return EdgeState(
        block=block,
        motion=replace(shaken, phase=phase),
        kind=_kind(tracked.saddle, lost=len(tracked.states) <= limits["max_periods"]),
        saddle=tracked.saddle,
        start=State(angle=here[0], velocity=here[1]),
        other=State(angle=far[0], velocity=far[1]),
        attractors=(ends[0].attractor, ends[1].attractor),
        outcomes=(ends[0].name, ends[1].name),
        boundary=State(angle=pair.middle[0], velocity=pair.middle[1]),
        kick=size,
        opposite=kicks[1].kick if len(kicks) > 1 else None,
        fractal=any(each.fractal for each in kicks) if kicks else None,
        width=kicks[0].width if kicks else None,
        resolution=RESOLUTION if kicks else None,
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
                if not math.isfinite(pair.distance):  # one of them has fallen meanwhile
                    return Tracked(np.array(states), None, math.nan, growth.exponent)
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


def _kind(saddle: Orbit | HilltopSaddle | None, *, lost: bool) -> str:
    if saddle is None:
        return "lost" if lost else "aperiodic"
    return "hilltop" if isinstance(saddle, HilltopSaddle) else "orbit"


def _second(other: State | Rest | HasStart, block: DimensionlessBlock, sides: Floats) -> Point:
    """Return the second state."""
    given = start_of(other, name="other")
    if not isinstance(given, Rest | State) or getattr(given, "phase", None) is not None:
        raise InputError(
            "other",
            other,
            "it must be Rest() or a State without a phase",
            "give State(angle=..., velocity=...)",
        )
    _, begin = initial_march(given, block, Harmonic(amplitude=0.0, frequency_ratio=1.0), sides)
    return begin.angle, begin.velocity


def _kicked(sides: Floats, point: Point, kick: float) -> Point:
    """Return a state after a sudden change of the base velocity, in units of alpha g/p."""
    return point[0], set_going(*point, kick, sides)[1]


class _Fatal(NamedTuple):
    """Least fatal kick in one direction.

    Attributes
    ----------
    sign
        Of the change of the base velocity.
    low, high
        Sizes that enclose it: the block stands under the first; infinite where no kick is fatal.
    fractal
        Whether smaller steps find more borders.
    width
        Of the window that begins there; None where it is not fractal.
    """

    sign: int
    low: float
    high: float
    fractal: bool = False
    width: float | None = None

    @property
    def kick(self) -> float:
        """The kick with its sign [alpha g/p]; nan where none is fatal."""
        size = 0.5 * (self.low + self.high)
        return self.sign * size if math.isfinite(size) else math.nan


def _fatal(flow: Flow, point: Point, phase: float, sign: int, cycles: int) -> _Fatal:
    """Return the least fatal kick in one direction, bisected as far as numbers go."""

    def falls(sizes: Floats) -> NDArray[np.bool_]:
        states = np.array([_kicked(flow.sides, point, sign * size) for size in sizes.tolist()])
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
        overturned: NDArray[np.bool_] = status == int(Status.OVERTURNED)
        return overturned

    sizes = np.linspace(0.0, MOST_KICK, KICKS + 1)
    coarse = falls(sizes)
    first = int(np.argmax(coarse))
    if coarse[0]:
        raise _no_edge("overturns without a kick")
    if not first:
        return _Fatal(sign, math.inf, math.inf)
    twice = min(2 * first, KICKS)
    sizes = np.linspace(0.0, sizes[twice], FINER * twice + 1)
    fine = falls(sizes)
    fractal = _borders(fine) > _borders(coarse[: twice + 1])
    first = int(np.argmax(fine))
    stands = float(sizes[first + np.argmin(fine[first:])])
    for _ in range(ZOOMS if fractal else 0):  # narrower windows lead to the least
        begin = max(float(sizes[first]) - KICKS / ZOOM * float(sizes[1] - sizes[0]), 0.0)
        sizes = np.linspace(begin, sizes[first], KICKS + 1)
        first = int(np.argmax(falls(sizes)))
    low, high = float(sizes[first - 1]), float(sizes[first])
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if high - low <= 1e-13 * high or middle in (low, high):
            break
        state = _kicked(flow.sides, point, sign * middle)
        fatal = flow.carried(*state, phase, phase + TURN * cycles).fallen
        low, high = (low, middle) if fatal else (middle, high)
    if not low:
        raise _no_edge(BALANCED)
    if not fractal:
        return _Fatal(sign, low, high)
    wider = exp(np.linspace(log(CLOSE), log(stands - high), KICKS))
    return _Fatal(sign, low, high, fractal, float(wider[np.argmin(falls(high + wider))]))


def _borders(falls: NDArray[np.bool_]) -> int:
    """Return how often neighbours differ."""
    return int(np.count_nonzero(falls[1:] != falls[:-1]))


def _no_edge(reason: str, also: str = "") -> ModelError:
    return ModelError(
        "start",
        Words(reason),
        "the least fatal kick is sought from a state that stands, towards one that falls",
        f"give another start{also}, or give a second state as other",
    )
