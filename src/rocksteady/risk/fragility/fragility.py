"""Fragility: counted shares of all damage states over levels, with the runs behind them."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.results.answer import Answer
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, number_or_none, plural, share_of
from rocksteady.results.result import Result
from rocksteady.results.stated import Stated, facts_stated, runs_that, share_words
from rocksteady.risk.counted.verdict import LEAST
from rocksteady.risk.fragility.damage_states import UPLIFT, DamageState
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.seismic.measures.scalar import Measure

if TYPE_CHECKING:
    import xarray

MOST_SCALED: Final = 10.0
"""Factor of a record beyond which an answer states the largest."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Fragility(Result):
    """Fragility of blocks, from `rocksteady.compute_fragility`.

    Attributes
    ----------
    ensemble
        The runs.
    measure
        What the levels are in; None of plain factors.
    states
        Counted shares of each damage state, each containing the next.
    warnings
        Sentences on what limits the answer.
    records, runs
        Number of records and of runs; mirror images are runs that count once.
    friction, friction_needed
        Coefficient of friction that is given, and the one that rocking takes at the level where
        half reach the last state, or at the last level.
    slides_above
        Level above which it slides, where the levels end before it; else None.
    seconds
        Time that it took [s].
    """

    ensemble: "xarray.Dataset"
    measure: Measure | None
    states: tuple[StateFragility, ...]
    warnings: tuple[str, ...]
    records: int
    runs: int
    friction: float | None = None
    friction_needed: float | None = None
    slides_above: float | None = None
    seconds: float = 0.0

    @property
    def model(self) -> Model:
        """Equations of motion of the runs."""
        return Nonlinear() if self.ensemble.attrs["model"] == "nonlinear" else Linear()

    @property
    def key(self) -> str:
        """The measure's name in files."""
        return str(self.ensemble.attrs["measure"])

    @property
    def unit(self) -> str:
        """Unit of the levels; empty where they have none."""
        return "" if self.measure is None else self.measure.unit

    @property
    def scale_factor_max(self) -> float:
        """Largest factor of a record's accelerations."""
        return float(self.ensemble["scale"].max())

    def state(self, name: str) -> StateFragility:
        """Return the shares of a damage state.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        for each in self.states:
            if each.state.name == name:
                return each
        known = ", ".join(each.state.name for each in self.states)
        raise InputError("name", name, f"the damage states are {known}", "give one of them")

    def describe(self) -> Description:
        """Return the counted shares of all states, and what summarises them."""
        ensemble, last = self.ensemble, self.states[-1]
        sentence = self._sentence()
        columns = (
            Column("level", f"level [{self.unit}]" if self.unit else "level", number),
            Column("runs", "runs"),
            *(Column(each.state.name, verb_of(each.state)) for each in self.states),
        )
        facts = [
            Fact("measure", self.key, "intensity", str(self.measure or "factor")),
            Fact("unit", self.unit),
            Fact("model", self.model.name, "model"),
            Fact("records", self.records, "records"),
            Fact("runs", self.runs, "runs"),
            Fact("blocks", int(ensemble.sizes["block"])),
            Fact("levels", last.curve.levels.tolist()),
            Fact("uplift_level", number_or_none(float(last.curve.lifts_at[0]))),
            Fact("restitution", ensemble["restitution"].values.tolist()),
            Fact("scatter", float(ensemble.attrs["scatter"])),
            Fact("directions", [str(each) for each in ensemble["direction"].values]),
            Fact("vertical", [str(each) for each in ensemble["vertical"].values]),
            Fact("friction", self.friction),
            Fact("friction_needed", self.friction_needed),
            Fact("scale_factor_max", self.scale_factor_max, "largest scale factor"),
            Fact("seconds", self.seconds),
            Fact("warnings", list(self.warnings)),
        ]
        return Description(
            headline=sentence,
            facts=facts,
            tables=[
                Table("shares", [row for each in self.states for row in each.rows]),
                Table("fits", [each.summary_row for each in self.states]),
                Table("", self._shown_rows(), columns, title="Counted shares"),
            ],
            notes=self.warnings,
            answer=Answer(sentence, facts_stated(self._lines())),
        )

    def _level(self, value: float) -> str:
        """Return a level in words."""
        label = "" if self.measure is None else self.measure.label
        return f"{number(value)} {self.unit}" if self.unit else f"{label} {number(value)}".strip()

    def _sentence(self) -> str:
        """Return where half of the runs reach the last state, or how many do at most."""
        last = self.states[-1]
        verb, half = verb_of(last.state), last.half
        label = "the records" if self.measure is None else self.measure.label
        if self.records < LEAST:
            verb = "gives" if self.records == 1 else "give"
            who = plural(self.records, "record")
            return f"No answer: {who} {verb} no share, {LEAST} are the least."
        if half is None:
            place = 0 if last.curve.steps[0] > 0.5 else -1
            end, count = ("lowest", "highest")[place], last.curve.counts[place]
            words = share_words(count.falls, count.runs, count.band, count.share)
            at = f"{self._level(float(last.curve.levels[place]))}, the {end} level"
            first, space, beyond = verb.capitalize().partition(" ")
            verbs = f"{first}s{space}{beyond}"
            return f"{runs_that(verbs, count.falls, count.runs)} at {at}: {words}."
        value, low, high = half
        stated = Stated(
            quantity=f"Half {verb} at",
            value=value,
            unit=self.unit,
            band=(low, high) if low and high else None,
        )
        of = "" if self.measure is None else f" of {label}" if self.unit else f" {label}"
        return f"{stated.quantity} {stated.number}{of}{stated.interval}."

    def _lines(self) -> list[Stated]:
        """Return what stands below the sentence."""
        last, few = self.states[-1], self.records < LEAST
        runs = f"{self.runs:,} runs, {plural(self.records, 'record')}"
        lines = [
            Stated(
                quantity="lifts at",
                value=float(last.curve.lifts_at[0]),
                unit=self.unit,
                evidence="in the record that lifts it first",
            )
            if math.isfinite(last.curve.lifts_at[0])
            else Stated(quantity="lifts at", text="no level: no record lifts it"),
            Stated(
                quantity="counted",
                text=runs,
                condition="" if last.curve.is_monotone else "fewer fall at some higher level",
            ),
            *([] if few else [self._summary(last)]),
        ]
        if self.friction_needed is not None:
            given, above = self.friction, self.slides_above
            where = "" if few or last.half is None else f" where half {verb_of(last.state)}"
            lines.append(
                Stated(
                    quantity="friction",
                    text=f"needs {number(self.friction_needed)}{where}",
                    evidence="it is not given" if given is None else f"given {number(given)}",
                    condition="" if above is None else f"it slides above {self._level(above)}",
                )
            )
        if self.scale_factor_max > MOST_SCALED:
            words = f"records by up to {number(self.scale_factor_max)} x: check these"
            lines.append(Stated(quantity="scaled", text=words))
        lines += [
            Stated(quantity=f"half {verb_of(each.state)}", value=each.half[0], unit=self.unit)
            for each in self.states[-2:-1]
            if each.half is not None and each.state.name != UPLIFT and not few
        ]
        return lines

    def _summary(self, last: StateFragility) -> Stated:
        """Return median and beta, where they summarise the points."""
        best, misfit = last.lognormal, f"{number(100.0 * last.lognormal.misfit, 2)} points"
        if math.isnan(best.beta):
            return Stated(quantity="lognormal", text="none: use the points")
        if not last.is_lognormal:
            words = f"none: the best is {misfit} from the counts; use the points"
            return Stated(quantity="lognormal", text=words)
        return Stated(
            quantity="lognormal",
            text=f"median {number(best.median)} {self.unit}".rstrip()
            + f", beta {number(best.beta)}",
            evidence=f"within {misfit} of the counts",
        )

    def _shown_rows(self) -> list[dict[str, Any]]:
        """Return a row for each level, with the share of each state."""
        curve = self.states[-1].curve
        return [
            {
                "level": level,
                "runs": curve.counts[place].runs,
                **{
                    each.state.name: share_of(each.curve.counts[place].share)
                    for each in self.states
                },
            }
            for place, level in enumerate(curve.levels.tolist())
        ]


def verb_of(state: DamageState) -> str:
    """Return what a block does in a damage state, in a word or two."""
    if state.peak is not None:
        return f"tilt > {state.peak:g} alpha"
    return {"uplift": "lift", "overturned": "fall"}[state.name]
