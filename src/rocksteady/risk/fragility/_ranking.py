"""Measures of intensity compared: the same labels over each, ranked by their likelihood."""

import math
from collections.abc import Sequence
from itertools import product
from typing import Literal

import numpy as np

from rocksteady.errors import InputError
from rocksteady.risk.fits.fragility_curve import fit_curve
from rocksteady.risk.fits.vector_fit import fit_vector
from rocksteady.risk.fragility._labels_of_runs import Labels
from rocksteady.risk.fragility.damage_states import DamageState
from rocksteady.risk.fragility.efficiency import Efficiency
from rocksteady.seismic.measures.scalar import Measure


def rank_measures(
    labels: Labels,
    measures: Sequence[Measure],
    state: DamageState,
    family: Literal["lognormal", "logistic"],
) -> tuple[Efficiency, ...]:
    """Return measures and pairs of them, that of the least AIC first.

    A measure that scaling does not change enters pairs alone: over it alone the levels of a record
    would all stand at one place.  Pairs are lognormal.
    """
    single = [measure for measure in measures if measure.scales]
    still = [measure for measure in measures if not measure.scales]
    ranking = [_alone(labels, measure, state, family) for measure in single]
    pairs = [*product(single, still)]
    plain = {measure.key: measure for measure in single}
    if {"pga_g", "pgv_m_s"} <= plain.keys():
        pairs.append((plain["pga_g"], plain["pgv_m_s"]))
    if family == "lognormal":
        together = (_together(labels, pair, state) for pair in pairs)
        ranking += [each for each in together if each is not None]
    return tuple(sorted(ranking, key=lambda each: each.aic))


def _alone(
    labels: Labels,
    measure: Measure,
    state: DamageState,
    family: Literal["lognormal", "logistic"],
) -> Efficiency:
    """Return the efficiency of one measure."""
    curve = fit_curve(
        labels.intensity(measure).ravel(),
        labels.count(state).ravel(),
        labels.trials.ravel(),
        family=family,
        groups=labels.groups.ravel(),
        measure=(measure.label, measure.unit),
    )
    return Efficiency(
        measure=(measure,),
        state=state.name,
        status=curve.status,
        median=curve.median,
        beta=curve.beta,
        log_likelihood=curve.log_likelihood,
        aic=curve.aic,
    )


def _together(
    labels: Labels, pair: tuple[Measure, Measure], state: DamageState
) -> Efficiency | None:
    """Return the efficiency of two measures; None where one follows from the other here."""
    at = np.column_stack([labels.intensity(measure).ravel() for measure in pair])
    try:
        fit = fit_vector(at, labels.count(state).ravel(), labels.trials.ravel())
    except InputError:  # records of one shape: the two depend on each other
        return None
    return Efficiency(
        measure=pair,
        state=state.name,
        status=fit.status,
        median=math.nan,
        beta=math.nan,
        log_likelihood=fit.log_likelihood,
        aic=fit.aic,
    )
