"""Picture of an assessment: counted shares over levels, its demand and its target."""

from typing import TYPE_CHECKING, Any, NamedTuple

from rocksteady.errors import InputError, Words
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import quantity
from rocksteady.results.stated import share_words
from rocksteady.risk.assess.assessment import Assessment
from rocksteady.risk.counted.count import Count
from rocksteady.risk.counted.suite import Shaking
from rocksteady.risk.counted.verdict import LEAST, MARGIN
from rocksteady.show.plots.risk.fragility import draw_states, state_colours
from rocksteady.show.style.layout import axes_or_new
from rocksteady.show.style.legends import line_scale, text_size
from rocksteady.show.style.limits import LETTERS
from rocksteady.show.style.line_ends import LineEnd
from rocksteady.show.style.tokens import DASHED, inks_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@checked
def plot_assessment(assessment: Assessment, ax: "Axes | None" = None) -> "Axes":
    """Draw the counted shares of an assessed object, with its demand and its target.

    Dashed lines are the demand and the share that is accepted; the thin one beside the demand is at
    1.1 times it.  The share that falls at both has its 90 % interval.  Where both peaks are given,
    levels are multiples of the demand.

    Parameters
    ----------
    assessment
        From `rocksteady.assess_object`.
    ax
        Axes to draw on; default: axes of a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes: level of the ground motion, and share of the runs.

    Raises
    ------
    InputError
        If nothing was counted: it stands or slides by statics, or there is no answer.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from rocksteady import assess_object
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject
    >>> vase = DescribedObject(
    ...     values={
    ...         "name": "vase",
    ...         "geometry": {"width_m": 0.14, "height_m": 0.5},
    ...         "demand": {"pga_g": 0.4, "pgv_m_s": 0.4},
    ...         "assessment": {"draws": 1},
    ...     }
    ... )
    >>> found = assess_object(vase, make_synthetic_suite(12))
    >>> plot_assessment(found, Figure().add_subplot()).get_xlabel()
    'PGA [g]: PGV over PGA is kept at 1 m/s per g'
    """
    fragility, judged = assessment.fragility, assessment.judged
    shaking = judged.shaking
    if fragility is None or shaking is None:
        raise InputError(
            "assessment",
            Words("has no counted shares over levels"),
            assessment.sentence.rstrip("."),
            "read summary()",
        )
    axes = axes_or_new(ax)
    inks, width = inks_of(axes), line_scale(axes)
    goal, limits = assessment.target, []
    if goal.years is None:
        limits = [LineEnd(f"target {goal.words}", goal.share, inks.limit)]
        axes.axhline(goal.share, color=inks.limit, lw=width, ls=DASHED, zorder=2.4)
    draw_states(axes, fragility.states, limits)
    axes.set_xlabel(_level_label(assessment, shaking))
    answers = _answers(assessment, shaking)
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, answers[0].at / MARGIN), max(high, answers[-1].at * MARGIN))
    colour = state_colours(fragility.states, inks)[-1]
    for answer, side, thick in zip(answers, ("right", "left"), (1.0, 0.6), strict=False):
        axes.axvline(answer.at, color=inks.limit, lw=thick * width, ls=DASHED, zorder=2.4)
        axes.annotate(
            answer.words, (answer.at, 1.0), (1.0 if side == "left" else -1.0, 2.0),
            xycoords=axes.get_xaxis_transform(), textcoords="offset points", ha=side, va="bottom",
            fontsize=text_size(axes, LETTERS), color=inks.limit, annotation_clip=False,
        )  # fmt: skip
        axes.vlines(answer.at, *answer.band, color=colour, lw=2.0 * width, zorder=2.9)
        dot: dict[str, Any] = {"ms": 5.5 * width, "color": colour, "mec": inks.paper, "zorder": 3.0}
        axes.plot(answer.at, answer.share, "o", **dot)
    return axes


class _Answer(NamedTuple):
    """A share at a level, its 90 % interval, and both in words."""

    at: float
    share: float
    band: tuple[float, float]
    words: str


def _answers(assessment: Assessment, shaking: Shaking) -> list[_Answer]:
    """Return the answer, and the share at `MARGIN` times the demand where it can be judged."""
    judged, level = assessment.judged, shaking.level
    name = f"demand {quantity(level, shaking.measure.unit)}"
    answers = []
    if judged.stands:
        answers.append(_Answer(level, 0.0, (0.0, 0.0), f"{name}\nstands"))
    elif judged.count is not None:
        answers.append(_counted(level, judged.count, name))
    if judged.beyond is not None and judged.beyond.records >= LEAST:
        answers.append(_counted(MARGIN * level, judged.beyond, f"{MARGIN:g} x"))
    return answers


def _counted(at: float, count: Count, name: str) -> _Answer:
    """Return a counted share at a level."""
    words = share_words(count.falls, count.runs, count.band, count.share).partition(" (")[0]
    return _Answer(at, count.share, count.band, f"{name}\n{words} fall")


def _level_label(assessment: Assessment, shaking: Shaking) -> str:
    """Return the label of the levels."""
    measure, demand = shaking.measure, shaking.demand
    label = f"{measure.label}{' of the ground' * assessment.described.on_floor} [{measure.unit}]"
    return f"{label}: {demand.kept}" if shaking.stretched else label
