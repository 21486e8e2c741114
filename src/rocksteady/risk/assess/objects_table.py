"""Many objects under one demand: a probability, a colour and a sentence for each."""

import math
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.block import Block
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.checks.validation import in_range
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, plural, quantity
from rocksteady.results.result import Result
from rocksteady.risk.assess._counts import count_runs
from rocksteady.risk.assess._verdicts import AMBER, WORDS, colour_of
from rocksteady.risk.assess.caveats import CAVEATS
from rocksteady.risk.assess.described.objects import ObjectFile, bounds_of
from rocksteady.risk.assess.two_numbers import assess_two_numbers, share_words
from rocksteady.risk.ensemble.levels import Stripes
from rocksteady.risk.ensemble.restitution_band import RestitutionBand
from rocksteady.risk.ensemble.runs import run_ensemble
from rocksteady.risk.fits.vector_fit import VectorFit, fit_vector
from rocksteady.risk.screens.friction import (
    first_motion,
    needed_friction,
    uplift_acceleration_g,
)
from rocksteady.seismic.measures.free_sides import first_side
from rocksteady.sweep.run import Run

Integers = NDArray[np.int64]

FEWEST = 5
"""Objects that lift, below which no curve is fitted through all of them."""
MEASURES = ("p PGV/(g tan alpha)", "tan alpha")
"""What the curve of all objects is over."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ObjectsTable(Result):
    """Objects under one demand, from `rocksteady.assess_objects`.

    Attributes
    ----------
    rows
        One mapping per object, in the order given: ``name``, ``kind``, ``alpha_rad``, ``p_rad_s``,
        ``uplift_pga_g``, ``friction_needed``, ``lifted``, ``fell`` and ``trials`` of the runs,
        ``probability`` and the same ``counted``, ``fitted`` and by the ``closed_form``, ``colour``,
        ``class``, ``verdict`` and ``sentence``; further columns of its table after them.
    pga_g, pgv_m_s
        The demand; the motions are scaled to its PGV, without one to its PGA.
    target_probability
        Above it an object is red, above a fifth of it amber.
    curve
        P(falls | lifts) over p PGV/(g tan alpha) and tan alpha of all objects and motions, or over
        the first alone where all have one shape or one size; None where too few lift, or without a
        PGV.
    records, seconds
        Number of motions, and time that it took [s].
    """

    rows: tuple[dict[str, Any], ...]
    pga_g: float | None
    pgv_m_s: float | None
    target_probability: float
    curve: VectorFit | None
    records: int
    seconds: float

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
        demand = " and ".join(
            quantity(value, unit)
            for value, unit in ((self.pga_g, "g of PGA"), (self.pgv_m_s, "m/s of PGV"))
            if value is not None
        )
        words = ", ".join(f"{count} {colour}" for colour, count in counts.items() if count)
        facts = [
            Fact("objects", len(self.rows), "objects"),
            Fact("records", self.records, "records"),
            Fact("pga_g", self.pga_g),
            Fact("pgv_m_s", self.pgv_m_s),
            Fact("demand", demand, "demand"),
            Fact("target_probability", self.target_probability, "target", f"{number(target)} %"),
            Fact("colours", counts, "colours", words),
            Fact("seconds", self.seconds),
        ]
        colours_mean = (
            f"Red is a probability above {number(target)} %, amber one above "
            f"{number(AMBER * target)} %, green one below; grey is no answer, because the object "
            "slides or its friction is too low for rocking alone."
        )
        source = (
            "The probability is that of the curve through the runs of all objects where there is "
            "one, else the share of the object's own runs; each has its own restitution alone. "
            "Objects against a wall are no part of the curve."
        )
        return Description(
            headline=f"{plural(len(self.rows), 'object')} at {demand}: {words}",
            facts=facts,
            tables=[
                Table(
                    "objects",
                    self.sorted_by("probability"),
                    columns,
                    kind=lambda row: str(row["colour"]),
                    alarm="red",
                )
            ],
            notes=[colours_mean, source, *CAVEATS],
        )


@checked
def assess_objects(
    objects: Sequence[ObjectFile],
    motions: Sequence[Record | BaseMotion],
    *,
    pga_g: float | None = None,
    pgv_m_s: float | None = None,
    target_probability: float = 0.1,
    run: Run | None = None,
) -> ObjectsTable:
    """Assess many objects under one demand, in one sweep.

    Every object meets every motion in both signs, without vertical motion and with its own
    restitution, at one level.  Of all that lift one curve is fitted over p PGV/(g tan alpha) and
    tan alpha, so that the probability of an object does not hang on a few dozen runs alone.  Over
    the first alone large slender objects would get half of what their runs show: at one PGV it does
    not distinguish a slender object from a small one.

    Parameters
    ----------
    objects
        As `read_objects` returns them; for a range the middle is taken.
    motions
        Records of the ground or the floor.
    pga_g, pgv_m_s
        Peaks of the demand, [g] and [m/s]; one of the two at least.  Motions are scaled to the PGV
        where it is given.  An object that the PGA does not lift stands.
    target_probability
        Above it an object is red, above a fifth of it amber; default 0.1.
    run
        Executor, workers, store and progress; default `Run()`.

    Returns
    -------
    ObjectsTable
        A row for each object.

    Raises
    ------
    InputError, ModelError
        If there are no objects or no motions, or no peak.

    Examples
    --------
    >>> from rocksteady import ObjectFile, assess_objects, make_synthetic_suite
    >>> sizes = {"vase": (0.12, 0.5), "chest": (0.9, 1.1)}
    >>> objects = [
    ...     ObjectFile(values={"name": name, "geometry": {"width_m": b, "height_m": h}})
    ...     for name, (b, h) in sizes.items()
    ... ]
    >>> table = assess_objects(objects, make_synthetic_suite(4), pga_g=0.4, pgv_m_s=0.5)
    >>> [(row["name"], row["colour"], row["verdict"]) for row in table.rows]
    [('vase', 'red', 'above target'), ('chest', 'green', 'stands')]
    """
    began = time.perf_counter()
    bodies, suite = [*objects], [*motions]
    for name, things in (("objects", bodies), ("motions", suite)):
        if not things:
            raise InputError(name, [], "there must be one or more", "give a list")
    target = in_range(
        "target_probability", target_probability, 0.0, 1.0, "()", hint="give a probability"
    )
    peaks = [
        None if value is None else in_range(key, value, 0.0, most, hint=hint)
        for key, value, most, hint in (
            ("pga_g", pga_g, 10.0, "give the peak in g; 0.3 is usual"),
            ("pgv_m_s", pgv_m_s, 10.0, "give the peak in m/s; 0.4 is usual"),
        )
    ]
    pga, pgv = peaks
    level = pgv if pgv is not None else pga
    if level is None:
        raise ModelError(
            "pga_g, pgv_m_s",
            Words("are both missing"),
            "objects are assessed at a peak velocity, a peak acceleration or both",
            "give the PGV, and the PGA where it is known",
        )
    blocks = [each.block for each in bodies]
    ensemble = run_ensemble(
        blocks,
        suite,
        stripes=Stripes("pgv_m_s" if pgv is not None else "pga_g", [level], beside=()),
        restitution=RestitutionBand(draws=1),
        vertical=False,
        run=run,
    )
    counts = count_runs(ensemble, blocks)
    trials, lifted, fell = (
        np.array([getattr(each, name)[:, 0] for each in counts])
        for name in ("trials", "lifted", "fell")
    )
    curve = None if pgv is None else _pooled(blocks, pgv, lifted, fell)
    rows = tuple(
        _row(described, block, (pga, pgv), target, curve, (trials[k], lifted[k], fell[k]))
        for k, (described, block) in enumerate(zip(bodies, blocks, strict=True))
    )
    return ObjectsTable(
        rows=rows,
        pga_g=pga,
        pgv_m_s=pgv,
        target_probability=target,
        curve=curve,
        records=len(suite),
        seconds=time.perf_counter() - began,
    )


def _pooled(
    blocks: Sequence[Block], pgv: float, lifted: Integers, fell: Integers
) -> VectorFit | None:
    """Return P(falls | lifts) of all objects that stand free of walls.

    None where too few lift, or no curve fits.
    """
    free = np.array([not block.one_sided for block in blocks])
    lifted = np.where(free[:, np.newaxis], lifted, 0)
    if (lifted.sum(axis=1) > 0).sum() < FEWEST:
        return None
    uplifted = lifted > 0
    records = np.broadcast_to(np.arange(lifted.shape[1]), lifted.shape)[uplifted]
    points = np.array([_point(block, pgv) for block in blocks])
    for width in (2, 1):
        at = np.broadcast_to(points[:, np.newaxis, :width], (*lifted.shape, width))[uplifted]
        try:
            curve = fit_vector(
                at, fell[uplifted], lifted[uplifted], groups=records, names=MEASURES[:width]
            )
        except InputError:  # of one shape, or of one size: the two depend on each other
            continue
        if curve.status == "fitted" and curve.coefficients[1] > 0.0:
            return curve
    return None


def _point(block: Block, pgv: float) -> tuple[float, float]:
    """Return p PGV/(g tan alpha) and tan alpha of the side that lifts first."""
    side = first_side(block)
    slope = tan(side.alpha)
    return side.p * pgv / (block.gravity * slope), slope


def _row(
    described: ObjectFile,
    block: Block,
    peaks: tuple[float | None, float | None],
    target: float,
    curve: VectorFit | None,
    runs: tuple[Integers, Integers, Integers],
) -> dict[str, Any]:
    """Return the row of an object."""
    pga, pgv = peaks
    trials, lifted, fell = (int(each.sum()) for each in runs)
    friction = described.given.friction
    motion = None
    if pga is not None:
        motion = first_motion(block, pga, 100.0 if friction is None else bounds_of(friction)[0])
    closed, fitted, counted = None, None, fell / trials
    if pga is not None and pgv is not None and not block.one_sided:
        closed = assess_two_numbers(block, pga, pgv).probability
    if curve is not None and pgv is not None and not block.one_sided:
        falls = float(curve.probability(np.array(_point(block, pgv)[: len(curve.names)])))
        fitted = None if math.isnan(falls) else falls * lifted / trials
    probability: float | None = counted if fitted is None else fitted
    if motion == "rest":
        probability = 0.0
    elif motion in ("slides", "slides and rocks"):
        probability = None
    colour = colour_of(probability, target)
    side = first_side(block)
    row = {
        "name": described.name,
        "kind": described.given.kind,
        "colour": colour,
        "class": WORDS[colour],
        "probability": probability,
        "counted": counted,
        "fitted": fitted,
        "closed_form": closed,
        "fell": fell,
        "lifted": lifted,
        "trials": trials,
        "alpha_rad": side.alpha,
        "p_rad_s": side.p,
        "uplift_pga_g": uplift_acceleration_g(block),
        "friction_needed": None if pga is None else needed_friction(block, pga),
        "verdict": _verdict(probability, motion, target),
        "sentence": _sentence(
            described.name, probability, motion, (fell, trials), peaks, fitted=fitted is not None
        ),
    }
    return row | {
        (f"{key} (given)" if key in row else key): text for key, text in described.extra.items()
    }


def _verdict(probability: float | None, motion: str | None, target: float) -> str:
    """Return the verdict in two words."""
    if probability is None:
        return "slides"
    if motion == "rest":
        return "stands"
    return "above target" if probability > target else "below target"


def _sentence(
    name: str,
    probability: float | None,
    motion: str | None,
    runs: tuple[int, int],
    peaks: tuple[float | None, float | None],
    *,
    fitted: bool,
) -> str:
    """Return the one sentence on an object."""
    pga, pgv = peaks
    if probability is None:
        return f"{name} slides at a PGA of {number(pga or 0.0)} g: rocking is no answer."
    if motion == "rest":
        return f"{name} stands: a PGA of {number(pga or 0.0)} g does not lift it."
    level = f"a PGV of {number(pgv)} m/s" if pgv is not None else f"a PGA of {number(pga or 0.0)} g"
    fell, trials = runs
    if not fitted:  # a share is no smaller than one of the runs
        return f"{name}: {fell or 'none'} of its {trials} runs fall at {level}."
    return (
        f"{name}: {share_words(probability).lower()} objects of its shape and size would fall at "
        f"{level}; in {fell} of its own {trials} runs it fell."
    )
