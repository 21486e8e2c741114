"""Statements on the paper's time histories (Figs 8 to 13), one per figure."""

from dataclasses import dataclass
from functools import partial

from rocksteady.kernels.elementary.arrays import log
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.claims.findings import Finding
from rocksteady.studies.tso_wong_1989.figures.cases import KICK, RESTITUTION, SIDES
from rocksteady.studies.tso_wong_1989.figures.fates import Kind, settle
from rocksteady.studies.tso_wong_1989.figures.histories import History, counted
from rocksteady.studies.tso_wong_1989.figures.words import multiplier_text, sign, signed, times

STATEMENTS = Statements()


@dataclass(frozen=True, kw_only=True)
class Shown:
    """What the paper reports of a time history.

    Attributes
    ----------
    figure
        Its panel.
    text, page
        What the paper says, in our words, and where.
    fate
        Attractor to which the motion departs; None where the paper calls it stable.
    period, symmetric
        Period and symmetry of a subharmonic fate.
    """

    figure: str
    text: str
    page: int
    fate: Kind | None = None
    period: int = 0
    symmetric: bool | None = None


HISTORIES = (
    Shown(
        figure="8a", page=100, fate=Kind.OVERTURNED,
        text="At A = 1, 1 Hz the in-phase harmonic motion is left and the block topples.",
    ),
    Shown(
        figure="8b", page=100, fate=Kind.SYMMETRIC,
        text="At A = 1, 2 Hz the in-phase harmonic motion is left for the stable out-of-phase one.",
    ),
    Shown(
        figure="8c", page=100, fate=Kind.SYMMETRIC,
        text="At A = 1, 8 Hz the in-phase harmonic motion is left for the stable out-of-phase one.",
    ),
    Shown(
        figure="9a", page=100, fate=Kind.OVERTURNED,
        text="At A = 2, 3.5 Hz the in-phase 1/3 subharmonic is left and the block topples.",
    ),
    Shown(
        figure="9b", page=100, fate=Kind.SYMMETRIC,
        text="At A = 2, 4 Hz the in-phase 1/3 subharmonic is left for the stable harmonic motion.",
    ),
    Shown(
        figure="9c", page=100, fate=Kind.SUBHARMONIC, period=3, symmetric=True,
        text="At A = 2, 5 Hz the in-phase 1/3 subharmonic is left for the stable out-of-phase one.",
    ),
    Shown(
        figure="10", page=100,
        text="At A = 6, 4 Hz the out-of-phase harmonic motion is stable.",
    ),
    Shown(
        figure="11a", page=100,
        text="At A = 4, 6 Hz the symmetric out-of-phase 1/3 subharmonic is stable (Fig. 11a).",
    ),
    Shown(
        figure="11b", page=100,
        text="At A = 2, 6 Hz the symmetric out-of-phase 1/3 subharmonic is stable.",
    ),
    Shown(
        figure="12a", page=101,
        text="At A = 2, Ω = 2.0 the symmetric harmonic motion is stable.",
    ),
    Shown(
        figure="12b", page=105, fate=Kind.UNSYMMETRIC,
        text="At A = 2, Ω = 1.9 the symmetric harmonic motion is unstable, and the block shifts to "
        "a stable unsymmetric one.",
    ),
    Shown(
        figure="12c", page=105, fate=Kind.UNSYMMETRIC,
        text="At A = 2, Ω = 1.8 the block shifts from the symmetric harmonic motion to a stable "
        "unsymmetric one.",
    ),
    Shown(
        figure="12d", page=105, fate=Kind.OVERTURNED,
        text="At A = 2, Ω = 1.7 the block leaves the symmetric harmonic motion and overturns.",
    ),
    Shown(
        figure="13a", page=105,
        text="At A = 2, Ω = 4.4 the symmetric 1/3 subharmonic is stable.",
    ),
    Shown(
        figure="13b", page=105, fate=Kind.SUBHARMONIC, period=3, symmetric=False,
        text="At A = 2, Ω = 4.2 the symmetric 1/3 subharmonic is unstable, and the block settles "
        "to an unsymmetric one.",
    ),
    Shown(
        figure="13c", page=105, fate=Kind.SYMMETRIC,
        text="At A = 2, Ω = 3.6 the block leaves the symmetric 1/3 subharmonic for the harmonic "
        "motion.",
    ),
    Shown(
        figure="13d", page=105, fate=Kind.OVERTURNED,
        text="At A = 2, Ω = 3.0 the block overturns after a few subharmonic cycles.",
    ),
)  # fmt: skip


def _fates(history: History) -> str:
    """Say what became of the block on each side."""
    parts = []
    for side in history.sides:
        drawn = history.fates[side]
        text = f"on the {sign(side)} side from {KICK:g}: {drawn.label}"
        if history.fates_over_kicks:
            text += f" (over all distances: {counted(history.fates_over_kicks[side])})"
        parts.append(text)
    return "; ".join(parts)


def fate_finding(
    history: History, kind: Kind, *, period: int = 0, symmetric: bool | None = None
) -> Finding:
    """Return whether a motion is unstable and is left, always, for one kind of fate.

    Parameters
    ----------
    history
        The time history.
    kind
        What the paper reports.
    period
        Excitation periods of a subharmonic fate.
    symmetric
        Whether it is symmetric, where that matters.
    """
    runs = [fate for side in SIDES for fate in history.fates_over_kicks.get(side, [])]
    met = [
        fate.kind is kind and period in {0, fate.period} and symmetric in {None, fate.symmetric}
        for fate in runs
    ]
    share = sum(met) / max(len(met), 1)
    same = not history.stable and all(met)
    reason = ""
    if not history.stable and not same:
        reason = (
            f"The paper's fate is met in {share:.0%} of the runs: it depends on where the motion "
            "is left. "
        )
    return Finding(
        holds=same,
        detail=f"{'Stable' if history.stable else 'Unstable'}, half-cycle multiplier "
        f"{multiplier_text(history.multiplier)}. {reason}Left {_fates(history)}.",
        values={"share": share, "multiplier": history.modulus},
    )


def stable_finding(history: History) -> Finding:
    """Return whether a symmetric motion is stable and a run stays on it."""
    states, branch = history.states, history.case.branch - 1
    assert states.peak is not None
    peak = float(states.peak[branch])
    fate = settle(RESTITUTION, history.shaking, history.start)
    stays = fate.symmetric and abs(fate.highest - peak) < 1e-5
    text = (
        f"Half-cycle multiplier {multiplier_text(history.multiplier)}; peak {peak:.5f} in closed "
        "form. "
    )
    if history.stable and stays:
        text += (
            f"The block settles there: peak {fate.highest:.5f}, by Newton's method on its returns."
        )
    else:
        periods = 1.0 / (2.0 * log(history.modulus) / log(10.0) / history.case.order)
        text += (
            f"Unstable: a disturbance grows tenfold in {periods:.1f} periods, and over the "
            f"{history.case.periods} periods of the figure {times(history.growth)}, too little "
            f"to be seen. Left {_fates(history)}. The attractor is unsymmetric, θ/α between "
            f"{signed(fate.lowest, '.5f')} and {fate.highest:.5f}."
        )
    return Finding(
        holds=history.stable and stays,
        detail=text,
        values={
            "multiplier": [history.multiplier.real, history.multiplier.imag],
            "peak": peak,
            "highest": fate.highest,
            "lowest": fate.lowest,
        },
    )


def check_history(shown: Shown, evidence: Evidence) -> Finding:
    """Compare the fate of a motion with that in the paper."""
    history = evidence.histories[shown.figure]
    if shown.fate is None:
        return stable_finding(history)
    return fate_finding(history, shown.fate, period=shown.period, symmetric=shown.symmetric)


for _shown in HISTORIES:
    # A correction, E3, and not a figure like the others.
    _name = "E3" if _shown.figure == "11a" else f"fig-{_shown.figure}"
    STATEMENTS.add(_name, _shown.text, page=_shown.page, figures=(_shown.figure,))(
        partial(check_history, _shown)
    )
