"""Fragility of one damage state: its curves and its points."""

from dataclasses import dataclass
from typing import Any

from rocksteady.model.checks.arguments import checked_result
from rocksteady.results.description import Column, Description, Fact, Table
from rocksteady.results.numbers import number, number_or_none
from rocksteady.results.result import Result
from rocksteady.risk.fits.fragility_curve import FragilityCurve
from rocksteady.risk.fits.two_stages import TwoStageCurve
from rocksteady.risk.fragility.damage_states import DamageState

GIVEN = "given-uplift"
"""Stage whose intensity, and with it median and beta, is that above the offset."""


@checked_result
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class StateFragility(Result):
    """Fragility of one damage state.

    Attributes
    ----------
    state
        The damage state.
    plain
        One curve over all runs.
    two_stage
        P(uplift) times P(state given uplift); None where no run lifts, or every one does and the
        gate is not known, and of uplift itself.
    points
        Intensity, trials, uplifts and failures of each level; without levels of the measure, those
        of joined neighbours, without uplifts.
    given_uplift
        Whether the curve is of the runs that lift alone.

    Examples
    --------
    >>> from rocksteady import Block, compute_fragility
    >>> from rocksteady.motions import make_synthetic_suite
    >>> from rocksteady.risk import FitOptions, Levels, RestitutionBand
    >>> fragility = compute_fragility(
    ...     Block.rectangle(width=0.3, height=1.5),
    ...     make_synthetic_suite(3),
    ...     levels=Levels("pgv_m_s", [0.2, 0.5, 1.0]),
    ...     restitution=RestitutionBand(draws=1),
    ...     fitting=FitOptions(states=["overturned"], bands=None),
    ... )
    >>> (state,) = fragility.states
    >>> state.state.name, state.plain.status, len(state.points)
    ('overturned', 'separated', 3)
    """

    state: DamageState
    plain: FragilityCurve
    two_stage: TwoStageCurve | None = None
    points: tuple[tuple[float, int, int | None, int], ...] = ()
    given_uplift: bool = False

    @property
    def curve(self) -> FragilityCurve | TwoStageCurve:
        """The curve to use: given uplift, in two stages, or one curve."""
        return self.plain if self.two_stage is None else self.two_stage.over(self.given_uplift)

    @property
    def gain(self) -> float | None:
        """What two stages add to the log-likelihood of the failures; None without stages."""
        return None if self.two_stage is None else self.two_stage.gain

    def describe(self) -> Description:
        """Return the curve to use, and a row for each of its curves."""
        curve = self.curve.describe()
        rows = self.rows(self.plain.measure[0])
        columns = (
            Column("stage", "curve", left=True),
            Column("status", "status", left=True),
            Column("median", "median", number),
            Column("beta", "beta", number),
            Column("failures", "reached", str),
            Column("trials", "of", str),
        )
        return Description(
            headline=f"{self.state.name}: {curve.headline}",
            facts=[
                Fact("damage_state", self.state.name, "damage state"),
                Fact("peak", self.state.peak),
                *(fact for fact in curve.facts if fact.key != "measure"),
            ],
            tables=[Table("fits", rows, columns)],
            notes=curve.notes,
        )

    def plot(self, *arguments: Any, **options: Any) -> Any:
        """Plot the curve to use, as `rocksteady.plots.fragility`."""
        return self.curve.plot(*arguments, **options)

    def rows(self, measure: str) -> list[dict[str, Any]]:
        """Return a row for each of its curves, that to use first, under the names of the JSON.

        Parameters
        ----------
        measure
            Name of the measure of intensity.
        """
        curves: list[tuple[str, FragilityCurve | TwoStageCurve]] = [("plain", self.plain)]
        if self.two_stage is not None:
            stages = self.two_stage
            curves[:0] = [
                ("two-stage", stages),
                ("uplift", stages.uplift),
                (GIVEN, stages.given_uplift),
            ]
        curves.sort(key=lambda each: each[1] is not self.curve)
        return [self._row(measure, stage, curve) for stage, curve in curves]

    def _row(
        self, measure: str, stage: str, curve: FragilityCurve | TwoStageCurve
    ) -> dict[str, Any]:
        lognormal = curve if isinstance(curve, FragilityCurve) else None
        low, high = getattr(curve, "median_band", None) or (None, None)
        beta_low, beta_high = (None if lognormal is None else lognormal.beta_band) or (None, None)
        step_low, step_high = (None if lognormal is None else lognormal.step) or (None, None)
        return {
            "damage_state": self.state.name,
            "peak": self.state.peak,
            "measure": measure,
            "stage": stage,
            "used": curve is self.curve,
            "status": "product" if lognormal is None else lognormal.status,
            "median": number_or_none(curve.median),
            "offset": self.two_stage.offset if self.two_stage and stage == GIVEN else 0.0,
            "beta": None if lognormal is None else number_or_none(lognormal.beta),
            "low": low,
            "high": high,
            "beta_low": beta_low,
            "beta_high": beta_high,
            "log_likelihood": curve.log_likelihood,
            "misfit": number_or_none(curve.misfit),
            "gain": None if lognormal or self.gain is None else number_or_none(self.gain),
            "goodness": None if lognormal is None else lognormal.goodness,
            "step_low": step_low,
            "step_high": step_high,
            "trials": None if lognormal is None else lognormal.trials,
            "failures": None if lognormal is None else lognormal.failures,
        }
