"""Statements of the parametric study (pages 89, 95 to 98, 105)."""

import math

import numpy as np

from rocksteady import Block, compute_response_curve
from rocksteady.arrays import Floats
from rocksteady.formulas import steady_states
from rocksteady.kernels.elementary.arrays import log
from rocksteady.orbits import compute_region_boundaries
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.claims.findings import Finding
from rocksteady.studies.tso_wong_1989.figures.responses import RESTITUTION, RESTITUTIONS, Responses
from rocksteady.studies.tso_wong_1989.figures.words import series

STATEMENTS = Statements()


def peaks_at(response: Responses, x: float) -> Floats:
    """Return the peak of each curve at the abscissa nearest to `x`; nan where there is none."""
    peaks = []
    for curve in response.curves:
        axis = curve.frequency_hz if response.hertz else curve.frequency_ratio
        assert axis is not None
        peaks.append(float(curve.peak[int(np.argmin(np.abs(axis - x)))]))
    return np.array(peaks)


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
    """Find the last frequency of each curve and compare eq 23 there with the amplitude."""
    response = evidence.responses["5b"]
    ends, gaps = {}, {}
    for amplitude, curve in zip(response.values, response.curves, strict=True):
        places = np.flatnonzero(np.isfinite(curve.peak))
        if len(places) and places[-1] + 1 < len(curve.peak):
            last, beyond = curve.frequency_ratio[places[-1] : places[-1] + 2]
            ends[amplitude] = float(last)
            limits = compute_region_boundaries([last, beyond], RESTITUTION, order=3).existence
            gaps[amplitude] = bool(limits[0] <= amplitude < limits[1])
    words = ", ".join(f"A = {amplitude:g} at Ω = {end:.2f}" for amplitude, end in ends.items())
    return Finding(
        holds=sorted(ends) == [1.0, 2.0] and all(gaps.values()),
        detail=f"On the axis, in steps of 0.01, these curves end: {words or 'none'}; and there the "
        f"least amplitude (23) passes that of the curve at {sum(gaps.values())} of {len(gaps)}.",
        values={f"A={amplitude:g}": end for amplitude, end in ends.items()},
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
    see=("6a", "6b"),
)
def larger_block(_: Evidence) -> Finding:
    """Scale a block under one shaking in SI units, in one motion and across two stable ones."""
    sizes = np.array([0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0])
    hertz = np.linspace(0.3, 16.0, 158)
    worst, compared, other_motion, example = -math.inf, 0, 0, ""
    for amplitude in (1.5, 3.0, 6.0):
        peaks = {}
        for order in (1, 3):
            curves = [
                compute_response_curve(
                    Block.from_radius(alpha=0.2, radius=float(size), restitution=RESTITUTION),
                    amplitude,
                    frequency_hz=hertz,
                    order=order,
                    model="linear",
                )
                for size in sizes
            ]
            peaks[order] = np.array([np.where(c.stable, c.peak, math.nan) for c in curves])
            ratio = peaks[order][1:] / peaks[order][:-1]
            known = np.isfinite(ratio)
            compared += int(known.sum())
            worst = max(worst, float(ratio[known].max(initial=-math.inf)))
        # The next larger block in its stable 1/3 subharmonic, the smaller in its harmonic motion.
        above = np.argwhere(peaks[3][1:] > peaks[1][:-1])
        other_motion += len(above)
        if len(above) and not example:
            size, column = above[len(above) // 2]
            example = (
                f"at A = {amplitude:g} and {hertz[column]:.1f} Hz the block with a half-diagonal "
                f"of {sizes[size + 1]:g} m has a stable 1/3 subharmonic with peak "
                f"{peaks[3][size + 1, column]:.5f}, the one of {sizes[size]:g} m a stable harmonic "
                f"motion with {peaks[1][size, column]:.5f}"
            )
    text = (
        f"In the same motion, yes: half-diagonals from 0.5 to 8 m, α = 0.2 rad, δ = 0.8, A = 1.5, "
        f"3 and 6, 0.3 to 16 Hz, {compared} comparisons of stable motions of one order, and the "
        f"larger block's peak is at most {worst:.4f} of the other's."
    )
    if other_motion:
        text += (
            " Not always: where both motions are stable the larger block may be in the larger "
            f"one. So it is at {other_motion} of the points; {example}."
        )
    return Finding(
        holds=worst < 1.0 and other_motion == 0,
        detail=text,
        values={"comparisons": compared, "largest_ratio": worst, "other_motion": other_motion},
    )


@STATEMENTS.add(
    "low-frequency",
    "The peak is highly sensitive to the excitation frequency in the low frequency range.",
    page=89,
    figures=("5a", "5b"),
)
def low_frequency(evidence: Evidence) -> Finding:
    """Compare the slopes of the curves of Fig 5 at both ends of their stable part."""
    rows, holds = [], True
    values = {}
    for name in ("5a", "5b"):
        response = evidence.responses[name]
        for label, curve in zip(response.labels, response.curves, strict=True):
            stable = np.flatnonzero(curve.stable)
            if len(stable) < 100:  # too short a piece to have two ends
                continue
            slope = np.gradient(curve.peak[stable], curve.frequency_ratio[stable])
            low, high = abs(float(slope[1])), abs(float(slope[-2]))
            holds = holds and low > 2.0 * high
            values[f"Fig. {name}, {label}"] = (low, high)
            rows.append(
                f"Fig. {name}, {label}: −{low:.4f} at Ω = {curve.frequency_ratio[stable[1]]:.2f}, "
                f"−{high:.4f} at {curve.frequency_ratio[stable[-2]]:.2f}"
            )
    return Finding(
        holds=holds and bool(rows),
        detail="Slope of the peak over Ω at the lower and the upper end of each stable curve. "
        + "; ".join(rows)
        + ". Relative to the peak the sensitivity is nearly the same everywhere.",
        values=values,
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
    rises = {}
    for name, direction in (("7a", 1.0), ("7b", -1.0)):
        curves = evidence.responses[name].curves
        peaks = np.array([curve.peak for curve in curves])
        stable = np.array([curve.stable for curve in curves[:-1]]).all(axis=0)
        steps = direction * np.diff(peaks, axis=0)[:, stable]
        rises[name] = (int((steps > 0.0).all(axis=0).sum()), int(stable.sum()))
    return Finding(
        holds=all(right == total > 0 for right, total in rises.values()),
        detail="Over all frequencies of the axis at which the motions with δ = 0.7, 0.8 and 0.9 "
        f"are stable, the peak rises with δ for n = 1 at {rises['7a'][0]} of {rises['7a'][1]}, and "
        f"falls for n = 3 at {rises['7b'][0]} of {rises['7b'][1]}.",
        values=dict(rises),
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
                ends.append(log(float(states.peak[0])))
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
