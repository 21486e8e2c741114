"""Statement that the equations may be linearised for slender blocks (page 91)."""

import numpy as np

from rocksteady import Block, Harmonic, Nonlinear, Steady, simulate
from rocksteady.formulas import steady_states
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.claims.findings import Finding

STATEMENTS = Statements()

SLENDERNESSES = (0.05, 0.1, 0.2, 0.3)
"""alpha [rad] of the blocks that are followed by the full equations."""

POINT = (2.0, 4.0, 0.8)
"""Amplitude, frequency ratio and restitution."""

CYCLES = 10
"""Forcing periods; the motion is stable and begins on its orbit."""


@STATEMENTS.add(
    "slender",
    "For slender blocks the critical angle is small, and sine and cosine may be linearised.",
    page=91,
)
def slender(_: Evidence) -> Finding:
    """Compare the steady motion by the full equations (1), (2) with that by the linear ones."""
    amplitude, ratio, restitution = POINT
    states = steady_states(amplitude, ratio, restitution)
    assert states.peak is not None
    linear = float(states.peak[0])
    peaks = {alpha: peak_by_full_equations(alpha) for alpha in SLENDERNESSES}
    errors = {alpha: abs(peak / linear - 1.0) for alpha, peak in peaks.items()}
    # Of order alpha^2: the same factor of it for all, and a few percent at most.
    factors = [error / (alpha * alpha) for alpha, error in errors.items()]
    spread = max(factors) / min(factors)
    largest = max(errors.values())
    listed = ", ".join(
        f"{peaks[alpha]:.5f} at α = {alpha:g} rad ({errors[alpha]:.2%})" for alpha in SLENDERNESSES
    )
    return Finding(
        holds=spread < 1.1 and largest < max(SLENDERNESSES) * max(SLENDERNESSES),
        detail=f"The paper states no error. At A = {amplitude:g}, Ω = {ratio:g}, δ = "
        f"{restitution:g}, n = 1 the full equations (1), (2) give a peak θ/α of {listed}, and the "
        f"linear ones {linear:.5f}: the difference is {np.mean(factors):.2f} α² of the peak.",
        values={"linear": linear, "peaks": [peaks[alpha] for alpha in SLENDERNESSES]},
    )


def peak_by_full_equations(alpha: float) -> float:
    """Return the peak of |theta|/alpha of the steady motion of a block of some slenderness."""
    amplitude, ratio, restitution = POINT
    block = Block.from_p(alpha=alpha, p=2.0, restitution=restitution)
    motion = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
    run = simulate(block, motion, start=Steady(), cycles=CYCLES, model=Nonlinear())
    return run.peak
