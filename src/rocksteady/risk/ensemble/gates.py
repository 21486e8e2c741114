"""Gate of uplift, where it is known exactly: no run lifts up to it, and each lifts above it."""

from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.seismic.measures.scalar import Measure

if TYPE_CHECKING:
    import xarray

SAME_GATE = 1e-9
"""Relative difference of gates that rounding makes."""


def uplift_of(
    ensemble: "xarray.Dataset",
    measure: Measure,
    *,
    intensity: Floats,
    lifted: Integers,
    trials: Integers,
) -> float | Integers:
    """Return the gate of an ensemble where its runs agree with it, and the uplifts otherwise.

    Parameters
    ----------
    ensemble
        From `run_ensemble`.
    measure
        Measure of the intensity.
    intensity, lifted, trials
        Intensity, number of uplifts and number of runs of each observation, all of one shape.

    Returns
    -------
    float or ndarray
        What `rocksteady.risk.fit_two_stages` takes for `uplifted`.
    """
    gate = _gate_of(ensemble, measure)
    if gate is not None and np.array_equal(np.where(intensity > gate, trials, 0), lifted):
        return gate
    return lifted


def _gate_of(ensemble: "xarray.Dataset", measure: Measure) -> float | None:
    """Return the peak acceleration at which every block lifts; None without such a gate.

    A symmetric block at rest lifts where |a| > g tan alpha, of the linear model where
    |a| > g alpha.  A vertical motion moves the limit, and unequal sides have two.  A block against
    a wall lifts by the peak of one sign alone, which the peak acceleration need not be.
    """
    if measure.name not in ("pga_g", "pga_per_uplift"):
        return None
    if "with" in ensemble["vertical"].values.tolist():
        return None
    if "one_sided" in ensemble.coords:
        return None
    alphas = ensemble["alpha"].values.tolist()
    if "negative_alpha" in ensemble.coords and ensemble["negative_alpha"].values.tolist() != alphas:
        return None
    linear = ensemble.attrs["model"] != "nonlinear"
    gates = [
        (alpha if linear else tan(alpha)) / (1.0 if measure.name == "pga_g" else tan(alpha))
        for alpha in alphas
    ]
    first = gates[0]
    return first if all(abs(gate - first) <= SAME_GATE * first for gate in gates) else None
