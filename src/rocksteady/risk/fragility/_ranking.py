"""Measures of intensity compared: the same labels over each, ranked by their likelihood."""

from collections.abc import Sequence
from typing import Literal

from rocksteady.risk.fits.fragility_curve import fit_curve
from rocksteady.risk.fragility._labels_of_runs import Labels
from rocksteady.risk.fragility.damage_states import DamageState
from rocksteady.risk.fragility.efficiency import Efficiency
from rocksteady.seismic.measures.scalar import Intensity


def rank_measures(
    labels: Labels,
    measures: Sequence[Intensity],
    state: DamageState,
    family: Literal["lognormal", "logistic"],
) -> tuple[Efficiency, ...]:
    """Return the measures, the one of the largest likelihood first."""
    trials, failures = labels.trials.ravel(), labels.count(state).ravel()
    found = []
    for measure in measures:
        if not measure.scales:
            continue
        curve = fit_curve(
            labels.intensity(measure).ravel(),
            failures,
            trials,
            family=family,
            groups=labels.groups.ravel(),
            measure=(measure.label, measure.unit),
        )
        found.append(
            Efficiency(
                measure=(measure,),
                state=state.name,
                status=curve.status,
                median=curve.median,
                beta=curve.beta,
                log_likelihood=curve.log_likelihood,
                aic=curve.aic,
            )
        )
    return tuple(sorted(found, key=lambda each: each.aic))
