"""Statistics of the rocking spectra of a suite of records."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.validation import in_range
from rocksteady.outcomes import Status

if TYPE_CHECKING:
    import xarray


QUANTILES = (0.16, 0.5, 0.84)


@checked
def compute_suite_spectrum(
    spectra: "xarray.Dataset", quantiles: Sequence[float] = QUANTILES
) -> "xarray.Dataset":
    """Summarise the spectra of a suite by quantiles and the share of falls.

    A record that overturns a block counts as larger than any that does not.  A quantile is the
    least peak that this part of the records does not exceed: a peak of one of them, or infinite
    where it is one that overturns.

    Parameters
    ----------
    spectra
        From `compute_rocking_spectrum` or `simulate_many`, of several records.
    quantiles
        From 0 to 1; default 0.16, 0.5 and 0.84.

    Returns
    -------
    xarray.Dataset
        ``peak_angle`` and ``peak_velocity`` over ``quantile`` and what is left without ``record``;
        ``overturned``, the share of the records that overturn the block; ``undecided``, the share
        of records that neither overturn it nor leave it rocking or at rest, which no quantile
        counts.

    Raises
    ------
    InputError
        If it has no axis of records, or a quantile is outside [0, 1].

    Examples
    --------
    >>> from rocksteady import Record, compute_rocking_spectrum
    >>> from rocksteady.measures import compute_suite_spectrum
    >>> shock = Record(acceleration_m_s2=[0.0, 4.0, -4.0, 0.0], dt_s=0.2)
    >>> suite = [shock.scaled(factor) for factor in (0.6, 0.8, 4.0)]
    >>> spectra = compute_rocking_spectrum(suite, alpha=0.2, periods_s=[4.0, 8.0])
    >>> summary = compute_suite_spectrum(spectra, quantiles=(0.5,))
    >>> summary.peak_angle.values.round(4)
    array([[0.0771, 0.0185]])
    >>> summary.overturned.values.round(3)
    array([0.333, 0.   ])
    """
    import xarray

    if "record" not in spectra.dims:
        raise InputError(
            "spectra",
            ", ".join(map(str, spectra.dims)),
            "it has no axis of records",
            "give compute_rocking_spectrum a list of records",
        )
    hint = "give parts, as (0.16, 0.5, 0.84)"
    parts = [in_range("quantiles", part, 0.0, 1.0, "[]", hint=hint) for part in quantiles]
    if not parts:
        raise InputError("quantiles", quantiles, "it must hold one part or more", hint)
    # Those of a record, as the factor that brings it to a level, are none of the suite.
    spectra = spectra.drop_vars(
        [name for name, values in spectra.coords.items() if "record" in values.dims]
    )
    status = spectra["status"]
    fell = status == Status.OVERTURNED
    known = fell | (status == Status.ROCKING) | (status == Status.AT_REST)
    variables = {}
    for name in ("peak_angle", "peak_velocity"):
        peaks = spectra[name].where(~fell, np.inf).where(known)
        values = peaks.transpose("record", ...).values
        left = peaks.isel(record=0, drop=True)
        variables[name] = (("quantile", *left.dims), _quantiles(values, parts), spectra[name].attrs)
    kept = spectra["peak_angle"].isel(record=0, drop=True)
    for name, which, words in (
        ("overturned", fell, "share of records that overturn the block"),
        ("undecided", ~known, "share of records without an answer"),
    ):
        share = which.mean("record").transpose(*kept.dims)
        variables[name] = (kept.dims, share.values, {"units": "1", "long_name": words})
    coordinates = {name: kept.coords[name] for name in kept.coords}
    return xarray.Dataset(
        variables,
        coords={**coordinates, "quantile": ("quantile", parts, {"long_name": "part of records"})},
        attrs={**spectra.attrs, "records": spectra.sizes["record"]},
    )


def _quantiles(values: Floats, parts: Sequence[float]) -> Floats:
    """Return order statistics along the first axis, nan left out, shape (parts, ...)."""
    ordered = np.sort(values, axis=0)  # nan last
    count = np.sum(~np.isnan(values), axis=0)
    places = [np.clip(np.ceil(part * count).astype(np.int64) - 1, 0, None) for part in parts]
    picked = [np.take_along_axis(ordered, place[np.newaxis], axis=0)[0] for place in places]
    return np.stack(picked)
