"""Many objects under one demand: a probability, a colour and a sentence for each."""

import time
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.equations import Model, Nonlinear
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import MOST_MISFIT
from rocksteady.results.numbers import counted, number, number_or_none, plural, quantity
from rocksteady.results.result import Result
from rocksteady.risk.assess._answers import EACH, answer_of_table
from rocksteady.risk.assess._demand_level import PEAKS, DemandLevel, demand_level
from rocksteady.risk.assess._probability import (
    NO_ANSWER,
    AtDemand,
    Onset,
    Probability,
    count_at_demand,
    fit_fragilities,
    onset_of,
    probability_of,
)
from rocksteady.risk.assess._verdicts import (
    AMBER,
    MET,
    WORDS,
    colour_of,
    peak_words,
    verdict_of,
    with_article,
)
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.described.building import Building
from rocksteady.risk.assess.described.objects import DescribedObject
from rocksteady.risk.assess.placed_objects import (
    PGA,
    PGV,
    PlacedObjects,
    place_objects,
    with_demand,
)
from rocksteady.risk.assess.two_numbers import assess_by_formula, share_words
from rocksteady.risk.ensemble.qualification import (
    FORCES,
    OUTPUTS,
    forces_of_rocking,
    most_of_rocking,
    runs_near,
)
from rocksteady.risk.fragility.damage_states import OVERTURNED
from rocksteady.risk.fragility.fitting import FitOptions
from rocksteady.risk.screens.friction import uplift_acceleration_g
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.seismic.measures.scalar import Measure
from rocksteady.sweep.run import Execution

if TYPE_CHECKING:
    import xarray

METHOD = (
    "Each object is assessed as one of its own file: by the curve through its runs at all levels "
    "and restitutions, or, where no curve can be fitted, by the share of its runs at the demand; "
    "over PGV it is of the runs that lift."
)
ORDER = {"red": 0, "amber": 1, "grey": 2, "green": 3}
"""Place of a colour on the screen: an object without an answer comes before what is safe."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ObjectsTable(Result):
    """Objects under one demand, from `rocksteady.assess_objects`.

    Attributes
    ----------
    rows
        One mapping per object, in the order given: ``name``, ``kind``, ``building``, ``floor`` and
        its number ``storey``, its demand ``pga_g`` and ``pgv_m_s``, on a floor the largest
        ``floor_pga_g`` of the motions at that PGA, ``alpha_rad``, ``p_rad_s``,
        ``uplift_pga_g``, ``friction_needed``, ``friction_cause``, ``vertical_g`` and
        ``vertical_share``, ``lifted``, ``fell`` and ``trials`` of the runs at the demand,
        ``probability`` (with a PGV of the runs that lift) with its ``basis`` and ``method`` as in
        `Assessment`, where it was counted its interval from ``band_low`` to ``band_high``, the
        share ``counted`` at the demand, of those ``tried``, the probability ``by_curve`` and that
        by the ``closed_form``, ``colour``, ``class``, ``verdict`` and ``sentence``, and as in
        `Assessment.qualification` ``top_displacement_m``, ``clearance_m`` and ``edge_speed_m_s``,
        with a mass the `Assessment.base_force_kn` ``base_force_across_kn`` and
        ``base_force_down_kn``; further columns of its table after them.
    pga_g, pgv_m_s
        The demand of objects that state none of their own; the motions are scaled to its PGV,
        without one to its PGA.
    target_probability
        Above it an object is red, above a fifth of it amber.
    records, seconds
        Number of motions, and time that it took [s].
    """

    rows: tuple[dict[str, Any], ...]
    pga_g: float | None
    pgv_m_s: float | None
    target_probability: float
    records: int
    seconds: float

    @property
    def model(self) -> Model:
        """Equations of motion of the runs."""
        return Nonlinear()

    @property
    def meets_target(self) -> bool:
        """Whether every object stands, or is below the target."""
        return all(row["verdict"] in MET for row in self.rows)

    @property
    def demand(self) -> tuple[float | None, float | None] | None:
        """PGA [g] and PGV [m/s] of all objects; None where these differ."""
        peaks = {(row["pga_g"], row["pgv_m_s"]) for row in self.rows}
        return peaks.pop() if len(peaks) == 1 else None

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
        """The rows, by colour, and in each colour the highest probability first."""
        return sorted(self.sorted_by("probability"), key=lambda row: ORDER[row["colour"]])

    def describe(self) -> Description:
        """Return how many objects have which colour, and a row for each, the worst first."""
        colours = Counter(row["colour"] for row in self.rows)
        counts = {colour: colours[colour] for colour in ("red", "amber", "green", "grey")}
        target = 100.0 * self.target_probability
        columns = [
            Column("name", "object", left=True),
            Column("probability", "P"),
            Column("class", "chance", left=True),
            Column("colour", "colour", left=True),
            Column("verdict", "verdict", left=True),
        ]
        peaks = zip(self.demand or (), ("g of PGA", "m/s of PGV"), strict=False)
        known = [quantity(value, unit) for value, unit in peaks if value is not None]
        demand = " and ".join(known) or EACH
        words = ", ".join(f"{count} {colour}" for colour, count in counts.items() if count)
        facts = [
            Fact("objects", len(self.rows), "objects"),
            Fact("records", self.records, "records"),
            Fact("model", self.model.name, "model"),
            Fact("pga_g", self.pga_g),
            Fact("pgv_m_s", self.pgv_m_s),
            Fact("demand", demand, "demand"),
            Fact("target_probability", self.target_probability, "target", f"{number(target)} %"),
            Fact("colours", counts, "colours", words),
            Fact("method", METHOD),
            Fact("seconds", self.seconds),
        ]
        colours_mean = (
            f"Red is a probability above {number(target)} %, amber one above "
            f"{number(AMBER * target)} %, green one below, or so great a share of the runs at the "
            f"demand where it is more than {100.0 * MOST_MISFIT:g} points above the curve; grey is "
            "no answer, because the object slides or its friction is too low for rocking alone."
        )
        return Description(
            headline=f"{plural(len(self.rows), 'object')} at {demand}: {words}",
            facts=facts,
            tables=[
                Table(
                    "objects",
                    self.worst,
                    columns,
                    kind=lambda row: str(row["colour"]),
                    alarm="red",
                )
            ],
            notes=[colours_mean, METHOD, *CAVEATS],
            answer=answer_of_table(self, self.worst),
        )


@checked
def assess_objects(
    objects: Sequence[DescribedObject],
    motions: Sequence[Record | BaseMotion],
    *,
    buildings: Sequence[Building] = (),
    pga_g: Annotated[float | None, PGA] = None,
    pgv_m_s: Annotated[float | None, PGV] = None,
    target_probability: Annotated[float, Bounds(0.0, 1.0, "()", "give a probability")] = 0.1,
    run: Execution | None = None,
) -> ObjectsTable:
    """Assess many objects under one demand.

    Each gets the probability that `assess_object` gives for it under this demand, by the same
    method: its own runs at all levels and restitutions, with one curve through them.  Bands,
    sensitivity and remedies are left to `assess_object`.

    Parameters
    ----------
    objects
        As `read_objects` returns them; for a range the middle is taken.  Each keeps its own
        vertical motion and its options, the target excepted.
    motions
        Records of the ground or the floor, as for `assess_object`.
    buildings
        Buildings of the objects that state a floor, as `read_buildings` returns them: each such
        object has the motions of its floor, made once a floor, and motions and demand are those of
        the ground.  None by default.
    pga_g, pgv_m_s
        Peaks of the demand, [g] and [m/s], of the objects that state none of their own; one of the
        two at least.  With one alone it is the measure of an object whose own measure needs the
        other.  An object that the PGA does not lift stands.
    target_probability
        Above it an object is red, above a fifth of it amber; default 0.1.
    run
        Executor, workers, store and progress; default `Execution()`.  Objects on other floors, with
        other restitutions, or with sides that differ where those of the first do not, have stores
        of their own beside it, as runs-2.zarr.

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
    >>> table = assess_objects(objects, make_synthetic_suite(4), pga_g=0.4, pgv_m_s=0.5)
    >>> [(row["name"], row["colour"], row["verdict"]) for row in table.rows]
    [('vase', 'red', 'above target'), ('chest', 'green', 'stands')]
    """
    asked = [with_demand(each, pga_g, pgv_m_s) for each in objects]
    placed = place_objects(asked, motions, buildings)
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
    shaken = placed.motions
    asked = [each.with_target(target_probability) for each in placed.objects]
    intensities = [_measure_of(each) for each in asked]
    levels = [
        demand_level(intensity, each.given.demand, moved, each.block, each.source)
        for each, moved, intensity in zip(asked, shaken, intensities, strict=True)
    ]
    onsets = [onset_of(each) for each in asked]
    rocking = [place for place, onset in enumerate(onsets) if not onset.slides]
    fitted = fit_fragilities(
        [asked[place] for place in rocking],
        [shaken[place] for place in rocking],
        [intensities[place] for place in rocking],
        FitOptions(states=[OVERTURNED], bands=None, measures=()),
        run=run,
    )
    fragilities = dict(zip(rocking, fitted, strict=True))
    inner = None if run is None else replace(run, store=None, progress=None)
    counts = count_at_demand(asked, shaken, levels, run=inner)
    rows: list[dict[str, Any]] = []
    near: dict[int, xarray.Dataset] = {}
    for place, (each, onset, level) in enumerate(zip(asked, onsets, levels, strict=True)):
        answer = NO_ANSWER
        if place in fragilities:
            share, band = counts[place].share, counts[place].band
            answer = probability_of(each, onset, fragilities[place], level, share, band)
        row = _row(each, onset, answer, level, counts[place]) | dict.fromkeys((*OUTPUTS, *FORCES))
        if place in fragilities and answer.basis != "statics":
            runs, measure = fragilities[place].ensemble, fragilities[place].measure
            near[place] = runs_near(runs, level.of(measure, each.block))
            row |= most_of_rocking(near[place])
        rows.append(row | _kept(each, row))
    for places in _by_floor(shaken, near):
        forces = forces_of_rocking(
            [near[place] for place in places],
            [asked[place].block for place in places],
            shaken[places[0]],
            [asked[place].body.whole_mass_kg for place in places],
            run=inner,
        )
        for place, force in zip(places, forces, strict=True):
            rows[place] |= dict(zip(FORCES, force or (), strict=False))
    return ObjectsTable(
        rows=tuple(rows),
        pga_g=peaks[0],
        pgv_m_s=peaks[1],
        target_probability=target_probability,
        records=len(placed.suite),
        seconds=placed.seconds + time.perf_counter() - began,
    )


def _by_floor(
    motions: Sequence[Sequence[Record | BaseMotion]], places: Iterable[int]
) -> list[list[int]]:
    """Return the numbers of the objects that stand on each floor."""
    floors: dict[int, list[int]] = {}
    for place in places:
        floors.setdefault(id(motions[place]), []).append(place)
    return list(floors.values())


def _measure_of(described: DescribedObject) -> Measure:
    """Return an object's measure of intensity; of a demand with one peak alone that peak."""
    options, demand = described.given.assessment, described.given.demand
    measure = Measure(options.intensity_measure, options.period_s)
    peak = PEAKS.get(measure.name)
    if peak is None or getattr(demand, peak) is not None:
        return measure
    return Measure("pga_g" if demand.pgv_m_s is None else "pgv_m_s")


def _row(
    described: DescribedObject,
    onset: Onset,
    answer: Probability,
    level: DemandLevel,
    counts: AtDemand,
) -> dict[str, Any]:
    """Return the row of an object."""
    block, demand, target = (
        described.block,
        described.demand,
        described.given.assessment.target_probability,
    )
    closed, on_floor = None, described.on_floor
    if (
        not on_floor
        and demand.pga_g is not None
        and demand.pgv_m_s is not None
        and not block.one_sided
    ):
        closed = assess_by_formula(
            block,
            demand.pga_g,
            demand.pgv_m_s,
            vertical_g=demand.vertical_g,
            vertical_share=demand.vertical_share,
        ).probability
    colour = colour_of(answer.value, target)
    side, need = first_side(block), onset.friction_needed
    return {
        "name": described.name,
        "kind": described.given.kind,
        "building": described.given.building,
        "floor": described.given.floor,
        "storey": described.storey,
        "pga_g": described.given.demand.pga_g,
        "pgv_m_s": described.given.demand.pgv_m_s,
        "floor_pga_g": demand.pga_g if described.on_floor else None,
        "colour": colour,
        "class": WORDS[colour],
        "probability": answer.value,
        "basis": answer.basis,
        "method": answer.method,
        "counted": number_or_none(counts.share),
        "by_curve": answer.by_curve,
        "closed_form": closed,
        **{key: count for key, count in counts._asdict().items() if key != "band"},
        "band_low": answer.band and answer.band[0],
        "band_high": answer.band and answer.band[1],
        "alpha_rad": side.alpha,
        "p_rad_s": side.p,
        "uplift_pga_g": uplift_acceleration_g(block, demand.vertical_at_peak_g),
        "friction_needed": need and need.largest,
        "friction_cause": need and need.cause,
        "vertical_g": demand.vertical_g,
        "vertical_share": demand.vertical_share,
        "verdict": verdict_of(answer, target),
        "sentence": _sentence(described, answer, level, counts),
    }


def _kept(described: DescribedObject, row: Mapping[str, object]) -> dict[str, str]:
    """Return the further columns of an object's table; a name of the row is marked as given."""
    return {
        (f"{key} (given)" if key in row else key): text for key, text in described.extra.items()
    }


def _sentence(
    described: DescribedObject, answer: Probability, level: DemandLevel, counts: AtDemand
) -> str:
    """Return the one sentence on an object."""
    name, fell, runs = described.label, counts.fell, plural(counts.tried, "run")
    if level.measure.given_uplift:
        runs += " that lift"
    if answer.value is None and answer.basis is not None:
        return f"No answer yet for {name}: no run lifts at {with_article(level.words)}."
    if answer.value is None:
        return f"{name} slides at {_peak(described)}: rocking is no answer."
    if answer.basis == "statics":
        return f"{name} stands: {_peak(described)} does not lift it."
    if answer.by_curve is None:  # a share is no smaller than one of the runs
        return f"{name}: {counted(fell, f'its {runs}')} at {with_article(level.words)}."
    decides = ", which decides" if answer.basis == "count" else ""
    share = share_words(answer.by_curve).lower()
    return (
        f"{name}: {share} objects of its shape and size would fall at "
        f"{with_article(level.words)}; of its {runs} there {fell or 'none'} fell{decides}."
    )


def _peak(described: DescribedObject) -> str:
    """Return the peak acceleration of an object's demand in words."""
    return peak_words(described.demand, on_floor=described.on_floor)
