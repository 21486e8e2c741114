"""Fragility of blocks: the curves of all damage states, their points, and the runs."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.validation import LARGEST, in_range
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.results.answer import Answer
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.doubts import FEW_RECORDS, MOST_MISFIT, with_misfit
from rocksteady.results.numbers import number, number_or_none, plural
from rocksteady.results.result import Result
from rocksteady.risk.ensemble.gates import condition_of
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve
from rocksteady.risk.fits.vector_fit import VectorCurve
from rocksteady.risk.fragility.damage_states import DamageState
from rocksteady.risk.fragility.efficiency import Efficiency
from rocksteady.risk.fragility.fitting import FitOptions
from rocksteady.risk.fragility.state_fragility import StateFragility
from rocksteady.seismic.measures.scalar import Measure

if TYPE_CHECKING:
    import xarray

_RANKING: Final = (
    Column("measure", "measure (or pair)", left=True),
    Column("beta", "beta"),
    Column("log_likelihood_per_run", "log-likelihood per run", "{:.3f}".format),
)

GOOD_ENOUGH: Final = 0.15
"""Misfit beyond which a curve is no answer."""
MOST_SCALED: Final = 10.0
"""Factor of a record beyond which an answer states the largest."""
_LEGEND: Final = (
    "Median and beta (standard deviation of the logarithm) with their bands; beta is given uplift "
    "where the curve has two stages, and over PGV all is. Misfit: largest difference between the "
    "curve and the share of runs at a level. Stages: 2, uplift and failure given uplift, where "
    "their gain, the log-likelihood above that of one curve, is above 0, or the gate is exact. "
    "Efficiency, of one curve of all runs over each measure: that of the highest log-likelihood "
    "predicts best."
)
"""What the columns mean."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Fragility(Result):
    """Fragility of blocks, from `rocksteady.compute_fragility`.

    Attributes
    ----------
    ensemble
        The runs.
    measure
        Measure of the curves' axis.
    states
        Curves and points of each damage state.
    surface
        Probability of the last damage state of the runs that lift, over PGA [g] and PGV [m/s]; None
        without either beside the runs, for records of one shape, or where no run lifts.
    ranking
        Measures by efficiency for the last damage state, the best first.
    fitting
        Options of the fits.
    warnings
        Sentences on what limits the answer.
    records, runs
        Number of records and of runs; mirror images are runs that count once.
    scale_factor_max
        Largest factor of a record's accelerations.
    seconds
        Time that it took [s].
    """

    ensemble: "xarray.Dataset"
    measure: Measure
    states: tuple[StateFragility, ...]
    surface: VectorCurve | None = None
    ranking: tuple[Efficiency, ...]
    fitting: FitOptions
    warnings: tuple[str, ...]
    records: int
    runs: int
    scale_factor_max: float
    seconds: float

    @property
    def model(self) -> Model:
        """Equations of motion of the runs."""
        return Nonlinear() if self.ensemble.attrs["model"] == "nonlinear" else Linear()

    def state(self, name: str) -> StateFragility:
        """Return the fragility of a damage state.

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

    def by_both_peaks(self, pga_g: float | None, pgv_m_s: float | None) -> float | None:
        """Return the probability of the last damage state at a PGA and a PGV, of what lifts.

        None where either is None, or the surface is not fitted.

        Parameters
        ----------
        pga_g, pgv_m_s
            Peaks of the ground [g], [m/s].

        Raises
        ------
        InputError
            If a peak is not above 0, or not within 1e-50 to 1e50.
        """
        if pga_g is None or pgv_m_s is None:
            return None
        least = 1.0 / LARGEST
        pga = in_range("pga_g", pga_g, least, LARGEST, "[]", hint="give the PGA in g")
        pgv = in_range("pgv_m_s", pgv_m_s, least, LARGEST, "[]", hint="give the PGV in m/s")
        if self.surface is None:
            return None
        share = float(self.surface.probability([pga, pgv]))
        return None if math.isnan(share) else share

    @property
    def surface_words(self) -> str:
        """What PGA and PGV explain together, beside one of them alone; empty without."""
        if self.surface is None or math.isnan(self.surface.coefficients[0]):
            return ""
        words = f"explain {number(100.0 * self.surface.explained, 2)} % of the deviance"
        curve, surface = _shape(self.states[-1]), self.surface
        if curve.trials == surface.trials and curve.measure[0] in surface.names:
            flat = surface.log_likelihood / (1.0 - surface.explained)
            share = 1.0 - curve.log_likelihood / flat
            words += f", {curve.measure[0]} alone {number(100.0 * share, 2)} %"
        return words

    def describe(self) -> Description:
        """Return the curves of all states, their points and the ranking."""
        measure, ensemble = self.measure, self.ensemble
        bands = self.fitting.bands
        last = self.states[-1]
        fits = [row for each in self.states for row in each.rows(self.measure.key)]
        facts = [
            Fact("measure", measure.key, "intensity", str(measure)),
            Fact("unit", measure.unit),
            Fact("stripes", str(ensemble.attrs["measure"])),
            Fact("model", self.model.name, "model"),
            Fact("family", self.fitting.family, "family"),
            Fact("confidence", None if bands is None else bands.confidence),
            Fact("replicates", None if bands is None else bands.replicates),
            Fact("seed", None if bands is None else bands.seed),
            Fact("records", self.records, "records"),
            Fact("runs", self.runs, "runs"),
            Fact("cells", int(ensemble["status"].size)),
            Fact("blocks", int(ensemble.sizes["block"])),
            Fact("levels", ensemble["level"].values.tolist()),
            Fact("restitution", ensemble["restitution"].values.tolist()),
            Fact("scatter", float(ensemble.attrs["scatter"])),
            Fact("directions", [str(each) for each in ensemble["direction"].values]),
            Fact("vertical", [str(each) for each in ensemble["vertical"].values]),
            Fact(
                "scale_factor_max",
                self.scale_factor_max,
                "largest scale factor",
            ),
            Fact(
                "surface",
                None if self.surface is None else self.surface.describe().to_dict(),
                "PGA and PGV" if self.surface_words else "",
                self.surface_words,
            ),
            Fact("seconds", self.seconds),
            Fact("warnings", list(self.warnings)),
        ]
        return Description(
            headline=self._headline(),
            facts=facts,
            tables=[
                Table("fits", fits),
                Table("", [_shown_row(each) for each in self.states], _columns(self.measure.unit)),
                Table("points", self._points()),
                Table("ranking", self._ranking()),
                Table(
                    "",
                    self._best(),
                    _RANKING,
                    title=f"Efficiency of measures, {last.state.name}, of one curve of all runs",
                ),
            ],
            notes=[_LEGEND, *self.warnings],
            answer=self._answer(),
        )

    def _answer(self) -> Answer:
        """Return where half of the blocks reach the last damage state, and other states."""
        *others, last = self.states
        curve, shape = last.curve, _shape(last)
        half = "If lifted, half" if last.given_uplift else "Half of them"
        half += f" {_verb(last.state)} at {self._median_words(last)}"
        if not math.isnan(shape.beta):
            half += f", {self._beta_words()}"
        if shape.step is not None and shape.step[0] == shape.step[1]:
            half += ", a step"
        sentence, provisional = f"{half}.", ""
        if math.isnan(curve.median):
            headline = shape.describe().headline
            sentence = f"No answer yet where half of them {_verb(last.state)}: {headline}."
        elif curve.misfit > GOOD_ENOUGH:
            sentence = "No answer yet: the curve misses the counted shares."
            provisional = half
        points = f"within {number(100.0 * curve.misfit, 2)} points of the counts; "
        if curve.misfit > MOST_MISFIT:
            points = f"poor: up to {number(100.0 * curve.misfit, 2)} points off the counts; "
        few = f" (curves need {FEW_RECORDS})" if self.records < FEW_RECORDS else ""
        runs = f"{self.runs:,} runs, {plural(self.records, 'record')}{few}"
        large = f"records by up to {number(self.scale_factor_max)} x: check these"
        facts = [
            ("provisional", provisional),
            ("fit", runs if math.isnan(curve.misfit) else points + runs),
            ("scaled", large if self.scale_factor_max > MOST_SCALED else ""),
        ]
        rows = [
            (
                _verb(each.state).removeprefix("tilt "),
                "if lifted, " * each.given_uplift + f"half at {self._median_words(each)}",
            )
            for each in others
            if not math.isnan(each.curve.median)
        ]
        return Answer(sentence, [*facts[:1], *rows[:2], *facts[1:]])

    def _median_words(self, each: StateFragility) -> str:
        """Return the median of a damage state with its interval, in the measure."""
        curve, unit = each.curve, self.measure.unit
        name = self.measure.label
        words = f"{number(curve.median)} {unit} of {name}" if unit else f"{name} {curve.median:.3g}"
        step = _shape(each).step
        if step is not None and step[0] < step[1]:
            low, high = (number(end + getattr(curve, "offset", 0.0)) for end in step)
            return f"{words} (a step: no level between {low} and {high})"
        band, bands = getattr(curve, "median_band", None), self.fitting.bands
        if band is None or bands is None:
            return words
        return f"{words} ({100.0 * bands.confidence:g} %: {number(band[0])} to {number(band[1])})"

    def _beta_words(self) -> str:
        """Return beta of the last damage state, and of what it is the deviation."""
        last = self.states[-1]
        shape, curve = _shape(last), last.curve
        words = f"beta {number(shape.beta)}"
        if isinstance(curve, TwoStageCurve) and curve.offset:
            return f"{words} of the excess over uplift, {shape.measure[0]}"
        return words if shape is curve else f"{words} given uplift"

    def _headline(self) -> str:
        """Return the answer in a line."""
        last = self.states[-1]
        median = last.curve.median
        unit = f" {self.measure.unit}" if self.measure.unit else ""
        half = f"half {_verb(last.state)}"
        answer = f"no level at which {half}"
        if not math.isnan(median):
            answer = f"{half} at {number(median)}{unit}"
        shape = _shape(last)
        if not math.isnan(shape.beta):
            answer += f", {self._beta_words()}"
            answer += f", {condition_of(self.ensemble)}" if last.given_uplift else ""
        return with_misfit(
            f"Fragility in {self.measure.label}: {answer}; "
            f"{plural(self.records, 'record')}, {self.runs:,} runs",
            last.curve.misfit,
        )

    def _points(self) -> list[dict[str, Any]]:
        """Return a row for each damage state and level."""
        return [
            {
                "damage_state": each.state.name,
                "level": level,
                "trials": trials,
                "uplifted": lifted,
                "failures": failures,
                "share": failures / tried if (tried := _tried(each, trials, lifted)) else None,
                "probability": number_or_none(float(each.curve.probability(level))),
            }
            for each in self.states
            for level, trials, lifted, failures in each.points
        ]

    def _best(self) -> list[dict[str, Any]]:
        """Return single measures and the best pair, the best first."""
        rows = self._ranking()
        pairs = [row for row in rows if " and " in row["measure"]]
        return [row for row in rows if row not in pairs[1:]]

    def _ranking(self) -> list[dict[str, Any]]:
        """Return a row for each measure."""
        trials = max(self.states[-1].plain.trials, 1)
        return [
            {
                "measure": " and ".join(each.key for each in row.measure),
                "damage_state": row.state,
                "stage": "plain",
                "status": row.status,
                "median": number_or_none(row.median),
                "beta": number_or_none(row.beta),
                "log_likelihood": row.log_likelihood,
                "log_likelihood_per_run": row.log_likelihood / trials,
                "aic": row.aic,
            }
            for row in self.ranking
        ]


def _shown_row(each: StateFragility) -> dict[str, Any]:
    """Return what people read of a damage state."""
    curve, shape = each.curve, _shape(each)
    return {
        "state": _short(each.state),
        "median": _with_band(curve.median, getattr(curve, "median_band", None)),
        "beta": _with_band(shape.beta, shape.beta_band),
        "stages": ("1" if shape is curve else "2")
        + (", given uplift" if each.given_uplift else "")
        + ("" if shape.status == "fitted" else f", {shape.status}"),
        "misfit": number_or_none(curve.misfit),
        "gain": number_or_none(curve.gain) if isinstance(curve, TwoStageCurve) else None,
    }


def _shape(each: StateFragility) -> FragilityCurve:
    """Return the curve that has the beta of a damage state."""
    curve = each.curve
    return curve if isinstance(curve, FragilityCurve) else curve.given_uplift


def _verb(state: DamageState) -> str:
    """Return what a block does in a damage state, in a word or two."""
    if state.peak is not None:
        return f"tilt > {state.peak:g} alpha"
    return {"uplift": "lift", "overturned": "fall"}[state.name]


def _short(state: DamageState) -> str:
    """Return a name that leaves room for the bands beside it."""
    default = state.peak is not None and state.name == f"theta/alpha > {state.peak:g}"
    return f"> {state.peak:g} alpha" if default else state.name


def _columns(unit: str) -> tuple[Column, ...]:
    """Return the columns of the table of damage states."""
    return (
        Column("state", "damage state", left=True),
        Column("median", f"median [{unit}]" if unit else "median", left=True),
        Column("beta", "beta", left=True),
        Column("misfit", "misfit"),
        Column("gain", "gain"),
        Column("stages", "stages", left=True),
    )


def _with_band(value: float, band: tuple[float, float] | None) -> str:
    """Return a number and its band in words."""
    if math.isnan(value):
        return "—"
    return (
        number(value) if band is None else f"{number(value)} ({number(band[0])}-{number(band[1])})"
    )


def _tried(state: StateFragility, trials: int, lifted: int | None) -> int:
    """Return the number of runs of a state's curve: over PGV only runs that lift."""
    return lifted if state.given_uplift and lifted is not None else trials
