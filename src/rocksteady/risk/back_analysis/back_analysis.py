"""Result of a back-analysis: which shakings agree with what fell and what stood."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.model.checks.arguments import checked_result
from rocksteady.model.checks.validation import in_range
from rocksteady.model.equations import Model
from rocksteady.results.numbers import chance, number, number_or_none
from rocksteady.results.result import Result
from rocksteady.results.words import Label
from rocksteady.risk.back_analysis._density import level_of
from rocksteady.risk.back_analysis.survey import Survey
from rocksteady.seismic.measures.scalar import Measure

Bound = Literal["interval", "lower bound", "upper bound"]


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BackAnalysis(Result):
    """Shakings that agree with a survey, from `rocksteady.back_analyse`.

    Attributes
    ----------
    survey, measures, records
        What was given; of the records the names.
    values_at_one
        Measures of the records as they are, shape (records, measures).
    first_values
        Values of the first measure that are compared, shape (nodes,).
    weights
        Posterior probability of each record at each value, tempered, shape (records, nodes).
    density
        Density of the logarithms of the first two measures, smoothed, shape (nodes, ratios).  Where
        outcomes are of one kind it is no density: the chance of the survey, the mean over records
        of like ratio.
    ratios
        Second measure over the first on the grid of `density`, shape (ratios,).
    threshold
        Density, or chance, on the edge of the region.
    confidence
        Share of shakings that the region covers where they are in no suite.
    share
        Posterior probability of the region.
    plain_coverage
        Coverage of records that are left out, by a region whose posterior probability is
        `confidence`; NaN where none was left out.
    held_out_surveys
        Number of simulated surveys that these follow from; 0 where no record was left out.
    temper
        Exponent of the likelihood.
    temper_scores
        Mean logarithm of the density at the truth, by temper, of records that are left out.
    bound
        "interval", "lower bound" where all fell, or "upper bound" where nothing fell.
    medians, lows, highs
        Posterior median of each measure, and the ends of its interval; NaN of what outcomes of
        one kind leave open.  A bound is where the chance of the survey is 1 - confidence.
    mc_errors
        Monte Carlo error of ln(median), or of that of the bound, from two halves of the draws.
    effective_records
        1 over the sum of squared weights of records.
    runs, seconds
        Number of runs, and time that they took.
    model
        Equations of motion of the runs.
    warnings
        Sentences on what makes the result doubtful.
    """

    survey: Survey
    measures: tuple[Measure, ...]
    records: tuple[str, ...]
    values_at_one: Floats
    first_values: Floats
    weights: Floats
    density: Floats
    ratios: Floats
    threshold: float
    confidence: Annotated[float, Label("Confidence", chance)]
    share: float
    plain_coverage: Annotated[float, Label("", plain=number_or_none)]
    held_out_surveys: Annotated[int, Label("Coverage of the region")]
    temper: Annotated[float, Label("Temper of the likelihood")]
    temper_scores: Mapping[float, float]
    bound: Annotated[Bound, Label("Kind of result")]
    medians: Floats
    lows: Floats
    highs: Floats
    mc_errors: Floats
    effective_records: Annotated[float, Label("Effective number of records", number)]
    draws: Annotated[int, Label("Draws of each object at each scale")]
    runs: Annotated[int, Label("Runs", "{:,}".format)]
    seconds: float
    model: Model
    warnings: tuple[str, ...] = ()

    @property
    def limits(self) -> Annotated[tuple[float, float], Label("Limits that were searched")]:
        """Limits of the first measure."""
        return float(self.first_values[0]), float(self.first_values[-1])

    @cached_property
    def region(self) -> NDArray[np.bool_]:
        """Whether each cell of `density` is in the region, shape (nodes, ratios)."""
        return np.asarray(self.density >= self.threshold)

    @property
    def inner_threshold(self) -> float:
        """Density on the edge of the smallest region with half of the posterior.

        Where outcomes are of one kind it is a chance of the survey of 0.5.
        """
        return level_of(self.density, 0.5) if self.bound == "interval" else 0.5

    def density_at(self, first: float, second: float) -> float:
        """Return the density, or the chance, at values of the first two measures.

        Parameters
        ----------
        first, second
            In the units of the measures.

        Raises
        ------
        InputError
            If the grid does not reach them.
        """
        from scipy.interpolate import RegularGridInterpolator

        hint = "stay inside, or analyse other limits: rs.calibration.ScanOptions(limits=...)"
        values, ratios = self.first_values, self.ratios
        first = in_range("first", first, values[0], values[-1], "[]", hint=hint)
        low, high = first * ratios[0], first * ratios[-1]
        second = in_range("second", second, low, high, "[]", hint=hint)
        grid = np.log(values), np.log(ratios)
        at = np.log([first, np.clip(second / first, ratios[0], ratios[-1])])  # less rounding
        return float(RegularGridInterpolator(grid, self.density)(at[np.newaxis])[0])

    def contains(self, first: float, second: float) -> bool:
        """Return whether values of the first two measures lie in the region.

        Parameters
        ----------
        first, second
            In the units of the measures.

        Raises
        ------
        InputError
            If the grid does not reach them.
        """
        return self.density_at(first, second) >= self.threshold

    @property
    def record_weights(self) -> Floats:
        """Posterior probability of each record, shape (records,)."""
        return np.asarray(self.weights.sum(axis=1))

    def rows(self) -> list[dict[str, Any]]:
        """Return the interval of each measure."""
        keys = ("measure", "label", "median", "low", "high", "mc_error")
        numbers = np.stack([self.medians, self.lows, self.highs, self.mc_errors], axis=1)
        return [
            dict(zip(keys, (measure.key, str(measure), *map(number_or_none, row)), strict=True))
            for measure, row in zip(self.measures, numbers.tolist(), strict=True)
        ]

    def record_rows(self) -> list[dict[str, Any]]:
        """Return the weight of each record and the scale that agrees best, the likeliest first."""
        keys = ("record", "weight", "scale", *(measure.key for measure in self.measures))
        peaks = self.first_values[self.weights.argmax(axis=1)][:, np.newaxis]
        first = self.values_at_one[:, :1]
        columns = [
            self.record_weights[:, np.newaxis],
            peaks / first,
            peaks * self.values_at_one / first,
        ]
        numbers = np.hstack(columns).tolist()
        order = np.argsort(-self.record_weights, kind="stable").tolist()
        return [
            dict(zip(keys, (self.records[place], *numbers[place]), strict=True)) for place in order
        ]

    def grid_rows(self) -> list[tuple[float, float, float, bool]]:
        """Return both measures, the density and whether it is in the region, of each cell."""
        up = self.first_values[:, np.newaxis] * self.ratios
        across = np.broadcast_to(self.first_values[:, np.newaxis], up.shape)
        columns = (across, up, self.density, self.region)
        return list(zip(*(each.ravel().tolist() for each in columns), strict=True))
