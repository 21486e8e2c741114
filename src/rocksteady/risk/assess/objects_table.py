"""Many objects at once: a table in, a counted answer for each."""

import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.equations import Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.result import Result, words_module
from rocksteady.risk.assess._remedies import is_helped, remedies_of
from rocksteady.risk.assess.described.building import Building
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.judging import Judged, band_of, judge_objects
from rocksteady.risk.assess.placed_objects import (
    PlacedObjects,
    demand_of,
    place_objects,
    with_demand,
)
from rocksteady.risk.assess.rates import curve_of, is_curved, site_of, with_rate, without_rate
from rocksteady.risk.assess.remedy import Remedy
from rocksteady.risk.counted.suite import Demanded, Shaking, Suite
from rocksteady.risk.counted.verdict import CODES, VERDICTS, Target, Verdict
from rocksteady.risk.ensemble.qualification import (
    FORCES,
    OUTPUTS,
    forces_of_rocking,
    most_of_rocking,
)
from rocksteady.risk.fragility.fragility import Fragility
from rocksteady.risk.hazard.hazard_curve import HazardCurve
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

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


def _on_spectrum(shakings: Sequence[Shaking | None]) -> Shaking | None:
    """Return the first motions on a spectrum; None without one, or of several spectra."""
    placed = [each for each in shakings if each is not None and each.placing is not None]
    return placed[0] if len({each.demand for each in placed}) == 1 else None


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
    words, rows = words_module(ObjectsTable), []
    for each, kind in zip(objects, like, strict=True):
        row = words.row_of(each, kinds[kind], placed.suite) | {"like": kind}
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


def _kept(described: DescribedObject, row: Mapping[str, object]) -> dict[str, str]:
    """Return the further columns of an object's table; a name of the row is marked as given."""
    return {
        (f"{key} (given)" if key in row else key): text for key, text in described.extra.items()
    }
