"""Many objects at once: a table in, a counted answer for each."""

import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.equations import Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.answer import Answer, left_out
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import chance, number, plural, share_of
from rocksteady.results.result import Result
from rocksteady.results.stated import share_words
from rocksteady.risk.assess._judging import Judged, band_of, judge_objects
from rocksteady.risk.assess._remedies import is_helped, remedies_of
from rocksteady.risk.assess._remedy import CHANGES, Remedy, change_words
from rocksteady.risk.assess._sentences import WORDS
from rocksteady.risk.assess.assessment import answer_facts, demand_facts, screen_of, target_facts
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.described.building import Building
from rocksteady.risk.assess.described.objects import DescribedObject, bounds_of
from rocksteady.risk.assess.described.schema import Value
from rocksteady.risk.assess.placed_objects import (
    PlacedObjects,
    demand_of,
    place_objects,
    with_demand,
)
from rocksteady.risk.assess.rates import curve_of, is_curved, site_of, with_rate, without_rate
from rocksteady.risk.counted.suite import Demanded, Peaks, Shaking, Suite
from rocksteady.risk.counted.verdict import CODES, LEAST, VERDICTS, Target, Verdict
from rocksteady.risk.ensemble.qualification import (
    FORCES,
    OUTPUTS,
    forces_of_rocking,
    most_of_rocking,
)
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.risk.screens.friction import uplift_acceleration_g
from rocksteady.risk.spectra.design_spectrum import DesignSpectrum
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

OPEN: Final[tuple[Verdict, ...]] = ("slides", "not-shown", "no-answer")
"""Verdicts that are neither above nor below a target."""
EACH = "the demand of each object"
MOST_ROWS = 5
"""Kinds of objects on a screen."""
MOST_HELPED = 10
"""Kinds of objects whose least changes are looked for, the worst first."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ObjectsTable(Result):
    """Answers for several objects, from `rocksteady.assess_objects`.

    Attributes
    ----------
    rows
        A row for each object, in the order given: its place and demand, ``verdict`` and the fields
        of an assessment's JSON, as ``share``, ``low``, ``high`` and ``share_1_1``; ``like``, a
        number that objects share which are alike in all that the runs depend on; motion of the top,
        clearance and forces as of an `Assessment`; least changes, of the 10 worst kinds; further
        columns of its table after them.
    pga_g, pgv_m_s
        The demand of objects that state none of their own.
    target
        Share that is accepted, at the demand or in some years.
    suite
        Motions of the ground.
    demands
        The demand of each kind, by its ``like``.
    shaking
        Motions on the spectrum of all objects that have one; None without one, or of several.
    curves
        Counted shares of each kind over levels, by its ``like``; empty where none were counted.
    seconds
        Time that it took [s].
    """

    rows: tuple[Mapping[str, Any], ...]
    pga_g: float | None
    pgv_m_s: float | None
    target: Target
    suite: Suite
    demands: Mapping[int, Demanded]
    shaking: Shaking | None
    curves: Mapping[int, Fragility]
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
        """How often each verdict occurs, what asks for something first."""
        counts = Counter(row["verdict"] for row in self.rows)
        return {verdict: counts[verdict] for verdict in VERDICTS if counts[verdict]}

    @property
    def demand(self) -> Demanded | None:
        """The demand of all objects; None where these differ."""
        several = set(self.demands.values())
        return several.pop() if len(several) == 1 else None

    @property
    def _where(self) -> str:
        """The demand in words after a verb, as far as the motions have it."""
        demand = self.demand
        if demand is None:
            return f"at {EACH}"
        shaken = [row["stretched"] for row in self.rows if row["median_scale"] is not None]
        if not demand.kept or all(shaken):
            return demand.where
        return f"{Peaks(pga_g=demand.pga_g).where} with each record's own PGV"

    def sorted_by(self, column: str, *, descending: bool = True) -> tuple[Mapping[str, Any], ...]:
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
    def worst(self) -> list[Mapping[str, Any]]:
        """The rows, by verdict, and of each verdict the highest share first."""
        column = "share" if self.target.years is None else "rate_per_year"
        return sorted(self.sorted_by(column), key=lambda row: VERDICTS.index(row["verdict"]))

    @property
    def kinds(self) -> list[tuple[Mapping[str, Any], int]]:
        """The first row of objects that are alike, and their number; the worst first."""
        counts = Counter(row["like"] for row in self.rows)
        seen = dict[int, Mapping[str, Any]]()
        for row in self.worst:
            seen.setdefault(row["like"], row)
        return [(row, counts[like]) for like, row in seen.items()]

    def describe(self) -> Description:
        """Return how many objects have which verdict, and a row for each, the worst first."""
        columns = [
            Column("name", "object", left=True),
            Column("share", "falls", share_of),
            Column("low", "from", share_of),
            Column("high", "to (90 %)", share_of),
            Column("share_1_1", "at 1.1 x", share_of),
            *[Column("probability_50_years", "in 50 years", share_of)] * self._has_rates,
            Column("verdict", "verdict", lambda verdict: WORDS[verdict], left=True),
        ]
        where = self._where
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
            *self._demand_facts(),
            *target_facts(self.target),
            Fact("verdicts", self.verdicts, "verdicts", words),
            Fact("seconds", self.seconds),
        ]
        return Description(
            headline=f"{plural(len(self.rows), 'object')} {where}: {words}",
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
            notes=[*CAVEATS, *self._remarks()],
            answer=self._answer(),
        )

    def _answer(self) -> Answer:
        """Return how many objects are above the target, and the worst kinds."""
        kinds, red = self.kinds, self.verdicts.get("red", 0)
        placing = None if self.shaking is None else self.shaking.placing
        several = len(kinds) < len(self.rows)
        objects = plural(len(self.rows), "object")
        place = "" if self.target.years else f" {self._where}"
        at = f"{place}{' on built-in motions' * self.suite.built_in}"
        target = f"the target of {self.target.words}"
        count = sum(row["verdict"] == "red" for row, _ in kinds) if several else red
        subject = f"{red} of {objects}"
        if several:
            subject = f"{count} of {plural(len(kinds), 'kind')} ({subject})"
        neither = {key: self.verdicts[key] for key in OPEN if key in self.verdicts}
        others = f"; {verdict_words(neither)}" if neither else ""
        sentence = f"{subject} {'are' if count > 1 else 'is'} above {target}{at}{others}."
        if not red:
            sentence = f"{verdict_words(self.verdicts)} of {objects}{at}, for {target}."
        rest = kinds[MOST_ROWS:]
        left = verdict_words(Counter(row["verdict"] for row, _ in rest))
        needs = [row["friction_needed"] for row in self.rows if row["friction"] is None]
        facts = [
            left_out(len(rest), left),
            ("spectrum", "" if placing is None else placing.line(placing.doubt).words),
            ("records", f"{self.records:,}" if not self.suite.built_in else ""),
            (
                "friction",
                f"must be at least {number(max(needs))} where it is not given" if needs else "",
            ),
        ]
        in_years = self.target.years is not None
        rows = [(row["name"], _row_words(row, count, in_years)) for row, count in kinds[:MOST_ROWS]]
        return Answer(sentence, facts, rows)

    def _remarks(self) -> list[str]:
        """Return what formulas of spectra leave to the engineer."""
        spectra = [each for each in self.demands.values() if isinstance(each, DesignSpectrum)]
        return [*filter(None, dict.fromkeys(each.remark for each in spectra))]

    def _demand_facts(self) -> list[Fact]:
        """Return the demand in JSON and in words, with the motions of the first object on it."""
        return demand_facts(self.shaking, self.demand, self._where.partition(" ")[2])

    @property
    def _has_rates(self) -> bool:
        """Whether a rate is known of an object."""
        return any(row["rate_per_year"] is not None for row in self.rows)


def _on_spectrum(shakings: Sequence[Shaking | None]) -> Shaking | None:
    """Return the first motions on a spectrum; None without one, or of several spectra."""
    placed = [each for each in shakings if each is not None and each.placing is not None]
    return placed[0] if len({each.demand for each in placed}) == 1 else None


def verdict_words(counts: Mapping[Verdict, int]) -> str:
    """Return numbers of verdicts in words, as "2 red, 1 not shown"."""
    return ", ".join(
        f"{counts[verdict]:,} {WORDS[verdict]}" for verdict in VERDICTS if verdict in counts
    )


def _row_words(row: Mapping[str, Any], count: int, in_years: bool) -> str:
    """Return verdict and share of objects that are alike."""
    words, rate = WORDS[row["verdict"]], row["probability_50_years"]
    if in_years and (rate is not None or row["no_rate"]):
        words += f", no rate: {row['no_rate']}" if rate is None else f", {chance(rate)} in 50 years"
    elif row["by"] == "statics" and row["verdict"] != "slides":
        words += ", by statics"
    elif row["share"] is not None:
        band = (row["low"], row["high"])
        words += f", {share_words(row['fall'], row['runs'], band, row['share'])}"
    elif row["verdict"] == "no-answer":
        words += f", {row['records']} of {LEAST} records"
    if rate is not None and not in_years:
        words += f"; {chance(rate)} in 50 years"
    return f"{words}; {count:,} alike" if count > 1 else words


@checked
def assess_objects(
    objects: Sequence[DescribedObject],
    motions: Sequence[Record | BaseMotion] | Suite | None = None,
    *,
    buildings: Sequence[Building] = (),
    demand: Demanded | None = None,
    target: Target | float = 0.1,
    hazard: HazardCurve | None = None,
    stretch: bool = True,
    run: Execution | None = None,
) -> ObjectsTable:
    """Assess several objects at their demands, each kind of object run once.

    Each gets the counted share and the verdict that `assess_object` gives, and with a hazard curve
    the rate; the 10 worst kinds get the least changes too.  The sensitivity is left to it.

    Parameters
    ----------
    objects
        As `read_objects` returns them; for a range the middle is taken.  Each keeps its own
        vertical motion and its options, the target excepted.
    motions, buildings, hazard, stretch
        As for `assess_object`.
    demand
        Peaks, or a `DesignSpectrum`, that objects are to stand which state none of their own.
    target
        Share that is accepted of the runs at the demand, default 0.1; or a `Target` in 50 years.
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
    >>> from rocksteady.risk import DescribedObject, Peaks
    >>> sizes = {"vase": (0.12, 0.5), "chest": (0.9, 1.1)}
    >>> objects = [
    ...     DescribedObject(values={"name": name, "geometry": {"width_m": b, "height_m": h}})
    ...     for name, (b, h) in sizes.items()
    ... ]
    >>> table = assess_objects(objects, make_synthetic_suite(12), demand=Peaks(pga_g=0.4))
    >>> [(row["name"], row["verdict"]) for row in table.rows]
    [('vase', 'red'), ('chest', 'stands')]
    """
    goal = target if isinstance(target, Target) else Target(target)
    asked = [with_demand(each, demand).with_target(goal) for each in objects]
    sites = [site_of(each, hazard, stretch=stretch) for each in asked]
    placed = place_objects(asked, motions, buildings, stretch=stretch)
    return assess_placed(placed, demand, sites, run=run)


def assess_placed(
    placed: PlacedObjects,
    demand: Demanded | None,
    sites: Sequence[HazardCurve | None],
    *,
    curves: bool = False,
    run: Execution | None = None,
) -> ObjectsTable:
    """Assess objects at their places; as `assess_objects`, which documents it.

    `demand` is that of the objects that state none of their own, `sites` the hazard curve of each
    as `site_of` returns it; `curves` counts curves without one too.
    """
    began = time.perf_counter()
    objects, built_in = placed.objects, placed.suite.built_in
    numbers: dict[object, int] = {}
    like = [
        numbers.setdefault(_key(*pair), len(numbers))
        for pair in zip(objects, placed.shakings, placed.plain, strict=True)
    ]
    places = dict(zip(reversed(like), reversed(range(len(like))), strict=True))
    firsts = [places[kind] for kind in range(len(numbers))]
    alike = replace(
        placed,
        objects=[objects[place] for place in firsts],
        shakings=[placed.shakings[place] for place in firsts],
        plain=[placed.plain[place] for place in firsts],
    )
    kinds = judge_objects(alike, run=run)
    fragilities: dict[int, Fragility] = {}
    for kind, (each, place) in enumerate(zip(alike.objects, firsts, strict=True)):
        site, shaking = sites[place], kinds[kind].shaking
        if not is_curved(kinds[kind], site, curves=curves) or shaking is None:
            if site is not None:
                kinds[kind] = without_rate(each, kinds[kind])
            continue
        fragility = curve_of(each, shaking, site, run)
        if fragility is not None:
            fragilities[kind] = fragility
        if site is not None:
            kinds[kind] = with_rate(each, kinds[kind], fragility, site, built_in=built_in)
    for kind, remedies in _worst_remedies(alike, kinds, run):
        kinds[kind] = replace(kinds[kind], remedies=remedies)
    moved = [
        {} if each.runs is None or each.stands else most_of_rocking(each.runs) for each in kinds
    ]
    heavy = {kind for each, kind in zip(objects, like, strict=True) if each.body.whole_mass_kg}
    forces = _forces_per_kg(alike, kinds, heavy, run)
    rows = []
    for each, kind in zip(objects, like, strict=True):
        row = _row(each, kinds[kind], placed.suite) | {"like": kind}
        row |= dict.fromkeys((*OUTPUTS, *FORCES)) | moved[kind]
        force, mass = forces[kind], each.body.whole_mass_kg
        if force is not None and mass is not None:
            row |= {key: mass * value for key, value in zip(FORCES, force, strict=True)}
        rows.append(row | _kept(each, row))
    return ObjectsTable(
        rows=tuple(rows),
        pga_g=None if demand is None else demand.pga_g,
        pgv_m_s=None if demand is None else demand.pgv_m_s,
        target=objects[0].target,
        suite=placed.suite,
        demands={kind: demand_of(each) for kind, each in enumerate(alike.objects)},
        shaking=_on_spectrum([each.shaking for each in kinds]),
        curves=fragilities,
        seconds=placed.seconds + time.perf_counter() - began,
    )


def _key(described: DescribedObject, shaking: Shaking | None, plain: Shaking | None) -> object:
    """Return what objects share that are alike in all that their answers depend on."""
    given = described.given
    return (
        described.block,
        tuple(variant.block for variant in described.variants()),
        id(shaking),
        id(plain),
        demand_of(described),
        given.demand.place,
        described.demand.vertical_at_peak_g,
        band_of(described),
        repr((given.friction, given.assessment)),
    )


def _worst_remedies(
    placed: PlacedObjects, judged: Sequence[Judged], run: Execution | None
) -> Iterator[tuple[int, tuple[Remedy, ...]]]:
    """Yield the places of the worst kinds of objects, with their least changes."""
    wanted = [
        (place, shaking)
        for place, (each, judgement) in enumerate(zip(placed.objects, judged, strict=True))
        if is_helped(judgement, each, built_in=placed.suite.built_in)
        and (shaking := judgement.shaking) is not None
    ]
    wanted.sort(key=lambda pair: -_share(judged[pair[0]]))
    some = wanted[:MOST_HELPED]
    asked = [(placed.objects[place], shaking) for place, shaking in some]
    yield from zip((place for place, _ in some), remedies_of(asked, run=run), strict=True)


def _share(judged: Judged) -> float:
    """Return the share that falls at the demand."""
    return 0.0 if judged.count is None else judged.count.share


def _forces_per_kg(
    placed: PlacedObjects, judged: Sequence[Judged], heavy: set[int], run: Execution | None
) -> list[tuple[float, float] | None]:
    """Return the forces on the base of 1 kg of each kind with a mass that was counted [kN]."""
    forces: list[tuple[float, float] | None] = [None] * len(judged)
    floors: dict[int, list[tuple[int, xarray.Dataset, Shaking]]] = {}
    for place, judgement in enumerate(judged):
        runs, shaking = judgement.runs, judgement.shaking
        if place in heavy and runs is not None and shaking is not None and not judgement.stands:
            floors.setdefault(id(shaking), []).append((place, runs, shaking))
    inner = None if run is None else replace(run, store=None, progress=None)
    for members in floors.values():
        places, runs_of, shakings = zip(*members, strict=True)
        blocks = [placed.objects[place].block for place in places]
        values = forces_of_rocking(
            runs_of, blocks, shakings[0].motions, [1.0] * len(blocks), run=inner
        )
        for place, force in zip(places, values, strict=True):
            forces[place] = force
    return forces


def _row(described: DescribedObject, judged: Judged, suite: Suite) -> dict[str, Any]:
    """Return the row of an object."""
    block, demand, given = described.block, described.demand, described.given
    asked = demand_of(described)
    side = first_side(block)
    uplift = uplift_acceleration_g(block, demand.vertical_at_peak_g)
    sentence = screen_of(described, judged, suite).sentence
    answer = answer_facts(judged, described.target, built_in=suite.built_in)
    return {
        "name": described.name,
        "kind": given.kind,
        "building": given.building,
        "floor": given.floor,
        "storey": described.storey,
        "place": given.demand.place,
        "pga_g": described.pga_g,
        "pgv_m_s": given.demand.pgv_m_s,
        "spectrum": asked.words_of_source if isinstance(asked, DesignSpectrum) else None,
        "floor_pga_g": demand.pga_g if described.on_floor else None,
        **{fact.key: fact.value for fact in answer if fact.key not in ("doubts", "conditions")},
        "alpha_rad": side.alpha,
        "p_rad_s": side.p,
        "uplift_pga_g": uplift,
        "friction": _friction(given.friction),
        "vertical_g": demand.vertical_g,
        "vertical_share": demand.vertical_share,
        **_least(judged.remedies, described.target),
        "sentence": f"{described.label}: {sentence[0].lower()}{sentence[1:]}",
    }


def _least(remedies: Sequence[Remedy], target: Target) -> dict[str, Any]:
    """Return the least changes of a row, in metres and in words; None where there is none."""
    row: dict[str, Any] = {}
    for change in CHANGES:
        remedy = next((each for each in remedies if each.change == change), None)
        key = change.replace(" ", "_")
        row |= {f"{key}_m": remedy and remedy.value, f"{key}_shown_m": remedy and remedy.shown_at}
    helped = next((each for each in remedies if each.values), None)
    return row | {"least_change": helped and change_words(helped, target)}


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
