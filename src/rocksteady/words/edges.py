"""Words of edge states, hilltop saddles and manifolds."""

import math

from rocksteady.dynamics.edges.edge_state import MOST_KICK, EdgeState
from rocksteady.dynamics.edges.hilltop import HilltopSaddle
from rocksteady.dynamics.edges.manifold import Manifold
from rocksteady.dynamics.history.start import State
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.dynamics.steady.verdicts import multipliers_text, multipliers_value
from rocksteady.model.facts import (
    case_text,
    harmonic_values,
    kick_m_s,
    kick_text,
    lean_text,
    other_kick_text,
    solved_text,
)
from rocksteady.outcomes import AttractorKind, motion_verb
from rocksteady.results.description import Column, Description, Fact, Table, line
from rocksteady.results.numbers import DIGITS, number, number_or_none, plural
from rocksteady.results.result import describes
from rocksteady.words._window_lists import OTHER_WAY

MORE_DIGITS = 6
"""Significant digits of a kick below an answer."""
MEANING = {
    "hilltop": "On the edge the block balances about its upright position and has no impact.",
    "orbit": "On the edge the block rocks for ever in an unstable orbit.",
    "lost": "On the edge the block could not be followed: one of the two motions beside it falls.",
    "aperiodic": (
        "On the edge the motion has not repeated: the edge is fractal with a chaotic motion in it, "
        "or the motion is slow. More periods, or other states, decide."
    ),
}


@describes(EdgeState)
def describe_edge(edge: EdgeState) -> Description:
    """Return what the edge state is, what it parts, and how it was tracked."""
    saddle = edge.saddle
    words = "hilltop saddle" if edge.kind == "hilltop" else edge.kind
    if isinstance(saddle, Orbit):
        words = f"unstable orbit of {plural(saddle.period, 'period')}"
    multipliers = None if saddle is None else multipliers_value(saddle.multipliers)
    first, second = edge.outcomes
    facts = [
        Fact("kind", edge.kind, "edge state", words),
        Fact("outcomes", [first, second], "between", f"{first} and {second}"),
        Fact("period", None if saddle is None else saddle.period),
        Fact("hilltop_side", saddle.side if isinstance(saddle, HilltopSaddle) else None),
        Fact("highest", None if saddle is None else saddle.highest),
        Fact("lowest", None if saddle is None else saddle.lowest),
        Fact(
            "multipliers",
            multipliers,
            "" if multipliers is None else "multipliers",
            "" if multipliers is None else multipliers_text(multipliers),
        ),
        Fact("exponent", edge.exponent, "exponent", f"{number(edge.exponent)} a period"),
        Fact(
            "least_kick",
            edge.kick,
            "" if edge.kick is None else "least kick",
            "" if edge.kick is None else kick_text(edge.block, edge.kick, MORE_DIGITS),
        ),
        Fact("least_kick_m_s", number_or_none(edge.kick_m_s)),
        Fact(
            "opposite_kick",
            edge.opposite,
            OTHER_WAY * (edge.opposite is not None),
            _other_way(edge, MORE_DIGITS),
        ),
        Fact("opposite_kick_m_s", number_or_none(kick_m_s(edge.block, edge.opposite))),
        Fact("fractal", edge.fractal),
        Fact("width", edge.width),
        Fact("resolution", edge.resolution, "searched" * bool(edge.fractal), _searched(edge)),
        Fact("start_state", _pair(edge.start), "start", _text(edge.start)),
        Fact("other_state", _pair(edge.other), "other", _text(edge.other)),
        Fact("boundary_state", _pair(edge.boundary), "boundary", _text(edge.boundary)),
        Fact("phase", edge.motion.phase, "phase", f"{number(edge.motion.phase)} rad"),
        Fact("periods", edge.periods, "tracked for", plural(edge.periods, "forcing period")),
        Fact("bisections", edge.bisections, "outcomes computed"),
        Fact("distance", None if saddle is None else edge.distance),
        *case_of(edge),
    ]
    if saddle is not None:
        facts.append(Fact("", label="distance", text=f"{edge.distance:.1e} at the end"))
    headline = f"Edge state, {words}: {place(edge)}"
    sentence, screen = _edge_answer(edge)
    return Description(headline, [*screen, *facts], notes=[MEANING[edge.kind]], sentence=sentence)


def _edge_answer(edge: EdgeState) -> tuple[str, list[Fact]]:
    """Return the least kick or a state of the edge, and the motion there."""
    first, second = (_end(each) for each in edge.outcomes)
    start = "rest" if _pair(edge.start) == [0.0, 0.0] else _text(edge.start)
    if edge.kick is None:
        words = f"the edge between both starts passes {_state(edge.boundary)}"
    else:
        sign = "negative " if edge.kick < 0.0 else "positive "
        kind = sign * (edge.opposite is None) + "kick" + " found" * bool(edge.fractal)
        size = kick_text(edge.block, edge.kick)
        words = f"from {start} the least {kind} that makes it fall is {size}"
    words = solved_text(words, edge.block)
    sentence, periods = f"{words[0].upper()}{words[1:]}.", plural(edge.periods, "period")
    if edge.saddle is None:
        ending = "could not be followed beyond" if edge.kind == "lost" else "does not repeat in"
        sentence = f"Undecided on the edge, which {ending} {periods}; {words}."
    pair = None if edge.saddle is None else multipliers_text(edge.saddle.multipliers)
    leaves = f"{number(math.exp(edge.exponent))}-fold a period"
    meaning = MEANING[edge.kind].split(": ")[0].split(". ")[0].removesuffix(".")
    meaning = meaning.removeprefix("On the edge ").replace("the block", "it")
    return (
        sentence,
        [
            line(OTHER_WAY, _other_way(edge)),
            line("searched", _searched(edge)),
            line("on the edge", meaning),
            line("leaves the edge", f"{leaves} (multipliers {pair})" if pair else leaves),
            line("between", f"{first} and {second}"),
            line("computed", f"{edge.model.name}; {edge.bisections} outcomes over {periods}"),
        ],
    )


def _end(outcome: str) -> str:
    """Return what a start comes to, after "it"."""
    kind, _, period = outcome.partition(" orbit of period ")
    if period:
        return motion_verb(AttractorKind(kind), int(period))
    kind, _, side = outcome.partition(" ")
    return f"{AttractorKind(kind).plain} {side}".strip()


def _other_way(edge: EdgeState, digits: int = DIGITS) -> str:
    """Return the least kick in the other direction in words."""
    if edge.opposite is None:
        return ""
    return other_kick_text(edge.block, edge.opposite, (0.0, MOST_KICK), digits)


def _searched(edge: EdgeState) -> str:
    """Return the resolution in words where smaller kicks may be fatal."""
    text = f"in steps of {number(edge.resolution or 0.0)} alpha g/p; fractal: smaller kicks "
    text += "may fell it, and larger ones may not"
    if edge.width is not None:
        text += f"; this window is {number(edge.width, 2)} wide"
    return text * bool(edge.fractal)


def _pair(state: State) -> list[float]:
    return [state.angle, state.velocity]


def _state(state: State) -> str:
    return f"u = {number(state.angle)}, du/d(pt) = {number(state.velocity)}"


def _text(state: State) -> str:
    return f"{state.angle:.10g},{state.velocity:.10g}"


@describes(HilltopSaddle)
def describe_saddle(saddle: HilltopSaddle) -> Description:
    """Return the side, extrema and multipliers of the motion."""
    begin = saddle.start
    first, second = saddle.multipliers.tolist()
    towards = "positive" if saddle.side > 0 else "negative"
    facts = [
        Fact("side", saddle.side, "side", towards),
        Fact("period", saddle.period, "period", "1 forcing period"),
        Fact("impacts_per_period", 0, "impacts", "none"),
        Fact("peaks", [saddle.highest, saddle.lowest]),
        Fact("", label="highest", text=lean_text(saddle.block, saddle.highest)),
        Fact("", label="lowest", text=lean_text(saddle.block, saddle.lowest)),
        Fact(
            "multipliers",
            [complex(first), complex(second)],
            "multipliers",
            f"{first:.6g}, {second:.6g}",
        ),
        Fact("lyapunov", saddle.lyapunov, "exponent", f"{number(saddle.lyapunov)} a period"),
        Fact("angle", begin.angle, "angle at the phase"),
        Fact("velocity", begin.velocity, "velocity there"),
        Fact("phase", saddle.motion.phase, "phase", f"{number(saddle.motion.phase)} rad"),
        Fact("residual", saddle.residual),
        *case_of(saddle),
    ]
    return Description(f"Hilltop saddle on the {towards} side: {place(saddle)}", facts)


@describes(Manifold)
def describe_manifold(manifold: Manifold) -> Description:
    """Return the saddle, and the branches with their lengths and ends."""
    rows = [
        {
            "branch": index,
            "sign": branch.sign,
            "place": branch.place,
            "points": len(branch.first),
            "length": branch.length,
            "jumps": len(branch.breaks),
            "ended": branch.ended,
        }
        for index, branch in enumerate(manifold.branches)
    ]
    columns = [
        Column("branch", "#"),
        Column("sign", "begins", lambda value: "+" if value > 0 else "-"),
        Column("place", "at"),
        Column("points", "points"),
        Column("length", "length", lambda value: number(value, 4)),
        Column("jumps", "jumps"),
        Column("ended", "ends by", left=True),
    ]
    hilltop = isinstance(manifold.saddle, HilltopSaddle)
    of = "hilltop saddle" if hilltop else f"orbit of {plural(manifold.saddle.period, 'period')}"
    where = "over impacts"
    if manifold.over == "phase":
        where = f"at phase {number(manifold.phase)} rad"
    multipliers = multipliers_value(manifold.saddle.multipliers)
    facts = [
        Fact("kind", manifold.kind, "kind"),
        Fact("over", manifold.over, "over", where),
        Fact("phase", manifold.phase),
        Fact("saddle", "hilltop" if hilltop else "orbit", "saddle", of),
        Fact("multipliers", multipliers, "multipliers", multipliers_text(multipliers)),
        Fact("points", manifold.points, "points"),
        Fact("window", list(manifold.window)),
        Fact("spacing", manifold.spacing),
        *case_of(manifold),
    ]
    return Description(
        f"{manifold.kind.capitalize()} manifold of a {of} {where}: " + place(manifold),
        facts,
        [Table("branches", rows, columns)],
    )


def case_of(result: EdgeState | HilltopSaddle | Manifold) -> list[Fact]:
    """Return the facts of what moves, by what and in which model."""
    values = harmonic_values(result.block, result.motion)
    return [
        *(Fact(key, value) for key, value in values.items()),
        Fact("model", result.model.name, "model"),
    ]


def place(result: EdgeState | HilltopSaddle | Manifold) -> str:
    """Return what moves and by what, for a headline."""
    motion = result.motion
    shaking = f"A = {number(motion.amplitude, 4)}, Ω = {number(motion.frequency_ratio, 4)}"
    return f"{shaking}, {case_text(result.block)}, {result.model.name} model"
