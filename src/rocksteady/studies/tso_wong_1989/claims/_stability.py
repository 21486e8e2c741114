"""Statements on stable symmetric motions, and Figs 8 to 11 (pages 89, 98 to 101)."""

from itertools import pairwise

import numpy as np

from rocksteady import Harmonic, State
from rocksteady.formulas import steady_states
from rocksteady.kernels.elementary.arrays import hypot
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.claims.findings import Finding
from rocksteady.studies.tso_wong_1989.figures.cases import RESTITUTION, SIDES
from rocksteady.studies.tso_wong_1989.figures.fates import settle
from rocksteady.studies.tso_wong_1989.figures.words import multiplier_text, scientific, sign, times

STATEMENTS = Statements()

ROUNDING = {"double": 2.0**-53, "single": 2.0**-24}
"""Relative rounding of a number."""
SEEN = 0.1
"""Part of a motion by which a difference from it is seen in a figure."""


@STATEMENTS.add(
    "E2",
    "None of the in-phase steady motions is stable; only out-of-phase ones are.",
    page=99,
    see=("3a", "4a", "4b"),
)
def in_phase_stable(evidence: Evidence) -> Finding:
    """Look for in-phase solutions that are stable, and let some of them run."""
    states = evidence.sample.states
    stable = states.in_phase & states.stable
    count, total = int(stable.sum()), int(states.in_phase.sum())
    regions = sorted({int(region) for region in states.region[stable.any(axis=0)]})
    named = []
    for a, w, r, n in ((0.75, 4.0, 0.5, 1), (1.7, 6.0, 0.8, 3)):
        point = steady_states(a, w, r, order=n)
        assert point.peak is not None
        phase = float(point.phase[0])
        fate = settle(
            r,
            Harmonic(amplitude=a, frequency_ratio=w, phase=phase + 1e-3),
            State(angle=0.0, velocity=float(point.velocity[0])),
        )
        stays = bool(abs(fate.highest - float(point.peak[0])) < 1e-5)
        named.append((point, phase, stays))
    words = "; ".join(
        f"A = {float(point.amplitude):g}, Ω = {float(point.frequency_ratio):g}, "
        f"δ = {float(point.restitution):g}, n = {int(point.order)}: φ = {phase:.3f} < π/2, trace "
        f"{float(point.trace[0]):.3f} (stable below {1.0 + np.square(point.restitution):.3f}), "
        f"region {int(point.region)}, and a run displaced by 0.001 "
        f"{'returns' if stays else 'does not return'} to it"
        for point, phase, stays in named
    )
    return Finding(
        holds=count == 0,
        detail=f"Of {total} in-phase solutions at random points {count} are stable, in regions "
        f"{regions}: there branch 1, which elsewhere is the out-of-phase motion, is in phase by "
        f"the paper's definition and stable near the fold (23). Examples: {words}.",
        values={
            "stable_in_phase": count,
            "in_phase": total,
            "trace": [float(point.trace[0]) for point, _, _ in named],
            "stays": [stays for _, _, stays in named],
        },
    )


@STATEMENTS.add(
    "branch-2-unstable",
    "The in-phase solution that exists beside an out-of-phase one is unstable.",
    page=99,
    see=("8a", "8b", "8c", "9a", "9b", "9c"),
)
def branch_2(evidence: Evidence) -> Finding:
    """Compute the largest multiplier of every admissible solution of branch 2."""
    states = evidence.sample.states
    assert states.admissible is not None
    admissible = states.admissible[1]
    first = states.half_cycle_multipliers[1, :, 0][admissible]
    size = hypot(first.real, first.imag)
    drawn = {
        name: evidence.histories[name].multiplier.real
        for name in ("8a", "8b", "8c", "9a", "9b", "9c")
    }
    words = ", ".join(f"{value:.3f} (Fig. {name})" for name, value in drawn.items())
    return Finding(
        holds=bool((size > 1.0).all()) and min(drawn.values()) > 1.0,
        detail=f"Of {int(admissible.sum())} admissible solutions of branch 2 at random points "
        f"{int((size > 1.0).sum())} have a half-cycle multiplier above 1, the smallest "
        f"{float(size.min()):.4f}; it tends to 1 at the fold (23). In the figures: {words}.",
        values={"smallest": float(size.min()), "figures": drawn},
    )


@STATEMENTS.add(
    "round-off",
    "In a time history that starts on an unstable steady motion the rounding of the computer is a "
    "disturbance that lets the instability show itself.",
    page=98,
    see=("8a", "8b", "8c", "9a", "9b", "9c"),
)
def round_off(evidence: Evidence) -> Finding:
    """Let one rounding grow by the exact multipliers over the time axis of each figure."""
    unstable = {n: history for n, history in evidence.histories.items() if not history.stable}
    left = {
        digits: [name for name, h in unstable.items() if h.growth * rounding > SEEN]
        for digits, rounding in ROUNDING.items()
    }
    kept = {digits: [n for n in unstable if n not in names] for digits, names in left.items()}
    return Finding(
        holds=not kept["double"],
        detail="Only where the run is long enough for its multiplier m: a rounding grows by "
        f"|m|^(2N/n) over N periods. In double precision it reaches {SEEN} of the motion within "
        f"the paper's time axes in {len(left['double'])} of the {len(unstable)} unstable motions "
        f"(Figs {_names(left['double'])}) and not in Figs {_names(kept['double'])}; in single "
        f"precision not in Figs {_names(kept['single'])}. Where the paper's run leaves one of the "
        "latter, its starting values were coarser than rounding. The multipliers used here need no "
        "run.",
        values={
            "growth": {name: history.growth for name, history in unstable.items()},
            "left": left,
        },
    )


@STATEMENTS.add(
    "E6",
    "What follows when an unstable motion is left shows where the system goes.",
    page=98,
    see=("8a", "8b", "8c", "9a", "9b", "9c", "11a", "12b", "12c", "12d", "13b", "13c", "13d"),
)
def one_fate(evidence: Evidence) -> Finding:
    """Leave every unstable motion on both sides from many distances and compare the fates."""
    by_side, by_distance, mirrored, always = [], [], [], []
    for name, history in evidence.histories.items():
        if history.stable:
            continue
        fates = history.fates_over_kicks
        classes = {side: {(fate.kind, fate.period) for fate in fates[side]} for side in SIDES}
        leanings = {fate.bias for side in SIDES for fate in fates[side]}
        if max(len(members) for members in classes.values()) > 1:
            by_distance.append(name)
        elif classes[1] != classes[-1]:
            by_side.append(name)
        elif {1, -1} <= leanings:
            mirrored.append(name)
        else:
            always.append(name)
    changes = max(
        (
            sum(
                earlier.kind is not later.kind
                for earlier, later in pairwise(h.fates_over_kicks[side])
            )
            for h in evidence.histories.values()
            if not h.stable
            for side in SIDES
        ),
        default=0,
    )
    count = len(next(iter(evidence.histories["8a"].fates_over_kicks.values())))
    return Finding(
        holds=not (by_side or by_distance or mirrored),
        detail="It shows one of several fates. Each unstable motion was left along its unstable "
        f"direction on both sides, from {count} distances between 1e-6 and 0.01 on each. The fate "
        f"depends on the side alone in Figs {_names(by_side)}; on the distance as well in "
        f"Figs {_names(by_distance)}, where along one side it changes up to {changes} times; the "
        f"two sides lead to mirror images in Figs {_names(mirrored)}; only in Figs "
        f"{_names(always)} is it the same from everywhere.",
        values={
            "side": by_side,
            "distance": by_distance,
            "mirror_images": mirrored,
            "always_the_same": always,
            "most_changes": changes,
        },
    )


def _names(names: list[str]) -> str:
    return ", ".join(names) if names else "none"


@STATEMENTS.add(
    "settled-out-of-phase",
    "The harmonic motion that these runs settle to is the stable out-of-phase solution.",
    page=99,
    figures=("8b", "8c", "9b", "9c"),
)
def settled_out_of_phase(evidence: Evidence) -> Finding:
    """Compare each settled symmetric motion with branch 1 of its period."""
    rows = []
    holds = True
    for name in ("8b", "8c", "9b", "9c"):
        history = evidence.histories[name]
        case = history.case
        for side, fate in history.fates.items():
            if not fate.symmetric:
                continue
            states = steady_states(
                case.amplitude, case.frequency_ratio, RESTITUTION, order=fate.period
            )
            assert states.peak is not None
            out = bool(states.stable[0] and not states.in_phase[0])
            apart = abs(fate.highest - float(states.peak[0]))
            holds = holds and out and apart < 1e-5
            rows.append(
                f"Fig. {name}, {sign(side)} side: peak {fate.highest:.5f}, of the out-of-phase "
                f"solution with n = {fate.period} {float(states.peak[0]):.5f}"
            )
    return Finding(holds=holds and bool(rows), detail="; ".join(rows) + ".")


@STATEMENTS.add(
    "three-periods",
    "A 1/3 subharmonic has three times the period of the excitation.",
    page=100,
    figures=("11a", "11b"),
)
def three_periods(evidence: Evidence) -> Finding:
    """Read the period of the settled motions."""
    periods = {name: evidence.histories[name].fates[1].period for name in ("9c", "11a", "11b")}
    words = ", ".join(f"Fig. {name}: {period}" for name, period in periods.items())
    return Finding(
        holds=set(periods.values()) == {3},
        detail=f"Smallest number of forcing periods after which the motion repeats: {words}.",
        values=dict(periods),
    )


@STATEMENTS.add(
    "second-peak",
    "With A = 4 each half cycle of the 1/3 subharmonic has two peaks; the second fades as A falls "
    "to 2.",
    page=101,
    figures=("11a", "11b"),
)
def second_peak(_: Evidence) -> Finding:
    """Count extrema of the half cycle between A = 4 and A = 2 and find where two of them merge."""
    amplitudes = np.linspace(2.0, 4.0, 2001)
    states = steady_states(amplitudes, 6.0, RESTITUTION, order=3)
    assert states.extrema is not None
    extrema = states.extrema[0]
    two = amplitudes[extrema >= 3]
    return Finding(
        holds=int(extrema[-1]) == 3 and int(extrema[0]) == 1,
        detail=f"The half cycle has {int(extrema[-1])} extrema at A = 4 (two peaks and a dip) and "
        f"{int(extrema[0])} at A = 2. The second peak exists from "
        f"A = {float(two.min(initial=4.0)):.3f} on; below, only a shoulder is left.",
        values={"extrema_at_4": int(extrema[-1]), "extrema_at_2": int(extrema[0]),
                "appears_at": float(two.min(initial=4.0))},
    )  # fmt: skip


@STATEMENTS.add(
    "stability-by-run",
    "A time history that starts on a steady motion and stays there shows that it is stable.",
    page=98,
    see=("10", "11a", "11b", "12a", "13a"),
)
def stability_by_run(evidence: Evidence) -> Finding:
    """Compare the multipliers with what the paper's windows let one see."""
    claimed = ("10", "11a", "11b", "12a", "13a")
    wrong = [name for name in claimed if not evidence.histories[name].stable]
    words = "; ".join(
        f"Fig. {name}: {multiplier_text(evidence.histories[name].multiplier)}" for name in claimed
    )
    hidden = ", ".join(
        f"Fig. {name}, where a disturbance grows only {times(evidence.histories[name].growth)} "
        f"in {evidence.histories[name].case.periods} periods"
        for name in wrong
    )
    return Finding(
        holds=not wrong,
        detail=(f"Not where the instability is slow: {hidden}. " if wrong else "")
        + f"Largest half-cycle multipliers: {words}.",
        values={"unstable": wrong},
    )


@STATEMENTS.add(
    "kicked-and-back",
    "The stable steady motions can be realised: a disturbed block returns to them.",
    page=105,
    figures=("10", "11b", "12a", "13a"),
)
def kicked_and_back(evidence: Evidence) -> Finding:
    """Disturb the stable motions of the figures and see whether they return."""
    rows, holds = [], True
    for name in ("10", "11b", "12a", "13a"):
        history = evidence.histories[name]
        states = history.states
        assert states.peak is not None
        shaking = Harmonic(
            amplitude=history.case.amplitude,
            frequency_ratio=history.case.frequency_ratio,
            phase=float(states.phase[0]) + 0.02,
        )
        velocity = float(states.velocity[0]) * 1.02
        fate = settle(RESTITUTION, shaking, State(angle=0.0, velocity=velocity))
        apart = abs(fate.highest - float(states.peak[0]))
        holds = holds and fate.symmetric and apart < 1e-5
        rows.append(
            f"Fig. {name}: {fate.label}, peak within {scientific(apart)} of the closed form"
        )
    return Finding(
        holds=holds,
        detail="Disturbed by .02 rad in phase and 2 % in velocity, the block settles to: "
        + "; ".join(rows)
        + ".",
    )
