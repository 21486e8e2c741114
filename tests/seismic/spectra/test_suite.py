"""What a suite of spectra has in common: order statistics in which a fall is more than any peak."""

import math

import numpy as np
import pytest
import xarray

from rocksteady import Record, Status, compute_rocking_spectrum
from rocksteady.errors import InputError
from rocksteady.measures import compute_suite_spectrum
from rocksteady.model.equations import Linear
from tests.seismic.grounds import ALPHAS, PERIODS, ground


def spectra(peaks: list[float], status: list[int]) -> xarray.Dataset:
    """Return a suite whose peaks are known."""
    return xarray.Dataset(
        {
            "status": ("record", np.array(status, dtype=np.int8)),
            "peak_angle": ("record", peaks),
            "peak_velocity": ("record", [2.0 * peak for peak in peaks]),
        },
        coords={"record": [f"r{n}" for n in range(len(peaks))]},
    )


def test_quantiles_are_peaks_of_records_and_a_fall_is_larger_than_all() -> None:
    found = spectra([0.3, 1.0, 0.1, 0.2], [1, 2, 1, 0])
    summary = compute_suite_spectrum(found, (0.0, 0.25, 0.26, 0.5, 0.75, 0.76, 1.0))
    expected = [0.1, 0.1, 0.2, 0.2, 0.3, math.inf, math.inf]
    assert summary.peak_angle.values.tolist() == expected
    assert summary.peak_velocity.values.tolist() == [2.0 * peak for peak in expected]
    assert (float(summary.overturned), float(summary.undecided)) == (0.25, 0.0)
    assert summary.attrs["records"] == 4


def test_what_has_no_answer_counts_in_no_quantile() -> None:
    found = spectra([0.3, 9.0, 0.1], [1, Status.UNDECIDED, 1])
    summary = compute_suite_spectrum(found)
    assert summary.peak_angle.values.tolist() == [0.1, 0.1, 0.3]
    assert float(summary.undecided) == pytest.approx(1.0 / 3.0)
    none = compute_suite_spectrum(spectra([0.3], [Status.LOST_CONTACT]))
    assert np.isnan(none.peak_angle.values).all()


def test_over_a_grid_it_is_numpys_quantile() -> None:
    suite = [ground(seed, peak) for seed, peak in ((1, 3.0), (2, 4.0), (3, 6.0), (4, 9.0))]
    found = compute_rocking_spectrum(suite, alpha=ALPHAS, periods_s=PERIODS, model=Linear())
    summary = compute_suite_spectrum(found)
    assert summary.peak_angle.dims == ("quantile", "alpha", "period")
    fell = (found.status == Status.OVERTURNED).values
    peaks = np.where(fell, 1e9, found.peak_angle.values)
    for place, part in enumerate((0.16, 0.5, 0.84)):
        expected = np.quantile(peaks, part, axis=0, method="inverted_cdf")
        got = summary.peak_angle.isel(quantile=place).values
        np.testing.assert_array_equal(np.minimum(got, 1e9), expected)
    np.testing.assert_allclose(summary.overturned.values, fell.mean(axis=0), rtol=1e-15)
    assert 0.0 < float(summary.overturned.mean()) < 1.0


def test_it_needs_several_records_and_parts_of_them() -> None:
    found = compute_rocking_spectrum(ground(), alpha=0.2, periods_s=math.pi, model=Linear())
    with pytest.raises(InputError, match="no axis of records"):
        compute_suite_spectrum(found)
    one = compute_rocking_spectrum(
        [Record(acceleration_m_s2=np.array([1.0, 0.0]), dt_s=0.1)],
        alpha=0.2,
        periods_s=math.pi,
        model=Linear(),
    )
    assert compute_suite_spectrum(one).peak_angle.values.tolist() == [0.0, 0.0, 0.0]
    with pytest.raises(InputError, match="quantiles"):
        compute_suite_spectrum(one, (0.5, 1.5))
