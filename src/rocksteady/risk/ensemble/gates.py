"""Gate of uplift: the peak acceleration of the ground up to which no run lifts."""

import math
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats, Integers
from rocksteady.kernels.elementary.arrays import tan
from rocksteady.model.blocks.gravity import ROUNDED, in_g
from rocksteady.seismic.measures.scalar import Measure

if TYPE_CHECKING:
    import xarray

GIVEN = {"nonlinear": "given PGA > g tan alpha", "linear": "given PGA > g alpha"}
"""Condition of a curve of the runs that lift, by the model."""
GIVEN_UPLIFT = "given uplift"
"""The same where no peak acceleration parts them."""


def lowest_gate(ensemble: "xarray.Dataset") -> float | None:
    """Return the peak acceleration of the ground [g] up to which no block lifts.

    That of the weaker side.  A vertical motion moves it, and a floor multiplies the acceleration by
    its own factor: None with either.
    """
    gate = float(ensemble.attrs["gate_g"])
    return None if math.isnan(gate) else gate


def condition_of(ensemble: "xarray.Dataset") -> str:
    """Return the condition of a curve of the runs that lift, in words."""
    if lowest_gate(ensemble) is None:
        return GIVEN_UPLIFT
    return GIVEN[ensemble.attrs["model"]]


def which_lift(ensemble: "xarray.Dataset") -> str:
    """Return of which runs such a curve is, in words: "that lift", and the condition if known."""
    condition = condition_of(ensemble)
    return "that lift" if condition == GIVEN_UPLIFT else f"that lift, {condition}"


def uplift_of(
    ensemble: "xarray.Dataset",
    measure: Measure,
    *,
    intensity: Floats,
    lifted: Integers,
    trials: Integers,
) -> float | Integers:
    """Return the gate that all blocks have, where the runs agree with it, or else the uplifts.

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

    Unequal sides have two.  A block against a wall lifts by the peak of one sign alone, which the
    peak acceleration need not be.
    """
    if measure.name not in ("pga_g", "pga_per_uplift") or lowest_gate(ensemble) is None:
        return None
    if "one_sided" in ensemble.coords:
        return None
    alphas = ensemble["alpha"].values.tolist()
    if "negative_alpha" in ensemble.coords and ensemble["negative_alpha"].values.tolist() != alphas:
        return None
    linear = ensemble.attrs["model"] != "nonlinear"
    gates = [
        (alpha if linear else tan(alpha))
        / (1.0 / in_g(gravity) if measure.name == "pga_g" else tan(alpha))
        for alpha, gravity in zip(alphas, ensemble["gravity"].values.tolist(), strict=True)
    ]
    first = gates[0]
    return first if all(abs(gate - first) <= ROUNDED * first for gate in gates) else None
