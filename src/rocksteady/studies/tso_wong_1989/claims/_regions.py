"""Statements on phases, kinds and regions of solutions (pages 93 to 95, 105)."""

import math

import numpy as np

from rocksteady.formulas import steady_states
from rocksteady.orbits import compute_region_map
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements, drawn_between
from rocksteady.studies.tso_wong_1989.claims.findings import Finding
from rocksteady.studies.tso_wong_1989.figures.regions import FREQUENCIES, region_shares
from rocksteady.studies.tso_wong_1989.figures.words import percent, scientific, series

STATEMENTS = Statements()

RESTITUTIONS = (0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99)
"""Over which regions are followed; the paper draws .5 and .95."""


@STATEMENTS.add(
    "phase-1",
    "The phase of the first solution lies between 0 and π/2 if Q > 1, between π/2 and π if Q < 1.",
    page=93,
)
def first_phase(evidence: Evidence) -> Finding:
    """Count phases of branch 1 by quadrant."""
    sample = evidence.sample
    phase, exists = sample.states.phase[0], sample.exists
    above, below = exists & (sample.q > 1.0), exists & (sample.q < 1.0)
    right = int(((phase > 0.0) & (phase < 0.5 * math.pi))[above].sum())
    left = int(((phase > 0.5 * math.pi) & (phase < math.pi))[below].sum())
    return Finding(
        holds=bool(right == above.sum() and left == below.sum()),
        detail=f"So it is at {right} of {int(above.sum())} random points with Q > 1 and at {left} "
        f"of {int(below.sum())} with Q < 1.",
        values={"q_above_1": right, "q_below_1": left},
    )


@STATEMENTS.add(
    "phase-2",
    "The phase of the second solution lies between 0 and π/2 if P < Q, between −π/2 and 0 if "
    "P > Q.",
    page=93,
)
def second_phase(evidence: Evidence) -> Finding:
    """Count phases of branch 2 by quadrant."""
    sample = evidence.sample
    phase, exists = sample.states.phase[1], sample.exists
    below, above = exists & (sample.p < sample.q), exists & (sample.p > sample.q)
    right = int(((phase > 0.0) & (phase < 0.5 * math.pi))[below].sum())
    negative = int(((phase > -0.5 * math.pi) & (phase < 0.0))[above].sum())
    return Finding(
        holds=bool(right == below.sum() and negative == above.sum()),
        detail=f"So it is at {right} of {int(below.sum())} random points with P < Q and at "
        f"{negative} of {int(above.sum())} with P > Q.",
        values={"p_below_q": right, "p_above_q": negative},
    )


@STATEMENTS.add(
    "kinds",
    "There are either two in-phase solutions (Q > 1) or one in phase and one out of phase (Q < 1).",
    page=93,
)
def kinds(evidence: Evidence) -> Finding:
    """Count in-phase solutions."""
    sample = evidence.sample
    exists = sample.exists
    in_phase = sample.states.in_phase.sum(axis=0)
    two = int((in_phase == 2)[exists & (sample.q > 1.0)].sum())
    single = int((in_phase == 1)[exists & (sample.q < 1.0)].sum())
    total = int(exists.sum())
    return Finding(
        holds=two + single == total,
        detail=f"Of {total} random points with solutions {two} have two in-phase ones, all with "
        f"Q > 1, and {single} one of each kind, all with Q < 1; {total - two - single} are "
        "otherwise.",
        values={"two_in_phase": two, "one_of_each": single, "points": total},
    )


@STATEMENTS.add(
    "eq-24-25",
    "P ≥ Q means A ≥ h(1 + Ω²)/Ω (24), and Q ≤ 1 means A ≥ Dh²(1 + Ω²) (25).",
    page=93,
)
def boundaries_in_amplitude(evidence: Evidence) -> Finding:
    """Compare the inequalities with the boundaries of the package, and those with the formulae."""
    sample, states = evidence.sample, evidence.sample.states
    squared = 1.0 + np.square(states.frequency_ratio)
    sign = sample.tanh * squared / states.frequency_ratio
    kind = sample.damping * np.square(sample.tanh) * squared
    worst = float(
        max(np.abs(states.sign / sign - 1.0).max(), np.abs(states.kind / kind - 1.0).max())
    )
    agree = ((sample.p >= sample.q) == (states.amplitude >= states.sign)) & (
        (sample.q <= 1.0) == (states.amplitude >= states.kind)
    )
    return Finding(
        holds=bool(agree.all()) and worst < 1e-12,
        detail=f"Both hold at {int(agree.sum())} of {len(agree)} random points; the package's "
        f"boundaries equal the formulae within {scientific(worst)}. (The scan does not "
        "distinguish ≥ from ≤ here; these are the directions that hold.)",
        values={"agree": int(agree.sum()), "points": len(agree), "difference": worst},
    )


@STATEMENTS.add(
    "four-regions",
    "Inequalities (23), (24), (25) divide the plane of A and Ω into four regions for harmonic "
    "motion; for the 1/3 subharmonic at δ = 0.5 a fifth appears.",
    page=94,
    figures=("3a", "3b", "4a", "4b"),
)
def four_regions(evidence: Evidence) -> Finding:
    """See which regions take part of the paper's windows, and where a fifth can be."""
    numbers_by_plane = {
        name: [number for number, share in plane.shares.items() if share > 0.0]
        for name, plane in evidence.planes.items()
    }
    expected = {"3a": 4, "3b": 4, "4a": 5, "4b": 4}
    words = "; ".join(f"Fig. {name}: {numbers}" for name, numbers in numbers_by_plane.items())
    # P = D h Omega grows with Omega towards D n pi/2; region 5 needs P > 1.
    limits = {}
    for order in (1, 3):
        damping = 2.0 / (order * math.pi)
        limits[order] = (1.0 - damping) / (1.0 + damping)
    return Finding(
        holds={name: len(numbers) for name, numbers in numbers_by_plane.items()} == expected,
        detail=f"Regions with a share of the window: {words}. Region 5 (P > Q > 1) needs P > 1 "
        f"somewhere, that is δ < {limits[1]:.4f} for n = 1 and δ < {limits[3]:.4f} for n = 3.",
        values={"regions": numbers_by_plane, "restitution_below": limits},
    )


@STATEMENTS.add(
    "E1",
    "In region 2 the block can respond in an out-of-phase and in an in-phase motion.",
    page=94,
    figures=("3a", "3b", "4a", "4b"),
)
def region_2_in_phase(evidence: Evidence) -> Finding:
    """See whether the in-phase solutions of regions 2 and 5 leave the floor upwards."""
    states = evidence.sample.states
    assert states.admissible is not None
    counts = {}
    for number in (2, 5):
        inside = states.region == number
        counts[number] = (
            int(inside.sum()),
            int((states.velocity[1] < 0.0)[inside].sum()),
            int(states.admissible[1][inside].sum()),
        )
    (two, down_two, good_two), (five, down_five, good_five) = counts[2], counts[5]
    return Finding(
        holds=good_two == two,
        detail=f"The in-phase solution of region 2 is no motion. At {down_two} of {two} random "
        "points its velocity after impact is negative, so that the block would go through the "
        f"floor at once; {good_two} are admissible. Region 5 is the same: {down_five} of {five} "
        f"negative, {good_five} admissible. By (18) and (19) the velocity is "
        "2δβ sin φ/[(1 − δ)hΩ] and has the sign of the phase.",
        values={"region_2": counts[2], "region_5": counts[5]},
    )


@STATEMENTS.add(
    "sign-of-phase",
    "The in-phase solution has a positive phase in region 1 and a negative one in region 2.",
    page=94,
    figures=("3a", "3b"),
)
def sign_of_phase(evidence: Evidence) -> Finding:
    """Count the signs."""
    states = evidence.sample.states
    phase = states.phase[1]
    positive = int((phase > 0.0)[states.region == 1].sum())
    negative = int((phase < 0.0)[states.region == 2].sum())
    first, second = int((states.region == 1).sum()), int((states.region == 2).sum())
    return Finding(
        holds=positive == first and negative == second,
        detail=f"Positive at {positive} of {first} random points of region 1, negative at "
        f"{negative} of {second} of region 2.",
        values={"region_1": (positive, first), "region_2": (negative, second)},
    )


@STATEMENTS.add(
    "E7",
    "In region 3 one of the two in-phase solutions has a positive phase, the other a negative one.",
    page=94,
    see=("3a", "4a", "4b"),
)
def region_3_signs(evidence: Evidence) -> Finding:
    """Count the signs in regions 3 and 5."""
    states = evidence.sample.states
    opposite = states.phase[0] * states.phase[1] < 0.0
    positive = (states.phase[0] > 0.0) & (states.phase[1] > 0.0)
    three, five = states.region == 3, states.region == 5
    return Finding(
        holds=bool(opposite[three].all()),
        detail=f"In region 3 both phases are positive ({int(positive[three].sum())} of "
        f"{int(three.sum())} random points; opposite at {int(opposite[three].sum())}), as Q > 1 "
        "and P < Q demand. The sentence fits region 5, where they are opposite at "
        f"{int(opposite[five].sum())} of {int(five.sum())}.",
        values={
            "region_3": (int(positive[three].sum()), int(opposite[three].sum()), int(three.sum())),
            "region_5": (int(opposite[five].sum()), int(five.sum())),
        },
    )


@STATEMENTS.add(
    "region-4",
    "No symmetric steady motion is possible in region 4.",
    page=94,
    figures=("3a", "3b", "4a", "4b"),
)
def region_4(evidence: Evidence) -> Finding:
    """Evaluate how near eq 20 comes to being solved there, over all phases."""
    sample = evidence.sample
    empty = ~sample.exists
    # P cos f + sin f is at most sqrt(1 + P^2); what is missing to Q must be positive.
    missing = (sample.q - np.sqrt(1.0 + np.square(sample.p)))[empty]
    none = int(np.isnan(sample.states.phase[:, empty]).all(axis=0).sum())
    return Finding(
        holds=bool((missing > 0.0).all()) and none == int(empty.sum()),
        detail=f"At all {int(empty.sum())} random points of region 4 the largest value of "
        f"P cos φ + sin φ falls short of Q, by {scientific(float(missing.min()))} at least; no "
        "solution is returned.",
        values={"points": int(empty.sum()), "least_shortfall": float(missing.min())},
    )


@STATEMENTS.add(
    "region-3-small",
    "Region 3 is small for harmonic motion.",
    page=95,
    figures=("3a", "3b"),
)
def region_3_small(evidence: Evidence) -> Finding:
    """Measure it in the paper's windows."""
    shares = {name: plane.shares[3] for name, plane in evidence.planes.items()}
    words = ", ".join(f"{percent(share)} in Fig. {name}" for name, share in shares.items())
    return Finding(
        holds=shares["3a"] < 0.05 and shares["3b"] < 0.05,
        detail=f"Its share of the window is {words}.",
        values={"shares": shares},
    )


@STATEMENTS.add(
    "E8",
    "Region 3 disappears entirely for large δ.",
    page=95,
    see=("3b",),
)
def region_3_stays(_: Evidence) -> Finding:
    """Find the largest restitution at which it still has an area; take points inside it."""
    widths = {}
    alive = []
    for restitution in (0.9, 0.95, 0.99, 0.999):
        curves = compute_region_map(FREQUENCIES, restitution)
        top = np.minimum(curves.kind, curves.sign)
        widths[restitution] = float((1.0 - curves.existence / top).max())
        column = int(np.argmax(1.0 - curves.existence / top))
        middle = 0.5 * (curves.existence[column] + top[column])
        inside = steady_states(middle, FREQUENCIES[column], restitution)
        if inside.region == 3 and inside.in_phase.all():
            alive.append(restitution)
    words = ", ".join(f"{scientific(width)} at δ = {r:g}" for r, width in widths.items())
    return Finding(
        holds=not alive,
        detail="It becomes narrow but never disappears: (23) over (25) is 1/√(1 + P²), below 1 for "
        f"every δ < 1. The largest gap between the two, relative to (25): {words}. A point in the "
        f"gap lies in region 3 and has two in-phase solutions at δ = "
        f"{series(alive)}. In Fig. 3b it is thinner than the line.",
        values={"relative_width": widths, "points_inside": alive},
    )


@STATEMENTS.add(
    "region-4-shrinks",
    "Region 4 decreases in size as δ increases.",
    page=95,
    figures=("3a", "3b", "4a", "4b"),
)
def region_4_shrinks(_: Evidence) -> Finding:
    """Measure it over restitution."""
    shares = {
        order: [
            region_shares(compute_region_map(FREQUENCIES, r, order=order))[4] for r in RESTITUTIONS
        ]
        for order in (1, 3)
    }
    falling = all(bool((np.diff(values) < 0.0).all()) for values in shares.values())
    words = "; ".join(
        f"n = {order}: " + ", ".join(percent(value) for value in values)
        for order, values in shares.items()
    )
    return Finding(
        holds=falling,
        detail=f"Its share of the window at δ = {series(RESTITUTIONS)}: {words}.",
        values={"restitution": RESTITUTIONS, "shares": shares},
    )


@STATEMENTS.add(
    "E5",
    "For the 1/3 subharmonic region 2 grows with δ at the expense of regions 3 and 4, and region 1 "
    "does not depend on δ.",
    page=95,
    see=("4a", "4b"),
)
def region_that_grows(evidence: Evidence) -> Finding:
    """Measure regions 1 and 2, and how far their common boundary moves."""
    low, high = evidence.planes["4a"], evidence.planes["4b"]
    moved = float(np.abs(high.curves.sign / low.curves.sign - 1.0).max())
    growth = {number: high.shares[number] / low.shares[number] for number in (1, 2)}
    # What region 2 gains comes from region 5 alone; above both boundaries it does not change.
    gained = high.shares[2] - low.shares[2]
    return Finding(
        holds=growth[2] > growth[1] and abs(high.shares[1] / low.shares[1] - 1.0) < 0.05,
        detail="The numbers 1 and 2 are exchanged in the sentence, against the text's own "
        "definition by the sign of the phase. From δ = 0.5 to 0.95 region 1 grows "
        f"{growth[1]:.2f}-fold, from {percent(low.shares[1])} to {percent(high.shares[1])} of the "
        f"window, downwards into regions 3 and 4. Region 2 goes from {percent(low.shares[2])} to "
        f"{percent(high.shares[2])}; its gain, {percent(gained)}, is what region 5 had "
        f"({percent(low.shares[5])}). The boundary between the two, (24), does not depend on δ (it "
        f"moves by {scientific(moved)}).",
        values={"growth": growth, "boundary_moves": moved, "region_5": low.shares[5]},
    )


@STATEMENTS.add(
    "E9",
    "For a given frequency no steady motion is possible if the excitation is too large, nor if it "
    "is too small.",
    page=105,
    see=("3a", "3b", "4a", "4b"),
)
def too_large(_: Evidence) -> Finding:
    """Follow branch 1 to large amplitudes in region 2."""
    draw = np.random.default_rng(1989)
    points = 4000
    ratio = drawn_between(draw, 0.5, 16.0, points)
    restitution = drawn_between(draw, 0.1, 0.99, points)
    counts = {}
    for order in (1, 3):
        base = steady_states(1.0, ratio, restitution, order=order, with_shapes=False)
        amplitude = np.maximum(base.sign, base.kind) * drawn_between(draw, 1.01, 20.0, points)
        states = steady_states(amplitude, ratio, restitution, order=order)
        assert states.admissible is not None
        assert (states.region == 2).all()
        counts[order] = (
            int(states.admissible[0].sum()),
            int((states.velocity[0] > 0.0).sum()),
            int(states.stable[0].sum()),
        )
    return Finding(
        holds=counts[1][0] == counts[3][0] == 0,
        detail="Too small: yes, below (23). Too large: the algebra has no such bound, and the "
        "out-of-phase solution exists at every amplitude above (25). At amplitudes up to 20 times "
        f"that at which region 2 begins it is an admissible motion for n = 1 at {counts[1][0]} of "
        f"{points} random points. For n = 3 at {counts[3][0]}; the others all begin upwards "
        f"({counts[3][1]} do) and dip through the floor within their half cycle. What does end is "
        f"stability, at symmetry breaking: stable are {counts[1][2]} for n = 1 and {counts[3][2]} "
        "for n = 3.",
        values={"admissible_upward_stable": counts, "points": points},
    )
