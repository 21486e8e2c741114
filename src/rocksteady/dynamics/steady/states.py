"""Symmetric steady states, over arrays of amplitude, frequency and restitution.

A symmetric steady state repeats itself, mirrored, after n half periods of the shaking; n = 1 is the
harmonic response and n = 3 the 1/3 subharmonic.  Wherever one exists there are two, the branches of
eqs 21 and 22 of Tso and Wong (1989); here both are given, with what the algebra does not see:
whether the block would pass through the floor on the way, and whether the motion is stable.  The
states of the full equations are those to which the closed form leads (`half_cycles`).
"""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from numbers import Integral
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rocksteady.arrays import Bools, Floats
from rocksteady.dynamics.arrays import order_of_orbit, resolved, validated_grid
from rocksteady.dynamics.steady._half_cycles import compute_course, find_half_cycles
from rocksteady.dynamics.steady.verdicts import half_cycle_pairs, squared_pairs, verdict
from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.core.clock import clock
from rocksteady.kernels.elementary.arrays import sin
from rocksteady.kernels.orbits.closed_form import (
    Points,
    Steady,
    fill_half_cycle,
    fill_steady,
    symmetric_orbit,
)
from rocksteady.kernels.orbits.return_map import Section
from rocksteady.kernels.orbits.symmetric_nonlinear import symmetric_from
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.arrays import scalar_of
from rocksteady.model.checks.bounds import INSIDE, Whole
from rocksteady.model.checks.validation import finite
from rocksteady.model.equations import Linear, Model, ModelChoice, Nonlinear, chosen_model
from rocksteady.model.motions.segments import Harmonic
from rocksteady.model.units import framed
from rocksteady.results.result import Result, words_module

if TYPE_CHECKING:
    import pandas as pd
    import xarray

BRANCHES = (1, 2)
SHAPE = (3, 4)
"""Rows of peak and extrema in what `find_half_cycles` returns."""
LEFT_OUT = 1e-15
"""Part of a flight that a step may leave out where a state is continued."""


def validated_branch(name: str, value: object) -> Literal[1, 2]:
    """Return the number of a branch, 1 or 2, as an int.

    Parameters
    ----------
    name, value
        Name of the argument, and 1 or 2: the upper or the lower signs of eqs 21 and 22.

    Returns
    -------
    int
        The same.

    Raises
    ------
    InputError
        If it is neither; 1.0 and True are refused.

    Examples
    --------
    >>> validated_branch("branch", 2)
    2
    """
    number = scalar_of(value)
    whole = isinstance(number, Integral) and not isinstance(number, bool)
    if not whole or number not in BRANCHES:
        raise InputError(name, value, "there are two branches", "give 1 or 2")
    return 1 if number == 1 else 2


def refuse_asymmetric(block: Block | DimensionlessBlock, name: str, what: str) -> None:
    """Refuse a block whose sides differ where only closed forms of symmetric blocks exist.

    Parameters
    ----------
    block
        Any.
    name, what
        The refused argument, and the closed form that was requested, in words.

    Raises
    ------
    ModelError
        If it is asymmetric, or stands against a wall.
    """
    if block.symmetric:
        return
    how = "stands against a wall" if block.one_sided else "is asymmetric"
    raise ModelError(
        name,
        Words(how if name == "block" else "is a steady state"),
        f"{what} comes from the closed forms of symmetric motions, whose second half mirrors the "
        f"first; a block that {how} has none",
        "its periodic motions are found by `find_orbits`",
    )


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class SteadyStates(Result):
    """Both symmetric steady states at each point of a grid.

    Arrays named below without a branch have the broadcast shape of the inputs, ``grid``; those of
    the solutions have shape ``(2, *grid)``, branch 1 first, and are nan (False, 0) where there is
    no solution.

    Attributes
    ----------
    amplitude, frequency_ratio, restitution, order
        The inputs, broadcast against each other.
    region
        1 to 5 (Figs 3, 4) of the closed form, which has no solution in 4.
    existence, sign, kind
        Boundaries in amplitude, of the closed form: eq 23, below which nothing exists; eq 24, above
        which the phase of branch 2 is negative; eq 25, above which branch 1 is out of phase.
    phase
        Phase of the shaking at the impact that begins a positive half cycle, in (-pi, pi] [rad]
        (eqs 21, 22).
    velocity_tau
        du/d(omega t) just after that impact (eq 19), u = theta/alpha.  Below 0 an inadmissible
        solution goes downwards there, through the floor; an `Orbit` has its modulus as speed.
    trace
        Trace of the half-cycle map of (phase, velocity), whose determinant is restitution^2.
    peak, extrema
        Largest u among the extrema of the positive half cycle, and their number; None without
        `with_shapes`.  For an inadmissible orbit that begins downwards it may be negative.
    admissible
        Whether the half cycle stays above the floor; None without `with_shapes`.
    block
        The block whose degrees, g and Hz stand beside; None for none.
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    closed_form
        The states of the linear model beside those of the full equations; None in the linear model.
    """

    amplitude: Floats
    frequency_ratio: Floats
    restitution: Floats
    order: NDArray[np.int64]
    region: NDArray[np.int64]
    existence: Floats
    sign: Floats
    kind: Floats
    phase: Floats
    velocity_tau: Floats
    trace: Floats
    peak: Floats | None
    extrema: NDArray[np.int64] | None
    admissible: Bools | None
    block: Block | None = None
    model: Model = field(default_factory=Linear)
    closed_form: "SteadyStates | None" = None

    @cached_property
    def velocity(self) -> Floats:
        """du/d(pt) just after that impact, as a `State` takes it; signed as `velocity_tau`."""
        result: Floats = self.frequency_ratio * self.velocity_tau
        return result

    @cached_property
    def in_phase(self) -> Bools:
        """Whether |phase| < pi/2; the other solutions are out of phase with the shaking."""
        result: Bools = np.abs(self.phase) < 0.5 * math.pi
        return result

    @cached_property
    def multipliers(self) -> NDArray[np.complex128]:
        """Multipliers of a period of the motion, shape ``(2, *grid, 2)``, as of an `Orbit`.

        They are the squares of those of the half cycle, in the same order.
        """
        return squared_pairs(self.half_cycle_multipliers)

    @cached_property
    def half_cycle_multipliers(self) -> NDArray[np.complex128]:
        """Multipliers of the half cycle, shape ``(2, *grid, 2)``, the larger in modulus first.

        They are the roots of ``m^2 - trace m + restitution^2``; a pair of equal modulus comes with
        the positive imaginary part first.  nan at a graze.
        """
        return half_cycle_pairs(self.trace, self.restitution)

    @cached_property
    def neutral(self) -> Bools:
        """Whether both multipliers have modulus 1: restitution 1 and |trace| < 2."""
        neutral: Bools = (np.abs(self.trace) < 2.0) & (self.restitution == 1.0) & self._allowed
        return neutral

    @cached_property
    def stable(self) -> Bools:
        """Whether the orbit is admissible and both multipliers lie inside the unit circle.

        That is so where ``|trace| < 1 + restitution^2``; not of neutral ones, or with a graze.
        """
        inside: Bools = np.abs(self.trace) < 1.0 + self.restitution * self.restitution
        stable: Bools = inside & (self.restitution < 1.0) & self._allowed
        return stable

    @property
    def _allowed(self) -> Bools:
        if self.admissible is None:
            hint = "call rs.formulas.steady_states(..., with_shapes=True)"
            message = f"stability needs admissibility: {hint}"
            raise AttributeError(message)
        return self.admissible

    def for_block(self, block: Block | DimensionlessBlock) -> "SteadyStates":
        """Return the same states, described in the degrees, g and Hz of a block."""
        closed = None if self.closed_form is None else self.closed_form.for_block(block)
        described = block if isinstance(block, Block) else None
        return replace(self, block=described, closed_form=closed)

    def rows(self) -> list[dict[str, Any]]:
        """Return one row per solution, in the order of the points."""
        rows: list[dict[str, Any]] = words_module(SteadyStates).solution_rows(self)
        return rows

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per solution, in the order of the points."""
        return framed(self.rows(), self.block, "amplitude", "frequency_ratio")

    def to_dataset(self) -> "xarray.Dataset":
        """Return everything as an xarray Dataset with dimensions branch and grid_0, grid_1, ...

        Returns
        -------
        xarray.Dataset
            Inputs, region and boundaries over the grid; phase [rad], velocity and the rest over
            branch and grid; shapes only where they were computed.

        Examples
        --------
        >>> data = steady_states([1.0, 2.0], 4.0, 0.8).to_dataset()
        >>> print(data.phase.dims, data.phase.attrs["units"])
        ('branch', 'grid_0') rad
        """
        dataset: xarray.Dataset = words_module(SteadyStates).steady_dataset(self)
        return dataset


@checked
def find_steady_states(
    block: Block | DimensionlessBlock,
    motion: Harmonic,
    *,
    order: ArrayLike = 1,
    model: ModelChoice = None,
) -> SteadyStates:
    """Find both symmetric steady states of a block under harmonic motion.

    Those of the linear model are a closed form; those of the full equations are its continuation
    from slender blocks to the block's own slenderness, found by Newton's method.  Either model has
    both or none.  `rocksteady.find_orbits` finds all periodic motions, of any block and motion.
    Over arrays of amplitudes and frequencies there is the closed form,
    `rocksteady.formulas.steady_states`.

    Parameters
    ----------
    block
        Symmetric; with a size the states are described in degrees, g and Hz.
    motion
        Its phase does not matter.
    order
        n = 1, 3, 5, ...: half periods of the motion in one half cycle; one or several.
    model
        ``"linear"`` or ``"nonlinear"``; by default nonlinear for a `Block`.

    Returns
    -------
    SteadyStates
        Arrays of shape ``(2, *order.shape)`` for the solutions; of the full equations with those of
        the linear model as `closed_form`.

    Raises
    ------
    InputError
        If an order is even, or a value of the motion is outside its range.
    ModelError
        If the sides of the block differ, one is a wall, the motion is not `Harmonic`, or the
        nonlinear model meets a block without slenderness.

    References
    ----------
    W. K. Tso and C. M. Wong, Earthquake Eng. Struct. Dyn. 18, 89-106 (1989), eqs 12 to 25.

    Examples
    --------
    >>> from rocksteady import Block, Harmonic
    >>> block = Block.rectangle(width=0.4, height=2.0)
    >>> motion = Harmonic.from_si(block, acceleration_m_s2=3.92, frequency_hz=2.0)
    >>> print(find_steady_states(block, motion).describe().sentence)
    It can rock steadily at 1.59° (0.14 alpha), out of phase, and that is stable.
    """
    if not isinstance(motion, Harmonic):
        raise ModelError(
            "motion",
            motion,
            "symmetric steady states are those of harmonic motion",
            "find_orbits takes any periodic motion, simulate any motion",
        )
    refuse_asymmetric(block, "block", "find_steady_states")
    return states_of(block, motion.amplitude, motion.frequency_ratio, order, model)


def states_of(
    block: Block | DimensionlessBlock,
    amplitude: ArrayLike,
    frequency_ratio: ArrayLike,
    order: ArrayLike,
    model: object,
) -> SteadyStates:
    """Return the symmetric steady states of a block over broadcast arrays.

    Parameters
    ----------
    block
        Symmetric.
    amplitude, frequency_ratio, order
        As for `steady_states`.
    model
        As for `find_steady_states`.
    """
    restitution = block.dimensionless().restitution
    if isinstance(chosen_model(model, block), Linear):
        states = steady_states(amplitude, frequency_ratio, restitution, order=order)
    else:
        assert isinstance(block, Block)
        alpha = block.positive.alpha
        states, _ = full_states(amplitude, frequency_ratio, restitution, alpha, order=order)
        states = replace(states, model=chosen_model(model, block))
    return states.for_block(block)


def full_states(
    amplitude: ArrayLike,
    frequency_ratio: ArrayLike,
    restitution: ArrayLike,
    alpha: ArrayLike,
    *,
    order: ArrayLike = 1,
    branch: int | None = None,
) -> tuple[SteadyStates, Floats]:
    """Return both branches of the full equations, and the derivatives of their half cycles.

    A state is continued from the closed form where that has a motion and no fold or floor comes in
    the way.  All others, and the shape of all, come from `half_cycles`.

    Parameters
    ----------
    amplitude, frequency_ratio, restitution, order
        As for `steady_states`.
    alpha
        Slenderness [rad].
    branch
        For starts: one branch alone, without its shape where it is continued.

    Returns
    -------
    states
        Arrays of shape ``(2, *grid)``.
    jacobian
        Derivative in (phase, velocity), row by row, of any scale; shape ``(4, 2, *grid)``.

    Examples
    --------
    >>> states, _ = full_states(2.0, 4.0, 0.8, 0.3)
    >>> print(states.peak.round(6), states.admissible)
    [ 0.181107 -0.040739] [ True False]
    """
    closed = steady_states(amplitude, frequency_ratio, restitution, order=order)
    assert closed.admissible is not None
    size, ratio, delta = closed.amplitude, closed.frequency_ratio, closed.restitution
    grids = np.broadcast_arrays(resolved(size), ratio, delta, alpha, closed.order.astype(float))
    given = [x.ravel() for x in grids]
    fields = np.full((10, 2, len(given[0])), math.nan)
    allowed, phase, velocity = (
        x.reshape(2, -1) for x in (closed.admissible, closed.phase, closed.velocity)
    )
    wanted = [branch is None or branch == each for each in BRANCHES]
    for which, cell in np.argwhere(allowed & np.array(wanted)[:, None]).tolist():
        a, w, r, lean, n = (x.item(cell) for x in given)
        begin = Section(1, *clock(phase.item(which, cell)), velocity.item(which, cell))
        sides = np.array([[r, 1.0, 1.0, lean, LEFT_OUT]] * 2)
        half = symmetric_from(a, w, sides, int(n), which + 1, begin)
        if half.found:
            trace = half.jacobian.phase_by_phase + half.jacobian.speed_by_speed
            turned = math.pi * half.state.half_cycles + half.state.phase
            turned -= 2.0 * math.pi * ((turned > math.pi) - (turned <= -math.pi))
            fields[:3, which, cell] = turned, half.state.speed, trace
            fields[5:, which, cell] = 1.0, *half.jacobian
    lacking = np.arange(len(given[0]))
    if branch is not None:
        lacking = np.flatnonzero(np.isnan(fields[0, branch - 1]))
    others = find_half_cycles(*(x[lacking] for x in given))
    continued = np.isfinite(fields[0][:, lacking])
    for row in range(10):
        kept = continued if row not in SHAPE else False
        fields[row][:, lacking] = np.where(kept, fields[row][:, lacking], others[row])
    fields = fields.reshape(10, *closed.phase.shape)
    states = replace(
        closed,
        phase=fields[0],
        velocity_tau=fields[1] / ratio,
        trace=fields[2],
        peak=fields[3],
        extrema=np.nan_to_num(fields[4]).astype(np.int64),
        admissible=fields[5] == 1.0,
        model=Nonlinear(),
        closed_form=closed,
    )
    return states, fields[6:]


@checked
def steady_states(
    amplitude: ArrayLike,
    frequency_ratio: ArrayLike,
    restitution: ArrayLike,
    *,
    order: Annotated[ArrayLike, INSIDE] = 1,
    with_shapes: bool = True,
) -> SteadyStates:
    """Return both branches of symmetric steady states (eqs 12 to 25) over broadcast arrays.

    They are those of the linear model and of symmetric blocks, of which the restitution is all that
    counts; those of the full equations are found by `rocksteady.find_steady_states`, the periodic
    motions of an asymmetric block by `rocksteady.find_orbits`.

    Parameters
    ----------
    amplitude
        A = a_max / (alpha g), from 0 to 1e50.
    frequency_ratio
        Omega = omega / p, from 0.01 to 10 000.
    restitution
        Ratio of angular velocities, in (0, 1].
    order
        n = 1, 3, 5, ...: half periods of the shaking in one half cycle.
    with_shapes
        Whether to follow the half cycles for peaks, extrema and admissibility, without which
        stability has no meaning.  Phase, velocity and trace alone are some ten times faster.

    Returns
    -------
    SteadyStates
        Arrays of shape ``(2, *grid)`` for the solutions.

    Raises
    ------
    InputError
        If a value is outside its range, or an order is even.

    References
    ----------
    W. K. Tso and C. M. Wong, Earthquake Eng. Struct. Dyn. 18, 89-106 (1989).

    Examples
    --------
    >>> states = steady_states(2.0, 4.0, 0.8)
    >>> print(states.region, states.phase.round(6), states.velocity.round(6))
    2 [ 2.846543 -0.03411 ] [ 0.732389 -0.085893]
    >>> print(states.admissible, states.stable, states.peak[0].round(6))
    [ True False] [ True False] 0.185499
    """
    amplitudes, ratios, restitutions, orders = validated_grid(
        amplitude, frequency_ratio, restitution, order
    )
    shape = amplitudes.shape
    size = amplitudes.size
    boundaries = np.empty((3, size))
    phase, velocity, trace = np.empty((3, 2, size))
    peak = np.empty((2, size if with_shapes else 0))
    extrema = np.zeros(peak.shape, dtype=np.int64)
    admissible = np.zeros(peak.shape, dtype=np.bool_)
    region = np.empty(size, dtype=np.int64)
    fill_steady(
        Points(resolved(amplitudes).ravel(), ratios.ravel(), restitutions.ravel(), orders.ravel()),
        with_shapes,
        Steady(region, boundaries, phase, velocity, trace, peak, extrema, admissible),
    )
    grid = (2, *shape)
    return SteadyStates(
        amplitude=amplitudes,
        frequency_ratio=ratios,
        restitution=restitutions,
        order=orders,
        region=region.reshape(shape),
        existence=boundaries[0].reshape(shape),
        sign=boundaries[1].reshape(shape),
        kind=boundaries[2].reshape(shape),
        phase=phase.reshape(grid),
        velocity_tau=velocity.reshape(grid),
        trace=trace.reshape(grid),
        peak=peak.reshape(grid) if with_shapes else None,
        extrema=extrema.reshape(grid) if with_shapes else None,
        admissible=admissible.reshape(grid) if with_shapes else None,
    )


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class SteadyOrbit(Result):
    """One period of a symmetric steady state, as arrays of shape (samples,).

    Attributes
    ----------
    tau
        omega t from the impact that begins the positive half, 0 to 2 n pi.
    angle, velocity, velocity_tau
        u = theta/alpha, du/d(pt) and du/d(omega t); the second half is the first one mirrored.
    excitation
        Base acceleration in units of alpha g.
    amplitude, frequency_ratio, restitution, order, branch
        Which steady state it is.
    verdict
        "stable", "neutral", "unstable", "grazes", or "inadmissible".
    model
        Which equations of motion hold: `Linear` or `Nonlinear`.
    """

    tau: Floats
    angle: Floats
    velocity: Floats
    velocity_tau: Floats
    excitation: Floats
    amplitude: float
    frequency_ratio: float
    restitution: float
    order: int
    branch: int
    verdict: str
    model: Model = field(default_factory=Linear)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return one row per sample."""
        import pandas as pd

        names = ("tau", "angle", "velocity", "velocity_tau", "excitation")
        return pd.DataFrame({name: getattr(self, name) for name in names})


@checked
def compute_steady_orbit(
    amplitude: float,
    frequency_ratio: float,
    restitution: float,
    *,
    order: int = 1,
    branch: int = 1,
    samples: Annotated[int, Whole(3, 999_999, "give an odd number, as 801")] = 801,
) -> SteadyOrbit:
    """Return one period of a symmetric steady state, admissible or not (eqs 7, 8, 14, 15).

    Parameters
    ----------
    amplitude, frequency_ratio, restitution, order
        As for `steady_states`, one number each.
    branch
        1 or 2.
    samples
        Number of equally spaced times, odd so that the impact in the middle is one of them; 3 or
        more.

    Returns
    -------
    SteadyOrbit
        Arrays of shape (samples,) over tau = omega t from 0 to 2 n pi.

    Raises
    ------
    InputError
        If a value is outside its range, or there is no solution.

    Examples
    --------
    >>> orbit = compute_steady_orbit(2.0, 4.0, 0.8)
    >>> print(f"{orbit.angle.max():.5f} {orbit.angle.min():.5f}")
    0.18550 -0.18550
    """
    for name, value in (
        ("amplitude", amplitude),
        ("frequency_ratio", frequency_ratio),
        ("restitution", restitution),
    ):
        finite(name, value, hint="give one number")
    order = order_of_orbit(order)
    which = validated_branch("branch", branch)
    if samples % 2 == 0:
        raise InputError(
            "samples",
            samples,
            "it must be odd, so that the impact in the middle is a sample",
            "give an odd number, as 801",
        )
    states = steady_states(amplitude, frequency_ratio, restitution, order=order)
    if states.region == 4:
        raise InputError(
            "amplitude",
            amplitude,
            f"a symmetric steady state needs {float(states.existence):.6g} or above (eq 23)",
            "raise the amplitude, or lower the frequency ratio",
        )
    return orbit_of(states, which, samples)


def orbit_of(states: SteadyStates, branch: int, samples: int = 801) -> SteadyOrbit:
    """Return one period of a steady state at the only point of a grid, admissible or not.

    Parameters
    ----------
    states
        With shapes, and with a state.
    branch, samples
        As for `compute_steady_orbit`.
    """
    a, w, r = (x.item() for x in (states.amplitude, states.frequency_ratio, states.restitution))
    n, which, amplitude = states.order.item(), branch - 1, resolved(states.amplitude).item()
    half, length = (samples + 1) // 2, n * math.pi
    tau = np.linspace(0.0, length, half)
    phase = states.phase[which].item()
    if states.block is not None and isinstance(states.model, Nonlinear):
        given = amplitude, w, r, states.block.positive.alpha, float(n)
        motion = compute_course(given, phase, tau / w)
    else:
        orbit = symmetric_orbit(amplitude, w, r, n, branch)
        motion = np.empty((2, half))
        fill_half_cycle(amplitude, w, n, orbit, tau / w, motion)
    angle = np.concatenate([motion[0], -motion[0, 1:]])
    velocity = np.concatenate([motion[1], -motion[1, 1:]])
    tau = np.concatenate([tau, length + tau[1:]])
    assert states.admissible is not None
    return SteadyOrbit(
        tau=tau,
        angle=angle,
        velocity=velocity,
        velocity_tau=velocity / w,
        excitation=a * sin(tau + phase),
        amplitude=a,
        frequency_ratio=w,
        restitution=r,
        order=n,
        branch=branch,
        verdict=verdict(
            admissible=states.admissible[which].item(),
            neutral=states.neutral[which].item(),
            stable=None if math.isnan(states.trace[which].item()) else states.stable[which].item(),
        ),
        model=states.model,
    )
