"""Statements on transitions as frequency falls, Figs 12 and 13 (pages 89, 101 to 105)."""

import math
from collections import Counter
from dataclasses import dataclass
from functools import cache

import numpy as np

from rocksteady import DimensionlessBlock, Harmonic, State, Steady, map_attractors
from rocksteady.formulas import steady_states, symmetry_breaking_frequencies
from rocksteady.orbits import Orbit
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.claims.findings import Finding
from rocksteady.studies.tso_wong_1989.figures.cases import RESTITUTION
from rocksteady.studies.tso_wong_1989.figures.fates import Fate, Kind, kinds_in, settle
from rocksteady.studies.tso_wong_1989.figures.histories import History
from rocksteady.studies.tso_wong_1989.figures.words import multiplier_text, series, signed

STATEMENTS = Statements()

AMPLITUDE = 2.0
"""Of Figs 12 and 13."""
STEP = 0.005
"""In Omega, of the way down from symmetry breaking."""


@dataclass(frozen=True, kw_only=True)
class Descent:
    """What an unsymmetric motion becomes as the frequency falls in small steps.

    Attributes
    ----------
    symmetric_from
        Omega of symmetry breaking, above which the symmetric motion is stable.
    doubled_from
        First Omega at which the unsymmetric motion of the same period was found no more.
    gone_from
        First Omega at which the block had left for another motion, or overturned.
    then
        What it became there.
    """

    symmetric_from: float
    doubled_from: float
    gone_from: float
    then: Fate


@cache
def descent(order: int) -> Descent:
    """Follow the unsymmetric motion down from symmetry breaking, each run from the last state."""
    breaking = float(symmetry_breaking_frequencies(AMPLITUDE, RESTITUTION, order=order)[-1])
    ratio = math.floor(breaking / STEP) * STEP - STEP
    fate = settle(
        RESTITUTION,
        Harmonic(amplitude=AMPLITUDE, frequency_ratio=ratio),
        Steady(order=order, kick=0.01),
    )
    assert fate.orbit is not None
    doubled, orbit = math.nan, fate.orbit
    while True:
        ratio -= STEP
        fate = _followed(orbit, ratio)
        # The aperiodic motion that ends the cascade of doublings has no orbit to go on from.
        orbit = fate.orbit if fate.orbit is not None else orbit
        kin = fate.kind in (Kind.UNSYMMETRIC, Kind.SUBHARMONIC) and fate.period % order == 0
        same = fate.kind is Kind.UNSETTLED or (kin and not fate.symmetric)
        if math.isnan(doubled) and fate.period != order:
            doubled = ratio
        if not same:
            return Descent(
                symmetric_from=breaking, doubled_from=doubled, gone_from=ratio, then=fate
            )


def _followed(orbit: Orbit, ratio: float) -> Fate:
    """Return what a motion becomes at another frequency, with the velocity per tau that it has."""
    first = orbit.states[0]
    shaking = Harmonic(amplitude=AMPLITUDE, frequency_ratio=ratio, phase=first.phase)
    velocity = first.side * first.speed * ratio / orbit.motion.frequency_ratio
    return settle(RESTITUTION, shaking, State(angle=0.0, velocity=velocity))


@STATEMENTS.add(
    "asymmetry-grows",
    "The asymmetry of the harmonic motion increases as the frequency falls further.",
    page=105,
    figures=("12b", "12c"),
)
def asymmetry_grows(_: Evidence) -> Finding:
    """Follow the mean of the extrema over the unsymmetric range."""
    ratios = (1.94, 1.92, 1.9, 1.88, 1.86, 1.84, 1.82, 1.8)
    fates = map_attractors(
        DimensionlessBlock(restitution=RESTITUTION),
        axes={"amplitude": [AMPLITUDE], "frequency_ratio": ratios},
        start=Steady(kick=1e-4, side=-1),
    )
    highest, lowest = fates["highest"].values[0], fates["lowest"].values[0]
    offsets = (0.5 * np.abs(highest + lowest)).tolist()
    rising = bool((np.diff(offsets) > 0.0).all())
    return Finding(
        holds=rising and set(kinds_in(fates)) == {Kind.UNSYMMETRIC},
        detail="Middle between highest and lowest θ/α at Ω = "
        f"{series(ratios)}: {series(offsets, '.4f')}.",
        values={"frequency_ratio": ratios, "offset": offsets},
    )


@STATEMENTS.add(
    "no-subharmonic-at-3.6",
    "At A = 2, Ω = 3.6 no form of 1/3 subharmonic is stable.",
    page=105,
    figures=("13c",),
)
def no_subharmonic(_: Evidence) -> Finding:
    """Start from many states and see whether any run settles to a subharmonic."""
    ratio = 3.6
    velocities = np.linspace(-1.4, 1.4, 29)
    # Half a period is enough: the other half starts from the mirror images of these states.
    phases = np.linspace(0.0, math.pi, 32, endpoint=False)
    fates = map_attractors(
        DimensionlessBlock(restitution=RESTITUTION),
        Harmonic(amplitude=AMPLITUDE, frequency_ratio=ratio),
        axes={"phase": phases, "velocity": velocities},
    )
    counts = dict(Counter(kind.value for kind in kinds_in(fates)))
    total = len(velocities) * len(phases)
    words = ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items()))
    return Finding(
        holds=Kind.SUBHARMONIC.value not in counts and Kind.UNSETTLED.value not in counts,
        detail=f"Of {total} runs from the floor with {len(phases)} phases and {len(velocities)} "
        f"velocities (du/d(pt) to 1.4, δ = 0.8): {words}. A search, not a proof.",
        values={"fates": counts},
    )


@STATEMENTS.add(
    "transitions",
    "Leaving a steady motion ends in overturning in some instances, and in another steady motion, "
    "as from 1/3 subharmonic to harmonic, in others.",
    page=90,
    figures=("9b", "12d", "13c"),
)
def ways_out(evidence: Evidence) -> Finding:
    """Count the motions that are always left for overturning, and always for another motion."""
    always: dict[str, list[str]] = {}
    for name, history in evidence.histories.items():
        if history.stable:
            continue
        kinds = {fate.kind for fates in history.fates_over_kicks.values() for fate in fates}
        if len(kinds) == 1:
            always.setdefault(kinds.pop().value, []).append(name)
    falls = always.get(Kind.OVERTURNED.value, [])
    harmonic = always.get(Kind.SYMMETRIC.value, [])
    down = [name for name in harmonic if evidence.histories[name].case.order > 1]
    words = "; ".join(f"{kind} in Figs {', '.join(names)}" for kind, names in always.items())
    return Finding(
        holds=bool(falls) and bool(down),
        detail=f"Left from every distance and on both sides, the fate is always {words}; from a "
        f"1/3 subharmonic to a harmonic motion in {len(down)} of them.",
        values={"always": always},
    )


@STATEMENTS.add(
    "several-motions",
    "For one amplitude and frequency of the excitation a block can respond in several ways.",
    page=89,
    figures=("9c",),
)
def several_motions(_: Evidence) -> Finding:
    """Count stable symmetric motions of several orders at the points of the figures and others."""
    amplitude = np.linspace(0.5, 6.0, 56)[:, np.newaxis]
    ratio = np.linspace(1.0, 12.0, 111)
    stable = np.sum(
        [
            steady_states(amplitude, ratio, RESTITUTION, order=order).stable.any(axis=0)
            for order in (1, 3, 5)
        ],
        axis=0,
    )
    several = int((stable > 1).sum())
    here = [
        order
        for order in (1, 3)
        if steady_states(AMPLITUDE, 6.0, RESTITUTION, order=order).stable.any()
    ]
    return Finding(
        holds=several > 0,
        detail=f"On {several} of {stable.size} points (A 0.5 to 6, Ω 1 to 12, δ = 0.8) more than "
        f"one symmetric motion of n = 1, 3, 5 is stable, on {int((stable > 2).sum())} three are; "
        f"at A = 2, Ω = 6 those of n = {series(here)}. Up to A = 1 a block at rest stays there "
        "as well.",
        values={"several": several, "points": int(stable.size)},
    )


@STATEMENTS.add(
    "symmetry-breaking",
    "As the frequency falls past the boundary of stable symmetric motion, the motion becomes "
    "unsymmetric.",
    page=89,
    figures=("12a", "12b", "13a", "13b"),
)
def symmetry_breaking(_: Evidence) -> Finding:
    """Compute the boundary in closed form, the multiplier there, and runs on both sides of it."""
    rows, holds = [], True
    values = {}
    for order in (1, 3):
        boundary = float(symmetry_breaking_frequencies(AMPLITUDE, RESTITUTION, order=order)[-1])
        at = steady_states(AMPLITUDE, boundary, RESTITUTION, order=order)
        multiplier = complex(at.half_cycle_multipliers[0, 0])
        above, below = (
            settle(
                RESTITUTION,
                Harmonic(amplitude=AMPLITUDE, frequency_ratio=boundary + shift),
                Steady(order=order, kick=0.01),
            )
            for shift in (0.02, -0.02)
        )
        ok = above.symmetric and not below.symmetric and above.period == below.period == order
        holds = holds and ok
        values[f"n={order}"] = boundary
        rows.append(
            f"n = {order}: Ω = {boundary:.6f}, where a half-cycle multiplier is "
            f"{multiplier_text(multiplier)}; 0.02 above it {above.label}, 0.02 below "
            f"{below.label}"
        )
    return Finding(
        holds=holds,
        detail="The boundary at A = 2, δ = 0.8 in closed form. " + "; ".join(rows) + ".",
        values=values,
    )


@STATEMENTS.add(
    "beyond-unsymmetric",
    "When the frequency falls past the boundary of stable unsymmetric motion, the block overturns.",
    page=89,
    see=("12d", "13c", "13d"),
)
def beyond_unsymmetric(_: Evidence) -> Finding:
    """Follow both unsymmetric motions down to their end."""
    descents = {order: descent(order) for order in (1, 3)}
    words = "; ".join(
        f"n = {order}: found with {order} forcing period{'s' if order > 1 else ''} down to "
        f"Ω = {end.doubled_from + STEP:.3f}, gone at {end.gone_from:.3f}, where the run "
        f"{'becomes ' if end.then.kind is not Kind.OVERTURNED else ''}{end.then.label}"
        for order, end in descents.items()
    )
    return Finding(
        holds=all(end.then.kind is Kind.OVERTURNED for end in descents.values()),
        detail="So it is for the harmonic motion, not for the 1/3 subharmonic, which gives way to "
        "the stable harmonic one (as the paper's own Fig. 13c shows), and between the two the "
        f"unsymmetric motion doubles its period. In steps of {STEP} in Ω at A = 2, δ = 0.8: "
        f"{words}.",
        values={
            f"n={order}": {
                "symmetric_above": end.symmetric_from,
                "doubled_at": end.doubled_from,
                "gone_at": end.gone_from,
            }
            for order, end in descents.items()
        },
    )


@STATEMENTS.add(
    "narrow-range",
    "The frequency range of unsymmetric motions is very small against that of symmetric ones.",
    page=105,
    figures=("12b", "12c", "13b"),
)
def narrow_range(_: Evidence) -> Finding:
    """Compare the widths of both ranges on the paper's axis of Fig 5."""
    rows, holds = [], True
    values = {}
    axis_end = 16.0
    for order in (1, 3):
        result = descent(order)
        ratios = np.linspace(result.symmetric_from, axis_end, 4001)[1:]
        stable = steady_states(AMPLITUDE, ratios, RESTITUTION, order=order).stable[0]
        end = float(ratios[stable][-1])
        symmetric = end - result.symmetric_from
        unsymmetric = result.symmetric_from - result.gone_from
        holds = holds and unsymmetric < 0.1 * symmetric
        values[f"n={order}"] = (unsymmetric, symmetric)
        rows.append(
            f"n = {order}: unsymmetric over {unsymmetric:.3f} below Ω = "
            f"{result.symmetric_from:.4f}, symmetric from there to {end:.2f}"
            + (" (end of the axis)" if end == axis_end else "")
        )
    return Finding(holds=holds, detail="At A = 2, δ = 0.8. " + "; ".join(rows) + ".", values=values)


@STATEMENTS.add(
    "peak-to-peak",
    "The range from lowest to highest point of an unsymmetric motion is close to that of the "
    "symmetric motion that has lost its stability.",
    page=105,
    figures=("12b", "12c", "13b"),
)
def peak_to_peak(evidence: Evidence) -> Finding:
    """Compare both ranges where the figures have unsymmetric motions."""
    rows = []
    apart = []
    for name in ("12b", "12c", "13b"):
        history: History = evidence.histories[name]
        assert history.states.peak is not None
        fate = history.fates[-1]
        symmetric = 2.0 * float(history.states.peak[0])
        span = fate.highest - fate.lowest
        apart.append(abs(span / symmetric - 1.0))
        rows.append(
            f"Fig. {name}: {span:.5f} (from {signed(fate.lowest, '.5f')} to {fate.highest:.5f}) "
            f"against {symmetric:.5f}, {signed(span / symmetric - 1.0, '+.2%')}"
        )
    return Finding(
        holds=max(apart) < 0.1,
        detail="; ".join(rows) + ".",
        values={"relative_difference": apart},
    )
