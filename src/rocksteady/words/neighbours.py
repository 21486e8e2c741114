"""Words of neighbours of a verdict: how many fall, and from which scale on."""

from functools import partial

from rocksteady.dynamics.history.neighbours import Neighbours
from rocksteady.outcomes import Status
from rocksteady.results.answer import GIVEN, Answer
from rocksteady.results.description import Column, Description, Fact, Table
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
    return Description(
        f"{fact.text}, {model} model",
        facts=[
            Fact("model", model),
            Fact("status", neighbours.case.status.label, "the given case"),
            fact,
        ],
        tables=[Table("cases", rows, columns, most=len(rows))],
        notes=neighbours_notes(neighbours),
        answer=neighbours_answer(neighbours, None),
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


def neighbours_answer(neighbours: Neighbours, friction: float | None) -> Answer:
    """Return the answer of the case, which may slide, with what its neighbours say."""
    case = neighbours.case
    given, falls = case.describe(friction=friction).answer, case.status is Status.OVERTURNED
    assert given is not None
    words = f"but {_others(neighbours)}"
    if case.status is Status.LOST_CONTACT:
        same = sum(each.status is case.status for each in neighbours.cases)
        words = f"and so do {same} of {neighbours.runs} neighbours"
    elif neighbours.agree:
        words = "and so do" if falls else "and"
        words += f" all {neighbours.runs} neighbours" + ("" if falls else " stand")
    facts = [fact for fact in given.facts if fact[1] and fact[0] != ROCKING_ALONE]
    facts[-1] = ("computed", f"{case.model.name}; neighbours {RANGE}")
    place = [label for label, _ in facts].index(GIVEN) - 1 if len(facts) > 2 else 0
    if not slides(case, friction):
        facts.insert(max(place, 0), ("stands at", partial(_stands, neighbours)))
    return sliding_or(case, f"{sentence(case)}, {words}", facts, friction)


def _stands(neighbours: Neighbours) -> str:
    """Return the largest factor at which neither it nor a neighbour falls."""
    factor, pga = neighbours.stands_at, neighbours.case.pga_g
    if factor is None:
        return ""
    peak = "" if pga is None else f" ({quantity(factor * pga, 'g')})"
    return f"{factor:.2f} x this motion{peak}, where no neighbour falls"
