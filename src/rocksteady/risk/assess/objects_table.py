"""Many objects at once: a table in, a counted answer for each."""

import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, Final

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.equations import Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.answer import Answer, left_out
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural, share_of
from rocksteady.results.result import Result
from rocksteady.results.stated import share_words
from rocksteady.risk.assess._judging import Judged, band_of, judge_objects
from rocksteady.risk.assess._sentences import WORDS
from rocksteady.risk.assess.assessment import answer_facts, screen_of
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.described.building import Building
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.described.schema import Value
from rocksteady.risk.assess.placed_objects import (
    PGA,
    PGV,
    PlacedObjects,
    peaks_of,
    place_objects,
    with_demand,
)
from rocksteady.risk.counted.suite import Peaks, Suite
from rocksteady.risk.counted.verdict import CODES, LEAST, VERDICTS, Verdict
from rocksteady.risk.ensemble.qualification import (
    FORCES,
    OUTPUTS,
    forces_of_rocking,
    most_of_rocking,
)
from rocksteady.risk.screens.friction import uplift_acceleration_g
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.sweep.run import Execution

OPEN: Final[tuple[Verdict, ...]] = ("slides", "not-shown", "no-answer")
"""Verdicts that are neither above nor below a target."""
EACH = "the demand of each object"
MOST_ROWS = 5
"""Kinds of objects on a screen."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ObjectsTable(Result):
    """Answers for count objects, from `rocksteady.assess_objects`.

    Attributes
    ----------
    rows
        A row for each object, in the order given: its place and demand, ``verdict`` and the fields
        of an assessment's JSON, as ``share``, ``low``, ``high`` and ``share_1_1``; ``like``, a
        number that objects share which are alike in all that the runs depend on; motion of the top,
        clearance and forces as of an `Assessment`; further columns of its table after them.
    pga_g, pgv_m_s
        The demand of objects that state none of their own.
    target_probability
        Share that is accepted.
    suite
        Motions of the ground.
    seconds
        Time that it took [s].
    """

    rows: tuple[dict[str, Any], ...]
    pga_g: float | None
    pgv_m_s: float | None
    target_probability: float
    suite: Suite
    seconds: float

    @property
    def model(self) -> Model:
        """Equations of motion of the runs."""
        return Nonlinear()

    @property
    def records(self) -> int:
        """Number of motions."""
        return len(self.suite.motions)

    @property
    def exit_code(self) -> int:
        """Exit code of a command that checks the verdicts: of the worst row, 1 before 3."""
        codes = {CODES[verdict] for verdict in self.verdicts}
        return next((code for code in (1, 3) if code in codes), 0)

    @property
    def verdicts(self) -> dict[Verdict, int]:
        """How count objects have which verdict, what asks for something first."""
        counts = Counter(row["verdict"] for row in self.rows)
        return {verdict: counts[verdict] for verdict in VERDICTS if counts[verdict]}

    @property
    def demand(self) -> Peaks | None:
        """The demand of all objects; None where these differ."""
        peaks = {(row["pga_g"], row["pgv_m_s"]) for row in self.rows}
        if len(peaks) > 1:
            return None
        pga, pgv = peaks.pop()
        return Peaks(pga_g=pga, pgv_m_s=pgv)

    def sorted_by(self, column: str, *, descending: bool = True) -> tuple[dict[str, Any], ...]:
        """Return the rows in the order of a column; those without a value come last.

        Parameters
        ----------
        column
            Name of a column.
        descending
            Largest first; default True.

        Raises
        ------
        InputError
            If there is no such column.
        """
        names = list(self.rows[0])
        if column not in names:
            raise InputError("column", column, f"columns are {', '.join(names)}", "give one")
        known = [row for row in self.rows if row[column] is not None]
        others = [row for row in self.rows if row[column] is None]
        ranked = sorted(known, key=lambda row: row[column], reverse=descending)
        return (*ranked, *others)

    @property
    def worst(self) -> list[dict[str, Any]]:
        """The rows, by verdict, and of each verdict the highest share first."""
        return sorted(self.sorted_by("share"), key=lambda row: VERDICTS.index(row["verdict"]))

    @property
    def kinds(self) -> list[tuple[dict[str, Any], int]]:
        """The first row of objects that are alike, and their number; the worst first."""
        counts = Counter(row["like"] for row in self.rows)
        seen = dict[int, dict[str, Any]]()
        for row in self.worst:
            seen.setdefault(row["like"], row)
        return [(row, counts[like]) for like, row in seen.items()]

    def describe(self) -> Description:
        """Return how many objects have which verdict, and a row for each, the worst first."""
        target = f"{number(100.0 * self.target_probability)} %"
        columns = [
            Column("name", "object", left=True),
            Column("share", "falls", share_of),
            Column("low", "from", share_of),
            Column("high", "to (90 %)", share_of),
            Column("share_1_1", "at 1.1 x", share_of),
            Column("verdict", "verdict", lambda verdict: WORDS[verdict], left=True),
        ]
        demand = EACH if self.demand is None else self.demand.words
        words = verdict_words(self.verdicts)
        facts = [
            Fact("objects", len(self.rows), "objects"),
            Fact("kinds", len(self.kinds), "kinds of object"),
            Fact("records", self.records, "records"),
            Fact("copies", self.suite.copies),
            Fact("built_in", self.suite.built_in),
            Fact("model", self.model.name, "model"),
            Fact("pga_g", self.pga_g),
            Fact("pgv_m_s", self.pgv_m_s),
            Fact("demand", demand, "demand"),
            Fact("target_probability", self.target_probability, "target", target),
            Fact("verdicts", self.verdicts, "verdicts", words),
            Fact("seconds", self.seconds),
        ]
        return Description(
            headline=f"{plural(len(self.rows), 'object')} at {demand}: {words}",
            facts=facts,
            tables=[
                Table(
                    "objects",
                    self.worst,
                    columns,
                    kind=lambda row: WORDS[row["verdict"]],
                    alarm=WORDS["red"],
                )
            ],
            notes=CAVEATS,
            answer=self._answer(),
        )

    def _answer(self) -> Answer:
        """Return how many objects are above the target, and the worst kinds."""
        kinds, red = self.kinds, self.verdicts.get("red", 0)
        demand = EACH if self.demand is None else self.demand.words
        several = len(kinds) < len(self.rows)
        objects = plural(len(self.rows), "object")
        at = f"at {demand}{' on built-in motions' * self.suite.built_in}"
        target = f"the target of {number(100.0 * self.target_probability)} %"
        count = sum(row["verdict"] == "red" for row, _ in kinds) if several else red
        subject = f"{red} of {objects}"
        if several:
            subject = f"{count} of {plural(len(kinds), 'kind')} ({subject})"
        neither = {key: self.verdicts[key] for key in OPEN if key in self.verdicts}
        others = f"; {verdict_words(neither)}" if neither else ""
        sentence = f"{subject} {'are' if count > 1 else 'is'} above {target} {at}{others}."
        if not red:
            sentence = f"{verdict_words(self.verdicts)} of {objects} {at}, for {target}."
        rest = kinds[MOST_ROWS:]
        left = verdict_words(Counter(row["verdict"] for row, _ in rest))
        needs = [row["friction_needed"] for row in self.rows if row["friction"] is None]
        facts = [
            left_out(len(rest), left),
            ("records", f"{self.records:,}" if not self.suite.built_in else ""),
            (
                "friction",
                f"must be at least {number(max(needs))} where it is not given" if needs else "",
            ),
        ]
        rows = [(row["name"], _row_words(row, count)) for row, count in kinds[:MOST_ROWS]]
        return Answer(sentence, facts, rows)


def verdict_words(counts: Mapping[Verdict, int]) -> str:
    """Return numbers of verdicts in words, as "2 red, 1 not shown"."""
    return ", ".join(
        f"{counts[verdict]:,} {WORDS[verdict]}" for verdict in VERDICTS if verdict in counts
    )


def _row_words(row: Mapping[str, Any], count: int) -> str:
    """Return verdict and share of objects that are alike."""
    words = WORDS[row["verdict"]]
    if row["by"] == "statics" and row["verdict"] != "slides":
        words += ", by statics"
    elif row["share"] is not None:
        band = (row["low"], row["high"])
        words += f", {share_words(row['fall'], row['runs'], band, row['share'])}"
    elif row["verdict"] == "no-answer":
        words += f", {row['records']} of {LEAST} records"
    return f"{words}; {count:,} alike" if count > 1 else words


@checked
def assess_objects(
    objects: Sequence[DescribedObject],
    motions: Sequence[Record | BaseMotion] | None = None,
    *,
    buildings: Sequence[Building] = (),
    pga_g: Annotated[float | None, PGA] = None,
    pgv_m_s: Annotated[float | None, PGV] = None,
    target_probability: Annotated[float, Bounds(0.0, 1.0, "()", "give a share")] = 0.1,
    stretch: bool = True,
    run: Execution | None = None,
) -> ObjectsTable:
    """Assess count objects at their demands, each kind of object run once.

    Each gets the counted share and the verdict that `assess_object` gives; curve and sensitivity
    are left to it.

    Parameters
    ----------
    objects
        As `read_objects` returns them; for a range the middle is taken.  Each keeps its own
        vertical motion and its options, the target excepted.
    motions, buildings, stretch
        As for `assess_object`.
    pga_g, pgv_m_s
        Peaks of the demand, [g] and [m/s], of the objects that state none of their own.
    target_probability
        Share that is accepted; default 0.1.
    run
        Executor, workers and progress; default `Execution()`.

    Returns
    -------
    ObjectsTable
        A row for each object.

    Raises
    ------
    InputError, ModelError
        If there are no objects or no motions, an object has no peak, or its building is not given
        or has no such floor.

    Examples
    --------
    >>> from rocksteady import assess_objects
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import DescribedObject
    >>> sizes = {"vase": (0.12, 0.5), "chest": (0.9, 1.1)}
    >>> objects = [
    ...     DescribedObject(values={"name": name, "geometry": {"width_m": b, "height_m": h}})
    ...     for name, (b, h) in sizes.items()
    ... ]
    >>> table = assess_objects(objects, make_synthetic_suite(12), pga_g=0.4, pgv_m_s=0.5)
    >>> [(row["name"], row["verdict"]) for row in table.rows]
    [('vase', 'red'), ('chest', 'stands')]
    """
    asked = [with_demand(each, pga_g, pgv_m_s) for each in objects]
    placed = place_objects(asked, motions, buildings, stretch=stretch)
    return assess_placed(placed, (pga_g, pgv_m_s), target_probability, run=run)


def assess_placed(
    placed: PlacedObjects,
    peaks: tuple[float | None, float | None],
    target_probability: float,
    *,
    run: Execution | None = None,
) -> ObjectsTable:
    """Assess objects at their places; as `assess_objects`, which documents it.

    `peaks` are the PGA [g] and the PGV [m/s] of the objects that state none of their own.
    """
    began = time.perf_counter()
    asked = [each.with_target(target_probability) for each in placed.objects]
    placed = replace(placed, objects=asked)
    judged = judge_objects(placed, run=run)
    forces = _forces(placed, judged, run)
    likes: dict[object, int] = {}
    rows = []
    for each, judgement, force in zip(asked, judged, forces, strict=True):
        asked_of, vertical = peaks_of(each), each.demand.vertical_at_peak_g
        friction = repr(each.given.friction)
        key = (each.block, id(judgement.shaking), asked_of, vertical, band_of(each), friction)
        row = _row(each, judgement, placed.suite) | {"like": likes.setdefault(key, len(likes))}
        row |= dict.fromkeys((*OUTPUTS, *FORCES))
        if judgement.runs is not None and not judgement.stands:
            row |= most_of_rocking(judgement.runs)
        row |= dict(zip(FORCES, force or (), strict=False))
        rows.append(row | _kept(each, row))
    return ObjectsTable(
        rows=tuple(rows),
        pga_g=peaks[0],
        pgv_m_s=peaks[1],
        target_probability=target_probability,
        suite=placed.suite,
        seconds=placed.seconds + time.perf_counter() - began,
    )


def _forces(
    placed: PlacedObjects, judged: Sequence[Judged], run: Execution | None
) -> list[tuple[float, float] | None]:
    """Return the forces on the base of each object with a mass that was counted."""
    floors: dict[int, list[int]] = {}
    for place, judgement in enumerate(judged):
        if judgement.runs is not None and judgement.shaking is not None and not judgement.stands:
            floors.setdefault(id(judgement.shaking), []).append(place)
    forces: list[tuple[float, float] | None] = [None] * len(judged)
    inner = None if run is None else replace(run, store=None, progress=None)
    for places in floors.values():
        shaking = judged[places[0]].shaking
        assert shaking is not None
        runs = [each for place in places if (each := judged[place].runs) is not None]
        values = forces_of_rocking(
            runs,
            [placed.objects[place].block for place in places],
            shaking.motions,
            [placed.objects[place].body.whole_mass_kg for place in places],
            run=inner,
        )
        for place, force in zip(places, values, strict=True):
            forces[place] = force
    return forces


def _row(described: DescribedObject, judged: Judged, suite: Suite) -> dict[str, Any]:
    """Return the row of an object."""
    block, demand, given = described.block, described.demand, described.given
    side = first_side(block)
    uplift = uplift_acceleration_g(block, demand.vertical_at_peak_g)
    sentence = screen_of(described, judged, suite).sentence
    answer = answer_facts(judged, built_in=suite.built_in)
    return {
        "name": described.name,
        "kind": given.kind,
        "building": given.building,
        "floor": given.floor,
        "storey": described.storey,
        "pga_g": given.demand.pga_g,
        "pgv_m_s": given.demand.pgv_m_s,
        "floor_pga_g": demand.pga_g if described.on_floor else None,
        **{fact.key: fact.value for fact in answer if fact.key not in ("doubts", "conditions")},
        "alpha_rad": side.alpha,
        "p_rad_s": side.p,
        "uplift_pga_g": uplift,
        "friction": _friction(given.friction),
        "vertical_g": demand.vertical_g,
        "vertical_share": demand.vertical_share,
        "sentence": f"{described.label}: {sentence[0].lower()}{sentence[1:]}",
    }


def _friction(given: Value | None) -> str | None:
    """Return a friction as a table of objects takes it, as "0.3:0.5"; None of none."""
    if given is None:
        return None
    return ":".join(dict.fromkeys(f"{end:g}" for end in bounds_of(given)))


def _kept(described: DescribedObject, row: Mapping[str, object]) -> dict[str, str]:
    """Return the further columns of an object's table; a name of the row is marked as given."""
    return {
        (f"{key} (given)" if key in row else key): text for key, text in described.extra.items()
    }
