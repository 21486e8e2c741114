"""Statements of the parametric study (pages 89, 95 to 98, 105)."""

import math

import numpy as np
from numpy.typing import NDArray

from rocksteady import Block, response_curve, steady_states
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.findings import Finding
from rocksteady.studies.tso_wong_1989.responses import RESTITUTIONS, Responses
from rocksteady.studies.tso_wong_1989.words import series

STATEMENTS = Statements()

Floats = NDArray[np.float64]


def peaks_at(response: Responses, x: float) -> Floats:
    """Return the peak of each curve at the abscissa nearest to `x`; nan where there is none."""
    found = []
    for curve in response.curves:
        axis = curve.frequency_hz if response.hertz else curve.frequency_ratio
        assert axis is not None
        found.append(float(curve.peak[int(np.argmin(np.abs(axis - x)))]))
    return np.array(found)


@STATEMENTS.add(
    "no-resonance",
    "The peak grows as the frequency falls, for the harmonic motion and the 1/3 subharmonic; there "
    "is no resonance peak.",
    page=98,
    figures=("5a", "5b"),
)
def no_resonance(evidence: Evidence) -> Finding:
    """Look for a place where a curve rises with frequency."""
    rising: dict[str, int] = {}
    points = 0
    for name in ("5a", "5b"):
        for curve in evidence.responses[name].curves:
            steps = np.diff(curve.peak)
            known = np.isfinite(steps)
            points += int(known.sum())
            if (steps[known] >= 0.0).any():
                rising[name] = rising.get(name, 0) + int((steps[known] >= 0.0).sum())
    return Finding(
        holds=not rising,
        detail=f"Along the 12 curves of Figs 5a and 5b, {points} steps of .01 in Ω, the peak rises "
        f"with frequency at {sum(rising.values())}.",
        values={"steps": points, "rising": rising},
    )


@STATEMENTS.add(
    "less-than-proportional",
    "The peak does not grow in proportion to the excitation.",
    page=98,
    figures=("5a", "5b"),
)
def less_than_proportional(evidence: Evidence) -> Finding:
    """Compare the growth of the peak with that of the amplitude."""
    parts, holds = [], True
    values = {}
    for name, ratio in (("5a", 4.0), ("5a", 8.0), ("5b", 9.0)):
        peaks = peaks_at(evidence.responses[name], ratio)
        known = np.flatnonzero(np.isfinite(peaks))
        first, last = int(known[0]), int(known[-1])
        growth = float(peaks[last] / peaks[first])
        amplitudes = evidence.responses[name].values
        increase = amplitudes[last] / amplitudes[first]
        holds = holds and growth < increase
        values[f"{name} at {ratio:g}"] = growth
        parts.append(
            f"Fig. {name}, Ω = {ratio:g}: {series(peaks, '.5f')}, {growth:.2f}-fold from "
            f"A = {amplitudes[first]:g} to {amplitudes[last]:g}, where A grows {increase:g}-fold"
        )
    return Finding(holds=holds, detail=". ".join(parts) + ".", values=values)


@STATEMENTS.add(
    "curves-end",
    "The curves of the 1/3 subharmonic for A = 1 and A = 2 end at a certain frequency, beyond "
    "which there is no such motion.",
    page=98,
    figures=("5b",),
)
def curves_end(evidence: Evidence) -> Finding:
    """Find the last frequency of each curve and compare with eq 23."""
    from scipy.optimize import brentq

    from rocksteady import boundaries

    ends = {}
    for value, curve in zip(
        evidence.responses["5b"].values, evidence.responses["5b"].curves, strict=True
    ):
        there = np.isfinite(curve.peak)
        if not there[-1]:

            def excess(ratio: float, amplitude: float = value) -> float:
                return float(boundaries(ratio, 0.8, order=3).existence) - amplitude

            last = float(curve.frequency_ratio[there][-1])
            ends[value] = (last, float(brentq(excess, 1.0, 16.0)))
    words = ", ".join(f"A = {value:g} at Ω = {exact:.4f}" for value, (_, exact) in ends.items())
    near = all(0.0 <= exact - last <= 0.0101 for last, exact in ends.values())
    return Finding(
        holds=sorted(ends) == [1.0, 2.0] and near,
        detail=f"Within the axis these curves end: {words}, where (23) reaches the amplitude.",
        values={f"A={value:g}": exact for value, (_, exact) in ends.items()},
    )


@STATEMENTS.add(
    "grows-with-p",
    "At a given frequency in Hz the peak grows with p.",
    page=98,
    figures=("6a", "6b"),
)
def grows_with_p(evidence: Evidence) -> Finding:
    """Compare the curves of Fig 6 at the frequencies that several reach."""
    rows, holds = [], True
    for name in ("6a", "6b"):
        for hertz in (6.0, 10.0, 14.0):
            peaks = peaks_at(evidence.responses[name], hertz)
            known = peaks[np.isfinite(peaks)]
            holds = holds and len(known) > 1 and bool((np.diff(known) > 0.0).all())
            rows.append(f"Fig. {name}, {hertz:g} Hz: {series(peaks, '.5f')}")
    return Finding(
        holds=holds,
        detail="Peaks for p = π/2, π, 2π, 4π rad/s. " + ". ".join(rows) + ".",
    )


@STATEMENTS.add(
    "larger-block",
    "Of two blocks of one shape and restitution under one excitation the larger always responds "
    "with the smaller amplitude.",
    page=89,
    figures=("6a", "6b"),
)
def larger_block(_: Evidence) -> Finding:
    """Scale a block, in stable out-of-phase motion under one shaking in SI units."""
    sizes = np.array([0.5, 1.0, 2.0, 4.0, 8.0])
    alpha = 0.2
    worst = -math.inf
    compared = 0
    for order in (1, 3):
        for amplitude in (1.5, 3.0, 6.0):
            hertz = np.linspace(0.3, 16.0, 158)
            peaks = np.array(
                [
                    response_curve(
                        Block.from_radius(alpha=alpha, radius=float(size), restitution=0.8),
                        amplitude,
                        frequency_hz=hertz,
                        order=order,
                    ).peak
                    for size in sizes
                ]
            )
            ratio = peaks[1:] / peaks[:-1]
            known = np.isfinite(ratio)
            compared += int(known.sum())
            worst = max(worst, float(ratio[known].max()))
    return Finding(
        holds=worst < 1.0,
        detail=f"Half-diagonals from 0.5 to 8 m, α = 0.2 rad, δ = 0.8, A = 1.5, 3 and 6, n = 1 and "
        f"3, 0.3 to 16 Hz: in all {compared} comparisons of two sizes in the same motion, the "
        f"larger block's peak is the smaller, at most {worst:.4f} of the other's. (Which motion a "
        "block settles to is another question: where several coexist a larger block may be in a "
        "larger one.)",
        values={"comparisons": compared, "largest_ratio": worst},
    )


@STATEMENTS.add(
    "insensitive-to-restitution",
    "The peak is insensitive to the restitution from 0.7 to 1, for harmonic motion above all.",
    page=98,
    figures=("7a", "7b"),
)
def insensitive_to_restitution(evidence: Evidence) -> Finding:
    """Compare the spread of the curves of Fig 7."""
    spreads = {}
    rows = []
    for name in ("7a", "7b"):
        for ratio in (4.0, 6.0, 10.0):
            peaks = peaks_at(evidence.responses[name], ratio)
            spreads[name, ratio] = float((peaks.max() - peaks.min()) / peaks.mean())
            rows.append(
                f"Fig. {name}, Ω = {ratio:g}: {series(peaks, '.5f')} "
                f"(spread {spreads[name, ratio]:.1%})"
            )
    less = all(spreads["7a", ratio] < spreads["7b", ratio] for ratio in (4.0, 6.0, 10.0))
    damping = [(1.0 - r) / (1.0 + r) for r in RESTITUTIONS]
    return Finding(
        holds=less and max(spreads["7a", ratio] for ratio in (4.0, 6.0, 10.0)) < 0.1,
        detail="Peaks at A = 3 for δ = 0.7, 0.8, 0.9, 1. "
        + ". ".join(rows)
        + f". The damping parameter D meanwhile goes from {damping[0]:.3f} to 0.",
        values={f"Fig. {name} at {ratio:g}": spread for (name, ratio), spread in spreads.items()},
    )


@STATEMENTS.add(
    "restitution-trend",
    "With growing restitution the peak of the harmonic motion grows, and that of the 1/3 "
    "subharmonic falls.",
    page=98,
    figures=("7a", "7b"),
)
def restitution_trend(evidence: Evidence) -> Finding:
    """Follow both trends along the whole of the stable curves."""
    found = {}
    for name, direction in (("7a", 1.0), ("7b", -1.0)):
        curves = evidence.responses[name].curves
        peaks = np.array([curve.peak for curve in curves])
        stable = np.array([curve.stable for curve in curves[:-1]]).all(axis=0)
        steps = direction * np.diff(peaks, axis=0)[:, stable]
        found[name] = (int((steps > 0.0).all(axis=0).sum()), int(stable.sum()))
    return Finding(
        holds=all(right == total for right, total in found.values()),
        detail="Over all frequencies of the axis at which the motions with δ = 0.7, 0.8 and 0.9 "
        f"are stable, the peak rises with δ for n = 1 at {found['7a'][0]} of {found['7a'][1]}, and "
        f"falls for n = 3 at {found['7b'][0]} of {found['7b'][1]}.",
        values=dict(found),
    )


@STATEMENTS.add(
    "sensitivities",
    "The peak is highly sensitive to the system frequency p and to the excitation frequency, and "
    "relatively insensitive to the excitation amplitude and to the restitution.",
    page=98,
    figures=("5a", "5b", "6a", "6b", "7a", "7b"),
)
def sensitivities(_: Evidence) -> Finding:
    """Compute elasticities: the percentage by which the peak changes for one percent."""
    step = 1e-4
    rows, holds = [], True
    values = {}
    for order, ratio in ((1, 3.0), (1, 6.0), (3, 6.0), (3, 9.0)):
        point = {"amplitude": 3.0, "frequency_ratio": ratio, "restitution": 0.8}
        elastic = {}
        for name, value in point.items():
            ends = []
            for factor in (1.0 - step, 1.0 + step):
                moved = {**point, name: value * factor}
                states = steady_states(
                    moved["amplitude"],
                    moved["frequency_ratio"],
                    moved["restitution"],
                    order=order,
                )
                assert states.peak is not None
                ends.append(math.log(float(states.peak[0])))
            elastic[name] = (ends[1] - ends[0]) / (2.0 * step)
        frequency = abs(elastic["frequency_ratio"])
        others = max(abs(elastic["amplitude"]), abs(elastic["restitution"]))
        holds = holds and frequency > 2.0 * others
        values[f"n={order}, Omega={ratio:g}"] = elastic
        rows.append(
            f"n = {order}, Ω = {ratio:g}: p {-elastic['frequency_ratio']:+.2f}, excitation "
            f"frequency {elastic['frequency_ratio']:+.2f}, A {elastic['amplitude']:+.2f}, δ "
            f"{elastic['restitution']:+.2f}"
        )
    return Finding(
        holds=holds,
        detail="Percent by which the peak changes for one percent of each, around A = 3, δ = 0.8. "
        + "; ".join(rows).replace("-", "−")
        + ".",
        values=values,
    )
