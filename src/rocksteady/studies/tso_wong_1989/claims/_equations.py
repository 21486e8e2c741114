"""Statements on the equations of motion and their closed solution (pages 90 to 93)."""

import math

import numpy as np

from rocksteady import Block, DimensionlessBlock, Harmonic, State, simulate
from rocksteady.errors import InputError
from rocksteady.formulas import steady_states
from rocksteady.kernels.elementary.arrays import atan2, cos, hypot, log, sin, tanh
from rocksteady.studies.tso_wong_1989.claims._solutions import (
    LONGEST,
    differing,
    followable,
    landed,
)
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.claims.findings import Finding
from rocksteady.studies.tso_wong_1989.figures.words import scientific, signed
from rocksteady.sweeps import Grid, Output, evaluate

STATEMENTS = Statements()

ROUNDING = 1e-9
"""Relative difference up to which two computed numbers count as equal; they agree far better."""


@STATEMENTS.add(
    "uplift",
    "The base acceleration αg is just what lifts a block from rest, so A measures the shaking.",
    page=91,
)
def uplift(_: Evidence) -> Finding:
    """Shake a block at rest with A just below, at and just above 1."""
    amplitudes = (0.999, 1.0, 1.001)
    peaks = [
        simulate(
            DimensionlessBlock(restitution=0.8), Harmonic(amplitude=a, frequency_ratio=2.0)
        ).peak
        for a in amplitudes
    ]
    words = ", ".join(f"{peak:.3g} at A = {a:g}" for a, peak in zip(amplitudes, peaks, strict=True))
    return Finding(
        holds=peaks[0] == peaks[1] == 0.0 < peaks[2],
        detail=f"Largest θ/α of a block shaken from rest for 50 periods (Ω = 2, δ = 0.8): {words}.",
        values={"amplitude": amplitudes, "peak": peaks},
    )


@STATEMENTS.add(
    "eq-4-5",
    "With (7) and (8) the linear equations of motion (4) and (5) are solved in closed form.",
    page=91,
)
def linear_equations(_: Evidence) -> Finding:
    """Differentiate a run numerically and put it into the equations."""
    run = simulate(
        DimensionlessBlock(restitution=0.8),
        Harmonic(amplitude=2.0, frequency_ratio=3.0, phase=0.3),
        start=State(angle=0.1, velocity=0.0),
        cycles=40,
    )
    step = 1e-4
    flights = run.flights
    long = flights.duration > 0.1
    s = (flights.pt + 0.5 * flights.duration)[long]
    side = flights.side[long]
    ahead, here, behind = run(s + step), run(s), run(s - step)
    velocity = (ahead.angle - behind.angle) / (2.0 * step)
    acceleration = (ahead.velocity - behind.velocity) / (2.0 * step)
    base = 2.0 * sin(3.0 * s + 0.3)
    worst = max(
        float(np.abs(velocity - here.velocity).max()),
        float(np.abs(acceleration - (here.angle - side + base)).max()),
    )
    return Finding(
        holds=worst < 1e-6,
        detail=f"In the middle of {len(s)} flights of a run (A = 2, Ω = 3, δ = 0.8), "
        f"differentiated numerically, the equations are met within {scientific(worst)}; the "
        "differences are those of the differentiation.",
        values={"flights": len(s), "largest_residual": worst},
    )


@STATEMENTS.add(
    "eq-9",
    "At an impact the angular velocity is reduced by the factor δ (9).",
    page=91,
)
def impact_law(_: Evidence) -> Finding:
    """Read the velocity on both sides of every impact of a run."""
    restitution = 0.8
    run = simulate(
        DimensionlessBlock(restitution=restitution),
        Harmonic(amplitude=2.0, frequency_ratio=3.0),
        start=State(angle=0.1, velocity=0.0),
        cycles=40,
    )
    instant = 1e-9
    s = run.impacts.pt[1:-1]
    ratio = run(s + instant).velocity / run(s - instant).velocity
    worst = float(np.abs(ratio - restitution).max())
    return Finding(
        holds=worst < 1e-6,
        detail=f"Over {len(s)} impacts of a run (A = 2, Ω = 3, δ = {restitution}) the velocity "
        f"just after over that just before differs from δ by at most {scientific(worst)}.",
        values={"impacts": len(s), "largest_difference": worst},
    )


@STATEMENTS.add(
    "E4",
    "Symmetric steady motions have half periods of nπ with n = 1, 2, 3, ...",
    page=91,
)
def odd_orders(_: Evidence) -> Finding:
    """Start on the algebra's solution for n = 1 to 4 and see whether the next half mirrors it."""
    a, w, r = 2.0, 4.0, 0.8
    defects = {}
    for n in (1, 2, 3, 4):
        phase, velocity_tau = _algebra(a, w, r, n)
        run = simulate(
            DimensionlessBlock(restitution=r),
            Harmonic(amplitude=a, frequency_ratio=w, phase=phase),
            start=State.per_tau(angle=0.0, velocity_tau=velocity_tau, frequency_ratio=w),
            cycles=n,
        )
        tau = np.linspace(0.0, n * math.pi, 400)
        later = np.minimum(tau + n * math.pi, run.end_time_pt * w)
        defects[n] = float(np.abs(run.at_tau(later).angle + run.at_tau(tau).angle).max())
    mirrored = [n for n, defect in defects.items() if defect < 1e-6]
    refused = []
    for n in defects:
        try:
            steady_states(a, w, r, order=n)
        except InputError:
            refused.append(n)
    words = ", ".join(f"{scientific(defect)} for n = {n}" for n, defect in defects.items())
    return Finding(
        holds=mirrored == list(defects),
        detail="After nπ the mirrored half cycle needs the mirrored shaking, sin(τ + nπ) = −sin τ: "
        "n must be odd. Started on the solution of (19), (21), (22) at A = 2, Ω = 4, δ = 0.8, the "
        f"second half differs from the mirrored first by up to {words}. The package refuses "
        f"n = {', '.join(map(str, refused))}.",
        values={"largest_defect": list(defects.values()), "mirrored": mirrored},
    )


def _algebra(a: float, w: float, r: float, n: int) -> tuple[float, float]:
    """Return phase and du/d(omega t) of branch 1 by (19), (21), (22) as printed, for any n."""
    h = tanh(0.5 * n * math.pi / w)
    d = (1.0 - r) / (1.0 + r)
    beta = a / (1.0 + w * w)
    p, q = d * h * w, d * h * h / beta
    root = math.sqrt(1.0 + p * p - q * q)
    phase = atan2((q + p * root) / (1.0 + p * p), (q * p - root) / (1.0 + p * p))
    velocity = -(beta * sin(phase) / h - h) / w - beta * cos(phase)
    return phase, velocity


@STATEMENTS.add(
    "eq-10-13",
    "A motion that starts with u = 0 and the velocity and phase of (19), (21), (22) is back on the "
    "floor after nπ with its velocity over δ: a symmetric steady motion (10 to 13).",
    page=92,
)
def steady_conditions(evidence: Evidence) -> Finding:
    """March from the closed form's solutions to their first impact."""
    solutions = followable(evidence.sample.states)
    landings = evaluate(
        landed,
        Grid(axes=(solutions,)),
        (
            Output(name="late", long_name="delay of the first impact times velocity"),
            Output(name="fast", long_name="relative error of the velocity before it"),
        ),
    )
    late, fast = (float(landings[name].values.max()) for name in ("late", "fast"))
    return Finding(
        holds=late < 1e-8 and fast < 1e-8,
        detail=f"From {len(solutions)} admissible solutions at random points (both branches, "
        f"n = 1, 3, 5, half cycles up to pt = {LONGEST:g}) the exact march lands at τ = nπ, with a "
        f"delay that times the velocity is at most {scientific(late)}, and with the velocity −v/δ "
        f"within {scientific(fast)} of it.",
        values={
            "solutions": len(solutions),
            "largest_delay": late,
            "largest_velocity_error": fast,
        },
    )


@STATEMENTS.add(
    "eq-14-17",
    "From u = 0 and the velocity after impact follow a⁺ and b⁺ (14, 15), and with them the motion "
    "(7) over the whole half cycle (12, 13 become 16, 17).",
    page=92,
)
def constants(evidence: Evidence) -> Finding:
    """Evaluate (7) with (14), (15) over half cycles, and compare with the package's orbits."""
    solutions = followable(evidence.sample.states)
    apart = Output(name="apart", long_name="largest difference of theta/alpha")
    worst = float(evaluate(differing, Grid(axes=(solutions,)), (apart,))["apart"].values.max())
    return Finding(
        holds=worst < 1e-10,
        detail=f"Over the half cycles of {len(solutions)} admissible solutions at random points "
        f"(half cycles up to pt = {LONGEST:g}), 101 times each, (7) with (14) and (15) differs "
        f"from the package's orbit, which is made from both of its ends, by at most "
        f"{scientific(worst)}, and so is 0 at the end (16).",
        values={"solutions": len(solutions), "difference": worst},
    )


@STATEMENTS.add(
    "eq-18-19",
    "Conditions (12) and (13) give the starting velocity in two ways, (18) and (19).",
    page=92,
)
def two_velocities(evidence: Evidence) -> Finding:
    """Put both phases into both expressions, and compare with the package."""
    sample = evidence.sample
    states, exists = sample.states, sample.exists
    w = states.frequency_ratio
    sine, cosine = sin(states.phase), cos(states.phase)
    ratio = sample.beta * sine / sample.tanh
    by_18 = states.restitution * ((ratio + sample.tanh) / w - sample.beta * cosine)
    by_19 = -(ratio - sample.tanh) / w - sample.beta * cosine
    scale = sample.beta + sample.tanh / w
    apart = float((np.abs(by_18 - by_19) / scale)[:, exists].max())
    package = float((np.abs(states.velocity_tau - by_19) / scale)[:, exists].max())
    return Finding(
        holds=apart < ROUNDING and package < ROUNDING,
        detail=f"At {int(exists.sum())} random points, both branches, (18) and (19) differ by at "
        f"most {scientific(apart)} of their terms, and the velocity of the package from (19) by "
        f"{scientific(package)}. The scan of (18) is not legible; it is derived in "
        "docs/theory/steady.md.",
        values={"points": int(exists.sum()), "difference": apart, "package": package},
    )


@STATEMENTS.add(
    "eq-20-22",
    "The phase solves P cos φ + sin φ = Q (20); the signs of (21) and (22) go together, and there "
    "are two solutions.",
    page=93,
)
def paired_signs(evidence: Evidence) -> Finding:
    """Check both pairings of the signs."""
    sample = evidence.sample
    states, exists = sample.states, sample.exists
    p, q, root = sample.p[exists], sample.q[exists], sample.root[exists]
    phase = states.phase[:, exists]
    worst = float((np.abs(p * cos(phase) + sin(phase) - q) / (1.0 + p)).max())
    # Where the radical or P is next to 0 the wrong pairing is next to the right one.
    clear = p * root > 1e-3
    sine, cosine = (q + p * root) / (1.0 + p * p), (q * p + root) / (1.0 + p * p)
    wrong = float(np.abs(sine * sine + cosine * cosine - 1.0)[clear & (q > 1e-3)].min())
    distinct = float(np.abs(phase[0] - phase[1]).min())
    return Finding(
        holds=worst < 1e-8 and wrong > 0.0 and distinct > 0.0,
        detail=f"At {int(exists.sum())} random points both phases meet (20) within "
        f"{scientific(worst)}. With the signs of (21) and (22) paired the other way "
        f"sin² φ + cos² φ differs from 1 by at least {scientific(wrong)}. The two phases are never "
        f"closer than {scientific(distinct)}.",
        values={"residual": worst, "wrong_pairing": wrong, "closest_phases": distinct},
    )


@STATEMENTS.add(
    "eq-23",
    "Solutions exist exactly where P² + 1 > Q², which is the least amplitude (23).",
    page=93,
)
def existence(evidence: Evidence) -> Finding:
    """Compare the radicand with the boundary on amplitudes around it."""
    sample = evidence.sample
    radicand = sample.p * sample.p + 1.0 - sample.q * sample.q
    by_amplitude = sample.states.amplitude > sample.states.existence
    agree = int(((radicand > 0.0) == by_amplitude).sum())
    count = len(radicand)
    return Finding(
        holds=agree == count,
        detail=f"At {agree} of {count} random points the radicand is positive where, and only "
        "where, A exceeds (23).",
        values={"points": count, "agree": agree},
    )


@STATEMENTS.add(
    "eq-6-26-27",
    "p depends on size and mass distribution and not on mass: p² = gR/(R_g² + R²) (26), for a "
    "homogeneous rectangle 3g/4R (27), so that p falls with the square root of the size.",
    page=98,
)
def frequency_parameter(_: Evidence) -> Finding:
    """Build blocks of several masses and sizes."""
    gravity = 9.80665
    half_width, half_height = 0.2, 1.0
    radius = hypot(half_width, half_height)
    by_mass = []
    for mass in (1.0, 50.0, 2000.0):
        inertia = mass * 4.0 / 3.0 * radius * radius
        block = Block.general(
            mass=mass,
            inertia=inertia,
            radius=radius,
            alpha=atan2(half_width, half_height),
            restitution=0.8,
            gravity=gravity,
        )
        by_mass.append(block.p)
    gyration = radius / math.sqrt(3.0)
    eq26 = math.sqrt(gravity * radius / (gyration * gyration + radius * radius))
    eq27 = math.sqrt(3.0 * gravity / (4.0 * radius))
    sizes = (1.0, 4.0, 9.0)
    scaled = [
        Block.rectangle(width=0.4 * size, height=2.0 * size, restitution=0.8, gravity=gravity).p
        for size in sizes
    ]
    spread = max(abs(value - eq27) for value in (*by_mass, eq26, scaled[0]))
    power = log(scaled[-1] / scaled[0]) / log(sizes[-1])
    return Finding(
        holds=spread < 1e-12 and abs(power + 0.5) < 1e-12,
        detail=f"A homogeneous block 0.4 m by 2 m has p = {eq27:.6f} rad/s by (26), by (27) and "
        f"as built with masses of 1, 50 and 2000 kg (differences to {scientific(spread)}). Scaled "
        f"to 9 times its size, p goes with the power {signed(power, '.6f')} of the size.",
        values={"p": by_mass, "eq26": eq26, "eq27": eq27, "power": power},
    )
