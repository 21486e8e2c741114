"""Words of neighbours of a verdict: how many fall, and from which scale on."""

from functools import partial

from rocksteady.dynamics.history.neighbours import Neighbours
from rocksteady.outcomes import Status
from rocksteady.results.description import GIVEN, Column, Description, Fact, Table, line
from rocksteady.results.numbers import angle, number, quantity
from rocksteady.results.result import describes
from rocksteady.words.trajectory import ROCKING_ALONE, sentence, slides, sliding_or

RANGE = "±5 % scale, ±0.03 rest., ±2 % alpha"


@describes(Neighbours)
def describe_neighbours(neighbours: Neighbours) -> Description:
    """Return how many fall, and what was changed in each."""
    columns = (
        Column("scale", "scale", lambda scale: number(scale, 4)),
        Column("sign", "sign"),
        Column("restitution", "restitution"),
        Column("alpha_rad", "alpha", angle),
        Column("status", "status", left=True),
        Column("peak_rad", "peak", angle),
        Column("peak", "in alpha", number),
    )
    rows = [
        {
            "scale": each.scale,
            "sign": each.sign,
            "restitution": each.restitution,
            "alpha_rad": each.alpha,
            "status": each.status.label,
            "peak": each.peak,
            "peak_rad": each.peak * each.alpha,
        }
        for each in neighbours.cases
    ]
    fact, model = neighbours_fact(neighbours), neighbours.model.name
    sentence, screen = neighbours_answer(neighbours, None)
    return Description(
        f"{fact.words}, {model} model",
        facts=[
            *screen,
            Fact("model", model),
            Fact("status", neighbours.case.status.label, "the given case"),
            fact,
        ],
        tables=[Table("cases", rows, columns, most=len(rows))],
        notes=neighbours_notes(neighbours),
        sentence=sentence,
    )


def neighbours_fact(neighbours: Neighbours) -> Fact:
    """Return their numbers, as the command prints them beside the case."""
    counts = {"runs": neighbours.runs, "fall": neighbours.fall}
    text = f"falls in {neighbours.fall} of {neighbours.runs} neighbours ({RANGE})"
    return Fact("neighbours", counts, "neighbours", text)


def neighbours_notes(neighbours: Neighbours) -> tuple[str, ...]:
    """Return a warning where neighbours end otherwise than the case."""
    if neighbours.agree:
        return ()
    words = (
        f"The verdict is not robust: {_others(neighbours)}, though motion "
        "and block differ by a few per cent."
    )
    return (words,)


def _others(neighbours: Neighbours) -> str:
    """Return how many neighbours end otherwise than the case."""
    falls = neighbours.case.status is Status.OVERTURNED
    others = neighbours.runs - neighbours.fall if falls else neighbours.fall
    return f"{others} of {neighbours.runs} neighbours {'stand' if falls else 'fall'}"


def neighbours_answer(neighbours: Neighbours, friction: float | None) -> tuple[str, list[Fact]]:
    """Return the answer of the case, which may slide, with what its neighbours say."""
    case = neighbours.case
    falls = case.status is Status.OVERTURNED
    words = f"but {_others(neighbours)}"
    if case.status is Status.LOST_CONTACT:
        same = sum(each.status is case.status for each in neighbours.cases)
        words = f"and so do {same} of {neighbours.runs} neighbours"
    elif neighbours.agree:
        words = "and so do" if falls else "and"
        words += f" all {neighbours.runs} neighbours" + ("" if falls else " stand")
    given = case.describe(friction=friction).facts
    facts = [each for each in given if each.first and each.text and each.label != ROCKING_ALONE]
    facts[-1] = line("computed", f"{case.model.name}; neighbours {RANGE}")
    place = [fact.label for fact in facts].index(GIVEN) - 1 if len(facts) > 2 else 0
    if not slides(case, friction):
        facts.insert(max(place, 0), line("stands at", partial(_stands, neighbours)))
    return sliding_or(case, f"{sentence(case)}, {words}", facts, friction)


def _stands(neighbours: Neighbours) -> str:
    """Return the largest factor at which neither it nor a neighbour falls."""
    factor, pga = neighbours.stands_at, neighbours.case.pga_g
    if factor is None:
        return ""
    peak = "" if pga is None else f" ({quantity(factor * pga, 'g')})"
    return f"{factor:.2f} x this motion{peak}, where no neighbour falls"
